//! What the steps of a path with friction add up to, and their errors.

/// Estimated errors of a state by finite steps of the path of the loads.
///
/// The path is solved in steps and, beside it, in steps of twice the length, each from its own states. An error of first order is the difference of both,
/// one of second order a third of it. So twice the difference is stated; those of the lost energy add up. Steps that are exact have no error,
/// see [`SlipProcess`](crate::history::SlipProcess).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SlipPathErrors {
    /// Of the shift since the beginning, a length.
    pub shift: f64,
    /// Of the energy lost since the beginning, per area.
    pub dissipated: f64,
    /// Of the share of the nodes in contact that stick.
    pub stick_share: f64,
}

/// What the steps of a path add up to.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SlipTotals {
    /// The shift of the rigid surface along `x` since the beginning, a length.
    pub shift: f64,
    /// The energy that friction has dissipated since the beginning, per area.
    pub dissipated: f64,
    /// The errors of these; none where steps were given that are not exact.
    pub errors: Option<SlipPathErrors>,
}
