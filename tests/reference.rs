//! Pressures computed by another code: Tamaas 2.9.0, Polonsky-Keer-Rey, to a tolerance of 1e-12, with the same kernel.
//!
//! The differences are printed with `cargo test --release --test reference -- --nocapture`.

#[allow(dead_code, reason = "not every test file uses every helper")]
mod common;

use asperity::contact::{Contact, ContactModulus, Load, Problem, Solver};
use asperity::surface::{Field, read_heights};
use asperity::{Grid, Surface};
use common::{relative_l2, solve, solvers};
use serde_json::Value;
use std::path::{Path, PathBuf};

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name)
}

fn field(name: &str) -> Field {
    let values = read_heights(data(name)).unwrap();
    let shape = match *values.shape() {
        [n] => [1, n],
        [ny, nx] => [ny, nx],
        _ => panic!("{name} has rank {}", values.ndim()),
    };
    values.to_shape(shape).unwrap().into_owned()
}

struct Case {
    name: String,
    problem: Problem,
    pressure: Field,
    relative_area: f64,
    mean_gap: f64,
}

impl Case {
    fn of(entry: &Value) -> Self {
        let number = |key: &str| entry[key].as_f64().unwrap();
        let name = entry["name"].as_str().unwrap().to_owned();
        let height = field(&format!("{name}.height.npy"));
        let grid = match *height.shape() {
            [1, n] => Grid::line(n, number("size")),
            [ny, nx] => Grid::surface([ny, nx], [number("size"); 2]),
            _ => panic!("a field has two axes"),
        };
        let surface = Surface::new(grid.unwrap(), height).unwrap();
        Self {
            problem: Problem::new(
                surface,
                ContactModulus(number("contact_modulus")),
                Load::MeanPressure(number("mean_pressure")),
            )
            .unwrap(),
            pressure: field(&format!("{name}.pressure.npy")),
            relative_area: number("relative_area"),
            mean_gap: number("mean_gap"),
            name,
        }
    }

    fn all() -> Vec<Self> {
        let text = std::fs::read_to_string(data("reference.json")).unwrap();
        let entries: Vec<Value> = serde_json::from_str(&text).unwrap();
        assert_eq!(entries.len(), 5);
        entries.iter().map(Self::of).collect()
    }

    fn assert_agrees(&self, solver: &dyn Solver, contact: &Contact) {
        let who = format!("{}, {}", self.name, solver.settings());
        let error = relative_l2(&contact.pressure, &self.pressure);
        println!("{error:.1e}  {who}");
        assert!(error < 1e-6, "{who}: pressures differ by {error}");
        let faint = 1e-9 * self.problem.expected_mean_pressure();
        let differ = |(a, b): (&f64, &f64)| (*a > 0.0) != (*b > 0.0) && a.max(*b) > faint;
        let differing = contact.pressure.iter().zip(&self.pressure).filter(|&pair| differ(pair)).count();
        assert_eq!(differing, 0, "{who}: nodes in one contact only");
        assert_eq!(contact.measures().relative_area, self.relative_area, "{who}");
        assert!((contact.mean_gap() / self.mean_gap - 1.0).abs() < 1e-8, "{who}: mean gap");
    }
}

#[test]
fn every_solver_finds_the_pressures_of_the_reference() {
    for case in Case::all() {
        for solver in solvers() {
            case.assert_agrees(solver.as_ref(), &solve(solver.as_ref(), &case.problem, 1e-12));
        }
    }
}
