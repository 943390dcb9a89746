//! The knobs of the page, and the setup that they describe.

mod history;
mod surface;

use super::height_knobs::HeightKnobs;
use super::refusal::{Refusal, RefusalRule};
use super::scale::{MODULUS, RETARDATION_TIME};
use super::schema::{self, MOST_BUMPS, MOST_POINTS, SURFACE_SIDE, USUAL_HARDENING, USUAL_RANGE};
use super::source::{SceneFile, SurfaceSource};
use crate::contact::{Friction, Law, Load, Stop};
use crate::elastic::Base;
use crate::grid::Grid;
use crate::setup::{
    Body, LayerModulus, Method, Part, Record, Setup, SlidingMotion, Solid, Theme, Viscoelastic, YieldLaw,
};
use crate::surface::RolloffForm;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// Kurtosis of Gaussian heights.
const GAUSSIAN_KURTOSIS: f64 = 3.0;
/// Poisson's ratio of a layer, and of a solid that yields below its surface.
const POISSON: f64 = 0.3;

/// The state of the knobs. Lengths are given in waves per cell, pressures as `p*`.
///
/// Ranges, defaults and groups of the knobs stand in [`schema::KNOBS`]; here are the types of their values. Typed code makes the setup of them. A
/// column of the schema with the key of a setup that each knob sets, and in which scale, would need more code than that: only half of the
/// knobs set one key each, and most of these do so under a condition on other knobs. The others choose an enum (`body` with
/// `domain`, `rolloff-form`), share a list (`load` with `pull`, the lengths of `points`), or set several keys at once (`layer`, `creep`, `exponent`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Knobs {
    domain: Domain,
    body: SmoothBody,
    /// Exponent of the power law.
    exponent: f64,
    /// Rms gradient of the roughness; 0 for none.
    roughness: f64,
    hurst: f64,
    /// Waves per cell at the roll-off.
    rolloff: f64,
    /// Waves per cell at the short cut-off.
    cutoff: f64,
    /// What the spectrum does at waves longer than those of the roll-off.
    #[serde(default = "plateau")]
    rolloff_form: RolloffForm,
    /// Peklenik's number of a surface.
    #[serde(default = "one")]
    peklenik: f64,
    /// Angle from the x axis to the lay, in degrees.
    #[serde(default)]
    lay_angle: f64,
    /// Skewness of the roughness; with a kurtosis of 3, 0 stands for Gaussian heights.
    #[serde(default)]
    skewness: f64,
    /// Kurtosis of the roughness.
    #[serde(default = "gaussian_kurtosis")]
    kurtosis: f64,
    seed: u32,
    /// Points of the line, or along each side of the surface.
    points: usize,
    /// Reduced pressure `p* = <p> / (gbar E*)`.
    pub(super) load: f64,
    /// Hardness over the contact modulus; 0 for none.
    #[serde(default)]
    hardness: f64,
    /// Yield stress over the contact modulus, of a solid that yields below its surface; 0 for none.
    #[serde(default)]
    yield_stress: f64,
    /// Hardening modulus of such a solid over the contact modulus.
    #[serde(default = "usual_hardening")]
    hardening: f64,
    /// Whether the load is taken off such a solid again.
    #[serde(default)]
    release: bool,
    /// Thickness of a bonded layer of Poisson's ratio 0.3 on a rigid base, over the cell; 0 for a half-space.
    #[serde(default)]
    layer: f64,
    /// Creep of the solid, a Kelvin term: its compliance after a long time over that at once, minus 1; 0 for an elastic one.
    #[serde(default)]
    creep: f64,
    /// Speed of sliding towards `+x` over a solid that creeps, in lengths of the cell per retardation time; 0 at rest.
    #[serde(default)]
    speed: f64,
    /// How long the load has acted on a solid that creeps, where the surface is at rest, in retardation times.
    #[serde(default)]
    time: f64,
    /// Work of adhesion over the contact modulus and the length of the cell; 0 for none.
    #[serde(default)]
    adhesion: f64,
    /// Range of the attraction, over the length of the cell.
    #[serde(default = "usual_range")]
    pub(super) range: f64,
    /// Reduced pressure that pulls surfaces with adhesion apart after the load; 0 for none.
    #[serde(default)]
    pub(super) pull: f64,
    /// How deep surfaces with adhesion are moved into each other before they are moved apart, over their mean gap at first touch; 0 where loads
    /// move them.
    #[serde(default)]
    depth: f64,
    /// Coulomb's coefficient of friction between surface and solid; 0 for none.
    #[serde(default)]
    friction: f64,
    /// The tangential load over that at which the surface slides: pulled, pushed back and pulled again, or raised while it rolls; 0 for none.
    #[serde(default)]
    sideways: f64,
    /// Whether the surface rolls under the tangential load, instead of being pulled.
    #[serde(default)]
    rolling: bool,
    solver: Method,
    stop: Stop,
    /// Parts of the recording; of profile and mesh the one that the domain has.
    record: Vec<Part>,
    /// Ground of the pictures; dark where the page says nothing.
    #[serde(default)]
    theme: Theme,
    /// Bumps on a line: positions, heights and widths, divided by the length of the cell.
    #[serde(default)]
    bumps: Vec<[f64; 3]>,
    /// How the file of heights is read, if it is the body. Its points and lengths replace those above.
    #[serde(default)]
    pub(super) heights: HeightKnobs,
    /// The hash of the scene, if it is the body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    scene: Option<String>,
    /// The knobs of a second surface, which is shown beside the first under the same mean pressure. Only the knobs of
    /// its surface are used.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    beside: Option<Box<Knobs>>,
}

