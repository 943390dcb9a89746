//! Files of several channels of which one cannot be read, and values that no heights have.

use super::binaries::{nanoscope, opd, plu};
use super::containers::{gwy, netcdf, sur};
use asperity::formats::Measurement;
use asperity::surface::{Field, Surface};
use asperity::{Grid, error::SurfaceError};

/// A file with other bytes where these are first.
fn changed(file: &[u8], from: &[u8], to: &[u8]) -> Vec<u8> {
    let at = file.windows(from.len()).position(|it| it == from).unwrap_or_else(|| panic!("{from:?} is not there"));
    [&file[..at], to, &file[at + from.len()..]].concat()
}

#[test]
fn a_channel_that_cannot_be_read_does_not_refuse_the_others() {
    let spm = nanoscope::file();
    let current = changed(&gwy::file(), b"unitstr\0sA\0", b"unitstr\0sm\0");
    let cut = |file: Vec<u8>, bytes: usize| file[..file.len() - bytes].to_vec();
    let cases = [
        (changed(&spm, b"Number of lines: 4", b"Number of lines: 0"), "Phase", "0 rows of 5", "Height Sensor"),
        (changed(&spm, b"Bytes/pixel: 2", b"Bytes/pixel: 1"), "Phase", "1 bytes per point", "Height Sensor"),
        (changed(&spm, b"@2:Z scale", b"@2:Z skale"), "Phase", "no @2:Z scale", "Height Sensor"),
        (cut(spm.clone(), 1), "LogModulus", "has 39 bytes", "Height Sensor"),
        (changed(&current, b"xres\0i\x05", b"xres\0i\x09"), "Topography", "4 rows of 9", "Current"),
        (changed(&opd::file(), &[5, 0, 4, 0, 1, 0], &[5, 0, 4, 0, 3, 0]), "Image", "3 bytes", "Raw"),
        (cut(plu::file(), 8 + 60 + 1), "layer 2", "bytes for them", "layer 1"),
        (cut(sur::packed(), 1), "object 2", "bytes are missing", "Z"),
        (netcdf::unlimited(), "series", "unlimited dimension", "z"),
    ];
    for (file, name, why, read) in cases {
        let measured = Measurement::from_bytes(&file, None).unwrap_or_else(|error| panic!("{name}: {error}"));
        let [(found, reason)] = measured.unreadable.as_slice() else { panic!("{name}: {:?}", measured.unreadable) };
        assert!(found == name && reason.contains(why), "{found}: {reason}");
        assert_eq!(measured.channel, read, "{name}");
        assert!(!measured.channels.contains(found) && measured.channels.contains(&read.to_owned()), "{name}");
        let asked = Measurement::from_bytes(&file, Some(name)).unwrap_err().to_string();
        assert!(asked.starts_with(&format!("its channel {name:?} cannot be read, because ")), "{asked}");
        assert!(asked.contains(why) && asked.contains("choose one of"), "{asked}");
    }
}

#[test]
fn units_and_directions_of_the_axes_of_a_map_are_their_own() {
    let known = Measurement::from_bytes(&netcdf::falling("mm"), None).unwrap();
    let [dy, dx] = known.spacing.unwrap();
    assert!(known.is_in_metres && (dy - 3e-3).abs() < 1e-12 && (dx - 2e-6).abs() < 1e-15);
    let first = super::containers::height(1, 0) * 1e-9;
    assert!((known.height[[0, 1]] - first).abs() < 1e-15, "{:?}", known.height);
    let unknown = Measurement::from_bytes(&netcdf::falling("ells"), None).unwrap();
    assert!(!unknown.is_in_metres);
}

#[test]
fn heights_whose_differences_overflow_are_refused() {
    for text in ["-9e307 9e307\n1 2\n3 4\n5 6\n", "0 1e308\n1 -1e308\n2 3\n3 4\n", "1e308\n-1\n1e308\n-1e308\n"] {
        let error = Measurement::from_bytes(text.as_bytes(), None).map(|it| it.height);
        assert!(error.as_ref().is_err_and(|it| it.to_string().contains("overflow")), "{text}: {error:?}");
    }
    let height = Field::from_shape_vec((1, 4), vec![1e308, -1e308, 0.0, 1.0]).unwrap();
    let refused = Surface::new(Grid::line(4, 1.0).unwrap(), height);
    assert!(matches!(refused, Err(SurfaceError::Overflow { .. })));
}

#[test]
fn headers_of_arrays_are_no_longer_than_the_file() {
    for (version, count) in [(1, vec![0xff, 0xff]), (2, vec![0xff; 4]), (3, vec![0xff; 4])] {
        let file = [b"\x93NUMPY".to_vec(), vec![version, 0], count, b"{'descr'".to_vec()].concat();
        let error = Measurement::from_bytes(&file, None).unwrap_err().to_string();
        assert!(error.contains("it states a header of "), "{error}");
    }
}
