//! Solids that creep: knobs, setups, sliding, and contacts in the course of time.

use super::{Page, number, values, with};
use asperity::contact::Quantity;
use asperity::explore::{Knobs, Session, Start, Stock};
use asperity::history::Sliding;
use asperity::job::HistoryOutcome;
use asperity::setup::Setup;
use serde_json::{Value, json};

const CELL: f64 = 160e-6;

fn setup(changes: Value) -> Setup {
    Knobs::read(with(changes).to_string().as_bytes()).unwrap().setup().unwrap()
}

#[test]
fn creep_speed_and_time_make_the_setup() {
    let sliding = setup(json!({"creep": 9, "speed": 0.02, "time": 5}));
    assert_eq!(sliding.viscoelastic.as_ref().unwrap().creep, [9.0, 1.0]);
    assert_eq!(sliding.sliding.as_ref().unwrap().speed, [0.02 * CELL]);
    assert!(sliding.path.is_none(), "the time is of no use to a surface that slides");
    assert!(sliding.drive().unwrap().unwrap().name == "sliding" && !sliding.is_history().unwrap());
    let aging = setup(json!({"creep": 9, "time": 5}));
    assert_eq!((aging.path.as_ref().unwrap().time.as_slice(), &aging.sliding), (&[5.0][..], &None));
    assert_eq!(aging.drive().unwrap().unwrap().name, "creep");
    let elastic = setup(json!({}));
    for changes in [json!({"creep": 9}), json!({"speed": 0.02, "time": 5})] {
        assert_eq!(setup(changes.clone()), elastic, "{changes}");
    }
}

/// States from before these knobs were there, as in links that were saved.
#[test]
fn states_without_the_knobs_are_elastic() {
    let mut earlier = with(json!({}));
    for name in ["creep", "speed", "time"] {
        earlier.as_object_mut().unwrap().remove(name);
    }
    assert_eq!(Knobs::read(earlier.to_string().as_bytes()).unwrap(), Start::RoughLine.knobs());
}

#[test]
fn what_cannot_slide_or_creep_is_refused() {
    let page = Page::open();
    let gfmd = json!({"method": "gfmd"});
    for (changes, words) in [
        (json!({"creep": 9, "speed": 1, "hardness": 5e-4}), "set the hardness or the speed to 0"),
        (json!({"creep": 9, "speed": 1, "solver": gfmd}), "GFMD solves elastic contacts only"),
        (json!({"creep": 9, "time": 1, "solver": gfmd}), "GFMD solves elastic contacts only"),
        (json!({"creep": -1}), "`creep` cannot be -1: give a number from 0 to 100"),
        (json!({"creep": 9, "speed": -1}), "`speed` cannot be -1: give a number from 0 to 1000"),
        (json!({"creep": 9, "time": 1000}), "`time` cannot be 1000: give a number from 0 to 100"),
    ] {
        let answer = page.post("/api/solve", &with(changes.clone()).to_string());
        assert!(answer.status == 400 && answer.text().contains(words), "{changes}: {}", answer.text());
    }
    let aging = with(json!({"creep": 9, "time": 1}));
    let swept = page.post("/api/sweep", &aging.to_string());
    assert!(swept.status == 400 && swept.text().contains("with creep cannot be swept"), "{}", swept.text());
    let hold = json!({"knobs": aging, "mean-gap": null, "is-deep": false}).to_string();
    let held = page.post("/api/hold", &hold);
    assert!(held.status == 400 && held.text().contains("with creep cannot be dragged"), "{}", held.text());
    assert_eq!(page.solve(&with(json!({"creep": 9, "time": 1, "hardness": 5e-4})))["numbers"]["status"], "converged");
}

