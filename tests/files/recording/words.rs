//! Words of recordings, read back from their files: units, and what became of a run.

use super::{rough_line, stores};
use asperity::contact::{Load, PolonskyKeer, Solver};
use asperity::job::Job;
use asperity::record::{Options, Recording, Scene, Target};
use asperity::setup::{Setup, SetupTable};
use asperity::{Problem, Stop};
use rerun::{SeriesLines, StoreKind, TextDocument};
use std::path::Path;

const SCENE: &str = "\
surface.indenter = { shape = 'sphere', radius = '1 mm' }
grid = { points = [16, 16], size = '200 um' }
solid = { contact-modulus = '1 GPa' }
";

/// All texts of an entity, in their order.
fn texts(path: &Path, entity: &str) -> Vec<String> {
    let component = TextDocument::descriptor_text().component;
    let mut texts = Vec::new();
    for store in stores(path, StoreKind::Recording) {
        for chunk in store.iter_physical_chunks().filter(|chunk| chunk.entity_path().to_string() == entity) {
            texts.extend(chunk.iter_slices::<String>(component).flatten().map(|text| text.to_string()));
        }
    }
    texts
}

fn table(rest: &str) -> SetupTable {
    SetupTable::from_toml(&format!("{SCENE}{rest}")).unwrap()
}

#[test]
fn tables_and_titles_have_the_units_in_which_quantities_are_given() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let setup = table("load.mean-pressure = '2 MPa'").setup().unwrap();
    Job::new(setup).recorded(Target::File(path.clone())).run(&mut ()).unwrap();
    let text = texts(&path, "/contact/description").pop().unwrap();
    for row in ["| surface | sphere, radius 1 mm |", "| contact modulus E* | 1 GPa |", "| mean pressure | 2 MPa |"] {
        assert!(text.contains(row), "{text}");
    }
    let setup = table("load.mean-pressure = ['0.5 MPa', '2 MPa']").setup().unwrap();
    Job::new(setup).recorded(Target::File(path.clone())).run(&mut ()).unwrap();
    let load = texts(&path, "/load");
    assert!(load.iter().any(|text| text.starts_with("# p = 500 kPa")), "{load:?}");
    let named: Vec<String> = stores(&path, StoreKind::Recording)
        .iter()
        .flat_map(|store| store.iter_physical_chunks().cloned().collect::<Vec<_>>())
        .filter(|chunk| chunk.entity_path().to_string() == "/load/value")
        .flat_map(|chunk| {
            let names = SeriesLines::descriptor_names().component;
            chunk.iter_slices::<String>(names).flatten().map(|name| name.to_string()).collect::<Vec<_>>()
        })
        .collect();
    assert_eq!(named, ["mean pressure [Pa]"]);
}

#[test]
fn numbers_without_units_get_none() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let scene = "surface.indenter = { shape = 'sine', amplitude = 0.01 }\ngrid = { points = 64, size = 1 }\n\
                 solid.contact-modulus = 3\nload.mean-pressure = 0.02\n";
    Job::new(Setup::from_toml(scene).unwrap()).recorded(Target::File(path.clone())).run(&mut ()).unwrap();
    let text = texts(&path, "/contact/description").pop().unwrap();
    assert!(text.contains("| contact modulus E* | 3 |"), "{text}");
    assert!(text.contains("| mean pressure | 0.02, in the unit of E* |"), "{text}");
}

#[test]
fn a_run_says_what_has_become_of_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let [one, other]: [Problem; 2] = [rough_line(), rough_line()];
    let scenes = [Scene::new("one", &one), Scene::new("other", &other), Scene::new("third", &other)];
    let recording = Recording::create(&path, &scenes, Options::default()).unwrap();
    PolonskyKeer.solve(&one, &Stop::default(), &mut recording.recorder(0)).unwrap();
    let mut left = recording.recorder(1);
    asperity::contact::Observer::begin(&mut left, &PolonskyKeer, &other, &Stop::default()).unwrap();
    drop(left);
    recording.finish().unwrap();
    let last = |scene: &str| texts(&path, &format!("/{scene}/description")).pop().unwrap();
    assert!(last("one").starts_with("**Result**: converged"), "{}", last("one"));
    assert!(last("other").starts_with("**Result**: ended without a result"), "{}", last("other"));
    assert!(last("third").starts_with("**Result**: not begun"), "{}", last("third"));
}

#[test]
fn a_state_with_adhesion_names_no_certificate() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let scene = "surface.indenter = { shape = 'sine', amplitude = 0.01 }\ngrid = { points = 64, size = 1 }\n\
                 solid.contact-modulus = 1\nload.mean-gap = 0.012\nadhesion = { work = 1e-5, range = 3e-3 }\n\
                 path = { load = [0.012, 0.009], steps = 2 }\n";
    let setup = Setup::from_toml(scene).unwrap();
    assert!(matches!(setup.load, Load::MeanGap(_)));
    Job::new(setup).recorded(Target::File(path.clone())).run(&mut ()).unwrap();
    let texts = texts(&path, "/contact/contact/description");
    assert!(texts.len() > 1 && texts.iter().all(|text| !text.contains("NaN")), "{texts:?}");
}
