//! Surfaces with adhesion: knobs, setups, what they refuse, and the hand under which they snap in and let go.

use super::{Page, number, with};
use asperity::contact::Quantity;
use asperity::explore::{Knobs, Start};
use asperity::job::HistoryOutcome;
use asperity::setup::Setup;
use serde_json::{Value, json};

const CELL: f64 = 160e-6;
const MODULUS: f64 = 1e9;

/// A smooth wave that sticks, with changes.
fn wave(changes: Value) -> Value {
    let mut knobs =
        with(json!({"body": "sine", "roughness": 0, "points": 2048, "load": 0.001, "adhesion": 6e-7, "range": 1e-4}));
    changes.as_object().unwrap().iter().for_each(|(name, value)| knobs[name] = value.clone());
    knobs
}

fn setup(knobs: &Value) -> Setup {
    Knobs::read(knobs.to_string().as_bytes()).unwrap().setup().unwrap()
}

#[test]
fn work_range_and_pull_make_the_setup() {
    let pulled = setup(&wave(json!({"pull": 0.03})));
    let adhesion = pulled.adhesion.as_ref().unwrap();
    assert_eq!(adhesion.work, Some(6e-7 * MODULUS * CELL));
    assert_eq!(adhesion.range, Some(1e-4 * CELL));
    assert_eq!(pulled.path.as_ref().unwrap().load, [0.0, 0.001, -0.03]);
    assert_eq!(pulled.drive().unwrap().unwrap().name, "adhesion");
    let pressed = setup(&wave(json!({})));
    assert!(pressed.path.is_none() && pressed.is_history().unwrap());
    let plain = setup(&wave(json!({"adhesion": 0})));
    assert_eq!(plain, setup(&wave(json!({"adhesion": 0, "range": 1e-2, "pull": 1}))));
    assert!(plain.adhesion.is_none());
}

/// States from before these knobs were there, as in links that were saved.
#[test]
fn states_without_the_knobs_do_not_stick() {
    let mut earlier = with(json!({}));
    for name in ["adhesion", "range", "pull", "depth"] {
        earlier.as_object_mut().unwrap().remove(name);
    }
    assert_eq!(Knobs::read(earlier.to_string().as_bytes()).unwrap(), Start::RoughLine.knobs());
}

#[test]
fn what_cannot_stick_is_refused() {
    let page = Page::open();
    let at_rest = "adhesion is solved for elastic contacts at rest";
    for (changes, words) in [
        (json!({"hardness": 5e-4}), at_rest),
        (json!({"creep": 9, "speed": 1}), at_rest),
        (json!({"creep": 9, "time": 1}), at_rest),
        (json!({"solver": {"method": "polonsky-keer"}}), "choose the multilevel method"),
        (json!({"adhesion": -1}), "`adhesion` cannot be -1: give a number from 0 to 1"),
        (json!({"range": 0}), "`range` cannot be 0: give a number from "),
        (json!({"depth": 1}), "`depth` cannot be 1: give a number from 0 to 0.95"),
        (json!({"pull": -1}), "`pull` cannot be -1: give a number from 0 to 1000"),
    ] {
        let answer = page.post("/api/solve", &wave(changes.clone()).to_string());
        assert!(answer.status == 400 && answer.text().contains(words), "{changes}: {}", answer.text());
    }
    let swept = page.post("/api/sweep", &wave(json!({})).to_string());
    assert!(swept.status == 400 && swept.text().contains("with adhesion cannot be swept"), "{}", swept.text());
    let coarse = page.post("/api/solve", &wave(json!({"range": 1e-5})).to_string());
    let fault = coarse.text();
    assert!(
        coarse.status == 400 && fault.starts_with("the grid is too coarse for this attraction: its process zone"),
        "{fault}"
    );
    let hold = json!({"knobs": wave(json!({"range": 1e-5})), "mean-gap": 1e-7, "is-deep": false});
    let held = page.post("/api/hold", &hold.to_string());
    assert!(held.status == 400 && held.text() == fault, "{}", held.text());
}

