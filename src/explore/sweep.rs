//! A sweep of the load from first touch to full contact, recorded load by load.

use super::hand::fast_solver;
use super::knobs::Knobs;
use super::motion::Motion;
use super::report::{ExactNumbers, SweepPoint, SweepReport, file_stem};
use super::section::Section;
use super::session::Turn;
use super::session_recording::SessionRecording;
use super::tape::SweepTape;
use crate::contact::{Contact, Each, Failure, Law, Load, Observables, Problem, Step};
use crate::error::ProblemError;
use crate::history::{Loading, Process};
use crate::setup::{Setup, Solid};
use crate::theory::{Exact, persson};
use std::ops::ControlFlow;

/// Loads of a sweep: first value of `p*`, loads per decade, and last value, unless contact is full before.
const FIRST: f64 = 1e-4;
const LAST: f64 = 1e2;
const PER_DECADE: f64 = 12.0;
/// Relative area from which the contact counts as full.
const FULL: f64 = 0.9999;
/// With fewer nodes in contact than this, the numbers are not accurate.
const FEWEST_NODES: usize = 4;

/// Solves one load after the other, each from the previous contact, until the contact is full or the turn is over.
pub(crate) fn run(turn: Turn<'_>, knobs: Knobs, setup: Setup) -> Result<(), Failure> {
    let loads: Vec<f64> = loads().collect();
    let problem = at_load(&setup.problem()?, FIRST)?;
    let theories = [is_rough_flat(&setup), exact(&setup, &problem).is_some()];
    let surface = setup.surface.title(problem.surface().grid());
    let [motion, for_files] = knobs.motion_in_words();
    let report = SweepReport {
        id: format!("sweep-{}", turn.number),
        file_stem: file_stem(&surface, &format!("sweep{for_files}"), fast_solver(&setup).name()),
        title: format!("{surface}, load sweep{motion}"),
        knobs,
        ended: false,
        points: Vec::new(),
    };
    let heaviest = at_load(&problem, heaviest(&loads))?;
    let (tape, live) = SweepTape::begin((&report, &setup, &heaviest), &loads, theories, turn.view())?;
    turn.keep(SessionRecording::new(&report.id, &report.file_stem, live));
    let mut press = Press { turn, setup: &setup, report, tape: &tape, row: None, motion: Motion::default() };
    press.publish();
    let pressed = press.all(&problem, &loads);
    press.report.ended = true;
    let Press { report, motion, .. } = press;
    tape.finish()?;
    turn.finish_sweep(report, motion);
    pressed
}

fn loads() -> impl Iterator<Item = f64> {
    let steps = (PER_DECADE * (LAST / FIRST).log10()).round() as i32;
    (0..=steps).map(|i| FIRST * 10f64.powf(f64::from(i) / PER_DECADE))
}

/// Whether Persson's theory is about a surface: it is for rough flats at rest on an elastic half-space, random or measured.
fn is_rough_flat(setup: &Setup) -> bool {
    let Setup { surface, solid, law, .. } = setup;
    let is_half_space = !matches!(solid, Some(Solid::Layer { .. }));
    let is_rough = surface.spectrum.is_some() || surface.height.is_some();
    let is_elastic = *law == Law::HardWall && setup.viscoelastic.is_none();
    is_half_space && is_elastic && is_rough && surface.indenter.is_none()
}

/// The load that the pictures have room for: contact is full there, if the surface is rough.
fn heaviest(loads: &[f64]) -> f64 {
    let is_full = |load: &f64| persson::relative_area(*load) >= FULL;
    loads.iter().copied().find(is_full).unwrap_or(LAST)
}

fn at_load(problem: &Problem, load: f64) -> Result<Problem, ProblemError> {
    problem.clone().with_load(Load::ReducedPressure(load))
}

fn exact(setup: &Setup, problem: &Problem) -> Option<Exact> {
    setup.exact(problem.surface().grid(), problem.expected_mean_pressure())
}

/// A running sweep.
struct Press<'a> {
    turn: Turn<'a>,
    setup: &'a Setup,
    report: SweepReport,
    tape: &'a SweepTape,
    /// The row of the sections, in which contact began.
    row: Option<usize>,
    motion: Motion,
}

impl Press<'_> {
    /// Solves and records load after load.
    fn all(&mut self, problem: &Problem, loads: &[f64]) -> Result<(), Failure> {
        let turn = self.turn;
        let mut watch =
            Each(|_: &Step<'_>| if turn.goes_on() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) });
        let setup = self.setup;
        let all = loads.iter().map(|load| Load::ReducedPressure(*load)).collect();
        let mut loading = Loading::new(problem.clone(), fast_solver(setup), setup.stop).along(all);
        for (number, &load) in loads.iter().enumerate() {
            let Some(state) = loading.next(&mut watch) else { break };
            let contact = state?.contact;
            if !turn.goes_on() {
                break;
            }
            self.show(number, load, &contact)?;
            if self.report.points.last().is_some_and(|point| point.observables.relative_area >= FULL) {
                break;
            }
        }
        Ok(())
    }

    /// Records load number `number`, from 0 on, and reports it if it is more than a few nodes.
    fn show(&mut self, number: usize, load: f64, contact: &Contact) -> Result<(), Failure> {
        self.tape.contact(number, contact)?;
        if contact.counted().contact_nodes < FEWEST_NODES {
            return Ok(());
        }
        let point = SweepPoint {
            number: number + 1,
            load,
            observables: Observables::new(contact),
            persson: is_rough_flat(self.setup).then(|| persson::relative_area(load)),
            exact: exact(self.setup, &contact.problem).as_ref().map(ExactNumbers::from),
        };
        self.tape.point(&point)?;
        self.report.points.push(point);
        let row = *self.row.get_or_insert_with(|| contact.highest_row());
        self.motion.add_load(number + 1, Section::from_load(contact, row));
        self.publish();
        Ok(())
    }

    fn publish(&self) {
        self.turn.update_report(|news| news.sweep = Some(self.report.clone()));
    }
}
