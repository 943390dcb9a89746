//! Small files of microscopes and profilometers with parts, layers and images, whose content is known.

use super::binaries::{POINTS, bcr, frt, height, ibw, jpk, metropro, mi, nid, wsxm};
use super::made::{SPACING, assert_map, assert_says, changed, is_close, read, reason};
use asperity::formats::Measurement;

/// A file with other bytes of the same number wherever these are.
fn changed_everywhere(file: &[u8], from: &[u8], to: &[u8]) -> Vec<u8> {
    let mut file = file.to_vec();
    let places: Vec<usize> = (0..file.len()).filter(|at| file[*at..].starts_with(from)).collect();
    places.into_iter().for_each(|at| file[at..at + to.len()].copy_from_slice(to));
    file
}

#[test]
fn bcr_of_integers_and_singles() {
    let measured = read(&bcr::file(), None);
    assert_eq!((measured.format, measured.channel.as_str()), ("BCR-STM (BCR, BCRF)", "height"));
    assert_map(&measured, 1e-9, SPACING, true);
    assert_says(&measured, "fileformat", "bcrstm");
    assert_says(&measured, "yunit", "um");
    assert_map(&read(&bcr::wide(), None), 1e-9, SPACING, true);
}

#[test]
fn bcr_that_is_refused() {
    let file = bcr::file();
    assert_eq!(
        reason(&changed(&file, b"xpixels = 5", b"xpixels = 6")),
        "it states 4 rows of 6 points, but has 40 bytes for them"
    );
    let wide = bcr::wide();
    let unit: Vec<u8> = b"zunit = pm".iter().flat_map(|it| [*it, 0]).collect();
    let volts: Vec<u8> = b"zunit = kV".iter().flat_map(|it| [*it, 0]).collect();
    assert_eq!(reason(&changed(&wide, &unit, &volts)), "its heights are in \"kV\", which is no length");
}

#[test]
fn frt_of_points_and_of_images() {
    for (file, channel) in [(frt::file(), "topography"), (frt::images(), "topography, sensor below")] {
        let mut measured = read(&file, None);
        assert_eq!((measured.format, measured.channel.as_str()), ("FRT MicroProf", channel));
        assert_eq!(measured.channels.len(), 1);
        assert_says(&measured, "Description", "steel");
        measured.height.mapv_inplace(|it| ((it / 1e-9).round() - 100.0) * 1e-9);
        assert_map(&measured, 1e-9, SPACING, true);
    }
    let images = Measurement::from_bytes(&frt::images(), Some("1")).unwrap_err().to_string();
    assert!(images.starts_with("its channel \"intensity\" contains no heights"), "{images}");
}

#[test]
fn frt_that_is_refused() {
    let file = frt::file();
    assert_eq!(reason(&changed(&file, b"RV1.00", b"RV9.00")), "it has the version \"9.00\", neither 1.00 nor 1.01");
    assert!(reason(&file[..file.len() - 1]).contains("40 bytes are missing"), "{}", reason(&file[..file.len() - 1]));
    let scale = 1e-9_f64.to_le_bytes();
    let flat = changed(&file, &scale, &0_f64.to_le_bytes());
    assert_eq!(reason(&flat), "it states that a step of its heights is 0.0 metres");
}

#[test]
fn ibw_of_layers() {
    let file = ibw::file();
    let measured = read(&file, None);
    assert_eq!(measured.format, "Igor binary wave (IBW)");
    assert_eq!(measured.channels, ["HeightTrace", "HeightTrace (4)"]);
    assert_map(&measured, 2.0, SPACING, true);
    assert_says(&measured, "Wave", "steel");
    assert_says(&measured, "ImagingMode", "AC Mode");
    assert_map(&read(&file, Some("4")), 4.0, SPACING, true);
    assert!(Measurement::from_bytes(&file, Some("AmplitudeTrace")).is_err());
    let alone = read(&ibw::alone(), None);
    assert_eq!(alone.channel, "steel");
    assert_map(&alone, 1e-6, SPACING, true);
}

#[test]
fn ibw_of_a_profile() {
    let measured = read(&ibw::profile(), None);
    assert!(measured.is_profile && measured.is_in_metres && measured.channel == "steel");
    let told = (0..POINTS[0]).map(|ix| f64::from(height(ix, 0)) * 1e-9);
    assert!(measured.height.iter().zip(told).all(|(found, told)| is_close(*found, told)));
    assert!(is_close(measured.spacing.unwrap()[1], 2e-6));
    assert_says(&measured, "Place", "here");
}

#[test]
fn ibw_that_is_refused() {
    let mut file = ibw::profile();
    file[16] = 5;
    assert_eq!(reason(&file), "its format is not known", "the check sum does not hold");
    assert_eq!(reason(&ibw::signed(file)), "its wave consists of complex numbers: save their real parts");
    let cut = ibw::file();
    assert!(reason(&cut[..cut.len() - 30]).contains("incomplete"), "{}", reason(&cut[..cut.len() - 30]));
    let curves = changed(&ibw::file(), b"0506 MFP3D", b"0506 Force");
    assert_eq!(reason(&curves), "it contains force curves, not a map");
}

#[test]
fn jpk_of_channels() {
    let file = jpk::file();
    let measured = read(&file, None);
    assert_eq!((measured.format, measured.channel.as_str()), ("JPK image scan", "Height (retrace)"));
    assert_eq!(measured.channels.len(), 1);
    assert_map(&measured, 1e-9, SPACING, false);
    assert_says(&measured, "Comment", "steel");
    let deflection = Measurement::from_bytes(&file, Some("1")).unwrap_err().to_string();
    assert!(
        deflection.starts_with("its channel \"Vertical Deflection (retrace)\" contains no heights"),
        "{deflection}"
    );
}

