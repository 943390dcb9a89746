//! Elastic solids: the displacement by a pressure (fast, by Fourier transforms, and slow, by direct sums), and the
//! stress inside.
//!
//! An [`ElasticSolid`] gives the response to one wave; a [`Response`] is a solid on a grid, periodic or free along each
//! axis.

mod compliance;
mod convolution;
mod coupling;
mod depth;
pub mod direct;
mod directed;
pub(crate) mod element;
mod ewald;
mod free;
mod half_space;
mod layer;
mod prony;
mod response;
mod secular;
mod shear;
mod solid;
mod stiffness_table;
pub mod stress;

pub use compliance::Compliance;
pub(crate) use convolution::Convolution;
pub use coupling::Coupling;
pub use depth::{DepthLayers, DepthResponse};
pub(crate) use directed::SteadyMotion;
pub use half_space::HalfSpace;
pub use layer::{Base, Layer};
pub use prony::{Prony, PronyTerm};
pub use response::Response;
pub use shear::{ShearCompliance, ShearResponse};
pub use solid::{ElasticSolid, LongWaves};
pub use stiffness_table::StiffnessTable;
pub use stress::Stress;
