//! What a user does at the command line, run for real on small contacts.

mod adhesion;
mod below;
mod command_style;
mod flow;
mod heights;
mod in_vain;
mod interruption;
mod licences;
mod load_curves;
mod measured;
mod memory;
mod negative;
mod overwriting;
mod patches;
mod pictures;
mod plain_names;
mod refine;
mod roughness;
mod studies;
mod tables;
mod warnings;

use crate::command::{Folder, text};
use assert_cmd::Command;
use ndarray::{Array2, ArrayD, Axis, ShapeBuilder, Zip};
use ndarray_npy::{NpzReader, read_npy, write_npy};
use serde_json::Value;
use std::fs::File;
use std::process::Output;

const CYLINDER: &str = "--indenter cylinder --radius 1 --points 64 --size 4";
const SPHERE: &str = "--indenter sphere --radius 1 --points 24,32 --size 3,4";
const ROUGH_LINE: &str =
    "--hurst 0.8 --rolloff 0.25 --short-cutoff 0.02 --rms-gradient 0.1 --seed 7 --points 255 --size 1";
const ROUGH_SURFACE: &str =
    "--hurst 0.5 --rolloff 0.5 --short-cutoff 0.1 --rms-gradient 0.1 --points 40,36 --size 1,1.2";

/// Every kind of surface that is made rather than read, and its shape.
const SURFACES: [(&str, &[usize]); 13] = [
    (CYLINDER, &[64]),
    ("--indenter sine --amplitude 0.1 --points 61 --size 1", &[61]),
    ("--indenter wedge --slope 0.2 --points 64 --size 1", &[64]),
    ("--indenter power-law --coefficient 2 --exponent 4 --points 50 --size 1", &[50]),
    ("--indenter punch --half-width 0.2 --depth 1 --points 64 --size 1", &[64]),
    (SPHERE, &[24, 32]),
    ("--indenter crossed-sine --amplitude 0.1 --points 16,25 --size 1,1.5", &[16, 25]),
    ("--indenter cone --slope 0.2 --points 31,32 --size 1", &[31, 32]),
    ("--indenter power-law --coefficient 2 --exponent 4 --points 20,20 --size 1,1.2", &[20, 20]),
    ("--indenter punch --half-width 0.2 --depth 1 --points 24,24 --size 1", &[24, 24]),
    (ROUGH_LINE, &[255]),
    (ROUGH_SURFACE, &[40, 36]),
    ("--hurst 1 --rolloff 1 --short-cutoff 0.5 --rms-gradient 1e-3 --seed 0 --points 4,4 --size 1", &[4, 4]),
];

const SOLVERS: [&str; 6] = [
    "multilevel",
    "polonsky-keer",
    "gfmd --masses uniform --dynamics damped",
    "gfmd --masses uniform --dynamics fire",
    "gfmd --masses stiffness --dynamics damped",
    "gfmd --masses stiffness --dynamics fire --time-step 0.6 --damping 0.8",
];

/// Numbers that every summary has.
const NUMBERS: [&str; 18] = [
    "relative_area",
    "relative_area_counted",
    "relative_area_corrected",
    "rms_gradient",
    "rms_gradient_contact_counted",
    "reduced_pressure",
    "kappa",
    "kappa_r_counted",
    "kappa_r_corrected",
    "mean_gap",
    "mean_pressure",
    "max_pressure",
    "certificate",
    "penetration",
    "iterations",
    "transforms",
    "seconds",
    "rms_height",
];

/// The arrays of an `.npz`.
struct Fields {
    height: ArrayD<f64>,
    pressure: ArrayD<f64>,
    gap: ArrayD<f64>,
    displacement: ArrayD<f64>,
    contact: ArrayD<bool>,
    converged: bool,
    certificate: f64,
}

impl Fields {
    fn read(file: File) -> Self {
        let mut npz = NpzReader::new(file).unwrap();
        let mut field = |name| -> ArrayD<f64> { npz.by_name(name).unwrap() };
        let (height, pressure, gap) = (field("height"), field("pressure"), field("gap"));
        let (displacement, certificate) = (field("displacement"), field("certificate").sum());
        let contact = npz.by_name("contact").unwrap();
        let converged: ArrayD<bool> = npz.by_name("converged").unwrap();
        let converged = converged[[]];
        Self { height, pressure, gap, displacement, contact, converged, certificate }
    }
}

/// Solves, and returns the JSON object and the arrays.
fn solve(folder: &Folder, arguments: &str) -> (Value, Fields) {
    let output = folder.run(&format!("solve {arguments} --json --out contact.npz"));
    assert!(output.status.success(), "{arguments}: {}", text(&output.stderr));
    let summary = json(&output);
    check_said(text(&output.stderr), &summary, arguments);
    (summary, Fields::read(File::open(folder.join("contact.npz")).unwrap()))
}

/// What is said on standard error: the warnings of the summary, and which files were written.
fn check_said(said: &str, summary: &Value, arguments: &str) {
    let (wrote, warned): (Vec<&str>, Vec<&str>) = said.lines().partition(|line| line.starts_with("wrote "));
    let warnings = summary["warnings"].as_array().unwrap().iter().map(|warning| warning.as_str().unwrap());
    assert!(warned.into_iter().eq(warnings.map(|it| format!("warning: {it}"))), "{arguments}: {said}");
    assert!(wrote.contains(&"wrote contact.npz: numpy.load(\"contact.npz\") in Python"), "{arguments}: {said}");
}

