//! Small files of every format, whose heights, distances, voids and header are known.

use super::binaries::{self, POINTS, VOID, height, nanoscope, opd, opdx, plu, sdf, tmd, vk4};
use asperity::formats::Measurement;

/// Distances along y and x that the files of most formats state, in metres.
pub const SPACING: [f64; 2] = [3e-6, 2e-6];

pub fn read(file: &[u8], channel: Option<&str>) -> Measurement {
    Measurement::from_bytes(file, channel).unwrap_or_else(|error| panic!("{error}"))
}

/// What is wrong with a file.
pub fn reason(file: &[u8]) -> String {
    Measurement::from_bytes(file, None).unwrap_err().to_string()
}

pub fn is_close(found: f64, told: f64) -> bool {
    (found - told).abs() <= 1e-6 * told.abs()
}

/// Asserts that a map in metres has its heights in this unit, its void and its distances.
pub fn assert_map(measured: &Measurement, unit: f64, spacing: [f64; 2], has_void: bool) {
    let [nx, ny] = POINTS;
    assert_eq!(measured.height.dim(), (ny, nx));
    assert!(measured.is_in_metres && !measured.is_profile && measured.positions.is_none());
    for ((iy, ix), found) in measured.height.indexed_iter() {
        let told = f64::from(height(ix, iy)) * unit;
        let is_void = has_void && [ix, iy] == VOID;
        assert!(if is_void { found.is_nan() } else { is_close(*found, told) }, "{found} at {ix}, {iy}, not {told}");
    }
    let found = measured.spacing.unwrap();
    assert!(found.iter().zip(spacing).all(|(found, told)| is_close(*found, told)), "{found:?}, not {spacing:?}");
}

/// Asserts that the header says something.
pub fn assert_says(measured: &Measurement, name: &str, value: &str) {
    let told: Vec<&str> = measured.header.iter().filter(|it| it.0 == name).map(|it| it.1.as_str()).collect();
    assert_eq!(told, [value], "{name} in {:?}", measured.header);
}

/// A file with other bytes for these, which are in it once.
pub fn changed(file: &[u8], from: &[u8], to: &[u8]) -> Vec<u8> {
    let places: Vec<usize> = (0..file.len()).filter(|at| file[*at..].starts_with(from)).collect();
    let [place] = places[..] else { panic!("{from:?} is at {places:?}") };
    [&file[..place], to, &file[place + from.len()..]].concat()
}

#[test]
fn al3d() {
    let file = binaries::al3d::file();
    let measured = read(&file, None);
    assert_eq!((measured.format, measured.channel.as_str()), ("Alicona AL3D", "depth"));
    assert_map(&measured, 1.0, SPACING, true);
    assert_says(&measured, "Comment", "steel");
    assert_says(&measured, "InvalidPixelValue", "3.0000000281e+15");
    let early = changed(&file, b"689\0", b"600\0");
    assert_eq!(reason(&early), "its depth image cannot be at byte 600, where the header is");
    assert!(
        reason(&file[..file.len() - 10]).starts_with("it contains 18 heights"),
        "{}",
        reason(&file[..file.len() - 10])
    );
    let many =
        changed(&file, &[&b"TagCount"[..], &[0; 12], b"6\0"].concat(), &[&b"TagCount"[..], &[0; 12], b"66"].concat());
    assert!(reason(&many).starts_with("it states 66 tags"), "{}", reason(&many));
}

