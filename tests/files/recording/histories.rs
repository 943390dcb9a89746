//! Recordings of histories, read back: their time lines.

use super::{chunks, stores};
use asperity::job::HistoryOutcome;
use asperity::setup::Setup;
use rerun::log::Chunk;
use rerun::time::TimeType;
use rerun::{StoreKind, TextDocument};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// A rough line on a solid that creeps with the retardation time `time`, along a path.
fn recorded(path: &Path, time: f64, of_path: &str) -> HistoryOutcome {
    let text = format!(
        "surface.indenter = {{ shape = 'sine', amplitude = 0.01 }}\ngrid = {{ points = 32, size = 1 }}\n\
         load.reduced-pressure = 0.1\nviscoelastic.creep = [9, {time:e}]\npath = {{ {of_path} }}\n"
    );
    let setup = Setup::from_toml(&text).unwrap();
    let problem = setup.problem().unwrap();
    let outcome = HistoryOutcome::solve(&setup, &problem, &mut ()).unwrap();
    outcome.record(path, &setup, &problem).unwrap();
    outcome
}

/// The times of the chunks of an entity on a time line, by the numbers of the states.
fn times(chunks: &[Chunk], entity: &str, name: &str) -> BTreeMap<i64, i64> {
    let own = chunks.iter().filter(|chunk| chunk.entity_path().to_string() == entity);
    let column = |chunk: &Chunk, name: &str| {
        let found = chunk.timelines().iter().find(|(it, _)| it.as_str() == name);
        found.map(|(_, column)| column.times_raw().to_vec()).unwrap_or_default()
    };
    own.flat_map(|chunk| column(chunk, "step").into_iter().zip(column(chunk, name))).collect()
}

/// The exact times: the values of `/load/value`, by the numbers of the states.
fn values(chunks: &[Chunk]) -> Vec<f64> {
    let component = rerun::Scalars::descriptor_scalars().component;
    let own = chunks.iter().filter(|chunk| chunk.entity_path().to_string() == "/load/value");
    let of_chunk = |chunk: &Chunk| {
        let steps = chunk.iter_component_indices("step".into(), component).map(|(step, _)| step.as_i64());
        steps.zip(chunk.iter_slices::<f64>(component).map(|value| value[0])).collect::<Vec<_>>()
    };
    own.flat_map(of_chunk).collect::<BTreeMap<_, _>>().into_values().collect()
}

/// The texts about the states.
fn notes(path: &Path) -> Vec<String> {
    let component = TextDocument::descriptor_text().component;
    let stores = stores(path, StoreKind::Recording);
    let own = stores.iter().flat_map(|store| store.iter_physical_chunks());
    let own = own.filter(|chunk| chunk.entity_path().to_string() == "/load");
    own.flat_map(|chunk| {
        chunk.iter_slices::<String>(component).flatten().map(|text| text.to_string()).collect::<Vec<_>>()
    })
    .collect()
}

#[test]
fn no_two_states_are_at_the_same_time_and_exact_times_are_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("creep.rrd");
    for (time, of_path, name, tick) in [
        (1e-3, "time = 2e-3, steps = 4", "time", 1e-9),
        (1e-15, "time = 1e-15", "time in 1e-21 s", 1e-21),
        (1e15, "time = 1e15", "time in 1 s", 1.0),
        (
            1.0,
            "time = [0, 1e-9, 2e-9, 1e3, 1e3], load = [0.05, 0.05, 0.1, 0.1, 0.05], steps = 2",
            "time in 1e-15 s",
            1e-15,
        ),
        (1e12, "time = [0, 1e12, 1e12], load = [0.1, 0.1, 0.05], steps = 3", "time in 1 s", 1.0),
    ] {
        let outcome = recorded(&path, time, of_path);
        let exact = outcome.values(asperity::contact::Quantity::Time);
        let chunks = chunks(&path);
        let names: BTreeSet<String> =
            chunks.iter().flat_map(|chunk| chunk.timelines().keys().map(ToString::to_string)).collect();
        assert_eq!(names, BTreeSet::from(["step".to_owned(), name.to_owned()]), "{of_path}");
        let types = chunks.iter().flat_map(|chunk| chunk.timelines().iter());
        let types: Vec<TimeType> =
            types.filter(|(it, _)| it.as_str() == name).map(|(_, column)| column.timeline().typ()).collect();
        let is_duration = name == "time";
        assert!(types.iter().all(|it| (*it == TimeType::DurationNs) == is_duration), "{of_path}");
        assert_eq!(values(&chunks), exact, "{of_path}");
        for entity in ["/load/value", "/curve/0", "/chart/0/lines", "/contact/contact/pressure/curves/pressure"] {
            let found = times(&chunks, entity, name);
            assert_eq!(found.len(), exact.len(), "{of_path}: {entity}");
            let ticks: Vec<i64> = found.into_values().collect();
            assert!(ticks.windows(2).all(|pair| pair[0] < pair[1]), "{of_path}: {entity} {ticks:?}");
            // a jump adds a tick, and the path here has one
            assert!(ticks.iter().zip(&exact).all(|(it, exact)| (*it as f64 - exact / tick).abs() <= 1.5), "{of_path}");
        }
        let said = notes(&path);
        assert!(!said.is_empty());
        assert!(
            said.iter().all(|note| is_duration != note.contains(&format!("The time line `{name}` counts"))),
            "{said:?}"
        );
    }
}
