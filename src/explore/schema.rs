//! The schema of the knobs: names, kinds, ranges, units, defaults and the states that have them, written once for page, lessons, links and
//! documents.

use super::refusal::{Refusal, RefusalRule};
use super::scale::{CELL, MODULUS};
use crate::quantity::number_in_words;
use KnobGroup::{File, Load, Recording, Solid, Solver, Surface};
use KnobKind::{Choice, Choices, Length, Nodes, Number, Switch};
use serde::Serialize;
use serde_json::{Map, Value, json};

/// The largest number of points of a line, and of a surface, that the program solves while the user waits.
const MOST_POINTS_OF_PROGRAM: [usize; 2] = [1 << 18, 1 << 20];

/// The largest number of points of a line, and of a surface, that the module in a browser solves while the user waits: it has one
/// thread.
pub const MOST_POINTS_OF_MODULE: [usize; 2] = [1 << 16, 1 << 18];

/// The largest number of points of a line, and of a surface, here.
pub(crate) const MOST_POINTS: [usize; 2] =
    if cfg!(target_arch = "wasm32") { MOST_POINTS_OF_MODULE } else { MOST_POINTS_OF_PROGRAM };

/// The largest number of points of a line, and of a surface, whose solid yields below it while the user waits: each of them stands for all layers below.
pub(super) const MOST_POINTS_OF_YIELDING: [usize; 2] = [1 << 11, 1 << 14];

/// The number of points of a line, and of a surface, whose solid yields, to start with.
const USUAL_POINTS_OF_YIELDING: [usize; 2] = [1 << 9, 1 << 12];

/// Points along each side of a surface to start with.
pub(super) const SURFACE_SIDE: usize = 1 << 8;
/// The range of an attraction over the length of the cell, to start with.
pub(super) const USUAL_RANGE: f64 = 1e-4;
/// The hardening modulus of a solid that yields over the contact modulus, to start with.
pub(super) const USUAL_HARDENING: f64 = 0.01;
/// The most bumps of a line.
pub(super) const MOST_BUMPS: usize = 32;
/// The largest file of heights, in bytes.
pub const MOST_HEIGHTS: usize = 1 << 26;

/// A group of controls.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum KnobGroup {
    /// How hard the bodies are pressed.
    Load,
    /// The deformable body.
    Solid,
    /// The rigid body.
    Surface,
    /// The file of heights.
    File,
    /// The method, and when it stops.
    Solver,
    /// What is recorded.
    Recording,
}

/// The states of the page that have a knob.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum KnobScenes {
    /// All states.
    All,
    /// All but that of a setup file.
    Own,
    /// All but that of a setup file, with a solid that creeps.
    Creeping,
    /// The same, where the surface does not slide.
    Resting,
    /// All but that of a setup file, with a solid that yields below its surface.
    Yielding,
    /// All but that of a setup file, with adhesion.
    Adhering,
    /// All but that of a setup file, with adhesion, under loads and not at gaps.
    Pulled,
    /// All states but those at gaps.
    Loaded,
    /// All but that of a setup file, with friction.
    Rubbing,
    /// Surfaces that the knobs make: no file is the body.
    Made,
    /// Made surfaces with roughness.
    Rough,
    /// Made surfaces with roughness that are no lines.
    RoughSurface,
    /// A power law as the body.
    PowerLaw,
    /// GFMD as the solver.
    Gfmd,
    /// Damped GFMD as the solver.
    Damped,
    /// A file of heights as the body.
    Heights,
    /// A file of several channels.
    Channels,
    /// A file without units.
    Unitless,
    /// A file without a spacing.
    Unspaced,
    /// A file of heights at uneven positions.
    Uneven,
}

impl KnobScenes {
    /// Whether the other states hold a value of the knob, too, for when it is needed again.
    fn is_held_by_others(self) -> bool {
        matches!(
            self,
            Self::All
                | Self::Own
                | Self::Creeping
                | Self::Resting
                | Self::Yielding
                | Self::Adhering
                | Self::Pulled
                | Self::Loaded
                | Self::Rubbing
                | Self::Made
                | Self::Rough
                | Self::RoughSurface
                | Self::PowerLaw
        )
    }
}

