//! `asperity surface`: makes a surface, or describes one.

use super::caution;
use super::flags::{OfSurface, Scene};
use super::outcome::Outcome;
use super::output::{write_json, write_rows};
use super::subject::along_axes;
use super::wrote::wrote;
use anyhow::Result;
use asperity::files::check_named;
use asperity::setup::Cost;
use asperity::surface::{Roughness, write_heights};
use clap::Args;
use serde::Serialize;
use std::io::{self, Write, stdout};
use std::path::PathBuf;

/// Fields that a surface takes while it is made and written: heights, spectrum, and the heights as given.
const FIELDS: f64 = 3.0;

const EXAMPLES: &str = "\
Examples:
  asperity surface --height profile.txt --size 160um --detrend plane --out flat.npy
  asperity surface --indenter sphere --radius 1mm --points 256,256 --size 100um --json";

#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Describe {
    #[command(flatten)]
    scene: Scene<OfSurface>,
    /// Write the heights
    #[arg(long, value_name = "FILE.npy", help_heading = "Output")]
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
    points: Vec<usize>,
    size: Vec<f64>,
    /// Distances of rows and columns, or of the nodes of a line.
    spacing: Vec<f64>,
    /// Jumps across the period along the same axes.
    jump_in_rms_steps: Vec<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    seed: Option<u64>,
    #[serde(flatten)]
    roughness: Roughness,
    warnings: Vec<String>,
}

impl Describe {
    pub fn run(&self) -> Result<Outcome> {
        if let Some(path) = &self.out {
            check_named(path, &["npy"])?;
        }
        let (recipe, cell) = self.scene.table()?.surface()?;
        let grid = recipe.grid(&cell)?;
        recipe.check(&grid)?;
        Cost::of_fields(&grid, FIELDS).check("a surface")?;
        let (surface, rank) = (recipe.surface(grid)?, recipe.rank(&cell)?);
        if let Some(path) = &self.out {
            let height = surface.heights_as_given();
            write_heights(path, if rank == 1 { height.row(0).into_dyn() } else { height.view().into_dyn() })?;
        }
        let outer = 2 - rank;
        let statistics = Statistics {
            points: grid.shape()[outer..].to_vec(),
            source: recipe.description(),
            size: grid.size()[outer..].to_vec(),
            spacing: grid.spacing()[outer..].to_vec(),
            jump_in_rms_steps: surface.jumps()[outer..].to_vec(),
            seed: surface.seed(),
            roughness: Roughness::of(&surface),
            warnings: caution::of_surface(&recipe, &surface),
        };
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

impl Statistics {
    fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let join = |values: Vec<String>| values.join(" x ");
        let Roughness { rms_height, rms_gradient, rms_curvature, peak, valley, skewness, kurtosis } = self.roughness;
        let number = |value: f64| format!("{value:.6e}");
        let rows = [
            ("points", join(self.points.iter().map(usize::to_string).collect())),
            ("size", join(self.size.iter().map(f64::to_string).collect())),
            ("spacing", along_axes(&self.spacing, number)),
            (
                "jump across the period",
                format!("{} rms steps", along_axes(&self.jump_in_rms_steps, |jump| format!("{jump:.3}"))),
            ),
            ("rms height", number(rms_height)),
            ("rms gradient", number(rms_gradient)),
            ("rms curvature", number(rms_curvature)),
            ("highest peak", number(peak)),
            ("deepest valley", number(valley)),
            ("skewness", number(skewness)),
            ("kurtosis", number(kurtosis)),
        ];
        writeln!(out, "{}", self.source)?;
        write_rows(rows.map(|(name, value)| (name.to_owned(), value)), out)
    }
}
