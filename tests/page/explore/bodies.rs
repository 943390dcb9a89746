//! The two bodies in the section that the page draws: the rigid surface keeps its shape, and the solid is pressed down.

use super::Page;
use asperity::explore::Start;
use asperity::setup::Setup;
use serde_json::{Value, json};

/// Knobs of a start at a load, a cylinder or a rough profile or surface, with one column of the section for each node.
fn knobs(start: Start, load: f64) -> Value {
    let mut knobs = serde_json::to_value(start.knobs()).unwrap();
    knobs["load"] = load.into();
    knobs["record"] = json!(["traces"]);
    if knobs["domain"] == "line" {
        knobs["points"] = 512.into();
        knobs["cutoff"] = 64.into();
    }
    knobs
}

/// A run of the start at the load, and its section.
fn pressed(page: &Page, start: Start, load: f64) -> (Value, Value) {
    let run = page.solve(&knobs(start, load));
    let section = page.get(&format!("/api/run/{}/section", run["id"].as_str().unwrap())).json();
    (run, section)
}

fn numbers(values: &Value) -> Vec<f64> {
    values.as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).collect()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Values less their mean, and the largest of them.
fn shape(values: &[f64]) -> (Vec<f64>, f64) {
    let mean = mean(values);
    let shape: Vec<f64> = values.iter().map(|value| value - mean).collect();
    let most = shape.iter().map(|value| value.abs()).fold(0.0, f64::max);
    (shape, most)
}

/// The heights along the row of a section, from the setup of its run.
fn heights(run: &Value, section: &Value) -> Vec<f64> {
    let problem = Setup::from_toml(run["setup"].as_str().unwrap()).unwrap().problem().unwrap();
    let grid = *problem.surface().grid();
    let row = section["y"].as_f64().map_or(0, |y| (y / grid.spacing()[0]).round() as usize);
    problem.height()[row * grid.shape()[1]..][..grid.shape()[1]].to_vec()
}

const STARTS: [Start; 4] = [Start::HertzLine, Start::RoughLine, Start::HertzSurface, Start::RoughSurface];

/// The rigid surface less its mean is the negative of the heights less theirs, at every load: peaks towards the solid point down.
#[test]
fn the_rigid_surface_has_the_shape_of_the_heights_at_all_loads() {
    let page = Page::open();
    for start in STARTS {
        for load in [0.02, 0.3, 1.0] {
            let (run, section) = pressed(&page, start, load);
            let (rigid, _) = shape(&numbers(&section["rigid"]));
            let (height, most) = shape(&heights(&run, &section));
            assert_eq!(rigid.len(), height.len());
            for (rigid, height) in rigid.iter().zip(&height) {
                assert!((rigid + height).abs() < 1e-5 * most, "{start:?} at {load}: {rigid} at the height {height}");
            }
        }
    }
}

/// The shape is the same at all loads where a column stands for several nodes too.
#[test]
fn the_rigid_surface_keeps_its_shape_in_columns_of_nodes() {
    let page = Page::open();
    let shapes = [0.02, 0.3, 1.0].map(|load| {
        let mut knobs = knobs(Start::RoughLine, load);
        knobs["points"] = 4096.into();
        knobs["cutoff"] = 512.into();
        let order = json!({"knobs": knobs, "mean-gap": null, "is-deep": false});
        shape(&numbers(&page.post("/api/hold", &order.to_string()).json()["section"]["rigid"]))
    });
    for (rigid, most) in &shapes {
        let away = rigid.iter().zip(&shapes[0].0).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(rigid.len() == 1024 && away < 1e-5 * most, "{away} of {most}");
    }
}

/// The solid is lower where it is pressed than where it is not, and lowest where the rigid surface is; a free one would be flat.
#[test]
fn the_solid_is_lower_below_the_contact() {
    let page = Page::open();
    for start in STARTS {
        let (_, section) = pressed(&page, start, 0.1);
        let [rigid, solid, pressure] = ["rigid", "solid", "pressure"].map(|name| numbers(&section[name]));
        let of = |is_pressed: bool| {
            let chosen = solid.iter().zip(&pressure).filter(|(_, pressure)| (**pressure > 0.0) == is_pressed);
            mean(&chosen.map(|(z, _)| *z).collect::<Vec<_>>())
        };
        assert!(of(true) < of(false), "{start:?}: {} below the contact, {} beside it", of(true), of(false));
        let apart = rigid.iter().zip(&solid).map(|(rigid, solid)| rigid - solid);
        assert!(apart.fold(f64::INFINITY, f64::min) > -1e-6 * shape(&rigid).1, "{start:?}: the bodies overlap");
        if matches!(start, Start::HertzLine | Start::HertzSurface) {
            let lowest = |values: &[f64]| (0..values.len()).min_by(|&a, &b| values[a].total_cmp(&values[b])).unwrap();
            assert!(lowest(&rigid).abs_diff(lowest(&solid)) <= 1, "{start:?}");
        }
    }
}

/// A column of several nodes keeps the largest of their pressures, so that the picture reaches that of the contact.
#[test]
fn the_picture_reaches_the_largest_pressure() {
    let page = Page::open();
    for start in STARTS {
        let mut knobs = serde_json::to_value(start.knobs()).unwrap();
        knobs["record"] = json!(["traces"]);
        let run = page.solve(&knobs);
        let section = page.get(&format!("/api/run/{}/section", run["id"].as_str().unwrap())).json();
        let drawn = numbers(&section["pressure"]).into_iter().fold(0.0, f64::max);
        let highest = run["numbers"]["max_pressure_over_modulus"].as_f64().unwrap();
        assert!((drawn / highest - 1.0).abs() < 1e-6, "{start:?}: {drawn} of {highest}");
    }
}

/// The contact under the hand and the surface beside have the same picture as a run.
#[test]
fn the_hand_and_the_surface_beside_show_the_same_picture() {
    let page = Page::open();
    let mut beside = knobs(Start::RoughLine, 0.3);
    beside["seed"] = 2.into();
    let mut both = knobs(Start::RoughLine, 0.3);
    both["beside"] = beside.clone();
    let order = json!({"knobs": both, "mean-gap": null, "is-deep": false});
    let held = page.post("/api/hold", &order.to_string()).json();
    for (part, knobs) in [("section", knobs(Start::RoughLine, 0.3)), ("beside", beside)] {
        let run = page.solve(&knobs);
        let (rigid, _) = shape(&numbers(&held[part]["rigid"]));
        let (height, most) = shape(&heights(&run, &held[part]));
        let away = rigid.iter().zip(&height).map(|(rigid, height)| (rigid + height).abs()).fold(0.0, f64::max);
        assert!(away < 1e-5 * most, "{part}: {away} of {most}");
    }
}