/// The one JSON object on standard output.
fn json(output: &Output) -> Value {
    let out = text(&output.stdout);
    assert_eq!(out.lines().count(), 1, "{out}");
    serde_json::from_str(out).unwrap()
}

fn number(summary: &Value, key: &str) -> f64 {
    summary[key].as_f64().unwrap_or_else(|| panic!("{key} is {} in {summary}", summary[key]))
}

fn assert_close(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance * expected.abs(), "{what}: {found:e} against {expected:e}");
}

/// The numbers of a summary without its seconds, which no two runs share, and what it says of its source.
fn timeless(mut summary: Value) -> Value {
    for key in ["seconds", "setup", "source", "warnings"] {
        summary.as_object_mut().unwrap().remove(key).unwrap();
    }
    summary
}

/// What holds for the summary of any converged contact under the pressure `load`.
fn check_summary(summary: &Value, load: f64) {
    let n = |key| number(summary, key);
    assert!(NUMBERS.iter().all(|key| n(key).is_finite()), "{summary}");
    assert!(NUMBERS.iter().all(|&key| n(key) >= 0.0 || key == "mean_gap"), "{summary}");
    assert!(n("mean_gap") >= -n("penetration") * n("rms_height"), "{summary}");
    assert_eq!(summary["status"], "converged");
    assert_close(n("mean_pressure"), load, 1e-12, "mean pressure");
    assert_close(n("reduced_pressure"), load / (n("rms_gradient") * n("contact_modulus")), 1e-12, "p*");
    assert_close(n("kappa"), n("relative_area") / n("reduced_pressure"), 1e-12, "kappa");
    for kind in ["", "_counted", "_corrected"] {
        let [area, gradient, kappa_r] =
            ["relative_area", "rms_gradient_contact", "kappa_r"].map(|it| format!("{it}{kind}"));
        let expected = number(summary, &area) * n("contact_modulus") / load;
        // the contact of a punch has no gradient
        if let Some(gradient) = summary[&gradient].as_f64() {
            assert_close(number(summary, &kappa_r), gradient * expected, 1e-12, &kappa_r);
        }
    }
    assert!(n("certificate") <= 1e-8 && n("penetration") <= 1e-8, "{summary}");
    assert!(n("relative_area") > 0.0 && n("relative_area") <= 1.0);
    assert!(n("relative_area_corrected") <= n("relative_area_counted"));
    assert!(n("max_pressure") >= n("mean_pressure") && n("transforms") > n("iterations"));
}

/// What holds for the arrays of any contact, whose summary is given.
fn check_fields(fields: &Fields, summary: &Value, shape: &[usize]) {
    let Fields { height, pressure, gap, displacement, contact, .. } = fields;
    for field in [height, pressure, gap, displacement] {
        assert_eq!(field.shape(), shape);
    }
    assert_eq!(summary["points"], serde_json::json!(shape));
    assert_eq!(*contact, pressure.mapv(|p| p > 0.0));
    assert!(pressure.iter().all(|&p| p >= 0.0));
    let n = |key| number(summary, key);
    let (length, points) = (n("rms_height"), pressure.len() as f64);
    assert_close(pressure.sum() / points, n("mean_pressure"), 1e-12, "mean pressure of the array");
    assert_close(
        contact.iter().filter(|c| **c).count() as f64 / points,
        n("relative_area_counted"),
        1e-12,
        "area of the array",
    );
    assert_close(gap.sum() / points, n("mean_gap"), 1e-10, "mean gap of the array");
    assert_close(fields.certificate, n("certificate"), 1e-15, "certificate");
    // <p g> = 0 and g >= -eta h_rms leave at most twice eta of |p g|
    let eta = n("certificate") * 1.001 + 1e-15;
    assert!(gap.iter().all(|&g| g >= -eta * length), "penetration");
    let product = Zip::from(gap).and(pressure).fold(0.0, |sum, g, p| sum + (g * p).abs()) / points;
    assert!(product <= 2.0 * eta * n("mean_pressure") * length, "gap under pressure: {product:e}");
    let datum = gap - displacement + height;
    assert!(datum.iter().all(|d| (d - datum[vec![0; shape.len()].as_slice()]).abs() < 1e-12 * length), "g = u - h + d");
    assert!((displacement.sum() / points).abs() < 1e-12 * length, "mean displacement");
}

/// Heights without symmetry.
fn hills(shape: [usize; 2]) -> Array2<f64> {
    let [ny, nx] = shape.map(|n| n as f64 / std::f64::consts::TAU);
    Array2::from_shape_fn(shape, |(i, j)| {
        (j as f64 / nx).cos() + 0.4 * (3.0 * j as f64 / nx + 1.0).sin() + 0.5 * (i as f64 / ny + 0.5).cos()
    })
}

