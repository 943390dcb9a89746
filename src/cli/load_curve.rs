//! `asperity solve` under one load after the other.

use super::exit_status::{ExitStatus, Interrupted};
use super::finding::Finding;
use super::output::write_rows;
use super::outputs::Outputs;
use super::picture;
use super::problem_summary::ProblemSummary;
use super::report::{self, SolveReport};
use super::state_watch::StateWatch;
use super::units::Units;
use super::warnings;
use anyhow::Result;
use asperity::contact::{Observables, Problem, Quantity, Status, archive_of_states, warnings_of};
use asperity::error::{HistoryError, StudyError, is_input};
use asperity::job::{HistoryOutcome, LoadNumbers, Solved, write_loads};
use asperity::plot::Figure;
use asperity::setup::Setup;
use serde::Serialize;
use std::io::{self, Write};
use std::path::Path;

/// Everything that a script may want to know about contacts under one load after the other, and the setup that repeats them.
#[derive(Serialize)]
struct LoadsReport {
    #[serde(flatten)]
    subject: ProblemSummary,
    loads: Vec<Finding>,
    /// Why not all loads were solved, if they were not.
    #[serde(skip_serializing_if = "Option::is_none")]
    ended: Option<String>,
    warnings: Vec<String>,
    #[serde(serialize_with = "Setup::serialize_saved")]
    setup: Setup,
    #[serde(skip)]
    history: HistoryOutcome,
    /// Whether the recording could not be written to its end.
    #[serde(skip)]
    has_lost_recording: bool,
    #[serde(skip)]
    units: Units,
    #[serde(skip)]
    is_verbose: bool,
}

/// Writes and prints what came out under a list of loads.
pub(crate) fn write(
    solved: Solved,
    problem: &Problem,
    watch: StateWatch<'_>,
    (outputs, units): (&Outputs, Units),
) -> Result<ExitStatus> {
    let status = watch.status;
    let Some(mut history) = solved.history else { return Ok(status) };
    let is_stopped = matches!(history.ended, Some(HistoryError::Stopped));
    if let Some(error) = history.ended.take_if(|error| is_input(error)) {
        return Err(StudyError::from(error).into());
    }
    if watch.findings.is_empty() {
        return Err(Interrupted.into());
    }
    history.states.retain(|state| state.contact.status != Status::StoppedByObserver);
    let mut setup = solved.setup;
    let all = setup.loads.len();
    setup.loads.truncate(watch.findings.len());
    let failure = history.failure.take();
    let ended = history.ended.as_ref().map(HistoryError::to_string);
    let StateWatch { findings, of_contact, shortfalls, .. } = watch;
    let observables: Vec<&Observables> = findings.iter().map(|it| &it.observables).collect();
    let mut warnings = setup.surface.warnings(problem.surface());
    warnings.extend(warnings_of(&observables, problem.law()));
    warnings.extend(of_contact);
    let mut warnings = warnings::in_flags(&warnings);
    warnings::refuse_if_strict(&warnings, outputs.strict)?;
    warnings.extend(shortfalls);
    let solved = findings.len();
    let report = LoadsReport {
        subject: ProblemSummary::new(&setup, problem)?,
        loads: findings,
        ended: ended.clone(),
        warnings,
        setup,
        history,
        has_lost_recording: failure.is_some(),
        units,
        is_verbose: outputs.verbose,
    };
    report::deliver(&report, outputs)?;
    if let Some(error) = &ended {
        let cause = if is_stopped { "interrupted" } else { error };
        warnings::print(&[format!("{cause}: {solved} of {all} loads were solved and written")]);
    }
    match (failure, ended) {
        (Some(failure), _) => Err(failure.into()),
        (None, Some(_)) if is_stopped => Ok(ExitStatus::Interrupted),
        (None, Some(_)) => Ok(status.max(ExitStatus::NotConverged)),
        (None, None) => Ok(status),
    }
}

/// The numbers of a finding for a table.
fn numbers_of<'a>((finding, further): (&'a Finding, &'a Vec<(Quantity, f64)>)) -> LoadNumbers<'a> {
    LoadNumbers { status: finding.status, observables: &finding.observables, further }
}

impl SolveReport for LoadsReport {
    fn setup(&self) -> &Setup {
        &self.setup
    }

    fn warnings(&self) -> &[String] {
        &self.warnings
    }

    fn has_lost_recording(&self) -> bool {
        self.has_lost_recording
    }

    fn archive(&self) -> io::Result<Vec<u8>> {
        archive_of_states(&self.history.states, self.subject.rank, &self.setup.to_saved_toml())
            .map_err(io::Error::other)
    }

    fn write_table(&self, path: &Path) -> Result<()> {
        let further: Vec<Vec<(Quantity, f64)>> = self.loads.iter().map(Finding::further).collect();
        Ok(write_loads(path, &self.loads.iter().zip(&further).map(numbers_of).collect::<Vec<_>>())?)
    }

    fn figure(&self) -> Figure {
        let observables: Vec<&Observables> = self.loads.iter().map(|it| &it.observables).collect();
        picture::of_loads(&self.subject.title, &observables, self.setup.load, self.units)
    }

    fn write_further_files(&self, _: &Outputs) -> Result<()> {
        Ok(())
    }

    fn write_text(&self, out: &mut dyn Write) -> io::Result<()> {
        let loads = self.loads.len();
        writeln!(out, "{}: {loads} loads, area, kappa and kappa_r with resolved edges", self.subject.line())?;
        write_rows(self.subject.rows(self.units, self.is_verbose), out)?;
        writeln!(
            out,
            "\n{:>12} {:>12} {:>12} {:>9} {:>9} {:>8} {:>8} {:>8} {:>9}",
            "p*", "pressure", "mean gap", "area", "counted", "kappa", "kappa_r", "patches", "eta"
        )?;
        self.loads.iter().try_for_each(|Finding { observables: it, .. }| {
            writeln!(
                out,
                "{:>12.4e} {:>12.4e} {:>12.4e} {:>9} {:>9.5} {:>8} {:>8} {:>8} {:>9.1e}",
                it.reduced_pressure,
                it.mean_pressure,
                it.mean_gap,
                word(it.resolved_area(), 5),
                it.relative_area_counted,
                word(it.resolved_kappa(), 4),
                word(it.resolved_kappa_r(), 4),
                it.patches,
                it.certificate
            )
        })?;
        let flowing = self.loads.iter().filter_map(|it| Some((it.observables.reduced_pressure, it.flow.as_ref()?)));
        flowing.enumerate().try_for_each(|(i, (reduced_pressure, flow))| {
            let rows = flow.rows(self.units);
            let names = rows.iter().map(|(name, _)| format!("  {name}"));
            if i == 0 {
                writeln!(out, "\n{:>12}{}", "p*", names.collect::<String>())?;
            }
            let values = rows.iter().map(|(_, value)| format!("  {value}"));
            writeln!(out, "{reduced_pressure:>12.4e}{}", values.collect::<String>())
        })
    }
}

/// A number with some digits; a dash where it is not resolved.
fn word(value: Option<f64>, digits: usize) -> String {
    value.map_or("-".into(), |value| format!("{value:.digits$}"))
}
