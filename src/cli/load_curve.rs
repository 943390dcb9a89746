//! `asperity solve` under one load after the other.

use super::exit_status::{ExitStatus, Interrupted, settle, usage};
use super::finding::Finding;
use super::flow::FlowFinding;
use super::interrupt::{Interruption, interrupted};
use super::output::{write_json, write_rows};
use super::outputs::Outputs;
use super::picture;
use super::problem_summary::ProblemSummary;
use super::progress::Progress;
use super::solve_plan::{self, SolvePlan};
use super::units::Units;
use super::warnings;
use super::wrote::wrote;
use anyhow::Result;
use asperity::contact::{Observables, Problem, State, Status, archive_of_states, warnings_of};
use asperity::error::FileError;
use asperity::files::write_beside;
use asperity::job::CurveRecording;
use asperity::job::{LoadNumbers, write_loads};
use asperity::setup::{Part, SetupTable};
use asperity::study::LoadCurve;
use serde::Serialize;
use std::io::{self, Write, stdout};
use std::path::Path;
use std::sync::Arc;

/// Everything that a script may want to know about contacts under one load after the other, and the setup that repeats them.
#[derive(Serialize)]
struct LoadCurveSummary {
    #[serde(flatten)]
    subject: ProblemSummary,
    loads: Vec<Finding>,
    warnings: Vec<String>,
    setup: SetupTable,
    #[serde(skip)]
    units: Units,
}

/// The findings under all loads, their contacts, and how the solves ended.
struct Pressed {
    findings: Vec<Finding>,
    /// The contacts, if their fields are to be written.
    states: Vec<State>,
    outcome: ExitStatus,
    /// Why the recording could not be finished, if it could not. The contacts are complete in any case.
    failure: Option<FileError>,
}

/// Solves the contacts of a curve, and writes and prints them.
pub fn run(curve: &LoadCurve, outputs: &Outputs, units: Units, is_dry: bool) -> Result<ExitStatus> {
    if outputs.live {
        return usage(
            "--live shows the steps under one load, but several are given: give one load, or use --record FILE.rrd",
        );
    }
    if curve.setup.record.every.is_some() {
        return usage(
            "--record-every is for the steps under one load, but the contact under each load is recorded: leave it out",
        );
    }
    if let Some(part) = curve.setup.record.what.iter().find(|part| Part::OF_A_RUN.contains(part)) {
        let part = part.name();
        return usage(format!(
            "the recording part {part} shows the steps under one load, but several are given: give one load, or \
             leave the part out"
        ));
    }
    let cost = curve.cost(&outputs.extras(curve.loads.len()))?;
    outputs.check()?;
    if is_dry {
        let (loads, is_recorded) = (Some(curve.loads.len()), outputs.recording().is_some());
        let plan = SolvePlan { setup: &curve.setup, cost: &cost, loads, is_recorded, is_passed_twice: false };
        solve_plan::write(&plan, &mut stdout())?;
    }
    cost.check(curve.setup.solver.name())?;
    if is_dry {
        return Ok(ExitStatus::Done);
    }
    let problem = curve.problem()?;
    if outputs.strict {
        let warnings = warnings::in_flags(&curve.setup.surface.warnings(problem.surface()));
        warnings::refuse_if_strict(&warnings, true)?;
    }
    let mut pressed = press(curve, &problem, outputs)?;
    let (outcome, failure) = (pressed.outcome, pressed.failure.take());
    let is_whole = |path: &&Path| failure.is_none() || Some(*path) != outputs.recording();
    let solved = LoadCurve { loads: curve.loads[..pressed.findings.len()].into(), ..curve.clone() };
    write(&solved, &problem, pressed, outputs, units)?;
    outputs.files().filter(is_whole).for_each(wrote);
    if outcome == ExitStatus::Interrupted {
        warnings::print(&[format!(
            "interrupted: {} of {} loads were solved and written",
            solved.loads.len(),
            curve.loads.len()
        )]);
    }
    failure.map_or(Ok(outcome), |failure| Err(failure.into()))
}

