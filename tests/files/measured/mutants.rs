//! Files with errors in them: whatever they are, they are read or refused, in little memory, and what is read can be prepared or not.

use super::binaries::{self, ibw};
use super::containers::{self, SHAPE, hdf5, plux, x3p, xlsx};
use super::texts;
use asperity::error::{SetupError, SurfaceError};
use asperity::formats::Measurement;
use asperity::setup::{Cell, Recipe};
use asperity::surface::{Detrend, Fill, Form, Mirror, Preparation, Resample};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::path::Path;
use std::time::{Duration, Instant};

/// Mutants of each file; the environment variable `MUTANTS` sets another number.
const COUNT: usize = 400;
/// Heights of more nodes than that are not prepared.
const NODES: usize = 4096;
/// The range of lengths within which prepared heights must be finite; sums of squares overflow beyond.
const LENGTHS: std::ops::Range<f64> = 1e-100..1e100;
/// Bytes by which the memory of this process may grow: many times what all small files need together.
const LARGEST: u64 = 2 << 30;

/// Numbers that counts and places in headers are replaced by.
const NUMBERS: [u64; 12] = [
    0,
    1,
    0x7f,
    0xff,
    0x7fff,
    0xffff,
    0x7fff_ffff,
    0xffff_ffff,
    0x7fff_ffff_ffff_ffff,
    0xffff_ffff_ffff_ffff,
    0x4000_0000,
    0x0100_0000_0000,
];

/// Numbers that a text may hold instead of its own.
const WORDS: [&str; 9] = ["-1", "0", "1", "4294967295", "18446744073709551615", "1e308", "nan", "inf", "x"];

fn count() -> usize {
    std::env::var("MUTANTS").ok().and_then(|count| count.parse().ok()).unwrap_or(COUNT)
}

/// Replaces bytes at a place by a number, in either order of bytes.
fn replace(file: &mut [u8], at: usize, random: &mut ChaCha8Rng) {
    let (number, size) = (NUMBERS[random.random_range(0..NUMBERS.len())], [1, 2, 4, 8][random.random_range(0..4)]);
    let bytes = if random.random() { number.to_le_bytes() } else { number.rotate_right(8 * size as u32).to_be_bytes() };
    file[at..].iter_mut().zip(&bytes[..size]).for_each(|(old, new)| *old = *new);
}

/// Writes another number for the digits behind a place.
fn replace_word(file: &mut Vec<u8>, at: usize, random: &mut ChaCha8Rng) {
    let Some(start) = (at..file.len()).find(|i| file[*i].is_ascii_digit()) else { return };
    let end = (start..file.len()).find(|i| !file[*i].is_ascii_digit()).unwrap_or(file.len());
    file.splice(start..end, WORDS[random.random_range(0..WORDS.len())].bytes());
}

/// Changes a file in one place.
fn change(file: &mut Vec<u8>, random: &mut ChaCha8Rng) {
    let reach = if random.random() { file.len() } else { file.len().min(1024) };
    let at = random.random_range(0..reach.max(1));
    match random.random_range(0..7) {
        _ if file.is_empty() => file.push(random.random()),
        0 => file[at] ^= 1 << random.random_range(0..8),
        1 => file[at] = random.random(),
        2 => file.truncate(at),
        3 => drop(file.splice(at..at, (0..random.random_range(1..20)).map(|i| i as u8).collect::<Vec<_>>())),
        4 => drop(file.drain(at..(at + random.random_range(1..20)).min(file.len()))),
        5 => replace_word(file, at, random),
        _ => replace(file, at, random),
    }
}

/// A file with one to three changes.
fn mutant(file: &[u8], random: &mut ChaCha8Rng) -> Vec<u8> {
    let mut file = file.to_vec();
    (0..random.random_range(1..4)).for_each(|_| change(&mut file, random));
    file
}

/// Bytes of address space that this process has had at most, where the system says.
fn memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmPeak:"))?;
    line.split_whitespace().next()?.parse::<u64>().ok().map(|kilobytes| kilobytes << 10)
}

/// All steps, the form in turns, with a wavelength for the filter.
fn steps(turn: usize, wavelength: f64) -> Preparation {
    Preparation {
        resample: Some(Resample::Linear),
        fill: Some(Fill::Harmonic),
        detrend: Some(Detrend::Curvature),
        remove_form: [None, Some(Form::Cylinder), Some(Form::Sphere)][turn % 3],
        low_pass: Some(wavelength),
        taper: Some(0.2),
        mirror: Some(Mirror::Both),
        ..Preparation::default()
    }
}

/// Whether all lengths of a measurement are such that its prepared heights must be finite.
fn is_sane(measured: &Measurement) -> bool {
    let lengths = measured.spacing.iter().flatten().chain(measured.height.iter().filter(|h| !h.is_nan()));
    lengths.into_iter().all(|length| *length == 0.0 || LENGTHS.contains(&length.abs()))
}

