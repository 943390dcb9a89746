//! Facets: what can be asked of a run that has ended, beyond its report.

use super::reel::Solved;
use serde_json::{Value, json};

/// Something to be told of a run.
pub struct Facet {
    /// Its name in the path under which it is asked for.
    pub name: &'static str,
    /// It, as JSON.
    pub of: fn(&Solved) -> Value,
}

/// The facets of a run.
pub const FACETS: [Facet; 1] = [Facet { name: "steps", of: |solved| json!(solved.steps) }];