#[test]
fn a_contact_that_slides_has_the_friction_of_the_library() {
    let page = Page::open();
    let state = with(json!({"creep": 9, "speed": 0.02, "points": 1024, "cutoff": 64}));
    let run = page.solve(&state);
    let setup = Setup::from_toml(run["setup"].as_str().unwrap()).unwrap();
    let library = Sliding::solve(&setup.problem().unwrap(), &setup.stop, &mut ()).unwrap();
    assert_eq!(number(&run, "friction"), library.friction);
    assert!(library.friction > 1e-4, "{}", library.friction);
    for part in [" --creep 9", " --speed "] {
        assert!(run["command"].as_str().unwrap().contains(part), "{}", run["command"]);
    }
    assert_eq!(run["title"], "Rough line, p* = 0.05, f = 9, Vτ/L = 0.02");
    assert!(run["process"].is_null());
    let facet = |name: &str| page.get(&format!("/api/run/{}/{name}", run["id"].as_str().unwrap())).json();
    assert_eq!(facet("section")["slides"], true);
    assert_eq!(facet("patches")["is_hertzian"], false);
    assert_eq!(values(&facet("steps")["friction"]).last(), Some(&library.friction));
    assert!(facet("why")["causes"].is_array());
    let rest = page.solve(&with(json!({"points": 1024, "cutoff": 64})));
    assert!(rest["numbers"]["friction"].is_null(), "there is no friction at rest");
    assert!(page.get(&format!("/api/run/{}/steps", rest["id"].as_str().unwrap())).json()["friction"].is_null());
}

/// The contact lies in front of the tips of a sine, that is at larger places, where its pressure pushes back.
#[test]
fn the_pressure_is_higher_in_front() {
    let page = Page::open();
    let state = json!({"body": "sine", "roughness": 0, "load": 0.1, "creep": 9, "speed": 0.5});
    let run = page.solve(&with(state));
    let section = page.get(&format!("/api/run/{}/section", run["id"].as_str().unwrap())).json();
    let [pressure, rigid] = ["pressure", "rigid"].map(|name| values(&section[name]));
    let tip = (0..rigid.len()).min_by(|&a, &b| rigid[a].total_cmp(&rigid[b])).unwrap();
    let half = rigid.len() / 2;
    let ahead = |places: std::ops::Range<usize>| places.map(|i| pressure[(tip + i) % rigid.len()]).sum::<f64>();
    let (front, back) = (ahead(1..half), ahead(half + 1..rigid.len()));
    assert!(front > 1.5 * back, "{front} in front, {back} behind");
}

#[test]
fn a_hand_and_a_sweep_slide_too() {
    let page = Page::open();
    let state = json!({"creep": 9, "speed": 0.02, "points": 1024, "cutoff": 64});
    let run = page.solve(&with(state.clone()));
    let hold = |mean_gap: Option<f64>| {
        let order = json!({"knobs": with(state.clone()), "mean-gap": mean_gap, "is-deep": true});
        let answer = page.post("/api/hold", &order.to_string());
        assert_eq!(answer.status, 200, "{}", answer.text());
        answer.json()
    };
    let loaded = hold(None);
    let near = |held: &Value, of: &str| {
        let ratio = number(held, of) / number(&run, of);
        assert!((ratio - 1.0).abs() < 1e-2, "{of} under the hand is {ratio} times that of the run");
    };
    near(&loaded, "friction");
    let held = hold(loaded["section"]["mean_gap"].as_f64());
    for of in ["friction", "reduced_pressure", "relative_area"] {
        near(&held, of);
    }
    assert!(held["shear"]["highest"].as_f64().unwrap() > 0.0);
    page.order("/api/sweep", &with(state));
    let sweep = page.wait(|state| state["busy"] == false && state["sweep"]["ended"] == true)["sweep"].clone();
    let points = sweep["points"].as_array().unwrap();
    let at = points.iter().find(|it| it["reduced_pressure"].as_f64().unwrap() > 0.04).unwrap();
    assert!(at["friction"].as_f64().unwrap() > 1e-4 && at["persson"].is_null(), "{at}");
}

