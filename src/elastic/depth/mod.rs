//! The half-space in depth: stress and displacement by a plastic strain in layers below the surface.
//!
//! ```text
//! strain (layers, components, nodes) --transforms--> waves --two scans over the layers for each wave--> stress, displacement
//! ```

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
