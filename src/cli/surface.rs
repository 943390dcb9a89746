//! `asperity surface`: makes a surface, or describes one.

use super::caution;
use super::flags::{OfSurface, Scene};
use super::outcome::Outcome;
use super::output::{write_json, write_rows};
use super::subject::along_axes;
use super::wrote::wrote;
use anyhow::Result;
use asperity::Grid;
use asperity::error::FileError;
use asperity::files::check_named;
use asperity::setup::{Cost, Recipe};
use asperity::surface::{Field, Measurement, Roughness, Scan};
use clap::Args;
use serde::Serialize;
use std::io::{self, Write, stdout};
use std::path::{Path, PathBuf};

/// Fields that a surface takes while it is made and written: heights, spectrum, and the heights as given.
const FIELDS: f64 = 3.0;

const EXAMPLES: &str = "\
Examples:
  asperity surface patch.x3p --fill harmonic --detrend curvature --out flat.npy
  asperity surface --indenter sphere --radius 1mm --points 256,256 --size 100um --json";

#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Describe {
    #[command(flatten)]
    scene: Scene<OfSurface>,
    /// Write the heights in metres, as the ending of the name says: .npy, .sdf, .x3p or .xyz
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    out: Option<PathBuf>,
    /// Print one JSON object instead of a table
    #[arg(long, help_heading = "Output")]
    json: bool,
}

/// The statistics of a surface as they are printed.
#[derive(Serialize)]
struct Statistics {
    /// The parts of the surface, such as a file, in words.
    source: String,
    /// What the file of heights says.
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<Origin>,
    points: Vec<usize>,
    size: Vec<f64>,
    /// Distances of rows and columns, or of the nodes of a line.
    spacing: Vec<f64>,
    /// What the steps of the preparation came to.
    steps: Vec<String>,
    voids: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    seed: Option<u64>,
    /// What there is to say of heights without voids.
    #[serde(flatten)]
    whole: Option<Whole>,
    warnings: Vec<String>,
}

/// What a file of heights says of itself.
#[derive(Serialize)]
struct Origin {
    format: &'static str,
    channels: Vec<String>,
    channel: String,
    /// Whether the file says its units, and lengths are metres.
    is_in_metres: bool,
    header: Vec<(String, String)>,
}

/// The statistics of heights without voids.
#[derive(Serialize)]
struct Whole {
    /// Jumps across the period along y and x, or of a line along it.
    jump_in_rms_steps: Vec<f64>,
    #[serde(flatten)]
    roughness: Roughness,
}

impl Describe {
    pub fn run(&self) -> Result<Outcome> {
        if let Some(path) = &self.out {
            check_named(path, &Scan::endings())?;
        }
        let (recipe, cell) = self.scene.table()?.surface()?;
        let grid = recipe.grid(&cell)?;
        recipe.check(&grid)?;
        Cost::of_fields(&grid, FIELDS).check("a surface")?;
        let (statistics, height) = describe(&recipe, &grid, 2 - recipe.rank(&cell)?)?;
        if let Some(path) = &self.out {
            statistics.check_unit(&recipe, path)?;
            scan(height, &grid).write(path)?;
        }
        if self.json {
            write_json(&statistics, &mut stdout())?
        } else {
            statistics.write(&mut stdout())?
        }
        caution::tell(&statistics.warnings);
        self.out.iter().for_each(|path| wrote(path));
        Ok(Outcome::Done)
    }
}

/// The statistics of a surface from an axis on, and its heights, NaN where they are void.
fn describe(recipe: &Recipe, grid: &Grid, outer: usize) -> Result<(Statistics, Field)> {
    let read = |path: &PathBuf| -> Result<_> { Ok((Origin::read(path, recipe)?, recipe.prepared(path, grid)?)) };
    let (file, prepared) = recipe.height.as_ref().map(read).transpose()?.unzip();
    let voids = prepared.as_ref().map_or(0, |it| it.scan.voids());
    let mut statistics = Statistics {
        source: recipe.description(),
        warnings: file.iter().filter_map(|it| it.unit_warning(recipe)).collect(),
        file,
        points: grid.shape()[outer..].to_vec(),
        size: grid.size()[outer..].to_vec(),
        spacing: grid.spacing()[outer..].to_vec(),
        steps: prepared.as_ref().map(|it| it.told.clone()).unwrap_or_default(),
        voids,
        seed: recipe.spectrum.map(|_| recipe.seed()),
        whole: None,
    };
    if let Some(prepared) = prepared.filter(|_| voids > 0) {
        statistics.warnings.push(caution::of_voids(voids, grid.len()));
        return Ok((statistics, prepared.scan.height));
    }
    let surface = recipe.surface(*grid)?;
    let (jump_in_rms_steps, roughness) = (surface.jumps()[outer..].to_vec(), Roughness::of(&surface));
    statistics.whole = Some(Whole { jump_in_rms_steps, roughness });
    statistics.warnings.extend(caution::of_surface(recipe, &surface));
    Ok((statistics, surface.heights_as_given()))
}

