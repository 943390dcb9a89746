//! The report of one contact.

use super::finding::Finding;
use super::output::{TextRow, row, write_rows};
use super::outputs::Outputs;
use super::picture;
use super::problem_summary::ProblemSummary;
use super::report::SolveReport;
use super::slip::SlipFinding;
use super::stress;
use super::units::Units;
use anyhow::Result;
use asperity::contact::{PartialSlip, State, archive_of_slip, archive_of_state};
use asperity::diagnosis::Findings;
use asperity::job::write_nodes;
use asperity::plot::Figure;
use asperity::setup::Setup;
use serde::Serialize;
use std::f64::consts::PI;
use std::io::{self, Write};
use std::path::Path;

/// Everything that a script may want to know about a contact, and the setup that repeats it.
#[derive(Serialize)]
pub(crate) struct ContactReport {
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
    /// The contact with what flows through it.
    #[serde(skip)]
    pub state: State,
    /// The contact in partial slip, under a tangential load.
    #[serde(skip)]
    pub partial_slip: Option<PartialSlip>,
    #[serde(skip)]
    pub units: Units,
}

impl SolveReport for ContactReport {
    fn setup(&self) -> &Setup {
        &self.setup
    }

    fn warnings(&self) -> &[String] {
        &self.warnings
    }

    fn has_lost_recording(&self) -> bool {
        self.state.contact.failure.is_some()
    }

    fn archive(&self) -> io::Result<Vec<u8>> {
        let (rank, text) = (self.subject.rank, self.setup.to_saved_toml());
        let bytes = match &self.partial_slip {
            Some(slip) => archive_of_slip(slip, rank, Some(&text)),
            None => archive_of_state(&self.state, rank, Some(&text)),
        };
        bytes.map_err(io::Error::other)
    }

    /// The table of a line has its nodes.
    fn write_table(&self, path: &Path) -> Result<()> {
        Ok(write_nodes(path, &self.state.contact)?)
    }

    fn figure(&self) -> Figure {
        let contact = &self.state.contact;
        let title = picture::title_of(&self.setup.surface, contact.problem.surface().grid());
        picture::of_contact(&title, contact, self.units)
    }

    /// The stress below the contact.
    fn write_further_files(&self, outputs: &Outputs) -> Result<()> {
        match &outputs.stress {
            Some(path) => stress::write(path, &self.setup, &self.state.contact, outputs.stress_row),
            None => Ok(()),
        }
    }

    fn write_text(&self, is_verbose: bool, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "{}: {}", self.subject.line(), self.finding.status)?;
        // results first, then what they belong to
        let mut rows = self.finding.rows(self.units);
        rows.extend(self.size());
        if let Some(slip) = &self.slip {
            rows.extend(slip.rows(self.units));
        }
        rows.extend(self.subject.rows(self.units, is_verbose));
        if is_verbose {
            rows.extend(self.finding.details(self.units));
        }
        write_rows(rows, out)?;
        write_diagnosis(self.diagnosis.as_ref(), out)
    }
}

impl ContactReport {
    /// How large the contact is: on a line its half-width, or the width of all patches together; on a surface its area, and its radius where theory knows
    /// one.
    fn size(&self) -> Option<TextRow> {
        let (it, units) = (&self.finding.observables, self.units);
        let cell: f64 = self.subject.size.iter().product();
        // none where nothing touches either
        let size = it.resolved_area().filter(|area| *area > 0.0)? * cell;
        let exact = self.finding.exact_radius(units);
        let beside = exact.as_ref().map_or(String::new(), |exact| format!("   {exact}"));
        let is_line = self.subject.size.len() == 1;
        let (name, mut words) = match (is_line, it.patches) {
            (true, 1) => ("half-width of the contact", units.length(0.5 * size) + &beside),
            (true, patches) => ("width of the contact", format!("{} in {patches} patches", units.length(size))),
            (false, _) => ("area of the contact", units.area(size)),
        };
        if !is_line && it.patches == 1 && exact.is_some() {
            words += &format!(", radius {}{beside}", units.length((size / PI).sqrt()));
        }
        if self.setup.surface.prepare.mirror.is_some() {
            words += ", with its mirror images";
        }
        Some(row(name, words))
    }
}

/// Writes why a run was slow, if that is known.
pub(crate) fn write_diagnosis(diagnosis: Option<&Findings>, out: &mut dyn Write) -> io::Result<()> {
    diagnosis.map_or(Ok(()), |diagnosis| write!(out, "\nWhy it was slow:\n{diagnosis}"))
}