#[test]
fn nanoscope_of_two_bytes() {
    let file = nanoscope::file();
    let measured = read(&file, None);
    assert_eq!(measured.format, "Nanoscope");
    assert_eq!(measured.channels, ["Height Sensor", "Height", "Height (4)"]);
    assert_eq!(measured.channel, "Height Sensor");
    let spacing = [3e-6, 2e-6];
    assert_map(&measured, 6.5536 * 400e-9 / 65536.0, spacing, false);
    assert_map(&read(&file, Some("Height")), 65.536e-3 * 20e-9 / 65536.0, spacing, false);
    assert_map(&read(&file, Some("4")), 131.072e-9 / 65536.0, spacing, false);
    for (name, value) in [("Microscope", "M"), ("Scan Rate", "1.5"), ("Line Direction", "Retrace")] {
        assert_says(&measured, name, value);
    }
    assert!(!measured.header.iter().any(|it| it.0 == "Junk"));
    let phase = Measurement::from_bytes(&file, Some("Phase")).unwrap_err().to_string();
    assert!(phase.starts_with("its channel \"Phase\" contains no heights"), "{phase}");
    for other in ["Deflection", "LogModulus"] {
        assert!(Measurement::from_bytes(&file, Some(other)).is_err_and(|it| it.to_string().contains("no heights")));
    }
}

#[test]
fn nanoscope_of_scans_that_are_not_square() {
    let metres = |[height, width]: [f64; 2]| [height / POINTS[1] as f64 * 1e-6, width / POINTS[0] as f64 * 1e-6];
    let ratio = "\\Aspect Ratio: 2:1";
    let cases = [
        (format!("\\Scan Size: 10 10 ~m\n{ratio}"), String::new(), [5.0, 10.0]),
        ("\\Scan Size: 10 ~m".into(), "\\Aspect Ratio: 2.5\n".into(), [4.0, 10.0]),
        (format!("\\Scan Size: 10 12 ~m\n{ratio}"), String::new(), [12.0, 10.0]),
        ("\\Scan Size: 10 10 ~m".into(), "\\Slow Axis Size: 6000 nm\n".into(), [6.0, 10.0]),
        (format!("\\Scan Size: 10 10 ~m\n{ratio}"), "\\Lines: 8\n\\Slow Axis Size: 6 ~m\n".into(), [3.0, 10.0]),
        ("\\Scan Size: 10 10 ~m".into(), "\\Aspect Ratio: 1:1\n".into(), [10.0, 10.0]),
    ];
    for (image, scan, size) in cases {
        let unit = 6.5536 * 400e-9 / 65536.0;
        assert_map(&read(&nanoscope::sized(&image, &scan), None), unit, metres(size), false);
    }
    // a number alone is the ratio of width and height or its inverse, whichever makes pixels more nearly square
    let [nx, ny] = POINTS.map(|count| count as f64);
    let inverse = format!("\\Scan Size: 10 10 ~m\n\\Aspect Ratio: {}", ny / nx);
    let square = read(&nanoscope::sized(&inverse, ""), None).spacing.unwrap();
    assert!(is_close(square[0], square[1]) && is_close(square[1], 10e-6 / nx), "{square:?}");
    let empty = read(&nanoscope::sized("\\Scan Size: 0 0 ~m", ""), None);
    assert!(empty.spacing.is_none() && empty.warnings[0].to_string().contains("the size along x and y is zero"));
    let wrong = nanoscope::sized("\\Scan Size: 10 ~m", "\\Aspect Ratio: 0:1\n");
    assert_eq!(reason(&wrong), "its aspect ratio is \"0:1\"");
}

#[test]
fn nanoscope_of_four_bytes() {
    let unit = 6.5536 * 400e-9;
    assert_map(&read(&nanoscope::long(), None), unit / 65536.0, SPACING, false);
    assert_map(&read(&nanoscope::full(), None), unit / 65536.0 / 65536.0, SPACING, false);
}

#[test]
fn nanoscope_that_is_refused() {
    let file = nanoscope::file();
    let text = changed(&file, b"\\*File list\r", b"?*File list\r");
    assert_eq!(reason(&text), "its images are text: export them as binary data");
    let old = String::from_utf8_lossy(&file).replace("@2:Z scale", "Z scale");
    assert_eq!(reason(old.as_bytes()), "its images have no @2:Z scale: the file is older than version 4.3");
}