/// Root-mean-square gradient over all axes (Eq. 8), straight from its definition.
fn rms_gradient(height: &ArrayD<f64>, size: &[f64]) -> f64 {
    let mean_square = |(axis, length): (usize, &f64)| {
        let points = height.len_of(Axis(axis));
        let spacing = length / points as f64;
        let slope =
            |i: usize| (&height.index_axis(Axis(axis), (i + 1) % points) - &height.index_axis(Axis(axis), i)) / spacing;
        (0..points).map(|i| slope(i).mapv(|s| s * s).mean().unwrap()).sum::<f64>() / points as f64
    };
    size.iter().enumerate().map(mean_square).sum::<f64>().sqrt()
}

#[test]
fn every_surface_that_can_be_made_is_solved() {
    let folder = Folder::new();
    for (surface, shape) in SURFACES {
        let (summary, fields) = solve(&folder, &format!("{surface} --modulus 1 --pressure 0.004"));
        check_summary(&summary, 0.004);
        check_fields(&fields, &summary, shape);
        assert!(fields.converged);
        assert_eq!(summary.get("seed").is_some(), surface.contains("--hurst"), "only a random surface has a seed");
        assert!(folder.run(&format!("surface {surface} --out surface.npy")).status.success());
        assert_eq!(read_npy::<_, ArrayD<f64>>(folder.join("surface.npy")).unwrap(), fields.height, "{surface}");
    }
}

#[test]
fn every_solver_finds_the_same_contact() {
    let folder = Folder::new();
    for (surface, shape) in
        [(CYLINDER, &[64][..]), (SPHERE, &[24, 32]), (ROUGH_LINE, &[255]), (ROUGH_SURFACE, &[40, 36])]
    {
        let found = SOLVERS.map(|solver| {
            let (summary, fields) =
                solve(&folder, &format!("{surface} --modulus 1 --pressure 0.004 --solver {solver}"));
            check_summary(&summary, 0.004);
            check_fields(&fields, &summary, shape);
            assert_eq!(summary["solver"]["method"], solver.split(' ').next().unwrap());
            number(&summary, "mean_gap")
        });
        assert!(found.iter().all(|gap| (gap / found[0] - 1.0).abs() < 1e-6), "{surface}: {found:?}");
    }
}

#[test]
fn a_smooth_contact_comes_with_its_exact_solution() {
    let (summary, _) =
        solve(&Folder::new(), &format!("{} --modulus 1 --pressure 0.01", CYLINDER.replace("64", "1024")));
    let exact = &summary["exact"];
    assert_close(number(&summary, "relative_area"), number(exact, "relative_area"), 1e-3, "area");
    assert_close(number(&summary, "kappa_r"), number(exact, "kappa_r"), 2e-3, "kappa_r");
    assert_close(number(&summary, "mean_gap"), number(exact, "mean_gap"), 1e-3, "mean gap");
    assert_close(number(&summary, "max_pressure"), number(exact, "max_pressure"), 1e-3, "peak pressure");
}

/// A cylinder that touches on three thousandths of its cell: `eta`, over its rms height, is met long before its pressure is known.
#[test]
fn a_narrow_contact_is_solved_to_a_bound_of_its_pressure() {
    let folder = Folder::new();
    let narrow = "--indenter cylinder --radius 1 --points 16384 --size 4 --modulus 1 --pressure 8e-6";
    let [(loose, _), (tight, _)] =
        ["", " --pressure-tolerance 1e-5"].map(|goal| solve(&folder, &format!("{narrow}{goal}")));
    let bound = |summary| number(summary, "pressure_error_bound");
    assert!(bound(&loose) > 1e-4 && bound(&tight) <= 1e-5, "{} {}", bound(&loose), bound(&tight));
    assert_eq!(tight["setup"]["stop"]["pressure-tolerance"], 1e-5);
    let output = folder.run(&format!("solve {narrow} --pressure-tolerance 1e-30 --max-iterations 40"));
    assert_eq!(output.status.code(), Some(3));
    assert!(
        text(&output.stderr).contains("and a relative error of the pressure of at most"),
        "{}",
        text(&output.stderr)
    );
}

#[test]
fn the_stiffness_is_told_where_it_is_asked_for() {
    let folder = Folder::new();
    let sine = "--indenter sine --amplitude 0.01 --points 1024 --size 1 --modulus 1";
    let (without, _) = solve(&folder, &format!("{sine} --mean-gap 0.002"));
    assert!(without["stiffness"].is_null() && without["mean_pressure_error"].is_null(), "{without}");
    let (with, _) = solve(&folder, &format!("{sine} --mean-gap 0.002 --stiffness"));
    assert!(number(&with, "stiffness") > 0.0 && number(&with, "mean_pressure_error") < 1e-5, "{with}");
    let output = folder.run(&format!("solve {sine} --mean-gap 0.004,0.002 --stiffness --json"));
    let loads = json(&output)["states"].as_array().unwrap().clone();
    assert_close(number(&loads[1], "stiffness"), number(&with, "stiffness"), 1e-4, "stiffness of a curve");
    assert!(number(&loads[0], "stiffness") < number(&loads[1], "stiffness"));
}

