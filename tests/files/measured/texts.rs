//! Small texts of numbers, and what is read of them.

use asperity::surface::Measurement;

/// A name of a file and what makes it.
pub type Writer = (&'static str, fn() -> Vec<u8>);

/// All files.
pub const ALL: &[Writer] = &[
    ("text, profile", || b"x (um);z (nm)\n0,0;1,5\n0,5;-2\n1,0;3e-1\n1,5;4\n".into()),
    ("text, matrix", || b"1 2 3 4\n5 6 NaN 8\n9 10 11 12\n".into()),
    ("text, points", || POINTS.into()),
    ("text of Gwyddion", || GWYDDION.into()),
    ("text, decimal commas", || b"1,5\t2,5\t-3e-1\t4\n5\t6,25\tNaN\t8\n9\t10\t11\t12\n1\t1,0\t1\t0\n".into()),
    ("text, commas", || b"x [nm],z [nm]\n0.0,1.5\n0.5,-2\n1.0,0.3\n1.5,---\n2.0,1\n".into()),
    ("text, exported points", || EXPORTED.into()),
    ("hfm", || HFM.into()),
];

/// A map of 3 x 2 points in any order, of which one is missing.
const POINTS: &str = "x [mm]\ty [mm]\tz [\u{b5}m]\n0.2 0.5 6\n0 0 1\n0.1 0 2\n0 0.5 4\n0.2 0 3\n";

/// A map of 4 x 4 points row by row, of which one is missing.
const EXPORTED: &str = "# x (m), y (m), height (m)\n0 0 1e-9\n1e-6 0 2e-9\n2e-6 0 1e-9\n3e-6 0 4e-9\n0 2e-6 0\n1e-6 2e-6 5e-9\n\
    2e-6 2e-6 1e-9\n3e-6 2e-6 4e-9\n0 4e-6 1e-9\n1e-6 4e-6 2e-9\n2e-6 4e-6 9e-9\n0 6e-6 1e-9\n1e-6 6e-6 2e-9\n2e-6 6e-6 1e-9\n3e-6 6e-6 7e-9\n";

/// A profile of four points, of which the third one is not valid.
const HFM: &str = "X;Y;valid\r\n[mm];[\u{b5}m];[1/0]\r\n8.001;100.5;1\r\n8.002;-7;1\r\n8.003;0;0\r\n8.004;3e1;1\r\n";

const GWYDDION: &str = "# Kanal: H\u{f6}he 2\n# Breite: 3,0 \u{b5}m\n# H\u{f6}he: 1000 nm\n# Value units: m\n1e-9 2e-9 3e-9\n4e-9 5e-9 6e-9\n";

fn read(text: &[u8]) -> Measurement {
    Measurement::from_bytes(text, None).unwrap_or_else(|error| panic!("{error}"))
}

fn is_close(found: f64, told: f64) -> bool {
    (found.is_nan() && told.is_nan()) || (found - told).abs() <= 1e-12 * told.abs()
}

/// Asserts what is read: rows of heights, and distances along y and x.
fn assert_map(measured: &Measurement, rows: &[&[f64]], spacing: Option<[f64; 2]>) {
    assert_eq!(measured.height.dim(), (rows.len(), rows[0].len()));
    let told = rows.concat();
    assert!(measured.height.iter().zip(&told).all(|(found, told)| is_close(*found, *told)), "{:?}", measured.height);
    assert_eq!(measured.spacing.is_some(), spacing.is_some());
    let pairs = measured.spacing.into_iter().flatten().zip(spacing.into_iter().flatten());
    pairs.for_each(|(found, told)| assert!(is_close(found, told), "{found}, not {told}"));
}

#[test]
fn profiles_with_units_in_their_head_are_metres() {
    let measured = read(&ALL[0].1());
    assert!(measured.is_in_metres && measured.is_profile && measured.positions.is_none());
    assert_map(&measured, &[&[1.5e-9, -2e-9, 0.3e-9, 4e-9]], Some([0.5e-6; 2]));
    let uneven = read(b"5 1\n1 2\n2 3\n");
    assert_eq!((uneven.positions, uneven.is_in_metres), (Some(vec![0.0, 1.0, 4.0]), false));
    assert_map(&Measurement { positions: None, ..read(b"5 1\n1 2\n2 3\n") }, &[&[2.0, 3.0, 1.0]], Some([2.0; 2]));
}

#[test]
fn hfm_has_points_that_are_not_valid() {
    let measured = read(HFM.as_bytes());
    assert_eq!((measured.format, measured.is_profile, measured.is_in_metres), ("HFM", true, true));
    assert!(measured.positions.is_none() && (measured.spacing.unwrap()[1] / 1e-6 - 1.0).abs() < 1e-9);
    let told = [100.5e-6, -7e-6, f64::NAN, 30e-6];
    assert!(measured.height.iter().zip(told).all(|(found, told)| is_close(*found, told)), "{:?}", measured.height);
    let reason =
        |from: &str, to: &str| Measurement::from_bytes(HFM.replace(from, to).as_bytes(), None).unwrap_err().to_string();
    assert_eq!(reason("[mm]", "[s]"), "its unit \"[s]\" is no length");
    assert_eq!(reason("-7;1", "-7;2"), "line 4 has \"8.002;-7;2\" instead of position, height and 0 or 1");
    assert_eq!(reason("-7;1", "-7"), "line 4 has \"8.002;-7\" instead of position, height and 0 or 1");
}

#[test]
fn matrices_and_points_are_maps() {
    let nan = f64::NAN;
    let matrix = read(&ALL[1].1());
    assert_map(&matrix, &[&[1.0, 2.0, 3.0, 4.0], &[5.0, 6.0, nan, 8.0], &[9.0, 10.0, 11.0, 12.0]], None);
    let points = read(&ALL[2].1());
    assert_map(&points, &[&[1e-6, 2e-6, 3e-6], &[4e-6, nan, 6e-6]], Some([0.5e-3, 0.1e-3]));
    assert!(points.is_in_metres && !points.is_profile);
}

#[test]
fn commas_part_numbers_or_stand_for_points() {
    let decimal = read(&ALL[4].1());
    assert_eq!((decimal.height[[0, 0]], decimal.height[[0, 2]], decimal.height[[1, 1]]), (1.5, -0.3, 6.25));
    assert!(decimal.height[[1, 2]].is_nan() && decimal.height.dim() == (4, 4));
    let parted = read(&ALL[5].1());
    assert_map(&parted, &[&[1.5e-9, -2e-9, 0.3e-9, f64::NAN, 1e-9]], Some([0.5e-9; 2]));
    let exported = read(&ALL[6].1());
    assert!(exported.height.dim() == (4, 4) && exported.height[[2, 3]].is_nan() && exported.is_in_metres);
}

#[test]
fn exports_of_gwyddion_say_their_size_in_any_language() {
    let measured = read(&ALL[3].1());
    assert_map(&measured, &[&[1e-9, 2e-9, 3e-9], &[4e-9, 5e-9, 6e-9]], Some([0.5e-6, 1e-6]));
    assert_eq!((measured.channel.as_str(), measured.is_in_metres), ("H\u{f6}he 2", true));
}

#[test]
fn texts_that_are_no_surface_say_why() {
    let reason = |text: &[u8]| Measurement::from_bytes(text, None).unwrap_err().to_string();
    assert!(reason(b"0 0 1\n1 0 2\n0.3 0.7 3\n").starts_with("it has three columns, but they are not x, y and height"));
    assert!(reason(b"0 1\n1 2\n1 3\n").starts_with("it contains two heights at the position 1.0"));
    assert!(reason(b"0 1\nnan 2\n1 3\n").starts_with("it contains the position NaN"));
    assert!(reason(b";\n;;\n").contains("it begins with \";\""));
    assert!(reason(b"nothing\n").contains("nor a text of numbers"));
}
