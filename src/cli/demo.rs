//! `asperity demo`: Hertz beside rough contact.

use super::exit_status::{ExitStatus, settle};
use super::progress::Bars;
use super::terminal::stdout;
use super::wrote::wrote;
use anyhow::Result;
use asperity::contact::{Gfmd, Load, Observables};
use asperity::files::check_named;
use asperity::job::{Job, JobRun, Solved};
use asperity::record::Target;
use asperity::setup::{Cell, Method, Recipe, Setup, Solid};
use asperity::surface::{Indenter, Spectrum};
use clap::Args;
use std::io::Write;
use std::path::PathBuf;

/// The cell of the paper: eight roll-off wavelengths of 20 micrometres, and an indenter radius of a quarter of it (metres).
const CELL: f64 = 160e-6;
const RADIUS: f64 = CELL / 4.0;
/// Contact modulus of the solid (pascals); the results depend only on pressures over it.
const MODULUS: f64 = 1e9;
/// Load of the rough contacts.
const REDUCED_PRESSURE: f64 = 0.05;

const EXAMPLES: &str = "\
Examples:
  asperity demo
  asperity demo --out lecture.rrd";

#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Demo {
    /// The recording
    #[arg(long, value_name = "FILE.rrd", default_value = "demo.rrd")]
    out: PathBuf,
}

/// One contact of the demo.
struct Exhibit {
    name: &'static str,
    title: &'static str,
    setup: Setup,
    /// `kappa_r` that van Dokkum et al. (2018) report for such contacts.
    paper: f64,
}

impl Demo {
    pub(crate) fn run(&self) -> Result<ExitStatus> {
        check_named(&self.out, &["rrd"])?;
        let exhibits = exhibits();
        let run = |exhibit: &Exhibit| JobRun {
            name: exhibit.name.into(),
            title: Some(exhibit.title.into()),
            ..JobRun::new(exhibit.setup.clone())
        };
        let [first, rest @ ..] = exhibits.each_ref().map(run);
        let job = rest.into_iter().fold(Job::from_run(first), Job::beside);
        let job = job.recorded(Target::File(self.out.clone()));
        let solved = job.run(&mut Bars::default())?.solved;
        write_table(&exhibits, &solved)?;
        let outcome = solved
            .iter()
            .try_fold(ExitStatus::Done, |outcome, it| Ok::<_, anyhow::Error>(outcome.max(settle(&it.contact)?)))?;
        wrote(&self.out);
        Ok(outcome)
    }
}

/// A smooth indenter under a mean pressure of `strain E*`, at a friction of `damping` of the critical one of the longest
/// wave: a single contact holds the mean more softly than that.
fn smooth(indenter: Indenter, cell: Cell, strain: f64, damping: f64) -> Setup {
    let solver = Method::Gfmd(Gfmd { damping, ..Gfmd::default() });
    let setup = Setup::new(Recipe::indenter(indenter), cell, Load::MeanPressure(strain * MODULUS));
    Setup { solver, ..setup.on(Solid::ContactModulus(MODULUS)) }
}

/// Self-affine roughness with a roll-off at `1/waves` of the cell and some points per shortest wavelength.
fn rough(cell: Cell, waves: f64, points_per_wave: f64) -> Setup {
    let spacing = CELL / cell.points[0] as f64;
    let (rolloff_wavelength, short_cutoff) = (CELL / waves, spacing * points_per_wave);
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength, short_cutoff, rms_gradient: 1e-3 };
    let setup = Setup::new(Recipe::rough(spectrum, 1), cell, Load::ReducedPressure(REDUCED_PRESSURE));
    Setup { solver: Method::Gfmd(Gfmd::default()), ..setup.on(Solid::ContactModulus(MODULUS)) }
}

/// The four contacts: smooth and rough, line and surface.
fn exhibits() -> [Exhibit; 4] {
    let line = |points| Cell::line(points, CELL);
    let surface = || Cell::surface([256, 256], [CELL, CELL]);
    let (cylinder, sphere) = (Indenter::Cylinder { radius: RADIUS }, Indenter::Sphere { radius: RADIUS });
    let exhibit = |name, title, paper, setup| Exhibit { name, title, setup, paper };
    [
        exhibit("hertz_line", "Hertz line", 1.47, smooth(cylinder, line(1 << 11), 8e-3, 0.35)),
        exhibit("rough_line", "Rough line", 1.75, rough(line(1 << 13), 8.0, 32.0)),
        exhibit("hertz_point", "Hertz point", 1.66, smooth(sphere, surface(), 5e-3, 0.2)),
        exhibit("rough_surface", "Rough surface", 1.88, rough(surface(), 4.0, 8.0)),
    ]
}

fn write_table(exhibits: &[Exhibit], solved: &[Solved]) -> Result<()> {
    let mut out = stdout();
    writeln!(
        out,
        "{:<14} {:>6} {:>8} {:>8} {:>8} {:>10} {:>8} {:>6} {:>11}",
        "", "steps", "area", "kappa", "kappa_r", "counted", "exact", "paper", "certificate"
    )?;
    for (exhibit, Solved { contact, .. }) in exhibits.iter().zip(solved) {
        let it = Observables::new(contact);
        let exact = exhibit.setup.exact(contact.problem.surface().grid(), contact.problem.expected_mean_pressure());
        let exact = exact.and_then(|exact| exact.kappa_r).map_or("-".into(), |kappa_r| format!("{kappa_r:.4}"));
        writeln!(
            out,
            "{:<14} {:>6} {:>8.4} {:>8.4} {:>8.4} {:>10.4} {exact:>8} {:>6} {:>11.1e}",
            exhibit.title,
            contact.work.iterations,
            it.relative_area,
            it.kappa,
            it.kappa_r,
            it.kappa_r_counted,
            exhibit.paper,
            contact.certificate.eta
        )?;
    }
    Ok(())
}
