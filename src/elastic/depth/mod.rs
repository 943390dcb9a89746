//! The half-space in depth: stress and displacement by a plastic strain in layers below the surface.
//!
//! ```text
//! strain (layers, components, nodes) --transforms--> waves --two scans over the layers for each wave--> stress, displacement
//! ```
//!
//! A wave of strain is split into a part in the plane of its wave vector and the depth, which has an Airy function, and a part across this plane, which has a
//! stress function of second order. Both are solved exactly for a strain that is uniform in each layer, whatever the thicknesses are.
//!
//! # Source
//! Derived for this crate; the setting is that of Jacq et al., J. Tribol. 124, 653 (2002), and Frérot et al., Comput. Methods Appl. Mech. Eng. 351,
//! 951 (2019), whose volume integrals act on nodes in depth.

mod antiplane;
mod depth_response;
mod layer_wave;
mod layers;
mod parity;
mod plane;
mod wave_column;
mod wave_tensor;

pub use depth_response::DepthResponse;
pub use layers::DepthLayers;
