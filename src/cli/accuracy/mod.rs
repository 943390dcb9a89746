//! `asperity accuracy`: error against run time.

mod advice;
mod curve;
mod figure;
mod ladder;
mod model;
mod quantity;
#[cfg(feature = "record")]
mod recording;
mod row;
mod scene;
mod table;

use super::contender::Contender;

use super::{Outcome, usage};
use anyhow::Result;
use asperity::contact::Stop;
use asperity::error::FileError;
use asperity::files::check_target;
use asperity::plot::{write_png, write_svg};
use clap::Args;
use curve::{Curve, Reference};
use figure::figure;
use ladder::Ladder;
use model::{Model, models};
use row::write_rows;
use scene::Scene;
use std::io::{Write, stdout};
use std::path::{Path, PathBuf};
use table::write_scene;

const ERRORS: &str = "\
Three errors, all relative, are kept apart:
  algebraic       of a step against the solution on the same grid
  discretisation  of a grid against the exact solution, or against a grid four times finer than the finest,
                  whose own error may hide a quarter of that of the finest
  model           of a theory against the same
Area and kappa_r are corrected for counting nodes.";

/// Measures how far each solver has come after which time, and what that is worth.
#[derive(Args)]
#[command(after_help = ERRORS)]
pub struct Accuracy {
    /// What to solve, in this order
    #[arg(value_enum, value_name = "SCENE", default_values_t = Scene::ALL)]
    scenes: Vec<Scene>,
    /// Points along each side of the grids, coarsest first [default: those of the scene]
    #[arg(long, value_name = "N,N,...", value_delimiter = ',')]
    points: Vec<usize>,
    /// Certificate eta at which the curves end
    #[arg(long, value_name = "ETA", default_value = "1e-10", allow_negative_numbers = true)]
    tolerance: f64,
    /// Certificate eta of the solutions that errors are held against, as far as rounding lets it
    #[arg(long, value_name = "ETA", default_value = "1e-13", allow_negative_numbers = true)]
    reference_tolerance: f64,
    /// Iterations at the most
    #[arg(long, value_name = "N", default_value_t = 100_000)]
    max_iterations: usize,
    /// Seed of the rough surfaces
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Time each curve so many times, after a run to warm up; the median of the seconds is reported
    #[arg(long, value_name = "N", default_value_t = 3)]
    repeats: usize,
    /// Use smaller grids
    #[arg(long, conflicts_with = "points")]
    quick: bool,
    /// Write accuracy.csv and a figure of each scene, as SVG and PNG, into this folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Record the solvers on the finest grid of each scene side by side, into the same folder
    #[cfg(feature = "record")]
    #[arg(long, requires = "out")]
    record: bool,
}

/// All that was measured on a scene.
pub struct Measured {
    scene: Scene,
    ladder: Ladder,
    models: Vec<Model>,
    /// Of all solvers on all grids, the finest last.
    curves: Vec<Curve>,
}

impl Measured {
    /// The curves on the finest grid.
    fn finest(&self) -> impl Iterator<Item = &Curve> {
        self.curves.iter().skip(self.curves.len().saturating_sub(Contender::ALL.len()))
    }
}

impl Accuracy {
    /// Runs the command.
    pub fn run(&self) -> Result<Outcome> {
        self.check()?;
        if let Some(folder) = &self.out {
            make_folder(folder)?;
        }
        writeln!(
            stdout(),
            "Seconds are those of the solver, without what watches it: median of {} after a warm-up, {} threads",
            self.repeats,
            rayon::current_num_threads()
        )?;
        let mut all = Vec::new();
        for &scene in &self.scenes {
            all.push(self.measure(scene)?);
            write_scene(&all[all.len() - 1], &mut stdout())?;
            if let Some(folder) = &self.out {
                write_files(folder, &all)?;
                #[cfg(feature = "record")]
                self.record(folder, scene)?;
            }
        }
        let points = all.iter().flat_map(|measured| &measured.curves).map(|curve| curve.points.last());
        let is_met = |eta: f64| eta <= self.tolerance;
        let all_converged = points.into_iter().all(|last| last.is_some_and(|last| is_met(last.eta)));
        Ok(if all_converged { Outcome::Done } else { Outcome::NotConverged })
    }

