//! The verdict on the result of another code, as text and as JSON.

use super::finding::Finding;
use super::output::write_rows;
use super::units::Units;
use asperity::contact::Load;
use asperity::foreign::{Assessment, Disagreement, GivenField, Mistake, Spot};
use asperity::grid::Grid;
use asperity::setup::Setup;
use serde::Serialize;
use std::io::{self, Write};
use std::path::PathBuf;

/// Rows on the contact that do not apply to the result of another code, or that are shown in another form.
const LEFT_OUT: [&str; 3] = ["work", "penetration", "load error"];
/// The name of the mistake that is a wrong load.
const LOAD: &str = "load";
/// A relative error of the load above this value is reported.
const LARGEST_LOAD_ERROR: f64 = 1e-6;
/// Errors of a load, and shares of tension, that are rounding.
const ROUNDING: f64 = 1e-12;

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
        let is_load = |mistake: &&Mistake| mistake.errors == [LOAD];
        let others =
            self.findings.iter().filter(|it| !is_load(it)).map(|mistake| ("finding", mistake.sentence.clone()));
        let has_other_load = self.findings.is_empty() || self.findings.iter().any(|it| is_load(&it));
        let load = self.other_load().filter(|_| !self.holds && has_other_load);
        let unexplained = (!self.holds && self.findings.is_empty() && load.is_none())
            .then(|| "no common mistake explains it: the result is not converged, or it solves another problem".into());
        let mistakes = others.chain([load, unexplained].into_iter().flatten().map(|words| ("finding", words)));
        let own = mistakes.chain(self.own());
        let found = self.finding.rows(self.units).into_iter().chain(self.finding.details(self.units));
        let numbers = found.filter(|(name, _)| !LEFT_OUT.contains(&name.as_str()));
        write_rows(own.map(|(name, value)| (name.to_owned(), value)).chain(numbers), out)
    }

    /// The load that the pressures carry, where another one is prescribed.
    fn other_load(&self) -> Option<String> {
        let is_missed = self.quantity == GivenField::Pressure && self.assessment.load_error > LARGEST_LOAD_ERROR;
        let [found, prescribed] = [self.mean, self.mean_pressure?].map(|pressure| self.units.pressure(pressure));
        is_missed.then(|| format!("the pressures carry {found}, but {prescribed} is prescribed"))
    }

    /// What is wrong with the result, and where.
    fn own(&self) -> Vec<(&'static str, String)> {
        let Assessment { given, load_error, tension, densest, deepest, pressed, closed, apart, unpressed } =
            &self.assessment;
        let place = |node| place(&self.grid, node, self.units);
        let mut rows = vec![
            ("source", self.source.clone()),
            ("contact modulus E*", self.units.pressure(self.contact_modulus)),
            (
                "prescribed",
                match self.prescribed {
                    Some(load) if *load_error > ROUNDING => {
                        format!("{}, with a relative error of {load_error:.1e}", self.units.load(load))
                    }
                    Some(load) => self.units.load(load),
                    None => format!("nothing: the load is that of the {}", self.quantity),
                },
            ),
        ];
        if tension.nodes > 0 && tension.share <= ROUNDING {
            rows.push((
                "tension",
                format!("rounding errors only: {} nodes, {:.1e} of all pressure", tension.nodes, tension.share),
            ));
        } else if tension.nodes > 0 {
            let worst = place(tension.node);
            rows.push((
                "tension",
                format!(
                    "{} nodes, {:.1e} of all pressure, down to {} at {worst}",
                    tension.nodes,
                    tension.share,
                    self.units.pressure(tension.lowest)
                ),
            ));
            let stand_in = match tension.share < 1.0 {
                true => "for the numbers below, tension is set to zero and the load is restored",
                false => "there is no compression; the numbers below are for a uniform pressure",
            };
            rows.push(("certificate as given", format!("{}: {stand_in}", given.eta)));
        }
        rows.extend([
            (
                "error in energy",
                format!("largest density at {}, {:.2} % of the total", place(densest.node), 100.0 * densest.value),
            ),
            ("penetration", format!("{:.1e} rms heights at {}", deepest.value, place(deepest.node))),
            ("contact", format!("{pressed} nodes have pressure, {closed} have a closed gap")),
        ]);
        let disagree = |it: &Disagreement| {
            it.worst.map(|Spot { node, value }| {
                format!("{} nodes, the worst at {}, with a gap of {value:.1e} rms heights", it.nodes, place(node))
            })
        };
        rows.extend(disagree(apart).map(|words| ("pressure across a gap", words)));
        rows.extend(disagree(unpressed).map(|words| ("overlap, no pressure", words)));
        rows
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
