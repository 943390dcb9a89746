//! The verdict on the result of another code, as text and as JSON.

use super::finding::Finding;
use super::output::{TextRow, row, write_rows};
use super::units::Units;
use asperity::contact::Load;
use asperity::foreign::{Assessment, GivenField, Mistake, Spot};
use asperity::grid::Grid;
use asperity::setup::Setup;
use serde::Serialize;
use std::io::{self, Write};
use std::path::PathBuf;

/// Rows on the contact that do not apply to the result of another code, or that are shown in another form.
const OTHER_ROWS: [&str; 3] = ["work", "penetration", "load error"];
/// The name of the mistake that is a wrong load.
const LOAD_MISTAKE: &str = "load";
/// A relative error of the load above this value is reported.
const LARGEST_LOAD_ERROR: f64 = 1e-6;
/// Errors of a load, and shares of tension, that are rounding.
const ROUNDING_ERROR: f64 = 1e-12;

/// All that is known of a result.
#[derive(Serialize)]
pub(crate) struct ClaimReport {
    pub file: PathBuf,
    pub quantity: GivenField,
    /// Whether it is within the tolerances.
    pub holds: bool,
    /// The load, if it was given and is not that of the result itself.
    pub prescribed: Option<Load>,
    pub source: String,
    pub contact_modulus: f64,
    #[serde(flatten)]
    pub finding: Finding,
    pub assessment: Assessment,
    /// Common mistakes that explain why it does not hold.
    pub findings: Vec<Mistake>,
    pub warnings: Vec<String>,
    #[serde(serialize_with = "Setup::serialize_saved")]
    pub setup: Setup,
    #[serde(skip)]
    pub grid: Grid,
    /// The mean of the field, and the mean pressure that is prescribed, if one is.
    #[serde(skip)]
    pub mean: f64,
    #[serde(skip)]
    pub mean_pressure: Option<f64>,
    #[serde(skip)]
    pub units: Units,
}

impl ClaimReport {
    /// Writes the verdict for reading.
    pub(crate) fn write_text(&self, out: &mut impl Write) -> io::Result<()> {
        let holds = if self.holds { "within tolerance" } else { "not within tolerance" };
        let Self { quantity, file, setup, .. } = self;
        let title = setup.surface.title(&self.grid);
        writeln!(out, "{title}, {}: the {quantity} of {} is {holds}", points(&self.grid), file.display())?;
        let mut rows = self.mistakes();
        rows.extend(self.own());
        let numbers = [self.finding.rows(self.units), self.finding.details(self.units)].concat();
        rows.extend(numbers.into_iter().filter(|(name, _)| !OTHER_ROWS.contains(&name.as_str())));
        write_rows(rows, out)
    }

    /// Why the result does not hold, as far as common mistakes explain it.
    fn mistakes(&self) -> Vec<TextRow> {
        let is_load = |mistake: &Mistake| mistake.errors == [LOAD_MISTAKE];
        let mut rows = Vec::new();
        for mistake in self.findings.iter().filter(|mistake| !is_load(mistake)) {
            rows.push(row("finding", &*mistake.sentence));
        }
        if self.holds {
            return rows;
        }
        // For a wrong load, both pressures are printed in place of the general sentence about it. If other mistakes explain the result, the load is not
        // mentioned: it differs because of them.
        if let Some(load) = self.other_load()
            && (self.findings.is_empty() || self.findings.iter().any(is_load))
        {
            rows.push(row("finding", load));
        } else if self.findings.is_empty() {
            let words = "no common mistake explains it: the result is not converged, or it solves another problem";
            rows.push(row("finding", words));
        }
        rows
    }

    /// The load that the pressures carry, where another one is prescribed.
    fn other_load(&self) -> Option<String> {
        let is_missed = self.quantity == GivenField::Pressure && self.assessment.load_error > LARGEST_LOAD_ERROR;
        let [found, prescribed] = [self.mean, self.mean_pressure?].map(|pressure| self.units.pressure(pressure));
        is_missed.then(|| format!("the pressures carry {found}, but {prescribed} is prescribed"))
    }

    /// What is wrong with the result, and where.
    fn own(&self) -> Vec<TextRow> {
        let found = &self.assessment;
        let place = |node| place(&self.grid, node, self.units);
        let prescribed = match self.prescribed {
            Some(load) if found.load_error > ROUNDING_ERROR => {
                format!("{}, with a relative error of {:.1e}", self.units.load(load), found.load_error)
            }
            Some(load) => self.units.load(load),
            None => format!("nothing: the load is that of the {}", self.quantity),
        };
        let mut rows = vec![
            row("source", &*self.source),
            row("contact modulus E*", self.units.pressure(self.contact_modulus)),
            row("prescribed", prescribed),
        ];
        rows.extend(self.tension());
        let (densest, deepest) = (&found.densest, &found.deepest);
        let energy = format!("largest density at {}, {:.2} % of the total", place(densest.node), 100.0 * densest.value);
        rows.push(row("error in energy", energy));
        rows.push(row("penetration", format!("{:.1e} rms heights at {}", deepest.value, place(deepest.node))));
        let contact = format!("{} nodes have pressure, {} have a closed gap", found.pressed, found.closed);
        rows.push(row("contact", contact));
        let disagreements = [("pressure across a gap", &found.apart), ("overlap, no pressure", &found.unpressed)];
        for (name, disagreement) in disagreements {
            if let Some(Spot { node, value }) = disagreement.worst {
                let (nodes, place) = (disagreement.nodes, place(node));
                let words = format!("{nodes} nodes, the worst at {place}, with a gap of {value:.1e} rms heights");
                rows.push(row(name, words));
            }
        }
        rows
    }

    /// The nodes that pull, and what stands in for them in the other numbers.
    fn tension(&self) -> Vec<TextRow> {
        let tension = &self.assessment.tension;
        let (nodes, share) = (tension.nodes, tension.share);
        if nodes == 0 {
            return Vec::new();
        }
        if share <= ROUNDING_ERROR {
            let words = format!("rounding errors only: {nodes} nodes, {share:.1e} of all pressure");
            return vec![row("tension", words)];
        }
        let lowest = self.units.pressure(tension.lowest);
        let worst = place(&self.grid, tension.node, self.units);
        let words = format!("{nodes} nodes, {share:.1e} of all pressure, down to {lowest} at {worst}");
        let stand_in = match share < 1.0 {
            true => "for the numbers below, tension is set to zero and the load is restored",
            false => "there is no compression; the numbers below are for a uniform pressure",
        };
        let certificate = format!("{}: {stand_in}", self.assessment.given.eta);
        vec![row("tension", words), row("certificate as given", certificate)]
    }
}

/// Points along the axes, in words.
pub(crate) fn points(grid: &Grid) -> String {
    let [ny, nx] = grid.shape();
    if grid.is_line() { format!("{nx} points") } else { format!("{ny} x {nx} points") }
}

/// A node in words.
fn place(grid: &Grid, node: usize, units: Units) -> String {
    let ([dy, dx], [_, nx]) = (grid.spacing(), grid.shape());
    let (row, column) = (node / nx, node % nx);
    match grid.is_line() {
        true => format!("node {column} (x = {})", units.position(column as f64 * dx)),
        false => {
            let [y, x] = [row as f64 * dy, column as f64 * dx].map(|it| units.position(it));
            format!("row {row}, column {column} (y = {y}, x = {x})")
        }
    }
}
