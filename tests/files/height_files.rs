//! Height files and archives: round trips, and why unusable ones are refused.

use crate::real_files::real_files;
use asperity::error::FileError;
use asperity::formats::{Measurement, read_heights, read_shape, write_heights};
use ndarray::{Array2, ShapeBuilder, arr1, arr2};
use ndarray_npy::{NpzWriter, WriteNpyExt};
use std::fs::File;
use std::path::Path;

fn reason(path: &Path) -> String {
    match read_heights(path) {
        Err(FileError::Format { reason, .. }) => reason.to_string(),
        other => panic!("{other:?}"),
    }
}

fn entries(folder: &Path) -> usize {
    std::fs::read_dir(folder).unwrap().count()
}

#[test]
fn heights_survive_a_round_trip_in_both_orders() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("h.npy");
    let c = arr2(&[[1.0, 2.0, 3.0], [4.0, 5.0, 6.5]]);
    let mut fortran = Array2::zeros((2, 3).f());
    fortran.assign(&c);
    for heights in [c.clone(), fortran] {
        write_heights(&path, heights.view().into_dyn()).unwrap();
        assert_eq!(read_heights(&path).unwrap(), c.clone().into_dyn());
        assert_eq!(entries(folder.path()), 1);
    }
}

#[test]
fn singles_and_integers_are_widened() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("h.npy");
    ndarray_npy::write_npy(&path, &arr1(&[0.5f32, -2.25])).unwrap();
    assert_eq!(read_heights(&path).unwrap(), arr1(&[0.5, -2.25]).into_dyn());
    macro_rules! widened {
        ($($type:ty),+) => {
            $(ndarray_npy::write_npy(&path, &arr1(&[<$type>::MIN, 7, <$type>::MAX])).unwrap();
            let expected = arr1(&[<$type>::MIN as f64, 7.0, <$type>::MAX as f64]).into_dyn();
            assert_eq!(read_heights(&path).unwrap(), expected, stringify!($type));)+
        };
    }
    widened!(i8, i16, i32, i64, u8, u16, u32, u64);
}

/// An array in the words of NumPy: type, order, shape and bytes.
fn npy(descr: &str, is_fortran: bool, shape: &str, bytes: &[u8]) -> Vec<u8> {
    let order = if is_fortran { "True" } else { "False" };
    let mut header = format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': {shape}, }}");
    header.push_str(&" ".repeat(117 - header.len()));
    header.push('\n');
    [b"\x93NUMPY\x01\x00", &(header.len() as u16).to_le_bytes()[..], header.as_bytes(), bytes].concat()
}

#[test]
fn both_orders_of_bytes_and_of_axes_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("h.npy");
    let values = [1i32, -2, 3, 400_000, 5, 6];
    let big: Vec<u8> = values.iter().flat_map(|value| value.to_be_bytes()).collect();
    let little: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
    let [rows, columns] = [arr2(&[[1.0, -2.0, 3.0], [4e5, 5.0, 6.0]]), arr2(&[[1.0, 3.0, 5.0], [-2.0, 4e5, 6.0]])];
    for (descr, bytes) in [(">i4", &big), ("<i4", &little)] {
        for (is_fortran, expected) in [(false, &rows), (true, &columns)] {
            std::fs::write(&path, npy(descr, is_fortran, "(2, 3)", bytes)).unwrap();
            let heights = read_heights(&path).unwrap();
            assert_eq!(heights, expected.clone().into_dyn(), "{descr}, {is_fortran}");
        }
    }
    let singles: Vec<u8> = [0.5f32, 1.5, -2.5, 0.0].iter().flat_map(|value| value.to_be_bytes()).collect();
    std::fs::write(&path, npy(">f4", false, "(4,)", &singles)).unwrap();
    assert_eq!(read_heights(&path).unwrap(), arr1(&[0.5, 1.5, -2.5, 0.0]).into_dyn());
}

