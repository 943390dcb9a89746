//! The summary of a solve, as text and as JSON.

use super::finding::Finding;
use super::problem_summary::ProblemSummary;
use super::slip::SlipFinding;
use super::units::Units;
use anyhow::Result;
use asperity::diagnosis::Findings;
use asperity::setup::Setup;
use serde::Serialize;
use std::f64::consts::PI;
use std::io::{self, Write};

/// Everything that a script may want to know about a contact, and the setup that repeats it.
#[derive(Serialize)]
pub(crate) struct Summary {
    #[serde(flatten)]
    pub subject: ProblemSummary,
    #[serde(flatten)]
    pub finding: Finding,
    /// The stick and slip areas under a tangential load.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slip: Option<SlipFinding>,
    /// Findings of `--diagnose`: why the solve was slow.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub diagnosis: Option<Findings>,
    pub warnings: Vec<String>,
    #[serde(serialize_with = "Setup::serialize_saved")]
    pub setup: Setup,
    #[serde(skip)]
    pub units: Units,
    /// Whether all numbers are written for reading.
    #[serde(skip)]
    pub is_verbose: bool,
}

impl Summary {
    /// Writes the summary for reading.
    pub(crate) fn write_text(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "{}: {}", self.subject.line(), self.finding.status)?;
        let units = self.units;
        let slip = self.slip.iter().flat_map(|it| it.rows(units));
        let results = self.finding.rows(units).into_iter().chain(self.size()).chain(slip);
        let details = if self.is_verbose { self.finding.details(units) } else { Vec::new() };
        write_rows(results.chain(self.subject.rows(units, self.is_verbose)).chain(details), out)?;
        write_diagnosis(self.diagnosis.as_ref(), out)
    }

    /// How large the contact is: on a line its half-width, or the width of all patches together; on a surface its area, and its radius where theory knows
    /// one.
    fn size(&self) -> Option<(String, String)> {
        let (it, units) = (&self.finding.observables, self.units);
        let size = it.resolved_area()? * self.subject.size.iter().product::<f64>();
        let exact = self.finding.exact_radius(units);
        let beside = exact.as_ref().map_or(String::new(), |exact| format!("   {exact}"));
        let (name, size) = match (self.subject.size.len(), it.patches) {
            (1, 1) => ("half-width of the contact", format!("{}{beside}", units.length(0.5 * size))),
            (1, patches) => ("width of the contact", format!("{} in {patches} patches", units.length(size))),
            (_, 1) if exact.is_some() => {
                let radius = units.length((size / PI).sqrt());
                ("area of the contact", format!("{}, radius {radius}{beside}", units.area(size)))
            }
            _ => ("area of the contact", units.area(size)),
        };
        let images = if self.setup.surface.prepare.mirror.is_some() { ", with its mirror images" } else { "" };
        (it.relative_area > 0.0).then(|| (name.to_owned(), format!("{size}{images}")))
    }
}

/// Writes why a run was slow, if that is known.
pub(crate) fn write_diagnosis(diagnosis: Option<&Findings>, out: &mut impl Write) -> io::Result<()> {
    diagnosis.map_or(Ok(()), |diagnosis| write!(out, "\nWhy it was slow:\n{diagnosis}"))
}

/// Writes an object as one line of JSON.
pub(crate) fn write_json(object: &impl Serialize, out: &mut impl Write) -> Result<()> {
    Ok(writeln!(out, "{}", serde_json::to_string(object)?)?)
}

/// Writes names and values, one pair a line.
pub(crate) fn write_rows(rows: impl IntoIterator<Item = (String, String)>, out: &mut impl Write) -> io::Result<()> {
    rows.into_iter().try_for_each(|(name, value)| writeln!(out, "  {name:<25} {value}"))
}
