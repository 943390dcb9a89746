//! A sweep of the load from first touch to full contact, recorded load by load.

use super::knobs::Knobs;
use super::motion::Motion;
use super::report::{ExactNumbers, SweepPoint, SweepReport, file_stem};
use super::section::Section;
use super::session::Turn;
use super::session_recording::SessionRecording;
use crate::contact::{Contact, Each, Failure, Law, Load, Multilevel, Observables, Problem, Solver, Step};
use crate::error::ProblemError;
use crate::plot::Colour;
use crate::record::{CurveKind, LoadAxis, LoadRecording, Loads, Output, RecordedCurve, Scene};
use crate::setup::{Part, Setup, Solid};
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

/// A curve of the recording: its view, name, kind and colour, and its value at a point.
type PointCurve = (&'static str, &'static str, CurveKind, Colour, fn(&SweepPoint) -> f64);

const AREA: &str = "Relative area a_rel";
const KAPPA_R: &str = "kappa_r";
const KAPPA: &str = "kappa";
const GREY: Colour = Colour([0x80; 3]);

/// Curves of every sweep, behind them those of Persson's theory where it applies, and those of an exact solution where there is one.
const CURVES: [PointCurve; 3] = [
    (AREA, "a_rel", CurveKind::Computed, Colour::SKY, |point| point.observables.resolved_area().unwrap_or(f64::NAN)),
    (KAPPA_R, "kappa_r", CurveKind::Computed, Colour::ORANGE, |point| {
        point.observables.resolved_kappa_r().unwrap_or(f64::NAN)
    }),
    (KAPPA, "kappa", CurveKind::Computed, Colour::SKY, |point| point.observables.resolved_kappa().unwrap_or(f64::NAN)),
];
const PERSSON: [PointCurve; 2] = [
    (AREA, "Persson", CurveKind::Theory, GREY, |point| point.persson.unwrap_or(f64::NAN)),
    (KAPPA, "Persson", CurveKind::Theory, GREY, |point| {
        point.persson.unwrap_or(f64::NAN) / point.observables.reduced_pressure
    }),
];
const EXACT: [PointCurve; 2] = [
    (AREA, "exact", CurveKind::Exact, Colour::GREEN, |point| {
        point.exact.as_ref().map_or(f64::NAN, |exact| exact.relative_area)
    }),
    (KAPPA_R, "exact kappa_r", CurveKind::Exact, Colour::GREEN, |point| {
        point.exact.as_ref().and_then(|exact| exact.kappa_r).unwrap_or(f64::NAN)
    }),
];

/// Solves one load after the other, each from the previous contact, until the contact is full or the turn is over.
pub fn run(turn: Turn<'_>, knobs: Knobs, setup: Setup) -> Result<(), Failure> {
    let loads: Vec<f64> = loads().collect();
    let problem = at_load(&setup.problem()?, FIRST)?;
    let persson = is_rough_flat(&setup).then_some(PERSSON).into_iter().flatten();
    let exact = exact(&setup, &problem).map(|_| EXACT).into_iter().flatten();
    let curves: Vec<PointCurve> = CURVES.into_iter().chain(persson).chain(exact).collect();
    let surface = setup.surface.title(problem.surface().grid());
    let report = SweepReport {
        id: format!("sweep-{}", turn.number),
        file_stem: file_stem(&surface, "sweep", Multilevel.name()),
        title: format!("{surface}, load sweep"),
        knobs,
        ended: false,
        points: Vec::new(),
    };
    let heaviest = at_load(&problem, heaviest(&loads))?;
    let (recording, live) = record(turn, &report, &setup, &heaviest, &loads, &curves)?;
    turn.keep(SessionRecording::new(&report.id, &report.file_stem, live));
    let mut press = Press {
        turn,
        setup: &setup,
        report,
        recording: &recording,
        curves: &curves,
        row: None,
        motion: Motion::default(),
    };
    press.publish();
    let pressed = press.all(&problem, &loads);
    press.report.ended = true;
    let Press { report, motion, .. } = press;
    recording.finish()?;
    turn.finish_sweep(report, motion);
    pressed
}

