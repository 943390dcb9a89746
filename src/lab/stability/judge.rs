//! One trial of one solver, judged.

use super::check::Check;
use super::report::Report;
use super::trial::Trial;
use super::verdict::{Demand, Verdict};
use crate::contact::Contact;
use crate::error::{SetupError, SolveError};
use crate::lab::{Rival, Watch};
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Duration;

/// By how much dimensionless results may differ between units.
const UNITS: f64 = 1e-10;
/// By how much a solver's certificate may differ from the checked one, besides rounding.
const AGREEMENT: f64 = 1e-6;

/// Solves a trial within a budget of time, checks what comes back, and judges it.
pub fn judge(trial: &Trial, rival: &Rival, budget: Duration, watch: &mut Watch<'_>) -> Report {
    let report = |found, verdict, note| Report::new(trial, rival, found, verdict, note);
    match catch_unwind(AssertUnwindSafe(|| trial.solve(rival, budget, watch))) {
        Ok(Ok((contact, twin))) => {
            let check = Check::of(&contact.problem, contact.pressure.as_slice().unwrap_or_default());
            let mismatch = || twin.and_then(|twin| mismatch(&contact, &twin));
            let fault = fault(&contact, &check, trial.tolerance).or_else(mismatch);
            let (verdict, note) = match fault {
                Some(fault) => (Verdict::Wrong, fault),
                None if trial.demand_of(rival) == Demand::Refusal => (Verdict::Wrong, "this cannot be solved".into()),
                None if contact.is_converged() => (Verdict::Converged, String::new()),
                None => (Verdict::NotConverged, contact.status.to_string()),
            };
            report(Some((&contact, &check)), verdict, note)
        }
        Ok(Err(SetupError::Solve(error @ (SolveError::NotConverged { .. } | SolveError::Observer(_))))) => {
            report(None, Verdict::Wrong, error.to_string())
        }
        Ok(Err(error)) => report(None, Verdict::Refused, error.to_string()),
        Err(panic) => report(None, Verdict::Wrong, format!("panic: {}", message(panic.as_ref()))),
    }
}

/// The fault of a returned contact, if it has one.
fn fault(contact: &Contact, check: &Check, tolerance: f64) -> Option<String> {
    let doubt = || check.doubt(tolerance).filter(|_| contact.is_converged());
    check.fault().or_else(|| disagreement(contact, check)).or_else(doubt)
}

/// The claim of a solver about its result that the check does not confirm.
fn disagreement(contact: &Contact, check: &Check) -> Option<String> {
    if contact.displacement.iter().chain(&contact.gap).any(|value| !value.is_finite()) {
        return Some("the displacement or the gap is not finite".into());
    }
    let said = contact.certificate.eta;
    let differs = (said - check.eta).abs() > AGREEMENT * check.eta + check.rounding;
    (said.is_nan() || differs).then(|| format!("the certificate is said to be {said:.1e}, but is {:.1e}", check.eta))
}

/// How dimensionless results differ, if they do and both have converged.
fn mismatch(contact: &Contact, twin: &Contact) -> Option<String> {
    if !(contact.is_converged() && twin.is_converged()) {
        return None;
    }
    let [a, b] = [contact, twin].map(|contact| {
        let measures = contact.measures();
        let mean = contact.problem.mean_pressure_of(contact.pressure.as_slice().unwrap_or_default());
        (measures.relative_area, measures.kappa_r, &contact.pressure / mean)
    });
    let largest = b.2.fold(0.0, |most: f64, p| most.max(p.abs()));
    let pressure = (&a.2 - &b.2).fold(0.0, |most: f64, p| most.max(p.abs())) / largest;
    let differences = [("area", (a.0 / b.0 - 1.0).abs()), ("kappa_r", (a.1 / b.1 - 1.0).abs()), ("pressure", pressure)];
    let worst = differences.into_iter().find(|(_, difference)| difference.is_nan() || *difference > UNITS)?;
    Some(format!("the {} differs by {:.1e} from that in other units", worst.0, worst.1))
}

/// The message of a panic.
fn message(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("without a message")
}
