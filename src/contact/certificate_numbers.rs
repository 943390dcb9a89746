//! The numbers of a certificate in an archive.

use crate::contact::Certificate;

impl Certificate {
    /// The numbers of the certificate, in the order of its fields.
    pub(super) fn numbers(&self) -> [f64; 9] {
        [
            self.eta,
            self.eta_gap,
            self.pressure_error_bound,
            self.mean_gap_error_bound,
            self.load_error,
            self.min_pressure,
            self.above_hardness,
            self.penetration,
            self.rounding,
        ]
    }

    /// The certificate of such numbers.
    pub(super) fn from_numbers(numbers: [f64; 9]) -> Self {
        let [eta, eta_gap, pressure_error_bound, mean_gap_error_bound, load_error, rest @ ..] = numbers;
        let [min_pressure, above_hardness, penetration, rounding] = rest;
        Self {
            eta,
            eta_gap,
            pressure_error_bound,
            mean_gap_error_bound,
            load_error,
            min_pressure,
            above_hardness,
            penetration,
            rounding,
        }
    }
}