#[test]
fn a_mean_gap_presses_as_the_pressure_that_makes_it() {
    let folder = Folder::new();
    for (surface, shape) in [(CYLINDER, &[64][..]), (SPHERE, &[24, 32]), (ROUGH_SURFACE, &[40, 36])] {
        let (pressed, _) = solve(&folder, &format!("{surface} --modulus 1 --pressure 0.004 --tolerance 1e-11"));
        let gap = number(&pressed, "mean_gap");
        let run = format!("{surface} --mean-gap {gap:e} --solver polonsky-keer --tolerance 1e-11");
        let (apart, fields) = solve(&folder, &run);
        check_fields(&fields, &apart, shape);
        assert_eq!((&pressed["prescribed"], &apart["prescribed"]), (&"mean pressure".into(), &"mean gap".into()));
        assert_close(number(&apart, "mean_gap"), gap, 1e-9, "mean gap");
        for key in ["mean_pressure", "reduced_pressure", "kappa_r", "max_pressure", "relative_area"] {
            assert_close(number(&apart, key), number(&pressed, key), 1e-6, key);
        }
        match pressed.get("exact") {
            Some(exact) => {
                assert_close(number(&apart["exact"], "relative_area"), number(exact, "relative_area"), 1e-6, "")
            }
            None => assert!(apart.get("exact").is_none()),
        }
        let summary = folder.run(&format!("solve {run}"));
        let is_told = |line: &str| line.split_whitespace().eq(["prescribed", "mean", "gap"]);
        assert!(text(&summary.stdout).lines().any(is_told), "{}", text(&summary.stdout));
    }
}

/// The same heights, but for the rounding of taking their mean off and adding it back.
fn assert_same(found: &ArrayD<f64>, given: &ArrayD<f64>) {
    assert_eq!(found.shape(), given.shape());
    let largest = given.fold(0.0, |m: f64, h| m.max(h.abs()));
    assert!(found.iter().zip(given).all(|(f, g)| (f - g).abs() <= 4.0 * f64::EPSILON * largest));
}

#[test]
fn heights_from_a_file_come_back_as_they_were() {
    let folder = Folder::new();
    for (shape, size) in [(vec![60], "2"), (vec![12, 20], "3,2"), (vec![20, 12], "3"), (vec![1, 30], "2")] {
        let rows = if shape.len() == 1 { 1 } else { shape[0] };
        let height = hills([rows, *shape.last().unwrap()]).into_shape_with_order(shape.clone()).unwrap();
        write_npy(folder.join("h.npy"), &height).unwrap();
        let (summary, fields) = solve(&folder, &format!("--height h.npy --size {size} --modulus 1 --pressure 0.3"));
        check_summary(&summary, 0.3);
        check_fields(&fields, &summary, &shape);
        assert_same(&fields.height, &height);
        assert!(summary.get("seed").is_none());
    }
}

#[test]
fn lengths_are_along_the_axes_of_the_array() {
    let folder = Folder::new();
    let height = hills([12, 20]).into_dyn();
    write_npy(folder.join("h.npy"), &height).unwrap();
    for (size, lengths) in [("3,2", [3.0, 2.0]), ("2,3", [2.0, 3.0]), ("2.5", [2.5, 2.5])] {
        let (summary, _) = solve(&folder, &format!("--height h.npy --size {size} --modulus 1 --pressure 0.3"));
        assert_close(number(&summary, "rms_gradient"), rms_gradient(&height, &lengths), 1e-12, size);
    }
}

#[test]
fn singles_and_fortran_order_are_read() {
    let folder = Folder::new();
    let load = "--height h.npy --size 3,2 --modulus 1 --pressure 0.3";
    let height = hills([12, 20]);
    write_npy(folder.join("h.npy"), &height).unwrap();
    let (plain, _) = solve(&folder, load);
    let mut fortran = Array2::zeros(height.dim().f());
    fortran.assign(&height);
    write_npy(folder.join("h.npy"), &fortran).unwrap();
    let (summary, fields) = solve(&folder, load);
    assert_same(&fields.height, &height.clone().into_dyn());
    assert_eq!(timeless(summary), timeless(plain));
    let single = height.mapv(|h| h as f32);
    write_npy(folder.join("h.npy"), &single).unwrap();
    let (summary, fields) = solve(&folder, load);
    check_summary(&summary, 0.3);
    assert_same(&fields.height, &single.mapv(f64::from).into_dyn());
}

#[test]
fn one_row_is_a_line() {
    let folder = Folder::new();
    let row = hills([1, 30]);
    write_npy(folder.join("row.npy"), &row).unwrap();
    write_npy(folder.join("line.npy"), &row.row(0)).unwrap();
    let of = |name: &str| {
        let (mut summary, _) = solve(&folder, &format!("--height {name} --size 2 --modulus 1 --pressure 0.3"));
        for key in ["points", "size", "spacing", "jump_in_rms_steps"] {
            let last = summary[key].as_array_mut().unwrap().pop().unwrap();
            summary[key] = last;
        }
        timeless(summary)
    };
    assert_eq!(of("row.npy"), of("line.npy"));
}

#[test]
fn a_reduced_pressure_is_a_pressure_over_gradient_and_modulus() {
    let (summary, _) = solve(&Folder::new(), &format!("{ROUGH_LINE} --reduced-pressure 0.03 --modulus 5e9"));
    let load = 0.03 * number(&summary, "rms_gradient") * 5e9;
    check_summary(&summary, load);
    assert_close(number(&summary, "reduced_pressure"), 0.03, 1e-12, "p*");
}

