//! Descriptions of scenes.

use crate::contact::{Problem, Solver, Stop};
use crate::theory::Exact;

/// Parameters, solver and exact values of one scene, in Markdown: its `surface` in words, lengths in `unit`.
pub fn describe(
    surface: &str,
    problem: &Problem,
    unit: &str,
    solver: &dyn Solver,
    stop: &Stop,
    exact: Option<&Exact>,
) -> String {
    let grid = problem.surface().grid();
    let along = |values: [String; 2]| if grid.is_line() { values[1].clone() } else { values.join(" x ") };
    let mut rows = vec![
        ("surface", surface.to_owned()),
        ("points", along(grid.shape().map(|n| n.to_string()))),
        ("cell", format!("{} {unit}", along(grid.size().map(|l| format!("{l:.4e}"))))),
        ("rms height", format!("{:.4e} {unit}", problem.rms_height())),
        ("rms gradient", format!("{:.4e}", problem.rms_gradient())),
        ("contact modulus E*", format!("{:.4e}", problem.contact_modulus())),
    ];
    if let Some(mean) = problem.mean_pressure() {
        let reduced = mean / (problem.contact_modulus() * problem.rms_gradient());
        rows.push(("mean pressure", format!("{mean:.4e}, in the unit of E*")));
        rows.push(("reduced pressure p*", format!("{reduced:.4e}")));
    }
    rows.extend(problem.mean_gap().map(|gap| ("mean gap", format!("{gap:.4e} {unit}"))));
    rows.extend([
        ("solver", format!("{}: {}", solver.name(), solver.settings())),
        ("tolerance", format!("certificate {:e}, at most {} steps", stop.tolerance(), stop.max_iterations())),
    ]);
    rows.extend(problem.surface().seed().map(|seed| ("seed", seed.to_string())));
    if let Some(exact) = exact {
        rows.push(("exact solution", exact.name.to_owned()));
        rows.push(("exact relative area", format!("{:.6}", exact.relative_area)));
        rows.extend(exact.kappa_r.map(|k| ("exact kappa_r", format!("{k:.5}"))));
    }
    let lines = rows.iter().map(|(name, value)| format!("| {name} | {value} |\n"));
    format!("| | |\n|---|---|\n{}", lines.collect::<String>())
}
