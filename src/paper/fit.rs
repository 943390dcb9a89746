//! Curves of relative area against reduced pressure, fitted by least squares.

use crate::theory::persson::CorrectedArea;
use std::f64::consts::{FRAC_2_SQRT_PI, SQRT_2};

/// Where the search for `b1` and `b2` begins: between lines and Persson's theory, fading over `p* = 1`.
const START: [f64; 2] = [0.7, 1.0];

/// The damping of the first step, over the largest diagonal of the normal equations, and the factor by which it falls after a step that succeeds and rises
/// after one that fails.
const DAMPING: f64 = 1e-3;
const DAMPING_FACTOR: f64 = 10.0;

/// Relative changes of the sum of squares, and of the parameters, that are rounding.
const ROUNDING: f64 = 30.0 * f64::EPSILON;

/// Most steps of a search.
const MOST_STEPS: usize = 300;

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
    /// Marquardt, with the exact Jacobian. `None` if the search fails, and for points at
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
        has_more.then(|| Self::from_search(Search { points, weights, b: START, fades: true })).flatten()
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
        Self::from_search(Search { points, weights: Weights::Equal, b: [START[0], 0.0], fades: false })
    }

    fn from_search(search: Search<'_>) -> Option<Self> {
        let points = search.points;
        let area = search.least()?;
        let squares = points.iter().map(|&(p, a)| (area.relative_area(p) / a - 1.0).powi(2)).sum::<f64>();
        let residual = (squares / points.len() as f64).sqrt();
        residual.is_finite().then_some(Self { area, residual })
    }
}