/// Makes a surface of a file by all steps, if it has few nodes and they allow it; whether it is one.
fn prepare(path: &Path, turn: usize, measured: &Measurement) -> bool {
    let [_, dx] = measured.spacing.unwrap_or([1.0; 2]);
    let [ny, nx] = [measured.height.nrows(), measured.height.ncols()];
    let size = if measured.is_profile { vec![nx as f64] } else { vec![ny as f64, nx as f64] };
    let size = if measured.spacing.is_some() { Vec::new() } else { size };
    let cell = Cell { points: Vec::new(), size, ..Cell::line(4, 1.0) };
    let longest = if measured.is_profile { dx } else { measured.spacing.map_or(1.0, |[dy, dx]| dx.max(dy)) };
    let recipe =
        Recipe { height: Some(path.to_path_buf().into()), prepare: steps(turn, 4.0 * longest), ..Recipe::default() };
    match recipe.grid(&cell).and_then(|grid| recipe.surface(grid)) {
        Ok(surface) => surface.heights().iter().all(|h| h.is_finite()),
        Err(SetupError::Surface(SurfaceError::NonFinite { .. }) | SetupError::Voids { .. }) => {
            assert!(!is_sane(measured), "heights are lost: {measured:?}");
            false
        }
        Err(_) => false,
    }
}

/// Reads mutants and says how many are read and prepared, and how long the slowest one took to read.
fn survive(name: &str, seed: u64, make: impl Fn(&mut ChaCha8Rng) -> Vec<u8>) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mutant");
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let (before, mut read, mut prepared, mut slowest) = (memory(), 0, 0, Duration::ZERO);
    for i in 0..count() {
        let file = make(&mut random);
        let start = Instant::now();
        let measured = Measurement::from_bytes(&file, None);
        slowest = slowest.max(start.elapsed());
        match measured {
            Ok(measured) => {
                read += 1;
                if measured.height.len() <= NODES {
                    std::fs::write(&path, &file).unwrap();
                    prepared += usize::from(prepare(&path, i, &measured));
                }
            }
            Err(error) => assert!(error.kind() == std::io::ErrorKind::InvalidData, "{name}, mutant {i}: {error}"),
        }
    }
    let grown = memory().zip(before).map_or(0, |(after, before)| after - before);
    let (all, megabytes) = (count(), grown >> 20);
    println!(
        "{name}: of {all} mutants {read} are read and {prepared} prepared, the slowest is read in {slowest:?}, {megabytes} MB more"
    );
    assert!(grown < LARGEST, "{name}: {grown} bytes more");
}

#[test]
fn files_with_errors_do_no_harm() {
    let all = [binaries::ALL, containers::ALL, texts::ALL].concat();
    for (seed, (name, file)) in all.iter().enumerate() {
        let file = file();
        assert!(Measurement::from_bytes(&file, None).is_ok(), "{name}");
        survive(name, seed as u64, |random| mutant(&file, random));
    }
}

#[test]
fn arrays_of_hdf5_with_errors_do_no_harm() {
    for (seed, file) in [hdf5::plain(), hdf5::packed(), hdf5::huge()].iter().enumerate() {
        survive("hdf5", 110 + seed as u64, |random| mutant(file, random));
    }
}

/// Their errors are not found by the check sum of the headers.
#[test]
fn waves_with_errors_whose_check_sums_hold_do_no_harm() {
    for (seed, file) in [ibw::file(), ibw::alone(), ibw::profile()].iter().enumerate() {
        survive("ibw whose check sum holds", 102 + seed as u64, |random| ibw::signed(mutant(file, random)));
    }
}

#[test]
fn archives_of_files_with_errors_do_no_harm() {
    let (main, points) = x3p::doubles();
    survive("x3p of a wrong description", 100, |random| x3p::archive(&mutant(main.as_bytes(), random), &points, &[]));
    let valid = main.replace("</DataLink>", "<ValidPointsLink>bindata/valid.bin</ValidPointsLink></DataLink>");
    survive("x3p of wrong points", 101, |random| {
        x3p::archive(valid.as_bytes(), &mutant(&points, random), &mutant(&[0xff; 3], random))
    });
}

#[test]
fn descriptions_and_sheets_with_errors_do_no_harm() {
    let (index, data) = (plux::index(SHAPE), xlsx::data());
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
    survive("plux of a wrong description", 102, |random| plux::archive(&text(mutant(index.as_bytes(), random))));
    survive("xlsx of wrong cells", 103, |random| xlsx::archive("DATA", &text(mutant(data.as_bytes(), random))));
}

#[test]
fn descriptions_that_unpack_to_much_do_no_harm() {
    let (main, points) = x3p::doubles();
    let with = |record: &str| main.replace("<Record1>", &format!("<Record1>{record}"));
    let nested = [5_000, 200_000].map(|depth| with(&["<a>".repeat(depth), "</a>".repeat(depth)].concat()));
    let flat = [9_000, 1_000_000].map(|count| with(&"<a/>".repeat(count)));
    let long = main.replace("<Date>", &format!("<{}/><Date>", "a".repeat(50_000)));
    let descriptions: Vec<String> = nested.into_iter().chain(flat).chain([long]).collect();
    for description in descriptions {
        let file = x3p::archive(description.as_bytes(), &points, &[]);
        let read = Measurement::from_bytes(&file, None);
        assert_eq!(read.is_ok(), description.len() < 60_000, "{} bytes: {:?}", description.len(), read.err());
    }
}
