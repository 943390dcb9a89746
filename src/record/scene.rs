//! Scenes: the problems of a recording.

use crate::contact::Problem;
use crate::theory::Exact;

/// One contact problem of a recording.
pub struct Scene<'a> {
    /// Root of the scene's entities, such as `hertz_line`; characters other than letters, digits, `_` and `-` become `_`.
    pub name: String,
    /// Title of tab and pictures.
    pub title: String,
    /// The problem whose steps will be recorded.
    pub problem: &'a Problem,
    /// Parameters, units, seed, solver and settings, in Markdown.
    pub description: String,
    /// The exact solution, where there is one; its pressure is drawn beside the computed one. A line is then shown around
    /// its contact only.
    pub exact: Option<Exact>,
}
