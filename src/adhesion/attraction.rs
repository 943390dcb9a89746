//! Attractions between two surfaces.

use crate::error::AdhesionError;
use serde::{Deserialize, Serialize};
use std::sync::Arc;
use strum::{EnumIter, EnumMessage, IntoStaticStr};

/// Changes over the range below which an exponential is computed by its series.
const SERIES: f64 = 1e-3;

/// The attraction between two surfaces at a gap `g >= 0`, above a hard wall at zero.
///
/// `V(g) <= 0` is its energy per area, and `sigma(g) = V'(g) >= 0` the traction that pulls the surfaces together. The work of adhesion is
/// `w = -V(0)`, and the strength `sigma_0 = sigma(0)`. All forms have the range `rho = w/sigma_0`, so that forms of the same work and range
/// have the same strength.
///
/// | form        | `sigma(g)`                        | remark                                                                 |
/// |-------------|-----------------------------------|------------------------------------------------------------------------|
/// | exponential | `sigma_0 exp(-g/rho)`             | smooth, without a cut-off                                              |
/// | cubic       | `sigma_0 (1 - g/(3 rho))^2`       | zero beyond `3 rho`; `V` is a cubic                                    |
/// | Dugdale     | `sigma_0`                         | zero beyond `rho`; the form of Maugis' solution                        |
/// | table       | linear between given points       | zero beyond the last one; must not increase with the gap               |
///
/// All of them are concave in the gap, since `sigma` does not increase.
///
/// # Source
/// Dugdale: Maugis, J. Colloid Interface Sci. 150, 243 (1992). The others are common in computations with walls.
///
/// ```
/// use asperity::adhesion::{Attraction, AttractionForm};
/// let attraction = Attraction::new(AttractionForm::Cubic, 0.05, 1e-9)?;
/// // the traction is the derivative of the energy
/// let slope = (attraction.energy(1.001e-9) - attraction.energy(0.999e-9)) / 0.002e-9;
/// assert!((slope / attraction.traction(1e-9) - 1.0).abs() < 1e-5);
/// assert_eq!(attraction.energy(0.0), -0.05);
/// # Ok::<(), asperity::error::AdhesionError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Attraction {
    shape: AttractionShape,
    work: f64,
    range: f64,
}

/// The form of an [`Attraction`] that is no table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, EnumIter, EnumMessage, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum AttractionForm {
    /// An exponential: smooth, without a cut-off.
    #[default]
    Exponential,
    /// A cubic energy, with a cut-off at three ranges.
    Cubic,
    /// A constant traction, with a cut-off at the range.
    Dugdale,
}

/// What an attraction is computed from.
#[derive(Debug, Clone, PartialEq)]
enum AttractionShape {
    Form(AttractionForm),
    Table(Arc<TractionTable>),
}

/// Tractions at some gaps, linear between them.
#[derive(Debug, Clone, PartialEq)]
struct TractionTable {
    gaps: Vec<f64>,
    tractions: Vec<f64>,
    /// The energy at each gap.
    energies: Vec<f64>,
}

impl Attraction {
    /// An attraction of a work of adhesion, an energy per area, and a range, a length.
    ///
    /// # Errors
    /// [`AdhesionError::NotPositive`] for a number that is not positive and finite.
    pub fn new(form: AttractionForm, work: f64, range: f64) -> Result<Self, AdhesionError> {
        Self::of_shape(AttractionShape::Form(form), work, range)
    }

