//! Files of instruments that are broken: reading one takes neither the program down nor long, nor much memory.

use crate::writers::ALL;
use asperity::surface::Measurement;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::time::{Duration, Instant};

/// Mutants of each file; `MUTANTS` in the environment is another number.
const MUTANTS: u64 = 400;
/// The longest time that reading one may take.
const LONGEST: Duration = Duration::from_secs(1);
/// Bytes of memory that all mutants together may add to what the program has mapped, far less than a number in a header can ask for.
const MEMORY: u64 = 1 << 31;
/// Numbers that a text may hold instead of its own.
const WORDS: [&str; 9] = ["-1", "0", "1", "4294967295", "18446744073709551615", "1e308", "nan", "inf", "x"];
/// Numbers of eight bytes that may stand anywhere; shorter ones are parts of them.
const NUMBERS: [u64; 6] = [0, u64::MAX, i64::MAX as u64, 1 << 31, 0x7fef_ffff_ffff_ffff, 0x7ff8_0000_0000_0000];

/// A file with a few changes.
fn mutant(file: &[u8], random: &mut ChaCha8Rng) -> Vec<u8> {
    let mut bytes = file.to_vec();
    for _ in 0..random.random_range(1..4) {
        change(&mut bytes, random);
    }
    bytes
}

fn change(bytes: &mut Vec<u8>, random: &mut ChaCha8Rng) {
    let at = random.random_range(0..bytes.len().max(1)).min(bytes.len());
    match random.random_range(0..6) {
        0 => bytes.iter_mut().skip(at).take(1).for_each(|byte| *byte ^= 1 << random.random_range(0..8)),
        1 => bytes.truncate(at),
        2 => drop(bytes.splice(at..at, (0..random.random_range(1..20)).map(|i| (i * 37) as u8))),
        3 => drop(bytes.splice(at..(at + random.random_range(1..20)).min(bytes.len()), [])),
        4 => overwrite(bytes, at, random),
        _ => replace_word(bytes, at, random),
    }
}

/// Writes a large or odd number over the bytes at a place.
fn overwrite(bytes: &mut [u8], at: usize, random: &mut ChaCha8Rng) {
    let number = NUMBERS[random.random_range(0..NUMBERS.len())].to_le_bytes();
    let part = &number[8 - (1 << random.random_range(0..4))..];
    bytes.iter_mut().skip(at).zip(part).for_each(|(byte, new)| *byte = *new);
}

/// Writes another number for the digits behind a place.
fn replace_word(bytes: &mut Vec<u8>, at: usize, random: &mut ChaCha8Rng) {
    let Some(start) = (at..bytes.len()).find(|i| bytes[*i].is_ascii_digit()) else { return };
    let end = (start..bytes.len()).find(|i| !bytes[*i].is_ascii_digit()).unwrap_or(bytes.len());
    bytes.splice(start..end, WORDS[random.random_range(0..WORDS.len())].bytes());
}

/// The most memory that the program has ever mapped, where the system tells.
fn peak() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmPeak:"))?;
    Some(1024 * line.trim().trim_end_matches("kB").trim().parse::<u64>().ok()?)
}

#[test]
fn mutants_are_read_or_refused() {
    let count = std::env::var("MUTANTS").ok().and_then(|it| it.parse().ok()).unwrap_or(MUTANTS);
    for (name, file) in ALL {
        let (file, before) = (file(), peak());
        let (mut read, mut longest) = (0, Duration::ZERO);
        for seed in 0..count {
            let bytes = mutant(&file, &mut ChaCha8Rng::seed_from_u64(seed));
            let start = Instant::now();
            read += u64::from(Measurement::of(&bytes, None).is_ok());
            longest = longest.max(start.elapsed());
            assert!(start.elapsed() < LONGEST, "mutant {seed} of {name} takes {:?}", start.elapsed());
        }
        let more = before.zip(peak()).map_or(0, |(before, after)| after - before);
        println!("{name}: {read} of {count} mutants are read, the longest in {longest:?}; {more} bytes more");
        assert!(more < MEMORY, "mutants of {name} take {more} bytes");
    }
}