fn usual_range() -> f64 {
    USUAL_RANGE
}

fn usual_hardening() -> f64 {
    USUAL_HARDENING
}

fn plateau() -> RolloffForm {
    RolloffForm::Plateau
}

fn one() -> f64 {
    1.0
}

fn gaussian_kurtosis() -> f64 {
    GAUSSIAN_KURTOSIS
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Domain {
    Line,
    Surface,
}

/// The smooth body under the roughness.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum SmoothBody {
    /// A cylinder on a line, a sphere on a surface.
    Round,
    /// A sine on a line, crossed sines on a surface.
    Sine,
    /// A power of the distance.
    PowerLaw,
    /// Nothing but the roughness.
    Flat,
    /// The file of heights, and no roughness on it.
    File,
    /// The scene of a setup, with its cell, solid and law.
    Scene,
}

/// A state of the knobs to start from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Start {
    /// A smooth cylinder.
    HertzLine,
    /// A smooth sphere.
    HertzSurface,
    /// A self-affine line.
    RoughLine,
    /// A self-affine surface.
    RoughSurface,
}

impl Start {
    /// The state of the knobs.
    pub fn knobs(self) -> Knobs {
        let mut knobs: Knobs = serde_json::from_value(schema::defaults()).expect("the defaults are in their ranges");
        if matches!(self, Self::HertzLine | Self::HertzSurface) {
            (knobs.body, knobs.roughness) = (SmoothBody::Round, 0.0);
        }
        if matches!(self, Self::HertzSurface | Self::RoughSurface) {
            (knobs.domain, knobs.points, knobs.cutoff) = (Domain::Surface, SURFACE_SIDE, 32.0);
        }
        knobs
    }
}

impl Knobs {
    /// Whether a line is pressed.
    pub(super) fn is_line(&self) -> bool {
        self.domain == Domain::Line
    }

    /// The knobs of a scene, with the solver, the parts of the recording and, if that is a pressure or a force, the load of its setup.
    ///
    /// # Errors
    /// For a scene that cannot be made, and for a setup beyond the limits of the page.
    pub fn from_scene(scene: &SceneFile) -> Result<Self, Refusal> {
        let (setup, start) = (&scene.setup, Start::RoughLine.knobs());
        let problem = setup.problem()?;
        let surface = problem.surface();
        let unit = problem.rms_gradient() * problem.contact_modulus();
        let knobs = Self {
            domain: if surface.grid().is_line() { Domain::Line } else { Domain::Surface },
            body: SmoothBody::Scene,
            scene: Some(scene.mark.clone()),
            load: match setup.load {
                Load::ReducedPressure(load) => load,
                load if load.is_pressure() => problem.expected_mean_pressure() / unit,
                _ => start.load,
            },
            solver: setup.solver,
            stop: setup.stop,
            record: if setup.record.what.is_empty() { start.record } else { setup.record.what.clone() },
            theme: setup.record.theme,
            ..Start::RoughLine.knobs()
        };
        knobs.check()?;
        Ok(knobs)
    }

