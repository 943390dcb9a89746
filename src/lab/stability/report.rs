//! The report of one trial of one solver.

use super::check::Check;
use super::trial::Trial;
use super::verdict::TrialVerdict;
use crate::contact::{Contact, Status};
use crate::lab::Rival;
use crate::lab::table::{or_dash, points};
use serde::Serialize;
use std::fmt;

/// The names of the columns in which a report displays, 120 characters wide without the notes.
pub const HEAD: &str = "\
case                            points solver          steps seconds     eta   verdict       note";

/// One trial of one solver. There are no figures where nothing was returned.
#[derive(Serialize)]
pub struct TrialReport {
    case: String,
    pub solver: &'static str,
    pub verdict: TrialVerdict,
    /// Whether the verdict is what the trial demands.
    pub as_demanded: bool,
    note: String,
    ny: Option<usize>,
    nx: Option<usize>,
    status: Option<Status>,
    pub iterations: Option<usize>,
    transforms: Option<u64>,
    seconds: Option<f64>,
    relative_area: Option<f64>,
    /// Certificate, as the solver says.
    certificate: Option<f64>,
    /// Certificate, as checked, like all that follows.
    pub eta: Option<f64>,
    eta_gap: Option<f64>,
    pressure_error: Option<f64>,
    penetration: Option<f64>,
    min_pressure: Option<f64>,
    load_error: Option<f64>,
    energy: Option<f64>,
    rounding: Option<f64>,
}

impl TrialReport {
    /// The report on what was found, if anything was returned.
    pub fn new(
        trial: &Trial,
        rival: &Rival,
        found: Option<(&Contact, &Check)>,
        verdict: TrialVerdict,
        note: String,
    ) -> Self {
        let (contact, check) = found.unzip();
        let status = contact.map(|contact| contact.status);
        let shape = contact.map(|contact| contact.problem.surface().grid().shape());
        let work = contact.map(|contact| contact.work);
        Self {
            case: trial.name.clone(),
            solver: rival.name,
            verdict,
            as_demanded: trial.demand_of(rival).is_met(verdict, check.map(|check| check.eta), status),
            note,
            ny: shape.map(|[ny, _]| ny),
            nx: shape.map(|[_, nx]| nx),
            status,
            iterations: work.map(|work| work.iterations),
            transforms: work.map(|work| work.transforms),
            seconds: work.map(|work| work.seconds),
            relative_area: contact.map(|contact| contact.resolved().relative_area),
            certificate: contact.map(|contact| contact.certificate.eta),
            eta: check.map(|check| check.eta),
            eta_gap: check.map(|check| check.eta_gap),
            pressure_error: check.map(|check| check.pressure_error),
            penetration: check.map(|check| check.penetration),
            min_pressure: check.map(|check| check.min_pressure),
            load_error: check.map(|check| check.load_error),
            energy: check.map(|check| check.energy),
            rounding: check.map(|check| check.rounding),
        }
    }
}

impl fmt::Display for TrialReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let line = format!(
            "{:<28} {:>9} {:<13} {:>7} {:>7} {:>7} {} {:<13} {}",
            self.case,
            or_dash(self.ny.zip(self.nx), |(ny, nx)| points([ny, nx])),
            self.solver,
            or_dash(self.iterations, |steps| steps.to_string()),
            or_dash(self.seconds, |seconds| format!("{seconds:.3}")),
            or_dash(self.eta, |eta| format!("{eta:.1e}")),
            if self.as_demanded { ' ' } else { '!' },
            self.verdict,
            self.note
        );
        f.write_str(line.trim_end())
    }
}
