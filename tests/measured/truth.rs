//! Real files against what a peer's reader makes of them.

use asperity::surface::Measurement;
use ndarray::Array2;
use serde_json::Value;
use std::io::Write;
use std::path::Path;

/// Real files and what a peer's reader makes of them, where they are.
const FILES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/surfaces");

/// Metres in a unit of the peer's reader.
fn metres(unit: &str) -> f64 {
    match unit {
        "m" => 1.0,
        "mm" => 1e-3,
        "µm" | "μm" => 1e-6,
        "nm" => 1e-9,
        _ => panic!("{unit} is no unit"),
    }
}

/// The largest deviation of heights of a map from what the peer reads, over their range, after all else was compared.
fn map_deviation(name: &str, measured: &Measurement, truth: &Value) -> f64 {
    let number = |value: &Value| value.as_f64().unwrap();
    let unit = truth["unit_in_file"].as_str().map(metres);
    assert_eq!(measured.is_in_metres, unit.is_some(), "{name}");
    let unit = unit.unwrap_or(1.0);
    let points = [0, 1].map(|axis| truth["points_x_y"][axis].as_u64().unwrap() as usize);
    let height: &Array2<f64> = &measured.height;
    assert_eq!(height.dim(), (points[1], points[0]), "{name}");
    if let Some([dy, dx]) = measured.spacing {
        for (axis, spacing) in [dx, dy].into_iter().enumerate() {
            let (size, told) = (spacing * points[axis] as f64, number(&truth["size_x_y"][axis]) * unit);
            assert!((size / told - 1.0).abs() < 1e-6, "{name}: size {size} along {axis}, not {told}");
        }
    }
    let voids = height.iter().filter(|h| h.is_nan()).count();
    assert_eq!(voids as u64, truth["void_points"].as_u64().unwrap(), "{name}");
    let told: Vec<f64> = truth["min_max_mean_rms"].as_array().unwrap().iter().map(|it| number(it) * unit).collect();
    let range = told[1] - told[0];
    let known = || height.iter().filter(|h| !h.is_nan());
    let mean = known().sum::<f64>() / known().count() as f64;
    let rms = (known().map(|h| (h - mean).powi(2)).sum::<f64>() / known().count() as f64).sqrt();
    let [low, high] =
        [known().copied().fold(f64::INFINITY, f64::min), known().copied().fold(f64::NEG_INFINITY, f64::max)];
    let all = [low, high, mean, rms].into_iter().zip(told);
    let nodes = truth["heights_ix_iy"].as_array().unwrap().iter().map(|node| {
        let [ix, iy] = [0, 1].map(|i| node[i].as_u64().unwrap() as usize);
        (height[[iy, ix]], node[2].as_f64().map_or(f64::NAN, |told| told * unit))
    });
    let deviation = |(found, told): (f64, f64)| match (found.is_nan(), told.is_nan()) {
        (true, true) => 0.0,
        (false, false) => (found - told).abs() / range,
        _ => f64::INFINITY,
    };
    all.chain(nodes).map(deviation).fold(0.0, f64::max)
}

/// Reads a file and compares it with what the peer reads.
fn reads(name: &str) {
    let path = Path::new(FILES).join(name);
    let Ok(truth) = std::fs::read_to_string(Path::new(FILES).join("truth.json")) else {
        writeln!(std::io::stderr(), "skipped: {name} is not here").ok();
        return;
    };
    let truth: Value = serde_json::from_str(&truth).unwrap();
    let measured = Measurement::read(&path, None).unwrap_or_else(|error| panic!("{error}"));
    let deviation = map_deviation(name, &measured, &truth[name]);
    println!("{name}: {} {:?}, deviation {deviation:.1e} of the range", measured.format, measured.height.dim());
    assert!(deviation < 1e-6, "{name}: {deviation}");
}

#[test]
fn al3d() {
    reads("al3d-1.al3d");
}

#[test]
fn nanoscope() {
    reads("di-1.di");
    reads("di-3.di");
}

#[test]
fn opd() {
    reads("opd-1.opd");
}

#[test]
fn plu() {
    reads("plu-1.plu");
}

#[test]
fn sdf() {
    reads("sdf-1.sdf");
}