#[test]
fn texts_of_numbers_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("h.txt");
    let (line, matrix) = (arr1(&[1.5, -2.0, 3e-3]).into_dyn(), arr2(&[[1.0, 2.5], [3.0, -4.0]]).into_dyn());
    for (text, expected) in [
        ("1.5\n-2\n3e-3\n", &line),
        ("height (um)\n1.5\n\n-2\n3e-3", &line),
        ("1.5 -2 3e-3\n", &line),
        ("1.5,-2,3e-3\n", &line),
        ("# Width: 12.34 \u{b5}m\n% and more, of it\n1 2.5\n3 -4\n", &matrix),
        ("1\t2.5\r\n3\t-4\r\n", &matrix),
        ("1,2.5\n3,-4\n", &matrix),
        ("1, 2.5\n3, -4\n", &matrix),
        ("1;2.5\n3;-4\n", &matrix),
        ("1 2,5\n3 -4\n", &matrix),
        ("1,0;2,5;\n3,0;-4,0;\n", &matrix),
        ("\"1\"\t\"2,5\"\n3\t-4\n", &matrix),
        ("1,5;-2,0;3e-3\n", &line),
    ] {
        std::fs::write(&path, text).unwrap();
        assert_eq!(read_heights(&path).unwrap(), *expected, "{text:?}");
    }
    std::fs::write(&path, b"Width: 12 \xb5m\n1 2.5\n3 -4\n").unwrap();
    assert_eq!(read_heights(&path).unwrap(), matrix);
    for (text, words) in [
        ("1 2\n3 4\n5\n", "line 3 has 1 numbers, but the lines before it have 2"),
        ("1 2\n\n3 four\n", "line 3 has \"four\", which is not a number"),
        ("1,5\n2,5\n", "\"1,5\" may be one number with a decimal comma or two whole ones: write decimal points"),
        ("1,5,2 2,5\n", "nor a text of numbers: it begins with \"1,5,2 2,5\""),
        ("# nothing\n", "nor a text of numbers: it begins with \"# nothing\""),
    ] {
        std::fs::write(&path, text).unwrap();
        assert!(reason(&path).contains(words), "{text:?}: {}", reason(&path));
    }
}

#[test]
fn two_columns_or_rows_are_positions_and_heights() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("h");
    let heights = [3.0, -1.0, 4.0, -1.0, 5.0];
    let pairs =
        Array2::from_shape_fn((5, 2), |(i, column)| if column == 0 { 0.3 + 0.1 * i as f64 } else { heights[i] });
    for pairs in [pairs.clone(), pairs.t().to_owned()] {
        ndarray_npy::write_npy(&path, &pairs).unwrap();
        assert_eq!(read_heights(&path).unwrap(), arr1(&heights).into_dyn());
        assert_eq!(read_shape(&path).unwrap(), [5]);
        assert!((Measurement::read(&path, None).unwrap().spacing.unwrap()[1] - 0.1).abs() < 1e-15);
    }
    std::fs::write(&path, "X_(microns),y1\n0.0386,3.0\n0.0772,-1\n0.1158,4\n0.1544,-1\n0.1931,5\n").unwrap();
    assert_eq!((read_heights(&path).unwrap(), read_shape(&path).unwrap()), (arr1(&heights).into_dyn(), vec![5]));
    for (place, words) in [(3, "position number 4, 0.75, is not evenly spaced"), (2, "number 3"), (4, "number 2")] {
        let mut uneven = pairs.clone();
        uneven[[place, 0]] = 0.75;
        ndarray_npy::write_npy(&path, &uneven).unwrap();
        assert!(reason(&path).contains(words), "{}", reason(&path));
    }
    ndarray_npy::write_npy(&path, &Array2::<f64>::zeros((5, 3))).unwrap();
    assert_eq!((read_shape(&path).unwrap(), Measurement::read(&path, None).unwrap().spacing), (vec![5, 3], None));
    ndarray_npy::write_npy(&path, &Array2::from_elem((5, 2), 1.0)).unwrap();
    assert!(reason(&path).contains("positions, is 1.0 everywhere: give the heights alone"));
}

