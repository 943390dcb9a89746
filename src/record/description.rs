//! Descriptions of scenes, as rows of a table in Markdown.

use super::scene::Scene;
use super::units::{RecordUnits, value_with_unit};
use crate::contact::{Load, Unit};
use crate::contact::{Solver, Stop};
use crate::digest::fnv1a;
use crate::quantity::number_in_words;
use crate::setup::in_words;

/// The name of a recording, which distinguishes it from other recordings: surface, load and solver with its settings,
/// or the titles of several scenes.
pub(crate) fn name(scenes: &[Scene<'_>]) -> String {
    match scenes {
        [Scene { setup: Some(setup), problem, .. }] => {
            let grid = problem.surface().grid();
            let load = load_in_words(setup.load, grid.is_line(), &RecordUnits::from(&setup.record));
            format!("{}, {load}, {}", setup.surface.title(grid), in_words(setup, &["solver"]))
        }
        _ => scenes.iter().map(|scene| scene.title.as_str()).collect::<Vec<_>>().join(", "),
    }
}

/// The application of a recording, to which the viewer keeps its layout: the same for the same scenes, and under another title
/// another one.
pub(crate) fn application(title: &str, scenes: &[Scene<'_>]) -> String {
    let describe = |scene: &Scene<'_>| {
        let setup = scene.setup.as_ref().map_or_else(String::new, |setup| setup.to_toml());
        format!(
            "{}\n{}\n{}\n{setup}",
            scene.name,
            scene.title,
            of_scene(scene, &RecordUnits { length: String::new(), pressure: String::new() })
        )
    };
    application_of(&[&[title.to_owned()], scenes.iter().map(describe).collect::<Vec<_>>().as_slice()].concat())
}

/// The application with this name.
pub(crate) fn application_of(words: &[String]) -> String {
    format!("asperity-{:016x}", fnv1a(words.iter().map(|word| word.as_bytes())))
}

/// The head of the table.
pub(crate) const HEAD: &str = "| | |\n|---|---|\n";

/// A load in words, such as `p = 20 MPa`.
pub fn load_in_words(load: Load, is_line: bool, units: &RecordUnits) -> String {
    match units.of_load(load, is_line) {
        "" => load.to_string(),
        unit => format!("{} = {}", load.symbol(), value_with_unit(load.value(), unit)),
    }
}

/// Surface, load and exact values of a scene.
pub(crate) fn of_scene(scene: &Scene<'_>, units: &RecordUnits) -> String {
    let problem = scene.problem;
    let grid = problem.surface().grid();
    let length = |value: f64| value_with_unit(value, units.of_kind(Unit::Length));
    let pressure = |value: f64| value_with_unit(value, units.of_kind(Unit::Pressure));
    let along = |values: [String; 2]| if grid.is_line() { values[1].clone() } else { values.join(" x ") };
    let mut rows: Vec<(&str, String)> =
        scene.setup.iter().map(|it| ("surface", it.surface.described(Some(&length)))).collect();
    rows.extend([
        ("points", along(grid.shape().map(|n| n.to_string()))),
        ("cell", along(grid.size().map(length))),
        ("rms height", length(problem.rms_height())),
        ("rms gradient", number_in_words(problem.rms_gradient())),
        ("boundary", grid.boundary().to_owned()),
        ("solid", problem.solid().description()),
        ("contact modulus E*", pressure(problem.contact_modulus())),
    ]);
    if let Some(mean) = scene.mean_pressure() {
        let reduced = mean / (problem.contact_modulus() * problem.rms_gradient());
        let unit = if units.pressure.is_empty() { ", in the unit of E*" } else { "" };
        rows.push(("mean pressure", format!("{}{unit}", pressure(mean))));
        rows.push(("reduced pressure p*", number_in_words(reduced)));
    }
    rows.extend(problem.mean_gap().map(|gap| ("mean gap", length(gap))));
    if scene.setup.as_ref().is_some_and(|setup| setup.surface.prepare.mirror.is_some()) {
        rows.push(("measured part", "inside the dashed outline: the rest is its mirror image".into()));
    }
    rows.extend(problem.surface().seed().map(|seed| ("seed", seed.to_string())));
    if let Some(exact) = &scene.exact {
        rows.push(("exact solution", exact.name.to_owned()));
        rows.push(("exact relative area", format!("{:.6}", exact.relative_area)));
        rows.extend(exact.kappa_r.map(|kappa_r| ("exact kappa_r", format!("{kappa_r:.5}"))));
    }
    table(&rows)
}

/// The solver of a run and when it stops.
pub(crate) fn of_run(solver: &dyn Solver, stop: &Stop) -> String {
    let pressure = stop.pressure_tolerance().map_or(String::new(), |it| format!(", pressure within {it:e}"));
    table(&[
        ("solver", format!("{}: {}", solver.name(), solver.settings())),
        ("tolerance", format!("certificate {:e}{pressure}, at most {} steps", stop.tolerance(), stop.max_iterations())),
    ])
}

fn table(rows: &[(&str, String)]) -> String {
    rows.iter().map(|(name, value)| format!("| {name} | {value} |\n")).collect()
}
