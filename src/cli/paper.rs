//! `asperity paper`: the tables and figures of van Dokkum et al. (2018), made again.

use super::choice::count;
use super::exit_status::ExitStatus;
use super::progress::blank;
use super::terminal::stdout;
use super::warnings;
use super::wrote::wrote;
use anyhow::Result;
use asperity::paper::{self, Effort, Event, Item};
use asperity::study::{Point, warnings_of_extrapolated_rows};
use clap::ValueEnum;
use clap::builder::{PossibleValue, PossibleValuesParser};
use indicatif::ProgressBar;
use std::collections::BTreeSet;
use std::io::Write;
use std::num::NonZeroUsize;
use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

const EXAMPLES: &str = "\
Examples:
  asperity paper fig2 --quick
  asperity paper fig2 fig3 --hurst 0.3,0.6 --line-seeds 1-20 --out study";

/// What is said before the numbers of a quick run.
const COARSE: &str = "\
--quick: coarse grids, short spectra and few loads. Rows below may differ from the paper for this reason alone; leave --quick out for its numbers.";

#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct PaperCommand {
    /// Tables and figures to make, in the given order
    #[arg(value_name = "PART", default_value = "all", value_parser = parts())]
    parts: Vec<String>,
    /// Folder for all files
    #[arg(long, value_name = "DIR", default_value = "paper")]
    out: PathBuf,
    /// Hurst exponents [default: 0.2,0.5,0.8; for the item nayak 0.3,0.8]
    #[arg(long, value_name = "H,H,...", value_delimiter = ',')]
    hurst: Vec<f64>,
    /// Reduced pressures p* of rough lines and surfaces [default: 13 from 1e-3 to 1e-1, for surfaces every third of
    /// them; for the item hurst 8 from 1e-4 to 0.32, for nayak 5 from 1e-3 to 0.3, for its surfaces 4 from 1e-2; with --full 1e-3, 1e-2, 1e-1]
    #[arg(long, value_name = "P,P,...", value_delimiter = ',')]
    loads: Vec<f64>,
    /// Seeds of rough lines, such as 1-10 or 3,5,8 [default: 1-10]
    #[arg(long, value_name = "SEEDS", value_delimiter = ',', value_parser = seeds)]
    line_seeds: Vec<RangeInclusive<u64>>,
    /// Seeds of rough surfaces on all grids [default: 1-6 on 2048, 1-4 on 4096, 1-2 on 8192; with --full 1]
    #[arg(long, value_name = "SEEDS", value_delimiter = ',', value_parser = seeds)]
    surface_seeds: Vec<RangeInclusive<u64>>,
    /// Points of a rough line [default: 262144]
    #[arg(long, value_name = "N")]
    line_points: Option<usize>,
    /// Points along a side of rough surfaces, coarsest grid first; with two or more grids, values are extrapolated to
    /// zero spacing [default: 2048,4096,8192, which is 8 to 32 points per shortest wavelength; with --full 16384, which
    /// is 64 as in the paper]
    #[arg(long, value_name = "N,N,...", value_delimiter = ',')]
    surface_points: Vec<usize>,
    /// Shortest wavelength of rough lines, as a fraction of the roll-off wavelength [default: 1/512]
    #[arg(long, value_name = "SHARE")]
    line_cutoff: Option<f64>,
    /// Shortest wavelength of rough surfaces, as a fraction of the roll-off wavelength [default: 1/64]
    #[arg(long, value_name = "SHARE")]
    surface_cutoff: Option<f64>,
    /// Certificate eta of each point
    #[arg(long, value_name = "ETA", default_value = "1e-8")]
    tolerance: f64,
    /// Realisations solved at the same time [default: the number of threads, or fewer if memory is short]
    #[arg(long, value_name = "N", value_parser = count)]
    workers: Option<NonZeroUsize>,
    /// Use small grids, short spectra and few loads, as a quick test
    #[arg(long, conflicts_with = "full")]
    quick: bool,
    /// Use rough surfaces of 16384 points per side (the paper's size, if its eps_c is read this way), one per Hurst
    /// exponent
    #[arg(long)]
    full: bool,
    /// Solve all points again, and replace existing results
    #[arg(long)]
    fresh: bool,
    /// Do not write recordings
    #[arg(long)]
    no_record: bool,
}

impl PaperCommand {
    pub(crate) fn run(&self) -> Result<ExitStatus> {
        let (items, paper, bar) =
            (self.items(), self.paper(), blank("{prefix} [{wide_bar}] {percent} %, {msg} ({eta} left)"));
        let is_told = AtomicBool::new(!self.quick);
        let comparison = paper.run(&items, &|event| {
            if matches!(event, Event::Begin { .. }) && !is_told.swap(true, Ordering::Relaxed) {
                writeln!(stdout(), "{COARSE}").ok();
            }
            show(&bar, event);
        })?;
        writeln!(stdout())?;
        comparison.write_text(&mut stdout())?;
        let points = paper.all_points(&items)?;
        points.iter().filter(|point| !point.is_converged()).try_for_each(warn)?;
        wrote(&self.out);
        warnings::print(&warnings::in_flags(&warnings_of_extrapolated_rows(&points)));
        let is_converged = points.iter().all(Point::is_converged);
        Ok(if is_converged { ExitStatus::Done } else { ExitStatus::NotConverged })
    }