/// Real files, those of the tests of SurfaceTopography.
#[test]
#[ignore = "needs files of instruments"]
fn measured_profiles_and_matrices_are_read() {
    let folder = real_files();
    let read = |name: &str| read_heights(folder.join(name)).unwrap();
    let matrix = read("matrix-3.txt");
    assert_eq!((matrix.shape(), matrix[[0, 255]], matrix[[131, 121]]), (&[256, 256][..], 1.7899e-7, 3.3094e-10));
    let (profile, microns) = (read("xy-4.txt"), read("csv-1.csv"));
    assert_eq!((profile.shape(), profile[[3]]), (&[10001][..], 0.003585));
    assert_eq!((microns.shape(), microns[[7]]), (&[8][..], 1.94981));
    assert!(reason(&folder.join("nonuniform.asc")).contains("is not evenly spaced"));
}

#[test]
fn unusable_files_say_why() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("h.npy");
    assert!(matches!(read_heights(&path), Err(FileError::Read { .. })));
    assert!(reason(folder.path()).contains("directory"));
    std::fs::write(&path, b"").unwrap();
    assert!(reason(&path).ends_with("it is empty"));
    for text in [&b"hello"[..], b"12 \x01", b"\x93NUMPY\x01\x00\xff\xff", b"\x93NUMPY\x02\x00\xff\xff\xff\xff"] {
        std::fs::write(&path, text).unwrap();
        assert!(reason(&path).contains(" .npy file"), "{text:?}: {}", reason(&path));
    }
    ndarray_npy::write_npy(&path, &arr1(&[true, false])).unwrap();
    assert!(reason(&path).contains("'|b1': save integers, float32 or float64"), "{}", reason(&path));
    ndarray_npy::write_npy(&path, &ndarray::Array3::<f64>::zeros((1, 2, 3))).unwrap();
    assert!(reason(&path).contains("rank 3"));
    ndarray_npy::write_npy(&path, &ndarray::arr0(1.0)).unwrap();
    assert!(reason(&path).contains("rank 0"));
}

#[test]
fn truncated_and_boastful_files_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("h.npy");
    write_heights(&path, ndarray::ArrayD::zeros(vec![8, 8]).view()).unwrap();
    let whole = std::fs::read(&path).unwrap();
    for length in 0..whole.len() {
        std::fs::write(&path, &whole[..length]).unwrap();
        assert!(!reason(&path).is_empty());
    }
    let boastful = String::from_utf8_lossy(&whole[10..128]).replace("(8, 8)", "(999999999999, 8)");
    let header = [b"\x93NUMPY\x01\x00", &(boastful.len() as u16).to_le_bytes()[..], boastful.as_bytes()].concat();
    std::fs::write(&path, header).unwrap();
    assert!(reason(&path).contains("999999999999"), "{}", reason(&path));
    let nested = [b"\x93NUMPY\x01\x00\x00\x0f", &[b'('; 0x0f00][..]].concat();
    std::fs::write(&path, nested).unwrap();
    assert!(reason(&path).contains("not a valid .npy file"));
}

#[test]
fn heights_are_read_from_archives_and_broken_ones_say_why() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("x.npz");
    let mut npz = NpzWriter::new(File::create(&path).unwrap());
    let heights = arr2(&[[1.0, 2.5], [3.0, -4.0]]);
    npz.add_array("setup", &arr1(b"text")).unwrap();
    npz.add_array("height", &heights).unwrap();
    npz.finish().unwrap();
    assert_eq!(read_heights(&path).unwrap(), heights.into_dyn());
    let whole = std::fs::read(&path).unwrap();
    let end_of_heights = whole.windows(4).position(|mark| mark == b"PK\x01\x02").unwrap();
    for length in 0..end_of_heights {
        std::fs::write(&path, &whole[..length]).unwrap();
        assert!(!reason(&path).is_empty(), "{length}");
    }
    for place in 0..end_of_heights {
        let mut other = whole.clone();
        other[place] ^= 0xff;
        std::fs::write(&path, &other).unwrap();
        let _ = read_heights(&path);
    }
    let mut npz = NpzWriter::new(File::create(&path).unwrap());
    npz.add_array("pressure", &arr1(&[1.0])).unwrap();
    npz.finish().unwrap();
    assert!(reason(&path).contains("without the array `height`"));
}

