//! The effect of rounding on a certificate.

use crate::contact::{CertificateSums, Problem};

/// Root-mean-square error of one transform, relative to the root mean square of its values, for each doubling of its length. For
/// powers of two a bound is 3.5 epsilon (Higham, *Accuracy and Stability of Numerical Algorithms*, 2002, theorem 24.2); other
/// lengths are transformed as convolutions of three times as many steps, and get more than four times as much.
const TRANSFORM: f64 = 16.0 * f64::EPSILON;

/// Relative rounding of the differences of `u`, `h` and the reference: at most four.
const RHO: f64 = 4.0 * f64::EPSILON;

/// Largest number of terms that a sum adds one after the other.
const IN_A_ROW: f64 = 32_768.0;

/// Bounds of the error `delta` of the computed `v = u - h`, of which the certificate is made, in the two norms that matter.
///
/// `u = A p` is computed by a transform pair. The forward one errs by `epsilon <p^2>^(1/2)` in the root mean square of the modes,
/// which the compliance `1/k` then makes smaller; the inverse one by `epsilon <u^2>^(1/2)`, at any wavelength; and the difference
/// by a few roundings of `u`, `h` and the reference. So, with the softest and the stiffest mode,
///
/// ```text
/// |delta|*^2 = sum k |delta_q|^2 <= 12 (epsilon^2 (<p^2> / k_min + k_max <u^2>) + rho^2 k_max (<u^2> + h_rms^2 + v_reference^2))
/// |<delta>|  <= epsilon <u^2>^(1/2) + rho ((<u^2> + h_rms^2 + v_reference^2)^(1/2) + D)
/// ```
///
/// where `k` is the inverse of the real part of a complex compliance, and `k_min` the smallest real part of its inverse, and
/// with a few roundings `rho`, since `(a + b + c)^2 <= 3 (a^2 + b^2 + c^2)`, and the first of them counts twice, for the product
/// with the compliance. All is bounded by magnitudes that are met in the sums.
pub(super) struct Rounding {
    /// `|delta|*^2`, an energy per area: dual to `|x|^2 = <x A x>`, so that `<delta x> <= |delta|* |x|` where `<x> = 0`.
    pub energy: f64,
    /// The bound of `|<delta>|`, a length.
    pub mean: f64,
    /// The bound of the error of `<p v> / <p>` by summation, a length.
    pub depth: f64,
    /// The bound of the error of `<p u>` by summation.
    pub elastic: f64,
    /// The bound of the relative error of a sum of positive terms.
    sum: f64,
}

impl Rounding {
    /// The bounds for the sums of a state.
    pub(crate) fn new(problem: &Problem, sums: &CertificateSums) -> Self {
        let n = problem.nodes() as f64;
        let epsilon = TRANSFORM * n.log2();
        let [_, stiffest] = problem.compliance().stiffness_range();
        let softest = problem.compliance().least_stiffness();
        let [square_p, square_u] = [sums.square_pressure, sums.square_displacement].map(|sum| sum / n);
        let square_lengths = square_u + problem.rms_height().powi(2) + sums.reference_v.powi(2);
        let datum = problem.datum().unwrap_or(0.0);
        let mean_v = sums.pressure_v / sums.pressure;
        let sum = 0.5 * f64::EPSILON * n.min(IN_A_ROW); // relative error of a sum of positive terms
        Self {
            energy: 12.0
                * (epsilon.powi(2) * (square_p / softest + stiffest * square_u)
                    + RHO.powi(2) * stiffest * square_lengths),
            mean: epsilon * square_u.sqrt() + RHO * (square_lengths.sqrt() + datum),
            depth: 2.0 * sum * (mean_v.abs() + 2.0 * sums.lowest_v.abs()),
            elastic: sum * (square_p * square_u).sqrt(),
            sum,
        }
    }

    /// The bounds where the depth is itself a mean of positive terms.
    pub(crate) fn with_depth(self, depth: f64) -> Self {
        Self { depth: 2.0 * self.sum * depth, ..self }
    }
}
