//! What is studied, with all options resolved, and the points that are solved for it.

use super::super::{memory, method::Method, usage};
use super::bar::Bar;
use super::means::Points;
use super::options::Options;
use super::part::Part;
use super::rough::Rough;
use anyhow::Result;
use asperity::Stop;
use asperity::error::FileError;
use asperity::files::check_target;
use asperity::study::{Realisation, Row, Sweep, Table};
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::io::{Write, stdout};
use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::time::Instant;

/// Iterations at the most; a point takes some tens.
const MAX_ITERATIONS: usize = 2000;
/// Certificate of smooth indenters.
const SMOOTH_TOLERANCE: f64 = 1e-12;
/// The share of the free memory that sweeps may fill.
const MEMORY: f64 = 0.8;
/// More `kappa = a_rel/p*` than rough surfaces have at these loads, to tell memory.
const MOST_KAPPA: f64 = 4.0;
/// Least and largest reduced pressure, and the number of loads, as in the paper.
const LOADS: ([f64; 2], usize) = ([1e-3, 1e-1], 13);

/// What is studied.
pub struct Study {
    out: PathBuf,
    /// Rough lines.
    pub lines: Rough,
    /// Rough surfaces.
    pub surfaces: Rough,
    /// Points along a side of smooth surfaces: of Fig. 1, and of Table 1.
    pub smooth_surface: [usize; 2],
    tolerance: f64,
    workers: Option<usize>,
    fresh: bool,
    /// Whether recordings are made.
    #[cfg(feature = "record")]
    pub record: bool,
    /// Points above the tolerance.
    unconverged: RefCell<Vec<Row>>,
}

impl Study {
    /// Resolves `options`.
    pub fn new(options: &Options) -> Result<Self> {
        let hurst = sorted(&options.hurst);
        let count = options.size([4, 3, LOADS.1]);
        let loads = if options.loads.is_empty() { default_loads(count) } else { sorted(&options.loads) };
        let sides = || options.size([vec![256, 512], vec![16384], vec![2048, 4096]]);
        let lines = Rough {
            points: vec![options.line_points.unwrap_or(options.size([1 << 13, 1 << 18, 1 << 18]))],
            hurst: hurst.clone(),
            seeds: all_seeds(&options.line_seeds, options.size([3, 10, 10])),
            cutoff: options.line_cutoff.unwrap_or(options.size([1.0 / 64.0, 1.0 / 512.0, 1.0 / 512.0])),
            loads: loads.clone(),
        };
        let surfaces = Rough {
            points: if options.surface_points.is_empty() { sides() } else { options.surface_points.clone() },
            hurst,
            seeds: all_seeds(&options.surface_seeds, options.size([1, 1, 2])),
            cutoff: options.surface_cutoff.unwrap_or(options.size([1.0 / 16.0, 1.0 / 64.0, 1.0 / 64.0])),
            loads,
        };
        Ok(Self {
            out: options.out.clone(),
            lines,
            surfaces,
            smooth_surface: options.size([[1 << 10, 1 << 10], [1 << 13, 1 << 11], [1 << 13, 1 << 11]]),
            tolerance: options.tolerance,
            workers: options.workers,
            fresh: options.fresh,
            #[cfg(feature = "record")]
            record: !options.no_record,
            unconverged: RefCell::default(),
        })
    }

    /// The file of a part in the folder of all.
    pub fn file(&self, name: &str, ending: &str) -> PathBuf {
        self.out.join(format!("{name}.{ending}"))
    }

    /// When a solve ends. Contacts of single indenters may be so narrow that the rms height, which the certificate is over, is
    /// no measure of what happens in them: they are solved to less.
    pub fn stop(&self, part: Part) -> Result<Stop> {
        let tolerance = match part {
            Part::Table1 | Part::Fig1 | Part::Beyond => self.tolerance.min(SMOOTH_TOLERANCE),
            _ => self.tolerance,
        };
        Ok(Stop::new(tolerance, MAX_ITERATIONS)?)
    }

