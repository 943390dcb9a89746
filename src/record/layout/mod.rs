//! Layouts: the views of a recording and their places in the viewer.

mod blueprint;
mod loads;
mod steps;

pub use loads::{TEXT, send_loads};
pub use steps::send_steps;
