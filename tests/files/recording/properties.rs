//! Properties of recordings, read back: what makes a table of a folder of them.

use super::{cylinder, rough_line, stores};
use asperity::contact::{Load, Multilevel, PolonskyKeer, Quantity, Reading, Solver};
use asperity::job::HistoryOutcome;
use asperity::record::{Options, Recording, Scene};
use asperity::setup::{Cell, Recipe, Setup};
use asperity::surface::Spectrum;
use asperity::{Problem, Stop};
use rerun::components::{Scalar, Text};
use rerun::{Component, StoreKind};
use std::collections::BTreeMap;
use std::path::Path;
use strum::IntoEnumIterator;

const DOCUMENTATION: &str = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/doc/record.md"));

/// The values of each property of a group, each of which is written once.
fn group<C: Component>(path: &Path, name: &str) -> BTreeMap<String, Vec<C>> {
    let mut found = BTreeMap::new();
    for store in stores(path, StoreKind::Recording) {
        let is_group = |entity: String| entity == format!("/__properties/{name}");
        for chunk in store.iter_physical_chunks().filter(|chunk| is_group(chunk.entity_path().to_string())) {
            for (row, component) in
                (0..chunk.num_rows()).flat_map(|row| chunk.components_identifiers().map(move |it| (row, it)))
            {
                if let Some(Ok(values)) = chunk.component_batch::<C>(component, row) {
                    assert!(found.insert(component.to_string(), values).is_none(), "{component} is written twice");
                }
            }
        }
    }
    found
}

fn numbers(path: &Path, name: &str) -> BTreeMap<String, Vec<f64>> {
    let numbers = group::<Scalar>(path, name).into_iter();
    numbers.map(|(name, values)| (name, values.into_iter().map(|value| value.0.0).collect())).collect()
}

fn texts(path: &Path, name: &str) -> BTreeMap<String, String> {
    group::<Text>(path, name).into_iter().map(|(name, values)| (name, values[0].to_string())).collect()
}

/// The property of an observable.
fn property(observable: &str) -> &str {
    if observable == "transforms" { "solver_transforms" } else { observable }
}

fn rough(path: &Path) -> Setup {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 0.05, rms_gradient: 0.01 };
    let setup = Setup::new(Recipe::rough(spectrum, 1), Cell::line(512, 1.0), Load::ReducedPressure(0.05));
    let problem = setup.problem().unwrap();
    let recording = Recording::create(path, &[Scene::from_setup(&setup, &problem)], Options::default()).unwrap();
    let contact = Multilevel.solve(&problem, &setup.stop, &mut recording.recorder(0)).unwrap().converged().unwrap();
    recording.finish().unwrap();
    let (numbers, state) = (numbers(path, "contact"), Reading::from(&contact));
    for observable in Quantity::iter() {
        if !observable.tells_of(&contact) {
            assert!(!numbers.contains_key(property(observable.name())), "{}", observable.name());
            continue;
        }
        let [found, expected] = [numbers[property(observable.name())][0], state.value(observable)].map(f64::to_bits);
        assert_eq!(found, expected, "{}", observable.name());
    }
    setup
}

#[test]
fn a_solve_tells_what_it_was_and_what_came_out() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let setup = rough(&path);
    let (numbers, texts) = (numbers(&path, "contact"), texts(&path, "contact"));
    let number = |name: &str| numbers[name].as_slice();
    assert_eq!([number("points"), number("size"), number("hurst")], [[512.0], [1.0], [0.8]]);
    assert_eq!(number("tolerance"), [setup.stop.tolerance()]);
    assert!(number("solver_seconds")[0] > 0.0);
    assert_eq!([&texts["solver"], &texts["status"], &texts["title"]], ["multilevel", "converged", "Rough line"]);
    assert_eq!(texts["settings"], Multilevel.settings());
    assert_eq!(texts["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(Setup::from_toml(&texts["setup"]).unwrap(), setup);
    let section = DOCUMENTATION.split("# Properties").nth(1).unwrap().split("\n# ").next().unwrap();
    for name in numbers.keys().chain(texts.keys()) {
        let is_observable = Quantity::iter().any(|observable| observable.name() == name);
        assert!(is_observable || section.contains(&format!("`{name}`")), "{name} is not documented");
    }
}

/// With adhesion the problem of a contact has a load that stands in for any: the reduced pressure is the given one, and there is none at a mean gap.
#[test]
fn a_reduced_pressure_that_nobody_gave_is_no_property() {
    let folder = tempfile::tempdir().unwrap();
    let scene = "
        surface = { indenter = { shape = 'sine', amplitude = 0.01 } }
        grid = { points = 32, size = 1.0 }
        solid = { young = 1.0, poisson = 0.3 }
        adhesion = { work = 1e-4, range = 0.01 }";
    for (load, given) in
        [("mean-gap = 0.02", None), ("mean-pressure = 1e-3", Some(1e-3)), ("reduced-pressure = 0.03", Some(0.03))]
    {
        let path = folder.path().join("a.rrd");
        let setup = Setup::from_toml(&format!("{scene}\nload = {{ {load} }}")).unwrap();
        let problem = setup.problem().unwrap();
        HistoryOutcome::solve(&setup, &problem, &mut ()).unwrap().record(&path, &setup, &problem).unwrap();
        let numbers = numbers(&path, "contact/contact");
        assert_eq!(numbers["points"], [32.0]);
        let reduced = problem.rms_gradient() * problem.contact_modulus();
        let expected = given.map(|given| if load.starts_with("mean") { given / reduced } else { given });
        let found = numbers.get("reduced_pressure").map(|it| it[0]);
        let is_expected = found.zip(expected).is_some_and(|(found, expected)| (found / expected - 1.0).abs() < 1e-14);
        assert!(is_expected || found.is_none() && expected.is_none(), "{load}: {found:?} for {expected:?}");
    }
}

#[test]
fn each_scene_has_properties_of_its_own_and_an_unfinished_one_has_no_status() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let problems: [(&str, Problem); 2] = [("smooth", cylinder()), ("rough one", rough_line())];
    let scenes = [0, 1].map(|i| Scene::new(problems[i].0, &problems[i].1));
    let recording = Recording::create(&path, &scenes, Options::default()).unwrap();
    let contact = PolonskyKeer.solve(&problems[0].1, &Stop::default(), &mut recording.recorder(0)).unwrap();
    recording.finish().unwrap();
    let [smooth, rough] = ["smooth", "rough_one"].map(|name| (numbers(&path, name), texts(&path, name)));
    assert_eq!(smooth.0["iterations"], [contact.work.iterations as f64]);
    assert_eq!((smooth.0["points"][0], rough.0["points"][0]), (64.0, 512.0));
    assert_eq!(smooth.1["status"], "converged");
    assert!(!rough.0.contains_key("iterations") && !rough.1.contains_key("status"));
}
