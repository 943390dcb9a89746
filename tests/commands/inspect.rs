//! Iterations of other codes at the command line: a projected gradient, whose steps are written into files.

use crate::command::{Folder, text};
use ndarray::{Array1, Array2};
use ndarray_npy::{NpzWriter, write_npy};
use serde_json::Value;
use std::f64::consts::TAU;
use std::process::{Command, Output, Stdio};
use std::time::Duration;

const NODES: usize = 64;
const LOAD: f64 = 0.01;
const PROBLEM: &str = "--height h.npy --size 1 --modulus 1 --mean-pressure 0.01";

/// Writes a sine of 64 nodes, and returns the first steps of a projected gradient on it.
fn steps(folder: &Folder, count: usize) -> Vec<Array1<f64>> {
    use asperity::{Grid, elastic::Response};
    let height: Vec<f64> = (0..NODES).map(|i| 0.01 * (TAU * i as f64 / NODES as f64).cos()).collect();
    write_npy(folder.join("h.npy"), &Array1::from(height.clone())).unwrap();
    let mut half_space = Response::half_space(&Grid::line(NODES, 1.0).unwrap(), 1.0);
    let (mut pressure, mut displacement) = (vec![LOAD; NODES], vec![0.0; NODES]);
    let mut steps = Vec::new();
    for _ in 0..count {
        steps.push(Array1::from(pressure.clone()));
        half_space.displacement(&pressure, &mut displacement);
        (0..NODES).for_each(|i| pressure[i] -= displacement[i] - height[i]);
        pressure = feasible(&pressure);
    }
    steps
}

/// The nearest pressure without tension that carries the load.
fn feasible(pressure: &[f64]) -> Vec<f64> {
    let (mut low, mut high) = (-1.0, 1.0);
    for _ in 0..80 {
        let middle: f64 = 0.5 * (low + high);
        let mean = pressure.iter().map(|p| (p - middle).max(0.0)).sum::<f64>() / NODES as f64;
        if mean > LOAD { low = middle } else { high = middle }
    }
    pressure.iter().map(|p| (p - low).max(0.0)).collect()
}

fn stacked(steps: &[Array1<f64>]) -> Array2<f64> {
    Array2::from_shape_fn((steps.len(), NODES), |(step, node)| steps[step][node])
}

fn inspected(folder: &Folder, rest: &str) -> Value {
    let output = folder.run(&format!("inspect {PROBLEM} {rest} --json"));
    found(&output)
}

fn found(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{}", text(&output.stderr)))
}

fn numbers(found: &Value, name: &str) -> Vec<f64> {
    found["steps"].as_array().unwrap().iter().map(|step| step[name].as_f64().unwrap()).collect()
}

#[test]
fn steps_come_near_to_the_reference_and_the_certificate_bounds_them() {
    let folder = Folder::new();
    let steps = steps(&folder, 200);
    write_npy(folder.join("all.npy"), &stacked(&steps)).unwrap();
    let output = folder.run(&format!("inspect {PROBLEM} all.npy --json"));
    let found = found(&output);
    let (errors, energy) = (numbers(&found, "pressure_error"), numbers(&found, "energy_error"));
    assert_eq!((errors.len(), found["reference_of"].as_str()), (200, Some("multilevel")));
    assert!(found["reference_certificate"].as_f64().unwrap() < 1e-12);
    assert!(errors.windows(2).all(|pair| pair[1] < pair[0]) && errors[199] < 0.1 * errors[0], "{errors:?}");
    // energy_error is over the energy of the reference, the bound over that of the step: they come together
    let bound = found["last"]["pressure_error_bound"].as_f64().unwrap();
    assert!(energy[199] <= 1.1 * bound && bound < 100.0 * energy[199], "{} {bound}", energy[199]);
    assert_eq!(output.status.code(), Some(3), "two hundred steps are not enough for 1e-8");
    let loose = folder.run(&format!("inspect {PROBLEM} all.npy --tolerance 0.1"));
    assert_eq!(loose.status.code(), Some(0), "{}", text(&loose.stderr));
    assert!(text(&loose.stdout).contains("200 steps of pressure from all.npy"), "{}", text(&loose.stdout));
}

