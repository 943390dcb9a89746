//! The table for reading, 120 columns wide.

use super::case::{Case, Group};
use super::row::Row;
use clap::ValueEnum;
use std::io::{self, Write};

/// The names of the columns.
pub fn write_head(out: &mut impl Write) -> io::Result<()> {
    writeln!(
        out,
        "{:<14} {:>11} {:<13} {:>6} {:>10} {:>8} {:>6} {:>7} {:>6} {:>7} {:>5} {:>6} status",
        "case",
        "points",
        "solver",
        "steps",
        "transforms",
        "solve s",
        "make s",
        "eta",
        "area",
        "kappa_r",
        "MiB",
        "ratio"
    )
}

/// The name of a group and what it is.
pub fn write_group(group: Group, quick: bool, out: &mut impl Write) -> io::Result<()> {
    let Some(value) = group.to_possible_value() else { return Ok(()) };
    let help = value.get_help().map(ToString::to_string).unwrap_or_default();
    writeln!(out, "\n{}{}: {help}", value.get_name(), if quick { ", shrunk" } else { "" })
}

/// One result.
pub fn write_row(case: &Case, row: &Row, out: &mut impl Write) -> io::Result<()> {
    let or_dash = |value: Option<f64>, digits| value.map_or("-".into(), |value| format!("{value:.digits$}"));
    writeln!(
        out,
        "{:<14} {:>11} {:<13} {:>6} {:>10} {:>8.3} {:>6.3} {:>7.1e} {:>6.4} {:>7.4} {:>5} {:>6} {}",
        case.name,
        case.size,
        row.solver,
        row.iterations,
        row.transforms,
        row.solve_seconds,
        row.make_seconds,
        row.certificate,
        row.relative_area,
        row.kappa_r_corrected,
        or_dash(row.peak_mib, 0),
        or_dash(row.ratio, 2),
        row.status
    )
}