/// Under a load that is held, the contact is that of an elastic solid which is softer by the creep so far (Lee and Radok).
#[test]
fn a_contact_in_time_is_that_of_a_softer_solid() {
    let page = Page::open();
    let state = json!({"creep": 9, "time": 1, "points": 1024, "cutoff": 64});
    let run = page.solve(&with(state));
    let softer = 0.05 * (1.0 + 9.0 * (1.0 - (-1.0f64).exp()));
    let elastic = page.solve(&with(json!({"load": softer, "points": 1024, "cutoff": 64})));
    for of in ["relative_area", "kappa_r", "patches"] {
        let ratio = number(&run, of) / number(&elastic, of);
        assert!((ratio - 1.0).abs() < 1e-6, "{of} is {ratio} times that of the softer solid");
    }
    assert!(run["process"]["kind"] == "creep" && run["numbers"]["friction"].is_null(), "{}", run["numbers"]);
    let setup = Setup::from_toml(run["setup"].as_str().unwrap()).unwrap();
    let outcome = HistoryOutcome::solve(&setup, &setup.problem().unwrap(), &mut ()).unwrap();
    let last = outcome.states.last().unwrap();
    assert_eq!(Some(number(&run, "relative_area")), last.get(Quantity::RelativeArea));
    assert_eq!(Some(number(&run, "kappa_r")), last.get(Quantity::KappaR));
    // the file that the page offers has the numbers of the state
    let arrays = page.get(&format!("/save/{}.npz", run["id"].as_str().unwrap()));
    let mut npz = ndarray_npy::NpzReader::new(std::io::Cursor::new(arrays.body)).unwrap();
    let mut saved = |name: &str| npz.by_name::<ndarray::OwnedRepr<f64>, ndarray::Ix0>(name).map(|it| it.into_scalar());
    for name in ["relative_area", "kappa_r", "mean_gap"] {
        assert_eq!(saved(name).unwrap(), number(&run, name), "{name}");
    }
    assert!(saved("elastic_energy").is_err() && saved("kappa").is_err());
    assert!(run["command"].as_str().unwrap().contains(" --path-time 1"), "{}", run["command"]);
    let facet = |name: &str| page.get(&format!("/api/run/{}/{name}", run["id"].as_str().unwrap())).json();
    let steps = facet("steps");
    let areas = values(&steps["relative_area"]);
    assert!(areas.len() > 4 && areas.is_sorted_by(|a, b| a <= b), "the contact grows state by state: {areas:?}");
    let times = values(&steps["time"]);
    assert!(times[0] == 0.0 && times.is_sorted() && times.last() == Some(&1.0), "{times:?}");
    assert_eq!(values(&steps["step"]), (1..=areas.len()).map(|i| i as f64).collect::<Vec<_>>());
    assert_eq!(*areas.last().unwrap(), number(&run, "relative_area"));
    let shown = facet("motion")["sections"].as_array().unwrap().len();
    assert!((4..=outcome.states.len()).contains(&shown), "{shown} of {} states move", outcome.states.len());
    assert!(facet("why").is_null());
    assert_eq!(facet("patches")["is_hertzian"], false);
}

/// A solve in time gives way to the next order at its next step.
#[test]
fn a_contact_in_time_is_stopped_by_the_next_order() {
    let page = Page::open();
    let long = json!({"domain": "surface", "points": 512, "cutoff": 128, "creep": 9, "time": 100, "stop": {"tolerance": 1e-12, "max-iterations": 20000}});
    page.order("/api/solve", &with(long));
    page.wait(|state| state["run"]["numbers"]["transforms"].as_u64().is_some_and(|it| it > 0));
    let begun = std::time::Instant::now();
    let run = page.solve(&with(json!({"points": 256, "cutoff": 32})));
    assert_eq!(run["numbers"]["status"], "converged");
    println!("The next order was solved after {:.1} s.", begun.elapsed().as_secs_f64());
}

#[test]
fn two_surfaces_creep_and_slide_together() {
    let beside = with(json!({"hurst": 0.3, "points": 512, "cutoff": 32}));
    for motion in [json!({"speed": 0.02}), json!({"time": 1})] {
        let session = Session::new(Stock::default(), 0);
        let mut state = with(json!({"creep": 9, "points": 512, "cutoff": 32, "beside": beside}));
        motion.as_object().unwrap().iter().for_each(|(name, value)| state[name] = value.clone());
        let knobs = Knobs::read(state.to_string().as_bytes()).unwrap();
        session.order(asperity::explore::RunKind::Solve, knobs).unwrap();
        session.work_once();
        let run = serde_json::to_value(session.report()).unwrap()["run"].clone();
        let [first, second] = [&run, &run["beside"]].map(|it| number(it, "relative_area"));
        assert!(first > 0.2 && second > 0.1 && first != second, "{motion}: {first} {second}");
    }
}
