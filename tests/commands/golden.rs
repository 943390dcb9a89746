//! What each kind of drive gives at each door: by what is written down in `golden.txt`, and by an earlier program.
//!
//! `golden.txt` has the names of all numbers, how many there are and their root mean square. Names that come or go and numbers that change are mistakes, or
//! stand in the changelog. `ASPERITY_GOLDEN=write cargo test --release --test commands golden` writes the file anew.
//!
//! `ASPERITY_BEFORE=path/to/earlier/asperity cargo test --release --test commands golden` compares with an earlier program on the same machine: each number
//! of JSON, tables, archives and recordings that the earlier one gives has to come out again, to the bit. Numbers that are new are told.

use crate::drives::{Drive, Found, found};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

/// A number that changed, in words. Curves over states are found again in any order.
fn changed(drive: &Drive, name: &str, before: &[f64], now: &Found) -> Option<String> {
    let is_same = |(one, two): (&f64, &f64)| one == two || (one.is_nan() && two.is_nan());
    let is_curve = |name: &str| name.starts_with("rrd/curve/");
    let is_there = |(other, values): (&String, &Vec<f64>)| is_curve(other) && values == before;
    match now.get(name) {
        _ if is_curve(name) && now.iter().any(is_there) => None,
        None => Some(format!("{}: {name} is gone", drive.name)),
        Some(now) if now.len() != before.len() => {
            Some(format!("{}: {name} has {} values, not {}", drive.name, now.len(), before.len()))
        }
        Some(now) => {
            let (place, (one, two)) = before.iter().zip(now).enumerate().find(|(_, pair)| !is_same(*pair))?;
            Some(format!("{}: {name}, value {place}: {two:e}, not {one:e}", drive.name))
        }
    }
}

/// The names of numbers that the earlier program did not have.
fn added<'a>(before: &'a Found, now: &'a Found) -> Vec<&'a str> {
    now.keys().filter(|name| !before.contains_key(*name)).map(String::as_str).collect()
}

#[test]
fn each_drive_gives_what_an_earlier_program_gave() {
    let Some(earlier) = std::env::var_os("ASPERITY_BEFORE") else {
        eprintln!("golden: skipped, as ASPERITY_BEFORE names no earlier program");
        return;
    };
    let mut differences = Vec::new();
    for (drive, now) in found() {
        let before = drive.run(Path::new(&earlier));
        differences.extend(before.iter().filter_map(|(name, values)| changed(drive, name, values, now)));
        eprintln!("golden: {}: {} numbers; new are {}", drive.name, before.len(), added(&before, now).join(" "));
    }
    assert!(differences.is_empty(), "{}", differences.join("\n"));
}

/// What is written down of all drives.
const WRITTEN: &str = include_str!("golden.txt");

/// The largest relative difference of a root mean square. Machines with other instructions round differently, and a solver that stops at another
/// iterate within its tolerance gives other digits from the sixth on.
const TOLERANCE: f64 = 1e-4;

/// Numbers that differ from machine to machine: they count the work, or are rounding alone.
const OF_WORK: [&str; 11] = [
    "bound",
    "certificate",
    "error",
    "iterations",
    "penetration",
    "precision",
    "residual",
    "solved",
    "step",
    "transforms",
    "version",
];

/// A line of what is written down: how many numbers there are, and their root mean square where it can be compared.
type Line = (usize, Option<f64>);

/// The line of some numbers.
fn line(name: &str, values: &[f64]) -> Line {
    let finite: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
    let mean_square = finite.iter().map(|value| value * value).sum::<f64>() / finite.len() as f64;
    // steps of the solver are as many as it takes
    let is_of_work = OF_WORK.iter().any(|word| name.contains(word)) || name.starts_with("rrd/");
    let count = if name.starts_with("rrd/") { 0 } else { values.len() };
    (count, (!is_of_work && !finite.is_empty()).then(|| mean_square.sqrt()))
}

/// The lines of all drives, by drive and name.
fn lines() -> BTreeMap<String, Line> {
    let of = |(drive, found): &(&Drive, Found)| -> Vec<(String, Line)> {
        found.iter().map(|(name, values)| (format!("{}\t{name}", drive.name), line(name, values))).collect()
    };
    found().iter().flat_map(of).collect()
}

/// The lines that are written down.
fn written() -> BTreeMap<String, Line> {
    let read = |text: &str| {
        let [drive, name, count, size] = text.split('\t').collect::<Vec<_>>().try_into().unwrap();
        (format!("{drive}\t{name}"), (count.parse().unwrap(), size.parse().ok()))
    };
    WRITTEN.lines().map(read).collect()
}

/// Writes the lines of all drives into the file.
fn write_down(lines: &BTreeMap<String, Line>) {
    let mut text = String::new();
    for (name, (count, size)) in lines {
        let size = size.map_or("-".to_owned(), |size| format!("{size:.6e}"));
        writeln!(text, "{name}\t{count}\t{size}").unwrap();
    }
    std::fs::write(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/commands/golden.txt"), text).unwrap();
}

#[test]
fn each_drive_gives_what_is_written_down() {
    let now = lines();
    if std::env::var("ASPERITY_GOLDEN").is_ok_and(|it| it == "write") {
        write_down(&now);
        return;
    }
    let before = written();
    let mut wrong = Vec::new();
    for name in before.keys().filter(|name| !now.contains_key(*name)) {
        wrong.push(format!("{name} is gone"));
    }
    for (name, (count, size)) in &now {
        let Some((old_count, old_size)) = before.get(name) else {
            wrong.push(format!("{name} is new"));
            continue;
        };
        let is_near = match (size, old_size) {
            (Some(size), Some(old)) => (size - old).abs() <= TOLERANCE * old.abs().max(1e-12),
            (size, old) => size.is_some() == old.is_some(),
        };
        if count != old_count || !is_near {
            wrong.push(format!("{name}: {count} numbers of size {size:?}, not {old_count} of {old_size:?}"));
        }
    }
    assert!(wrong.is_empty(), "{} differences:\n{}", wrong.len(), wrong[..wrong.len().min(40)].join("\n"));
}
