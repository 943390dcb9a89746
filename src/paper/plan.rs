//! The surfaces and loads that the paper is made again with.

use super::breadths::Breadths;
use super::comparison::Comparison;
use super::item::Item;
use super::rough::Rough;
use super::{beyond, fig1, persson, table1};
use crate::contact::Stop;
use crate::error::{FileError, SetupError, StudyError};
use crate::files::check_target;
use crate::setup::{Cost, Extras, available_bytes};
use crate::study::{Realisation, Sweep, Table};
use std::path::PathBuf;

/// Least and largest reduced pressure, as in the paper.
const LOADS: [f64; 2] = [1e-3, 1e-1];
/// Smallest and largest reduced pressure at which the continuum values of lines are reported.
const WIDE_LOADS: [f64; 2] = [1e-4, 0.316_227_766_016_837_94];
/// Nayak's parameters of spectra.
const BREADTHS: [f64; 7] = [3.0, 6.0, 12.0, 25.0, 50.0, 100.0, 200.0];
/// Largest number of iterations; a point takes some tens.
const MAX_ITERATIONS: usize = 2000;
/// Certificate of smooth indenters. Their contacts may be so narrow that the rms height, which the certificate is over, is no
/// measure of what happens in them.
const SMOOTH_TOLERANCE: f64 = 1e-12;
/// The share of the free memory that sweeps may fill.
const MEMORY: f64 = 0.8;

/// The surfaces and loads that the paper is made again with, and the folder of all files.
///
/// A run that was killed continues when it is started again, and its tables are the same to the last bit.
#[derive(Debug, Clone, PartialEq)]
pub struct Paper {
    /// Folder for all files; made if it is not there.
    pub folder: PathBuf,
    /// Rough lines.
    pub lines: Rough,
    /// Rough surfaces.
    pub surfaces: Rough,
    /// Rough lines on several grids and under a wider range of loads, to find the continuum values.
    pub fine_lines: Rough,
    /// Rough lines and surfaces of several Nayak's parameters.
    pub broad_lines: Breadths,
    /// See [`Paper::broad_lines`].
    pub broad_surfaces: Breadths,
    /// Points along a side of spheres: of Fig. 1, and of Table 1.
    pub sphere_sides: [usize; 2],
    /// Certificate `eta` of each point; smooth indenters have one of at most `1e-12`.
    pub tolerance: f64,
    /// Realisations solved at a time; without a number as many as there are threads, if they fit in memory.
    pub workers: Option<usize>,
    /// Whether all points are solved again, and replace earlier ones.
    pub is_fresh: bool,
    /// Whether recordings are written.
    #[cfg(feature = "record")]
    pub is_recorded: bool,
}

/// How large grids are, and how many surfaces and loads there are.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Effort {
    /// Use small grids, short spectra and few loads, as a quick test.
    Quick,
    /// Rough surfaces of up to 8192 points per side, 32 per shortest wavelength, on three grids to extrapolate from.
    Usual,
    /// Rough surfaces of 16384 points per side, the size of the paper as its `eps_c` is read, one for each Hurst
    /// exponent.
    Full,
}

