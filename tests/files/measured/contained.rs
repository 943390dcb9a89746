//! Small files of every format, read back point by point.

use super::containers::{self, ALL, SHAPE, VOID, height};
use asperity::formats::Measurement;

/// A measurement in a file that is written here.
fn read(file: &[u8], channel: Option<&str>) -> Measurement {
    Measurement::from_bytes(file, channel).unwrap_or_else(|error| panic!("{error}"))
}

/// Whether two numbers are the same except for rounding, or both void.
fn is_same(found: f64, told: f64) -> bool {
    (found.is_nan() && told.is_nan()) || (found - told).abs() <= 1e-6 * told.abs()
}

/// The value of an entry of a header.
fn entry<'a>(measured: &'a Measurement, name: &str) -> &'a str {
    let found = measured.header.iter().find(|it| it.0 == name);
    &found.unwrap_or_else(|| panic!("no {name} in {:?}", measured.header)).1
}

/// Compares a map with what was written: heights in nanometres, rows 3 and columns 2 micrometres apart.
fn is_map(name: &str, measured: &Measurement) {
    assert_eq!((measured.height.dim(), measured.is_profile), (SHAPE.into(), false), "{name}");
    assert!(measured.is_in_metres && measured.positions.is_none(), "{name}");
    let spacing = measured.spacing.unwrap();
    let across = if name == "zon" { 2e-6 } else { 3e-6 }; // the points of ZON are squares
    assert!(is_same(spacing[0], across) && is_same(spacing[1], 2e-6), "{name}: {spacing:?}");
    for ((iy, ix), &found) in measured.height.indexed_iter() {
        let told = if [iy, ix] == VOID { f64::NAN } else { height(ix, iy) * 1e-9 };
        assert!(is_same(found, told), "{name}: {found} at {ix}, {iy}, not {told}");
    }
}

/// Compares an uneven profile of three points with what was written, in micrometres.
fn is_uneven(name: &str, measured: &Measurement) {
    assert_eq!((measured.height.dim(), measured.is_profile), ((1, 3), true), "{name}");
    assert!(measured.is_in_metres && is_same(measured.spacing.unwrap()[1], 1.5e-6), "{name}");
    let positions = measured.positions.as_ref().unwrap();
    assert!(
        positions.iter().zip([0.0, 1e-6, 3e-6]).all(|(found, told)| is_same(*found, told)),
        "{name}: {positions:?}"
    );
    let heights = measured.height.iter().zip([1e-6, f64::NAN, 3e-6]);
    assert!(heights.into_iter().all(|(found, told)| is_same(*found, told)), "{name}: {:?}", measured.height);
}

#[test]
fn maps_come_back_as_they_were_written() {
    let mut maps = 0;
    for (name, file) in ALL.iter().filter(|it| !it.0.contains("profile")) {
        is_map(name, &read(&file(), None));
        maps += 1;
    }
    assert!(maps > 0);
}

#[test]
fn x3p_says_where_it_comes_from() {
    let measured = read(&containers::x3p::file(), Some("height"));
    assert_eq!(measured.format, "ISO 25178-72 (X3P)");
    assert_eq!([entry(&measured, "Date"), entry(&measured, "Instrument/Model")], ["2026-11-22T09:00:00", "probe"]);
    is_uneven("x3p", &read(&containers::x3p::profile(), None));
}

#[test]
fn x3p_without_increments_has_no_size() {
    let (main, points) = containers::x3p::doubles();
    let read_main = |main: &str| {
        Measurement::from_bytes(&containers::x3p::archive(main.as_bytes(), &points, &[]), None)
            .map_err(|it| it.to_string())
    };
    let without = |axis: &str| main.replace(&format!("<Increment>{axis}</Increment>"), "");
    for main in [without("2e-6"), without("3e-6"), without("2e-6").replace("<Increment>3e-6", "<Increment>")] {
        let measured = read_main(&main).unwrap();
        assert!(measured.spacing.is_none() && measured.is_in_metres, "{:?}", measured.spacing);
        assert!(is_same(measured.height[[0, 1]], height(1, 0) * 1e-9));
    }
    let whole = main.replace(">D<", ">L<");
    assert!(read_main(&whole).unwrap_err().contains("no Increment that turns them into metres"));
}

