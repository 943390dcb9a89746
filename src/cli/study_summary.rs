//! What a study has found, as text and as JSON.

use super::exit_status::ExitStatus;
use super::output::write_json;
use super::study_table::{write_adhesion_means, write_means, write_yield_means};
use super::terminal::stdout;
use super::warnings;
use anyhow::Result;
use asperity::study::{AdhesionMeans, LoadMeans, Plan, Point, YieldMeans};
use clap::Args;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// How the findings of a study are printed.
#[derive(Args)]
pub(crate) struct StudyOutput {
    /// Print one JSON object instead of a table: the means with their errors, and the warnings
    #[arg(long)]
    json: bool,
    /// Treat warnings as errors: all files are written, and the exit code is 2
    #[arg(long)]
    strict: bool,
}

/// The findings of a study, or of a share of it.
#[derive(Serialize)]
pub(crate) struct StudySummary {
    table: PathBuf,
    rows: usize,
    converged: usize,
    /// The means over the seeds; none of a share, which does not have all of them.
    #[serde(skip_serializing_if = "Option::is_none")]
    means: Option<Means>,
    warnings: Vec<String>,
}

/// The means over the seeds.
#[derive(Serialize)]
#[serde(untagged)]
enum Means {
    Contact(Vec<LoadMeans>),
    Adhesion(Vec<AdhesionMeans>),
    Yielding(Vec<YieldMeans>),
}

impl StudySummary {
    /// The summary of the points of a share.
    pub(crate) fn of_share(plan: &Plan, table: &Path, points: &[Point]) -> Self {
        Self {
            table: table.into(),
            rows: points.len(),
            converged: points.iter().filter(|point| point.is_converged()).count(),
            means: None,
            warnings: plan.warnings(points).iter().map(ToString::to_string).collect(),
        }
    }

    /// The summary of all points of a study.
    pub(crate) fn of_all(plan: &Plan, table: &Path, points: &[Point]) -> Self {
        let means = if points.iter().any(Point::has_adhesion) {
            Means::Adhesion(plan.adhesion_means(points))
        } else if points.iter().any(Point::yields) {
            Means::Yielding(plan.yield_means(points))
        } else {
            Means::Contact(plan.means(points))
        };
        Self { means: Some(means), ..Self::of_share(plan, table, points) }
    }

    /// Prints the summary and its warnings, and says how the study ended.
    ///
    /// # Errors
    /// The warnings, where `--strict` is given.
    pub(crate) fn finish(&self, plan: &Plan, output: &StudyOutput) -> Result<ExitStatus> {
        match &self.means {
            _ if output.json => write_json(self, &mut stdout())?,
            None => (),
            Some(Means::Contact(means)) => write_means(plan, self.rows, means, &mut stdout())?,
            Some(Means::Adhesion(means)) => write_adhesion_means(plan, self.rows, means, &mut stdout())?,
            Some(Means::Yielding(means)) => write_yield_means(plan, self.rows, means, &mut stdout())?,
        }
        warnings::refuse_if_strict(&self.warnings, output.strict)?;
        warnings::print(&self.warnings);
        Ok(if self.converged == self.rows { ExitStatus::Done } else { ExitStatus::NotConverged })
    }
}