impl Paper {
    /// The paper's own Hurst exponents, with as many points, seeds and loads as an effort allows.
    pub fn new(folder: impl Into<PathBuf>, effort: Effort) -> Self {
        let hurst = vec![0.2, 0.5, 0.8];
        let loads = between(LOADS, effort.choose([4, 13, 3]));
        let lines = Rough {
            points: vec![effort.choose([1 << 13, 1 << 18, 1 << 18])],
            hurst: hurst.clone(),
            seeds: vec![seeds(effort.choose([3, 10, 10]))],
            cutoff: 1.0 / effort.choose([64.0, 512.0, 512.0]),
            loads: loads.clone(),
        };
        let fine_lines = Rough {
            points: effort.choose([[12, 13, 14], [16, 18, 20], [16, 18, 20]]).map(|power| 1 << power).into(),
            loads: between(WIDE_LOADS, effort.choose([3, 8, 8])),
            ..lines.clone()
        };
        let surfaces = Rough {
            points: effort.choose([vec![128, 256, 512], vec![2048, 4096, 8192], vec![16384]]),
            hurst,
            seeds: effort.choose([&[3, 2, 2][..], &[6, 4, 2], &[1]]).iter().map(|&count| seeds(count)).collect(),
            cutoff: 1.0 / effort.choose([16.0, 64.0, 64.0]),
            // every third load of lines, or every one of few
            loads: loads.into_iter().step_by(effort.choose([1, 3, 1])).collect(),
        };
        Self {
            folder: folder.into(),
            lines,
            surfaces,
            fine_lines,
            broad_lines: broad_lines(effort),
            broad_surfaces: broad_surfaces(effort),
            sphere_sides: effort.choose([[1 << 10, 1 << 10], [1 << 13, 1 << 11], [1 << 13, 1 << 11]]),
            tolerance: 1e-8,
            workers: None,
            is_fresh: false,
            #[cfg(feature = "record")]
            is_recorded: true,
        }
    }

    /// Refuses a folder that cannot be written into, surfaces and loads that cannot be or do not fit in memory, and to replace
    /// the points of another study.
    pub(super) fn check(&self, items: &[Item]) -> Result<(), StudyError> {
        if self.folder.is_file() {
            let reason = "it is a file: give a folder".into();
            return Err(FileError::Target { path: self.folder.clone(), reason }.into());
        }
        let comparison = self.file("comparison.csv");
        check_target(if self.folder.is_dir() { &comparison } else { &self.folder })?;
        Comparison::read(&comparison)?;
        self.lines.check()?;
        self.surfaces.check()?;
        self.fine_lines.check()?;
        if items.contains(&Item::Nayak) {
            self.broad_lines.check()?;
            self.broad_surfaces.check()?;
        }
        for &item in items {
            self.sweep(item)?.check_cost()?;
        }
        for &source in items.iter().flat_map(|item| item.sources()) {
            let sweep = self.sweep(source)?;
            sweep.check_cost()?;
            if !self.is_fresh {
                sweep.check_table(&self.table(source))?;
            }
        }
        Ok(())
    }

    /// Makes the folder; for a fresh run, removes the points of `items`.
    pub(super) fn prepare(&self, items: &[Item]) -> Result<(), FileError> {
        let folder = &self.folder;
        if !folder.is_dir() {
            std::fs::create_dir(folder).map_err(|source| FileError::Write { path: folder.into(), source })?;
        }
        let mut sources = items.iter().filter(|_| self.is_fresh).flat_map(|item| item.sources());
        sources.try_for_each(|&source| self.table(source).clear())
    }

    /// The surfaces and loads of an item, as many at a time as fit in memory.
    pub(super) fn sweep(&self, item: Item) -> Result<Sweep, StudyError> {
        let realisations = match item {
            Item::Table1 => table1::realisations(self.sphere_sides[1]),
            Item::Fig1 => fig1::realisations(self.sphere_sides[0]),
            Item::Fig2 => self.lines.lines(),
            Item::Fig4 => self.surfaces.surfaces(),
            Item::Beyond => beyond::realisations(),
            Item::Hurst => self.fine_lines.lines(),
            Item::Persson => persson::realisations([&self.lines, &self.surfaces]),
            Item::Nayak => {
                let [lines, surfaces] = [&self.broad_lines, &self.broad_surfaces].map(Breadths::realisations);
                lines.into_iter().chain(surfaces).collect()
            }
            Item::Fig3 | Item::Fig5 | Item::Gw => Vec::new(),
        };
        let realisations = self.stopping(item, realisations)?;
        let mut bytes = 1.0f64;
        for realisation in &realisations {
            let cost = realisation.setup.cost(&Extras::default())?;
            // the pressure of the load before included
            bytes = bytes.max(cost.bytes + Cost::from_fields(&cost.grid, 1.0).bytes);
        }
        let fit = available_bytes().map_or(1.0, |free| MEMORY * free / bytes);
        let workers = self.workers.unwrap_or((fit as usize).clamp(1, rayon::current_num_threads()));
        Ok(Sweep { realisations, workers, memory: None })
    }