#[test]
fn one_file_a_step_in_natural_order_is_the_same_as_one_array() {
    let folder = Folder::new();
    let steps = steps(&folder, 12);
    std::fs::create_dir(folder.join("steps")).unwrap();
    for (i, step) in steps.iter().enumerate() {
        write_npy(folder.join(&format!("steps/step{i}.npy")), step).unwrap();
    }
    write_npy(folder.join("all.npy"), &stacked(&steps)).unwrap();
    let mut npz = NpzWriter::new(std::fs::File::create(folder.join("all.npz")).unwrap());
    npz.add_array("pressure", &stacked(&steps)).unwrap();
    npz.add_array("seconds", &Array1::from_iter((0..12).map(|i| 0.5 * f64::from(i)))).unwrap();
    npz.finish().unwrap();
    let [array, files, archive] = ["all.npy", "steps", "all.npz"].map(|rest| inspected(&folder, rest));
    for name in ["certificate", "pressure_error", "energy_error"] {
        assert_eq!(numbers(&array, name), numbers(&files, name));
        assert_eq!(numbers(&array, name), numbers(&archive, name));
    }
    assert_eq!(numbers(&archive, "seconds")[11], 5.5);
    std::fs::write(folder.join("times.txt"), "0 1 2 3 4 5 6 7 8 9 10 11".replace(' ', "\n")).unwrap();
    assert_eq!(numbers(&inspected(&folder, "steps --times times.txt"), "seconds")[11], 11.0);
    let own = inspected(&folder, "all.npy --reference steps/step11.npy");
    assert_eq!((numbers(&own, "pressure_error")[11], own["reference_of"].as_str()), (0.0, Some("steps/step11.npy")));
}

#[test]
fn gaps_and_displacements_are_replayed_as_well() {
    let folder = Folder::new();
    steps(&folder, 1);
    folder.run("solve --height h.npy --size 1 --modulus 1 --pressure 0.01 --tolerance 1e-12 --out run.npz");
    for kind in ["gap", "displacement", "pressure"] {
        let found = inspected(&folder, &format!("run.npz --kind {kind}"));
        assert!(numbers(&found, "pressure_error")[0] < 1e-6, "{kind}: {found}");
        assert_eq!(found["last"]["status"], "converged", "{kind}");
    }
}

#[test]
fn a_folder_is_followed_while_it_is_written() {
    let folder = Folder::new();
    let steps = steps(&folder, 4);
    std::fs::create_dir(folder.join("live")).unwrap();
    let arguments = format!("inspect {PROBLEM} --follow live --idle 2 --json");
    let followed = Command::new(env!("CARGO_BIN_EXE_asperity"))
        .args(arguments.split_whitespace())
        .current_dir(folder.join("."))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    for (i, step) in steps.iter().enumerate() {
        std::thread::sleep(Duration::from_millis(150));
        let (draft, whole) = (folder.join("draft"), folder.join(&format!("live/{i}.npy")));
        write_npy(&draft, step).unwrap();
        let bytes = std::fs::read(&draft).unwrap();
        // half of the file first: it does not count until it is whole
        std::fs::write(&whole, &bytes[..bytes.len() / 2]).unwrap();
        std::thread::sleep(Duration::from_millis(300));
        std::fs::write(&whole, &bytes).unwrap();
    }
    let cut = std::fs::read(folder.join("live/0.npy")).unwrap();
    std::fs::write(folder.join("live/cut.npy"), &cut[..cut.len() - 8]).unwrap();
    let output = followed.wait_with_output().unwrap();
    let complaint = text(&output.stderr);
    assert!(complaint.contains("cut.npy") && complaint.contains("the file is ignored"), "{complaint}");
    let errors = numbers(&found(&output), "pressure_error");
    assert!(errors.len() == 4 && errors.windows(2).all(|pair| pair[1] < pair[0]), "{errors:?}");
}

#[cfg(all(unix, feature = "record"))]
#[test]
fn following_ends_at_an_interrupt_with_a_whole_recording() {
    let folder = Folder::new();
    let steps = steps(&folder, 3);
    std::fs::create_dir(folder.join("live")).unwrap();
    for (i, step) in steps.iter().enumerate() {
        write_npy(folder.join(&format!("live/{i}.npy")), step).unwrap();
    }
    let arguments = format!("inspect {PROBLEM} --follow live --record run.rrd --json");
    let followed = Command::new(env!("CARGO_BIN_EXE_asperity"))
        .args(arguments.split_whitespace())
        .current_dir(folder.join("."))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(1500));
    Command::new("kill").args(["-INT", &followed.id().to_string()]).status().unwrap();
    let output = followed.wait_with_output().unwrap();
    assert_eq!(numbers(&found(&output), "certificate").len(), 3);
    assert_eq!(output.status.code(), Some(3), "{}", text(&output.stderr));
    let mut file = std::fs::File::open(folder.join("run.rrd")).unwrap();
    let stores = rerun::ChunkStore::from_rrd_reader(&rerun::ChunkStoreConfig::ALL_DISABLED, &mut file).unwrap();
    let scalars = rerun::Scalars::descriptor_scalars().component;
    let chunks = stores.values().flat_map(|store| store.iter_physical_chunks());
    let traced: Vec<f64> = chunks
        .filter(|chunk| chunk.entity_path().to_string() == "/contact/trace/certificate")
        .flat_map(|chunk| chunk.iter_slices::<f64>(scalars).map(|row| row[0]).collect::<Vec<_>>())
        .collect();
    let certificates = numbers(&found(&output), "certificate");
    assert!(certificates.iter().all(|it| traced.contains(it)), "{traced:?} {certificates:?}");
}
