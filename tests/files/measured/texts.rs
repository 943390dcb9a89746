//! Small texts of numbers, and what is read of them.

use asperity::formats::Measurement;

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
    ("text of two bytes a letter", || utf_16("x in \u{b5}m;z in nm\n0;1\n1;2\n2;4\n3;1\n", u16::to_le_bytes)),
    ("text of Wyko", || WYKO.into()),
    ("text, validity", || VALIDITY.into()),
];

/// Three columns of two points each, from the last row on.
const WYKO: &str = "Wyko ASCII Data File Format 0\t0\t1\nX Size\t3\nY Size\t2\nBlock Name\tType\tLength\tValue\nWavelength\t7\t4\t500\n\
    Aspect\t7\t4\t1.5\nPixel_size\t7\t4\t0.002\nMult\t6\t2\t2\nRAW_DATA\t3\t24\t\n4\t1\nBad\t2\n6\t3\n";

/// Positions and heights, of which one is not valid.
const VALIDITY: &str = "X;Y;valid\n[mm];[um];[1/0]\n8.0;1;1\n8.5;2;0\n9.0;3;1\n9.5;5;1\n";

/// A text in UTF-16 behind the mark of the order of its bytes.
fn utf_16(text: &str, bytes: fn(u16) -> [u8; 2]) -> Vec<u8> {
    ['\u{feff}'].into_iter().chain(text.chars()).flat_map(|letter| bytes(letter as u16)).collect()
}

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
    let falling = read(b"5 1\n2 3\n1 2\n");
    assert_eq!((falling.positions, falling.is_in_metres), (Some(vec![0.0, 1.0, 4.0]), false));
    assert_map(&Measurement { positions: None, ..read(b"5 1\n2 3\n1 2\n") }, &[&[2.0, 3.0, 1.0]], Some([2.0; 2]));
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
    assert_eq!(reason(b""), "it is empty");
    assert!(reason(b" \n\n").starts_with("it is empty"));
    assert!(reason(b";\n;;\n").contains("it begins with \";\""));
    assert!(reason(b"nothing\n").contains("nor a text of numbers"));
}

#[test]
fn lines_that_turn_back_are_refused_and_say_where() {
    let reason = |text: &[u8]| Measurement::from_bytes(text, None).unwrap_err().to_string();
    let turned = "its positions turn back at point";
    assert!(reason(b"0 1\n1 2\n2 3\n2 3\n1 2\n").starts_with(&format!("{turned} 5, from 2.0 to 1.0")));
    assert!(reason(b"3 1\n2 2\n2.5 3\n1 2\n").starts_with(&format!("{turned} 3, from 2.0 to 2.5")));
    assert!(reason(b"0 5 1\n1 5 2\n2 5 1\n1.5 5 1\n").starts_with(&format!("{turned} 4")));
    let even = read(b"3 1\n2 2\n1 3\n0 7\n");
    assert_map(&even, &[&[7.0, 3.0, 2.0, 1.0]], Some([1.0; 2]));
}

#[test]
fn heads_may_hold_numbers() {
    let rows = "0 1\n1 2\n2 4\n3 1\n";
    let heads = [
        "Points: 4\n",
        "ID,0\n",
        "Speed 0.5\nDate 2024\n",
        "32\nX Z\n",
        "Size\n0.5\n---\n",
        "4\n7.5\n",
        "None\n",
        "Date 2024-01-02\n4\n",
    ];
    for head in heads {
        let measured = read(format!("{head}{rows}").as_bytes());
        assert_map(&measured, &[&[1.0, 2.0, 4.0, 1.0]], Some([1.0; 2]));
    }
    let told = read(format!("3 4\nX Z\n{rows}").as_bytes());
    assert!(told.height.len() == 4 && told.warnings[0].to_string().contains("a row of numbers stands above"));
    let repeated = read(b"x z\n0 1\n1 2\n2 3\n3 4\nx z\n4 5\n");
    assert_map(&repeated, &[&[1.0, 2.0, 3.0, 4.0, 5.0]], Some([1.0; 2]));
    let reason = |text: &[u8]| Measurement::from_bytes(text, None).unwrap_err().to_string();
    assert!(reason(b"0 1\n1 x\n2 3\n3 4\n4 5\n5 6\n").starts_with("line 2 has \"x\""));
    assert!(reason(b"0 1\n1 2\n2 3\n3 4\nend 5\n").starts_with("line 5 has \"end\""));
}