    /// Realisations of an item, solved to its certificate.
    pub(super) fn stopping(&self, item: Item, realisations: Vec<Realisation>) -> Result<Vec<Realisation>, SetupError> {
        let is_smooth = matches!(item, Item::Table1 | Item::Fig1 | Item::Beyond);
        let tolerance = if is_smooth { self.tolerance.min(SMOOTH_TOLERANCE) } else { self.tolerance };
        let stop = Stop::new(tolerance, MAX_ITERATIONS)?;
        let stopping = |mut realisation: Realisation| {
            realisation.setup.stop = stop;
            realisation
        };
        Ok(realisations.into_iter().map(stopping).collect())
    }

    /// The table of the points of an item.
    pub(super) fn table(&self, item: Item) -> Table {
        Table::new(self.file(&format!("{}.csv", item.name())))
    }

    /// A file in the folder of all.
    pub(super) fn file(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }
}

/// Lines of two Hurst exponents, whose spectra span up to four decades at the lower one.
fn broad_lines(effort: Effort) -> Breadths {
    let counts: [&[u64]; 3] = [&[6, 6, 6], &[10, 10, 5], &[20, 20, 10]];
    let loads: [&[f64]; 3] = [&[0.01, 0.1], &[0.001, 0.01, 0.03, 0.1, 0.3], &[0.001, 0.01, 0.03, 0.1, 0.3]];
    Breadths {
        is_line: true,
        hurst: vec![0.3, 0.8],
        nayak: effort.choose([&[3.0, 12.0, 30.0][..], &BREADTHS, &BREADTHS]).to_vec(),
        points_per_wave: effort.choose([[8, 16, 32], [16, 32, 64], [16, 32, 64]]).to_vec(),
        least: effort.choose([1 << 12, 1 << 15, 1 << 16]),
        largest: 1 << 22,
        seeds: effort.choose(counts).iter().map(|&count| seeds(count)).collect(),
        loads: effort.choose(loads).to_vec(),
    }
}

/// Surfaces of two Hurst exponents; at the lower one only narrow spectra fit on a grid.
fn broad_surfaces(effort: Effort) -> Breadths {
    let counts: [&[u64]; 3] = [&[4, 4], &[6, 4, 2], &[10, 6, 3]];
    let loads: [&[f64]; 3] = [&[0.01, 0.1], &[0.01, 0.03, 0.1, 0.3], &[0.01, 0.03, 0.1, 0.3]];
    Breadths {
        is_line: false,
        hurst: vec![0.3, 0.8],
        nayak: effort.choose([&[3.0, 6.0, 12.0][..], &BREADTHS, &BREADTHS]).to_vec(),
        points_per_wave: effort.choose([&[4, 8][..], &[4, 8, 16], &[4, 8, 16]]).to_vec(),
        least: effort.choose([256, 512, 1024]),
        largest: effort.choose([1 << 10, 1 << 13, 1 << 14]),
        seeds: effort.choose(counts).iter().map(|&count| seeds(count)).collect(),
        loads: effort.choose(loads).to_vec(),
    }
}

/// Seeds from 1.
fn seeds(count: u64) -> Vec<u64> {
    (1..=count).collect()
}

/// Reduced pressures equally far apart in their logarithm.
fn between(ends: [f64; 2], count: usize) -> Vec<f64> {
    let [low, high] = ends.map(f64::log10);
    (0..count).map(|i| 10f64.powf(low + (high - low) * i as f64 / (count - 1) as f64)).collect()
}

impl Effort {
    /// The value that suits the effort.
    fn choose<T>(self, [quick, usual, full]: [T; 3]) -> T {
        match self {
            Self::Quick => quick,
            Self::Usual => usual,
            Self::Full => full,
        }
    }
}
