//! Facets of runs: what is told of a run that has ended, beyond its report.

use super::{Page, endless, stop, with};
use serde_json::{Value, json};

/// The sections of the steps: of one rigid shape, from the first step on, and at last that of the end.
#[test]
fn the_picture_moves_step_by_step() {
    let page = Page::open();
    for method in [
        json!({"method": "polonsky-keer"}),
        json!({"method": "gfmd", "masses": "stiffness", "dynamics": "fire", "time-step": 0.5, "damping": 1.0}),
    ] {
        let run = page.solve(&with(json!({"points": 256, "cutoff": 32, "solver": method})));
        let facet = |name: &str| page.get(&format!("/api/run/{}/{name}", run["id"].as_str().unwrap())).json();
        let (motion, end) = (facet("motion"), facet("section"));
        let values = |of: &Value| of.as_array().unwrap().iter().map(|z| z.as_f64().unwrap()).collect::<Vec<_>>();
        let steps = values(&motion["steps"]);
        assert!(
            steps[0] == 0.0 && steps.is_sorted_by(|a, b| a < b) && (6..200).contains(&steps.len()),
            "{method}: {steps:?}"
        );
        let sections = motion["sections"].as_array().unwrap();
        assert_eq!(sections.len(), steps.len());
        let away = |of: &Value, body: &str| {
            let [its, last] = [of, &end].map(|section| values(&section[body]));
            let by = its[0] - last[0];
            its.iter().zip(&last).map(|(a, b)| (a - b - by).abs()).fold(0.0, f64::max)
                / end["highest"].as_f64().unwrap()
        };
        for section in sections {
            assert!(away(section, "rigid") < 1e-4, "{method}: the rigid surface changes its shape");
        }
        let [first, last] = [&sections[0], sections.last().unwrap()].map(|section| away(section, "solid"));
        assert!(last < 0.05 && first > 2.0 * last, "{method}: the solid is {first} and {last} away from its end");
    }
}

/// The map of a surface holds the contact: pressures where the gap is closed, their mean the load, and the section as one of its rows.
#[test]
fn a_surface_is_seen_from_above() {
    let page = Page::open();
    let values = |of: &Value| of.as_array().unwrap().iter().map(|it| it.as_f64().unwrap()).collect::<Vec<f64>>();
    let run = page.solve(&with(json!({"domain": "surface", "points": 64, "cutoff": 16, "record": ["traces"]})));
    let facet = |name: &str| page.get(&format!("/api/run/{}/{name}", run["id"].as_str().unwrap())).json();
    let (top, section) = (facet("top"), facet("section"));
    assert_eq!(top["shape"], json!([64, 64]));
    let [pressure, gap, rigid] = ["pressure", "gap", "rigid"].map(|name| values(&top[name]));
    let widest = gap.iter().copied().fold(0.0, f64::max);
    let touching: Vec<f64> = pressure.iter().zip(&gap).filter(|(p, _)| **p > 0.0).map(|(_, g)| *g).collect();
    assert_eq!(touching.len() as f64 / 4096.0, run["numbers"]["relative_area_counted"].as_f64().unwrap());
    assert!(touching.iter().all(|gap| gap.abs() < 1e-6 * widest), "what touches has no gap");
    let highest = pressure.iter().copied().fold(0.0, f64::max);
    assert!((highest / top["highest_pressure"].as_f64().unwrap() - 1.0).abs() < 1e-6);
    let row = (section["y"].as_f64().unwrap() / top["size"][0].as_f64().unwrap() * 64.0).round() as usize;
    assert_eq!(rigid[64 * row..64 * (row + 1)], values(&section["rigid"]));
    assert_eq!(pressure[64 * row..64 * (row + 1)], values(&section["pressure"]));
    let fine = page.solve(&with(json!({"domain": "surface", "points": 512, "cutoff": 16, "record": ["traces"]})));
    let fine = page.get(&format!("/api/run/{}/top", fine["id"].as_str().unwrap())).json();
    assert_eq!(fine["shape"], json!([256, 256]));
    let line = page.solve(&with(json!({"points": 256, "cutoff": 64})));
    assert!(page.get(&format!("/api/run/{}/top", line["id"].as_str().unwrap())).json().is_null());
}

#[test]
fn the_numbers_of_every_step_are_told() {
    let page = Page::open();
    let run = page.solve(&with(json!({"points": 512, "cutoff": 64, "solver": {"method": "polonsky-keer"}})));
    let steps = page.get("/api/run/run-1/steps").json();
    let columns = steps.as_object().unwrap();
    let iterations = steps["iterations"].as_array().unwrap();
    assert!(iterations.len() > 10 && iterations[0].as_f64() < iterations[1].as_f64(), "{iterations:?}");
    assert_eq!(steps["step"], steps["iterations"], "the step of a row is its number of iterations");
    for (name, column) in columns.iter().filter(|(name, _)| *name != "step") {
        let last = column.as_array().unwrap().last().unwrap().as_f64().unwrap();
        assert_eq!(column.as_array().unwrap().len(), iterations.len(), "{name}");
        assert_eq!(Some(last), run["numbers"][name].as_f64(), "{name}");
    }
    for name in ["kappa_r", "relative_area", "certificate", "patches", "transforms", "seconds"] {
        assert!(columns.contains_key(name), "{name} is not among {:?}", columns.keys());
    }
}

