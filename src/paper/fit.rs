//! Curves of relative area against reduced pressure, fitted by least squares.

use crate::theory::persson::CorrectedArea;
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::storage::Owned;
use nalgebra::{Dyn, Matrix, OMatrix, U2, VecStorage, Vector2};
use std::f64::consts::{FRAC_2_SQRT_PI, SQRT_2};

/// Where the search for `b1` and `b2` begins: between lines and Persson's theory, fading over `p* = 1`.
const START: [f64; 2] = [0.7, 1.0];

/// The weights of points in a fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Weights {
    /// All the same: squares of `a_rel`, in which the heaviest loads count most.
    Equal,
    /// Squares of `a_rel` over its measured value: all loads count alike.
    Relative,
}

impl Weights {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Equal, Self::Relative];

    /// The factor on the residual of a point of this area.
    fn factor(self, relative_area: f64) -> f64 {
        match self {
            Self::Equal => 1.0,
            Self::Relative => 1.0 / relative_area,
        }
    }
}

/// The corrected form of Persson's theory (Eq. 11), fitted to points `(p*, a_rel)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// The curve, with `b1` and `b2`.
    pub area: CorrectedArea,
    /// Root mean square of the relative residuals.
    pub residual: f64,
}

impl Fit {
    /// Finds `b1` and `b2` that make the weighted sum of `(a_rel - erf(sqrt2 p*/Psi))^2` least: by the method of Levenberg and
    /// Marquardt (MINPACK's, with the exact Jacobian). `None` if the search fails, and for points at
    /// less than two loads.
    ///
    /// At small loads only `b1` matters: `b2` needs points at which the area bends, `p*` of some 0.1 and more.
    ///
    /// # Source
    /// Eq. 11 of the paper, and what it says around Fig. 3.
    ///
    /// ```
    /// use asperity::paper::{Fit, Weights};
    /// use asperity::theory::persson::CorrectedArea;
    /// let lines = CorrectedArea { b1: 0.6, b2: 2.0 };
    /// let points: Vec<_> = (1..20).map(|i| 0.05 * f64::from(i)).map(|p| (p, lines.relative_area(p))).collect();
    /// let fit = Fit::new(&points, Weights::Equal).unwrap();
    /// assert!((fit.area.b1 - 0.6).abs() < 1e-8 && (fit.area.b2 - 2.0).abs() < 1e-6);
    /// ```
    pub fn new(points: &[(f64, f64)], weights: Weights) -> Option<Self> {
        let (first, _) = points.first()?;
        let has_more = points.iter().any(|(p, _)| p != first);
        has_more.then(|| Self::search(Search { points, weights, b: Vector2::from(START), fades: true })).flatten()
    }

    /// Finds `b1` alone, with `b2 = 0`: then `a_rel = erf(sqrt(pi) kappa p*/2)` with one constant `kappa = sqrt(8/pi)/b1`, the
    /// form of Persson's theory for surfaces, with its slope fitted.
    ///
    /// ```
    /// use asperity::paper::Fit;
    /// let points: Vec<_> = (1..20).map(|i| 0.05 * f64::from(i)).map(|p| (p, libm::erf(1.9 * p))).collect();
    /// let kappa = Fit::proportional(&points).unwrap().area.kappa(0.0);
    /// assert!((kappa - 1.9 * 2.0 / std::f64::consts::PI.sqrt()).abs() < 1e-9);
    /// ```
    pub fn proportional(points: &[(f64, f64)]) -> Option<Self> {
        Self::search(Search { points, weights: Weights::Equal, b: Vector2::new(START[0], 0.0), fades: false })
    }

    fn search(search: Search<'_>) -> Option<Self> {
        let points = search.points;
        let (search, report) = LevenbergMarquardt::new().minimize(search);
        let area = search.area();
        let squares = points.iter().map(|&(p, a)| (area.relative_area(p) / a - 1.0).powi(2)).sum::<f64>();
        let residual = (squares / points.len() as f64).sqrt();
        (report.termination.was_successful() && residual.is_finite()).then_some(Self { area, residual })
    }
}

/// The sum of squares as a function of `b1` and `b2`.
struct Search<'a> {
    points: &'a [(f64, f64)],
    weights: Weights,
    b: Vector2<f64>,
    /// Whether the correction fades with the load, so that there is a `b2` to be found.
    fades: bool,
}

impl Search<'_> {
    fn area(&self) -> CorrectedArea {
        CorrectedArea { b1: self.b[0], b2: self.b[1] }
    }

    /// `d a_rel/d b1` and `d a_rel/d b2`.
    fn gradient(&self, p: f64) -> [f64; 2] {
        let CorrectedArea { b1, b2 } = self.area();
        let psi = self.area().correction(p);
        let by_psi = -FRAC_2_SQRT_PI * (-2.0 * (p / psi).powi(2)).exp() * SQRT_2 * p / (psi * psi);
        let by_b1 = 1.0 - libm::erf(b2 * p);
        let by_b2 = if self.fades { (1.0 - b1) * FRAC_2_SQRT_PI * (-(b2 * p).powi(2)).exp() * p } else { 0.0 };
        [by_psi * by_b1, by_psi * by_b2]
    }
}

impl LeastSquaresProblem<f64, Dyn, U2> for Search<'_> {
    type ResidualStorage = VecStorage<f64, Dyn, nalgebra::U1>;
    type JacobianStorage = Owned<f64, Dyn, U2>;
    type ParameterStorage = Owned<f64, U2>;

    fn set_params(&mut self, b: &Vector2<f64>) {
        self.b.copy_from(b);
    }

    fn params(&self) -> Vector2<f64> {
        self.b
    }

    fn residuals(&self) -> Option<Matrix<f64, Dyn, nalgebra::U1, Self::ResidualStorage>> {
        let area = self.area();
        let residuals = self.points.iter().map(|&(p, a)| self.weights.factor(a) * (area.relative_area(p) - a));
        Some(nalgebra::DVector::from_iterator(self.points.len(), residuals))
    }

    fn jacobian(&self) -> Option<OMatrix<f64, Dyn, U2>> {
        let rows = self.points.iter().flat_map(|&(p, a)| self.gradient(p).map(|by| self.weights.factor(a) * by));
        Some(OMatrix::<f64, Dyn, U2>::from_row_iterator(self.points.len(), rows))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_jacobian_is_that_of_the_residuals() {
        let search = |b1, b2| Search { points: &[], weights: Weights::Equal, b: Vector2::new(b1, b2), fades: true };
        for p in [1e-3, 0.03, 0.4] {
            let area = |b1, b2| search(b1, b2).area().relative_area(p);
            let step = 1e-6;
            let by_b1 = (area(0.55 + step, 2.3) - area(0.55 - step, 2.3)) / (2.0 * step);
            let by_b2 = (area(0.55, 2.3 + step) - area(0.55, 2.3 - step)) / (2.0 * step);
            let [b1, b2] = search(0.55, 2.3).gradient(p);
            assert!((b1 - by_b1).abs() < 1e-8 && (b2 - by_b2).abs() < 1e-8, "{p}: {b1} {by_b1}, {b2} {by_b2}");
        }
    }
}
