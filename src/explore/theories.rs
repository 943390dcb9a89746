//! What theories say of the contacts of a setup.

use crate::contact::{Contact, Law, Problem};
use crate::setup::{Setup, Solid};
use crate::theory::{Exact, persson};

/// Whether Persson's theory is about a surface: it is for rough flats at rest on an elastic half-space, random or measured.
pub(super) fn is_rough_flat(setup: &Setup) -> bool {
    let Setup { surface, solid, law, .. } = setup;
    let is_half_space = !matches!(solid, Some(Solid::Layer { .. }));
    let is_rough = surface.spectrum.is_some() || surface.height.is_some();
    let is_elastic = *law == Law::HardWall && setup.viscoelastic.is_none();
    is_half_space && is_elastic && is_rough && surface.indenter.is_none()
}

/// Persson's relative area of a contact under its load.
pub(super) fn persson(contact: &Contact) -> f64 {
    contact.problem.load().reduced_pressure().map_or(f64::NAN, persson::relative_area)
}

/// The exact solution of a problem of a setup, where there is one.
pub(super) fn exact(setup: &Setup, problem: &Problem) -> Option<Exact> {
    setup.exact(problem.surface().grid(), problem.expected_mean_pressure())
}
