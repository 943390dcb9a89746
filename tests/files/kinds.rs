//! A recording of each kind that the program writes, with all of its parts.

use asperity::Grid;
use asperity::record::Parts;
use asperity::setup::Part;
use assert_cmd::Command;
use ndarray::{Array1, Array2};
use ndarray_npy::{NpzReader, write_npy};
use std::fs::File;
use std::path::{Path, PathBuf};
use std::time::Duration;
use strum::IntoEnumIterator;

/// After which a command counts as hung.
const PATIENCE: Duration = Duration::from_secs(60);

const SCENE: &str = "\
surface.spectrum = { hurst = 0.8, rolloff-wavelength = 0.25, short-cutoff = 0.02, rms-gradient = 0.1 }
load.reduced-pressure = 0.05
";
const STUDY: &str = "\
surface = { spectrum = { hurst = [0.5, 0.8], rolloff-wavelength = 0.25, short-cutoff = 0.02, rms-gradient = 0.1 } }
grid = { points = 512, size = 1 }
load = { reduced-pressure = 0.01 }
";

/// Files of recordings, each with the command that writes it; one may need what those before it have written. `LINE` and
/// `SURFACE` are a scene on such a grid, `ALL_LINE` and `ALL_SURFACE` all parts that can be recorded of it.
pub const KINDS: &[(&str, &str)] = &[
    ("line.rrd", "solve LINE --record line.rrd --out result.npz"),
    ("surface.rrd", "solve SURFACE --record surface.rrd"),
    ("sweep.rrd", "solve LINE --reduced-pressure 1e-3..0.1:3 --unload --record sweep.rrd"),
    ("gfmd.rrd", "solve LINE --solver gfmd --record-what ALL_LINE --record gfmd.rrd"),
    ("instruments.rrd", "solve SURFACE --solver polonsky-keer --record-what ALL_SURFACE --record instruments.rrd"),
    ("inspect.rrd", "inspect --setup-of result.npz --record-what ALL_LINE --record inspect.rrd steps.npy"),
    ("certify.rrd", "certify --setup-of result.npz --pressure result.npz --record certify.rrd"),
    ("measured.rrd", "surface map.sdf --record measured.rrd"),
    ("compare.rrd", "compare line.rrd gfmd.rrd --out compare.rrd"),
    ("figure/fig2.rrd", "paper fig2 --quick --out figure"),
    ("solvers/rough-line.rrd", "accuracy rough-line --quick --record --out solvers"),
];

/// Writes the recordings of `kinds` into `folder`, and returns their paths.
pub fn record(kinds: &[(&str, &str)], folder: &Path) -> Vec<PathBuf> {
    std::fs::write(folder.join("scene.toml"), SCENE).unwrap();
    std::fs::write(folder.join("study.toml"), STUDY).unwrap();
    run("surface SURFACE --out map.sdf", folder);
    kinds
        .iter()
        .map(|(file, command)| {
            run(command, folder);
            if *file == "line.rrd" {
                write_steps(folder);
            }
            folder.join(file)
        })
        .collect()
}

/// Runs the program, which may find that what it was given has not converged.
fn run(command: &str, folder: &Path) {
    let [line, surface] = [Grid::line(512, 1.0), Grid::surface([128, 128], [1.0, 1.0])].map(Result::unwrap);
    let command = command.replace("ALL_LINE", &all_parts(&line)).replace("ALL_SURFACE", &all_parts(&surface));
    let command = command.replace("LINE", "scene.toml --points 512 --size 1");
    let command = command.replace("SURFACE", "scene.toml --points 128,128 --size 1");
    let mut program = Command::new(env!("CARGO_BIN_EXE_asperity"));
    let output = program.args(command.split_whitespace()).current_dir(folder).timeout(PATIENCE).output().unwrap();
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert!(matches!(output.status.code(), Some(0 | 3)), "{command}: {complaint}");
}

/// The names of all parts of a recording on `grid`.
fn all_parts(grid: &Grid) -> String {
    let known = Part::iter().filter(|part| Parts::on(grid).has(*part));
    known.map(Part::name).collect::<Vec<_>>().join(",")
}

/// Writes steps from the mean pressure to the solution, as another code may make them.
fn write_steps(folder: &Path) {
    let mut result = NpzReader::new(File::open(folder.join("result.npz")).unwrap()).unwrap();
    let solution: Array1<f64> = result.by_name("pressure").unwrap();
    let mean = solution.mean().unwrap();
    let steps =
        Array2::from_shape_fn((11, solution.len()), |(step, node)| mean + (solution[node] - mean) * step as f64 / 10.0);
    write_npy(folder.join("steps.npy"), &steps).unwrap();
}
