//! Factors between results, and where they come from.

use crate::grid::Grid;

/// Relative difference up to which two factors count as equal: the accuracy of a fit to a result of a few digits.
const SAME: f64 = 0.01;
/// Range of `1 - nu^2` for Poisson's ratios from 0.17 to 0.5.
const OF_POISSON: [f64; 2] = [0.75, 0.97];

/// A factor that is missing, and its cause where that is known.
pub(super) struct Factor {
    sentence: String,
    is_known: bool,
}

impl Factor {
    /// The factor by which a modulus is too large, on a solid of some Poisson's ratios, if they are known.
    pub(crate) fn from_modulus(factor: f64, poisson: &[f64]) -> Self {
        let of = |factor: f64| Self::cause_of_modulus(factor, poisson);
        let cause = of(factor).map(|(large, _)| large).or_else(|| of(1.0 / factor).map(|(_, small)| small));
        let is_known = cause.is_some();
        let cause = cause.unwrap_or_else(|| "check modulus, size and their units".into());
        let sentence = format!("the modulus is {}: {cause}", times(factor));
        Self { sentence, is_known }
    }

    /// The cause of a modulus that is too large by this factor, and of one that is too small by it.
    fn cause_of_modulus(factor: f64, poisson: &[f64]) -> Option<(String, String)> {
        if is_same(factor, 2.0) {
            return Some((
                "half of this value is the contact modulus of two equal bodies, 1/E* = 2 (1 - nu^2)/E".into(),
                "the pressures are those of one elastic body, 1/E* = (1 - nu^2)/E, or of a kernel with E* instead of \
                 E*/2"
                    .into(),
            ));
        }
        let is_poisson = |nu: &f64| is_same(factor, 1.0 - nu * nu);
        let is_any = poisson.is_empty() && (OF_POISSON[0]..=OF_POISSON[1]).contains(&factor);
        let nu = poisson.iter().copied().find(is_poisson).or_else(|| is_any.then(|| (1.0 - factor).sqrt()));
        if let Some(nu) = nu {
            return Some((
                format!("by 1 - nu^2 for nu = {nu:.2}, as if Young's modulus E was given instead of E* = E/(1 - nu^2)"),
                format!(
                    "by 1 - nu^2 for nu = {nu:.2}, as if the pressures were computed with E instead of E* = E/(1 - nu^2)"
                ),
            ));
        }
        let unit = of_unit(factor)?;
        Some((unit.clone(), unit))
    }

    /// The factor that pressures on a grid must be multiplied by.
    pub(crate) fn from_pressure(factor: f64, grid: &Grid) -> Self {
        let [dy, dx] = grid.spacing();
        let forces = [
            (dx, "forces per unit width: divide them by the spacing dx"),
            (dx * dy, "forces at the nodes: divide them by dx dy"),
        ];
        let force = forces.into_iter().skip(usize::from(!grid.is_line())).find(|(cell, _)| is_same(factor * cell, 1.0));
        if let Some((cell, words)) = force {
            return Self { sentence: format!("the pressures are {words} = {cell:.4e}"), is_known: true };
        }
        let unit = of_unit(factor).or_else(|| of_unit(1.0 / factor));
        let is_known = unit.is_some();
        let cause = unit.unwrap_or_else(|| "check their unit, the modulus and the size".into());
        Self { sentence: format!("the pressures are {}: {cause}", times(1.0 / factor)), is_known }
    }

    /// Whether the factor has a known cause.
    pub(crate) fn is_known(&self) -> bool {
        self.is_known
    }

    /// What is off by how much, and why if that is known.
    pub(crate) fn sentence(self) -> String {
        self.sentence
    }
}

/// A power of a thousand, as between units.
fn of_unit(factor: f64) -> Option<String> {
    let power = 3.0 * (factor.log10() / 3.0).round();
    let is_unit = power > 0.0 && is_same(factor, 10f64.powf(power));
    is_unit.then(|| "check the units".into())
}

fn is_same(one: f64, other: f64) -> bool {
    (one / other - 1.0).abs() < SAME
}

/// How much too large or small something is.
fn times(factor: f64) -> String {
    let (factor, word) = if factor >= 1.0 { (factor, "large") } else { (1.0 / factor, "small") };
    let factor = if factor < 1e4 { format!("{factor:.4}") } else { format!("{factor:.3e}") };
    format!("{factor} times too {word}")
}
