//! `asperity demo`: Hertz beside rough contact.

use super::Outcome;
use super::description::describe;
use super::progress::Progress;
use super::solve::settle;
use anyhow::Result;
use asperity::contact::{Contact, Gfmd, Problem, Solver, Stop};
use asperity::record::{Options, Recording, Scene};
use asperity::surface::{Indenter, Spectrum};
use asperity::theory::Exact;
use asperity::{Grid, Surface};
use clap::Args;
use std::io::{Write, stdout};
use std::path::PathBuf;

/// The cell of the paper: eight roll-off wavelengths of 20 micrometres, and an indenter radius of a quarter of it (metres).
const CELL: f64 = 160e-6;
const RADIUS: f64 = CELL / 4.0;
/// Contact modulus of the solid (pascals); the results depend only on pressures over it.
const MODULUS: f64 = 1e9;
/// Load of the rough scenes.
const REDUCED_PRESSURE: f64 = 0.05;
const SEED: u64 = 1;

/// Presses a cylinder, a rough line, a sphere and a rough surface on an elastic solid by GFMD and records every step.
#[derive(Args)]
pub struct Demo {
    /// The recording
    #[arg(long, value_name = "FILE.rrd", default_value = "demo.rrd")]
    out: PathBuf,
}

/// One contact of the demo.
struct Case {
    name: &'static str,
    title: &'static str,
    what: String,
    problem: Problem,
    exact: Option<Exact>,
    /// `kappa_r` that van Dokkum et al. (2018) report for such contacts.
    paper: f64,
}

impl Demo {
    /// Runs the command.
    pub fn run(&self) -> Result<Outcome> {
        let cases = [hertz_line()?, rough_line()?, hertz_point()?, rough_surface()?];
        let (solver, stop) = (Gfmd::default(), Stop::default());
        let scenes: Vec<Scene<'_>> = cases.iter().map(|case| case.scene(&solver, &stop)).collect();
        let recording = Recording::create(&self.out, &scenes, Options::default())?;
        let mut contacts = Vec::new();
        let mut outcome = Outcome::Done;
        for (i, case) in cases.iter().enumerate() {
            let mut recorder = recording.recorder(i);
            let mut progress = Progress::new(stop.tolerance(), case.title);
            let solved = solver.solve(&case.problem, &stop, &mut (&mut recorder, &mut progress));
            let (contact, ended) = settle(solved);
            recorder.close(&contact)?;
            contacts.push(contact);
            outcome = outcome.max(ended);
        }
        recording.finish()?;
        write_table(&cases, &contacts)?;
        writeln!(stdout(), "\nRecorded every step in {0}: open it with `rerun {0}`.", self.out.display())?;
        Ok(outcome)
    }
}

impl Case {
    fn scene(&self, solver: &Gfmd, stop: &Stop) -> Scene<'_> {
        Scene {
            name: self.name.into(),
            title: self.title.into(),
            problem: &self.problem,
            description: describe(&self.what, &self.problem, "m", solver, stop, self.exact.as_ref()),
            exact: self.exact.clone(),
        }
    }

    /// A smooth indenter at the load under which the contact of its Hertz solution has the relative area `area`.
    fn smooth(
        name: &'static str,
        title: &'static str,
        indenter: Indenter,
        grid: Grid,
        strain: f64,
        paper: f64,
    ) -> Result<Self> {
        let problem = Problem::new(indenter.surface(grid)?, MODULUS, strain * MODULUS)?;
        let exact = Exact::of(&indenter, &grid, MODULUS, problem.mean_pressure());
        let what = format!("{}, radius {RADIUS:.1e} m", indenter.name());
        Ok(Self { name, title, what, problem, exact, paper })
    }

    fn rough(name: &'static str, title: &'static str, grid: Grid, spectrum: Spectrum, paper: f64) -> Result<Self> {
        let surface = Surface::rough(grid, &spectrum, SEED)?;
        let problem = Problem::at_reduced_pressure(surface, MODULUS, REDUCED_PRESSURE)?;
        let what = format!(
            "self-affine, H = {}, roll-off {:.1e} m, short cut-off {:.2e} m",
            spectrum.hurst, spectrum.rolloff_wavelength, spectrum.short_cutoff
        );
        Ok(Self { name, title, what, problem, exact: None, paper })
    }
}

fn hertz_line() -> Result<Case> {
    let grid = Grid::line(1 << 12, CELL)?;
    Case::smooth("hertz_line", "Hertz line", Indenter::Cylinder { radius: RADIUS }, grid, 8e-3, 1.47)
}

fn hertz_point() -> Result<Case> {
    let grid = Grid::surface([256, 256], [CELL, CELL])?;
    Case::smooth("hertz_point", "Hertz point", Indenter::Sphere { radius: RADIUS }, grid, 5e-3, 1.66)
}

fn rough_line() -> Result<Case> {
    let grid = Grid::line(1 << 12, CELL)?;
    let spectrum =
        Spectrum { hurst: 0.8, rolloff_wavelength: CELL / 8.0, short_cutoff: CELL / 128.0, rms_gradient: 1e-3 };
    Case::rough("rough_line", "Rough line", grid, spectrum, 1.75)
}

fn rough_surface() -> Result<Case> {
    let grid = Grid::surface([256, 256], [CELL, CELL])?;
    let spectrum =
        Spectrum { hurst: 0.8, rolloff_wavelength: CELL / 4.0, short_cutoff: CELL / 32.0, rms_gradient: 1e-3 };
    Case::rough("rough_surface", "Rough surface", grid, spectrum, 1.88)
}

fn write_table(cases: &[Case], contacts: &[Contact]) -> Result<()> {
    let mut out = stdout();
    writeln!(
        out,
        "{:<14} {:>6} {:>8} {:>8} {:>8} {:>10} {:>8} {:>6} {:>11}",
        "", "steps", "area", "kappa", "kappa_r", "corrected", "exact", "paper", "certificate"
    )?;
    for (case, contact) in cases.iter().zip(contacts) {
        let measures = contact.measures(&case.problem);
        let exact = case.exact.as_ref().and_then(|e| e.kappa_r).map_or("-".into(), |k| format!("{k:.4}"));
        writeln!(
            out,
            "{:<14} {:>6} {:>8.4} {:>8.4} {:>8.4} {:>10.4} {exact:>8} {:>6} {:>11.1e}",
            case.title,
            contact.work.iterations,
            measures.relative_area,
            measures.kappa,
            measures.kappa_r,
            measures.kappa_r_corrected,
            case.paper,
            contact.certificate.eta
        )?;
    }
    Ok(())
}