#[test]
fn jpk_that_is_refused() {
    let file = jpk::file();
    let packed = changed_everywhere(&file, &[1, 2, 0, 3, 0, 0, 0, 1, 0, 16], &[1, 3, 0, 3, 0, 0, 0, 1, 0, 5]);
    assert_eq!(reason(&packed), "its images are compressed or have colours: save them without");
    let deep = changed_everywhere(&file, &[1, 2, 0, 3, 0, 0, 0, 1, 0, 16], &[1, 2, 0, 3, 0, 0, 0, 1, 0, 8]);
    assert_eq!(reason(&deep), "its images have 8 bits per point of a kind that is not read");
    let plain = changed(&file, &0x8042_u16.to_be_bytes(), &0x9042_u16.to_be_bytes());
    let other = read(&plain, None);
    assert!(
        other.format == "TIFF image" && !other.is_in_metres && other.spacing.is_none(),
        "another TIFF has grey values"
    );
}

#[test]
fn metropro_of_both_headers() {
    for file in [metropro::file(), metropro::long()] {
        let measured = read(&file, None);
        assert_eq!((measured.format, &measured.channels[..]), ("Zygo MetroPro", &["height".to_owned()][..]));
        assert_map(&measured, 2e-11, [2e-6; 2], true);
        assert_says(&measured, "Date", "Fri Jun 23 15:37:19 2006");
        assert_says(&measured, "Comment", "steel");
        let image = Measurement::from_bytes(&file, Some("1")).unwrap_err().to_string();
        assert_eq!(image, "its channel \"intensity\" contains no heights: choose one of \"height\"");
    }
}

#[test]
fn metropro_that_is_refused() {
    let file = metropro::file();
    let cut = reason(&file[..file.len() - 1]);
    assert_eq!(cut, "it states 4 rows of 5 points, but has 79 bytes for them");
    let mut other = file.clone();
    other[219] = 3;
    assert_eq!(reason(&other), "its phases have the resolution 3, which is none of 0, 1 and 2");
    let flat = changed(&file, &6.5536e-7_f32.to_be_bytes(), &f32::NAN.to_be_bytes());
    assert_eq!(reason(&flat), "it states that a phase of one is NaN metres");
}

#[test]
fn mi_of_every_type() {
    for file in [mi::file(), mi::long(), mi::text(), mi::columns()] {
        let measured = read(&file, None);
        assert_eq!(measured.format, "Molecular Imaging (MI)");
        assert_eq!(measured.channels, ["Topography", "Topography (3)"]);
        assert_map(&measured, 1e-9, SPACING, false);
        assert_says(&measured, "xNonlinearity2", "1.0");
        assert_says(&measured, "bufferRange", "32.768");
        assert_map(&read(&file, Some("3")), 1e-10, SPACING, false);
    }
}

#[test]
fn mi_that_is_refused() {
    let file = mi::file();
    let curves = changed(&file, b"fileType      Image", b"fileType      Spectroscopy");
    assert_eq!(reason(&curves), "it is a file of the type \"Spectroscopy\", not an image");
    assert_eq!(
        reason(&changed(&file, b"BINARY\n", b"ZIPPED\n")),
        "its numbers are of the type \"ZIPPED\", which is not known"
    );
    assert_eq!(reason(&file[..file.len() - 1]), "it states 4 rows of 5 points, but has 39 bytes for them");
    let words = String::from_utf8(mi::text()).unwrap().replace("\n-20\n", "\nlow\n");
    assert_eq!(reason(words.as_bytes()), "its heights contain \"low\"");
}

#[test]
fn nid_of_integers() {
    let file = nid::file();
    let measured = read(&file, None);
    assert_eq!(measured.format, "Nanosurf (NID, EZD)");
    assert_eq!(measured.channels, ["Scan forward (Z-Axis)", "Scan backward (Z-AxisSensor)"]);
    assert_map(&measured, 1e-9, SPACING, false);
    assert_says(&measured, "Op. mode", "Static \u{b0}");
    assert_says(&measured, "Dim2Name", "Z-Axis");
    assert_map(&read(&file, Some("3")), 1e-9, SPACING, false);
}

#[test]
fn nid_that_is_refused() {
    let file = nid::file();
    let text = changed(&file, b"SaveMode=Binary\r\nSaveBits=8", b"SaveMode=Text\r\nSaveBits=8");
    assert_eq!(
        reason(&text),
        "its channel \"Scan backward (Z-AxisSensor)\" is saved as \"Text\": save it as \"Binary\""
    );
    assert_eq!(reason(&changed(&file, b"#!", b"##")), "its header has no end, which is a line that begins with #!");
    assert_eq!(reason(&file[..file.len() - 1]), "it states 4 rows of 5 points, but has 19 bytes for them");
}

#[test]
fn wsxm_of_integers_and_doubles() {
    for file in [wsxm::file(), wsxm::double()] {
        let measured = read(&file, None);
        assert_eq!((measured.format, measured.channel.as_str()), ("WSxM (STP, TOP)", "Topography"));
        assert_map(&measured, 1e-9, SPACING, false);
        assert_says(&measured, "Acquisition time", "03/11/2011, 20:23");
    }
}

#[test]
fn wsxm_that_is_refused() {
    let file = wsxm::file();
    let curve = changed(&file, b"SxM Image file", b"IV curve file ");
    assert_eq!(reason(&curve), "it is a file of the type \"IV curve file\", not \"SxM Image file\"");
    let current = changed(&file, b"Z Amplitude: 46 nm", b"Z Amplitude: 46 nA");
    assert_eq!(reason(&current), "it contains no heights: none of its channels \"Topography\" is a length");
    assert_eq!(reason(&file[..file.len() - 1]), "it states 4 rows of 5 points, but has 39 bytes for them");
}
