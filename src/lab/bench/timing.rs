//! What a method took for a contest.

use super::group::Group;
use crate::contact::{Contact, Status};
use crate::lab::table::{median, or_dash, points};
use serde::Serialize;
use std::fmt;

/// The names of the columns in which a [`Timing`] displays, 120 wide.
pub const HEAD: &str = "\
case                points solver         steps transforms  solve s make s     eta   area kappa_r   MiB  ratio status";

/// One contest solved by one method.
#[derive(Debug, Clone, Serialize)]
pub struct Timing {
    /// The group of the contest.
    pub group: Group,
    /// The contest.
    pub case: String,
    /// Points along y, 1 for a line.
    pub ny: usize,
    /// Points along x.
    pub nx: usize,
    /// The method.
    pub solver: String,
    /// How the solver stopped.
    pub status: Status,
    /// Relaxation steps.
    pub iterations: usize,
    /// Fourier transforms; those of coarse grids count by their share of points.
    pub transforms: u64,
    /// Seconds in the solver, median over the repeats.
    pub solve_seconds: f64,
    /// Seconds of making the surface and posing the problem.
    pub make_seconds: f64,
    /// Certificate.
    pub certificate: f64,
    /// Share of nodes in contact.
    pub relative_area: f64,
    /// `kappa_r`, corrected for counting nodes.
    pub kappa_r_corrected: f64,
    /// Peak of resident memory while the surface was made and solved, where the system tells.
    pub peak_mib: Option<f64>,
    /// Seconds in the solver over those of the first method of the contest, if there are several.
    pub ratio: Option<f64>,
}

impl Timing {
    /// The timing of a contact, whose peak memory and ratio are not known yet.
    pub(super) fn of(
        group: Group,
        case: &str,
        contact: &Contact,
        make_seconds: f64,
        mut solve_seconds: Vec<f64>,
    ) -> Self {
        solve_seconds.sort_by(f64::total_cmp);
        let measures = contact.measures();
        let [ny, nx] = contact.problem.surface().grid().shape();
        Self {
            group,
            case: case.into(),
            ny,
            nx,
            solver: contact.solver.clone(),
            status: contact.status,
            iterations: contact.work.iterations,
            transforms: contact.work.transforms,
            solve_seconds: median(&solve_seconds),
            make_seconds,
            certificate: contact.certificate.eta,
            relative_area: measures.relative_area,
            kappa_r_corrected: measures.kappa_r_corrected,
            peak_mib: None,
            ratio: None,
        }
    }
}

impl fmt::Display for Timing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{:<14} {:>11} {:<13} {:>6} {:>10} {:>8.3} {:>6.3} {:>7.1e} {:>6.4} {:>7.4} {:>5} {:>6} {}",
            self.case,
            points([self.ny, self.nx]),
            self.solver,
            self.iterations,
            self.transforms,
            self.solve_seconds,
            self.make_seconds,
            self.certificate,
            self.relative_area,
            self.kappa_r_corrected,
            or_dash(self.peak_mib, |mib| format!("{mib:.0}")),
            or_dash(self.ratio, |ratio| format!("{ratio:.2}")),
            self.status
        )
    }
}
