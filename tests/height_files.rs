//! Height files and archives: round trips, and why unusable ones are refused.

use asperity::error::FileError;
use asperity::surface::{read_heights, write_heights};
use ndarray::{Array2, ShapeBuilder, arr1, arr2};
use ndarray_npy::{NpzWriter, WriteNpyExt};
use std::fs::File;
use std::path::Path;

fn reason(path: &Path) -> String {
    match read_heights(path) {
        Err(FileError::Format { reason, .. }) => reason,
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
fn singles_are_widened() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("h.npy");
    ndarray_npy::write_npy(&path, &arr1(&[0.5f32, -2.25])).unwrap();
    assert_eq!(read_heights(&path).unwrap(), arr1(&[0.5, -2.25]).into_dyn());
}

#[test]
fn unusable_files_say_why() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("h.npy");
    assert!(matches!(read_heights(&path), Err(FileError::Read { .. })));
    assert!(reason(folder.path()).contains("directory"));
    for text in [&b""[..], b"hello", b"\x93NUMPY\x01\x00\xff\xff", b"\x93NUMPY\x02\x00\xff\xff\xff\xff"] {
        std::fs::write(&path, text).unwrap();
        assert!(reason(&path).contains("no .npy file"), "{text:?}: {}", reason(&path));
    }
    ndarray_npy::write_npy(&path, &arr1(&[1i32, 2])).unwrap();
    assert!(reason(&path).contains("i4"), "{}", reason(&path));
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
    assert!(reason(&path).contains("no .npy file"));
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
fn sizes_of_members_may_be_long_as_numpy_writes_them() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("x.npz");
    let mut array = Vec::new();
    arr1(&[1.0, 2.0]).write_npy(&mut array).unwrap();
    let size = (array.len() as u64).to_le_bytes();
    let extra = [&[9, 0, 1, 0, 7, 1, 0, 16, 0][..], &size, &size].concat();
    let mut head =
        [b"PK\x03\x04".as_slice(), &[0; 14], &[0xff; 8], &[10, 0, extra.len() as u8, 0], b"height.npy"].concat();
    head.extend(extra.iter().chain(&array));
    std::fs::write(&path, &head).unwrap();
    assert_eq!(read_heights(&path).unwrap(), arr1(&[1.0, 2.0]).into_dyn());
    head[8] = 8;
    std::fs::write(&path, &head).unwrap();
    assert!(reason(&path).contains("compressed"));
}
