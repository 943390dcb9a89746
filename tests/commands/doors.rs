//! Four doors, one number: what a drive gives as JSON, as a table, in an archive, in a recording and as a row of a study is the same to the bit.

use crate::command::{Folder, text};
use crate::drives::{DRIVES, Drive, Found, found};
use asperity::contact::Quantity;

/// Whether two columns are the same to the bit, as far as both hold numbers.
fn is_same(one: &[f64], two: &[f64]) -> bool {
    one.len() == two.len() && one.iter().zip(two).all(|(a, b)| a.to_bits() == b.to_bits() || a.is_nan() || b.is_nan())
}

/// The values of a quantity in the states of a JSON object, or under its loads, or of its one contact; with flow, of its rows.
fn told(found: &Found, quantity: Quantity) -> Option<&Vec<f64>> {
    let name = quantity.name();
    ["json/states", "json/loads", "json"].iter().find_map(|place| found.get(&format!("{place}/{name}")))
}

fn check(drive: &Drive, found: &Found) -> Vec<String> {
    let mut wrong = Vec::new();
    let mut compared = 0;
    for quantity in Quantity::all() {
        let Some(json) = told(found, quantity) else { continue };
        for door in ["csv", "npz"] {
            let Some(other) = found.get(&format!("{door}/{}", quantity.name())) else { continue };
            // a number that some states do not have is left out of JSON, and no number elsewhere
            let other: Vec<f64> = other.iter().copied().filter(|value| !value.is_nan()).collect();
            compared += 1;
            if !is_same(json, &other) {
                wrong.push(format!("{}: {door} of {}: {json:?}, {other:?}", drive.name, quantity.name()));
            }
        }
    }
    // curves of a recording over states and loads are columns of the same table
    for (entity, values) in found.iter().filter(|(name, _)| name.starts_with("rrd/curve/")) {
        let is_there = |it: &Quantity| told(found, *it).is_some_and(|json| is_same(json, values));
        let is_partial = values.len() < found.get("rrd/load/value").map_or(0, Vec::len);
        if !is_partial && !Quantity::all().any(|it| is_there(&it)) {
            wrong.push(format!("{}: {entity} is no quantity: {values:?}", drive.name));
        }
        compared += 1;
    }
    assert!(compared > 30, "{}: only {compared} columns were compared", drive.name);
    wrong
}

#[test]
fn each_drive_gives_the_same_numbers_through_each_door() {
    let wrong: Vec<String> = found().iter().flat_map(|(drive, found)| check(drive, found)).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_row_of_a_study_has_the_numbers_of_the_last_state() {
    for drive in DRIVES.iter().filter(|drive| !drive.name.starts_with("loads")) {
        let folder = Folder::new();
        let solved = folder.run(&format!("{} --json --save-setup scene.toml", drive.words()));
        assert!(solved.status.success(), "{}: {}", drive.name, text(&solved.stderr));
        let solved: serde_json::Value = serde_json::from_slice(&solved.stdout).unwrap();
        let last = solved["states"].as_array().map_or(&solved, |states| states.last().unwrap());
        let studied = folder.run("study scene.toml --out row.csv");
        assert!(studied.status.success(), "{}: {}", drive.name, text(&studied.stderr));
        let mut table = csv::Reader::from_path(folder.join("row.csv")).unwrap();
        let names = table.headers().unwrap().clone();
        let row = table.records().next().unwrap().unwrap();
        let mut compared = 0;
        for (name, cell) in names.iter().zip(&row) {
            let (Ok(found), Some(expected)) = (cell.parse::<f64>(), last[name].as_f64()) else { continue };
            if Quantity::find(name).is_some() && !found.is_nan() {
                assert_eq!(found.to_bits(), expected.to_bits(), "{}: {name}", drive.name);
                compared += 1;
            }
        }
        assert!(compared >= 5, "{}: {compared} numbers", drive.name);
    }
}
