//! The command line that stands for a state of the controls.

use super::parameters::{CELL, Geometry, MODULUS, Method, Parameters};
use crate::surface::{Indenter, Spectrum};
use serde::Serialize;

impl Parameters {
    /// The command that repeats the solve: the same numbers, to the last digit.
    pub fn command(&self) -> String {
        let mut words = vec!["asperity solve".to_owned()];
        let mut say = |name: &str, value: String| words.push(format!("--{name} {value}"));
        for (name, value) in self.indenter().iter().flat_map(arguments) {
            say(name, value);
        }
        if self.is_rough() {
            let Spectrum { hurst, rolloff_wavelength, short_cutoff, rms_gradient } = self.spectrum();
            say("hurst", hurst.to_string());
            say("rolloff", format!("{rolloff_wavelength:e}"));
            say("short-cutoff", format!("{short_cutoff:e}"));
            say("rms-gradient", format!("{rms_gradient:e}"));
            say("seed", self.seed.to_string());
        }
        let n = self.points;
        say("points", if self.geometry == Geometry::Line { n.to_string() } else { format!("{n},{n}") });
        say("size", format!("{CELL:e}"));
        say("modulus", format!("{MODULUS:e}"));
        say("reduced-pressure", format!("{:e}", self.load));
        say("solver", word(&self.solver));
        if self.solver == Method::Gfmd {
            say("masses", word(&self.masses));
            say("dynamics", word(&self.dynamics));
            say("time-step", self.time_step.to_string());
            say("damping", self.damping.to_string());
        }
        say("tolerance", format!("{:e}", self.tolerance));
        say("max-iterations", self.max_iterations.to_string());
        words.join(" ")
    }
}

/// An indenter as it is given on the command line.
fn arguments(indenter: &Indenter) -> Vec<(&'static str, String)> {
    let number = |value: f64| format!("{value:e}");
    match *indenter {
        Indenter::Cylinder { radius } => vec![("indenter", "cylinder".into()), ("radius", number(radius))],
        Indenter::Sphere { radius } => vec![("indenter", "sphere".into()), ("radius", number(radius))],
        Indenter::Sine { amplitude } => vec![("indenter", "sine".into()), ("amplitude", number(amplitude))],
        Indenter::CrossedSine { amplitude } => {
            vec![("indenter", "crossed-sine".into()), ("amplitude", number(amplitude))]
        }
        Indenter::PowerLaw { coefficient, exponent } => {
            vec![("indenter", "power-law".into()), ("coefficient", number(coefficient)), ("exponent", number(exponent))]
        }
        Indenter::Wedge { slope } => vec![("indenter", "wedge".into()), ("slope", number(slope))],
        Indenter::Cone { slope } => vec![("indenter", "cone".into()), ("slope", number(slope))],
        Indenter::Punch { half_width, depth } => {
            vec![("indenter", "punch".into()), ("half-width", number(half_width)), ("depth", number(depth))]
        }
    }
}

/// The word that stands for a choice, here and on the command line.
fn word(choice: &impl Serialize) -> String {
    match serde_json::to_value(choice) {
        Ok(serde_json::Value::String(word)) => word,
        _ => String::new(),
    }
}
