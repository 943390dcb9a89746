//! Contacts under the hand, and what can be picked of runs.

use super::Page;
use asperity::explore::Start;
use serde_json::{Value, json};
use std::f64::consts::PI;

fn knobs(start: Start, changes: Value) -> Value {
    let mut knobs = serde_json::to_value(start.knobs()).unwrap();
    for (key, value) in changes.as_object().unwrap() {
        knobs[key] = value.clone();
    }
    knobs
}

fn hold(page: &Page, knobs: &Value, mean_gap: Option<f64>, is_deep: bool) -> Value {
    let order = json!({"knobs": knobs, "mean-gap": mean_gap, "is-deep": is_deep});
    let answer = page.post("/api/hold", &order.to_string());
    assert_eq!(answer.status, 200, "{}", answer.text());
    answer.json()
}

fn numbers(values: &Value) -> Vec<f64> {
    values.as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).collect()
}

/// At the gap that a load has, the hand finds that load.
#[test]
fn the_hand_finds_the_load_of_a_gap() {
    let page = Page::open();
    let knobs = knobs(Start::RoughLine, json!({"load": 0.2}));
    let loaded = hold(&page, &knobs, None, false);
    let gap = loaded["section"]["mean_gap"].as_f64().unwrap();
    let held = hold(&page, &knobs, Some(gap), false);
    let load = held["numbers"]["reduced_pressure"].as_f64().unwrap();
    assert!((load / 0.2 - 1.0).abs() < 1e-3, "{load}");
    let closer = hold(&page, &knobs, Some(0.8 * gap), false);
    assert!(closer["numbers"]["reduced_pressure"].as_f64().unwrap() > load);
    let [rigid, solid, pressure] = ["rigid", "solid", "pressure"].map(|name| numbers(&held["section"][name]));
    assert_eq!(rigid.len(), 1024);
    for ((rigid, solid), pressure) in rigid.iter().zip(&solid).zip(&pressure) {
        assert!(*pressure == 0.0 || (rigid - solid).abs() < 1e-4 * gap, "pressed at a gap of {}", rigid - solid);
    }
}

/// The stress below a smooth cylinder is largest where Hertz says: 0.30 of the largest pressure at 0.78 half-widths (Johnson), and on top of
/// it that of the mean pressure in a cell that its neighbours confine, `(1 - nu/(1 - nu))/2` of it.
#[test]
fn the_stress_below_is_that_of_hertz() {
    let page = Page::open();
    let held = hold(&page, &knobs(Start::HertzLine, json!({"load": 0.002})), None, true);
    let shear = &held["shear"];
    let (values, columns) = (numbers(&shear["values"]), shear["columns"].as_u64().unwrap() as usize);
    let (at, most) = values.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).unwrap();
    let pressure = numbers(&held["section"]["pressure"]).into_iter().fold(0.0, f64::max);
    assert_eq!(*most, 255.0);
    let highest = shear["highest"].as_f64().unwrap();
    let modulus = held["numbers"]["max_pressure"].as_f64().unwrap() / pressure;
    let confined = 0.5 * (1.0 - 0.3 / 0.7) * held["numbers"]["mean_pressure"].as_f64().unwrap() / modulus;
    assert!(((highest - confined) / pressure - 0.300).abs() < 0.006, "{highest}, {confined} of {pressure}");
    let length = held["section"]["length"].as_f64().unwrap();
    let half_width = 0.5 * length * held["numbers"]["relative_area"].as_f64().unwrap();
    let rows = values.len() / columns;
    let depth = shear["depth"].as_f64().unwrap() * (at / columns) as f64 / (rows - 1) as f64;
    assert!((depth / half_width - 0.78).abs() < 0.12, "{}", depth / half_width);
}

