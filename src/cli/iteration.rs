//! The iteration of another code, as text and as JSON.

use super::claim_report::points;
use super::contact_report::write_diagnosis;
use super::finding::Finding;
use super::output::write_rows;
use super::units::Units;
use asperity::diagnosis::Findings;
use asperity::foreign::{Distance, GivenField};
use asperity::grid::Grid;
use asperity::setup::Setup;
use serde::Serialize;
use std::io::{self, Write};

/// Rows of the table of steps between powers of ten, about.
const ROWS_PER_DECADE: f64 = 6.0;

/// The steps of another code, and how far they are from the reference.
#[derive(Serialize)]
pub(crate) struct Iteration {
    /// Where the steps come from.
    pub steps_of: String,
    pub quantity: GivenField,
    pub steps: Vec<Distance>,
    /// The solver or file of the reference, and its certificate.
    pub reference_of: String,
    pub reference_certificate: f64,
    /// The numbers of the last step.
    pub last: Finding,
    /// Findings of `--diagnose`: why the iteration was slow.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub diagnosis: Option<Findings>,
    #[serde(serialize_with = "Setup::serialize_saved")]
    pub setup: Setup,
    #[serde(skip)]
    pub grid: Grid,
    #[serde(skip)]
    pub units: Units,
}

impl Iteration {
    /// Writes a table of some steps, and the numbers of the last one.
    pub(crate) fn write_text(&self, out: &mut impl Write) -> io::Result<()> {
        let title = self.setup.surface.title(&self.grid);
        let is_timed = self.steps.iter().any(|it| it.seconds > 0.0);
        let (count, quantity, steps_of) = (self.steps.len(), self.quantity, &self.steps_of);
        writeln!(out, "{title}, {}: {count} steps of {quantity} from {steps_of}", points(&self.grid))?;
        writeln!(
            out,
            "  distance from {} (certificate {:.1e}), relative",
            self.reference_of, self.reference_certificate
        )?;
        let seconds = |words: String| if is_timed { format!(" {words:>10}") } else { String::new() };
        let head = ["certificate", "pressure", "energy norm"].map(|name| format!(" {name:>12}")).concat();
        writeln!(out, "  {:>8}{}{head}", "step", seconds("seconds".into()))?;
        for it in self.listed() {
            let numbers =
                [it.certificate, it.pressure_error, it.energy_error].map(|it| format!(" {it:>12.2e}")).concat();
            writeln!(out, "  {:>8}{}{numbers}", it.step, seconds(format!("{:.3}", it.seconds)))?;
        }
        writeln!(out, "the last step")?;
        let rows = self.last.rows(self.units).into_iter().chain(self.last.details(self.units));
        write_rows(rows.filter(|(name, _)| name != "work"), out)?;
        write_diagnosis(self.diagnosis.as_ref(), out)
    }

    /// All early steps, later ones less often, and the last.
    fn listed(&self) -> impl Iterator<Item = &Distance> {
        let place = |step: usize| (ROWS_PER_DECADE * (step as f64).log10()).floor();
        let last = self.steps.len().saturating_sub(1);
        let is_listed = move |step: usize| step < 2 || step == last || place(step) > place(step - 1);
        self.steps.iter().enumerate().filter(move |(step, _)| is_listed(*step)).map(|(_, it)| it)
    }
}
