//! The elastic solid: a frictionless half-space, fast by Fourier transform and slow by direct sum, and the stress inside it.

pub mod direct;
mod half_space;
pub mod stress;

pub use half_space::HalfSpace;
pub use stress::Stress;