#[test]
fn the_modulus_only_scales_pressures() {
    let folder = Folder::new();
    for surface in [CYLINDER, ROUGH_SURFACE] {
        let (soft, _) = solve(&folder, &format!("{surface} --modulus 1 --pressure 0.004"));
        let (stiff, _) = solve(&folder, &format!("{surface} --pressure 1.2e7 --modulus 3e9"));
        check_summary(&stiff, 1.2e7);
        assert_eq!(number(&stiff, "relative_area_counted"), number(&soft, "relative_area_counted"));
        assert_close(number(&stiff, "kappa_r"), number(&soft, "kappa_r"), 1e-10, "kappa_r");
        assert_close(number(&stiff, "mean_gap"), number(&soft, "mean_gap"), 1e-7, "mean gap");
        assert_close(number(&stiff, "max_pressure"), 3e9 * number(&soft, "max_pressure"), 1e-6, "peak pressure");
    }
}

#[test]
fn the_tolerance_is_reached_but_not_far_exceeded() {
    let folder = Folder::new();
    for tolerance in [1e-3, 1e-6, 1e-12] {
        let (summary, _) =
            solve(&folder, &format!("{ROUGH_LINE} --modulus 1 --pressure 0.004 --tolerance {tolerance}"));
        let certificate = number(&summary, "certificate");
        assert!(certificate <= tolerance && certificate > 1e-3 * tolerance, "{certificate:e} for {tolerance:e}");
    }
}

#[test]
fn a_seed_gives_the_same_numbers_on_any_number_of_threads() {
    let folder = Folder::new();
    let line = "--hurst 0.8 --rolloff 0.1 --short-cutoff 0.001 --rms-gradient 0.1 --seed 3 --points 40000 --size 1";
    let surface = "--hurst 0.8 --rolloff 0.5 --short-cutoff 0.05 --rms-gradient 0.1 --seed 3 --points 180,192 --size 1";
    for (surface, solver) in
        [(line, "polonsky-keer"), (surface, "polonsky-keer"), (surface, "gfmd --max-iterations 40")]
    {
        let on = |threads: &str| {
            let arguments =
                format!("solve {surface} --modulus 1 --pressure 0.004 --solver {solver} --json --out {threads}.npz");
            let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
            command.args(arguments.split(' ')).env("RAYON_NUM_THREADS", threads);
            let summary = timeless(json(&folder.finish(&mut command)));
            (summary, Fields::read(File::open(folder.join(&format!("{threads}.npz"))).unwrap()).pressure)
        };
        let one = on("1");
        assert_eq!(one.0["seed"], 3);
        assert_eq!(one, on("2"));
        assert_eq!(one, on("3"));
    }
}

#[test]
fn another_seed_is_another_surface() {
    let folder = Folder::new();
    let gap = |surface: &str| number(&solve(&folder, &format!("{surface} --modulus 1 --pressure 0.004")).0, "mean_gap");
    assert_ne!(gap(ROUGH_LINE), gap(&ROUGH_LINE.replace("--seed 7", "--seed 8")));
}

#[test]
fn a_contact_that_does_not_converge_is_written_all_the_same_and_says_so() {
    let folder = Folder::new();
    for solver in SOLVERS {
        let recorded = if cfg!(feature = "record") { "--record contact.rrd" } else { "" };
        let run =
            format!("solve {ROUGH_LINE} --modulus 1 --pressure 0.004 --max-iterations 3 --solver {solver} {recorded}");
        let output = folder.run(&format!("{run} --json --out contact.npz"));
        assert_eq!(output.status.code(), Some(3));
        let said = text(&output.stderr);
        assert_eq!(said.lines().filter(|line| line.starts_with("warning: not converged")).count(), 1, "{said}");
        let summary = json(&output);
        assert_eq!((&summary["status"], &summary["claim"]), (&"iteration-cap".into(), &"not-converged".into()));
        assert_eq!(summary["warnings"], serde_json::json!(warnings::warnings(&output)));
        assert_eq!(summary["iterations"], 3);
        assert_close(number(&summary, "mean_pressure"), 0.004, 1e-12, "mean pressure");
        assert!(number(&summary, "certificate") > 1e-8);
        let fields = Fields::read(File::open(folder.join("contact.npz")).unwrap());
        assert!(!fields.converged);
        check_fields(&fields, &summary, &[255]);
        let output = folder.run(&run);
        assert_eq!(output.status.code(), Some(3));
        assert!(text(&output.stdout).contains("iteration cap"), "{}", text(&output.stdout));
        #[cfg(feature = "record")]
        assert_is_recording(&folder, "contact.rrd");
    }
}

#[test]
fn a_tolerance_below_rounding_ends_without_convergence() {
    let output =
        Folder::new().run(&format!("solve {ROUGH_SURFACE} --modulus 1 --pressure 0.004 --tolerance 1e-30 --json"));
    assert_eq!(output.status.code(), Some(3));
    assert_eq!(json(&output)["status"], "stalled");
}