#[test]
fn a_wave_holds_under_a_pull_as_in_the_library() {
    let page = Page::open();
    let run = page.solve(&wave(json!({"pull": 0.05, "record": ["traces", "profile", "fields", "mask", "stress"]})));
    assert_eq!(run["process"]["kind"], "adhesion");
    assert!((number(&run, "reduced_pressure") / -0.05 - 1.0).abs() < 1e-9);
    assert!(number(&run, "mean_pressure") < 0.0);
    let setup = Setup::from_toml(run["setup"].as_str().unwrap()).unwrap();
    let outcome = HistoryOutcome::solve(&setup, &setup.problem().unwrap(), &mut ()).unwrap();
    let last = outcome.states.last().unwrap();
    assert_eq!(Some(number(&run, "relative_area")), last.get(Quantity::RelativeArea));
    assert!(number(&run, "relative_area") > 0.1, "{}", run["numbers"]);
    for absent in ["kappa", "kappa_r", "kappa_r_counted", "elastic_energy", "reduced_pressure_contact"] {
        assert!(run["numbers"][absent].is_null(), "{absent} has no meaning with adhesion");
    }
    // the file that the page offers has the numbers of the state
    let arrays = page.get(&format!("/save/{}.npz", run["id"].as_str().unwrap()));
    let mut npz = ndarray_npy::NpzReader::new(std::io::Cursor::new(arrays.body)).unwrap();
    let mut saved = |name: &str| npz.by_name::<ndarray::OwnedRepr<f64>, ndarray::Ix0>(name).map(|it| it.into_scalar());
    for name in ["mean_pressure", "reduced_pressure", "relative_area"] {
        assert_eq!(saved(name).unwrap(), number(&run, name), "{name}");
    }
    assert!(saved("kappa_r").is_err() && saved("elastic_energy").is_err());
    assert!(run["command"].as_str().unwrap().contains(" --adhesion "), "{}", run["command"]);
    let facet = |name: &str| page.get(&format!("/api/run/{}/{name}", run["id"].as_str().unwrap())).json();
    let steps = facet("steps");
    let areas: Vec<f64> = steps["relative_area"].as_array().unwrap().iter().map(|it| it.as_f64().unwrap()).collect();
    let turn = areas.iter().position(|area| area >= areas.iter().max_by(|a, b| a.total_cmp(b)).unwrap()).unwrap();
    let (approach, retreat) = (&areas[..=turn], &areas[turn..]);
    assert!(approach.len() > 10 && approach.is_sorted(), "the contact grows state by state: {areas:?}");
    assert!(retreat.len() > 10 && retreat.is_sorted_by(|a, b| a >= b), "the contact shrinks state by state: {areas:?}");
    assert!(facet("why").is_null() && facet("shear").is_null());
    assert_eq!(facet("patches")["is_hertzian"], false);
    let parted = page.solve(&wave(json!({"pull": 0.1})));
    assert_eq!((number(&parted, "relative_area"), number(&parted, "patches")), (0.0, 0.0));
    // surfaces that have parted have no gap that a load would give
    assert!(parted["mean_gap"].is_null(), "{}", parted["mean_gap"]);
}

