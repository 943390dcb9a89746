//! `asperity surface`: makes a surface, or describes one.

use super::flags::Scene;
use super::outcome::Outcome;
use anyhow::Result;
use asperity::Surface;
use asperity::files::check_target;
use asperity::setup::Cost;
use asperity::surface::{Roughness, write_heights};
use clap::Args;
use serde::Serialize;
use std::io::{Write, stdout};
use std::path::PathBuf;

/// Fields that a surface takes while it is made and written: heights, spectrum, and the heights as given.
const FIELDS: f64 = 3.0;

#[derive(Args)]
pub struct Describe {
    #[command(flatten)]
    scene: Scene<false>,
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
    points: Vec<usize>,
    size: Vec<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    seed: Option<u64>,
    #[serde(flatten)]
    roughness: Roughness,
}

impl Describe {
    pub fn run(&self) -> Result<Outcome> {
        if let Some(path) = &self.out {
            check_target(path)?;
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
        let statistics = Statistics::of(&surface, rank);
        let mut out = stdout();
        if self.json {
            writeln!(out, "{}", serde_json::to_string(&statistics)?)?;
        } else {
            statistics.write(&recipe.description(), &mut out)?;
        }
        Ok(Outcome::Done)
    }
}

impl Statistics {
    fn of(surface: &Surface, rank: usize) -> Self {
        let (grid, outer) = (surface.grid(), 2 - rank);
        let (points, size) = (grid.shape()[outer..].to_vec(), grid.size()[outer..].to_vec());
        Self { points, size, seed: surface.seed(), roughness: Roughness::of(surface) }
    }

    fn write(&self, description: &str, out: &mut impl Write) -> std::io::Result<()> {
        let join = |values: Vec<String>| values.join(" x ");
        writeln!(out, "{description}")?;
        writeln!(out, "  points         {}", join(self.points.iter().map(usize::to_string).collect()))?;
        writeln!(out, "  size           {}", join(self.size.iter().map(f64::to_string).collect()))?;
        let Roughness { rms_height, rms_gradient, rms_curvature, peak, valley, skewness, kurtosis } = self.roughness;
        let rows = [
            ("rms height", rms_height),
            ("rms gradient", rms_gradient),
            ("rms curvature", rms_curvature),
            ("highest peak", peak),
            ("deepest valley", valley),
            ("skewness", skewness),
            ("kurtosis", kurtosis),
        ];
        for (name, value) in rows {
            writeln!(out, "  {name:<14} {value:.6e}")?;
        }
        Ok(())
    }
}
