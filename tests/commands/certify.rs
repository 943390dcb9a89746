//! Results of other codes at the command line: those of Tamaas in `tests/data`, as they are and spoiled.

use crate::command::{Folder, text};
use crate::peer::{Peer, data};
use ndarray::{Array2, Axis};
use ndarray_npy::{NpzReader, write_npy};
use serde_json::Value;
use std::process::Output;

fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{}", text(&output.stderr)))
}

fn peer(name: &str) -> Peer {
    Peer::all().into_iter().find(|peer| peer.name == name).unwrap()
}

/// The flags of the problem of a peer.
fn problem(name: &str, size: f64) -> String {
    format!("--height {} --size {size} --modulus 1", data(&format!("{name}.height.npy")).display())
}

fn write(folder: &Folder, name: &str, field: &Array2<f64>) {
    match field.nrows() {
        1 => write_npy(folder.join(name), &field.index_axis(Axis(0), 0)).unwrap(),
        _ => write_npy(folder.join(name), field).unwrap(),
    }
}

#[test]
fn a_result_of_a_peer_is_certified() {
    let folder = Folder::new();
    let (line, pressure) = (problem("line_rough_h08", 160e-6), data("line_rough_h08.pressure.npy"));
    let output = folder.run(&format!("certify {line} --pressure {} --mean-pressure 1e-5 --json", pressure.display()));
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let found = json(&output);
    assert_eq!((&found["holds"], found["findings"].as_array().unwrap().len()), (&Value::Bool(true), 0));
    assert!(found["certificate"].as_f64().unwrap() < 1e-11 && found["pressure_error_bound"].as_f64().unwrap() < 1e-5);
    assert_eq!(found["relative_area_counted"].as_f64().unwrap(), 0.04052734375);
    assert_eq!((&found["assessment"]["pressed"], &found["assessment"]["closed"]), (&166.into(), &166.into()));
    let told = folder.run(&format!("certify {line} --pressure {}", pressure.display()));
    let told = text(&told.stdout);
    assert!(told.contains("is within tolerance") && told.contains("the load is that of the pressure"), "{told}");
    // a tolerance that nobody meets
    let strict = folder.run(&format!("certify {line} --pressure {} --tolerance 1e-20", pressure.display()));
    assert_eq!(strict.status.code(), Some(3));
}

#[test]
fn a_tension_of_rounding_is_called_that() {
    let folder = Folder::new();
    let peer = peer("line_rough_h08");
    let (pressure, line) = (&peer.pressure, problem(&peer.name, 160e-6));
    let highest = pressure.iter().copied().fold(0.0, f64::max);
    for (share, words) in [(1e-16, "rounding errors only"), (1e-3, "down to -")] {
        let spoiled = pressure.mapv(|p| if p == 0.0 { -share * highest / 1e3 } else { p });
        write(&folder, "p.npy", &spoiled);
        let output = folder.run(&format!("certify {line} --pressure p.npy"));
        let told = text(&output.stdout).lines().find(|line| line.trim().starts_with("tension")).unwrap();
        assert!(told.contains(words), "{told}");
    }
}

#[test]
fn spoiled_results_are_refused_with_the_reason() {
    let folder = Folder::new();
    let peer = peer("surface_rough_h08");
    let surface = problem(&peer.name, 1.0);
    let pressure = &peer.pressure;
    let [dy, dx] = peer.surface.grid().spacing();
    let turned = pressure.t().as_standard_layout().into_owned();
    let cases = [
        ("negative", -pressure, "", "sign", "give -pressure"),
        ("forces", pressure * (dx * dy), "", "pressure-factor", "divide them by dx dy"),
        ("turned", turned, "", "arrangement", "give pressure.T"),
        ("young", pressure.clone(), "--young 0.91 --poisson 0.3 --mean-pressure 0.02", "", ""),
        ("half", pressure.clone(), "--modulus 0.5", "modulus", "one elastic body"),
    ];
    for (name, field, flags, mistake, words) in cases {
        write(&folder, &format!("{name}.npy"), &field);
        let load = if flags.contains("pressure") { "" } else { "--mean-pressure 0.02" };
        let surface = if flags.contains("modul") || flags.contains("young") {
            surface.replace("--modulus 1", "")
        } else {
            surface.clone()
        };
        let output = folder.run(&format!("certify {surface} {flags} {load} --pressure {name}.npy --json"));
        let found = json(&output);
        if mistake.is_empty() {
            // E / (1 - nu^2) is the modulus of the peer
            assert_eq!(output.status.code(), Some(0), "{name}: {found}");
            continue;
        }
        assert_eq!(output.status.code(), Some(3), "{name}: {found}");
        assert_eq!(found["findings"][0]["errors"][0], mistake, "{name}: {found}");
        assert!(found["findings"][0]["sentence"].as_str().unwrap().contains(words), "{name}: {found}");
    }
}

