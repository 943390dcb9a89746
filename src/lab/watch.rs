//! Watching experiments.

use crate::contact::Observer;

/// Makes an observer of a run from its title, such as a progress bar.
pub type Watch<'a> = dyn FnMut(&str) -> Box<dyn Observer> + 'a;
