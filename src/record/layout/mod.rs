//! Layouts: the views of a recording and their places in the viewer.

mod blueprint;
mod comparison;
mod copy;
mod curves;
mod loads;
mod steps;
mod survey;
mod window;

pub use comparison::{Compared, send_comparison, send_load_comparison};
pub use copy::copy;
pub use loads::{TEXT, fit_loads, send_loads};
pub use steps::{fit_steps, send_steps};
pub use survey::{fit_survey, send_survey};
