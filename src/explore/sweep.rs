//! Contact from first touch to full, load by load.

use super::parameters::{Parameters, Refusal};
use super::report::{Point, Sweep, Values};
use super::session::Turn;
use crate::contact::{Contact, Multilevel, Problem, Solver, Step};
use crate::error::SolveError;
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

/// Solves load after load, each from the contact before, until contact is full or the turn over.
pub(super) fn run(turn: Turn<'_>, parameters: &Parameters) -> Result<(), Refusal> {
    let stop = parameters.stop()?;
    let mut problem = parameters.problem()?;
    let mut sweep = Sweep { title: parameters.title(), ended: false, points: Vec::new() };
    let mut start = None;
    let mut watch = |_: &Step<'_>| if turn.goes_on() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) };
    for load in loads() {
        problem = Parameters::at_load(problem, load)?;
        let solved = Multilevel.solve_from(start.as_ref(), &problem, &stop, &mut watch);
        let contact = solved.or_else(SolveError::into_contact).map_err(|error| Refusal(error.to_string()))?;
        if !turn.goes_on() {
            break;
        }
        sweep.points.extend(point(parameters, &problem, &contact, load));
        sweep.ended = sweep.points.last().is_some_and(|point| point.area >= FULL);
        turn.show_sweep(sweep.clone());
        if sweep.ended {
            return Ok(());
        }
        start = Some(contact.pressure);
    }
    sweep.ended = true;
    turn.show_sweep(sweep);
    Ok(())
}

fn loads() -> impl Iterator<Item = f64> {
    let steps = (PER_DECADE * (LAST / FIRST).log10()).round() as i32;
    (0..=steps).map(|i| FIRST * 10f64.powf(f64::from(i) / PER_DECADE))
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