/// How the value of a slider follows from its position.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SliderScale {
    /// The value is the position.
    Linear,
    /// The position is the logarithm of the value to the base of ten.
    Log10,
    /// The same, but the first position is zero.
    ZeroOrLog10,
    /// The position is the logarithm of the value to the base of two; values are whole.
    Log2,
}

/// The values of a knob that takes a number, and its control.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct NumericKnob {
    /// The least and the largest value.
    pub range: [f64; 2],
    /// The value to start with.
    pub default: f64,
    /// Whether only whole numbers are taken.
    pub whole: bool,
    /// First position, last position and step of its slider; none where the page has a field alone.
    pub slider: Option<[f64; 3]>,
    /// How the value follows from the position of the slider.
    pub scale: SliderScale,
    /// The unit, as a key of the texts of the page; none for a pure number.
    pub unit: Option<&'static str>,
}

impl NumericKnob {
    const fn new(range: [f64; 2], default: f64) -> Self {
        Self { range, default, whole: false, slider: None, scale: SliderScale::Linear, unit: None }
    }

    const fn whole(self) -> Self {
        Self { whole: true, ..self }
    }

    const fn linear(self, slider: [f64; 3]) -> Self {
        Self { slider: Some(slider), ..self }
    }

    const fn log10(self, slider: [f64; 3]) -> Self {
        Self { scale: SliderScale::Log10, ..self.linear(slider) }
    }

    const fn zero_or_log10(self, slider: [f64; 3]) -> Self {
        Self { scale: SliderScale::ZeroOrLog10, ..self.linear(slider) }
    }

    const fn log2(self, slider: [f64; 3]) -> Self {
        Self { scale: SliderScale::Log2, ..self.whole().linear(slider) }
    }

    const fn degrees(self) -> Self {
        Self { unit: Some("degrees"), ..self }
    }

    const fn waves(self) -> Self {
        Self { unit: Some("waves"), ..self }
    }
}

/// The values that a knob takes, and that which it has to start with.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum KnobKind {
    /// A number.
    Number(NumericKnob),
    /// One of some names.
    Choice {
        /// All names, in the order of the page; an empty name means no value.
        options: &'static [&'static str],
        /// One of them.
        default: &'static str,
    },
    /// Several of some names.
    Choices {
        /// All names, in the order of the page; a name with spaces means several values that belong together.
        options: &'static [&'static str],
        /// Some of them.
        default: &'static [&'static str],
    },
    /// Yes or no.
    Switch {
        /// Whether it is yes.
        default: bool,
    },
    /// A length with its unit, or none.
    Length {
        /// The allowed values.
        example: &'static str,
    },
    /// Numbers of nodes with commas between, or none.
    Nodes {
        /// The allowed values.
        example: &'static str,
    },
}

/// One knob.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Knob {
    /// The group of its control; none where the page has no control.
    pub group: Option<KnobGroup>,
    /// The name of its control on the page, and in the keys of its texts.
    pub id: &'static str,
    /// Where it stands in [`Knobs`](super::Knobs), from the outside in, with dots between.
    pub path: &'static str,
    /// The states that have it.
    pub scenes: KnobScenes,
    /// The values that it takes.
    #[serde(flatten)]
    pub kind: KnobKind,
}

/// A knob that all states have, with its value in the outermost place.
const fn knob(group: KnobGroup, id: &'static str, kind: KnobKind) -> Knob {
    Knob { group: Some(group), id, path: id, scenes: KnobScenes::All, kind }
}

impl Knob {
    const fn at(self, path: &'static str) -> Self {
        Self { path, ..self }
    }

    const fn only_in(self, scenes: KnobScenes) -> Self {
        Self { scenes, ..self }
    }

    /// What a state holds to start with; null for nothing.
    pub fn default(&self) -> Value {
        match self.kind {
            Number(NumericKnob { whole: true, default, .. }) => json!(default as u64),
            Number(NumericKnob { default, .. }) => json!(default),
            Choice { default: "", .. } | Length { .. } | Nodes { .. } => Value::Null,
            Choice { default, .. } => json!(default),
            Choices { default, .. } => default.iter().flat_map(|it| it.split(' ')).collect(),
            Switch { default } => json!(default),
        }
    }

