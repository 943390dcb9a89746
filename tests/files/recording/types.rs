//! The types of components: newer viewers make one table of a recording, in which each component is a column of one type.

use super::*;
use crate::kinds::{self, KINDS};
use asperity::record::Target;
use rerun::external::arrow::array::Array;
use std::path::PathBuf;

/// What else the program records, by other ways through it.
const OTHERS: &[(&str, &str)] = &[
    ("free.rrd", "solve LINE --boundary free --record-what traces,profile,fields,mask,raster --record free.rrd"),
    ("layer.rrd", "solve LINE --layer 0.1 --poisson 0.3 --record layer.rrd"),
    ("hard.rrd", "solve SURFACE --hardness 0.05 --theme light --record hard.rrd"),
    ("loads.rrd", "solve SURFACE --reduced-pressure 1e-3..0.1:3 --record loads.rrd"),
    ("profile.rrd", "surface LINE --record profile.rrd"),
    ("row.rrd", "study study.toml --record-row 2 --record row.rrd"),
    ("demo.rrd", "demo"),
];

const TIMELINES: [&str; 4] = ["step", "seconds", "transforms", "load"];

/// The type of a component as its descriptor has it, and that of its values.
type Type = (String, String);

/// Where each component has which types.
fn types(path: &Path, kind: StoreKind) -> BTreeMap<String, BTreeMap<Type, String>> {
    let mut types = BTreeMap::<String, BTreeMap<Type, String>>::new();
    for store in stores(path, kind) {
        for chunk in store.iter_physical_chunks() {
            for column in chunk.components().values() {
                let named = column.descriptor.component_type.map_or("none".into(), |name| name.to_string());
                let known = types.entry(column.descriptor.component.to_string()).or_default();
                let of_values = column.list_array.values().data_type().to_string();
                known.entry((named, of_values)).or_insert_with(|| chunk.entity_path().to_string());
            }
        }
    }
    types
}

/// Asserts that each component of a file has one type, and that none has the name of a timeline.
fn check(path: &Path) {
    for kind in [StoreKind::Recording, StoreKind::Blueprint] {
        let types = types(path, kind);
        assert!(types.len() > 5, "{} has {} components only", path.display(), types.len());
        for (component, types) in types {
            assert_eq!(types.len(), 1, "{}: {component} is {types:?}", path.display());
            assert!(
                !TIMELINES.contains(&component.as_str()),
                "{}: {component} is a timeline: {types:?}",
                path.display()
            );
        }
    }
}

#[test]
fn each_component_of_every_kind_of_recording_has_one_type_and_no_name_of_a_timeline() {
    let folder = tempfile::tempdir().unwrap();
    let recordings: Vec<PathBuf> = kinds::record(&[KINDS, OTHERS].concat(), folder.path());
    recordings.iter().for_each(|path| check(path));
}

#[cfg(feature = "serve")]
#[test]
fn so_it_is_in_the_recordings_of_the_explorer() {
    let folder = tempfile::tempdir().unwrap();
    for problem in [rough_line(), rough_surface()] {
        let what = Parts::on(problem.surface().grid());
        let options = Options { what, ..Options::default() };
        let mut output = None;
        let target = Target::Temporary("it".into(), Box::new(|begun| output = Some(begun)));
        let recording = Recording::to(target, &[Scene::new("contact", &problem)], options).unwrap();
        PolonskyKeer.solve(&problem, &Stop::default(), &mut recording.recorder(0)).unwrap();
        recording.finish().unwrap();
        let path = folder.path().join("live.rrd");
        std::fs::write(&path, output.unwrap().read(0, u64::MAX).unwrap()).unwrap();
        check(&path);
    }
}
