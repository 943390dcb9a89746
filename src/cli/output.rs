//! The summary of a solve, for people and for scripts.

use super::finding::Finding;
use super::slip::SlipFinding;
use super::subject::Subject;
use anyhow::Result;
use asperity::diagnosis::Findings;
use asperity::setup::Setup;
use serde::Serialize;
use std::io::{self, Write};

/// Everything that a script may want to know about a contact, and the setup that repeats it.
#[derive(Serialize)]
pub struct Summary {
    #[serde(flatten)]
    pub subject: Subject,
    #[serde(flatten)]
    pub finding: Finding,
    /// What sticks and what slips under a tangential load.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slip: Option<SlipFinding>,
    /// Findings of `--diagnose`: what held the solve up.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub diagnosis: Option<Findings>,
    pub warnings: Vec<String>,
    pub setup: Setup,
}

impl Summary {
    /// Writes the summary for reading.
    pub fn write_text(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "{}: {}", self.subject.line(), self.finding.status)?;
        let slip = self.slip.iter().flat_map(SlipFinding::rows);
        write_rows(self.subject.rows().into_iter().chain(self.finding.rows()).chain(slip), out)?;
        write_diagnosis(self.diagnosis.as_ref(), out)
    }
}

/// Writes what held a run up, if that is known.
pub fn write_diagnosis(diagnosis: Option<&Findings>, out: &mut impl Write) -> io::Result<()> {
    diagnosis.map_or(Ok(()), |diagnosis| write!(out, "\nWhat held it up:\n{diagnosis}"))
}

/// Writes an object as one line of JSON.
pub fn write_json(object: &impl Serialize, out: &mut impl Write) -> Result<()> {
    Ok(writeln!(out, "{}", serde_json::to_string(object)?)?)
}

/// Writes names and values, one pair a line.
pub fn write_rows(rows: impl IntoIterator<Item = (String, String)>, out: &mut impl Write) -> io::Result<()> {
    rows.into_iter().try_for_each(|(name, value)| writeln!(out, "  {name:<25} {value}"))
}
