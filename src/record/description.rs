//! Descriptions of scenes, as rows of a table in Markdown.

use super::scene::Scene;
use crate::contact::{Solver, Stop};

/// The head of the table.
pub const HEAD: &str = "| | |\n|---|---|\n";

/// Surface, load and exact values of a scene, lengths in `unit`.
pub fn of_scene(scene: &Scene<'_>, unit: &str) -> String {
    let problem = scene.problem;
    let grid = problem.surface().grid();
    let along = |values: [String; 2]| if grid.is_line() { values[1].clone() } else { values.join(" x ") };
    let mut rows: Vec<(&str, String)> = scene.setup.iter().map(|it| ("surface", it.surface.description())).collect();
    rows.extend([
        ("points", along(grid.shape().map(|n| n.to_string()))),
        ("cell", format!("{} {unit}", along(grid.size().map(|l| format!("{l:.4e}"))))),
        ("rms height", format!("{:.4e} {unit}", problem.rms_height())),
        ("rms gradient", format!("{:.4e}", problem.rms_gradient())),
        ("contact modulus E*", format!("{:.4e}", problem.contact_modulus())),
    ]);
    if let Some(mean) = problem.mean_pressure() {
        let reduced = mean / (problem.contact_modulus() * problem.rms_gradient());
        rows.push(("mean pressure", format!("{mean:.4e}, in the unit of E*")));
        rows.push(("reduced pressure p*", format!("{reduced:.4e}")));
    }
    rows.extend(problem.mean_gap().map(|gap| ("mean gap", format!("{gap:.4e} {unit}"))));
    rows.extend(problem.surface().seed().map(|seed| ("seed", seed.to_string())));
    if let Some(exact) = &scene.exact {
        rows.push(("exact solution", exact.name.to_owned()));
        rows.push(("exact relative area", format!("{:.6}", exact.relative_area)));
        rows.extend(exact.kappa_r.map(|kappa_r| ("exact kappa_r", format!("{kappa_r:.5}"))));
    }
    table(&rows)
}

/// The solver of a run and when it stops.
pub fn of_run(solver: &dyn Solver, stop: &Stop) -> String {
    table(&[
        ("solver", format!("{}: {}", solver.name(), solver.settings())),
        ("tolerance", format!("certificate {:e}, at most {} steps", stop.tolerance(), stop.max_iterations())),
    ])
}

fn table(rows: &[(&str, String)]) -> String {
    rows.iter().map(|(name, value)| format!("| {name} | {value} |\n")).collect()
}