/// At gaps the load follows: approach and retreat have states at equal gaps of which one holds and the other does not, energy is lost in between, and the
/// pull-off is that of theory.
#[test]
fn a_cylinder_at_gaps_has_a_wide_loop() {
    let page = Page::open();
    let cylinder = json!({"domain": "line", "body": "round", "roughness": 0, "points": 4096, "load": 0.01, "adhesion": 1e-7, "range": 2e-5, "depth": 0.5});
    let run = page.solve(&with(cylinder.clone()));
    let touch = CELL / 2400.0;
    let setup = Setup::from_toml(run["setup"].as_str().unwrap()).unwrap();
    let gaps = &setup.path.as_ref().unwrap().load;
    for (gap, share) in gaps.iter().zip([2.0, 0.5, 2.0]) {
        assert!((gap / touch / share - 1.0).abs() < 1e-3, "{gaps:?} beside {touch}");
    }
    assert!(run["title"].as_str().unwrap().starts_with("Cylinder, δ/g₀ = 0.5, w/"), "{}", run["title"]);
    assert!(run["command"].as_str().unwrap().contains(" --mean-gap "), "{}", run["command"]);
    assert_eq!(number(&run, "relative_area"), 0.0);
    assert!(number(&run, "dissipated") > 0.0);
    let steps = page.get(&format!("/api/run/{}/steps", run["id"].as_str().unwrap())).json();
    let column = |name: &str| steps[name].as_array().unwrap().iter().map(|it| it.as_f64()).collect::<Vec<_>>();
    let [gap, pressure, area] = ["mean_gap", "mean_pressure", "relative_area"]
        .map(|name| column(name).into_iter().map(Option::unwrap).collect::<Vec<f64>>());
    let turn = (0..gap.len()).min_by(|&a, &b| gap[a].total_cmp(&gap[b])).unwrap();
    let last_apart = (0..turn).rfind(|&i| area[i] == 0.0).unwrap();
    let last_held = (turn..gap.len()).rfind(|&i| area[i] > 0.0).unwrap();
    assert!(gap[last_held] > 1.1 * gap[last_apart], "snaps in at {}, lets go at {}", gap[last_apart], gap[last_held]);
    assert_eq!(column("jump").into_iter().flatten().filter(|energy| *energy > 0.0).count(), 2);
    let lowest = pressure.iter().copied().fold(f64::INFINITY, f64::min);
    let jkr = run["pull_off"]["jkr"].as_f64().unwrap();
    assert!((lowest / jkr - 1.0).abs() < 1e-2, "{lowest} against {jkr}");
    let beside = {
        let mut knobs = with(cylinder);
        knobs["beside"] = with(json!({"body": "sine", "roughness": 0, "points": 4096}));
        page.solve(&knobs)
    };
    assert_eq!(number(&beside, "mean_gap"), number(&run, "mean_gap"));
}

/// Theory says when a cylinder lets go, and nothing of a wave.
#[test]
fn a_cylinder_lets_go_where_theory_says() {
    let page = Page::open();
    let cylinder = json!({"domain": "line", "body": "round", "roughness": 0, "points": 4096, "load": 0.01, "adhesion": 1e-7, "range": 2e-5, "pull": 0.1});
    let run = page.solve(&with(cylinder));
    let told = &run["pull_off"];
    assert!((told["tabor"].as_f64().unwrap() - 5.0).abs() < 1e-3 && told["dmt"].is_null(), "{told}");
    let steps = page.get(&format!("/api/run/{}/steps", run["id"].as_str().unwrap())).json();
    let column = |name: &str| steps[name].as_array().unwrap().iter().map(|it| it.as_f64().unwrap()).collect::<Vec<_>>();
    let held = column("mean_pressure").into_iter().zip(column("mean_attraction")).filter(|(_, held)| *held > 0.0);
    let lowest = held.map(|(pressure, _)| pressure).fold(f64::INFINITY, f64::min);
    let jkr = told["jkr"].as_f64().unwrap();
    assert!((lowest / jkr - 1.0).abs() < 2e-3, "{lowest} against {jkr}");
    assert!(page.solve(&wave(json!({})))["pull_off"].is_null());
}

