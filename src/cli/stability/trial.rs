//! One case by one solver, judged.

use super::case::{Case, Solved};
use super::check::Check;
use super::row::Row;
use super::verdict::{Demand, Verdict};
use crate::cli::contender::Contender;
use crate::cli::is_input;
use anyhow::Result;
use asperity::contact::Status;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Duration;

/// By how much dimensionless results may differ between units.
const UNITS: f64 = 1e-10;
/// By how much a solver's certificate may differ from the checked one, besides rounding.
const AGREEMENT: f64 = 1e-6;

/// Runs `case` by `method` and judges what comes of it.
pub fn run(case: &Case, method: Contender, budget: Duration) -> Row {
    let demand = case.demand_of(method);
    let row = |verdict, note| Row::empty(case.name.clone(), method.name(), verdict, note);
    let row = match catch_unwind(AssertUnwindSafe(|| attempt(case, method, budget))) {
        Ok(Ok((solved, mismatch))) => {
            let check = Check::of(&solved.problem, solved.contact.pressure.as_slice().unwrap_or_default());
            let fault = fault(&solved, &check, case.tolerance).or(mismatch);
            let (verdict, note) = judge(solved.contact.status, demand, fault);
            row(verdict, note).with(&solved, &check)
        }
        Ok(Err(error)) if is_input(&error) => row(Verdict::Refused, error.to_string()),
        Ok(Err(error)) => row(Verdict::Wrong, error.to_string()),
        Err(panic) => row(Verdict::Wrong, format!("panic: {}", message(panic.as_ref()))),
    };
    let as_demanded = demand.is_met(row.verdict, row.eta, row.status == Some(Status::Stalled));
    row.demanded(as_demanded)
}

/// Solves the case, and says how it differs from the contact that it must be like.
fn attempt(case: &Case, method: Contender, budget: Duration) -> Result<(Solved, Option<String>)> {
    let solved = case.solve(method, budget)?;
    let twin = case.solve_twin(method, budget)?;
    let mismatch = twin.and_then(|twin| mismatch(&solved, &twin));
    Ok((solved, mismatch))
}

/// What is wrong with a returned contact.
fn fault(solved: &Solved, check: &Check, tolerance: f64) -> Option<String> {
    let is_converged = solved.contact.status == Status::Converged;
    let doubt = || check.doubt(tolerance).filter(|_| is_converged);
    check.fault().or_else(|| disagreement(solved, check)).or_else(doubt)
}

/// The verdict, and what is wrong or why it has not converged.
fn judge(status: Status, demand: Demand, fault: Option<String>) -> (Verdict, String) {
    match fault {
        Some(fault) => (Verdict::Wrong, fault),
        None if demand == Demand::Refusal => (Verdict::Wrong, "this cannot be solved".into()),
        None if status == Status::Converged => (Verdict::Converged, String::new()),
        None => (Verdict::NotConverged, status.to_string()),
    }
}

/// What the solver says of its result that the check does not find.
fn disagreement(solved: &Solved, check: &Check) -> Option<String> {
    let contact = &solved.contact;
    if contact.displacement.iter().chain(&contact.gap).any(|value| !value.is_finite()) {
        return Some("the displacement or the gap is not finite".into());
    }
    let said = contact.certificate.eta;
    let differs = (said - check.eta).abs() > AGREEMENT * check.eta + check.rounding;
    (said.is_nan() || differs).then(|| format!("the certificate is said to be {said:.1e}, but is {:.1e}", check.eta))
}

/// How dimensionless results differ, if they do and both have converged.
fn mismatch(solved: &Solved, twin: &Solved) -> Option<String> {
    if [solved, twin].iter().any(|solved| solved.contact.status != Status::Converged) {
        return None;
    }
    let [a, b] = [solved, twin].map(|Solved { problem, contact }| {
        let measures = contact.measures(problem);
        let mean = problem.mean_pressure_of(contact.pressure.as_slice().unwrap_or_default());
        (measures.relative_area, measures.kappa_r, &contact.pressure / mean)
    });
    let largest = b.2.fold(0.0, |most: f64, p| most.max(p.abs()));
    let pressure = (&a.2 - &b.2).fold(0.0, |most: f64, p| most.max(p.abs())) / largest;
    let differences = [("area", (a.0 / b.0 - 1.0).abs()), ("kappa_r", (a.1 / b.1 - 1.0).abs()), ("pressure", pressure)];
    let worst = differences.into_iter().find(|(_, difference)| difference.is_nan() || *difference > UNITS)?;
    Some(format!("the {} differs by {:.1e} from that in other units", worst.0, worst.1))
}

/// What a panic says.
fn message(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("without a message")
}