    /// The knobs that `json` holds.
    ///
    /// # Errors
    /// A sentence on the fault of the text.
    pub fn read(json: &[u8]) -> Result<Self, Refusal> {
        Ok(serde_json::from_slice(json)?)
    }

    /// The setup that the knobs describe without a file of heights. Everything that needs no surface is checked.
    ///
    /// # Errors
    /// A sentence with the value that cannot be and what to do.
    pub fn setup(&self) -> Result<Setup, Refusal> {
        self.setup_with(None)
    }

    /// The state with some of its parts replaced, such as knobs by their names; the rest stays.
    ///
    /// # Errors
    /// A sentence on a part that no state has, or on a value that it cannot have.
    pub(super) fn with(&self, parts: impl IntoIterator<Item = (String, Value)>) -> Result<Self, Refusal> {
        let mut state = self.parts()?;
        state.extend(parts);
        Ok(serde_json::from_value(state.into())?)
    }

    /// The parts of the state, as they stand in JSON.
    fn parts(&self) -> Result<Map<String, Value>, Refusal> {
        Ok(serde_json::to_value(self).and_then(serde_json::from_value)?)
    }

    /// The same state, recorded on another ground.
    pub fn with_theme(self, theme: Theme) -> Self {
        Self { theme, ..self }
    }

    /// The solver, and when it stops.
    pub(super) fn method(&self) -> (Method, Stop) {
        (self.solver, self.stop)
    }

    /// Whether the scene is the body.
    pub(super) fn takes_scene(&self) -> bool {
        self.body == SmoothBody::Scene
    }

    /// Whether the file of heights is the body.
    pub(super) fn takes_file(&self) -> bool {
        self.body == SmoothBody::File
    }

    /// The setup that the knobs describe, with heights or a scene from outside.
    ///
    /// # Errors
    /// The errors of [`Knobs::setup`].
    pub fn setup_with(&self, source: Option<&SurfaceSource>) -> Result<Setup, Refusal> {
        self.check()?;
        let pressed = self.pressed(source)?;
        let grid = pressed.surface.grid(&pressed.grid)?;
        let load = if self.is_at_gaps() { pressed.load } else { Load::ReducedPressure(self.load) };
        let feels = pressed.feels();
        let setup = Setup {
            load,
            solver: self.solver,
            stop: self.stop,
            record: Record {
                what: self.recorded_parts(&grid, feels.attraction || feels.eigenstrain),
                theme: self.theme,
                ..Record::default()
            },
            ..pressed
        };
        setup.check()?;
        let drive = setup.history_drive()?;
        let is_several_speeds = setup.sliding.is_some() && drive.is_some();
        let is_path_of_scene = self.takes_scene() && setup.path.is_some();
        if is_several_speeds || is_path_of_scene && drive.is_some_and(|drive| drive.feels.attraction) {
            return Err(RefusalRule::SceneNotShown.into());
        }
        Ok(setup)
    }

    /// Surface, cell, solid and law: those of the scene, or those that the knobs make.
    fn pressed(&self, source: Option<&SurfaceSource>) -> Result<Setup, Refusal> {
        if self.body == SmoothBody::Scene {
            return match source {
                Some(SurfaceSource::Scene(scene)) if self.scene.as_ref() == Some(&scene.mark) => {
                    Ok(scene.setup.clone())
                }
                _ => Err(RefusalRule::NoScene.into()),
            };
        }
        let (surface, cell) = self.surface(source)?;
        let grid = surface.grid(&cell)?;
        self.check_motion(&grid)?;
        let load = Load::ReducedPressure(self.load);
        let has_memory = self.slides() || self.creeps_in_time();
        let setup = Setup {
            viscoelastic: has_memory
                .then(|| Viscoelastic { creep: vec![self.creep, RETARDATION_TIME], ..Viscoelastic::default() }),
            sliding: self
                .slides()
                .then(|| SlidingMotion { speed: vec![self.speed * grid.size()[1] / RETARDATION_TIME] }),
            adhesion: self.adheres().then(|| self.attraction(grid.size()[1])),
            friction: self.rubs().then_some(Friction { coefficient: self.friction, tangential: 0.0 }),
            rolling: self.rolling_motion(),
            path: self.path(),
            solid: Some(self.solid(grid.longest_wavelength())),
            law: if self.hardness > 0.0 { Law::Hardness(self.hardness * MODULUS) } else { Law::HardWall },
            ..Setup::new(surface, cell, load)
        };
        if self.is_at_gaps() { self.along_gaps(setup) } else { Ok(setup) }
    }