    fn of_shape(shape: AttractionShape, work: f64, range: f64) -> Result<Self, AdhesionError> {
        for (name, value) in [("work of adhesion", work), ("range of the attraction", range)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(AdhesionError::NotPositive { name, value });
            }
        }
        let strength = work / range;
        if !strength.is_normal() {
            return Err(AdhesionError::NotPositive { name: "work of adhesion over its range", value: strength });
        }
        Ok(Self { shape, work, range })
    }

    /// The attraction whose tractions at some gaps are given, and linear between them. The first gap is zero.
    ///
    /// # Errors
    /// [`AdhesionError::Table`] for fewer than two points, gaps that do not increase from zero, and tractions that are negative, not finite
    /// or increase with the gap.
    ///
    /// ```
    /// use asperity::adhesion::Attraction;
    /// let attraction = Attraction::from_table(vec![0.0, 1e-9, 3e-9], vec![50e6, 20e6, 0.0])?;
    /// assert!((attraction.work() - 0.055).abs() < 1e-15 && (attraction.range() - 1.1e-9).abs() < 1e-22);
    /// # Ok::<(), asperity::error::AdhesionError>(())
    /// ```
    pub fn from_table(gaps: Vec<f64>, tractions: Vec<f64>) -> Result<Self, AdhesionError> {
        let refuse = |point: Option<usize>, reason: String| Err(AdhesionError::Table { point, reason });
        if gaps.len() < 2 || gaps.len() != tractions.len() {
            let [gaps, tractions] = [gaps.len(), tractions.len()];
            return refuse(
                None,
                format!("it has {gaps} gaps and {tractions} tractions, but needs at least two of each"),
            );
        }
        if gaps[0] != 0.0 {
            return refuse(Some(0), format!("its first gap is {:?}, but must be 0", gaps[0]));
        }
        for (i, pair) in gaps.windows(2).enumerate() {
            if !(pair[1] > pair[0] && pair[1].is_finite()) {
                return refuse(
                    Some(i + 1),
                    format!("the gap {:?} follows {:?}, but gaps must increase", pair[1], pair[0]),
                );
            }
        }
        if let Some(i) = tractions.iter().position(|it| !(it.is_finite() && *it >= 0.0)) {
            let traction = tractions[i];
            return refuse(Some(i), format!("it has the traction {traction:?}, but tractions must not be negative"));
        }
        for (i, pair) in tractions.windows(2).enumerate() {
            if pair[1] > pair[0] {
                return refuse(
                    Some(i + 1),
                    format!("the traction {:?} follows {:?}, but tractions must not increase", pair[1], pair[0]),
                );
            }
        }
        let mut energies = vec![0.0; gaps.len()];
        for i in (0..gaps.len() - 1).rev() {
            energies[i] = energies[i + 1] - 0.5 * (tractions[i] + tractions[i + 1]) * (gaps[i + 1] - gaps[i]);
        }
        let (work, strength) = (-energies[0], tractions[0]);
        let table = TractionTable { gaps, tractions, energies };
        Self::of_shape(AttractionShape::Table(Arc::new(table)), work, work / strength)
    }

    /// Work of adhesion `w`, an energy per area.
    pub fn work(&self) -> f64 {
        self.work
    }

    /// Range `rho = w/sigma_0`, a length.
    pub fn range(&self) -> f64 {
        self.range
    }

    /// Strength `sigma_0`, the traction at zero gap, a pressure.
    pub fn strength(&self) -> f64 {
        self.work / self.range
    }

    /// The gap from which on there is no attraction, a length; infinite for the exponential form.
    pub fn cutoff(&self) -> f64 {
        match &self.shape {
            AttractionShape::Form(AttractionForm::Exponential) => f64::INFINITY,
            AttractionShape::Form(AttractionForm::Cubic) => 3.0 * self.range,
            AttractionShape::Form(AttractionForm::Dugdale) => self.range,
            AttractionShape::Table(table) => *table.gaps.last().unwrap_or(&0.0),
        }
    }

    /// Energy `V(g)`, an energy per area, at a gap that is not negative.
    pub fn energy(&self, gap: f64) -> f64 {
        if gap >= self.cutoff() {
            return 0.0;
        }
        match &self.shape {
            AttractionShape::Form(AttractionForm::Exponential) => -self.work * (-gap / self.range).exp(),
            AttractionShape::Form(AttractionForm::Cubic) => -self.work * (1.0 - gap / (3.0 * self.range)).powi(3),
            AttractionShape::Form(AttractionForm::Dugdale) => self.strength() * gap - self.work,
            AttractionShape::Table(table) => {
                let (i, along, slope) = table.place(gap);
                table.energies[i] + along * (table.tractions[i] + 0.5 * slope * along)
            }
        }
    }

    /// Traction `sigma(g) = V'(g)`, a pressure.
    pub fn traction(&self, gap: f64) -> f64 {
        if gap >= self.cutoff() {
            return 0.0;
        }
        match &self.shape {
            AttractionShape::Form(AttractionForm::Exponential) => self.strength() * (-gap / self.range).exp(),
            AttractionShape::Form(AttractionForm::Cubic) => self.strength() * (1.0 - gap / (3.0 * self.range)).powi(2),
            AttractionShape::Form(AttractionForm::Dugdale) => self.strength(),
            AttractionShape::Table(table) => {
                let (i, along, slope) = table.place(gap);
                table.tractions[i] + slope * along
            }
        }
    }

    /// Slope `sigma'(g) = V''(g) <= 0`, a pressure per length.
    pub fn slope(&self, gap: f64) -> f64 {
        if gap >= self.cutoff() {
            return 0.0;
        }
        match &self.shape {
            AttractionShape::Form(AttractionForm::Exponential) => {
                -self.strength() / self.range * (-gap / self.range).exp()
            }
            AttractionShape::Form(AttractionForm::Cubic) => {
                -2.0 / 3.0 * self.strength() / self.range * (1.0 - gap / (3.0 * self.range))
            }
            AttractionShape::Form(AttractionForm::Dugdale) => 0.0,
            AttractionShape::Table(table) => table.place(gap).2,
        }
    }

    /// What a change of the gap adds to the energy beyond the traction: `V(g + dg) - V(g) - sigma(g) dg <= 0`, without the loss of digits of a
    /// difference where the change is small.
    pub fn excess(&self, gap: f64, by: f64) -> f64 {
        let is_within = gap.max(gap + by) < self.cutoff();
        match &self.shape {
            AttractionShape::Form(AttractionForm::Exponential) => {
                let x = by / self.range;
                let rest =
                    if x.abs() < SERIES { x * x * (0.5 - x * (1.0 / 6.0 - x / 24.0)) } else { (-x).exp_m1() + x };
                self.energy(gap) * rest
            }
            AttractionShape::Form(AttractionForm::Cubic) if is_within => {
                let [left, x] = [1.0 - gap / (3.0 * self.range), by / (3.0 * self.range)];
                -self.work * x * x * (3.0 * left - x)
            }
            AttractionShape::Form(AttractionForm::Dugdale) if is_within => 0.0,
            AttractionShape::Table(table) if is_within && table.place(gap).0 == table.place(gap + by).0 => {
                0.5 * table.place(gap).2 * by * by
            }
            _ => self.energy(gap + by) - self.energy(gap) - self.traction(gap) * by,
        }
    }

    /// The largest `-V''(g)`, a pressure per length; infinite for the Dugdale form, whose traction jumps.
    pub fn steepest(&self) -> f64 {
        match &self.shape {
            AttractionShape::Form(AttractionForm::Dugdale) => f64::INFINITY,
            AttractionShape::Table(table) if table.tractions.last().is_some_and(|last| *last > 0.0) => f64::INFINITY,
            AttractionShape::Table(table) => table.gaps.iter().map(|&gap| -self.slope(gap)).fold(0.0, f64::max),
            _ => -self.slope(0.0),
        }
    }
}

