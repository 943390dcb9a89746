//! Properties of recordings: what is known of each scene as a whole, so that a folder of recordings is a table.
//!
//! Each scene has a group of properties under the name of its root, and each property is written once, as readers of whole
//! folders take any of several.

use super::draw::TRANSFORMS;
use super::scene::Scene;
use crate::contact::{Contact, Quantity, Reading, Solver, Stop};
use rerun::components::{Scalar, Text};
use rerun::{AnyValues, RecordingStream, RecordingStreamResult};
use strum::IntoEnumIterator;

/// What is known of a scene before it is solved.
pub(crate) fn of_scene(scene: &Scene<'_>) -> AnyValues {
    let Scene { title, problem, setup, .. } = scene;
    let grid = problem.surface().grid();
    let along = |values: [f64; 2]| values.into_iter().skip(usize::from(grid.is_line()));
    let spectrum = setup.as_ref().and_then(|setup| setup.surface.spectrum.as_ref()?.self_affine());
    let numbers = [
        ("hurst", spectrum.map(|spectrum| spectrum.hurst)),
        ("contact_modulus", Some(problem.contact_modulus())),
        ("rms_height", Some(problem.rms_height())),
        ("rms_gradient", Some(problem.rms_gradient())),
        ("reduced_pressure", scene.reduced_pressure()),
    ];
    let known = with_texts([("title", title.as_str()), ("version", env!("CARGO_PKG_VERSION"))])
        .with_component::<Scalar>("points", along(grid.shape().map(|n| n as f64)))
        .with_component::<Scalar>("size", along(grid.size()));
    let known = match setup {
        Some(setup) => known.with_component::<Text>("setup", [setup.to_saved_toml()]),
        None => known,
    };
    with_numbers(known, numbers.into_iter().filter_map(|(name, value)| Some((name, value?))))
}

/// The solver of a run and when it stops.
pub(crate) fn of_run(solver: &dyn Solver, stop: &Stop) -> AnyValues {
    let texts = [("solver", solver.name()), ("settings", &solver.settings())];
    with_numbers(with_texts(texts), [("tolerance", stop.tolerance())])
}

/// The end of a run and the observables of its result, except those that were known before.
pub(crate) fn of_contact(contact: &Contact, reading: &Reading<'_>) -> AnyValues {
    let is_known = |it: Quantity| match it {
        Quantity::RmsHeight | Quantity::RmsGradient => true,
        Quantity::ReducedPressure => contact.problem.mean_pressure().is_some(),
        _ => false,
    };
    let told = Quantity::iter().filter(|it| it.tells_of(contact) && !is_known(*it));
    let observables = told.map(|it| (property(it.name()), reading.value(it)));
    let ended = with_texts([("status", contact.status.to_string().as_str())]);
    with_numbers(ended, observables.chain([("solver_seconds", contact.work.seconds)]))
}

/// The name of the property of an observable: its own name, except for the one that is also the name of a timeline.
fn property(observable: &'static str) -> &'static str {
    if observable == TRANSFORMS { "solver_transforms" } else { observable }
}

/// Sends properties of the scene under `root`.
pub(crate) fn send(to: &RecordingStream, root: &str, properties: &AnyValues) -> RecordingStreamResult<()> {
    to.send_property(root.trim_start_matches('/'), properties)
}

fn with_texts<'a>(texts: impl IntoIterator<Item = (&'static str, &'a str)>) -> AnyValues {
    texts.into_iter().fold(AnyValues::default(), |all, (name, text)| all.with_component::<Text>(name, [text]))
}

fn with_numbers(properties: AnyValues, numbers: impl IntoIterator<Item = (&'static str, f64)>) -> AnyValues {
    numbers.into_iter().fold(properties, |all, (name, value)| all.with_component::<Scalar>(name, [value]))
}