/// A sphere that was pulled off has no pressure: its section is through its lowest point.
#[test]
fn what_has_parted_is_cut_at_its_peak() {
    let page = Page::open();
    let sphere = json!({"domain": "surface", "body": "round", "roughness": 0, "points": 32, "cutoff": 16, "load": 0.01, "adhesion": 1e-7, "range": 3e-3, "pull": 1});
    let run = page.solve(&with(sphere));
    assert_eq!(number(&run, "relative_area"), 0.0);
    let facet = |name: &str| page.get(&format!("/api/run/{}/{name}", run["id"].as_str().unwrap())).json();
    let (section, top) = (facet("section"), facet("top"));
    let rigid: Vec<f64> = top["rigid"].as_array().unwrap().iter().map(|z| z.as_f64().unwrap()).collect();
    let lowest = (0..rigid.len()).min_by(|&a, &b| rigid[a].total_cmp(&rigid[b])).unwrap();
    let y = section["y"].as_f64().unwrap();
    assert!((y / CELL * 32.0 - (lowest / 32) as f64).abs() < 1e-9, "cut at {y}, the peak is in row {}", lowest / 32);
}

/// The surface beside is pulled with the same mean pressure, whatever its own slopes are.
#[test]
fn two_surfaces_are_pulled_together() {
    let page = Page::open();
    let beside = wave(json!({"roughness": 0.02, "cutoff": 32}));
    let run = page.solve(&wave(json!({"pull": 0.02, "beside": beside})));
    let [first, second] = [&run, &run["beside"]].map(|it| number(it, "mean_pressure"));
    assert!(first < 0.0 && (second / first - 1.0).abs() < 1e-9, "{first} {second}");
    let [first, second] = [&run, &run["beside"]].map(|it| number(it, "relative_area"));
    assert!(first > second && second > 0.0, "{first} {second}");
}

/// The contact under a hand at a mean gap over the amplitude of the wave.
fn hold(page: &Page, knobs: &Value, gap: f64, goes_on: bool) -> Value {
    let order = json!({"knobs": knobs, "mean-gap": gap * 1e-3 * CELL, "is-deep": true, "goes-on": goes_on});
    let answer = page.post("/api/hold", &order.to_string());
    assert_eq!(answer.status, 200, "{}", answer.text());
    answer.json()
}

/// Between the gaps at which it snaps in and lets go, a wave touches or not, as the hand comes from below or from above.
#[test]
fn a_hand_finds_two_contacts_at_one_gap() {
    let page = Page::open();
    let knobs = wave(json!({}));
    let above = hold(&page, &knobs, 2.0, false);
    assert_eq!(number(&above, "relative_area"), 0.0);
    let apart = hold(&page, &knobs, 1.4, true);
    assert_eq!(number(&apart, "relative_area"), 0.0, "it has not snapped in yet");
    let snapped = hold(&page, &knobs, 1.25, true);
    assert!(number(&snapped, "relative_area") > 0.1, "{}", snapped["numbers"]);
    let stuck = hold(&page, &knobs, 1.4, true);
    assert!(number(&stuck, "relative_area") > 0.05, "it has let go too early: {}", stuck["numbers"]);
    let [loose, tight] = [&apart, &stuck].map(|it| number(it, "reduced_pressure"));
    assert!(tight < 10.0 * loose && loose < 0.0, "{tight} and {loose} at the same gap");
    assert!(stuck["shear"].is_null(), "it would be that of the pressure between the surfaces alone");
    let [one, other] = [&apart, &stuck].map(|it| it["section"]["mean_gap"].as_f64().unwrap());
    assert!((one / other - 1.0).abs() < 1e-9, "{one} {other}");
    assert_eq!(number(&hold(&page, &knobs, 1.5, true), "relative_area"), 0.0, "it lets go");
    assert_eq!(number(&hold(&page, &knobs, 1.4, true), "relative_area"), 0.0, "and stays apart");
    // the hand that takes the contact of the knobs, which touches, and one after another knob was turned
    let taken = hold(&page, &knobs, 1.4, false);
    assert!(
        (number(&taken, "relative_area") / number(&stuck, "relative_area") - 1.0).abs() < 0.02,
        "{}",
        taken["numbers"]
    );
    hold(&page, &knobs, 2.0, true);
    let turned = hold(&page, &wave(json!({"adhesion": 7e-7})), 1.4, true);
    assert!(number(&turned, "relative_area") > 0.05, "another attraction begins with the contact of its knobs");
}
