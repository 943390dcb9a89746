//! Warnings about the rows of a study.

use super::plan::Plan;
use super::point::Point;
use crate::contact::{LARGEST_ERROR, Strain, warnings_of_strains};
use crate::warning::Warning;

/// A share of rows on grids that are too coarse above this one gives a warning.
const LARGEST_SHARE: f64 = 0.1;

impl Plan {
    /// Warnings about `points` of the study: rows that did not converge, rows that are left out of means since their contact is not resolved, rows
    /// on grids that are too coarse for `kappa_r`, and those of [`warnings_of_strains`].
    pub fn warnings(&self, points: &[Point]) -> Vec<Warning> {
        let found = [unfinished(points), unresolved(points, Point::is_resolved), coarse(points)];
        let strains: Vec<Strain> = points.iter().map(|it| Strain::from(&it.observables)).collect();
        let strained = self.law().map(|law| warnings_of_strains(&strains, law));
        found.into_iter().flatten().chain(strained.into_iter().flatten()).collect()
    }
}

/// Warnings about rows that are extrapolated over grids, which needs no more than a contact on each of them.
pub fn warnings_of_extrapolated_rows(points: &[Point]) -> Vec<Warning> {
    [unfinished(points), unresolved(points, Point::has_contact)].into_iter().flatten().collect()
}

fn unfinished(points: &[Point]) -> Option<Warning> {
    let count = points.iter().filter(|point| !point.is_converged()).count();
    (count > 0).then(|| Warning::new(format!("{count} of {} rows did not converge", points.len()), "See their status"))
}

fn unresolved(points: &[Point], is_used: impl Fn(&Point) -> bool) -> Option<Warning> {
    let count = points.iter().filter(|point| point.is_converged() && !point.is_apart() && !is_used(point)).count();
    (count > 0).then(|| {
        Warning::new(
            format!(
                "{count} of {} rows are not resolved, since their contact has too few nodes. They are left out of means and figures",
                points.len()
            ),
            "Use more points or larger loads",
        )
    })
}

/// The warning that `kappa_r` of many rows is not known well on their grid.
fn coarse(points: &[Point]) -> Option<Warning> {
    let rows = points.iter().filter(|it| !it.has_adhesion() && it.has_contact());
    let errors: Vec<f64> =
        rows.map(|it| it.observables.kappa_r_error).filter(|it| it.is_nan() || *it > LARGEST_ERROR).collect();
    let largest = errors.iter().copied().reduce(f64::max)?;
    let amount = match largest.is_finite() {
        true => format!("{:.0} %", 100.0 * largest),
        false => "any amount".into(),
    };
    (errors.len() as f64 > LARGEST_SHARE * points.len() as f64).then(|| {
        Warning::new(
            format!(
                "The grid is too coarse for {} of {} rows: their kappa_r may be off by more than {:.0} %, and by up to {amount}, so that \
                 differences between means may come from the grid",
                errors.len(),
                points.len(),
                100.0 * LARGEST_ERROR
            ),
            "Use more points, or leave out rows with a large `kappa_r_error`",
        )
    })
}