fn loads() -> impl Iterator<Item = f64> {
    let steps = (PER_DECADE * (LAST / FIRST).log10()).round() as i32;
    (0..=steps).map(|i| FIRST * 10f64.powf(f64::from(i) / PER_DECADE))
}

/// Whether Persson's theory is about a surface: it is for rough flats on an elastic half-space, random or measured.
fn is_rough_flat(setup: &Setup) -> bool {
    let Setup { surface, solid, law, .. } = setup;
    let is_half_space = !matches!(solid, Some(Solid::Layer { .. }));
    let is_rough = surface.spectrum.is_some() || surface.height.is_some();
    is_half_space && *law == Law::HardWall && is_rough && surface.indenter.is_none()
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

/// Begins the recording: the requested pictures, and always curves and contact.
fn record(
    turn: Turn<'_>,
    report: &SweepReport,
    setup: &Setup,
    problem: &Problem,
    loads: &[f64],
    curves: &[PointCurve],
) -> Result<(LoadRecording, Output), Failure> {
    let (title, description) = (report.title.clone(), setup.surface.description());
    let loads = Loads {
        title: title.clone(),
        description: format!("{description}, each load solved from the previous contact, until the contact is full."),
        axis: LoadAxis::log("p*", loads.to_vec()),
        captions: loads.iter().map(|load| Load::ReducedPressure(*load).to_string()).collect(),
        curves: curves
            .iter()
            .map(|&(view, name, kind, colour, _)| RecordedCurve {
                view: view.into(),
                name: name.into(),
                colour: colour.0,
                kind,
            })
            .collect(),
        figure: None,
        scenes: &[Scene { title, exact: None, ..Scene::from_setup(setup, problem) }],
    };
    let mut parts = setup.record.clone();
    parts.what.extend([Part::Traces, Part::Mask]);
    Ok(LoadRecording::live(&report.id, &loads, turn.options(&parts))?)
}

/// A running sweep.
struct Press<'a> {
    turn: Turn<'a>,
    setup: &'a Setup,
    report: SweepReport,
    recording: &'a LoadRecording,
    curves: &'a [PointCurve],
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
        let mut start = None;
        for (number, &load) in loads.iter().enumerate() {
            let problem = at_load(problem, load)?;
            let contact = Multilevel.solve_from(start.as_ref(), &problem, &self.setup.stop, &mut watch)?;
            if !turn.goes_on() {
                break;
            }
            self.show(number, load, &contact)?;
            if self.report.points.last().is_some_and(|point| point.observables.relative_area >= FULL) {
                break;
            }
            start = Some(contact.pressure);
        }
        Ok(())
    }

    /// Records load number `number`, from 0 on, and reports it if it is more than a few nodes.
    fn show(&mut self, number: usize, load: f64, contact: &Contact) -> Result<(), Failure> {
        self.recording.contact(0, number, contact)?;
        if contact.counted().contact_nodes < FEWEST_NODES {
            return Ok(());
        }
        let point = SweepPoint {
            number,
            observables: Observables::new(contact),
            persson: is_rough_flat(self.setup).then(|| persson::relative_area(load)),
            exact: exact(self.setup, &contact.problem).as_ref().map(ExactNumbers::from),
        };
        let values: Vec<f64> = self.curves.iter().map(|(.., of)| of(&point)).collect();
        self.recording.values(number, &values)?;
        self.report.points.push(point);
        let row = *self.row.get_or_insert_with(|| contact.highest_row());
        self.motion.add_load(number, Section::from_load(contact, row));
        self.publish();
        Ok(())
    }

    fn publish(&self) {
        self.turn.update_report(|news| news.sweep = Some(self.report.clone()));
    }
}
