//! Friction on the page: contacts that are pulled back and forth, and that roll.

use super::{Page, number, values, with};
use asperity::contact::{Multilevel, Solver};
use asperity::flow::{FlowAxis, Leakage};
use asperity::setup::Setup;
use serde_json::{Value, json};

/// A smooth cylinder with friction.
fn cylinder(changes: Value) -> Value {
    let mut state = with(json!({"body": "round", "roughness": 0, "load": 0.01, "friction": 0.3, "sideways": 0.5}));
    state.as_object_mut().unwrap().extend(changes.as_object().unwrap().clone());
    state
}

/// What sticks below a tangential load `Q` is what would touch under the load `P - Q/mu` (Jäger).
#[test]
fn a_pulled_contact_sticks_where_a_lighter_one_touches() {
    let page = Page::open();
    let run = page.solve(&cylinder(json!({})));
    let elastic =
        |load: f64| number(&page.solve(&cylinder(json!({"sideways": 0, "load": load}))), "relative_area_counted");
    let share = elastic(0.005) / elastic(0.01);
    let told = number(&run, "stick_share");
    assert!((told / share - 1.0).abs() < 0.02, "{told} sticks, {share} would touch");
    assert_eq!(
        (&run["process"]["kind"], &run["numbers"]["kappa_r_error"]),
        (&json!("slip"), &run["numbers"]["kappa_r_error"])
    );
    let facet = |name: &str| page.get(&format!("/api/run/{}/{name}", run["id"].as_str().unwrap())).json();
    let section = facet("section");
    let [pressure, traction] = [&section["pressure"], &section["fields"]["traction"]].map(values);
    assert!(pressure.iter().zip(&traction).all(|(p, t)| t.abs() <= 0.3 * p * (1.0 + 1e-6)), "traction above friction");
    let ratio = traction.iter().sum::<f64>() / (0.3 * pressure.iter().sum::<f64>());
    assert!((ratio - 0.5).abs() < 0.01, "the traction carries {ratio}");
}

/// The cycle ends where it passed before, and has lost energy.
#[test]
fn a_cycle_of_the_pull_is_a_closed_loop() {
    let page = Page::open();
    let run = page.solve(&cylinder(json!({"points": 1024})));
    let steps = page.get(&format!("/api/run/{}/steps", run["id"].as_str().unwrap())).json();
    assert_eq!(run["process"]["charts"][0], json!(["shift", "mean_traction"]));
    let [shift, traction, lost] = ["shift", "mean_traction", "dissipated"].map(|name| values(&steps[name]));
    assert_eq!((shift.len(), traction.len()), (24, 24));
    assert!((shift[23] / shift[7] - 1.0).abs() < 1e-3, "{} and {}", shift[7], shift[23]);
    assert!((traction[23] / traction[7] - 1.0).abs() < 1e-9 && traction[15] < 0.0);
    assert!(lost[23] > lost[15] && lost[15] > lost[7], "{lost:?}");
    let area: f64 = (7..23).map(|i| 0.5 * (traction[i] + traction[i + 1]) * (shift[i + 1] - shift[i])).sum();
    assert!((area / (lost[23] - lost[7]) - 1.0).abs() < 0.05, "the loop holds {area}, lost is {}", lost[23] - lost[7]);
}

/// Carter: of a rolling cylinder under `Q` the part `sqrt(1 - Q/(mu P))` sticks.
#[test]
fn a_rolling_cylinder_sticks_as_carter_found() {
    let page = Page::open();
    let run = page.solve(&cylinder(json!({"rolling": true, "points": 2048})));
    assert_eq!(run["process"]["kind"], "rolling");
    let stuck = number(&run, "stick_share");
    assert!((stuck - 0.5f64.sqrt()).abs() < 0.02, "{stuck} sticks");
    assert!(number(&run, "creepage").abs() > 0.0);
}

#[test]
fn friction_is_refused_where_it_has_no_solution() {
    let page = Page::open();
    for (changes, words) in [
        (json!({"hardness": 5e-4}), "friction is solved for elastic contacts"),
        (json!({"adhesion": 1e-6}), "friction is solved for elastic contacts"),
        (json!({"creep": 9, "time": 1}), "friction is solved for elastic contacts"),
        (json!({"rolling": true, "domain": "surface", "points": 64, "cutoff": 16}), "rolling is solved on lines only"),
        (json!({"sideways": 1}), "`sideways` cannot be 1"),
    ] {
        let answer = page.post("/api/solve", &cylinder(changes.clone()).to_string());
        assert!(answer.status == 400 && answer.text().contains(words), "{changes}: {}", answer.text());
    }
    let swept = page.post("/api/sweep", &cylinder(json!({})).to_string());
    assert!(
        swept.status == 400 && swept.text().contains("tangential loads of a path cannot be swept"),
        "{}",
        swept.text()
    );
    let hold = json!({"knobs": cylinder(json!({})), "mean-gap": null, "is-deep": false}).to_string();
    let held = page.post("/api/hold", &hold);
    assert!(held.status == 400 && held.text().contains("cannot be dragged"), "{}", held.text());
}

/// A pulled surface has its traction and slip as maps, and any surface its leakage, which is that of the library.
#[test]
fn maps_of_traction_and_flux_are_those_of_the_contact() {
    let page = Page::open();
    let surface = json!({"domain": "surface", "points": 64, "cutoff": 16, "record": ["traces"]});
    let pulled =
        page.solve(&with(json!({"domain": "surface", "points": 64, "cutoff": 16, "friction": 0.3, "sideways": 0.5})));
    let top = page.get(&format!("/api/run/{}/top", pulled["id"].as_str().unwrap())).json();
    let [pressure, traction] = [&top["pressure"], &top["fields"]["traction"]["values"]].map(values);
    assert!(pressure.iter().zip(&traction).all(|(p, t)| t.abs() <= 0.3 * p * (1.0 + 1e-6)));
    let run = page.solve(&with(surface));
    let leak = page.get(&format!("/api/run/{}/leak", run["id"].as_str().unwrap())).json();
    let setup = Setup::from_toml(run["setup"].as_str().unwrap()).unwrap();
    let contact = Multilevel.solve(&setup.problem().unwrap(), &setup.stop, &mut ()).unwrap();
    for (along, axis) in leak["axes"].as_array().unwrap().iter().zip([FlowAxis::X, FlowAxis::Y]) {
        let library = Leakage::from_contact(&contact, axis, 1e-6).unwrap();
        let gap = along["hydraulic_gap"].as_f64().unwrap();
        assert!((gap / library.sigma().cbrt() - 1.0).abs() < 1e-4, "{gap}");
        let flux = values(&along["flux"]);
        assert!(flux.iter().zip(&pressure).all(|(flux, _)| *flux >= 0.0) && flux.iter().any(|flux| *flux > 1.0));
    }
}