#[test]
fn x3p_is_refused_when_its_points_are_damaged_or_missing() {
    let (main, points) = containers::x3p::doubles();
    let refusal = |main: &str, points: &[u8]| {
        let file = containers::x3p::archive(main.as_bytes(), points, &[]);
        Measurement::from_bytes(&file, None).unwrap_err().to_string()
    };
    assert!(refusal(&main, &points[1..]).contains("cannot be unpacked"));
    assert!(refusal(&main.replace("SUR", "PCL"), &points).contains("PCL"));
    assert!(refusal(&main.replace("<SizeZ>1", "<SizeZ>2"), &points).contains("2 layers"));
    assert!(refusal(&main.replace("<SizeX>5", "<SizeX>500000"), &points).contains("500000"));
    assert!(refusal(&main.replace(">D<", ">Q<"), &points).contains("\"Q\""));
    assert!(refusal(&main.replace("Record3", "Record4"), &points).contains("Record3"));
    let attributes: String = (0..2000).map(|i| format!(" a{i}=\"\"")).collect();
    assert!(refusal(&main.replace("<Record1", &format!("<Record1{attributes}")), &points).contains("attributes"));
}

#[test]
fn sur_has_objects_comments_and_profiles() {
    let measured = read(&containers::sur::packed(), Some("2"));
    assert_eq!((measured.channels.as_slice(), measured.channel.as_str()), (&["Z", "Z 2"].map(String::from)[..], "Z 2"));
    is_map("the second object", &measured);
    let told = [("comment", "remark"), ("operator", "me"), ("date", "2026-11-22 03:04:05"), ("acquisition", "9")];
    told.into_iter().for_each(|(name, value)| assert_eq!(entry(&measured, name), value));
    let profile = read(&containers::sur::profile(), None);
    assert!(profile.is_profile && is_same(profile.spacing.unwrap()[1], 2e-6));
    assert_eq!(profile.height.dim(), (1, SHAPE[0] * SHAPE[1]));
    assert!(is_same(profile.height[[0, 1]], height(1, 0) * 1e-9));
}

#[test]
fn sur_is_refused_when_it_is_cut_short() {
    let is_cut = |error: &str| error.contains("incomplete") || error.contains("points, but has");
    for (file, channel) in [(containers::sur::file(), None), (containers::sur::packed(), Some("2"))] {
        let error = Measurement::from_bytes(&file[..file.len() - 1], channel).unwrap_err().to_string();
        assert!(is_cut(&error), "{error}");
    }
    let mut file = containers::sur::packed();
    let place = 512 + 10 + 4 + 8 * 5 + 5; // within the first of five streams
    file[place] ^= 0xff;
    assert!(Measurement::from_bytes(&file, None).is_err());
}

#[test]
fn mnt_names_surfaces_and_software() {
    let measured = read(&containers::mnt::file(), None);
    assert_eq!((measured.format, measured.channels.as_slice()), ("Digital Surf (MNT)", &["steel".to_owned()][..]));
    assert_eq!([entry(&measured, "Version"), entry(&measured, "Serial number")], ["9.2.0.10023", "DS-1"]);
    let error = Measurement::from_bytes(&containers::mnt::short(), Some("1")).unwrap_err().to_string();
    assert!(error.contains("contains no heights"), "{error}");
    let refusal = |stream: &[u8]| {
        let file = containers::mnt::compound("ScopedContents", stream);
        Measurement::from_bytes(&file, None).unwrap_err().to_string()
    };
    assert_eq!(refusal(&[0; 100]), "its stream \"ScopedContents\" of 100 bytes is incomplete");
    assert_eq!(refusal(&[0; 5000]), "it has no contents");
    let other = containers::mnt::compound("WordDocument", &[0; 5000]);
    assert_eq!(Measurement::from_bytes(&other, None).unwrap_err().to_string(), "its format is not known");
}

