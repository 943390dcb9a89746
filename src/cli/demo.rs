//! `asperity demo`: Hertz beside rough contact.

use super::Outcome;
use super::progress::Progress;
use super::solve::settle;
use anyhow::Result;
use asperity::contact::{Contact, Dynamics, Gfmd, Masses, Problem, Solver, Stop};
use asperity::record::{Options, Recording, Scene, describe};
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
    label: Label,
    what: String,
    problem: Problem,
    solver: Gfmd,
    exact: Option<Exact>,
}

struct Label {
    name: &'static str,
    title: &'static str,
    /// `kappa_r` that van Dokkum et al. (2018) report for such contacts.
    paper: f64,
}

impl Demo {
    /// Runs the command.
    pub fn run(&self) -> Result<Outcome> {
        let cases = cases()?;
        let stop = Stop::default();
        let scenes: Vec<Scene<'_>> = cases.iter().map(|case| case.scene(&stop)).collect();
        let recording = Recording::create(&self.out, &scenes, Options::default())?;
        let mut contacts = Vec::new();
        let mut outcome = Outcome::Done;
        for (i, case) in cases.iter().enumerate() {
            let mut recorder = recording.recorder(i);
            let mut progress = Progress::new(stop.tolerance(), case.label.title);
            let solved = case.solver.solve(&case.problem, &stop, &mut (&mut recorder, &mut progress));
            let (contact, ended) = settle(solved)?;
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
    fn scene(&self, stop: &Stop) -> Scene<'_> {
        Scene {
            name: self.label.name.into(),
            title: self.label.title.into(),
            problem: &self.problem,
            description: describe(&self.what, &self.problem, "m", &self.solver, stop, self.exact.as_ref()),
            exact: self.exact.clone(),
        }
    }

    /// A smooth indenter under a mean pressure of `strain E*`, at a friction of `damping` of the critical one of the longest
    /// wave: a single contact holds the mean more softly than that.
    fn smooth(label: Label, indenter: Indenter, grid: Grid, strain: f64, damping: f64) -> Result<Self> {
        let problem = Problem::new(indenter.surface(grid)?, MODULUS, strain * MODULUS)?;
        let exact = Exact::of(&indenter, &grid, MODULUS, problem.expected_mean_pressure());
        let what = format!("{}, radius {RADIUS:.1e} m", indenter.name());
        let solver = Gfmd::new(Masses::Uniform, Dynamics::Damped, 0.5, damping)?;
        Ok(Self { label, what, problem, solver, exact })
    }

    /// Self-affine roughness with a roll-off at `1/waves` of the cell and 32 points per shortest wavelength of a line, 8 of a
    /// surface.
    fn rough(label: Label, grid: Grid, waves: f64) -> Result<Self> {
        let points_per_wave = if grid.is_line() { 32.0 } else { 8.0 };
        let spectrum = Spectrum {
            hurst: 0.8,
            rolloff_wavelength: CELL / waves,
            short_cutoff: grid.spacing()[1] * points_per_wave,
            rms_gradient: 1e-3,
        };
        let surface = Surface::rough(grid, &spectrum, SEED)?;
        let problem = Problem::at_reduced_pressure(surface, MODULUS, REDUCED_PRESSURE)?;
        let what = format!(
            "self-affine, H = {}, roll-off {:.1e} m, short cut-off {:.2e} m",
            spectrum.hurst, spectrum.rolloff_wavelength, spectrum.short_cutoff
        );
        Ok(Self { label, what, problem, solver: Gfmd::default(), exact: None })
    }
}

/// The four contacts: smooth and rough, line and surface.
fn cases() -> Result<[Case; 4]> {
    let line = |points| Grid::line(points, CELL);
    let surface = || Grid::surface([256, 256], [CELL, CELL]);
    let label = |name, title, paper| Label { name, title, paper };
    let (cylinder, sphere) = (Indenter::Cylinder { radius: RADIUS }, Indenter::Sphere { radius: RADIUS });
    Ok([
        Case::smooth(label("hertz_line", "Hertz line", 1.47), cylinder, line(1 << 11)?, 8e-3, 0.35)?,
        Case::rough(label("rough_line", "Rough line", 1.75), line(1 << 13)?, 8.0)?,
        Case::smooth(label("hertz_point", "Hertz point", 1.66), sphere, surface()?, 5e-3, 0.2)?,
        Case::rough(label("rough_surface", "Rough surface", 1.88), surface()?, 4.0)?,
    ])
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
            case.label.title,
            contact.work.iterations,
            measures.relative_area,
            measures.kappa,
            measures.kappa_r,
            measures.kappa_r_corrected,
            case.label.paper,
            contact.certificate.eta
        )?;
    }
    Ok(())
}