    /// Refuses what cannot be solved or does not fit in memory, and to replace the points of another study.
    pub fn check(&self, part: Part) -> Result<()> {
        if self.workers == Some(0) {
            return usage("--workers is 0: give a positive number of realisations to solve at a time");
        }
        if let Some(sides) = self.surfaces.points.windows(2).find(|sides| sides[0] >= sides[1]) {
            return usage(format!("--surface-points goes from {} to {}: give ever finer grids", sides[0], sides[1]));
        }
        let sweep = self.sweep(part)?;
        let needed = |realisation: &Realisation| memory::check(&realisation.grid, "a sweep", fields(realisation));
        sweep.realisations.iter().try_for_each(needed)?;
        sweep.check()?;
        if !self.fresh {
            sweep.check_table(&self.table(part))?;
        }
        Ok(())
    }

    /// Refuses a folder that cannot be made or written into.
    pub fn check_folder(&self) -> Result<()> {
        let folder = &self.out;
        if folder.is_file() {
            return usage(format!("--out names {}, which is a file: give a folder", folder.display()));
        }
        Ok(check_target(&if folder.is_dir() { self.file("comparison", "csv") } else { folder.clone() })?)
    }

    /// Makes the folder; with `--fresh`, removes the points of `parts`.
    pub fn prepare(&self, parts: &[Part]) -> Result<()> {
        let folder = &self.out;
        if !folder.is_dir() {
            std::fs::create_dir(folder).map_err(|source| FileError::Write { path: folder.into(), source })?;
        }
        let mut tables = parts.iter().filter(|_| self.fresh).flat_map(|part| part.tables());
        tables.try_for_each(|part| Ok(self.table(*part).clear()?))
    }

    /// The points of a part, solved now or before. Those above the tolerance are left out, and told in the end.
    pub fn points(&self, part: Part) -> Result<Points> {
        let sweep = self.sweep(part)?;
        let table = self.table(part);
        let new = sweep.points() - sweep.points_in(&table)?;
        let clock = Instant::now();
        let bar = Bar::new(part.name(), sweep.nodes());
        let points = sweep.run(&table, &|row| bar.add(row))?;
        drop(bar);
        if new > 0 {
            let seconds = clock.elapsed().as_secs_f64();
            writeln!(stdout(), "{}: {new} of {} points solved in {seconds:.1} s", part.name(), points.len())?;
        }
        let (converged, others) = points.into_iter().map(|timed| timed.row).partition(Row::is_converged);
        self.tell(others);
        Ok(Points(converged))
    }

    fn sweep(&self, part: Part) -> Result<Sweep> {
        let realisations = part.realisations(self)?;
        let most = realisations.iter().map(|realisation| memory::bytes(fields(realisation), &realisation.grid));
        let fit = memory::available().map_or(1.0, |free| MEMORY * free / most.fold(1.0, f64::max));
        let workers = self.workers.unwrap_or((fit as usize).clamp(1, rayon::current_num_threads()));
        Ok(Sweep { realisations, stop: self.stop(part)?, workers })
    }

    fn table(&self, part: Part) -> Table {
        Table::new(self.file(part.name(), "csv"))
    }

    /// Remembers points above the tolerance.
    fn tell(&self, rows: Vec<Row>) {
        let mut told = self.unconverged.borrow_mut();
        let new: Vec<Row> = rows.into_iter().filter(|row| !told.contains(row)).collect();
        told.extend(new);
    }

    /// The points above the tolerance.
    pub fn unconverged(&self) -> Vec<Row> {
        self.unconverged.borrow().clone()
    }
}

/// Fields that solving a realisation takes, the pressure of the load before included.
fn fields(realisation: &Realisation) -> f64 {
    let heaviest = realisation.loads.iter().fold(0.0, |most: f64, &load| most.max(load));
    let contact = (MOST_KAPPA * heaviest).min(1.0);
    memory::fields(Method::Multilevel, &realisation.grid, contact) + 1.0
}

fn default_loads(count: usize) -> Vec<f64> {
    let [low, high] = LOADS.0.map(f64::log10);
    let steps = count.max(2) - 1;
    let load = |i: usize| 10f64.powf(low + (high - low) * i as f64 / steps as f64);
    (0..count).map(load).collect()
}

/// In order, each once.
fn sorted(values: &[f64]) -> Vec<f64> {
    let mut values = values.to_vec();
    values.sort_by(f64::total_cmp);
    values.dedup();
    values
}

/// Each once; `1..=most` if none are named.
fn all_seeds(ranges: &[RangeInclusive<u64>], most: u64) -> Vec<u64> {
    let named: BTreeSet<u64> = ranges.iter().cloned().flatten().collect();
    if named.is_empty() { (1..=most).collect() } else { named.into_iter().collect() }
}