#[test]
fn plux_lists_layers_that_can_be_read() {
    let file = containers::plux::file();
    let measured = read(&file, None);
    assert_eq!((measured.format, entry(&measured, "Date")), ("Sensofar PLUX", "2026-11-22"));
    assert_eq!(measured.channels, ["layer 0"]);
    let refusal =
        |index: &str| Measurement::from_bytes(&containers::plux::archive(index), None).unwrap_err().to_string();
    let index = containers::plux::index(SHAPE);
    assert!(refusal(&containers::plux::index([4, 500_000])).contains("500000"));
    assert_eq!(refusal(&index.replace("FOV_X", "FOV")), "its index.xml has no FOV_X");
    assert_eq!(refusal(&index.replace("LAYER_", "OTHER_")), "its index.xml has no LAYER_0");
    assert!(refusal("<a><b></a>").starts_with("its index.xml cannot be read"));
}

#[test]
fn zon_that_is_packed_twice_is_refused() {
    assert_eq!(read(&containers::zon::file(), None).format, "Keyence ZON");
    let error = Measurement::from_bytes(&containers::zon::of_kind(b"KPK1"), None).unwrap_err().to_string();
    assert!(error.contains("packed twice"), "{error}");
}

#[test]
fn workbooks_are_those_of_roughness_testers() {
    let measured = read(&containers::xlsx::file(), None);
    is_uneven("xlsx", &measured);
    assert_eq!(measured.format, "Mitutoyo SurfTest (XLSX)");
    assert_eq!([entry(&measured, "Date"), entry(&measured, "Cut-off")], ["22- Nov -2026", "0.08mm"]);
    assert_eq!(entry(&measured, "Ra"), "0.018 µm");
    let error = Measurement::from_bytes(&containers::xlsx::workbook("Sheet2"), None).unwrap_err().to_string();
    assert!(error.starts_with("it is a workbook without a sheet DATA"), "{error}");
}

#[test]
fn workbooks_that_unpack_to_much_are_refused() {
    let data = containers::xlsx::data();
    let [nested, flat] = [["<a>".repeat(200_000), "</a>".repeat(200_000)].concat(), "<row/>".repeat(1_000_000)];
    let spaces: String = (0..2000).map(|i| format!("<row xmlns:a{i}=\"a\"/>")).collect();
    let attributes: String = (0..2000).map(|i| format!(" a{i}=\"\"")).collect();
    for more in [nested, flat, spaces, format!("<row{attributes}/>")] {
        let file = containers::xlsx::archive("DATA", &format!("{data}{more}"));
        let error = Measurement::from_bytes(&file, None).unwrap_err().to_string();
        assert!(error.contains("more than"), "{} bytes: {error}", more.len());
    }
}

#[test]
fn gwyddion_lists_channels_of_heights_only() {
    let measured = read(&containers::gwy::file(), None);
    assert_eq!((measured.format, measured.channels.len()), ("Gwyddion (GWY)", 1));
    assert_eq!((measured.channel.as_str(), entry(&measured, "Tip")), ("Topography", "blunt"));
    assert!(entry(&measured, "mask").contains("void"));
    let error = Measurement::from_bytes(&containers::gwy::file(), Some("Current")).unwrap_err().to_string();
    assert!(error.contains("contains no heights"), "{error}");
    let other = [b"GWYQ".to_vec(), containers::gwy::file()].concat();
    assert!(Measurement::from_bytes(&other, None).unwrap_err().to_string().contains("GWYQ"));
}

#[test]
fn netcdf_has_attributes_and_profiles() {
    let measured = read(&containers::netcdf::file(), Some("heights"));
    assert_eq!((entry(&measured, "title"), entry(&measured, "unit")), ("a small map", "nm"));
    assert_eq!(read(&containers::netcdf::wide(), None).channels, ["z"]);
    is_uneven("netcdf", &read(&containers::netcdf::profile(), None));
}

