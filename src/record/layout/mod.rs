//! Layouts: the views of a recording and their places in the viewer.

mod blueprint;
mod loads;
mod steps;

pub use loads::{LOAD, TEXT, send_loads};
pub use steps::send_steps;
