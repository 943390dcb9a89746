//! Real files against what a peer's reader makes of them.

use crate::real_files::real_files;
use asperity::formats::Measurement;
use ndarray::Array2;
use serde_json::Value;

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
    let truth = std::fs::read_to_string(real_files().join("truth.json")).unwrap();
    let truth: Value = serde_json::from_str(&truth).unwrap();
    let measured = Measurement::read(real_files().join(name), None).unwrap_or_else(|error| panic!("{error}"));
    let deviation = match truth[name]["dim"].as_u64() {
        Some(1) => profile_deviation(name, &measured, &truth[name]),
        _ => map_deviation(name, &measured, &truth[name]),
    };
    println!("{name}: {} {:?}, deviation {deviation:.1e} of the range", measured.format, measured.height.dim());
    assert!(deviation < 1e-6, "{name}: {deviation}");
}

/// Positions and heights of a profile, over the length and the range.
fn profile_deviation(name: &str, measured: &Measurement, truth: &Value) -> f64 {
    let unit = truth["unit_in_file"].as_str().map_or(1.0, metres);
    let number = |value: &Value| value.as_f64().unwrap() * unit;
    // a head may state a unit of the positions, which the peer does not look for
    let own = measured.units.distance.filter(|_| truth["unit_in_file"].is_null());
    let place = |value: &Value| value.as_f64().unwrap() * own.unwrap_or(unit);
    let count = truth["points"].as_u64().unwrap() as usize;
    assert_eq!((measured.height.dim(), measured.is_profile), ((1, count), true), "{name}");
    // positions that are even except for rounding are so here, and some of them are not to the peer
    assert!(measured.positions.is_none() || truth["uniform"] == false, "{name}");
    let x = measured.x().unwrap();
    let even = if measured.positions.is_none() { 0.1 * x[1] } else { 0.0 };
    let told: Vec<f64> = truth["min_max_mean_rms"].as_array().unwrap().iter().map(number).collect();
    let (range, length) = (told[1] - told[0], place(&truth["length"]));
    let samples = truth["samples_x_h"].as_array().unwrap().iter().map(|it| [place(&it[0]), number(&it[1])]);
    let deviation = |[at, told]: [f64; 2]| {
        let nearest = |i: &usize, j: &usize| (x[*i] - x[0] - at).abs().total_cmp(&(x[*j] - x[0] - at).abs());
        let i = (0..count).min_by(nearest).unwrap();
        (((x[i] - x[0] - at).abs() - even).max(0.0) / length).max((measured.height[[0, i]] - told).abs() / range)
    };
    samples.map(deviation).fold(0.0, f64::max)
}

/// Files of all formats.
const NAMES: [&str; 36] = [
    "xyz-1.txt",
    "xyz-2.txt",
    "xyz-1-different-order.txt",
    "matrix-3.txt",
    "matrix-6.txt",
    "txt_example.txt",
    "gwyddion-export-english.txt",
    "gwyddion-export-german.txt",
    "xy-1.txt",
    "xy-4.txt",
    "opdx-3.txt",
    "csv-1.csv",
    "nonuniform.asc",
    "al3d-1.al3d",
    "bcrf-1.bcrf",
    "frt-2.frt",
    "10x10-one_channel_without_name.ibw",
    "spot_1-1000nm.ibw",
    "metropro-1.dat",
    "mi-1.mi",
    "nid-1.nid",
    "stp-1.stp",
    "top-1.top",
    "di-1.di",
    "di-3.di",
    "opd-1.opd",
    "opdx-3.opdx",
    "mnt-1.mnt",
    "mitutoyo_mock.xlsx",
    "hfm-1.hfm",
    "tmd-1.tmd",
    "plu-1.plu",
    "sdf-1.sdf",
    "nc-1.nc",
    "sur-2.sur",
    "x3p-2.x3p",
];

#[test]
#[ignore = "needs files of instruments"]
fn files_are_read_as_by_a_peer() {
    NAMES.into_iter().for_each(reads);
}