#[test]
fn opd_of_singles_and_integers() {
    let spacing = [0.375e-3, 0.25e-3];
    let measured = read(&opd::file(), None);
    assert_eq!((measured.format, measured.channel.as_str()), ("Wyko OPD", "Raw"));
    assert_map(&measured, 500e-9, spacing, true);
    for (name, value) in [("Title", "steel"), ("MeasMode", "PSI"), ("Wavelength", "500")] {
        assert_says(&measured, name, value);
    }
    let measured = read(&opd::integers(), None);
    assert_eq!(measured.channel, "RAW_DATA");
    assert_map(&measured, 50e-9, spacing, true);
}

#[test]
fn opd_that_is_refused() {
    let file = opd::file();
    let image = Measurement::from_bytes(&file, Some("Image")).unwrap_err().to_string();
    assert_eq!(image, "its channel \"Image\" contains no heights: choose one of \"Raw\"");
    assert_eq!(reason(&changed(&file, b"Wavelength", b"Wavelenght")), "it has no Wavelength");
    let flat = changed(&file, &0.25_f32.to_le_bytes(), &0_f32.to_le_bytes());
    assert_eq!(reason(&flat), "its Pixel_size has the invalid value 0.0");
    assert!(reason(&file[..file.len() - 1]).contains("incomplete"), "{}", reason(&file[..file.len() - 1]));
}

#[test]
fn opdx_of_maps() {
    let file = opdx::file();
    let measured = read(&file, None);
    assert_eq!((measured.format, measured.channel.as_str()), ("Dektak OPDx", "Raw"));
    assert_eq!(measured.channels, ["Raw", "Analyzed"]);
    assert_map(&measured, 2e-9, SPACING, true);
    assert_map(&read(&file, Some("Analyzed")), 1e-9, SPACING, true);
    for (name, value) in [("Settings/InstrumentName", "Dektak"), ("Settings/StylusForce", "3 mg")] {
        assert_says(&measured, name, value);
    }
    for (name, fault) in [("Broken", "has no Matrix: choose one of"), ("Image", "contains no heights: choose one of")] {
        let error = Measurement::from_bytes(&file, Some(name)).unwrap_err().to_string();
        assert!(error.contains(&format!("{fault} \"Raw\", \"Analyzed\"")), "{error}");
    }
}

#[test]
fn opdx_of_profiles() {
    let heights: Vec<f64> = (0..POINTS[0]).map(|ix| f64::from(height(ix, 0)) * 2e-9).collect();
    let even = read(&opdx::profile(), None);
    let uneven = read(&opdx::of_positions(&[0.0, 1.0, 4.0, 6.0, 8.0]), None);
    let unknown = read(&opdx::of_positions(&[]), None);
    for measured in [&even, &uneven, &unknown] {
        assert!(measured.is_profile && measured.is_in_metres && is_close(measured.spacing.unwrap()[1], 2e-6));
        assert!(measured.height.iter().zip(&heights).all(|(found, told)| is_close(*found, *told)));
    }
    assert!(even.positions.is_none() && unknown.positions.is_none());
    assert!(is_close(uneven.positions.unwrap()[1], 1e-6));
}

#[test]
fn opdx_that_is_refused() {
    let file = opdx::profile();
    assert!(reason(&file[..file.len() / 2]).contains("incomplete"), "{}", reason(&file[..file.len() / 2]));
    assert_eq!(
        reason(&changed(&file, b"\x0b\x05\0", b"\x3b\x05\0")),
        "it has an item of the unknown type 59 at byte 202"
    );
    let nested = (0..100).fold(Vec::new(), |inner, _| opdx::container("a", &[inner]));
    let nested = [b"VCA DATA\x01\x00\x00\x55".to_vec(), nested].concat();
    assert_eq!(reason(&nested), "its containers are nested more than 32 times");
}

