//! `asperity certify`: the certificate of a result of another code.

use super::claim_report::ClaimReport;
use super::density;
use super::exit_status::{ExitStatus, usage};
use super::fields::{check_elastic, lay_load, poisson, rows};
use super::figure_args::FigureArgs;
use super::finding::Finding;
use super::flags::{OfProblem, SceneArgs};
use super::output::write_json;
use super::recording_args::RecordingArgs;
use super::terminal::stdout;
use super::warnings;
use super::wrote::wrote;
use anyhow::Result;
use asperity::contact::{Contact, ContactModulus, Problem, archive, warnings_of};
use asperity::error::ProblemError;
use asperity::files::{check_apart, check_named, write_beside};
use asperity::foreign::{Assessment, Claim, Frame, GivenField, Replay};
use asperity::formats::read_field;
use asperity::job::write_nodes;
use asperity::plot::{FigureStyle, is_figure, write_figure};
use asperity::setup::{Cost, Setup};
use clap::{ArgGroup, Args};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Fields that a claim takes while it is assessed: its own, heights, and those of a half-space, a contact and a trial.
const FIELDS_IN_MEMORY: f64 = 12.0;

const EXAMPLES: &str = "\
Examples:
  asperity certify --height h.npy --size 160um --modulus 1GPa --pressure p.npy --mean-pressure 1MPa
  asperity certify --setup scene.toml --gap g.npy --json
  asperity certify --setup-of run.npz --pressure mine.npy --record mine.rrd";

/// Heading of the flags of the result.
const RESULT: &str = "Result (one of --pressure, --gap, --displacement; .npy, .npz or text)";

#[derive(Args)]
#[command(after_help = EXAMPLES, group = ArgGroup::new("claim").args(["pressure", "gap", "displacement"]).required(true))]
pub(crate) struct Certify {
    /// File of the pressure, positive in compression; without a load flag, its own mean pressure is the load
    #[arg(long, value_name = "FILE", help_heading = RESULT)]
    pressure: Option<PathBuf>,
    /// File of the gap between the surfaces; without a load flag, its own mean gap is the load
    #[arg(long, value_name = "FILE", help_heading = RESULT)]
    gap: Option<PathBuf>,
    /// File of the displacement of the solid's surface, positive into the solid; any mean value is accepted, so a load
    /// flag is required
    #[arg(long, value_name = "FILE", help_heading = RESULT)]
    displacement: Option<PathBuf>,
    #[command(flatten)]
    scene: SceneArgs<OfProblem>,
    #[command(flatten)]
    shown: RecordingArgs,
    /// Write fields and numbers (.npz); for a line also the nodes (.csv) or a picture of where the error is (.svg,
    /// .pdf, .png)
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    out: Option<PathBuf>,
    /// Print one JSON object instead of a summary
    #[arg(long, help_heading = "Output")]
    json: bool,
    #[command(flatten)]
    figure: FigureArgs,
}

impl Certify {
    pub(crate) fn run(&self) -> Result<ExitStatus> {
        self.check()?;
        let (quantity, path) = self.claimed();
        let field = rows(read_field(path, quantity.name())?)?;
        let mut table = self.scene.table()?;
        let is_loaded = lay_load(&mut table, quantity, &field)?;
        let recorded = self.shown.record.as_deref();
        let read = self.scene.files(&table).into_iter().chain([path.into()]);
        check_apart(self.out.as_deref().into_iter().chain(recorded), read)?;
        let setup = table.setup()?;
        check_single(&setup)?;
        let grid = setup.check()?;
        Cost::from_fields(&grid, FIELDS_IN_MEMORY).check("a certificate")?;
        if !grid.is_line() && !["npz", ""].contains(&self.ending().as_str()) {
            return usage(format!(
                "a .{} can be written for a line only: for a surface give a .npz, or use --record",
                self.ending()
            ));
        }
        let (surface, modulus) = (Arc::new(setup.surface()?), ContactModulus(setup.contact_modulus()?));
        let claim = Claim::new(surface.clone(), modulus, is_loaded.then_some(setup.load), quantity, &field)?;
        let is_plain = setup.law.is_hard_wall() && setup.sliding.is_none() && setup.elastic()?.is_half_space();
        let claim = if is_plain { claim } else { claim.with_problem(setup.problem_of(surface)?) };
        let problem = claim.problem().or_else(|error| refuse(&claim, &setup, error))?;
        let contact = self.contact(&setup, &claim, &problem, path)?;
        if let Some(fault) = contact.fault().filter(|_| contact.failure.is_some()) {
            return Err(fault.into());
        }
        let assessment = Assessment::new(&claim, &contact)?;
        let holds = assessment.holds(&contact, &setup.stop);
        let mut warnings = setup.surface.warnings(problem.surface());
        let finding = Finding::new(&setup, &contact);
        warnings.extend(warnings_of(&[&finding.observables], problem.law()));
        self.write(
            &contact,
            &ClaimReport {
                file: path.into(),
                quantity,
                holds,
                prescribed: claim.load(),
                source: setup.surface.description(),
                contact_modulus: problem.contact_modulus(),
                finding,
                assessment,
                findings: if holds { Vec::new() } else { claim.mistakes(&poisson(&setup)) },
                warnings: warnings::in_flags(&warnings),
                units: self.scene.units(),
                mean: claim.mean(),
                mean_pressure: problem.mean_pressure(),
                setup,
                grid,
            },
        )?;
        Ok(if holds { ExitStatus::Done } else { ExitStatus::NotConverged })
    }

