//! The cost of a solve in words.

use super::problem_summary::solver_of;
use asperity::quantity::bytes_in_words;
use asperity::record::{Options, Size};
use asperity::setup::{Cost, Extras, Setup, available_bytes};
use asperity::study::Refinement;
use std::io::{self, Write};

/// A solve that is described instead of made.
pub(crate) struct SolvePlan<'a> {
    pub setup: &'a Setup,
    pub cost: &'a Cost,
    /// The length of a list of loads, if there is one.
    pub loads: Option<usize>,
    pub is_recorded: bool,
    /// Whether a first pass finds the final state, with which the steps are compared.
    pub is_passed_twice: bool,
}

/// Writes the estimated cost of the solve, and the size of its recording, if any.
pub(crate) fn write(plan: &SolvePlan<'_>, out: &mut impl Write) -> io::Result<()> {
    let SolvePlan { setup, cost, loads, is_passed_twice, .. } = *plan;
    let shape = cost.grid.shape();
    writeln!(out, "Estimate for {}; nothing was solved.", solver_of(setup).0)?;
    writeln!(out, "  points      {}", points(shape))?;
    let coarsest = shape.map(|n| (n >> cost.coarse_grids).max(1));
    match cost.coarse_grids {
        0 => writeln!(out, "  grids       1")?,
        halvings => writeln!(out, "  grids       {}, from {} to {}", halvings + 1, points(coarsest), points(shape))?,
    }
    let free = available_bytes().map_or(String::new(), |free| format!(", {} are free", bytes_in_words(free)));
    writeln!(out, "  memory      about {}{free}", bytes_in_words(cost.bytes))?;
    writeln!(out, "  transforms  {}", setup.solver.transforms())?;
    if is_passed_twice {
        writeln!(
            out,
            "  passes      2: the first finds the final state, with which the steps of the second are compared"
        )?;
    }
    if let Some(loads) = loads {
        writeln!(out, "  loads       {loads}, each solved from the contact under the previous load")?;
    }
    match loads {
        _ if !plan.is_recorded => {}
        Some(loads) => write_recording_of_loads(setup, cost, loads, out)?,
        None => write_recording(setup, cost, out)?,
    }
    Ok(())
}

/// Writes the estimated size of the recording.
fn write_recording(setup: &Setup, cost: &Cost, out: &mut impl Write) -> io::Result<()> {
    let options = Options::from(setup);
    let size = Size::new(options.what, &cost.grid);
    let numbers = bytes_in_words(1e3 * size.step);
    let frame = bytes_in_words(size.frame);
    let pictures = match options.every {
        Some(every) => format!("about {frame} per frame, one frame every {every} steps"),
        None => {
            let frames = size.frames(setup.solver.steps(setup.stop.max_iterations()), cost.coarse_grids);
            let most = bytes_in_words(size.still + frames as f64 * size.frame + size.contact);
            format!("at most about {most}: {frames} frames of {frame}")
        }
    };
    match (size.frame > 0.0, size.step > 0.0) {
        (true, true) => writeln!(out, "  recording   {pictures}, and {numbers} for 1000 steps"),
        (true, false) => writeln!(out, "  recording   {pictures}"),
        _ => writeln!(out, "  recording   about {} and {numbers} for 1000 steps", bytes_in_words(size.still)),
    }
}

/// Writes the estimated size of a recording over `loads` loads.
fn write_recording_of_loads(setup: &Setup, cost: &Cost, loads: usize, out: &mut impl Write) -> io::Result<()> {
    let size = Size::new(Options::from(setup).what, &cost.grid);
    let frame = size.frame + size.contact;
    let most = bytes_in_words(size.still + loads as f64 * frame);
    writeln!(out, "  recording   at most about {most}: {loads} frames of {}", bytes_in_words(frame))
}

/// Writes the grids that a contact may take until it has settled.
pub(crate) fn write_grids(refinement: &Refinement, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "Finer grids follow until area and kappa_r are accurate enough, if memory allows:")?;
    for setup in refinement.setups().skip(1) {
        let Ok(cost) = setup.cost(&Extras::default()) else { break };
        if cost.check(setup.solver.name()).is_err() {
            let needed = bytes_in_words(cost.bytes);
            return writeln!(
                out,
                "  {:<11} and finer ones are not tried: it takes about {needed}",
                points(cost.grid.shape())
            );
        }
        writeln!(out, "  {:<11} about {}", points(cost.grid.shape()), bytes_in_words(cost.bytes))?;
    }
    Ok(())
}

fn points([ny, nx]: [usize; 2]) -> String {
    if ny == 1 { nx.to_string() } else { format!("{ny} x {nx}") }
}
