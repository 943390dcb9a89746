//! Loads from a single node in contact to beyond full contact.

use super::{Size, pressed, rough};
use crate::cli::stability::case::Case;
use asperity::Problem;
use asperity::surface::Indenter;
use asperity::theory::{Westergaard, crossed_full_pressure};

const AMPLITUDE: f64 = 0.01;
/// Shares of the pressure of full contact.
const SHARES: [f64; 4] = [0.999, 0.9999, 1.0, 1.001];

pub fn cases(size: Size) -> Vec<Case> {
    let mut cases = decades(size);
    cases.extend(SHARES.map(|share| sine(size, share)));
    cases.extend(SHARES.map(|share| crossed_sine(size, share)));
    cases
}

/// Reduced pressures from 1e-12 to 10 on a rough line and a rough surface.
fn decades(size: Size) -> Vec<Case> {
    let line =
        |decade| Case::new(format!("load-line-1e{decade}"), move || pressed(rough(size.line()?)?, 10f64.powi(decade)));
    let surface = |decade| {
        Case::new(format!("load-surface-1e{decade}"), move || pressed(rough(size.surface()?)?, 10f64.powi(decade)))
    };
    (-12..=1).map(line).chain((-12..=1).map(surface)).collect()
}

/// A sine on a line around full contact.
fn sine(size: Size, share: f64) -> Case {
    Case::new(format!("sine-{share}-of-full"), move || {
        let full = Westergaard { amplitude: AMPLITUDE, period: 1.0, contact_modulus: 1.0 }.full_pressure();
        let surface = Indenter::Sine { amplitude: AMPLITUDE }.surface(size.line()?)?;
        Ok(Problem::new(surface, 1.0, share * full)?)
    })
}

/// A crossed sine on a surface around full contact.
fn crossed_sine(size: Size, share: f64) -> Case {
    Case::new(format!("crossed-sine-{share}-of-full"), move || {
        let full = crossed_full_pressure(AMPLITUDE, [1.0, 1.0], 1.0);
        let surface = Indenter::CrossedSine { amplitude: AMPLITUDE }.surface(size.surface()?)?;
        Ok(Problem::new(surface, 1.0, share * full)?)
    })
}