#[test]
fn arrays_of_other_names_are_listed_and_can_be_chosen() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("other.npz");
    let (z, phase) = (arr2(&[[1.0, 2.5], [3.0, -4.0]]), arr2(&[[0.0, 1.0], [1.0, 0.0]]));
    let write = |arrays: &[(&str, &ndarray::Array2<f64>)]| {
        let mut npz = NpzWriter::new(File::create(&path).unwrap());
        arrays.iter().for_each(|(name, array)| npz.add_array(*name, *array).unwrap());
        npz.finish().unwrap();
    };
    let read = |channel: Option<&str>| Measurement::read(&path, channel).map(|it| it.height);
    write(&[("phase", &phase), ("z", &z)]);
    let refused = read(None).unwrap_err().to_string();
    assert!(refused.contains("without the array \"height\": choose one of its channels phase, z"), "{refused}");
    for channel in ["z", "2"] {
        assert_eq!(read(Some(channel)).unwrap(), z);
        assert_eq!(Measurement::read_layout(&path, Some(channel)).unwrap().shape, [2, 2]);
    }
    assert_eq!(Measurement::read(&path, Some("z")).unwrap().channels, ["phase", "z"]);
    assert!(read(Some("y")).unwrap_err().to_string().contains("without the array \"y\""));
    write(&[("arr_0", &z)]);
    assert_eq!(read(None).unwrap(), z);
    write(&[("height", &z), ("pressure", &phase)]);
    assert_eq!((read(None).unwrap(), read(Some("pressure")).unwrap()), (z, phase));
}

/// The directory of an archive with one member, whose head the archive begins with: the same fields, the place 0, and the name; and the end of the archive.
pub fn directory(archive: &[u8]) -> Vec<u8> {
    let name = &archive[30..30 + usize::from(archive[26])];
    [&b"PK\x01\x02\0\0"[..], &archive[4..28], &[0; 16], name, b"PK\x05\x06", &[0; 18]].concat()
}

#[test]
fn sizes_of_members_may_be_long_as_numpy_writes_them() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("x.npz");
    let mut array = Vec::new();
    arr1(&[1.0, 2.0]).write_npy(&mut array).unwrap();
    let size = (array.len() as u64).to_le_bytes();
    let extra = [&[9, 0, 1, 0, 7, 1, 0, 16, 0][..], &size, &size].concat();
    let bit = |sum: u32| if sum & 1 == 1 { sum >> 1 ^ 0xedb8_8320 } else { sum >> 1 };
    let sum = !array.iter().fold(!0, |sum, &byte| (0..8).fold(sum ^ u32::from(byte), |sum, _| bit(sum)));
    let lengths = [0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 10, 0, extra.len() as u8, 0];
    let mut head = [b"PK\x03\x04".as_slice(), &[0; 10], &sum.to_le_bytes(), &lengths, b"height.npy"].concat();
    head.extend(extra.iter().chain(&array));
    std::fs::write(&path, [&head[..], &directory(&head)].concat()).unwrap();
    assert_eq!(read_heights(&path).unwrap(), arr1(&[1.0, 2.0]).into_dyn());
    head[8] = 8;
    std::fs::write(&path, [&head[..], &directory(&head)].concat()).unwrap();
    assert!(reason(&path).contains("compressed"));
}