#[test]
fn tmd_of_any_comment() {
    for comment in ["steel\r\n", "", "Created by TrueMap v6\r\n"] {
        let measured = read(&tmd::written(" v2.0", comment), None);
        assert_eq!(measured.format, "TrueMap TMD");
        assert_map(&measured, 1e-3, SPACING, true);
        assert_says(&measured, "Y0", "0.25 mm");
        assert_eq!(measured.header.iter().any(|it| it.0 == "Comment"), !comment.is_empty());
    }
    assert_eq!(reason(&tmd::written(" v3.0", "")), "it is of the version \"v3.0\": only version v2.0 is read");
    let file = tmd::file();
    assert!(reason(&file[..file.len() - 1]).contains("has 79 bytes for them"), "{}", reason(&file[..file.len() - 1]));
}

#[test]
fn vk4_of_every_size_of_numbers() {
    for size in [1, 2, 4] {
        let mut measured = read(&vk4::of_size(size), None);
        assert_eq!((measured.format, measured.channels.as_slice()), ("Keyence VK4", &["height".to_owned()][..]));
        assert_says(&measured, "Date", "2026-11-22 03:04:05");
        measured.height -= f64::from(vk4::SHIFT) * 1e-9;
        measured.height.iter_mut().filter(|it| it.abs() < 1e-15).for_each(|it| *it = 0.0);
        assert_map(&measured, 1e-9, SPACING, false);
    }
    let file = vk4::file();
    assert!(reason(&file[..file.len() - 1]).contains("has 79 bytes for them"), "{}", reason(&file[..file.len() - 1]));
    assert_eq!(reason(&[b"VK6", &file[..]].concat()), "it is of the version VK6 or VK7: save it as VK4");
}

#[test]
fn plu_of_layers_and_profile() {
    let file = plu::file();
    let measured = read(&file, Some("layer 2"));
    assert_eq!((measured.format, measured.channels.len()), ("Sensofar PLU", 2));
    assert_map(&measured, 1e-6, SPACING, true);
    for (name, value) in [("Date", "Fri Mar 10 16:35:59 2023"), ("Comment", "steel"), ("Y0", "20 µm")] {
        assert_says(&measured, name, value);
    }
    assert!(read(&file, None).height.iter().all(|height| *height == 0.0));
    let measured = read(&plu::profile(), None);
    assert!(measured.is_profile && measured.is_in_metres);
    let heights: Vec<f64> = (0..POINTS[0]).map(|ix| f64::from(height(ix, 0)) * 1e-6).collect();
    assert!(measured.height.iter().zip(heights).all(|(found, told)| is_close(*found, told)));
    assert!(is_close(measured.spacing.unwrap()[1], 2e-6));
}

#[test]
fn plu_that_is_refused() {
    let mut file = plu::file();
    file[428] = 7;
    assert_eq!(reason(&file), "it is a measurement of type 7, neither a profile nor a topography");
    file[428] = 1;
    assert_eq!(reason(&file), "it is a profile, but states 4 rows");
    file[490] = 7;
    assert_eq!(reason(&file), "its format is not known");
}

#[test]
fn sdf_of_text() {
    for kind in ["0", "5", "7"] {
        let measured = read(&sdf::text("ISO-1.0", kind, "BAD", "\r\n"), None);
        assert_map(&measured, 1e-9, SPACING, true);
        for (name, value) in [("Version", "aISO-1.0"), ("ManufacID", "steel"), ("Trailer", "Operator = Mr. Jones")] {
            assert_says(&measured, name, value);
        }
    }
    let voids = [("5", "32767"), ("INTEGER", "32767"), ("LONGINT", "2147483647"), ("float", "3.4e38"), ("0", "255")];
    for (kind, void) in voids {
        for end in ["\r", "\n", " ; remark\n"] {
            assert_map(&read(&sdf::text("BCR-1.0", kind, void, end), None), 1e-9, SPACING, true);
        }
    }
    assert_map(&read(&sdf::text("NPL-V1.0", "7", "BAD", "\n"), None), 1e-9, SPACING, true);
}