    /// Refuses a number outside the range in a state of the knobs; others have no such knob.
    fn check(&self, knobs: &Value) -> Result<(), Refusal> {
        let Number(NumericKnob { range: [least, most], whole, .. }) = self.kind else { return Ok(()) };
        let value = self.path.split('.').try_fold(knobs, |place, name| place.get(name)).and_then(Value::as_f64);
        let Some(value) = value.filter(|value| !(least..=most).contains(value)) else { return Ok(()) };
        let rule = if whole { RefusalRule::KnobRangeOfWhole } else { RefusalRule::KnobRange };
        let [value, least, most] = [value, least, most].map(in_words);
        Err(rule.with([("knob", self.path.into()), ("value", value), ("least", least), ("most", most)]))
    }
}

/// The most waves per cell.
const MOST_WAVES: f64 = (MOST_POINTS[0] / 2) as f64;

/// Parts of a state that belong to its surface and have no row below.
const SURFACE_PARTS: [&str; 3] = ["bumps", "scene", "beside"];

/// Ways to level scan lines.
const LINE_LEVELS: &[&str] = &["", "offsets", "median", "settling", "line", "parabola"];

/// All knobs, in the order of the page.
#[rustfmt::skip]
pub const KNOBS: &[Knob] = &[
    knob(Load, "load", Number(NumericKnob::new([1e-5, 1e3], 0.05).log10([-4.0, 1.5, 0.02]))).only_in(KnobScenes::Loaded),
    knob(Solid, "hardness", Number(NumericKnob::new([0.0, 1.0], 0.0).linear([0.0, 0.002, 0.00002]))).only_in(KnobScenes::Own),
    knob(Solid, "yield-stress", Number(NumericKnob::new([0.0, 1.0], 0.0).zero_or_log10([-5.1, -2.0, 0.05]))).only_in(KnobScenes::Own),
    knob(Solid, "hardening", Number(NumericKnob::new([1e-6, 1.0], USUAL_HARDENING).log10([-4.0, -0.5, 0.1]))).only_in(KnobScenes::Yielding),
    knob(Solid, "release", Switch { default: false }).only_in(KnobScenes::Yielding),
    knob(Solid, "layer", Number(NumericKnob::new([0.0, 10.0], 0.0).linear([0.0, 0.5, 0.005]))).only_in(KnobScenes::Own),
    knob(Solid, "creep", Number(NumericKnob::new([0.0, 100.0], 0.0).linear([0.0, 20.0, 0.5]))).only_in(KnobScenes::Own),
    knob(Solid, "speed", Number(NumericKnob::new([0.0, 1e3], 0.0).zero_or_log10([-4.1, 2.0, 0.1]))).only_in(KnobScenes::Creeping),
    knob(Solid, "time", Number(NumericKnob::new([0.0, 100.0], 0.0).zero_or_log10([-2.1, 2.0, 0.1]))).only_in(KnobScenes::Resting),
    knob(Solid, "adhesion", Number(NumericKnob::new([0.0, 1.0], 0.0).zero_or_log10([-9.1, -4.0, 0.1]))).only_in(KnobScenes::Own),
    knob(Solid, "range", Number(NumericKnob::new([1e-7, 1.0], USUAL_RANGE).log10([-6.0, -2.0, 0.1]))).only_in(KnobScenes::Adhering),
    knob(Solid, "pull", Number(NumericKnob::new([0.0, 1e3], 0.0).zero_or_log10([-4.1, 1.5, 0.02]))).only_in(KnobScenes::Pulled),
    knob(Solid, "depth", Number(NumericKnob::new([0.0, 0.95], 0.0).linear([0.0, 0.95, 0.05]))).only_in(KnobScenes::Adhering),
    knob(Solid, "friction", Number(NumericKnob::new([0.0, 10.0], 0.0).linear([0.0, 1.0, 0.05]))).only_in(KnobScenes::Own),
    knob(Solid, "sideways", Number(NumericKnob::new([0.0, 0.99], 0.0).linear([0.0, 0.95, 0.05]))).only_in(KnobScenes::Rubbing),
    knob(Solid, "rolling", Switch { default: false }).only_in(KnobScenes::Rubbing),
    knob(Surface, "domain", Choice { options: &["line", "surface"], default: "line" }).only_in(KnobScenes::Made),
    knob(Surface, "body", Choice { options: &["flat", "round", "sine", "power-law", "file", "scene"], default: "flat" }),
    knob(Surface, "exponent", Number(NumericKnob::new([1.0, 12.0], 4.0).linear([1.0, 12.0, 0.5]))).only_in(KnobScenes::PowerLaw),
    knob(Surface, "roughness", Number(NumericKnob::new([0.0, 1.0], 1e-3).linear([0.0, 0.01, 0.0002]))).only_in(KnobScenes::Made),
    knob(Surface, "hurst", Number(NumericKnob::new([0.01, 1.0], 0.8).linear([0.1, 1.0, 0.05]))).only_in(KnobScenes::Rough),
    knob(Surface, "rolloff", Number(NumericKnob::new([1.0, MOST_WAVES], 4.0).linear([1.0, 32.0, 1.0]).waves())).only_in(KnobScenes::Rough),
    knob(Surface, "cutoff", Number(NumericKnob::new([2.0, MOST_WAVES], 128.0).log2([3.0, 13.0, 0.5]).waves())).only_in(KnobScenes::Rough),
    knob(Surface, "rolloff-form", Choice { options: &["plateau", "drop", "none"], default: "plateau" }).only_in(KnobScenes::Rough),
    knob(Surface, "peklenik", Number(NumericKnob::new([0.05, 20.0], 1.0).linear([1.0, 10.0, 0.5]))).only_in(KnobScenes::RoughSurface),
    knob(Surface, "lay-angle", Number(NumericKnob::new([-180.0, 180.0], 0.0).linear([-90.0, 90.0, 5.0]).degrees())).only_in(KnobScenes::RoughSurface),
    knob(Surface, "skewness", Number(NumericKnob::new([-5.0, 5.0], 0.0).linear([-2.0, 2.0, 0.1]))).only_in(KnobScenes::Rough),
    knob(Surface, "kurtosis", Number(NumericKnob::new([1.0, 50.0], 3.0).linear([1.5, 10.0, 0.1]))).only_in(KnobScenes::Rough),
    knob(Surface, "seed", Number(NumericKnob::new([0.0, u32::MAX as f64], 1.0).whole())).only_in(KnobScenes::Rough),
    knob(Surface, "points", Number(NumericKnob::new([4.0, MOST_POINTS[0] as f64], 4096.0).log2([5.0, 18.0, 1.0]))).only_in(KnobScenes::Made),
    knob(File, "channel", Choice { options: &[], default: "" }).at("heights.channel").only_in(KnobScenes::Channels),
    knob(File, "unit", Length { example: "1 µm" }).at("heights.unit").only_in(KnobScenes::Unitless),
    knob(File, "width", Length { example: "10 µm" }).at("heights.width").only_in(KnobScenes::Unspaced),
    knob(File, "boundary", Choice { options: &["periodic", "free"], default: "periodic" }).at("heights.boundary").only_in(KnobScenes::Heights),
    knob(File, "auto", Switch { default: true }).at("heights.auto").only_in(KnobScenes::Heights),
    knob(File, "resample", Choice { options: &["", "linear", "repeats"], default: "" }).at("heights.prepare.resample").only_in(KnobScenes::Uneven),
    knob(File, "crop", Nodes { example: "0,256,0,256" }).at("heights.prepare.crop").only_in(KnobScenes::Heights),
    knob(File, "level-rows", Choice { options: LINE_LEVELS, default: "" }).at("heights.prepare.level-rows").only_in(KnobScenes::Heights),
    knob(File, "level-columns", Choice { options: LINE_LEVELS, default: "" }).at("heights.prepare.level-columns").only_in(KnobScenes::Heights),
    knob(File, "outliers", Choice { options: &["", "void"], default: "" }).at("heights.prepare.outliers").only_in(KnobScenes::Heights),
    knob(File, "scars", Choice { options: &["", "rows", "columns"], default: "" }).at("heights.prepare.scars").only_in(KnobScenes::Heights),
    knob(File, "fill", Choice { options: &["", "harmonic"], default: "" }).at("heights.prepare.fill").only_in(KnobScenes::Heights),
    knob(File, "detrend", Choice { options: &["", "mean", "plane", "curvature", "cubic"], default: "" }).at("heights.prepare.detrend").only_in(KnobScenes::Heights),
    knob(File, "low-pass", Length { example: "200 nm" }).at("heights.prepare.low-pass").only_in(KnobScenes::Heights),
    knob(File, "mirror", Choice { options: &["", "x", "y", "both"], default: "" }).at("heights.prepare.mirror").only_in(KnobScenes::Heights),
    knob(Solver, "solver", Choice { options: &["multilevel", "polonsky-keer", "gfmd"], default: "multilevel" }).at("solver.method"),
    knob(Solver, "masses", Choice { options: &["uniform", "stiffness"], default: "uniform" }).at("solver.masses").only_in(KnobScenes::Gfmd),
    knob(Solver, "dynamics", Choice { options: &["damped", "fire"], default: "damped" }).at("solver.dynamics").only_in(KnobScenes::Gfmd),
    knob(Solver, "damping", Number(NumericKnob::new([0.01, 100.0], 1.0).log10([-1.5, 1.0, 0.05]))).at("solver.damping").only_in(KnobScenes::Damped),
    knob(Solver, "time-step", Number(NumericKnob::new([0.001, 0.999], 0.5).linear([0.05, 0.95, 0.05]))).at("solver.time-step").only_in(KnobScenes::Gfmd),
    knob(Solver, "tolerance", Number(NumericKnob::new([1e-18, 1.0], 1e-8).log10([-12.0, -1.0, 1.0]))).at("stop.tolerance"),
    Knob { group: None, ..knob(Solver, "max-iterations", Number(NumericKnob::new([1.0, 100_000.0], 20_000.0).whole())).at("stop.max-iterations") },
    knob(Recording, "record", Choices {
        options: &["traces", "profile mesh", "fields", "mask", "spectrum", "stress", "fringes", "flow"],
        default: &["traces", "profile mesh", "fields", "mask"],
    }),
];

