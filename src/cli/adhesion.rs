//! What a summary says about adhesion.

use super::output::{TextRow, row};
use super::units::Units;
use asperity::job::AdhesionOutcome;
use asperity::quantity::number_in_words;
use std::io::{self, Write};

/// The part of the energy lost in jumps with rows from which the summary tells that there were smaller ones.
const UNTOLD_JUMP_ENERGY: f64 = 1e-3;

/// Numbers of the attraction, names and values for reading.
pub(crate) fn rows(it: &AdhesionOutcome, units: Units) -> Vec<TextRow> {
    let scales = &it.scales;
    let number = |value: Option<f64>| value.map_or("-".into(), number_in_words);
    let zone = format!("{}, {} spacings", units.length(scales.process_zone), number_in_words(scales.spacings));
    let ratio = number_in_words(scales.pastewka_robbins);
    vec![
        row("work of adhesion", units.energy_per_area(it.work)),
        row("range", units.length(it.range)),
        row("process zone", zone),
        row("Tabor's number", number(scales.tabor)),
        row("Maugis' number", number(scales.maugis)),
        row("Pastewka-Robbins", format!("{ratio} (rough surfaces are expected to stick below 1)")),
    ]
}

/// The end of the summary: pull-off, jumps and energies.
pub(crate) fn write_totals(it: &AdhesionOutcome, units: Units, out: &mut dyn Write) -> io::Result<()> {
    let totals = &it.totals;
    match totals.lowest_pressure.map(|pressure| units.pressure(pressure)) {
        None => writeln!(out, "\nthe attraction does not hold this load")?,
        Some(lowest) if totals.separated => writeln!(out, "\npull-off at a mean pressure of {lowest}")?,
        Some(lowest) => writeln!(out, "\nlowest mean pressure {lowest}")?,
    }
    let jumps = units.energy_per_area(totals.lost_in_jumps);
    let shown: f64 = totals.jumps.iter().map(|jump| jump.energy).sum();
    let smaller = if totals.lost_in_jumps - shown > UNTOLD_JUMP_ENERGY * shown { " and smaller ones" } else { "" };
    let count = match totals.jumps.len() {
        1 => format!("1 jump{smaller}"),
        count => format!("{count} jumps{smaller}"),
    };
    let error = totals.lost_error.map(|error| format!(", error of the steps {}", units.energy_per_area(error)));
    let open = if totals.separated { "; it is not known once the surfaces have parted under a load" } else { "" };
    writeln!(out, "energy lost per area: {jumps} in {count}{}{open}", error.unwrap_or_default())
}
