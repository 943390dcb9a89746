//! The elastic solid: a frictionless half-space, fast by Fourier transform and slow by direct sum.

pub mod direct;
mod half_space;

pub use half_space::HalfSpace;
