//! Elastic solids: what displacement a pressure makes, fast by Fourier transform and slow by direct sum, and the stress inside.
//!
//! An [`ElasticSolid`] says what it makes of one wave; a [`Response`] is a solid over a grid, periodic or free along each axis.

mod compliance;
pub mod direct;
mod element;
mod free;
mod half_space;
mod layer;
mod response;
mod solid;
pub mod stress;

pub use compliance::Compliance;
pub use half_space::HalfSpace;
pub use layer::{Base, Layer};
pub use response::Response;
pub use solid::ElasticSolid;
pub use stress::Stress;