#[test]
fn the_summary_reads_well() {
    let output = Folder::new().run(&format!("solve {CYLINDER} --modulus 1 --pressure 0.01"));
    let out = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0));
    let title = out.lines().next().unwrap();
    assert!(["Cylinder", "64 points", "multilevel", ": converged"].iter().all(|words| title.contains(words)), "{out}");
    // results come first, and those that depend on the grid have its error
    let first: Vec<&str> = out.lines().skip(1).take(6).collect();
    let names = ["relative area", "kappa_r", "mean gap", "mean pressure", "largest pressure", "certificate"];
    assert!(first.iter().zip(names).all(|(row, name)| row.trim_start().starts_with(name)), "{out}");
    assert!(first[..2].iter().all(|row| row.contains(" ± ")), "{out}");
    for words in ["cylinder, radius 1.0", "spacing                   6.250000e-2", "1.000000e0 (given)"] {
        assert!(out.contains(words), "{words} in {out}");
    }
    let further =
        ["reduced pressure", "rms gradient", "kappa ", "kappa, counted", "work", "penetration", "load error", "solver"];
    let all = Folder::new().run(&format!("solve {CYLINDER} --modulus 1 --pressure 0.01 --verbose"));
    for line in further {
        let has = |out: &str| out.lines().any(|row| row.trim_start().starts_with(line));
        assert!(!has(out) && has(text(&all.stdout)), "{line} in {}", text(&all.stdout));
    }
    assert!(text(&output.stderr).is_empty());
}

#[test]
fn a_surface_that_was_written_is_solved_as_if_just_made() {
    let folder = Folder::new();
    for (surface, size) in [(ROUGH_LINE, "1"), (ROUGH_SURFACE, "1,1.2")] {
        assert!(folder.run(&format!("surface {surface} --out h.npy")).status.success());
        let (mut made, _) = solve(&folder, &format!("{surface} --modulus 1 --pressure 0.004"));
        let (read, _) = solve(&folder, &format!("--height h.npy --size {size} --modulus 1 --pressure 0.004"));
        assert!(made.as_object_mut().unwrap().remove("seed").is_some());
        assert_eq!(timeless(made), timeless(read));
    }
}

#[test]
fn a_result_is_solved_again_to_the_last_bit_from_itself() {
    let folder = Folder::new();
    let run = "--indenter cylinder --radius 3um --hurst 0.7 --rolloff 0.3um --short-cutoff 0.1um --rms-gradient 0.0123 \
               --points 256 --size 7um --modulus 3.3GPa --reduced-pressure 0.0321 --solver polonsky-keer";
    let (summary, _) = solve(&folder, &format!("{run} --save-setup scene.toml"));
    std::fs::write(folder.join("result.json"), summary.to_string()).unwrap();
    std::fs::copy(folder.join("contact.npz"), folder.join("result.npz")).unwrap();
    let pressure = |folder: &Folder| Fields::read(File::open(folder.join("contact.npz")).unwrap()).pressure;
    let expected = pressure(&folder);
    let mut sources = vec!["scene.toml", "--setup-of result.npz", "--setup-of result.json"];
    if cfg!(feature = "record") {
        assert!(folder.run(&format!("solve {run} --record result.rrd")).status.success());
        sources.push("--setup-of result.rrd");
    }
    for source in sources {
        let (again, _) = solve(&folder, source);
        assert_eq!(pressure(&folder), expected, "{source}");
        assert_eq!(timeless(again.clone()), timeless(summary.clone()), "{source}");
        assert_eq!(again["setup"], summary["setup"], "{source}");
    }
    let (harder, _) = solve(&folder, "scene.toml --reduced-pressure 0.1");
    assert_eq!(number(&harder, "reduced_pressure"), 0.1);
}

#[test]
fn the_statistics_of_a_surface_are_those_of_its_heights() {
    let folder = Folder::new();
    for (surface, size) in [(ROUGH_LINE, &[1.0][..]), (ROUGH_SURFACE, &[1.0, 1.2])] {
        let made = json(&folder.run(&format!("surface {surface} --out h.npy --json")));
        let height: ArrayD<f64> = read_npy(folder.join("h.npy")).unwrap();
        assert_eq!(made["points"], serde_json::json!(height.shape()));
        assert_eq!(made["size"], serde_json::json!(size));
        assert_close(number(&made, "rms_gradient"), 0.1, 1e-12, "the gradient asked for");
        assert_close(number(&made, "rms_gradient"), rms_gradient(&height, size), 1e-12, "gradient");
        let centred = &height - height.mean().unwrap();
        assert_close(number(&made, "rms_height"), centred.mapv(|z| z * z).mean().unwrap().sqrt(), 1e-12, "height");
        assert_close(number(&made, "peak"), centred.fold(0.0, |m: f64, &z| m.max(z)), 1e-12, "peak");
        assert_close(number(&made, "valley"), centred.fold(0.0, |m: f64, &z| m.max(-z)), 1e-12, "valley");
        let size = size.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        let read = json(&folder.run(&format!("surface --height h.npy --size {size} --json")));
        for (key, value) in read
            .as_object()
            .unwrap()
            .iter()
            .filter(|(key, _)| !["source", "file", "warnings", "verdict"].contains(&key.as_str()))
        {
            assert_eq!(&made[key], value, "{key}");
        }
        assert_eq!(read["source"], "heights from h.npy");
        assert!(made.get("seed").is_some() && read.get("seed").is_none());
    }
}

