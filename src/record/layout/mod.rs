//! Layouts: the views of a recording and their places in the viewer.

mod blueprint;
mod comparison;
mod copy;
mod curves;
mod loads;
mod steps;
mod survey;
mod window;

pub(crate) use comparison::{Compared, send_comparison, send_load_comparison};
pub(crate) use copy::copy;
pub(crate) use loads::{TEXT, fit_charts, fit_loads, send_loads};
pub(crate) use steps::{fit_steps, send_steps};
pub(crate) use survey::{fit_survey, send_survey};