#[test]
fn the_steps_of_long_runs_are_thinned() {
    let page = Page::open();
    let slow = json!({"solver": {"method": "gfmd", "time-step": 0.05, "damping": 10}, "points": 256, "cutoff": 64, "stop": stop(1e-15, 9001)});
    page.solve(&with(slow));
    let steps = page.get("/api/run/run-1/steps").json();
    let iterations: Vec<f64> = steps["iterations"].as_array().unwrap().iter().map(|it| it.as_f64().unwrap()).collect();
    assert!((1000..=2001).contains(&iterations.len()), "{}", iterations.len());
    let [body @ .., _] = iterations.as_slice() else { panic!("no steps") };
    assert!(body.windows(2).all(|pair| pair[1] - pair[0] == 8.0), "{body:?}");
    assert_eq!(*iterations.last().unwrap(), 9001.0);
}

/// A solver on nested grids says which steps are on a coarser grid, where a certificate is that of another problem.
#[test]
fn steps_on_coarser_grids_are_told() {
    let page = Page::open();
    let nested = page.solve(&with(json!({"points": 512, "cutoff": 64})));
    let steps = page.get(&format!("/api/run/{}/steps", nested["id"].as_str().unwrap())).json();
    let levels: Vec<u64> = steps["level"].as_array().unwrap().iter().map(|it| it.as_u64().unwrap()).collect();
    assert!(
        levels[0] > 0 && levels.last() == Some(&0) && levels.is_sorted_by(|a, b| a >= b),
        "from coarse to fine: {levels:?}"
    );
}

#[test]
fn facets_are_those_of_runs_that_have_ended() {
    let page = Page::open();
    for path in ["/api/run/run-1/steps", "/api/run/run-1", "/api/run/"] {
        assert_eq!(page.get(path).status, 404, "{path}");
    }
    page.order("/api/solve", &endless());
    page.wait(|state| state["run"]["numbers"]["status"] == "running");
    let refused = page.get("/api/run/run-1/steps");
    assert_eq!((refused.status, refused.text()), (409, "run-1 has no steps: request it after the solve has ended"));
    assert_eq!(page.get("/api/run/run-1/everything").status, 404);
    assert_eq!(page.post("/api/cancel", "{}").status, 200);
    page.wait(|state| state["busy"] == false);
    assert_ne!(page.get("/api/run/run-1/steps").json(), Value::Null);
}

/// The sections of a sweep: one for each of its points, of one rigid shape, and with ever more contact.
#[test]
fn the_picture_moves_load_by_load() {
    let page = Page::open();
    page.order("/api/sweep", &with(json!({"points": 512, "cutoff": 64})));
    let state = page.wait(|state| state["busy"] == false && state["sweep"]["ended"] == true);
    let points = state["sweep"]["points"].as_array().unwrap();
    let id = state["sweep"]["id"].as_str().unwrap();
    let motion = page.get(&format!("/api/run/{id}/motion")).json();
    let numbers: Vec<&Value> = points.iter().map(|point| &point["number"]).collect();
    for point in points {
        let [number, load] = ["number", "reduced_pressure"].map(|name| point[name].as_f64().unwrap());
        let its = 1e-4 * 10f64.powf((number - 1.0) / 12.0);
        assert!((load / its - 1.0).abs() < 1e-6, "load {number} of the viewer is {its}, of the page {load}");
    }
    assert_eq!(motion["steps"].as_array().unwrap().iter().collect::<Vec<_>>(), numbers);
    let values = |of: &Value| of.as_array().unwrap().iter().map(|z| z.as_f64().unwrap()).collect::<Vec<_>>();
    let sections = motion["sections"].as_array().unwrap();
    let shape = |section: &Value| {
        let rigid = values(&section["rigid"]);
        rigid.iter().map(|z| (z - rigid[0]) / section["highest"].as_f64().unwrap()).collect::<Vec<_>>()
    };
    let first = shape(&sections[0]);
    let touching = |section: &Value| values(&section["pressure"]).iter().filter(|p| **p > 0.0).count();
    for section in sections {
        let away = shape(section).iter().zip(&first).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(away < 1e-4, "the rigid surface changes its shape by {away}");
    }
    let counts: Vec<usize> = sections.iter().map(touching).collect();
    assert!(counts.is_sorted() && counts[0] < 10 && *counts.last().unwrap() == first.len(), "{counts:?}");
    let other = page.get(&format!("/api/run/{id}/patches"));
    assert_eq!(other.status, 409, "{}", other.text());
}

/// A friction eight times too strong is found to be what held a run up, and the run is told step by step.
#[test]
fn a_run_tells_why_it_was_slow() {
    let page = Page::open();
    let solver = json!({"method": "gfmd", "masses": "uniform", "dynamics": "damped", "time-step": 0.5, "damping": 8});
    let run = page.solve(&with(json!({"points": 256, "cutoff": 32, "solver": solver})));
    let why = page.get("/api/run/run-1/why").json();
    assert_eq!(why["causes"][0]["cause"], "damping", "{}", why["causes"]);
    assert!((why["causes"][0]["damping"].as_f64().unwrap() / 8.0 - 1.0).abs() < 0.01, "{}", why["causes"]);
    let steps = run["numbers"]["iterations"].as_u64().unwrap();
    assert_eq!(why["standing"]["steps"].as_u64(), Some(steps));
    let stretches = why["decisions"]["stretches"].as_array().unwrap();
    assert_eq!(stretches.last().unwrap()["name"], "damped");
    assert!(stretches.last().unwrap()["steps"][1].as_u64().unwrap() + 1 >= steps);
    let rows = why["errors"]["rows"].as_array().unwrap();
    let worst = |row: &Value| row.as_array().unwrap().iter().filter_map(Value::as_f64).fold(0.0, f64::max);
    assert!(rows.len() > 50 && worst(&rows[rows.len() - 2]) < 0.01 * worst(&rows[0]), "errors do not fall");
    assert_eq!(rows.len(), why["errors"]["steps"].as_array().unwrap().len());
}
