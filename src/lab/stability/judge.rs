//! One trial of one solver, judged.

use super::check::Check;
use super::report::TrialReport;
use super::trial::{EquivalentContact, Trial};
use super::verdict::{Demand, TrialVerdict};
use crate::contact::Contact;
use crate::error::{SetupError, SolveError};
use crate::lab::{ObserverMaker, Rival};
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Duration;

/// By how much dimensionless results may differ between units.
const UNITS: f64 = 1e-10;
/// By how much a solver's certificate may differ from the checked one, besides rounding.
const AGREEMENT: f64 = 1e-6;

/// Solves a trial within a budget of time, checks what comes back, and judges it.
pub fn judge(trial: &Trial, rival: &Rival, budget: Duration, watch: ObserverMaker) -> TrialReport {
    let report = |found, verdict, note| TrialReport::new(trial, rival, found, verdict, note);
    match catch_unwind(AssertUnwindSafe(|| trial.solve(rival, budget, watch))) {
        Ok(Ok((contact, twin))) => {
            let check = Check::new(&contact.problem, contact.pressure.as_slice().unwrap_or_default());
            let mismatch = || twin.as_ref().and_then(|twin| mismatch(trial, &contact, twin));
            let unsolved_twin = twin.as_ref().filter(|twin| !twin.is_converged());
            let (verdict, note) = match fault(trial, &contact, &check).or_else(mismatch) {
                Some(fault) => (TrialVerdict::Wrong, fault),
                None if trial.demand_of(rival) == Demand::Refusal => {
                    (TrialVerdict::Wrong, "this case cannot be solved".into())
                }
                None if !contact.is_converged() => (TrialVerdict::NotConverged, contact.status.to_string()),
                None => match unsolved_twin {
                    Some(twin) => (TrialVerdict::NotConverged, format!("second solve: {}", twin.status)),
                    None => (TrialVerdict::Converged, String::new()),
                },
            };
            report(Some((&contact, &check)), verdict, note)
        }
        Ok(Err(SetupError::Solve(error @ (SolveError::NotConverged { .. } | SolveError::Observer(_))))) => {
            report(None, TrialVerdict::Wrong, error.to_string())
        }
        Ok(Err(error)) => report(None, TrialVerdict::Refused, error.to_string()),
        Err(panic) => report(None, TrialVerdict::Wrong, format!("panic: {}", message(panic.as_ref()))),
    }
}

/// The fault of a returned contact, if it has one.
fn fault(trial: &Trial, contact: &Contact, check: &Check) -> Option<String> {
    let doubt = || check.doubt(trial.tolerance, trial.pressure_tolerance).filter(|_| contact.is_converged());
    check.fault().or_else(|| disagreement(contact, check)).or_else(doubt)
}

/// The claim of a solver about its result that the check does not confirm.
fn disagreement(contact: &Contact, check: &Check) -> Option<String> {
    if contact.displacement.iter().chain(&contact.gap).any(|value| !value.is_finite()) {
        return Some("the displacement or the gap is not finite".into());
    }
    let said = contact.certificate.eta;
    let differs = (said - check.eta).abs() > AGREEMENT * check.eta + check.rounding;
    (said.is_nan() || differs)
        .then(|| format!("the reported certificate is {said:.1e}, the true one {:.1e}", check.eta))
}

/// How a contact differs from its twin, if both have converged and it does by more than their tolerances let it.
fn mismatch(trial: &Trial, contact: &Contact, twin: &Contact) -> Option<String> {
    if !(contact.is_converged() && twin.is_converged()) {
        return None;
    }
    match trial.twin.as_ref()? {
        EquivalentContact::InOtherUnits(_) => unlike_in_other_units(contact, twin),
        EquivalentContact::UnderItsLoad => unlike_under_its_load(contact, twin, trial.tolerance),
    }
}

/// How the mean gap of the contact under the load that was found differs from the one at which it was found.
fn unlike_under_its_load(contact: &Contact, twin: &Contact, tolerance: f64) -> Option<String> {
    let gap = contact.problem.mean_gap()?;
    let left = gap.min(contact.problem.highest() - gap);
    let difference = (twin.separation() - gap).abs() / left;
    let is_like = difference <= 2.0 * tolerance.sqrt();
    (!is_like)
        .then(|| format!("with the mean pressure found, the gap differs by {difference:.1e} of the remaining gap"))
}

/// How dimensionless results differ.
fn unlike_in_other_units(contact: &Contact, twin: &Contact) -> Option<String> {
    let [a, b] = [contact, twin].map(|contact| {
        let measures = contact.counted();
        let mean = contact.problem.mean_pressure_of(contact.pressure.as_slice().unwrap_or_default());
        (measures.relative_area, measures.kappa_r, &contact.pressure / mean)
    });
    let largest = b.2.fold(0.0, |most: f64, p| most.max(p.abs()));
    let pressure = (&a.2 - &b.2).fold(0.0, |most: f64, p| most.max(p.abs())) / largest;
    let differences = [("area", (a.0 / b.0 - 1.0).abs()), ("kappa_r", (a.1 / b.1 - 1.0).abs()), ("pressure", pressure)];
    let worst = differences.into_iter().find(|(_, difference)| difference.is_nan() || *difference > UNITS)?;
    Some(format!("in usual units, the {} differs by {:.1e}", worst.0, worst.1))
}

/// The message of a panic.
fn message(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("without a message")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{ContactModulus, Load, Multilevel, Problem, Solver, Stop};
    use crate::grid::Grid;
    use crate::surface::Indenter;

    fn sine(load: Load) -> Result<Problem, SetupError> {
        let sine = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(256, 1.0)?)?;
        Ok(Problem::new(sine, ContactModulus(1.0), load)?)
    }

    fn solved(load: Load) -> Contact {
        Multilevel.solve(&sine(load).unwrap(), &Stop::default(), &mut ()).unwrap()
    }

    fn with_twin(load: Load, twin: EquivalentContact) -> Trial {
        Trial { twin: Some(twin), ..Trial::new("sine", move || sine(load)) }
    }

    fn judged(trial: &Trial) -> TrialReport {
        judge(trial, &Rival::MULTILEVEL, Duration::MAX, |_| Box::new(()))
    }

    #[test]
    fn a_load_that_is_not_that_of_the_gap_is_wrong() {
        // from all but touching to all but closed
        for gap in [0.01 * (1.0 - 1e-6), 0.005, 1e-9] {
            let trial = with_twin(Load::MeanGap(gap), EquivalentContact::UnderItsLoad);
            assert_eq!(judged(&trial).verdict, TrialVerdict::Converged, "{gap}");
            let contact = solved(Load::MeanGap(gap));
            for factor in [0.9, 1.1, 100.0] {
                let twin = solved(Load::MeanPressure(factor * contact.mean_pressure()));
                let fault = mismatch(&trial, &contact, &twin);
                assert!(fault.is_some_and(|fault| fault.contains("the gap differs")), "{factor} at {gap}");
            }
        }
    }

    #[test]
    fn a_contact_is_not_solved_until_its_twin_is() {
        // a gap of which rounding leaves nothing
        let pose = || sine(Load::MeanGap(1e-15));
        let report = judged(&with_twin(Load::MeanPressure(0.01), EquivalentContact::InOtherUnits(Box::new(pose))));
        assert_eq!(report.verdict, TrialVerdict::NotConverged);
        assert!(!report.as_demanded && report.to_string().contains("second solve: no further progress"), "{report}");
    }
}