/// A wrong load is told in the units of the setup; so are fields that are shifted by a node, and a periodic cell for a free one.
#[test]
fn loads_shifts_and_boundaries_are_named() {
    let folder = Folder::new();
    let cell = "--indenter cylinder --radius 10mm --points 256 --size 4mm --modulus 1GPa";
    let solved = |flags: &str| {
        let output = folder.run(&format!("solve {cell} {flags} --tolerance 1e-12 --out run.npz"));
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        let mut npz = NpzReader::new(std::fs::File::open(folder.join("run.npz")).unwrap()).unwrap();
        npz.by_name::<ndarray::OwnedRepr<f64>, ndarray::Ix1>("pressure").unwrap()
    };
    let certify = |field: &ndarray::Array1<f64>, flags: &str| {
        write_npy(folder.join("p.npy"), field).unwrap();
        let line = format!("certify {cell} {flags} --pressure p.npy");
        let output = folder.run(&line);
        assert_eq!(output.status.code(), Some(3), "{flags}: {}", text(&output.stderr));
        (text(&output.stdout).to_owned(), json(&folder.run(&format!("{line} --json"))))
    };
    let heavy = solved("--pressure 2.31MPa");
    let (told, found) = certify(&heavy, "--mean-pressure 3MPa");
    assert!(told.contains("the pressures carry 2.31 MPa, but 3 MPa is prescribed"), "{told}");
    assert!(told.contains("contact modulus E*        1 GPa") && !told.contains("no common mistake"), "{told}");
    assert_eq!(found["findings"][0]["errors"], serde_json::json!(["load"]));
    // a load that is wrong beside other errors is told as well
    let spoiled = ndarray::Array1::from_iter(heavy.iter().enumerate().map(|(i, p)| p * (1.0 + 0.3 * (i as f64).sin())));
    let (told, _) = certify(&spoiled, "--mean-pressure 3MPa");
    assert!(told.contains(" MPa, but 3 MPa is prescribed"), "{told}");
    let rolled = ndarray::Array1::from_shape_fn(256, |i| heavy[(i + 255) % 256]);
    let (told, _) = certify(&rolled, "--mean-pressure 2.31MPa");
    assert!(
        told.contains("are shifted along x by 1 node relative to the heights: give numpy.roll(pressure, -1)"),
        "{told}"
    );
    let free = solved("--pressure 20MPa --boundary free");
    let (told, found) = certify(&free, "--mean-pressure 20MPa");
    assert!(told.contains("the pressures are those of a cell without images, but the boundary is periodic"), "{told}");
    assert_eq!(found["findings"][0]["errors"], serde_json::json!(["boundary"]));
}

#[test]
fn poissons_ratio_is_named_where_it_is_known() {
    let folder = Folder::new();
    let line = problem("line_rough_h02", 160e-6).replace("--modulus 1", "--young 1 --poisson 0.45");
    let pressure = data("line_rough_h02.pressure.npy");
    let output = folder.run(&format!("certify {line} --pressure {} --mean-pressure 3e-5", pressure.display()));
    let told = text(&output.stdout);
    assert_eq!(output.status.code(), Some(3), "{told}");
    assert!(
        told.contains("by 1 - nu^2 for nu = 0.45, as if the pressures were computed with E instead of E*"),
        "{told}"
    );
}

#[test]
fn a_noisy_pressure_is_refused_without_a_reason_and_its_worst_node_is_named() {
    let folder = Folder::new();
    let peer = peer("line_cylinder");
    let mut field = peer.pressure.clone();
    let touching: Vec<usize> = (0..field.len()).filter(|&i| field[[0, i]] > 0.0).collect();
    let middle = touching[touching.len() / 2];
    field[[0, middle]] *= 2.0;
    write(&folder, "noisy.npy", &field);
    let output = folder.run(&format!("certify {} --pressure noisy.npy", problem(&peer.name, 1.0)));
    let told = text(&output.stdout);
    assert_eq!(output.status.code(), Some(3), "{told}");
    assert!(told.contains("no common mistake explains it"), "{told}");
    assert!(told.contains(&format!("largest density at node {middle}")), "{told}");
}

