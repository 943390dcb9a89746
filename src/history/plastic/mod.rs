//! Contacts with a solid that yields below the surface: each load step is one convex minimum, with a bound of the distance from it.
//!
//! ```text
//! increment of plastic strain --> residual displacement u^r --> contact on the heights h - u^r --> stress --> gap, radial return --> next increment
//! ```

mod accelerated;
mod companions;
mod flow;
mod gap_search;
mod load_step;
mod plastic_errors;
mod plastic_loading;
mod plastic_process;
mod plastic_solid;
mod plastic_state;
mod pressing;

pub use plastic_errors::{PlasticErrorSources, PlasticErrors};
pub use plastic_loading::PlasticLoading;
pub use plastic_process::Plastic;
pub use plastic_solid::PlasticSolid;
pub use plastic_state::{PlasticCertificate, PlasticEnergy, PlasticState};