/// Solves and records the contacts. Ctrl-C ends it after the last load that is solved.
fn press(curve: &LoadCurve, problem: &Problem, outputs: &Outputs) -> Result<Pressed> {
    let mut recording = outputs.recording().map(|path| CurveRecording::create(path, curve, problem)).transpose()?;
    let mut pressed = Pressed { findings: Vec::new(), states: Vec::new(), outcome: ExitStatus::Done, failure: None };
    let title = |number: usize| format!("load {} of {}", number + 1, curve.loads.len());
    let interrupted = interrupted()?;
    let ended = curve.press(
        problem,
        |number| (Interruption(Arc::clone(&interrupted)), Progress::new(&title(number))),
        |_, contact| -> Result<()> {
            if contact.status == Status::StoppedByObserver {
                return Err(Interrupted.into());
            }
            outputs.complete(contact);
            pressed.outcome = pressed.outcome.max(settle(contact)?);
            let flow = FlowFinding::new(contact, &curve.setup.flow, outputs.archive().is_some())?;
            let mut finding = Finding { flow, ..Finding::new(&curve.setup, contact) };
            if let Some(Err(failure)) =
                recording.as_ref().map(|it| it.add(pressed.findings.len(), contact, &finding.observables))
            {
                recording = None;
                pressed.failure = Some(failure);
            }
            let fields = finding.flow.iter_mut().flat_map(|it| std::mem::take(&mut it.fields)).collect();
            let state = || State { fields, ..State::from_contact(contact.clone(), Some(pressed.findings.len())) };
            pressed.states.extend(outputs.archive().map(|_| state()));
            pressed.findings.push(finding);
            Ok(())
        },
    );
    match ended {
        Err(error) if error.is::<Interrupted>() && !pressed.findings.is_empty() => {
            pressed.outcome = ExitStatus::Interrupted
        }
        ended => ended?,
    }
    if let Some(Err(failure)) = recording.map(CurveRecording::finish) {
        pressed.failure = Some(failure);
    }
    Ok(pressed)
}

/// Writes and prints what came out.
fn write(curve: &LoadCurve, problem: &Problem, pressed: Pressed, outputs: &Outputs, units: Units) -> Result<()> {
    let (subject, setup) = (ProblemSummary::new(&curve.setup, problem)?, curve.to_table());
    let Pressed { findings, states, .. } = pressed;
    let observables: Vec<&Observables> = findings.iter().map(|it| &it.observables).collect();
    let mut warnings = curve.setup.surface.warnings(problem.surface());
    warnings.extend(warnings_of(&observables, problem.law()));
    // a grid is found under one load only: several take a number
    let refinements = warnings.iter_mut().flat_map(|it| &mut it.remedies).filter(|it| it.key == "grid.refine");
    refinements.for_each(|it| it.value = None);
    let warnings = warnings::in_flags(&warnings);
    warnings::refuse_if_strict(&warnings, outputs.strict)?;
    if let Some(path) = outputs.archive() {
        let bytes = archive_of_states(&states, subject.rank, &setup.to_toml());
        write_beside(path, |file| file.write_all(&bytes.map_err(io::Error::other)?))?;
    }
    if let Some(path) = outputs.table() {
        write_loads(path, &findings.iter().map(numbers_of).collect::<Vec<_>>())?;
    }
    if let Some(path) = outputs.picture() {
        picture::write(path, &picture::of_loads(&subject.title, &observables, units))?;
    }
    if let Some(path) = &outputs.save_setup {
        setup.write(path)?;
    }
    let summary = LoadCurveSummary { subject, loads: findings, warnings, setup, units };
    if outputs.json {
        write_json(&summary, &mut stdout())?
    } else {
        summary.write_text(&mut stdout())?
    }
    warnings::print(&summary.warnings);
    Ok(())
}

/// The numbers of a finding for a table.
fn numbers_of(finding: &Finding) -> LoadNumbers<'_> {
    let flow = finding.flow.as_ref().map_or(&[][..], |it| &it.numbers);
    LoadNumbers { status: finding.status, observables: &finding.observables, flow }
}

impl LoadCurveSummary {
    /// Writes the summary for reading.
    fn write_text(&self, out: &mut impl Write) -> io::Result<()> {
        let loads = self.loads.len();
        writeln!(out, "{}: {loads} loads, area, kappa and kappa_r with resolved edges", self.subject.line())?;
        write_rows(self.subject.rows(self.units), out)?;
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