#[test]
fn the_statistics_of_a_surface_read_well() {
    let output = Folder::new().run(&format!("surface {ROUGH_SURFACE}"));
    let out = text(&output.stdout);
    assert!(output.status.success() && text(&output.stderr).is_empty(), "{output:?}");
    for words in
        ["H = 0.5", "seed 1", "40 x 36", "1 x 1.2", "rms height", "rms gradient              0.100000", "kurtosis"]
    {
        assert!(out.contains(words), "{words} in {out}");
    }
}

#[test]
fn an_output_replaces_an_older_one() {
    let folder = Folder::new();
    std::fs::write(folder.join("contact.npz"), "old").unwrap();
    let (summary, fields) = solve(&folder, &format!("{CYLINDER} --modulus 1 --pressure 0.01"));
    check_fields(&fields, &summary, &[64]);
}

#[test]
fn help_and_version_are_no_errors() {
    let folder = Folder::new();
    for line in ["--help", "--version", "solve --help", "surface --help"] {
        let output = folder.run(line);
        assert!(output.status.success() && !output.stdout.is_empty() && output.stderr.is_empty(), "{line}");
    }
}

#[cfg(feature = "record")]
fn assert_is_recording(folder: &Folder, name: &str) -> usize {
    let bytes = std::fs::read(folder.join(name)).unwrap();
    assert!(bytes.starts_with(b"RRF2"), "{:?}", &bytes[..4.min(bytes.len())]);
    bytes.len()
}

#[cfg(feature = "record")]
#[test]
fn a_recording_does_not_change_the_result() {
    let folder = Folder::new();
    for surface in [CYLINDER, ROUGH_SURFACE] {
        let run = format!("{surface} --modulus 1 --pressure 0.004 --solver gfmd");
        let (recorded, _) = solve(&folder, &format!("{run} --record contact.rrd --length-unit mm"));
        assert_is_recording(&folder, "contact.rrd");
        let (alone, _) = solve(&folder, &run);
        assert_eq!(timeless(recorded), timeless(alone));
    }
}

#[cfg(feature = "record")]
#[test]
fn fewer_recorded_steps_make_a_smaller_file() {
    let folder = Folder::new();
    let size = |every: &str| {
        solve(
            &folder,
            &format!("{ROUGH_LINE} --modulus 1 --pressure 0.004 --solver gfmd --record contact.rrd {every}"),
        );
        assert_is_recording(&folder, "contact.rrd")
    };
    let (all, some, few) = (size("--record-every 1"), size(""), size("--record-every 100000"));
    assert!(all > some && some > few, "{all}, {some}, {few}");
}

/// The first number of bytes behind `words`.
fn bytes_after(out: &str, words: &str) -> f64 {
    let mut rest = out.split(words).nth(1).unwrap_or_else(|| panic!("{words} in {out}")).split_whitespace();
    let value: f64 = rest.next().unwrap().parse().unwrap();
    let unit = rest.next().unwrap().trim_end_matches([':', ',']);
    value
        * match unit {
            "kB" => 1e3,
            "MB" => 1e6,
            "GB" => 1e9,
            _ => panic!("{unit} in {out}"),
        }
}

#[test]
fn a_dry_run_says_what_a_solve_takes_and_writes_nothing() {
    let folder = Folder::new();
    write_npy(folder.join("hills.npy"), &hills([32, 48])).unwrap();
    let before = std::fs::read_dir(folder.join("")).unwrap().count();
    let file = "--height hills.npy --size 1";
    for (surface, points) in [(CYLINDER, "64"), (SPHERE, "24 x 32"), (ROUGH_LINE, "255"), (file, "32 x 48")] {
        for solver in SOLVERS {
            let line = format!("solve {surface} --modulus 1 --pressure 0.004 --solver {solver} --out a.npz --dry-run");
            let output = folder.run(&line);
            let out = text(&output.stdout);
            assert!(output.status.success() && output.stderr.is_empty(), "{line}: {}", text(&output.stderr));
            assert!(out.contains(&format!("points      {points}\n")) && out.contains("memory      about"), "{out}");
            assert_eq!(out.contains("transforms  about 100"), solver == "multilevel", "{out}");
        }
    }
    let huge = ROUGH_SURFACE.replace("40,36", "16384,16384");
    let output = folder.run(&format!("solve {huge} --reduced-pressure 0.01 --dry-run"));
    assert!(text(&output.stdout).contains("grids       10, from 32 x 32 to 16384 x 16384"), "{output:?}");
    assert_eq!(std::fs::read_dir(folder.join("")).unwrap().count(), before);
    for bad in ["--json", "--size 1,2,3", "--mean-gap 1"] {
        let output = folder.run(&format!("solve {ROUGH_LINE} --modulus 1 --pressure 0.004 --dry-run {bad}"));
        assert_eq!(output.status.code(), Some(2), "{bad}");
    }
}

