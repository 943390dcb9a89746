//! The schema of the numeric knobs: names, ranges, sliders and units, written once for page, lessons, links and documents.

use super::refusal::Refusal;
use crate::quantity::number_in_words;
use serde::Serialize;
use serde_json::Value;

/// How the value of a slider follows from its position.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SliderScale {
    /// The value is the position.
    Linear,
    /// The position is the logarithm of the value to the base of ten.
    Log10,
    /// The position is the logarithm of the value to the base of two; values are whole.
    Log2,
}

/// One knob that takes a number.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct NumericKnob {
    /// The name of its control on the page.
    pub id: &'static str,
    /// Where it stands in [`Knobs`](super::Knobs), from the outside in.
    pub path: &'static [&'static str],
    /// The least and the largest value.
    pub range: [f64; 2],
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
    const fn new(id: &'static str, path: &'static [&'static str], range: [f64; 2], slider: [f64; 3]) -> Self {
        Self { id, path, range, whole: false, slider: Some(slider), scale: SliderScale::Linear, unit: None }
    }

    const fn log(self) -> Self {
        Self { scale: SliderScale::Log10, ..self }
    }

    const fn log2(self) -> Self {
        Self { scale: SliderScale::Log2, whole: true, ..self }
    }

    const fn waves(self) -> Self {
        Self { unit: Some("waves"), ..self }
    }

    /// The value in a state of the knobs; none in a state that has no such knob.
    fn value(&self, knobs: &Value) -> Option<f64> {
        self.path.iter().try_fold(knobs, |place, name| place.get(name))?.as_f64()
    }

    /// Refuses a value outside the range.
    fn check(&self, value: f64) -> Result<(), Refusal> {
        let [least, most] = self.range;
        if (least..=most).contains(&value) {
            return Ok(());
        }
        let kind = if self.whole { "a whole number" } else { "a number" };
        let [value, least, most] = [value, least, most].map(in_words);
        Err(Refusal(format!("`{}` cannot be {value}: give {kind} from {least} to {most}", self.path.join("."))))
    }
}

/// All knobs that take a number, in the order of the page.
pub const NUMERIC_KNOBS: [NumericKnob; 14] = [
    NumericKnob::new("load", &["load"], [1e-5, 1e3], [-4.0, 1.5, 0.02]).log(),
    NumericKnob::new("hardness", &["hardness"], [0.0, 1.0], [0.0, 0.002, 0.00002]),
    NumericKnob::new("layer", &["layer"], [0.0, 10.0], [0.0, 0.5, 0.005]),
    NumericKnob::new("exponent", &["exponent"], [1.0, 12.0], [1.0, 12.0, 0.5]),
    NumericKnob::new("roughness", &["roughness"], [0.0, 1.0], [0.0, 0.01, 0.0002]),
    NumericKnob::new("hurst", &["hurst"], [0.01, 1.0], [0.1, 1.0, 0.05]),
    NumericKnob::new("rolloff", &["rolloff"], [1.0, 131_072.0], [1.0, 32.0, 1.0]).waves(),
    NumericKnob::new("cutoff", &["cutoff"], [2.0, 131_072.0], [3.0, 13.0, 0.5]).log2().waves(),
    NumericKnob {
        whole: true,
        slider: None,
        ..NumericKnob::new("seed", &["seed"], [0.0, 4_294_967_295.0], [0.0, 0.0, 0.0])
    },
    NumericKnob::new("points", &["points"], [4.0, 262_144.0], [5.0, 18.0, 1.0]).log2(),
    NumericKnob::new("damping", &["solver", "damping"], [0.01, 100.0], [-1.5, 1.0, 0.05]).log(),
    NumericKnob::new("time-step", &["solver", "time-step"], [0.001, 0.999], [0.05, 0.95, 0.05]),
    NumericKnob::new("tolerance", &["stop", "tolerance"], [1e-18, 1.0], [-12.0, -1.0, 1.0]).log(),
    NumericKnob {
        slider: None,
        whole: true,
        ..NumericKnob::new("steps", &["stop", "max-iterations"], [1.0, 100_000.0], [0.0, 0.0, 0.0])
    },
];

/// Refuses a state of the knobs with a number that is out of its range.
///
/// # Errors
/// A sentence with the knob as it is written, its value and its range.
pub fn check(knobs: &Value) -> Result<(), Refusal> {
    NUMERIC_KNOBS.iter().filter_map(|knob| Some((knob, knob.value(knobs)?))).try_for_each(|(knob, it)| knob.check(it))
}

/// A number as people write it: whole ones in all digits.
fn in_words(value: f64) -> String {
    if value.fract() == 0.0 && value.abs() < 1e15 { format!("{value}") } else { number_in_words(value) }
}

/// The schema as a script of the page.
pub fn script() -> String {
    let json = serde_json::to_string(&NUMERIC_KNOBS).expect("names and finite numbers");
    format!("const NUMERIC_KNOBS = {json};\n")
}
