//! Facets: data about a run that has ended, in addition to its report.

use super::leak::{CONDUCTANCE, Leak, conductance};
use super::section::Section;
use super::session_recording::SolvedRun;
use super::top::Top;
use super::why::Why;
use serde_json::{Value, json};

/// Additional data about a run that the page can request.
pub struct Facet {
    /// Its name in the path of the request.
    pub name: &'static str,
    /// It, as JSON.
    pub of: fn(&SolvedRun) -> Value,
}

/// The facet that sweeps have too.
pub const MOTION: &str = "motion";

/// The facets of a run.
pub const FACETS: [Facet; 11] = [
    Facet { name: "section", of: |solved| json!(solved.section()) },
    Facet { name: "top", of: |solved| json!(Top::from_contact(&solved.contact, &solved.fields)) },
    Facet { name: "leak", of: |solved| json!(Leak::through(&solved.contact)) },
    Facet { name: "shear", of: |solved| json!(solved.shear(Some(&solved.contact))) },
    Facet { name: "beside", of: |solved| json!(solved.beside.as_ref().map(|it| Section::from_contact(it, &[]))) },
    Facet { name: "shear-beside", of: |solved| json!(solved.shear(solved.beside.as_ref())) },
    Facet { name: "patches", of: |solved| json!(solved.patches()) },
    Facet { name: CONDUCTANCE, of: |solved| json!(conductance(&solved.contact)) },
    Facet { name: "steps", of: |solved| json!(solved.steps) },
    Facet { name: MOTION, of: |solved| json!(solved.motion) },
    Facet { name: "why", of: |solved| json!(Why::find(solved)) },
];
