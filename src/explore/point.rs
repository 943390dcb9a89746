//! Things on the page at which the texts of lessons point.

use super::leak::CONDUCTANCE;
use super::refusal::Refusal;
use super::schema::KNOBS;
use super::top::TopMap;
use crate::contact::Quantity;
use std::ops::Range;
use strum::IntoEnumIterator;

/// Things with names of their own: parts of the picture, and parts of the page around it.
const PLACES: [&str; 8] =
    ["section", "section.pressure", "section.peak", "section.contact", "section.stress", "top", "play", "why"];
/// Charts of the page.
const CHARTS: [&str; 2] = ["area", "kappa"];
/// Numbers in the table of the page that are no quantities of a contact.
const OTHER_NUMBERS: [&str; 2] = ["seconds", CONDUCTANCE];

/// Refuses a text of a lesson in which words point at something that is not on the page, as in `[area 0.11](number.area)`. Comments are left
/// out.
///
/// # Errors
/// A sentence with the known names, and where in the text the unknown one stands.
pub(super) fn check_points(text: &str) -> Result<(), (Range<usize>, Refusal)> {
    let mut begin = 0;
    for line in text.split_inclusive('\n') {
        if !line.trim_start().starts_with('#') {
            for name in points(line) {
                check(name).map_err(|refusal| (begin..begin + line.len(), refusal))?;
            }
        }
        begin += line.len();
    }
    Ok(())
}

/// The names behind the words that point.
fn points(line: &str) -> impl Iterator<Item = &str> {
    line.split("](").skip(1).filter_map(|behind| behind.split_once(')')).map(|(name, _)| name)
}

fn check(name: &str) -> Result<(), Refusal> {
    let is_known = match name.split_once('.') {
        Some(("number", of)) => Quantity::find(of).is_some() || OTHER_NUMBERS.contains(&of),
        Some(("control", id)) => KNOBS.iter().any(|knob| knob.id == id),
        Some(("map", map)) => TopMap::iter().any(|it| it.name() == map),
        Some(("chart", chart)) => CHARTS.contains(&chart),
        _ => PLACES.contains(&name),
    };
    if is_known {
        return Ok(());
    }
    let places = PLACES.iter().map(|it| format!("`{it}`"));
    let charts = CHARTS.iter().map(|it| format!("`chart.{it}`"));
    let maps = TopMap::iter().map(|it| format!("`map.{}`", it.name()));
    let known: Vec<String> = places.chain(charts).chain(maps).collect();
    Err(format!(
        "there is no {name:?} to point at: choose one of {}, or `number.` with the name of a number or `control.` with that of a knob",
        known.join(", ")
    )
    .into())
}