impl TractionTable {
    /// The interval of a gap below the last one, how far the gap is along it, and the slope of the traction there.
    fn place(&self, gap: f64) -> (usize, f64, f64) {
        let i = self.gaps.partition_point(|&at| at <= gap).clamp(1, self.gaps.len() - 1) - 1;
        let slope = (self.tractions[i + 1] - self.tractions[i]) / (self.gaps[i + 1] - self.gaps[i]);
        (i, gap - self.gaps[i], slope)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> Vec<Attraction> {
        let table = || Attraction::from_table(vec![0.0, 0.5, 1.0, 2.0], vec![3.0, 2.5, 1.0, 0.0]).unwrap();
        let forms = [AttractionForm::Exponential, AttractionForm::Cubic, AttractionForm::Dugdale];
        forms.into_iter().map(|form| Attraction::new(form, 2.0, 0.7).unwrap()).chain([table()]).collect()
    }

    #[test]
    fn energy_traction_and_slope_belong_together() {
        for attraction in all() {
            let step = 1e-6;
            for gap in [0.0, 0.13, 0.61, 0.83, 1.4, 1.99, 2.05, 5.0] {
                for by in [step, 0.01, 0.5, -0.5 * gap] {
                    let excess = attraction.excess(gap, by);
                    let direct = attraction.energy(gap + by) - attraction.energy(gap) - attraction.traction(gap) * by;
                    assert!((excess - direct).abs() < 1e-14, "{attraction:?} at {gap}: {excess:e} {direct:e}");
                }
                let change = attraction.energy(gap + step) - attraction.energy(gap);
                let mean = 0.5 * (attraction.traction(gap) + attraction.traction(gap + step));
                assert!((change / step - mean).abs() < 1e-8, "{attraction:?} at {gap}");
                let slope = (attraction.traction(gap + step) - attraction.traction(gap)) / step;
                assert!((slope - attraction.slope(gap)).abs() < 1e-4, "{attraction:?} at {gap}");
                assert!(attraction.slope(gap) <= 0.0 && -attraction.slope(gap) <= attraction.steepest());
            }
            assert!((attraction.energy(0.0) + attraction.work()).abs() < 1e-14);
            assert!((attraction.traction(0.0) - attraction.strength()).abs() < 1e-14);
        }
    }

    #[test]
    fn tables_that_are_no_attraction_are_refused() {
        for (gaps, tractions) in [
            (vec![0.0], vec![1.0]),
            (vec![0.1, 1.0], vec![1.0, 0.0]),
            (vec![0.0, 0.0], vec![1.0, 0.0]),
            (vec![0.0, 1.0], vec![1.0, 2.0]),
            (vec![0.0, 1.0], vec![1.0, -1.0]),
            (vec![0.0, f64::NAN], vec![1.0, 0.0]),
        ] {
            assert!(matches!(Attraction::from_table(gaps, tractions), Err(AdhesionError::Table { .. })));
        }
        assert!(Attraction::from_table(vec![0.0, 1.0], vec![0.0, 0.0]).is_err());
    }
}
