//! `asperity seal`: the load at which a surface seals.

use super::choice::choice;
use super::exit_status::ExitStatus;
use super::fields::check_elastic;
use super::flags::{OfSealing, SceneArgs};
use super::output::{write_json, write_rows};
use super::problem_summary::ProblemSummary;
use super::progress::Progress;
use super::terminal::stdout;
use super::units::Units;
use super::warnings;
use anyhow::Result;
use asperity::flow::{FlowAxis, PercolationLoad};
use asperity::setup::{Extras, Setup};
use clap::Args;
use serde::Serialize;
use std::io::{self, Write};

const EXAMPLES: &str = "\
Examples:
  asperity seal scene.toml
  asperity seal heights.npy --size 1mm --axis x --width 1e-4 --json";

#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Seal {
    #[command(flatten)]
    scene: SceneArgs<OfSealing>,
    /// The axis along which a fluid would flow [default: both]
    #[arg(long, value_name = "AXIS", value_parser = choice::<FlowAxis>())]
    axis: Option<FlowAxis>,
    /// Largest distance between a load at which the gap is open and one at which the contact seals, relative to the load
    #[arg(long, value_name = "SHARE", default_value_t = 1e-3)]
    width: f64,
    /// Print one JSON object instead of a summary
    #[arg(long)]
    json: bool,
}

/// The loads that seal a surface, and the setup.
#[derive(Serialize)]
struct SealSummary {
    #[serde(flatten)]
    subject: ProblemSummary,
    sealing: Vec<PercolationLoad>,
    warnings: Vec<String>,
    #[serde(serialize_with = "Setup::serialize_saved")]
    setup: Setup,
    #[serde(skip)]
    units: Units,
}

impl Seal {
    pub(crate) fn run(&self) -> Result<ExitStatus> {
        let mut table = self.scene.table()?;
        // any load that no body is too soft for: the search takes its own
        table.remove("load");
        table.lay("load.reduced-pressure", 1e-9.into());
        let setup = table.setup()?;
        check_elastic(&setup)?;
        setup.cost(&Extras::default())?.check(setup.solver.name())?;
        let problem = setup.problem()?;
        let warnings = warnings::in_flags(&setup.surface.warnings(problem.surface()));
        let axes = FlowAxis::ALL.into_iter().filter(|axis| self.axis.is_none_or(|it| it == *axis));
        let find = |axis: FlowAxis| {
            let watch = |number: usize| Progress::new(&format!("along {}, contact {}", axis.name(), number + 1));
            PercolationLoad::new(&problem, setup.solver(), &setup.stop, axis, self.width, watch)
        };
        let sealing = axes.map(find).collect::<Result<_, _>>()?;
        let (subject, units) = (ProblemSummary::new(&setup, &problem)?, self.scene.units());
        let summary = SealSummary { subject, sealing, warnings, setup, units };
        if self.json {
            write_json(&summary, &mut stdout())?;
        } else {
            summary.write_text(&mut stdout())?;
        }
        warnings::print(&summary.warnings);
        Ok(ExitStatus::Done)
    }
}

impl SealSummary {
    /// Writes the summary for reading.
    fn write_text(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "{}: the loads at which it seals", self.subject.line())?;
        let rows = self.subject.rows(self.units, true).into_iter();
        // the load is what is found
        write_rows(rows.filter(|(name, _)| name != "prescribed"), out)?;
        writeln!(
            out,
            "\n{:>7} {:>8} {:>12} {:>14} {:>9} {:>9} {:>9}  mean gap",
            "along", "the gap", "p*", "pressure", "area", "counted", "corrected"
        )?;
        self.sealing.iter().try_for_each(|found| {
            [("is open", &found.open), ("is shut", &found.sealed)].into_iter().try_for_each(|(said, it)| {
                writeln!(
                    out,
                    "{:>7} {said:>8} {:>12.5e} {:>14} {:>9.5} {:>9.5} {:>9.5}  {}",
                    found.axis.name(),
                    it.reduced_pressure,
                    self.units.pressure(it.mean_pressure),
                    it.relative_area,
                    it.relative_area_counted,
                    it.relative_area_corrected,
                    self.units.length(it.mean_gap)
                )
            })
        })
    }
}
