//! Watching experiments.

use crate::contact::Observer;

/// A function that makes an observer of a run from its title, such as a progress bar.
pub type ObserverMaker = fn(&str) -> Box<dyn Observer>;
