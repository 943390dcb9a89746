//! Contact from first touch to full, load by load, recorded as it goes.

use super::parameters::{Parameters, PartOf};
use super::report::{Point, Sweep, Values};
use super::session::{Fault, Turn};
use crate::contact::{Contact, Multilevel, Problem, Solver, Step};
use crate::error::SolveError;
use crate::record::{Curve, Live, LoadRecording, Loads, Options, Scene};
use crate::theory::persson;
use std::ops::ControlFlow;

/// Loads of a sweep: `p*` from its first value on, so many to a decade, up to the last if contact is not full before.
const FIRST: f64 = 1e-4;
const LAST: f64 = 1e2;
const PER_DECADE: f64 = 12.0;
/// Contact counts as full from this share of the area on.
const FULL: f64 = 0.9999;
/// Below so many nodes in contact the numbers mean little.
const FEWEST_NODES: usize = 4;

/// A curve of the recording: its view, name and colour, and what it shows of a point.
type Drawn = (&'static str, &'static str, [u8; 3], fn(&Point) -> f64);

const AREA: &str = "Relative area, 12 loads a decade from p* = 1e-4";
const KAPPA: &str = "kappa_r and kappa over the same loads";
const BLUE: [u8; 3] = [0x56, 0xb4, 0xe9];
const ORANGE: [u8; 3] = [0xe6, 0x9f, 0x00];
const GREY: [u8; 3] = [0x80; 3];
const BLACK: [u8; 3] = [0; 3];

/// Curves of every sweep, and behind them those of an exact solution.
const CURVES: [Drawn; 5] = [
    (AREA, "a_rel", BLUE, |point| point.area),
    (AREA, "Persson", GREY, |point| point.persson),
    (KAPPA, "kappa_r", ORANGE, |point| point.kappa_r),
    (KAPPA, "kappa", BLUE, |point| point.kappa),
    (KAPPA, "Persson", GREY, |point| point.persson / point.load),
];
const EXACT: [Drawn; 2] = [
    (AREA, "exact", BLACK, |point| point.exact.as_ref().map_or(f64::NAN, |exact| exact.relative_area)),
    (KAPPA, "exact kappa_r", BLACK, |point| point.exact.as_ref().and_then(|exact| exact.kappa_r).unwrap_or(f64::NAN)),
];

/// Solves load after load, each from the contact before, until contact is full or the turn over.
pub(super) fn run(turn: Turn<'_>, parameters: &Parameters) -> Result<(), Fault> {
    let loads: Vec<f64> = loads().collect();
    let problem = Parameters::at_load(parameters.problem()?, FIRST)?;
    let curves: Vec<Drawn> = match parameters.exact(&problem) {
        Some(_) => CURVES.into_iter().chain(EXACT).collect(),
        None => CURVES.to_vec(),
    };
    let problem = Parameters::at_load(problem, heaviest(&loads))?;
    let sweep = Sweep {
        id: format!("sweep-{}", turn.number()),
        title: format!("{}, load sweep", parameters.name()),
        parameters: parameters.clone(),
        ended: false,
        points: Vec::new(),
    };
    let (recording, live) = record(&sweep, &problem, &loads, &curves)?;
    turn.keep(sweep.id.clone(), live);
    turn.show_sweep(sweep.clone());
    let mut press = Press { turn, sweep, recording: &recording, curves: &curves };
    let pressed = press.all(problem, &loads);
    let sweep = Sweep { ended: true, ..press.sweep };
    recording.finish()?;
    turn.show_sweep(sweep);
    pressed
}

fn loads() -> impl Iterator<Item = f64> {
    let steps = (PER_DECADE * (LAST / FIRST).log10()).round() as i32;
    (0..=steps).map(|i| FIRST * 10f64.powf(f64::from(i) / PER_DECADE))
}

/// The load that the pictures have room for: contact is full there, if the surface is rough.
fn heaviest(loads: &[f64]) -> f64 {
    let is_full = |load: &f64| persson::relative_area(*load) >= FULL;
    loads.iter().copied().find(is_full).unwrap_or(LAST)
}

/// Begins the recording: the pictures that were asked for, and always curves and contact.
fn record(
    Sweep { id, title, parameters, .. }: &Sweep,
    problem: &Problem,
    loads: &[f64],
    curves: &[Drawn],
) -> Result<(LoadRecording, Live), Fault> {
    let description = parameters.description();
    let contact = Scene { name: "contact".into(), title: title.clone(), problem, description, exact: None };
    let curve = |&(view, name, colour, _): &Drawn| Curve { view: view.into(), name: name.into(), colour };
    let loads = Loads {
        title: title.clone(),
        description: format!("{}, each load from the contact before, until contact is full.", parameters.description()),
        captions: loads.iter().map(|load| format!("p* = {load:.3e}")).collect(),
        curves: curves.iter().map(curve).collect(),
        figure: None,
        scenes: &[contact],
    };
    let record = [PartOf::Traces, PartOf::Mask].into_iter().chain(parameters.record.clone()).collect();
    let what = Parameters { record, ..parameters.clone() }.parts();
    Ok(LoadRecording::live(id, &loads, Options { what, ..Options::default() })?)
}

/// A sweep on its way.
struct Press<'a> {
    turn: Turn<'a>,
    sweep: Sweep,
    recording: &'a LoadRecording,
    curves: &'a [Drawn],
}

impl Press<'_> {
    /// Solves and records load after load.
    fn all(&mut self, mut problem: Problem, loads: &[f64]) -> Result<(), Fault> {
        let (turn, stop) = (self.turn, self.sweep.parameters.stop()?);
        let mut watch = |_: &Step<'_>| if turn.goes_on() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) };
        let mut start = None;
        for (number, &load) in loads.iter().enumerate() {
            problem = Parameters::at_load(problem, load)?;
            let solved = Multilevel.solve_from(start.as_ref(), &problem, &stop, &mut watch);
            let contact = solved.or_else(SolveError::into_contact)?;
            if !turn.goes_on() {
                break;
            }
            self.show(number, point(&self.sweep.parameters, &problem, &contact, load), &contact)?;
            if self.sweep.points.last().is_some_and(|point| point.area >= FULL) {
                break;
            }
            start = Some(contact.pressure);
        }
        Ok(())
    }

    /// Records load number `number`, from 0 on, and reports it.
    fn show(&mut self, number: usize, point: Option<Point>, contact: &Contact) -> Result<(), Fault> {
        self.recording.contact(0, number, contact)?;
        if let Some(point) = point {
            let values: Vec<f64> = self.curves.iter().map(|(.., of)| of(&point)).collect();
            self.recording.values(number, &values)?;
            self.sweep.points.push(point);
            self.turn.show_sweep(self.sweep.clone());
        }
        Ok(())
    }
}

/// What is drawn of a contact, if it is more than a few nodes.
fn point(parameters: &Parameters, problem: &Problem, contact: &Contact, load: f64) -> Option<Point> {
    let measures = contact.measures(problem);
    let exact = parameters.exact(problem);
    (measures.contact_nodes >= FEWEST_NODES).then(|| Point {
        load,
        area: measures.relative_area_corrected,
        kappa: measures.relative_area_corrected / measures.reduced_pressure,
        kappa_r: measures.kappa_r_corrected,
        persson: persson::relative_area(load),
        exact: exact.as_ref().map(Values::of),
    })
}
