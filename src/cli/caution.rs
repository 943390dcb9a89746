//! Warnings about surfaces and loads for which the numbers of a contact mean little.

use asperity::contact::{Contact, Observables};
use asperity::setup::Recipe;
use asperity::surface::{Detrend, HeightFile, Layout, Surface};
use std::io::{Write, stderr};

/// Reduced pressures above this one are far beyond full contact, which is near 1 to 2.
const HEAVIEST: f64 = 10.0;
/// Steps across the period above this many rms steps are a jump: periodic random lines have 0.05 to 2, measured traces less their
/// plane up to 100.
const JUMP: f64 = 10.0;
/// Estimated errors of area or `kappa_r` above this one are told.
const LARGEST_ERROR: f64 = 0.1;
/// A share of the contact in patches too small to trust above this one is told.
const LARGEST_SHARE: f64 = 0.25;
/// Rms gradients of measured heights above this one come from a wrong unit, as they differ by thousands.
const STEEPEST: f64 = 10.0;
/// Lengths whose logarithms to the base of ten differ from a whole number by less than this may be the same in another unit.
const SAME_LENGTH: f64 = 0.01;
/// Spacings that differ by less than this share count as equal.
const UNEQUAL: f64 = 0.01;

/// Warnings about a surface, a sentence each: jumps across the period, unequal spacings, and gradients of a wrong unit.
pub fn of_surface(recipe: &Recipe, surface: &Surface) -> Vec<String> {
    let jumps = ["y", "x"].into_iter().zip(surface.jumps());
    let jump = |(axis, jump): (&str, f64)| {
        let remedy = match recipe.prepare.detrend {
            Some(Detrend::Plane | Detrend::Curvature) => {
                "mirror them by --mirror, or leave the period out by --boundary free"
            }
            _ => "take off their tilt by --detrend plane",
        };
        (jump > JUMP).then(|| {
            format!("the heights jump by {jump:.3} rms steps across the period along {axis}, where the contact is not real: {remedy}")
        })
    };
    let measured = recipe
        .height
        .as_ref()
        .map(|file| [spacing(surface), gradient(surface), spacing_of_file(recipe, file, surface)]);
    jumps.filter_map(jump).chain(measured.into_iter().flatten().flatten()).collect()
}

/// The warning that heights are void.
pub fn of_voids(voids: usize, points: usize) -> String {
    format!(
        "{voids} of {points} heights are void, and no contact can be solved with them: fill them by --fill harmonic, or --crop them away"
    )
}

/// Warnings about contacts, a sentence each: loads far beyond full contact, and patches of too few nodes.
pub fn of_contacts(found: &[&Observables]) -> Vec<String> {
    let heavy = found.iter().map(|it| it.reduced_pressure).filter(|it| *it > HEAVIEST).reduce(f64::max).map(|p| {
        format!("the reduced pressure {p:.3e} is far above 1, where contact is nearly full: check load, modulus and their units")
    });
    let doubtful: Vec<_> = found.iter().filter(|it| is_doubtful(it)).collect();
    let of =
        if found.len() > 1 { format!(" under {} of {} loads", doubtful.len(), found.len()) } else { String::new() };
    let worst = doubtful.into_iter().max_by(|a, b| error(a).total_cmp(&error(b)));
    let coarse = worst.map(|it| {
        format!(
            "area and kappa_r may be off by {:.0} %{of} on this grid, and {:.0} % of the contact is in patches too small to \
             trust: refine it by --refine auto, take more points, or smoother heights",
            100.0 * error(it),
            100.0 * it.unresolved_share
        )
    });
    heavy.into_iter().chain(coarse).collect()
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

/// The warning that the finest grid that could be tried is too coarse.
pub fn unsettled() -> String {
    "area and kappa_r have not settled on the finest grid that memory and 64-fold refinement allow: give a larger --area-tolerance, or \
     smoother heights"
        .into()
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

/// Says why steps of the preparation were chosen, on standard error.
pub fn note(reasons: &[String]) {
    for reason in reasons {
        writeln!(stderr(), "chosen: {reason}").ok();
    }
}

/// Lengths of measured surfaces that may have been swapped.
fn spacing(surface: &Surface) -> Option<String> {
    let [dy, dx] = surface.grid().spacing();
    let is_unequal = !surface.grid().is_line() && (dy / dx - 1.0).abs() > UNEQUAL;
    is_unequal.then(|| {
        format!(
            "the spacing is {dy:.4e} along y (rows) and {dx:.4e} along x (columns): if that is not so, give --size as y,x"
        )
    })
}

/// Distances in a file that do not fit the size, of a file that does not say its units in none.
fn spacing_of_file(recipe: &Recipe, file: &HeightFile, surface: &Surface) -> Option<String> {
    let Layout { spacing, shape, is_in_metres, .. } = file.layout(recipe.channel.as_deref()).ok()?;
    let [_, told] = spacing?;
    let refined = surface.grid().shape()[1] / recipe.prepare.shape(shape).ok()?[1];
    let spacing = surface.grid().spacing()[1] * refined as f64;
    let power = (spacing / told).log10();
    let unit = if is_in_metres { 0.0 } else { power.round() };
    let is_same = (power - unit).abs() < SAME_LENGTH;
    (!is_same).then(|| {
        format!(
            "the points in {} are {told:.6e} apart and those of the grid {spacing:.6e}: leave the size out, or give that of the file",
            file.display()
        )
    })
}

/// Heights that may have another unit than the size.
fn gradient(surface: &Surface) -> Option<String> {
    let gradient = surface.rms_gradient();
    (gradient > STEEPEST).then(|| format!("the rms gradient is {gradient:.3e}: give heights and size in the same unit"))
}