/// The state of the knobs to start with, without what no knob turns.
pub(super) fn defaults() -> Value {
    let mut state = Value::Null;
    for knob in KNOBS.iter().filter(|knob| knob.scenes.is_held_by_others()) {
        *knob.path.split('.').fold(&mut state, |place, name| &mut place[name]) = knob.default();
    }
    state
}

/// The parts of a state that a surface beside another one has of it: all but those of the surface itself.
pub(super) fn shared_with_beside(parts: Map<String, Value>) -> impl Iterator<Item = (String, Value)> {
    parts.into_iter().filter(|(name, _)| !is_of_surface(name))
}

/// Whether a part of a state describes its surface: a knob in the group of the surface or of the file, or one of [`SURFACE_PARTS`].
fn is_of_surface(name: &str) -> bool {
    let has_knob = |knob: &Knob| knob.path.split('.').next() == Some(name);
    let mut groups = KNOBS.iter().filter(|knob| has_knob(knob)).map(|knob| knob.group);
    SURFACE_PARTS.contains(&name) || groups.any(|group| matches!(group, Some(Surface | File)))
}

/// Refuses a state of the knobs with a number that is out of its range.
///
/// # Errors
/// A sentence with the knob as it is written, its value and its range.
pub(crate) fn check(state: &Value) -> Result<(), Refusal> {
    KNOBS.iter().try_for_each(|knob| knob.check(state))
}

/// A number as a user writes it: whole ones in all digits.
fn in_words(value: f64) -> String {
    if value.fract() == 0.0 && value.abs() < 1e15 { format!("{value}") } else { number_in_words(value) }
}

/// The schema as a part of the script of the page, with limits that are not those of one knob.
pub fn schema_script() -> String {
    let most = |[line, surface]: [usize; 2]| json!({ "line": line, "side": surface.isqrt() });
    let limits = json!({
        "side": SURFACE_SIDE,
        "program": most(MOST_POINTS_OF_PROGRAM),
        "module": most(MOST_POINTS_OF_MODULE),
        "yielding": most(MOST_POINTS_OF_YIELDING),
        "usualYielding": most(USUAL_POINTS_OF_YIELDING),
        "bumps": MOST_BUMPS,
        "bytes": MOST_HEIGHTS,
        "modulus": MODULUS,
        "cell": CELL,
    });
    format!("const KNOBS = {};\nconst LIMITS = {limits};\n", json!(KNOBS))
}