#[test]
fn a_hand_that_holds_nothing_is_told_so() {
    let page = Page::open();
    let rough = knobs(Start::RoughLine, json!({}));
    for (order, words) in [
        (json!({"knobs": rough, "mean-gap": 1.0, "is-deep": false}), "nothing touches"),
        (json!({"knobs": rough, "mean-gap": -1.0, "is-deep": false}), "everything touches"),
        (json!({"knobs": rough, "is-deep": false, "speed": 2}), "there is no `speed` here"),
        (
            json!({"knobs": knobs(Start::RoughLine, json!({"bumps": vec![[0.5, 1e-3, 0.01]; 33]})), "is-deep": false}),
            "33 bumps",
        ),
        (
            json!({"knobs": knobs(Start::RoughSurface, json!({"bumps": [[0.5, 1e-3, 0.01]]})), "is-deep": false}),
            "needs a line",
        ),
        (
            json!({"knobs": knobs(Start::RoughLine, json!({"beside": rough_surface()})), "is-deep": false}),
            "beside a surface",
        ),
    ] {
        let answer = page.post("/api/hold", &order.to_string());
        assert_eq!((answer.status, answer.text().contains(words)), (400, true), "{}", answer.text());
    }
}

fn rough_surface() -> Value {
    knobs(Start::RoughSurface, json!({}))
}

/// A smooth body is its own twin.
#[test]
fn hertz_is_its_own_twin() {
    let page = Page::open();
    for (start, load, kappa_r) in
        [(Start::HertzLine, 0.01, 8.0 / (PI * 3f64.sqrt())), (Start::HertzSurface, 0.05, 1.66608)]
    {
        let run = page.solve(&knobs(start, json!({"load": load, "record": ["traces"]})));
        let table = page.get(&format!("/api/run/{}/patches", run["id"].as_str().unwrap())).json();
        let patches = table["patches"].as_array().unwrap();
        assert_eq!(patches.len(), 1);
        let (patch, twin) = (&patches[0], &patches[0]["twin"]);
        for name in ["area", "max_pressure"] {
            let [its, of] = [patch, twin].map(|it| it[name].as_f64().unwrap());
            assert!((its / of - 1.0).abs() < 0.03, "{start:?}: the {name} is {its} and that of the twin {of}");
        }
        assert!((patch["share"].as_f64().unwrap() - 1.0).abs() < 1e-6);
        assert!((twin["kappa_r"].as_f64().unwrap() - kappa_r).abs() < 1e-4);
        let map = numbers(&table["map"]);
        let covered = map.iter().filter(|&&number| number == 1.0).count() as f64 / map.len() as f64;
        let area = run["numbers"]["relative_area"].as_f64().unwrap();
        assert!((covered / area - 1.0).abs() < 0.1, "{covered} of the map, {area} of the surface");
    }
}

/// Two surfaces under one mean pressure, though `p*` counts each by its own gradient.
#[test]
fn a_surface_is_pressed_beside_another() {
    let page = Page::open();
    let steeper = knobs(Start::RoughLine, json!({"roughness": 0.002, "seed": 2}));
    let run = page.solve(&knobs(Start::RoughLine, json!({"load": 0.1, "beside": steeper})));
    let load = |numbers: &Value| numbers["reduced_pressure"].as_f64().unwrap();
    assert!((load(&run["beside"]["numbers"]) / 0.05 - 1.0).abs() < 1e-9, "{run}");
    let beside = page.get(&format!("/api/run/{}/beside", run["id"].as_str().unwrap())).json();
    assert_eq!(numbers(&beside["rigid"]).len(), 1024);
    let without = page.solve(&knobs(Start::RoughLine, json!({"load": 0.1})));
    assert_eq!(without["beside"], Value::Null);
    assert_eq!(run["numbers"]["relative_area"], without["numbers"]["relative_area"]);
}

/// A cylinder beside a rough line has its exact pressure, under the mean pressure of both.
#[test]
fn a_cylinder_beside_another_surface_keeps_its_exact_pressure() {
    let page = Page::open();
    let cylinder = knobs(Start::RoughLine, json!({"body": "round", "roughness": 0}));
    let run = page.solve(&knobs(Start::RoughLine, json!({"load": 0.1, "beside": cylinder})));
    let facet = |name: &str| page.get(&format!("/api/run/{}/{name}", run["id"].as_str().unwrap())).json();
    let beside = facet("beside");
    let [exact, pressure] = ["exact", "pressure"].map(|name| numbers(&beside[name]));
    let highest = pressure.iter().copied().fold(0.0, f64::max);
    let largest_error = exact.iter().zip(&pressure).map(|(p, q)| (p - q).abs()).fold(0.0, f64::max);
    assert!(highest > 0.0 && largest_error < 0.05 * highest, "{largest_error} of {highest}");
    assert!(facet("section")["exact"].is_null());
}