#[cfg(feature = "record")]
#[test]
fn a_dry_run_tells_the_size_of_a_recording_about() {
    let folder = Folder::new();
    for (surface, points) in [(ROUGH_LINE, "4096"), (ROUGH_LINE, "1024"), (ROUGH_SURFACE, "128,128")] {
        let surface = surface.replace("255", points).replace("40,36", points);
        for solver in ["multilevel", "polonsky-keer"] {
            let run =
                format!("{surface} --reduced-pressure 0.05 --solver {solver} --max-iterations 200 --record a.rrd");
            let output = folder.run(&format!("solve {run} --dry-run"));
            assert!(!folder.join("a.rrd").exists());
            let most = bytes_after(text(&output.stdout), "at most about ");
            let numbers = bytes_after(text(&output.stdout), ", and ");
            let output = folder.run(&format!("solve {run} --json"));
            let steps = number(&json(&output), "iterations");
            let (told, made) = (most + numbers * steps / 1e3, assert_is_recording(&folder, "a.rrd") as f64);
            assert!((0.8..5.0).contains(&(told / made)), "{told} bytes told, {made} made: {run}");
            std::fs::remove_file(folder.join("a.rrd")).unwrap();
        }
    }
}

#[cfg(feature = "record")]
#[test]
fn a_recording_of_some_parts_is_smaller_and_does_not_change_the_result() {
    let folder = Folder::new();
    for (surface, parts) in [(ROUGH_LINE, ["traces", "mask,profile"]), (ROUGH_SURFACE, ["traces", "mesh"])] {
        let run = format!("{surface} --modulus 1 --pressure 0.004 --record contact.rrd");
        let (whole, _) = solve(&folder, &run);
        let bytes = assert_is_recording(&folder, "contact.rrd");
        for parts in parts {
            let (part, _) = solve(&folder, &format!("{run} --record-what {parts}"));
            assert!(assert_is_recording(&folder, "contact.rrd") < bytes, "{parts}");
            assert_eq!(timeless(part), timeless(whole.clone()));
        }
    }
}

#[cfg(feature = "record")]
#[test]
fn the_demo_records_four_contacts_in_less_than_40_megabytes() {
    let folder = Folder::new();
    let output = folder.run("demo --out demo.rrd");
    let out = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    for words in ["kappa_r", "Hertz line", "Rough line", "Hertz point", "Rough surface"] {
        assert!(out.contains(words), "{words} in {out}");
    }
    assert_eq!(text(&output.stderr), "wrote demo.rrd: asperity view demo.rrd\n");
    let size = assert_is_recording(&folder, "demo.rrd");
    assert!(size < 40_000_000, "{size}");
}

#[test]
fn results_stand_alone() {
    let folder = Folder::new();
    let (summary, _) = solve(&folder, &format!("{ROUGH_SURFACE} --modulus 1GPa --pressure 1MPa --solver gfmd"));
    assert_eq!(summary["size"], serde_json::json!([1.0, 1.2]));
    assert!(summary["source"].as_str().unwrap().starts_with("self-affine roughness, H = 0.5"));
    let mut npz = NpzReader::new(File::open(folder.join("contact.npz")).unwrap()).unwrap();
    let mut array = |name: &str| -> ArrayD<f64> { npz.by_name(name).unwrap() };
    let expected = |n: usize, length: f64| (0..n).map(|i| i as f64 * (length / n as f64)).collect::<Vec<_>>();
    assert_eq!(array("x").into_raw_vec_and_offset().0, expected(36, 1.2));
    assert_eq!(array("y").into_raw_vec_and_offset().0, expected(40, 1.0));
    assert_eq!(array("size").into_raw_vec_and_offset().0, [1.0, 1.2]);
    assert_eq!(array("contact_modulus")[[]], 1e9);
    for key in ["mean_pressure", "reduced_pressure", "mean_gap", "kappa_r", "nodes_per_patch", "transforms"] {
        assert_eq!(array(key)[[]], number(&summary, key), "{key}");
    }
    // three runs of one method are told apart
    let settings = ["--masses uniform", "--masses stiffness", "--masses stiffness --dynamics fire"];
    let solvers =
        settings.map(|it| solve(&folder, &format!("{ROUGH_SURFACE} --reduced-pressure 0.1 --solver gfmd {it}")).0);
    assert_eq!(solvers[2]["solver"]["dynamics"], "fire");
    assert!(solvers.iter().enumerate().all(|(i, a)| solvers[..i].iter().all(|b| a["solver"] != b["solver"])));
}

#[test]
fn a_line_is_written_as_a_table() {
    let folder = Folder::new();
    let (_, fields) = solve(&folder, &format!("{CYLINDER} --modulus 1 --pressure 0.01"));
    let output = folder.run(&format!("solve {CYLINDER} --modulus 1 --pressure 0.01 --out nodes.csv"));
    assert_eq!(output.status.code(), Some(0));
    assert!(
        text(&output.stderr)
            .ends_with("wrote nodes.csv: pandas.read_csv(\"nodes.csv\") in Python, or any spreadsheet\n")
    );
    let table = std::fs::read_to_string(folder.join("nodes.csv")).unwrap();
    let mut lines = table.lines();
    assert_eq!(lines.next(), Some("x,height,pressure,gap,displacement,contact"));
    let rows: Vec<Vec<f64>> = lines.map(|line| line.split(',').map(|word| word.parse().unwrap()).collect()).collect();
    assert_eq!(rows.len(), 64);
    for (i, row) in rows.iter().enumerate() {
        let contact = f64::from(u8::from(fields.contact[[i]]));
        let expected =
            [i as f64 / 16.0, fields.height[[i]], fields.pressure[[i]], fields.gap[[i]], fields.displacement[[i]]];
        assert_eq!((&row[..5], row[5]), (&expected[..], contact));
    }
}
