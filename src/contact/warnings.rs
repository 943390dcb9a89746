//! Warnings about contacts with unreliable numbers: loads beyond full contact, grids that are too coarse, pressures
//! above those at which metals yield.

use super::{Contact, Law, Observables};
use crate::warning::Warning;

/// Reduced pressures above this one are far beyond full contact, which is near 1 to 2.
const HEAVIEST: f64 = 10.0;
/// Estimated errors of area or `kappa_r` above this one give a warning.
const LARGEST_ERROR: f64 = 0.1;
/// Contact moduli from this one on are those of metals, glasses and ceramics, if they are in pascals.
const STIFF: f64 = 1e10;
/// The pressure, divided by the contact modulus, above which all metals yield: the hardness of steels is 0.01 to 0.04
/// of it.
const HARDEST: f64 = 0.05;
/// Bounds of the error of the pressure above this one give a warning.
const LARGEST_BOUND: f64 = 0.1;
/// A share of the contact in patches that are too small to trust above this one gives a warning.
const LARGEST_SHARE: f64 = 0.25;

/// Warnings about contacts under one load or several: loads far beyond full contact, errors that are not known,
/// inaccurate pressures, grids that are too coarse, and pressures above those at which metals yield.
pub fn warnings_of(found: &[&Observables], law: Law) -> Vec<Warning> {
    let all = [too_heavy(found), unknown(found), loose(found), coarse(found), metal(found, law)];
    all.into_iter().flatten().collect()
}

/// The warning that a contact reaches a free rim, beyond which the heights are not known.
pub fn warning_of_rim(contact: &Contact) -> Option<Warning> {
    let grid = contact.problem.surface().grid();
    let pressed = contact.pressure.iter().enumerate().filter(|(node, p)| **p > 0.0 && grid.is_at_rim(*node)).count();
    (pressed > 0).then(|| {
        Warning::new(
            format!(
                "The contact reaches the free rim at {pressed} nodes. The heights beyond the rim are missing, so the \
                 pressure there is that of a sharp edge"
            ),
            "Use a larger part of the surface, or a smaller load",
        )
    })
}

/// The warning that contacts that slide over a viscoelastic solid, one for each speed, leave a trail that is longer than the cell.
pub fn warning_of_trail<'a>(contacts: impl IntoIterator<Item = &'a Contact>) -> Option<Warning> {
    let slides: Vec<[f64; 2]> = contacts.into_iter().filter_map(trail_and_cell).collect();
    let long = slides.iter().filter(|[trail, cell]| trail > cell);
    let count = long.clone().count();
    let [trail, cell] = *long.max_by(|a, b| a[0].total_cmp(&b[0]))?;
    let (at, up_to) = match slides.len() {
        1 => (String::new(), ""),
        all => (format!("At {count} of {all} speeds t"), "up to "),
    };
    let t = if at.is_empty() { "T" } else { &at };
    Some(
        Warning::new(
            format!(
                "{t}he trail of the contact in the solid (speed times retardation time) is {up_to}{trail:.3e} long, and the \
                 cell {cell:.3e} along x, so that the surface slides into the trails of its periodic images. Friction, area and \
                 gap are those of the whole row of images, not of a single contact"
            ),
            "Use a cell that is longer along x than the trail, or a lower speed",
        )
        .with_remedy("grid.size", None)
        .with_remedy("sliding.speed", None),
    )
}

/// The length along which the solid remembers a contact that slides, and that of the cell along `x`.
fn trail_and_cell(contact: &Contact) -> Option<[f64; 2]> {
    let compliance = contact.problem.compliance();
    Some([compliance.trail()?, contact.problem.surface().grid().size()[1]])
}

/// The end of a statement that holds for some of several loads.
fn under(count: usize, found: &[&Observables]) -> String {
    match found.len() {
        1 => String::new(),
        all => format!(" under {count} of {all} loads"),
    }
}

fn too_heavy(found: &[&Observables]) -> Option<Warning> {
    let heavy = found.iter().map(|it| it.reduced_pressure).filter(|it| *it > HEAVIEST).reduce(f64::max)?;
    Some(Warning::new(
        format!("The reduced pressure {heavy:.3e} is far above 1, so the contact is nearly full"),
        "Check the load, the modulus, the size and their units",
    ))
}

fn unknown(found: &[&Observables]) -> Option<Warning> {
    let count = found.iter().filter(|it| is_unknown(it)).count();
    (count > 0).then(|| {
        Warning::new(
            format!(
                "This grid is too coarse for kappa_r and its error estimate, so kappa_r may be completely wrong{}",
                under(count, found)
            ),
            "Use a finer grid, or heights that are neither rounded nor clipped",
        )
        .with_remedy("grid.refine", Some("auto"))
    })
}

fn loose(found: &[&Observables]) -> Option<Warning> {
    let bounds: Vec<f64> = found.iter().map(|it| it.pressure_error_bound).filter(|it| *it > LARGEST_BOUND).collect();
    let largest = bounds.iter().copied().reduce(f64::max)?;
    let under = under(bounds.len(), found);
    Some(
        Warning::new(
            match largest < 1.0 {
                true => format!("The relative error of the pressure may be {:.0} %{under}", 100.0 * largest),
                false => format!("The relative error of the pressure may be 100 % or more{under}"),
            },
            "Set a tolerance for the pressure",
        )
        .with_remedy("stop.pressure-tolerance", Some("0.01")),
    )
}

fn coarse(found: &[&Observables]) -> Option<Warning> {
    let doubtful: Vec<&Observables> = found.iter().copied().filter(|it| is_doubtful(it)).collect();
    let count = under(doubtful.len(), found);
    let worst = doubtful.into_iter().max_by(|a, b| error(a).total_cmp(&error(b)))?;
    let small = match (100.0 * worst.unresolved_share).round() {
        0.0 => String::new(),
        share => format!(": {share} % of the contact is in patches that are too small to trust"),
    };
    let amount = match error(worst) {
        error if error.is_finite() => format!("{:.0} %", 100.0 * error),
        _ => "any amount".into(),
    };
    Some(
        Warning::new(
            format!("Area and kappa_r may be off by {amount}{count} on this grid{small}"),
            "Use a finer grid, or heights that are smoother and less rounded",
        )
        .with_remedy("grid.refine", Some("auto")),
    )
}

/// The warning that the pressure on a stiff solid is above that at which metals yield.
fn metal(found: &[&Observables], law: Law) -> Option<Warning> {
    let is_stiff = |it: &&&Observables| it.max_pressure >= STIFF * it.max_pressure_over_modulus;
    let shares = found.iter().filter(is_stiff).map(|it| it.max_pressure_over_modulus);
    let share = shares.reduce(f64::max).filter(|share| *share > HARDEST && law.is_hard_wall())?;
    Some(
        Warning::new(
            format!(
                "The largest pressure is {share:.2} of the contact modulus. Metals yield at lower pressures, so the \
                 real contact area is larger"
            ),
            "Give the hardness",
        )
        .with_remedy("law.hardness", None),
    )
}

/// Whether there is a contact whose `kappa_r`, or its error, is no number or zero.
fn is_unknown(it: &Observables) -> bool {
    it.relative_area_counted > 0.0
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
