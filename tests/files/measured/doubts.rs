//! Files that contradict themselves: counts that are not those of the data, and check sums of other bytes.

use super::binaries::{self, POINTS, bcr, frt, ibw, metropro, mi, nanoscope, nid, opd, opdx, plu, sdf, tmd, vk4, wsxm};
use super::containers::{sur, x3p};
use asperity::formats::{Measurement, Scan};
use asperity::surface::Field;
use std::io::{Cursor, Read, Write};
use zip::write::SimpleFileOptions;
use zip::{ZipArchive, ZipWriter};

/// Statements about what is doubtful in a file.
fn doubts(file: &[u8]) -> Vec<String> {
    let measured = Measurement::from_bytes(file, None).unwrap_or_else(|error| panic!("{error}"));
    measured.warnings.into_iter().map(|warning| warning.statement.to_string()).collect()
}

/// A file with other bytes of the same number wherever these are, at least once.
fn replaced(mut file: Vec<u8>, from: &[u8], to: &[u8]) -> Vec<u8> {
    let places: Vec<usize> = (0..file.len()).filter(|at| file[*at..].starts_with(from)).collect();
    assert!(!places.is_empty() && from.len() == to.len());
    places.into_iter().for_each(|at| file[at..at + to.len()].copy_from_slice(to));
    file
}

/// A file with other bytes at a place.
fn with(mut file: Vec<u8>, at: usize, bytes: &[u8]) -> Vec<u8> {
    file[at..at + bytes.len()].copy_from_slice(bytes);
    file
}

#[test]
fn a_row_that_no_count_accounts_for_is_told() {
    let [nx, ny] = POINTS;
    let points = |file: &[u8]| file.len() - 4 * nx * ny;
    let integers = |numbers: [i32; 3]| numbers.map(i32::to_le_bytes).concat();
    let (main, heights) = x3p::doubles();
    let x3p_of = |main: &str| x3p::archive(main.as_bytes(), &heights, &[]);
    let cases = [
        (
            "plu",
            plu::file(),
            with(plu::file(), 388, &3u32.to_le_bytes()),
            "the header states 3 rows of 5 points, but layer 1 has 4 rows of 5",
        ),
        (
            "opd",
            opd::file(),
            with(opd::file(), points(&opd::file()) - 4, &3u16.to_le_bytes()),
            "20 unexpected bytes follow the points of \"Raw\"",
        ),
        (
            "opdx",
            opdx::profile(),
            replaced(opdx::profile(), &[0x0b, 5, 0, 0], &[0x0b, 6, 0, 0]),
            "\"Raw\" states 6 points, but has 5",
        ),
        (
            "tmd",
            tmd::file(),
            replaced(tmd::file(), &[5, 0, 0, 0, 4, 0, 0, 0], &[5, 0, 0, 0, 3, 0, 0, 0]),
            "20 unexpected bytes follow the heights",
        ),
        (
            "vk4",
            vk4::file(),
            replaced(vk4::file(), &[5, 0, 0, 0, 4, 0, 0, 0, 32], &[5, 0, 0, 0, 3, 0, 0, 0, 32]),
            "20 unexpected bytes follow the points of \"height\"",
        ),
        ("sdf", sdf::binary(), with(sdf::binary(), 44, &3u16.to_le_bytes()), "19 unexpected bytes follow the heights"),
        (
            "al3d",
            binaries::al3d::file(),
            replaced(
                binaries::al3d::file(),
                &[b"Rows".as_slice(), &[0; 16], b"4"].concat(),
                &[b"Rows".as_slice(), &[0; 16], b"3"].concat(),
            ),
            "24 unexpected bytes follow the depth image",
        ),
        (
            "nanoscope",
            nanoscope::file(),
            replaced(nanoscope::file(), b"Number of lines: 4", b"Number of lines: 3"),
            "10 unexpected bytes follow the points of \"Height Sensor\"",
        ),
        (
            "sur",
            sur::file(),
            replaced(sur::file(), &integers([5, 4, 20]), &integers([5, 3, 20])),
            "it states 20 points, but 3 rows of 5 are 15",
        ),
        (
            "x3p",
            x3p_of(&main),
            x3p_of(&main.replace("<SizeY>4", "<SizeY>3")),
            "40 unexpected bytes follow the points in \"bindata/data.bin\"",
        ),
    ];
    for (name, file, changed, told) in cases {
        assert_eq!(doubts(&file), [""; 0], "{name}");
        let found = doubts(&changed);
        assert!(found.iter().any(|doubt| doubt.contains(told)), "{name}: {found:?}");
    }
}

#[test]
fn a_row_too_many_of_a_microscope_or_profilometer_is_told() {
    let less = |file: Vec<u8>, from: &str, to: &str| replaced(file, from.as_bytes(), to.as_bytes());
    let counts = |file: Vec<u8>| replaced(file, &[5, 0, 0, 0, 4, 0, 0, 0], &[5, 0, 0, 0, 3, 0, 0, 0]);
    let cases = [
        ("bcr", bcr::file(), less(bcr::file(), "ypixels = 4", "ypixels = 3"), 10, "the last row"),
        ("frt", frt::file(), counts(frt::file()), 10, "the points"),
        ("ibw", ibw::file(), ibw::signed(counts(ibw::file())), 80, "the numbers of the wave"),
        ("metropro", metropro::file(), replaced(metropro::file(), &[0, 5, 0, 4], &[0, 5, 0, 3]), 30, "the phases"),
        ("mi", mi::file(), less(mi::file(), "yPixels       4", "yPixels       3"), 30, "the last channel"),
        ("nid", nid::file(), less(nid::file(), "Lines=4", "Lines=3"), 25, "the last channel"),
        ("wsxm", wsxm::file(), less(wsxm::file(), "Number of rows: 4", "Number of rows: 3"), 10, "the last row"),
    ];
    for (name, file, changed, count, behind) in cases {
        assert_eq!(doubts(&file), [""; 0], "{name}");
        let (found, told) = (doubts(&changed), format!("{count} unexpected bytes follow {behind}"));
        assert!(found.len() == 1 && found[0].contains(&told), "{name}: {found:?}");
    }
}

