//! What an earlier program gave for each kind of drive, this one gives as well.
//!
//! `ASPERITY_BEFORE=path/to/earlier/asperity cargo test --release --test commands golden` compares both programs: each number of JSON, tables,
//! archives and recordings that the earlier one gives has to come out again, to the bit. Numbers that are new are told. What changed on
//! purpose stands in the changelog.

use crate::drives::{DRIVES, Drive, Found};
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
    for drive in &DRIVES {
        let [before, now] = [Path::new(&earlier), Path::new(env!("CARGO_BIN_EXE_asperity"))].map(|it| drive.run(it));
        differences.extend(before.iter().filter_map(|(name, values)| changed(drive, name, values, &now)));
        eprintln!("golden: {}: {} numbers; new are {}", drive.name, before.len(), added(&before, &now).join(" "));
    }
    assert!(differences.is_empty(), "{}", differences.join("\n"));
}
