//! `asperity surface`: makes a surface, or describes one.

use super::Outcome;
use super::memory;
use super::source::{Made, Source};
use anyhow::Result;
use asperity::Surface;
use asperity::files::check_target;
use asperity::surface::{Roughness, write_heights};
use clap::Args;
use serde::Serialize;
use std::io::{Write, stdout};
use std::path::PathBuf;

/// Fields that a surface takes while it is made and written: heights, spectrum, and the heights as given.
const FIELDS: f64 = 3.0;

/// Makes a surface and prints its statistics, or prints those of a file.
#[derive(Args)]
pub struct Describe {
    #[command(flatten)]
    source: Source,
    /// Write the heights
    #[arg(long, value_name = "FILE.npy", help_heading = "Output")]
    out: Option<PathBuf>,
    /// Print one JSON object instead of a table
    #[arg(long, help_heading = "Output")]
    json: bool,
}

#[derive(Serialize)]
struct Statistics {
    points: Vec<usize>,
    size: Vec<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    seed: Option<u64>,
    rms_height: f64,
    rms_gradient: f64,
    rms_curvature: f64,
    peak: f64,
    valley: f64,
    skewness: f64,
    kurtosis: f64,
}

impl Describe {
    /// Runs the command.
    pub fn run(&self) -> Result<Outcome> {
        if let Some(path) = &self.out {
            check_target(path)?;
        }
        memory::check(&self.source.check()?, "a surface", FIELDS)?;
        let (surface, made) = self.source.surface()?;
        if let Some(path) = &self.out {
            let height = surface.heights_as_given();
            if made.rank == 1 {
                write_heights(path, height.row(0).into_dyn())?;
            } else {
                write_heights(path, height.view().into_dyn())?;
            }
        }
        let statistics = Statistics::of(&surface, &made);
        let mut out = stdout();
        if self.json {
            writeln!(out, "{}", serde_json::to_string(&statistics)?)?;
        } else {
            statistics.write(&made.description, &mut out)?;
        }
        Ok(Outcome::Done)
    }
}

impl Statistics {
    fn of(surface: &Surface, made: &Made) -> Self {
        let grid = surface.grid();
        let outer = if made.rank == 1 { 1 } else { 0 };
        let Roughness { rms_height, rms_gradient, rms_curvature, peak, valley, skewness, kurtosis } =
            Roughness::of(surface);
        Self {
            points: grid.shape()[outer..].to_vec(),
            size: grid.size()[outer..].to_vec(),
            seed: surface.seed(),
            rms_height,
            rms_gradient,
            rms_curvature,
            peak,
            valley,
            skewness,
            kurtosis,
        }
    }

    fn write(&self, description: &str, out: &mut impl Write) -> std::io::Result<()> {
        let join = |values: Vec<String>| values.join(" x ");
        writeln!(out, "{description}")?;
        writeln!(out, "  points         {}", join(self.points.iter().map(usize::to_string).collect()))?;
        writeln!(out, "  size           {}", join(self.size.iter().map(f64::to_string).collect()))?;
        let rows = [
            ("rms height", self.rms_height),
            ("rms gradient", self.rms_gradient),
            ("rms curvature", self.rms_curvature),
            ("highest peak", self.peak),
            ("deepest valley", self.valley),
            ("skewness", self.skewness),
            ("kurtosis", self.kurtosis),
        ];
        for (name, value) in rows {
            writeln!(out, "  {name:<14} {value:.6e}")?;
        }
        Ok(())
    }
}
