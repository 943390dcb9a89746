//! The options of the command.

use std::ops::RangeInclusive;
use std::path::PathBuf;

/// What is studied, and where it goes. Lengths are those of the paper: a roll-off of 20 um, of which 8 fit a line and 4 a side
/// of a surface.
#[derive(clap::Args)]
pub struct Options {
    /// Folder of all files
    #[arg(long, value_name = "DIR", default_value = "paper")]
    pub out: PathBuf,
    /// Hurst exponents
    #[arg(long, value_name = "H,H,...", value_delimiter = ',', default_values_t = [0.2, 0.5, 0.8], allow_negative_numbers = true)]
    pub hurst: Vec<f64>,
    /// Reduced pressures p* of rough lines and surfaces [default: 13 from 1e-3 to 1e-1; with --full 1e-3, 1e-2, 1e-1]
    #[arg(long, value_name = "P,P,...", value_delimiter = ',', allow_negative_numbers = true)]
    pub loads: Vec<f64>,
    /// Seeds of rough lines, such as 1-10 or 3,5,8 [default: 1-10]
    #[arg(long, value_name = "SEEDS", value_delimiter = ',', value_parser = seeds)]
    pub line_seeds: Vec<RangeInclusive<u64>>,
    /// Seeds of rough surfaces [default: 1-2; with --full 1]
    #[arg(long, value_name = "SEEDS", value_delimiter = ',', value_parser = seeds)]
    pub surface_seeds: Vec<RangeInclusive<u64>>,
    /// Points of a rough line [default: 262144]
    #[arg(long, value_name = "N")]
    pub line_points: Option<usize>,
    /// Points along a side of rough surfaces, coarsest first; from two on, values are extrapolated in the spacing
    /// [default: 2048,4096, that is 8 and 16 per shortest wavelength; with --full the paper's 16384, that is 64]
    #[arg(long, value_name = "N,N,...", value_delimiter = ',')]
    pub surface_points: Vec<usize>,
    /// Shortest wavelength of rough lines, as a share of the roll-off [default: 1/512]
    #[arg(long, value_name = "SHARE", allow_negative_numbers = true)]
    pub line_cutoff: Option<f64>,
    /// Shortest wavelength of rough surfaces, as a share of the roll-off [default: 1/64]
    #[arg(long, value_name = "SHARE", allow_negative_numbers = true)]
    pub surface_cutoff: Option<f64>,
    /// Certificate eta of each point
    #[arg(long, value_name = "ETA", default_value = "1e-8", allow_negative_numbers = true)]
    pub tolerance: f64,
    /// Realisations solved at a time [default: as many as there are threads, if they fit in memory]
    #[arg(long, value_name = "N")]
    pub workers: Option<usize>,
    /// Small grids, short spectra and few loads, to see that it works
    #[arg(long, conflicts_with = "full")]
    pub quick: bool,
    /// Rough surfaces at the paper's own size, 16384 points a side, one for each Hurst exponent
    #[arg(long)]
    pub full: bool,
    /// Solve all points again, and replace those that are there
    #[arg(long)]
    pub fresh: bool,
    /// Write no recordings
    #[cfg(feature = "record")]
    #[arg(long)]
    pub no_record: bool,
}

impl Options {
    /// What suits `--quick`, `--full` or neither.
    pub fn size<T>(&self, [quick, full, usual]: [T; 3]) -> T {
        match (self.quick, self.full) {
            (true, _) => quick,
            (_, true) => full,
            _ => usual,
        }
    }
}

/// `7` or `1-10`.
fn seeds(text: &str) -> Result<RangeInclusive<u64>, String> {
    let (first, last) = text.split_once('-').unwrap_or((text, text));
    let parse = |seed: &str| seed.trim().parse::<u64>().map_err(|_| format!("{seed:?} is no seed: give whole numbers"));
    let seeds = parse(first)?..=parse(last)?;
    let count = seeds.end().saturating_sub(*seeds.start());
    match seeds.is_empty() || count > 100_000 {
        true => Err(format!("{text} holds no seeds, or too many: give a range such as 1-10")),
        false => Ok(seeds),
    }
}