    /// Refuses places where nothing can be written, and names that promise another content.
    fn check(&self) -> Result<()> {
        if let Some(path) = &self.out {
            check_named(path, &["npz", "csv", "svg", "pdf", "png"])?;
        }
        self.style()?;
        self.shown.check()?;
        Ok(())
    }

    /// How the picture is drawn.
    fn style(&self) -> Result<FigureStyle> {
        self.figure.style(self.out.as_deref().is_some_and(is_figure))
    }

    /// The quantity that is claimed, and its file.
    fn claimed(&self) -> (GivenField, &Path) {
        match (&self.pressure, &self.gap, &self.displacement) {
            (Some(path), ..) => (GivenField::Pressure, path),
            (_, Some(path), _) => (GivenField::Gap, path),
            (.., path) => (GivenField::Displacement, path.as_deref().unwrap_or(Path::new(""))),
        }
    }

    /// The contact that a claim makes, recorded on request.
    fn contact(&self, setup: &Setup, claim: &Claim, problem: &Problem, path: &Path) -> Result<Contact> {
        let frame = Frame { values: claim.values().to_vec(), seconds: None };
        let name = path.display().to_string();
        let replay = Replay::new(&name, claim.quantity(), [Ok(frame)].into_iter());
        let title = format!("{}, {}", setup.surface.title(problem.surface().grid()), name);
        self.shown.watch(&title, setup, problem, (&replay, None), &mut ())
    }

    /// Writes and prints what came out.
    fn write(&self, contact: &Contact, verdict: &ClaimReport) -> Result<()> {
        let setup = &verdict.setup;
        let figure = || density::figure(&setup.surface.title(&verdict.grid), contact);
        match (&self.out, self.ending().as_str()) {
            (Some(path), "csv") => write_nodes(path, contact)?,
            (Some(path), _) if is_figure(path) => write_figure(path, &figure(), &self.style()?)?,
            (Some(path), _) => {
                let bytes = archive(contact, setup.surface.rank(&setup.grid)?, Some(&setup.to_saved_toml()));
                write_beside(path, |file| file.write_all(&bytes.map_err(io::Error::other)?))?;
            }
            (None, _) => {}
        }
        if self.json {
            write_json(verdict, &mut stdout())?
        } else {
            verdict.write_text(&mut stdout())?
        }
        warnings::print(&verdict.warnings);
        self.shown.report();
        self.out.iter().for_each(|path| wrote(path));
        Ok(())
    }

    /// The ending of the name of the file that is written, or nothing.
    fn ending(&self) -> String {
        let ending = self.out.as_deref().and_then(Path::extension).unwrap_or_default();
        ending.to_string_lossy().to_ascii_lowercase()
    }
}

/// Refuses setups whose contact depends on its past, or on more than its pressure: no certificate of one pressure tells whether it is right.
fn check_single(setup: &Setup) -> Result<()> {
    check_elastic(setup)?;
    if setup.feels().attraction {
        return usage(
            "adhesion is given, but a contact with attraction has several solutions, and no certificate of a pressure tells which one is meant: leave it \
             out",
        );
    }
    if setup.is_history()? {
        return usage(
            "a history is given, but a result is certified as the solution of one problem without a past: leave the path and the creep out",
        );
    }
    Ok(())
}

/// The sentence for a problem that a claim cannot pose, and for the mistake that may be behind it.
fn refuse(claim: &Claim, setup: &Setup, error: ProblemError) -> Result<Problem> {
    match claim.mistakes(&poisson(setup)).first() {
        Some(mistake) => usage(format!("{error}; judging from the numbers, {}", mistake.sentence)),
        None => Err(error.into()),
    }
}