/// Heights that fill a grid, of which they may have fewer points than it.
fn scan(height: Field, grid: &Grid) -> Scan {
    let (points, size) = ([height.nrows(), height.ncols()], grid.size());
    Scan { height, spacing: [0, 1].map(|axis| size[axis] / points[axis] as f64) }
}

impl Origin {
    fn read(path: &Path, recipe: &Recipe) -> Result<Self> {
        let Measurement { format, channels, channel, is_in_metres, header, .. } =
            Measurement::read(path, recipe.channel.as_deref())?;
        Ok(Self { format, channels, channel, is_in_metres, header })
    }

    /// Whether lengths are metres as far as anybody says.
    fn has_unit(&self, recipe: &Recipe) -> bool {
        self.is_in_metres || recipe.file_unit.is_some() || self.format == "NumPy"
    }

    /// The warning that lengths are in a unit that nobody knows.
    fn unit_warning(&self, recipe: &Recipe) -> Option<String> {
        (!self.has_unit(recipe)).then(|| {
            "the file does not say its units, so that its heights are taken as they are: give them by --file-unit, such as 1um".into()
        })
    }

    fn rows(&self) -> Vec<(String, String)> {
        let unit = if self.is_in_metres { "metres" } else { "not said by the file" };
        let channel = match self.channels.as_slice() {
            [one] => one.clone(),
            all => format!("{}, one of {}: choose by --channel", self.channel, all.join(", ")),
        };
        let rows = [("format", self.format.to_owned()), ("channel", channel), ("lengths", unit.to_owned())];
        rows.map(|(name, value)| (name.to_owned(), value)).into_iter().chain(self.header.clone()).collect()
    }
}

impl Statistics {
    /// Refuses a format that is in metres for heights in a unit that nobody knows.
    fn check_unit(&self, recipe: &Recipe, path: &Path) -> Result<(), FileError> {
        let is_array = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("npy"));
        if is_array || self.file.as_ref().is_none_or(|it| it.has_unit(recipe)) {
            return Ok(());
        }
        let reason =
            "it would be in metres, and the height file does not say its units: give them by --file-unit, such as 1um";
        Err(FileError::Target { path: path.into(), reason: reason.into() })
    }

    fn write(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "{}", self.source)?;
        write_rows(self.file.iter().flat_map(Origin::rows), out)?;
        let join = |values: Vec<String>| values.join(" x ");
        let rows = [
            ("points", join(self.points.iter().map(usize::to_string).collect())),
            ("size", join(self.size.iter().map(f64::to_string).collect())),
            ("spacing", along_axes(&self.spacing, number)),
            ("voids", self.voids.to_string()),
        ];
        write_rows(rows.map(|(name, value)| (name.to_owned(), value)), out)?;
        write_rows(self.steps.iter().map(|step| ("prepared".to_owned(), step.clone())), out)?;
        write_rows(self.whole.iter().flat_map(Whole::rows), out)
    }
}

impl Whole {
    fn rows(&self) -> Vec<(String, String)> {
        let Roughness { rms_height, rms_gradient, rms_curvature, peak, valley, skewness, kurtosis } = self.roughness;
        let jumps = along_axes(&self.jump_in_rms_steps, |jump| format!("{jump:.3}"));
        let rows = [
            ("jump across the period", format!("{jumps} rms steps")),
            ("rms height", number(rms_height)),
            ("rms gradient", number(rms_gradient)),
            ("rms curvature", number(rms_curvature)),
            ("highest peak", number(peak)),
            ("deepest valley", number(valley)),
            ("skewness", number(skewness)),
            ("kurtosis", number(kurtosis)),
        ];
        rows.map(|(name, value)| (name.to_owned(), value)).into()
    }
}

fn number(value: f64) -> String {
    format!("{value:.6e}")
}