/// The sum of squares as a function of `b1` and `b2`.
#[derive(Clone, Copy)]
struct Search<'a> {
    points: &'a [(f64, f64)],
    weights: Weights,
    b: [f64; 2],
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

    /// The weighted sum of squares.
    fn squares(&self) -> f64 {
        let area = self.area();
        self.points.iter().map(|&(p, a)| (self.weights.factor(a) * (area.relative_area(p) - a)).powi(2)).sum()
    }

    /// The normal equations of a linear fit: the upper triangle `[11, 12, 22]` of the matrix `J^T J` and the vector `J^T r`.
    fn normal_equations(&self) -> ([f64; 3], [f64; 2]) {
        let area = self.area();
        let ([mut xx, mut xy, mut yy], [mut x, mut y]) = ([0.0; 3], [0.0; 2]);
        for &(p, a) in self.points {
            let factor = self.weights.factor(a);
            let (residual, [by_b1, by_b2]) =
                (factor * (area.relative_area(p) - a), self.gradient(p).map(|by| factor * by));
            (xx, xy, yy) = (xx + by_b1 * by_b1, xy + by_b1 * by_b2, yy + by_b2 * by_b2);
            (x, y) = (x + by_b1 * residual, y + by_b2 * residual);
        }
        ([xx, xy, yy], [x, y])
    }

    /// The curve with the least sum of squares. A step solves `(J^T J + damping D) db = -J^T r`, where `D` holds the largest diagonal of `J^T J`
    /// so far, so that steps stay short where a parameter loses its influence. The search ends where the step, or the fall of the sum that the
    /// linear fit promises, is rounding. `None` if that takes too many steps, or if the curve is not finite.
    ///
    /// # Source
    /// J. J. Moré, in *Numerical Analysis*, Lecture Notes in Mathematics 630, 105 (1978).
    fn least(mut self) -> Option<CorrectedArea> {
        let (mut damping, mut squares, mut scale) = (DAMPING, self.squares(), [0.0; 2]);
        for _ in 0..MOST_STEPS {
            let ([xx, xy, yy], [x, y]) = self.normal_equations();
            scale = [xx.max(scale[0]), yy.max(scale[1])];
            let [damped_xx, damped_yy] = [[xx, scale[0]], [yy, scale[1]]]
                .map(|[diagonal, scale]| diagonal + damping * if scale == 0.0 { 1.0 } else { scale });
            let determinant = damped_xx * damped_yy - xy * xy;
            let [by_b1, by_b2] = [(xy * y - damped_yy * x) / determinant, (xy * x - damped_xx * y) / determinant];
            let promised =
                -2.0 * (by_b1 * x + by_b2 * y) - (xx * by_b1 + 2.0 * xy * by_b2) * by_b1 - yy * by_b2 * by_b2;
            let next = Self { b: [self.b[0] + by_b1, self.b[1] + by_b2], ..self };
            let next_squares = next.squares();
            let is_short = by_b1.hypot(by_b2) <= ROUNDING * self.b[0].hypot(self.b[1]);
            let is_rounding = is_short || promised <= ROUNDING * squares;
            if next_squares < squares || is_rounding {
                (self, squares, damping) = (next, next_squares, damping / DAMPING_FACTOR);
            } else {
                damping *= DAMPING_FACTOR;
            }
            if is_rounding {
                return self.b.iter().all(|b| b.is_finite()).then(|| self.area());
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_jacobian_is_that_of_the_residuals() {
        let search = |b1, b2| Search { points: &[], weights: Weights::Equal, b: [b1, b2], fades: true };
        for p in [1e-3, 0.03, 0.4] {
            let area = |b1, b2| search(b1, b2).area().relative_area(p);
            let step = 1e-6;
            let by_b1 = (area(0.55 + step, 2.3) - area(0.55 - step, 2.3)) / (2.0 * step);
            let by_b2 = (area(0.55, 2.3 + step) - area(0.55, 2.3 - step)) / (2.0 * step);
            let [b1, b2] = search(0.55, 2.3).gradient(p);
            assert!((b1 - by_b1).abs() < 1e-8 && (b2 - by_b2).abs() < 1e-8, "{p}: {b1} {by_b1}, {b2} {by_b2}");
        }
    }

    /// Without scatter, `b1` and `b2` are found from far away and from loads at which they hardly differ; with scatter, the sum of squares is
    /// larger to all sides.
    #[test]
    fn the_sum_of_squares_is_least() {
        for (b1, b2) in [(0.3, 0.5), (0.55, 2.3), (0.9, 6.0), (1.3, 1.5)] {
            let area = CorrectedArea { b1, b2 };
            for weights in Weights::ALL {
                let exact: Vec<_> = [0.01, 0.05, 0.1, 0.2, 0.5, 1.0].map(|p| (p, area.relative_area(p))).into();
                let fit = Fit::new(&exact, weights).unwrap();
                assert!((fit.area.b1 - b1).abs() < 1e-8 && (fit.area.b2 - b2).abs() < 1e-6, "{b1}, {b2}: {fit:?}");
                let scatter = |i: usize| 1.0 + 0.02 * (1.7 * i as f64).sin();
                let points: Vec<_> = exact.iter().enumerate().map(|(i, &(p, a))| (p, a * scatter(i))).collect();
                let CorrectedArea { b1, b2 } = Fit::new(&points, weights).unwrap().area;
                let squares = |b1, b2| Search { points: &points, weights, b: [b1, b2], fades: true }.squares();
                for (by_b1, by_b2) in
                    [(1e-4, 0.0), (-1e-4, 0.0), (0.0, 1e-3), (0.0, -1e-3), (1e-4, 1e-3), (-1e-4, 1e-3)]
                {
                    assert!(squares(b1 + by_b1, b2 + by_b2) > squares(b1, b2), "{b1}, {b2} by {by_b1}, {by_b2}");
                }
            }
        }
    }

    #[test]
    fn one_load_gives_no_two_parameters() {
        assert!(Fit::new(&[(0.1, 0.2), (0.1, 0.21)], Weights::Equal).is_none());
        assert!(Fit::new(&[], Weights::Equal).is_none() && Fit::proportional(&[]).is_none());
        assert!(Fit::proportional(&[(0.1, 0.2), (0.1, 0.21)]).is_some());
    }
}
