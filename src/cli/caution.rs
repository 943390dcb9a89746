//! Warnings about loads for which the numbers of a contact mean little.

use super::manners::remark;
use super::outcome::usage;
use anyhow::Result;
use asperity::contact::{Contact, Law, Observables};
use std::io::{Write, stderr};

/// Reduced pressures above this one are far beyond full contact, which is near 1 to 2.
const HEAVIEST: f64 = 10.0;
/// Estimated errors of area or `kappa_r` above this one are told.
const LARGEST_ERROR: f64 = 0.1;
/// Contact moduli from this one on are those of metals, glasses and ceramics, if they are in pascals.
const STIFF: f64 = 1e10;
/// The share of the contact modulus above which no metal bears a pressure: the hardness of steels is 0.01 to 0.04 of it.
const HARDEST: f64 = 0.05;
/// Bounds of the error of the pressure above this one are told.
const LARGEST_BOUND: f64 = 0.1;
/// A share of the contact in patches too small to trust above this one is told.
const LARGEST_SHARE: f64 = 0.25;

/// Warnings about contacts, a sentence each: loads far beyond full contact, errors that are not known, pressures that are not solved for, and patches of too few nodes.
pub fn of_contacts(found: &[&Observables]) -> Vec<String> {
    let heavy = found.iter().map(|it| it.reduced_pressure).filter(|it| *it > HEAVIEST).reduce(f64::max).map(|p| {
        format!("the reduced pressure {p:.3e} is far above 1, where contact is nearly full: check load, modulus and their units")
    });
    let under = |count: usize| match found.len() {
        1 => String::new(),
        all => format!(" under {count} of {all} loads"),
    };
    let unknown = found.iter().filter(|it| is_unknown(it)).count();
    let unknown = (unknown > 0).then(|| {
        format!(
            "kappa_r and its error cannot be found{} on this grid, so that kappa_r may be wrong by any amount: refine it by \
             --refine auto, take more points, or heights that are neither rounded nor clipped",
            under(unknown)
        )
    });
    let loose: Vec<f64> = found.iter().map(|it| it.pressure_error_bound).filter(|it| *it > LARGEST_BOUND).collect();
    let loose = loose.iter().copied().reduce(f64::max).map(|bound| {
        format!(
            "the pressure is known within {:.0} % only{}, whatever the certificate: solve on by --pressure-tolerance 0.01",
            100.0 * bound,
            under(loose.len())
        )
    });
    let doubtful: Vec<_> = found.iter().filter(|it| is_doubtful(it)).collect();
    let of = under(doubtful.len());
    let worst = doubtful.into_iter().max_by(|a, b| error(a).total_cmp(&error(b)));
    let coarse = worst.map(|it| {
        let small = match (100.0 * it.unresolved_share).round() {
            0.0 => String::new(),
            share => format!(", and {share} % of the contact is in patches too small to trust"),
        };
        let by = match error(it) {
            error if error.is_finite() => format!("{:.0} %", 100.0 * error),
            _ => "any amount".into(),
        };
        format!(
            "area and kappa_r may be off by {by}{of} on this grid{small}: refine it by --refine auto, take more points, or \
             heights that are smoother and less rounded"
        )
    });
    heavy.into_iter().chain(unknown).chain(loose).chain(coarse).collect()
}

/// The warning that a stiff solid is pressed harder than metals bear, under some law of contact.
pub fn of_metal(found: &[&Observables], law: Law) -> Option<String> {
    let is_stiff = |it: &&&Observables| it.max_pressure >= STIFF * it.max_pressure_over_modulus;
    let shares = found.iter().filter(is_stiff).map(|it| it.max_pressure_over_modulus);
    let share = shares.reduce(f64::max).filter(|share| *share > HARDEST && law.is_hard_wall())?;
    Some(format!(
        "the largest pressure is {share:.2} of the contact modulus, which no metal bears: it yields before, over a larger area; give its \
         hardness by --hardness"
    ))
}

/// The warning that a contact reaches a free rim, beyond which the heights are not known.
pub fn of_rim(contact: &Contact) -> Option<String> {
    let grid = contact.problem.surface().grid();
    let pressed = contact.pressure.iter().enumerate().filter(|(node, p)| **p > 0.0 && grid.is_at_rim(*node)).count();
    (pressed > 0).then(|| {
        format!(
            "the contact reaches the free rim at {pressed} nodes, where the heights that would follow are missing: the pressure there is that \
             of an edge, give more of the surface, or a lighter load"
        )
    })
}

/// The warning that the finest grid that could be tried is too coarse, or no grid would be fine enough.
pub fn unsettled() -> String {
    "area and kappa_r have not settled on the finest grid that memory, 64-fold refinement and plateaus of the heights allow: give a \
     larger --area-tolerance, or heights that are smoother and less rounded"
        .into()
}

/// Whether there is a contact whose `kappa_r`, or its error, is no number or zero.
fn is_unknown(it: &Observables) -> bool {
    it.relative_area > 0.0
        && !(it.kappa_r_error.is_finite() && it.relative_area_error.is_finite() && it.kappa_r > 0.0)
}

/// Whether the grid is too coarse for the numbers of a contact.
fn is_doubtful(it: &Observables) -> bool {
    error(it) > LARGEST_ERROR || it.unresolved_share > LARGEST_SHARE
}

/// The larger one of the estimated errors of the grid.
fn error(it: &Observables) -> f64 {
    it.relative_area_error.max(it.kappa_r_error)
}

/// Says them on standard error.
pub fn tell(warnings: &[String]) {
    for warning in warnings {
        writeln!(stderr(), "warning: {warning}").ok();
    }
}

/// Takes warnings for an error where they are to be.
///
/// # Errors
/// The warnings, as what the person at the keyboard can mend.
pub fn heed(warnings: &[String], is_strict: bool) -> Result<()> {
    if is_strict && !warnings.is_empty() { usage(warnings.join("; ")) } else { Ok(()) }
}

/// Says why steps of the preparation were chosen, on standard error.
pub fn note(reasons: &[String]) {
    for reason in reasons {
        remark(format_args!("chosen: {reason}"));
    }
}