    /// Refuses what cannot be before anything runs.
    fn check(&self) -> Result<()> {
        if self.repeats == 0 {
            return usage("--repeats is 0: give a positive number of runs");
        }
        if let Some(pair) = self.points.windows(2).find(|pair| pair[0] >= pair[1]) {
            return usage(format!("--points goes from {} to {}: give ever finer grids", pair[0], pair[1]));
        }
        self.stop()?;
        self.reference_stop()?;
        for &scene in &self.scenes {
            let sides = self.sides(scene);
            scene.problem(sides[0], self.seed)?;
            scene.grid(ladder::REFINEMENT.saturating_mul(sides[sides.len() - 1]))?;
        }
        Ok(())
    }

    fn stop(&self) -> Result<Stop> {
        Ok(Stop::new(self.tolerance, self.max_iterations)?)
    }

    fn reference_stop(&self) -> Result<Stop> {
        Ok(Stop::new(self.reference_tolerance, self.max_iterations)?)
    }

    fn sides(&self, scene: Scene) -> &[usize] {
        if self.points.is_empty() { scene.ladder(self.quick) } else { &self.points }
    }

    #[cfg(feature = "record")]
    fn record(&self, folder: &Path, scene: Scene) -> Result<()> {
        let sides = self.sides(scene);
        if !self.record {
            return Ok(());
        }
        let problem = scene.problem(sides[sides.len() - 1], self.seed)?;
        recording::record(&folder.join(format!("{}.rrd", scene.name())), scene.name(), &problem, &self.stop()?)
    }

    fn measure(&self, scene: Scene) -> Result<Measured> {
        let sides = self.sides(scene);
        let ladder = Ladder::of(scene, sides, self.seed, &self.stop()?)?;
        let reduced_pressure = scene.mean_pressure() / scene.problem(sides[sides.len() - 1], self.seed)?.rms_gradient();
        let models = models(scene, &ladder.truth, reduced_pressure);
        let mut curves = Vec::new();
        for &side in sides {
            curves.extend(self.curves(scene, side)?);
        }
        Ok(Measured { scene, ladder, models, curves })
    }

    /// The curves of all solvers on one grid.
    fn curves(&self, scene: Scene, side: usize) -> Result<Vec<Curve>> {
        let title = format!("{} {side},", scene.name());
        let reference = Reference::of(scene.problem(side, self.seed)?, &self.reference_stop()?, &title)?;
        let curve = |contender| Curve::of(contender, &reference, &self.stop()?, self.repeats, &title);
        Contender::ALL.into_iter().map(curve).collect()
    }
}

/// Makes `folder`, in a folder that must be there, and checks that files can be written into it.
fn make_folder(folder: &Path) -> Result<()> {
    if folder.is_file() {
        return usage(format!("--out names {}, which is a file: give a folder", folder.display()));
    }
    if !folder.is_dir() {
        check_target(folder)?;
        std::fs::create_dir(folder).map_err(|source| FileError::Write { path: folder.into(), source })?;
    }
    Ok(check_target(&folder.join("accuracy.csv"))?)
}

/// The table of all scenes so far, and the figure of the last one.
fn write_files(folder: &Path, all: &[Measured]) -> Result<()> {
    write_rows(&folder.join("accuracy.csv"), all)?;
    if let Some(measured) = all.last() {
        let path = |ending| folder.join(format!("{}.{ending}", measured.scene.name()));
        write_svg(&path("svg"), &figure(measured))?;
        write_png(&path("png"), &figure(measured))?;
    }
    Ok(())
}