    /// The setup of the surface beside, if there is one, under the load of the knobs: a solve presses it as hard as the first one.
    ///
    /// # Errors
    /// The errors of [`Knobs::setup`], for a line beside a surface, and for a surface that has another one beside it.
    pub fn beside_with(&self, source: Option<&SurfaceSource>) -> Result<Option<Setup>, Refusal> {
        let Some(beside) = &self.beside else { return Ok(None) };
        if beside.beside.is_some() {
            return Err(RefusalRule::BesideTwice.into());
        }
        let shared = schema::shared_with_beside(self.parts()?);
        let other = beside.with(shared)?;
        let (first, second) = (self.setup_with(source)?, other.setup_with(source)?);
        let is_line = |setup: &Setup| Ok::<_, Refusal>(setup.surface.grid(&setup.grid)?.is_line());
        if is_line(&first)? != is_line(&second)? {
            return Err(RefusalRule::LineBesideSurface.into());
        }
        Ok(Some(second))
    }

    /// A half-space, which may yield below its surface, or a bonded layer below a cell of some length.
    fn solid(&self, length: f64) -> Solid {
        let elastic = self.elastic(length);
        if !self.yields_below() {
            return elastic;
        }
        let [yield_stress, hardening_modulus] = [self.yield_stress, self.hardening].map(|it| Some(it * MODULUS));
        Solid::Yielding(elastic.into(), YieldLaw { yield_stress, hardening_modulus, ..YieldLaw::default() })
    }

    /// The solid without what yields. Flow depends on both elastic constants.
    fn elastic(&self, length: f64) -> Solid {
        match (self.layer > 0.0, self.yields_below()) {
            (true, _) => {
                let (modulus, thickness) = (LayerModulus::Contact(MODULUS), self.layer * length);
                Solid::Layer { modulus, poisson: POISSON, thickness, base: Base::Bonded }
            }
            (false, true) => Solid::Bodies(Body { young: MODULUS * (1.0 - POISSON * POISSON), poisson: POISSON }, None),
            (false, false) => Solid::ContactModulus(MODULUS),
        }
    }

    /// Checks the limits of the page.
    fn check(&self) -> Result<(), Refusal> {
        schema::check(&self.parts()?.into())?;
        if matches!(self.body, SmoothBody::File | SmoothBody::Scene) {
            return Ok(());
        }
        let Self { points, rolloff, cutoff, .. } = *self;
        let most = MOST_POINTS[1].isqrt();
        let is_rough = self.roughness > 0.0;
        Err(if self.domain == Domain::Surface && points > most {
            RefusalRule::SurfacePoints.with([("value", points.to_string()), ("most", most.to_string())])
        } else if self.bumps.len() > MOST_BUMPS {
            RefusalRule::Bumps.with([("bumps", self.bumps.len().to_string()), ("most", MOST_BUMPS.to_string())])
        } else if self.body == SmoothBody::Flat && !is_rough {
            RefusalRule::SmoothFlat.into()
        } else if is_rough && cutoff <= rolloff && self.rolloff_form != RolloffForm::None {
            RefusalRule::CutoffOfRolloff.with([("value", cutoff.to_string()), ("rolloff", rolloff.to_string())])
        } else if is_rough && 2.0 * cutoff > points as f64 {
            RefusalRule::CutoffOfPoints.with([("value", cutoff.to_string()), ("points", points.to_string())])
        } else {
            return Ok(());
        })
    }

    /// The parts of the recording that a line or a surface has; without any the traces, since an empty list means the
    /// usual parts. The stress is that of the pressure alone, which with adhesion, or where the solid yields below its surface, is not all that
    /// the solid feels.
    fn recorded_parts(&self, grid: &Grid, feels_more: bool) -> Vec<Part> {
        let is_there = |part: &Part| part.is_on(grid) && !(feels_more && part.is_stress());
        let parts: Vec<Part> = self.record.iter().copied().filter(is_there).collect();
        if parts.is_empty() { vec![Part::Traces] } else { parts }
    }
}