#[test]
fn voids_have_many_names() {
    let words = ["Bad", "bad", "n/a", "NaN", "--", "null", "None", "#NV", "1.#QNAN", "-1.#IND00", "*", "?"];
    for word in words {
        let measured = read(format!("{word} 2 3 4\n5 6 7 8\n9 1 {word} 2\n3 4 5 6\n").as_bytes());
        assert_eq!(measured.height.dim(), (4, 4), "{word}");
        let voids: Vec<_> = measured.height.indexed_iter().filter(|it| it.1.is_nan()).map(|it| it.0).collect();
        assert_eq!(voids, [(0, 0), (2, 2)], "{word}");
    }
    assert!(read(b"1,5\t1,#QNAN\n2,5\t3\n").height.iter().any(|height| height.is_nan()));
}

#[test]
fn texts_of_two_bytes_a_letter_are_read_in_both_orders() {
    let text = "x (um),z (um)\n0,0.5\n1,0.25\n2,1.5\n";
    for file in [utf_16(text, u16::to_le_bytes), utf_16(text, u16::to_be_bytes)] {
        let measured = read(&file);
        assert_map(&measured, &[&[0.5e-6, 0.25e-6, 1.5e-6]], Some([1e-6; 2]));
        assert!(measured.is_in_metres);
    }
}

#[test]
fn units_stand_in_brackets_or_behind_names() {
    let heads =
        ["Lateral um,Raw nm", "x in \u{b5}m,z in nm", "X(um) Z(nm)", "x in um z in nm", "x [um]\tz [nm]", "um nm"];
    for head in heads {
        let measured = read(format!("{head}\n0,1.5\n1,2.5\n2,4.5\n").as_bytes());
        assert_map(&measured, &[&[1.5e-9, 2.5e-9, 4.5e-9]], Some([1e-6; 2]));
        assert!(measured.is_in_metres, "{head}");
    }
    assert!(!read(b"Scan Type,Standard\n0,1.5\n1,2.5\n2,4.5\n").is_in_metres);
    let points = read(b"x (mm), y (um), z (nm)\n0 0 1\n1 0 2\n0 1 3\n1 1 4\n");
    assert_map(&points, &[&[1e-9, 2e-9], &[3e-9, 4e-9]], Some([1e-6, 1e-3]));
    assert!(!read(b"x (mm), y (ells), z (nm)\n0 0 1\n1 0 2\n0 1 3\n1 1 4\n").is_in_metres);
}

#[test]
fn columns_beside_positions_and_heights_are_known() {
    let validity = read(VALIDITY.as_bytes());
    assert!(validity.is_in_metres && validity.is_profile);
    assert_map(&validity, &[&[1e-6, f64::NAN, 3e-6, 5e-6]], Some([0.5e-3; 2]));
    let counted = read(b"index, x in um, y in um\n0,5.0,1.5\n1,5.5,2.5\n2,6.0,3.5\n3,6.5,4.5\n");
    assert_map(&counted, &[&[1.5e-6, 2.5e-6, 3.5e-6, 4.5e-6]], Some([0.5e-6; 2]));
    let line = read(b"0 7 1\n1 7 2\n2 7 4\n3 7 1\n");
    assert!(line.is_profile);
    assert_map(&line, &[&[1.0, 2.0, 4.0, 1.0]], Some([1.0; 2]));
    assert_map(&read(b"7 0 1\n7 1 2\n7 2 4\n7 3 1\n"), &[&[1.0, 2.0, 4.0, 1.0]], Some([1.0; 2]));
    let points = read(b"1 0 0 1\n2 1 0 2\n3 0 1 3\n4 1 1 4\n");
    assert_map(&points, &[&[1.0, 2.0], &[3.0, 4.0]], Some([1.0; 2]));
}

#[test]
fn texts_of_wyko_are_metres() {
    let measured = read(WYKO.as_bytes());
    assert_eq!((measured.format, measured.is_in_metres), ("Wyko ASCII", true));
    let unit = 250e-9;
    assert_map(&measured, &[&[unit, 2.0 * unit, 3.0 * unit], &[4.0 * unit, f64::NAN, 6.0 * unit]], Some([3e-6, 2e-6]));
    let real = read(WYKO.replace("0\t0\t1", "0\t1\t1").as_bytes());
    assert!(is_close(real.height[[1, 2]], 6e-9));
    let reason = |text: String| Measurement::from_bytes(text.as_bytes(), None).unwrap_err().to_string();
    assert_eq!(reason(WYKO.replace("Pixel_size", "Pixel size")), "it has no Pixel_size");
    assert!(reason(WYKO.replace("6\t3\n", "")).starts_with("it states 3 columns of 2 heights, but has 2 lines of 2"));
}
