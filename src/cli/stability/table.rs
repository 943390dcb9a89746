//! The table for reading, 120 columns wide but for notes.

use super::row::Row;
use std::io::{self, Write};

/// The names of the columns.
pub fn write_head(out: &mut impl Write) -> io::Result<()> {
    writeln!(
        out,
        "{:<28} {:>9} {:<13} {:>7} {:>7} {:>7}   {:<13} note",
        "case", "points", "solver", "steps", "seconds", "eta", "verdict"
    )
}

/// One result.
pub fn write_row(row: &Row, out: &mut impl Write) -> io::Result<()> {
    let points = match (row.ny, row.nx) {
        (Some(1), Some(nx)) => nx.to_string(),
        (Some(ny), Some(nx)) => format!("{ny}x{nx}"),
        _ => "-".into(),
    };
    let line = format!(
        "{:<28} {:>9} {:<13} {:>7} {:>7} {:>7} {} {:<13} {}",
        row.case,
        points,
        row.solver,
        row.iterations.map_or("-".into(), |steps| steps.to_string()),
        row.seconds.map_or("-".into(), |seconds| format!("{seconds:.3}")),
        row.eta.map_or("-".into(), |eta| format!("{eta:.1e}")),
        if row.as_demanded { ' ' } else { '!' },
        row.verdict,
        row.note
    );
    writeln!(out, "{}", line.trim_end())
}