/// Compares the heights of a map without distances with what was written.
fn has_heights(name: &str, measured: &Measurement) {
    assert!(measured.spacing.is_none() && measured.is_in_metres && !measured.is_profile, "{name}");
    assert_eq!(measured.height.dim(), SHAPE.into(), "{name}");
    for ((iy, ix), &found) in measured.height.indexed_iter() {
        let told = if [iy, ix] == VOID { f64::NAN } else { height(ix, iy) * 1e-9 };
        assert!(is_same(found, told), "{name}: {found} at {ix}, {iy}, not {told}");
    }
}

#[test]
fn arrays_of_hdf5_are_listed_once_by_their_paths() {
    let file = containers::hdf5::plain();
    let measured = read(&file, None);
    assert_eq!((measured.format, measured.channel.as_str()), ("HDF5 (NetCDF-4)", "alias"));
    assert_eq!(measured.channels, ["alias", "scan/line"]);
    has_heights("integers", &measured);
    assert_eq!([entry(&measured, "operator"), entry(&measured, "_FillValue")], ["me", "-32768"]);
    let line = read(&file, Some("scan/line"));
    assert!(line.is_profile && line.is_in_metres);
    assert!(line.height.iter().zip([3e-6, 1e-6, 4e-6]).all(|(found, told)| is_same(*found, told)));
    let amplitude = Measurement::from_bytes(&file, Some("scan/amplitude")).unwrap_err().to_string();
    assert!(amplitude.contains("contains no heights: choose one of \"alias\", \"scan/line\""), "{amplitude}");
}

#[test]
fn packed_chunks_of_hdf5_are_unpacked() {
    let file = containers::hdf5::packed();
    let measured = read(&file, None);
    assert_eq!(measured.channels, ["z", "series"], "a length before values without a unit");
    has_heights("chunks", &measured);
    let series = read(&file, Some("series"));
    assert!(!series.is_in_metres && !series.is_profile);
    assert_eq!(series.height[[2, 4]], 32.0, "288 in one byte");
}

#[test]
fn scales_of_hdf5_say_where_points_are() {
    let file = containers::hdf5::scales();
    assert_eq!(read(&file, None).channels, ["heights", "profile"]);
    is_uneven("netcdf 4", &read(&file, Some("profile")));
}

#[test]
fn surfaces_of_datx_come_before_other_arrays() {
    let measured = read(&containers::hdf5::zygo(), None);
    assert_eq!((measured.format, &measured.channels[..]), ("Zygo Mx (DATX)", &["Surface".to_owned()][..]));
    assert_eq!(entry(&measured, "Z Converter"), "HeightCat NanoMeters 0 0.5 0.0000005 1.25");
    let other = Measurement::from_bytes(&containers::hdf5::zygo(), Some("Data/Intensity/{8}")).unwrap_err().to_string();
    assert!(other.contains("contains no heights: choose one of \"Surface\""), "{other}");
}

#[test]
fn hdf5_that_is_refused() {
    let reason = |file: &[u8]| Measurement::from_bytes(file, None).unwrap_err().to_string();
    let start = b"\x89HDF\r\n\x1a\n";
    assert!(reason(&[start, &[0; 100][..]].concat()).starts_with("it is damaged or not supported HDF5: "));
    let huge = containers::hdf5::huge();
    assert!(reason(&huge).starts_with("its 1000000 x 1000000 points do not fit in memory"), "{}", reason(&huge));
    for file in [containers::hdf5::plain(), containers::hdf5::packed(), containers::hdf5::zygo()] {
        for length in [8, 48, 100, file.len() / 2, file.len() - 1] {
            let read = Measurement::from_bytes(&file[..length], None);
            assert!(read.as_ref().map_or(true, |it| !it.unreadable.is_empty()), "{length}: {read:?}");
        }
    }
}
