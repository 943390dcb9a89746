//! Real Fourier transforms of fields on a [`Grid`](crate::Grid), on all cores: the plain pair, and filters that need one half
//! spectrum.
//!
//! # Conventions
//! For a field `f` of `n = ny nx` points
//!
//! - forward: `f_q = (1/n) sum_x f(x) exp(-i q x)`, so the coefficient of `q = 0` is the mean;
//! - inverse: `f(x) = sum_q f_q exp(i q x)`, so the pair is the identity.
//!
//! Since `f` is real, only `q_x >= 0` is stored: `(nx/2 + 1) * ny` coefficients, **`q_x` outside, `q_y` inside** (index
//! `kx * ny + ky`), which saves one of two transposes per transform. For a line that is just `kx`.

mod columns;
mod filter;
mod line;
mod long_line;
mod padded;
mod pair;
mod plans;
mod real;
mod surface;
mod wave;
mod worker;

pub(crate) use filter::Filter;
pub(crate) use padded::{Padded, smooth};
pub use pair::Fourier;
pub(crate) use real::Real;
pub(crate) use wave::Wave;

/// A complex Fourier coefficient.
pub type Complex = rustfft::num_complex::Complex<f64>;
