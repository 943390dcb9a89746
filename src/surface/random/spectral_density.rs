//! The spectrum that random roughness is made from, and its scale.

use super::self_affine::SelfAffine;
use super::spectrum_file::MeasuredSpectrum;

/// Where a spectrum comes from.
#[derive(Debug, Clone, PartialEq)]
pub enum SpectralDensity {
    /// A power law.
    SelfAffine(SelfAffine),
    /// The values of a file.
    Measured(MeasuredSpectrum),
}

/// What the heights of each realisation are scaled to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RoughnessScale {
    /// This root-mean-square gradient, by the finite differences of Eq. 8 of the paper.
    RmsGradient(f64),
    /// This root-mean-square height, a length.
    RmsHeight(f64),
    /// Nothing: the spectrum of a file is used as it is, and the realisations vary about it.
    AsGiven,
}