#[test]
fn bytes_behind_the_end_of_a_file_are_told() {
    for (name, file) in [("opd", opd::file()), ("sur", sur::file()), ("packed", sur::packed())] {
        let longer = [file, vec![0; 13]].concat();
        let found = doubts(&longer);
        assert!(found.iter().any(|doubt| doubt.contains("13 unexpected bytes follow the last")), "{name}: {found:?}");
    }
}

/// The files of an archive.
fn files(archive: Vec<u8>) -> Vec<(String, Vec<u8>)> {
    let mut archive = ZipArchive::new(Cursor::new(archive)).unwrap();
    let read = |i| {
        let mut file = archive.by_index(i).unwrap();
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).unwrap();
        (file.name().to_owned(), bytes)
    };
    (0..3).map(read).collect()
}

/// The archive of heights whose files are changed before they are packed, so that the check sums of the archive itself hold.
fn packed_anew(change: impl Fn(&str, Vec<u8>) -> Vec<u8>) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.x3p");
    let height = Field::from_shape_fn((5, 6), |(iy, ix)| 1e-6 * (iy * ix) as f64);
    Scan { height, spacing: [1e-6; 2] }.write(&path).unwrap();
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in files(std::fs::read(&path).unwrap()) {
        archive.start_file(&*name, SimpleFileOptions::default()).unwrap();
        archive.write_all(&change(&name, bytes)).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

#[test]
fn the_check_sums_in_an_x3p_are_compared() {
    assert_eq!(doubts(&packed_anew(|_, bytes| bytes)), [""; 0]);
    let spoiled = packed_anew(|name, mut bytes| {
        if name == "bindata/data.bin" {
            bytes[40] ^= 1;
        }
        bytes
    });
    let error = Measurement::from_bytes(&spoiled, None).unwrap_err().to_string();
    assert!(error.contains("check sum of its file \"bindata/data.bin\" differs from that in its main.xml"), "{error}");
    let edited = packed_anew(|name, bytes| match name {
        "main.xml" => String::from_utf8(bytes).unwrap().replace("<Offset>0<", "<Offset>0.0<").into_bytes(),
        _ => bytes,
    });
    let found = doubts(&edited);
    assert!(found.len() == 1 && found[0].contains("changed after it was written"), "{found:?}");
}

#[test]
fn texts_whose_head_counts_otherwise_are_told() {
    let rows = "0 1\n1 3\n2.5 2\n4 7\n";
    let measured = Measurement::from_bytes(format!("µm nm\n4\n{rows}").as_bytes(), None).unwrap();
    assert!(measured.is_in_metres && measured.is_profile && measured.warnings.is_empty(), "{:?}", measured.warnings);
    let near = |found: f64, told: f64| (found - told).abs() < 1e-12 * told;
    assert!(near(measured.positions.unwrap()[2], 2.5e-6) && near(measured.height[[0, 3]], 7e-9));
    let found = doubts(format!("µm nm\n3\n{rows}").as_bytes());
    assert!(found.len() == 1 && found[0].contains("the header states 3 rows, but there are 4"), "{found:?}");
}

#[test]
fn texts_of_holographic_microscopes_are_metres() {
    let head = "pixel size=3.7e-007 m\nheight conversion factor (-> m)=6.3e-008\nh=4 w=5\n";
    let rows = "1 2 3 4 5\n".repeat(4);
    let measured = Measurement::from_bytes(format!("{head}{rows}").as_bytes(), None).unwrap();
    assert!(measured.is_in_metres && measured.warnings.is_empty(), "{:?}", measured.warnings);
    assert!(measured.spacing.unwrap().iter().all(|spacing| (spacing - 3.7e-7).abs() < 1e-18));
    assert!((measured.height[[3, 4]] - 5.0 * 6.3e-8).abs() < 1e-18);
    let found = doubts(format!("{head}{}", "1 2 3 4 5\n".repeat(6)).as_bytes());
    assert!(found.len() == 1 && found[0].contains("the header states 4 rows, but there are 6"), "{found:?}");
}

#[test]
fn an_error_in_the_first_line_of_a_matrix_is_no_head() {
    let rows = "1 2 3 4\n5 6 7 8\n9 9 9 9\n";
    for first in ["1 2 3x 4", "a 2 3 4"] {
        let error = Measurement::from_bytes(format!("{first}\n{rows}").as_bytes(), None).map(|it| it.height.dim());
        assert!(error.as_ref().is_err_and(|error| error.to_string().starts_with("line 1 has")), "{first}: {error:?}");
    }
    assert_eq!(Measurement::from_bytes(format!("a b c d\n{rows}").as_bytes(), None).unwrap().height.dim(), (3, 4));
}
