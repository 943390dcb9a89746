//! Layouts: the views of a recording and their places in the viewer.

mod blueprint;
mod comparison;
mod copy;
mod loads;
mod steps;
mod survey;

pub use comparison::{Compared, send_comparison};
pub use copy::copy;
pub use loads::{TEXT, send_loads};
pub use steps::send_steps;
pub use survey::send_survey;
