//! `asperity accuracy`: error against run time.

use super::choice::choice;
use super::choice::count;
use super::exit_status::{ExitStatus, usage};
use super::progress::bar;
use super::terminal::stdout;
use super::wrote::wrote;
use anyhow::Result;
use asperity::contact::Stop;
use asperity::error::FileError;
use asperity::files::check_target;
use asperity::lab::accuracy::{AccuracyScene, Experiment, Measurements, figure, write_rows};
use asperity::plot::{write_png, write_svg};
use asperity::setup::Part;
use clap::{Args, ValueEnum};
use std::io::Write;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

const HELP: &str = "\
Examples:
  asperity accuracy sine --quick
  asperity accuracy sphere rough-line --out accuracy

The table separates three errors, all relative:
  algebraic       of a step, compared with the solution on the same grid
  discretisation  of a grid, compared with the exact solution, or with a grid four times finer than the finest,
                  whose own error can be a quarter of that of the finest grid
  model           of a theory, compared with the same reference
Area and kappa_r are those with contact edges interpolated between grid nodes; errors with counted nodes are beside them.";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Accuracy {
    /// Scenes to solve, in the given order
    #[arg(value_enum, value_name = "SCENE", default_values_t = AccuracyScene::value_variants().to_vec())]
    scenes: Vec<AccuracyScene>,
    /// Points along each side of the grids, coarsest first [default: depends on the scene]
    #[arg(long, value_name = "N,N,...", value_delimiter = ',')]
    points: Vec<usize>,
    /// Certificate eta at which the curves stop
    #[arg(long, value_name = "ETA", default_value = "1e-10")]
    tolerance: f64,
    /// Certificate eta of the reference solutions, if rounding allows it
    #[arg(long, value_name = "ETA", default_value = "1e-13")]
    reference_tolerance: f64,
    /// Largest number of iterations
    #[arg(long, value_name = "N", default_value_t = 100_000)]
    max_iterations: usize,
    /// Seed of the rough surfaces
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Measure each curve N times, after a warm-up run; the median time is reported
    #[arg(long, value_name = "N", default_value = "3", value_parser = count)]
    repeats: NonZeroUsize,
    /// Use smaller grids
    #[arg(long, conflicts_with = "points")]
    quick: bool,
    /// Write accuracy.csv and one figure per scene, as SVG and PNG, into this folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Record the solvers side by side on the finest grid of each scene, into the same folder
    #[arg(long, requires = "out")]
    record: bool,
    /// Parts to record, as for `solve`
    #[arg(long, value_name = "PART[,PART]", value_delimiter = ',', requires = "record", value_parser = choice::<Part>())]
    record_what: Vec<Part>,
}

impl Accuracy {
    pub(crate) fn run(&self) -> Result<ExitStatus> {
        let experiments = self.scenes.iter().map(|scene| self.experiment(*scene)).collect::<Result<Vec<_>>>()?;
        experiments.iter().try_for_each(Experiment::check)?;
        if let Some(folder) = &self.out {
            make_folder(folder)?;
        }
        writeln!(
            stdout(),
            "Times are of the solver alone, without recording: median of {} runs after a warm-up, {} threads",
            self.repeats,
            rayon::current_num_threads()
        )?;
        let mut all = Vec::new();
        for experiment in &experiments {
            let findings = experiment.run(bar)?;
            write!(stdout(), "\n{findings}")?;
            all.push(findings);
            if let Some(folder) = &self.out {
                write_files(folder, &all)?;
                if self.record {
                    let path = folder.join(format!("{}.rrd", experiment.scene.name()));
                    asperity::lab::accuracy::record(&path, experiment, &self.record_what, bar)?;
                }
            }
        }
        self.out.iter().for_each(|folder| wrote(folder));
        let mut ends = all.iter().zip(&experiments);
        let is_converged = ends.all(|(findings, experiment)| findings.is_converged(&experiment.stop));
        Ok(if is_converged { ExitStatus::Done } else { ExitStatus::NotConverged })
    }

    fn experiment(&self, scene: AccuracyScene) -> Result<Experiment> {
        Ok(Experiment {
            scene,
            sides: if self.points.is_empty() { scene.sides(self.quick).into() } else { self.points.clone() },
            seed: self.seed,
            stop: Stop::new(self.tolerance, self.max_iterations)?,
            reference: Stop::new(self.reference_tolerance, self.max_iterations)?,
            repeats: self.repeats,
        })
    }
}

/// Makes `folder`, in a folder that must be there, and checks that files can be written into it.
fn make_folder(folder: &Path) -> Result<()> {
    if folder.is_file() {
        return usage(format!("--out is {}, which is a file: give a folder", folder.display()));
    }
    if !folder.is_dir() {
        check_target(folder)?;
        std::fs::create_dir(folder).map_err(|source| FileError::Write { path: folder.into(), source })?;
    }
    Ok(check_target(&folder.join("accuracy.csv"))?)
}

/// The table of all scenes so far, and the figure of the last one.
fn write_files(folder: &Path, all: &[Measurements]) -> Result<()> {
    write_rows(&folder.join("accuracy.csv"), all)?;
    if let Some(findings) = all.last() {
        let path = |ending| folder.join(format!("{}.{ending}", findings.scene.name()));
        write_svg(&path("svg"), &figure(findings))?;
        write_png(&path("png"), &figure(findings))?;
    }
    Ok(())
}
