//! Recordings with wrong bytes, or without their end: read, or refused in one sentence.

use crate::command::{Folder, text};
use asperity::error::FileError;
use asperity::record::{compare, setups};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

/// Recordings that are damaged, half of them of a line, half of a surface.
const DAMAGED: usize = 600;

const RUNS: [&str; 2] = [
    "solve --indenter cylinder --radius 1 --points 64 --size 4 --reduced-pressure 0.01 --record whole.rrd",
    "solve --hurst 0.8 --rolloff 0.5 --short-cutoff 0.2 --rms-gradient 0.1 --points 16,16 --size 1 --reduced-pressure 0.05 --record whole.rrd",
];

/// A few bytes changed, a piece overwritten, left out or put in twice, or the end cut off.
fn damaged(whole: &[u8], random: &mut ChaCha8Rng) -> Vec<u8> {
    let mut bytes = whole.to_vec();
    let from = random.random_range(4..bytes.len() - 64);
    let piece = from..from + random.random_range(1..64);
    match random.random_range(0..6) {
        0 => bytes.truncate(from),
        1 => bytes[piece].fill(random.random_range(0..=255)),
        2 => drop(bytes.drain(piece)),
        3 => drop(bytes.splice(from..from, whole[piece].to_vec())),
        _ => (0..random.random_range(1..9)).for_each(|_| {
            let place = random.random_range(4..bytes.len());
            bytes[place] ^= 1 << random.random_range(0..8);
        }),
    }
    bytes
}

/// The places of the bytes of the heads of all messages: a head has a kind and a length of 8 bytes each, and follows the 12 bytes of the file's own head.
fn heads(bytes: &[u8]) -> Vec<usize> {
    let (mut at, mut places) = (12, Vec::new());
    while let Some(head) = bytes.get(at..at + 16) {
        places.extend(at..at + 16);
        let [kind, length] = [&head[..8], &head[8..]].map(|it| u64::from_le_bytes(it.try_into().unwrap()));
        if kind == 0 {
            break;
        }
        at += 16 + length as usize;
    }
    places
}

/// A whole recording has a digest: with any bit of its data wrong, it is refused, or what is read of it is as it was. Only the index at its end, which is
/// not read, is not summed.
#[test]
fn a_wrong_bit_changes_no_setup_and_no_curve() {
    let folder = Folder::new();
    let [whole, mutant, out] = ["whole.rrd", "mutant.rrd", "out.rrd"].map(|name| folder.join(name));
    assert!(folder.run(RUNS[0]).status.success());
    let (bytes, right) = (std::fs::read(&whole).unwrap(), setups(&whole).unwrap());
    let mut random = ChaCha8Rng::seed_from_u64(73);
    let (mut refused, mut silent) = (0, 0);
    // the heads of messages are few bytes, with kinds and lengths that the decoder goes by
    let heads = heads(&bytes);
    for number in 0..600 {
        let mut wrong = bytes.clone();
        let at = match number % 3 {
            0 => heads[random.random_range(0..heads.len())],
            _ => random.random_range(12..bytes.len()),
        };
        wrong[at] ^= 1 << random.random_range(0..8);
        std::fs::write(&mutant, wrong).unwrap();
        match setups(&mutant) {
            Ok(found) => {
                assert_eq!(found, right);
                silent += 1;
            }
            Err(_) => {
                refused += 1;
                assert!(compare(&[&whole, &mutant], &out).is_err());
            }
        }
    }
    // the index is a third of such a small recording
    assert!(refused > 350, "{refused} refused, {silent} read as they were");
}

#[test]
fn damaged_recordings_are_refused_in_one_sentence() {
    let folder = Folder::new();
    let [whole, mutant, out] = ["whole.rrd", "mutant.rrd", "out.rrd"].map(|name| folder.join(name));
    let mut random = ChaCha8Rng::seed_from_u64(58);
    let mut counts = [0; 2];
    for run in RUNS {
        assert!(folder.run(run).status.success());
        let bytes = std::fs::read(&whole).unwrap();
        for number in 0..DAMAGED / RUNS.len() {
            std::fs::write(&mutant, damaged(&bytes, &mut random)).unwrap();
            let read = [setups(&mutant).map(drop), compare(&[&whole, &mutant], &out)];
            for (count, read) in counts.iter_mut().zip(read) {
                match read {
                    Ok(()) => *count += 1,
                    Err(FileError::Read { .. } | FileError::Incomparable { .. }) => (),
                    Err(error) => panic!("mutant {number}: {error}"),
                }
            }
            // a few of them at the door
            if number % 25 == 0 {
                for line in ["solve --setup-of mutant.rrd --dry-run", "compare whole.rrd mutant.rrd --out out.rrd"] {
                    let output = folder.run(line);
                    let said = text(&output.stderr);
                    assert!(!said.contains("panicked") && said.lines().count() <= 3, "{line}, mutant {number}: {said}");
                    assert!(matches!(output.status.code(), Some(0 | 2)), "{line}, mutant {number}: {said}");
                }
            }
        }
    }
    println!("of {DAMAGED} recordings, {} still tell a setup, and {} can be compared", counts[0], counts[1]);
    let names = std::fs::read_dir(folder.join("")).unwrap().count();
    assert!(counts.iter().all(|count| (10..DAMAGED).contains(count)) && names <= 3, "{counts:?}, {names} files");
}
