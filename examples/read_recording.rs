//! A trace read back from a recording: `kappa_r` at every relaxation step, or of a history the exact time (speed, number) of each state.
//!
//! `cargo run --release --example read_recording [FILE.rrd [SCENE]]`; without a file it records one first.

use asperity::contact::{ContactModulus, Gfmd, Load, Solver};
use asperity::record::{Options, Recording, Scene};
use asperity::{Grid, Indenter, Problem, Stop};
use std::path::{Path, PathBuf};

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Records a cylinder pressed on the solid, as scene `contact`.
fn record(path: &Path) -> Result<()> {
    let cylinder = Indenter::Cylinder { radius: 40e-6 }.surface(Grid::line(512, 160e-6)?)?;
    let problem = Problem::new(cylinder, ContactModulus(1e9), Load::MeanPressure(8e6))?;
    let recording = Recording::create(path, &[Scene::new("contact", &problem)], Options::default())?;
    Gfmd::default().solve(&problem, &Stop::default(), &mut recording.recorder(0))?.converged()?;
    Ok(recording.finish()?)
}

/// The values of a trace, by step.
fn read(path: &Path, entity: &str) -> Result<Vec<(i64, f64)>> {
    let component = rerun::Scalars::descriptor_scalars().component;
    let mut values = Vec::new();
    let mut file = std::fs::File::open(path)?;
    let stores = rerun::ChunkStore::from_rrd_reader(&rerun::ChunkStoreConfig::ALL_DISABLED, &mut file)?;
    for store in stores.iter().filter(|(id, _)| id.kind() == rerun::StoreKind::Recording).map(|(_, store)| store) {
        for chunk in store.iter_physical_chunks().filter(|chunk| chunk.entity_path().to_string() == entity) {
            let steps = chunk.iter_component_indices("step".into(), component);
            let steps = steps.map(|(time, _)| time.as_i64());
            values.extend(steps.zip(chunk.iter_slices::<f64>(component).map(|value| value[0])));
        }
    }
    values.sort_by_key(|&(step, _)| step);
    Ok(values)
}

fn main() -> Result<()> {
    let mut arguments = std::env::args().skip(1);
    let folder = tempfile::tempdir()?;
    let path = match arguments.next() {
        Some(path) => PathBuf::from(path),
        None => {
            let path = folder.path().join("cylinder.rrd");
            record(&path)?;
            path
        }
    };
    let scene = arguments.next().unwrap_or_else(|| "contact".into());
    let (mut name, mut trace) = ("kappa_r", read(&path, &format!("/{scene}/trace/kappa_r"))?);
    if trace.is_empty() {
        // the time line of a history may be in a small part of its unit of time, but these numbers are exact
        (name, trace) = ("value", read(&path, "/load/value")?);
    }
    println!("{} steps in {}", trace.len(), path.display());
    for (step, value) in trace.iter().step_by(trace.len().div_ceil(12).max(1)).chain(trace.last()) {
        println!("step {step:>5}: {name} = {value:.5e}");
    }
    Ok(())
}
