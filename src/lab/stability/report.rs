//! The report of one trial of one solver.

use super::check::Check;
use super::verdict::Verdict;
use crate::contact::{Contact, Status};
use crate::lab::Rival;
use crate::lab::table::{or_dash, points};
use serde::Serialize;
use std::fmt;

/// The names of the columns in which a [`Report`] displays, 120 wide but for notes.
pub const HEAD: &str = "\
case                            points solver          steps seconds     eta   verdict       note";

/// One trial of one solver. There are no figures where nothing was returned.
#[derive(Debug, Clone, Serialize)]
pub struct Report {
    /// The trial.
    pub case: String,
    /// The solver.
    pub solver: &'static str,
    /// How the trial ended.
    pub verdict: Verdict,
    /// Whether the verdict is what the trial demands.
    pub as_demanded: bool,
    /// The fault, or why it was refused or not converged.
    pub note: String,
    /// Points along y, 1 for a line.
    pub ny: Option<usize>,
    /// Points along x.
    pub nx: Option<usize>,
    /// How the solver stopped.
    pub status: Option<Status>,
    /// Relaxation steps.
    pub iterations: Option<usize>,
    /// Fourier transforms; those of coarse grids count by their share of points.
    pub transforms: Option<u64>,
    /// Seconds in the solver.
    pub seconds: Option<f64>,
    /// Share of nodes in contact.
    pub relative_area: Option<f64>,
    /// Certificate, as the solver says.
    pub certificate: Option<f64>,
    /// Certificate, as checked.
    pub eta: Option<f64>,
    /// [`Check::penetration`].
    pub penetration: Option<f64>,
    /// [`Check::min_pressure`].
    pub min_pressure: Option<f64>,
    /// [`Check::load_error`].
    pub load_error: Option<f64>,
    /// [`Check::energy`].
    pub energy: Option<f64>,
    /// [`Check::rounding`].
    pub rounding: Option<f64>,
}

impl Report {
    /// The report with what was found, if anything was returned.
    pub(super) fn new(
        case: &str,
        rival: &Rival,
        verdict: Verdict,
        as_demanded: bool,
        note: String,
        found: Option<(&Contact, &Check)>,
    ) -> Self {
        let (contact, check) = found.unzip();
        let shape = contact.map(|contact| contact.problem.surface().grid().shape());
        let work = contact.map(|contact| contact.work);
        let checked = |value: fn(&Check) -> f64| check.map(value);
        Self {
            case: case.into(),
            solver: rival.name,
            verdict,
            as_demanded,
            note,
            ny: shape.map(|[ny, _]| ny),
            nx: shape.map(|[_, nx]| nx),
            status: contact.map(|contact| contact.status),
            iterations: work.map(|work| work.iterations),
            transforms: work.map(|work| work.transforms),
            seconds: work.map(|work| work.seconds),
            relative_area: contact.map(|contact| contact.measures().relative_area),
            certificate: contact.map(|contact| contact.certificate.eta),
            eta: checked(|check| check.eta),
            penetration: checked(|check| check.penetration),
            min_pressure: checked(|check| check.min_pressure),
            load_error: checked(|check| check.load_error),
            energy: checked(|check| check.energy),
            rounding: checked(|check| check.rounding),
        }
    }
}

impl fmt::Display for Report {
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