#[test]
fn fields_come_from_results_and_go_into_files() {
    let folder = Folder::new();
    let scene = "--indenter cylinder --radius 1 --points 128 --size 4 --modulus 1";
    folder.run(&format!("solve {scene} --pressure 0.01 --tolerance 1e-12 --out run.npz"));
    for quantity in ["pressure", "gap", "displacement"] {
        let output = folder.run(&format!("certify --setup-of run.npz --{quantity} run.npz --out again.npz --json"));
        assert_eq!(output.status.code(), Some(0), "{quantity}: {}", text(&output.stderr));
        let found = json(&output);
        assert!(found["certificate"].as_f64().unwrap() < 1e-11, "{quantity}: {found}");
        let read = |name: &str| {
            let mut npz = NpzReader::new(std::fs::File::open(folder.join(name)).unwrap()).unwrap();
            npz.by_name::<ndarray::OwnedRepr<f64>, ndarray::Ix1>("pressure").unwrap()
        };
        let (ours, theirs) = (read("run.npz"), read("again.npz"));
        assert!(ours.iter().zip(&theirs).all(|(a, b)| (a - b).abs() < 1e-9), "{quantity}");
    }
    let table = folder.run("certify --setup-of run.npz --pressure run.npz --out nodes.csv");
    assert_eq!(table.status.code(), Some(0), "{}", text(&table.stderr));
    assert!(std::fs::read_to_string(folder.join("nodes.csv")).unwrap().starts_with("x,height,pressure,gap"));
    let picture = folder.run("certify --setup-of run.npz --pressure run.npz --out error.svg");
    assert_eq!(picture.status.code(), Some(0), "{}", text(&picture.stderr));
    let picture = std::fs::read_to_string(folder.join("error.svg")).unwrap();
    assert!(picture.contains("where the error is") && picture.matches("<polyline").count() > 20, "{picture}");
}

#[cfg(feature = "record")]
#[test]
fn the_recording_shows_where_the_error_sits() {
    let folder = Folder::new();
    let surface = data("surface_wavy.pressure.npy");
    let flags = problem("surface_wavy", 1.0);
    let output = folder.run(&format!("certify {flags} --pressure {} --record it.rrd", surface.display()));
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(text(&output.stderr).contains("wrote it.rrd"));
    let mut file = std::fs::File::open(folder.join("it.rrd")).unwrap();
    let stores = rerun::ChunkStore::from_rrd_reader(&rerun::ChunkStoreConfig::ALL_DISABLED, &mut file).unwrap();
    let chunks = stores.values().flat_map(|store| store.iter_physical_chunks());
    let entities: std::collections::BTreeSet<String> = chunks.map(|chunk| chunk.entity_path().to_string()).collect();
    for name in ["density/image", "density/contacts", "pressure/image", "gap/image", "contact"] {
        assert!(entities.contains(&format!("/contact/{name}")), "{name}: {entities:?}");
    }
}

/// A result is certified as the solution of the problem that is given: with its solid, its law and its boundary. It holds for its own problem and
/// for no other one.
#[test]
fn each_result_holds_for_its_own_problem_alone() {
    let folder = Folder::new();
    let surface = "--hurst 0.8 --rolloff 0.25 --short-cutoff 0.05 --rms-gradient 0.1 --points 128 --size 1 --seed 3";
    let body = "--young 1 --poisson 0.3";
    let kinds = [
        ("plain", String::new()),
        ("bonded", "--layer 0.05 --base bonded".into()),
        ("loose", "--layer 0.05 --base sliding".into()),
        ("hard", "--hardness 0.05".into()),
        ("harder", "--hardness 0.06".into()),
        ("free", "--boundary free".into()),
        ("slides", "--creep 4,1 --speed 0.1".to_string()),
    ];
    for (name, flags) in &kinds {
        let solved =
            folder.run(&format!("solve {surface} {body} {flags} --pressure 0.005 --tolerance 1e-10 --out {name}.npz"));
        assert!(solved.status.success(), "{name}: {}", text(&solved.stderr));
    }
    for (of, _) in &kinds {
        for (result, _) in &kinds {
            let output = folder.run(&format!("certify --setup-of {of}.npz --pressure {result}.npz"));
            let expected = if of == result { 0 } else { 3 };
            assert_eq!(output.status.code(), Some(expected), "{result} as {of}: {}", text(&output.stdout));
        }
    }
    for (flags, word) in [("--adhesion 1e-4 --adhesion-range 0.01", "adhesion"), ("--creep 4,1 --path-time 1", "past")]
    {
        let solved = folder.run(&format!("solve {surface} {body} {flags} --pressure 0.005 --out other.npz"));
        assert!(solved.status.code() != Some(2), "{}", text(&solved.stderr));
        let refused = folder.run("certify --setup-of other.npz --pressure plain.npz");
        assert!(refused.status.code() == Some(2) && text(&refused.stderr).contains(word), "{}", text(&refused.stderr));
        std::fs::remove_file(folder.join("other.npz")).unwrap();
    }
}
