//! Solids that yield below their surface on the page: zone, imprint and numbers are those of the library.

use super::{Page, number, values, with};
use asperity::explore::Knobs;
use asperity::job::HistoryOutcome;
use serde_json::{Value, json};

/// A cylinder on a solid that yields, on few points.
fn cylinder(changes: Value) -> Value {
    let mut knobs = with(json!({
        "body": "round", "roughness": 0, "points": 256, "load": 0.01, "yield-stress": 1e-4, "record": ["traces"]
    }));
    changes.as_object().unwrap().iter().for_each(|(name, value)| knobs[name] = value.clone());
    knobs
}

fn facet(page: &Page, run: &Value, name: &str) -> Value {
    page.get(&format!("/api/run/{}/{name}", run["id"].as_str().unwrap())).json()
}

/// Rows and columns of the first and of the last place with a value in a field of a zone.
fn yielded(zone: &Value) -> [usize; 2] {
    let columns = zone["columns"].as_u64().unwrap() as usize;
    let strain = values(&zone["strain"]["values"]);
    let rows: Vec<usize> = (0..strain.len()).filter(|i| strain[*i] > 0.0).map(|i| i / columns).collect();
    [rows[0], *rows.last().unwrap()]
}

#[test]
fn a_zone_lies_below_the_contact_and_grows_with_each_state() {
    let page = Page::open();
    let run = page.solve(&cylinder(json!({"yield-stress": 1.5e-4})));
    assert_eq!((&run["process"]["kind"], &run["numbers"]["status"]), (&json!("plastic"), &json!("converged")));
    let zone = &facet(&page, &run, "section")["zone"];
    let [first, last] = yielded(zone);
    assert!(first > 2, "the surface does not yield: {first}");
    // the last row ends at 0.3 of the cell of 160 um
    let depth = zone["depth"].as_f64().unwrap();
    assert!((depth - 48e-6).abs() < 1e-12);
    let deepest = (last as f64 + 1.0) / 64.0 * depth;
    assert!((deepest / number(&run, "deepest_yield") - 1.0).abs() < 0.15, "{deepest}");
    let strain = zone["strain"]["highest"].as_f64().unwrap();
    assert!((strain / number(&run, "max_plastic_strain") - 1.0).abs() < 1e-12);
    let stress = zone["stress"]["highest"].as_f64().unwrap();
    assert!((1.5e-4..1.7e-4).contains(&stress), "the von Mises stress is a little above the yield stress: {stress}");
    let sections = facet(&page, &run, "motion")["sections"].as_array().unwrap().clone();
    let grown: Vec<f64> = sections.iter().map(|it| it["zone"]["strain"]["highest"].as_f64().unwrap()).collect();
    assert!(grown.len() == 4 && grown[0] == 0.0 && grown.is_sorted() && grown[3] == strain, "{grown:?}");
    assert_eq!(facet(&page, &run, "shear"), Value::Null, "the stress by the pressure alone is not that of the solid");
}

/// What the page shows of a release is the history of the setup that it gives, to the bit.
#[test]
fn a_release_leaves_the_imprint_of_the_library() {
    let page = Page::open();
    let knobs = cylinder(json!({"release": true}));
    let run = page.solve(&knobs);
    assert!(run["title"].as_str().unwrap().contains(", released, Y/E* = 1e-4"), "{}", run["title"]);
    let setup = serde_json::from_value::<Knobs>(knobs).unwrap().setup().unwrap();
    let outcome = HistoryOutcome::solve(&setup, &setup.problem().unwrap(), &mut ()).unwrap();
    let last = outcome.states.last().unwrap();
    for name in ["imprint_depth", "plastic_work", "max_plastic_strain", "deepest_yield"] {
        let quantity = asperity::contact::Quantity::find(name).unwrap();
        assert_eq!(number(&run, name), last.get(quantity).unwrap(), "{name}");
    }
    let section = facet(&page, &run, "section");
    assert_eq!(section["highest_pressure"], 0.0);
    let solid = values(&section["solid"]);
    let [low, high] = [f64::min, f64::max].map(|of| solid.iter().copied().reduce(of).unwrap());
    assert!(((high - low) / number(&run, "imprint_depth") - 1.0).abs() < 1e-5, "the solid keeps its imprint");
    assert!(solid.iter().position(|z| *z == low).unwrap().abs_diff(128) < 3, "below the cylinder");
    let loads = values(&facet(&page, &run, "steps")["mean_pressure"]);
    assert_eq!(loads.len(), 8);
    assert!(loads[..4].is_sorted() && loads[7] == 0.0, "{loads:?}");
}

/// Below a surface the zone is that of the row of the highest peak, and its section is that row.
#[test]
fn a_surface_is_cut_where_its_zone_is() {
    let page = Page::open();
    let knobs =
        json!({"domain": "surface", "body": "round", "points": 32, "cutoff": 8, "yield-stress": 5e-5, "load": 0.02});
    let run = page.solve(&cylinder(knobs));
    let section = facet(&page, &run, "section");
    assert_eq!(section["y"], json!(16.0 * 160e-6 / 32.0));
    assert!(section["zone"]["strain"]["highest"].as_f64() > Some(0.0));
    assert!(facet(&page, &run, "top")["fields"]["imprint"].is_object());
}

#[test]
fn what_cannot_be_solved_or_takes_too_long_is_refused() {
    let page = Page::open();
    for (changes, words) in [
        (json!({"hardness": 5e-4}), "a yield stress and a hardness"),
        (json!({"layer": 0.1}), "a yield stress and a layer"),
        (json!({"creep": 9, "time": 1}), "creep and a yield stress"),
        (json!({"adhesion": 1e-6}), "adhesion and a yield stress"),
        (json!({"friction": 0.3, "sideways": 0.5}), "a yield stress and friction"),
        (json!({"solver": {"method": "gfmd"}}), "gfmd"),
        (
            json!({"points": 4096}),
            "4096 points are too many where the solid yields below its surface: give at most 2048",
        ),
        (json!({"domain": "surface", "points": 256}), "256 x 256 points are too many"),
        (json!({"yield-stress": 2}), "`yield-stress` cannot be 2"),
        (json!({"hardening": 0}), "`hardening` cannot be 0"),
    ] {
        let answer = page.post("/api/solve", &cylinder(changes.clone()).to_string());
        assert!(answer.status == 400 && answer.text().contains(words), "{changes}: {}", answer.text());
    }
    let swept = page.post("/api/sweep", &cylinder(json!({})).to_string());
    assert!(swept.status == 400 && swept.text().contains("a yield stress cannot be swept"), "{}", swept.text());
    let hold = json!({"knobs": cylinder(json!({})), "mean-gap": null, "is-deep": false}).to_string();
    let held = page.post("/api/hold", &hold);
    assert!(held.status == 400 && held.text().contains("cannot be dragged"), "{}", held.text());
    page.order("/api/solve", &cylinder(json!({"load": 10, "yield-stress": 1e-5})));
    let state = page.wait(|state| state["busy"] == false);
    assert_eq!(state["known_fault"]["key"], "yields-everywhere", "{}", state["fault"]);
    assert_eq!(state["known_fault"]["places"]["limit"], "0.0000175");
}
