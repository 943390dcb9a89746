//! Contact problems, their solvers, and what is measured on their solutions.
//!
//! ```text
//! Problem --> Solver::solve --(Step)--> Observer
//!                  |
//!                  v
//!               Contact { pressure, displacement, gap, Certificate, Work, Status } --> Measures, Patches
//! ```

mod archive;
mod best;
mod certificate;
mod gfmd;
mod load;
mod measure;
mod multilevel;
mod observe;
mod patches;
mod polonsky_keer;
mod problem;
mod result;
mod solver;
mod stop;

use crate::chunks;

pub use archive::archive;
pub use certificate::Certificate;
pub use gfmd::{Dynamics, Gfmd, Masses};
pub use load::Load;
pub use measure::{Measures, NODE_EXCESS_PER_SWITCH_LINE, NODE_EXCESS_PER_SWITCH_SURFACE};
pub use multilevel::Multilevel;
pub use observe::{Observer, Phase, Step};
pub use patches::Patches;
pub use polonsky_keer::PolonskyKeer;
pub use problem::Problem;
pub use result::{Contact, Status, Work};
pub use solver::Solver;
pub use stop::Stop;