    /// The requested items, each once.
    fn items(&self) -> Vec<Item> {
        let mut items: Vec<Item> = Vec::new();
        for name in &self.parts {
            let asked = Item::from_str(name, false).map_or(Item::value_variants().to_vec(), |item| vec![item]);
            asked.into_iter().for_each(|item| items.extend((!items.contains(&item)).then_some(item)));
        }
        items
    }

    /// The paper of this effort, with all that is given.
    fn paper(&self) -> paper::Paper {
        let effort = match (self.quick, self.full) {
            (true, _) => Effort::Quick,
            (_, true) => Effort::Full,
            _ => Effort::Usual,
        };
        let mut paper = paper::Paper::new(&self.out, effort);
        let paper::Paper { lines, surfaces, fine_lines, broad_lines, broad_surfaces, .. } = &mut paper;
        for rough in [&mut *lines, &mut *surfaces, &mut *fine_lines] {
            replace(&mut rough.hurst, sorted(&self.hurst));
            replace(&mut rough.loads, sorted(&self.loads));
        }
        for broad in [&mut *broad_lines, &mut *broad_surfaces] {
            replace(&mut broad.hurst, sorted(&self.hurst));
            replace(&mut broad.loads, sorted(&self.loads));
        }
        replace(&mut lines.points, self.line_points.into_iter().collect());
        replace(&mut surfaces.points, self.surface_points.clone());
        let (of_lines, of_surfaces) = (&self.line_seeds, &self.surface_seeds);
        for (old, given) in [
            (&mut lines.seeds, of_lines),
            (&mut fine_lines.seeds, of_lines),
            (&mut broad_lines.seeds, of_lines),
            (&mut surfaces.seeds, of_surfaces),
            (&mut broad_surfaces.seeds, of_surfaces),
        ] {
            let seeds = each_once(given);
            replace(old, if seeds.is_empty() { Vec::new() } else { vec![seeds] });
        }
        lines.cutoff = self.line_cutoff.unwrap_or(lines.cutoff);
        fine_lines.cutoff = lines.cutoff;
        surfaces.cutoff = self.surface_cutoff.unwrap_or(surfaces.cutoff);
        paper::Paper {
            tolerance: self.tolerance,
            workers: self.workers.map(NonZeroUsize::get),
            is_fresh: self.fresh,
            is_recorded: !self.no_record,
            ..paper
        }
    }
}

/// The names of all items, and of all together.
fn parts() -> PossibleValuesParser {
    let items = Item::value_variants().iter().filter_map(ValueEnum::to_possible_value);
    items.chain([PossibleValue::new("all").help("All of these")]).collect::<Vec<_>>().into()
}

/// Replaces the usual values by the given ones, if any.
fn replace<T>(usual: &mut Vec<T>, given: Vec<T>) {
    if !given.is_empty() {
        *usual = given;
    }
}

/// In order, each once.
fn sorted(values: &[f64]) -> Vec<f64> {
    let mut values = values.to_vec();
    values.sort_by(f64::total_cmp);
    values.dedup();
    values
}

fn each_once(seeds: &[RangeInclusive<u64>]) -> Vec<u64> {
    seeds.iter().cloned().flatten().collect::<BTreeSet<_>>().into_iter().collect()
}

/// `7` or `1-10`.
fn seeds(text: &str) -> Result<RangeInclusive<u64>, String> {
    let (first, last) = text.split_once('-').unwrap_or((text, text));
    let parse =
        |seed: &str| seed.trim().parse::<u64>().map_err(|_| format!("{seed:?} is not a seed: give whole numbers"));
    let seeds = parse(first)?..=parse(last)?;
    let count = seeds.end().saturating_sub(*seeds.start());
    match seeds.is_empty() || count > 100_000 {
        true => Err(format!("{text} is not a range of seeds, or has too many: give a range such as 1-10")),
        false => Ok(seeds),
    }
}

/// Shows which share of the nodes of an item is solved, and the time left.
fn show(bar: &ProgressBar, event: Event<'_>) {
    match event {
        Event::Begin { item, nodes } => {
            bar.reset();
            bar.set_length(nodes);
            bar.set_prefix(item.name());
            bar.enable_steady_tick(Duration::from_millis(200));
        }
        Event::Solved(Point { name, ny, nx, hurst, observables, .. }) => {
            let hurst = hurst.map_or(String::new(), |hurst| format!(", H = {hurst}"));
            bar.set_message(format!("{name}{hurst}, p* = {:.2e}", observables.reduced_pressure));
            bar.inc((ny * nx) as u64);
        }
        Event::End { item, new, points, seconds } => {
            bar.finish_and_clear();
            if new > 0 {
                let _ = writeln!(stdout(), "{}: {new} of {points} points solved in {seconds:.1} s", item.name());
            }
        }
    }
}

fn warn(Point { name, ny, nx, hurst, seed, observables, .. }: &Point) -> Result<()> {
    let [hurst, seed] = [hurst.unwrap_or(f64::NAN), seed.map_or(f64::NAN, |seed| seed as f64)];
    let (p, eta) = (observables.reduced_pressure, observables.certificate);
    let place = format!("{name}, {ny} x {nx} points, H {hurst}, seed {seed}, p* {p:.3e}");
    Ok(writeln!(stdout(), "not converged, excluded from all averages: {place}: certificate {eta:.1e}")?)
}