#[test]
fn sdf_of_every_type_of_numbers() {
    let signed = |bcr: bool| {
        let of = |least: f64, most: f64| if bcr { most } else { least };
        vec![
            (3, sdf::numbers(f32::from, of(f32::MIN.into(), 3.4e38) as f32, f32::to_le_bytes)),
            (4, sdf::numbers(i8::from, of(-128.0, 127.0) as i8, i8::to_le_bytes)),
            (5, sdf::numbers(i16::from, of(-32768.0, 32767.0) as i16, i16::to_le_bytes)),
            (6, sdf::numbers(i32::from, of(i32::MIN.into(), i32::MAX.into()) as i32, i32::to_le_bytes)),
            (7, sdf::numbers(f64::from, of(f64::MIN, 1.7e308), f64::to_le_bytes)),
        ]
    };
    for dialect in ["ISO-1.0", "ISO-2.0", "BCR-1.0"] {
        for (kind, heights) in signed(dialect == "BCR-1.0") {
            let measured = read(&sdf::fixed(dialect, kind, heights), None);
            assert_map(&measured, 1e-9, SPACING, true);
            assert_says(&measured, "ManufacID", "steel");
            assert_says(&measured, "Trailer", "Mr. Jones");
        }
    }
}

#[test]
fn sdf_of_unsigned_numbers() {
    let shifted = |height: i8| (i16::from(height) + 20) as u8;
    let all = [
        (0, sdf::numbers(shifted, u8::MAX, u8::to_le_bytes)),
        (1, sdf::numbers(|it| shifted(it).into(), u16::MAX, u16::to_le_bytes)),
        (2, sdf::numbers(|it| shifted(it).into(), u32::MAX, u32::to_le_bytes)),
    ];
    for (kind, heights) in all {
        for dialect in ["ISO-1.0", "BCR-1.0"] {
            let mut measured = read(&sdf::fixed(dialect, kind, heights.clone()), None);
            measured.height -= 20e-9;
            measured.height.iter_mut().filter(|it| it.abs() < 1e-15).for_each(|it| *it = 0.0);
            assert_map(&measured, 1e-9, SPACING, true);
        }
    }
}

#[test]
fn sdf_with_eight_bytes_too_many() {
    let heights = sdf::numbers(i32::from, i32::MIN, i32::to_le_bytes);
    let file = sdf::fixed("ISO-1.0", 6, [vec![5, 0, 0, 0, 1, 0, 0, 0], heights].concat());
    assert_map(&read(&file[..file.len() - "Mr. Jones".len()], None), 1e-9, SPACING, true);
}

#[test]
fn sdf_of_a_profile_has_no_distance_of_rows() {
    let text = String::from_utf8(sdf::text("ISO-1.0", "7", "BAD", "\n")).unwrap();
    let text = text.replace("NumProfiles = 4", "NumProfiles = 1").replace("NumPoints = 5", "NumPoints = 20");
    let measured = read(text.replace("3.0e-006", "0").as_bytes(), None);
    assert!(measured.is_profile && is_close(measured.spacing.unwrap()[1], 2e-6));
}

#[test]
fn sdf_that_is_refused() {
    let file = sdf::file();
    assert_eq!(
        reason(&changed(&file, b"Compression = 0", b"Compression = 1")),
        "it has a compression of type 1: save it without compression"
    );
    assert_eq!(
        reason(&changed(&file, b"CheckType = 0", b"CheckType = 1")),
        "it has a check sum of type 1: save it without one"
    );
    assert_eq!(reason(&changed(&file, b"BAD", b"BUD")), "its heights contain \"BUD\"");
    assert!(reason(&changed(&file, b"1.0e-9", b"0")).contains("a unit of its heights is 0.0 metres"));
    assert!(reason(&changed(&file, b"NumPoints = 5", b"NumPoints = 6")).starts_with("it contains 20 heights"));
    let binary = sdf::fixed("ISO-1.0", 9, vec![0; 20]);
    assert_eq!(reason(&binary), "its heights are of the type 9, which ISO 25178-71 does not know");
}
