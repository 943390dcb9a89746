//! Facets: data about a run that has ended, in addition to its report.

use super::leak::{CONDUCTANCE, Leak, conductance};
use super::session_recording::{LastState, SolvedRun};
use super::top::Top;
use super::why::Why;
use serde_json::{Value, json};

/// Additional data about a run that the page can request.
pub(crate) struct Facet {
    /// Its name in the path of the request.
    pub name: &'static str,
    /// It, as JSON.
    pub of: fn(&SolvedRun) -> Value,
}

/// The facet that sweeps have too.
pub(crate) const MOTION: &str = "motion";

/// The facets of a run.
pub(crate) const FACETS: [Facet; 11] = [
    Facet { name: "section", of: |solved| json!(solved.last.section()) },
    Facet { name: "top", of: |solved| json!(Top::from_contact(&solved.last.contact, &solved.last.fields)) },
    Facet { name: "leak", of: |solved| json!(Leak::through(&solved.last.contact)) },
    Facet { name: "shear", of: |solved| json!(solved.shear(Some(&solved.last.contact))) },
    Facet { name: "beside", of: |solved| json!(solved.beside.as_ref().map(LastState::section)) },
    Facet { name: "shear-beside", of: |solved| json!(solved.shear(solved.beside.as_ref().map(|it| &it.contact))) },
    Facet { name: "patches", of: |solved| json!(solved.patches()) },
    Facet { name: CONDUCTANCE, of: |solved| json!(conductance(&solved.last.contact)) },
    Facet { name: "steps", of: |solved| json!(solved.steps) },
    Facet { name: MOTION, of: |solved| json!(solved.motion) },
    Facet { name: "why", of: |solved| json!(Why::find(solved)) },
];
