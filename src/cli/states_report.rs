//! The report of several states, whatever leads from one to the next: loads one after the other, creep, slip, sliding, rolling, adhesion and yielding.

use super::adhesion;
use super::finding::exact_words;
use super::history_picture;
use super::imprint;
use super::output::{row, write_rows};
use super::outputs::Outputs;
use super::picture;
use super::problem_summary::ProblemSummary;
use super::report::SolveReport;
use super::units::Units;
use anyhow::Result;
use asperity::contact::{Observables, Problem, Quantity, QuantityKind, ResultClaim, StateRow, Unit, archive_of_states};
use asperity::error::HistoryError;
use asperity::job::{AdhesionOutcome, HistoryOutcome};
use asperity::plot::Figure;
use asperity::quantity::number_in_words;
use asperity::setup::Setup;
use asperity::theory::Exact;
use serde::Serialize;
use serde_json::{Map, Value};
use std::io::{self, Write};
use std::path::Path;

/// Columns of what flows, where it was asked for.
const FLOW_COLUMNS: [Quantity; 3] = [Quantity::HydraulicGapX, Quantity::HydraulicGapY, Quantity::ConductancePerArea];

/// Everything that a script may want to know about the states of a run, and the setup that repeats it.
#[derive(Serialize)]
pub(crate) struct StatesReport {
    #[serde(flatten)]
    subject: ProblemSummary,
    process: &'static str,
    /// The claim of all states, in words: what their certificates prove. With adhesion each state has its own.
    claim: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    adhesion: Option<AdhesionOutcome>,
    states: Vec<Map<String, Value>>,
    /// Totals over all states, such as the largest area and the number of transforms, by the names of their quantities.
    totals: Map<String, Value>,
    /// Energy lost in each closed cycle of the path, per area of the cell.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    energy_per_cycle: Vec<f64>,
    /// The estimated errors of these by the steps in time or of the path, one for each cycle; null where a cycle has none.
    #[serde(skip_serializing_if = "has_no_errors")]
    energy_per_cycle_error: Vec<Option<f64>>,
    /// Why the run ended before its path did, if it did.
    #[serde(skip_serializing_if = "Option::is_none")]
    ended: Option<String>,
    warnings: Vec<String>,
    #[serde(serialize_with = "Setup::serialize_saved")]
    setup: Setup,
    #[serde(skip)]
    pub outcome: HistoryOutcome,
    /// Whether the cell repeats.
    #[serde(skip)]
    has_neighbours: bool,
    #[serde(skip)]
    units: Units,
}

/// The numbers of a state, by their names, with the exact solution where there is one.
fn object(number: usize, row: &StateRow, exact: Option<&Exact>) -> Map<String, Value> {
    let claim: &str = row.claim.into();
    let mut object = Map::new();
    object.insert("state".into(), Value::from(number + 1));
    object.insert("status".into(), word(row.status));
    object.insert("claim".into(), Value::from(claim));
    object.extend(numbers(&row.numbers));
    if let Some(exact) = exact {
        object.insert("exact".into(), word(exact));
    }
    object
}

/// Numbers by their names as JSON.
fn numbers(of: &[(Quantity, f64)]) -> impl Iterator<Item = (String, Value)> {
    of.iter().map(|(quantity, value)| (quantity.name().to_owned(), number_of(*quantity, *value)))
}

/// A number as JSON.
fn number_of(quantity: Quantity, value: f64) -> Value {
    match quantity.row().kind {
        QuantityKind::Flag => Value::from(value == 1.0),
        QuantityKind::Whole => Value::from(value as u64),
        QuantityKind::Number | QuantityKind::Bound => Value::from(value),
    }
}

/// A value as JSON.
fn word(value: impl Serialize) -> Value {
    serde_json::to_value(value).unwrap_or_default()
}

impl StatesReport {
    /// The report of a run that has found states of a problem.
    ///
    /// # Errors
    /// The errors of [`ProblemSummary::new`].
    pub(crate) fn new(
        setup: Setup,
        problem: &Problem,
        outcome: HistoryOutcome,
        warnings: Vec<String>,
        units: Units,
    ) -> Result<Self> {
        let cycles = outcome.cycles(&setup);
        let grid = problem.surface().grid();
        let mut states = Vec::new();
        for (number, row) in outcome.rows.iter().enumerate() {
            let pressure = row.get(Quantity::MeanPressure).unwrap_or(f64::NAN);
            let exact = setup.exact(grid, pressure);
            states.push(object(number, row, exact.as_ref()));
        }
        Ok(Self {
            subject: ProblemSummary::new(&setup, problem)?,
            process: outcome.drive.name,
            claim: match outcome.drive.has_claims {
                true => "each state has a claim of its own",
                false => outcome.claim().map_or("", ResultClaim::words),
            },
            adhesion: outcome.adhesion.clone(),
            states,
            totals: numbers(&outcome.totals).collect(),
            energy_per_cycle: cycles.iter().map(|it| it.energy).collect(),
            energy_per_cycle_error: cycles.iter().map(|it| it.error).collect(),
            ended: outcome.ended.as_ref().map(HistoryError::to_string),
            warnings,
            setup,
            outcome,
            has_neighbours: grid.is_periodic(),
            units,
        })
    }

    /// The columns of the table for reading: what the drive shows and what flows, as far as some state has it, with the area of the exact
    /// solution, how the solver stopped where it has missed a goal, and the claims, where there are any.
    fn columns(&self) -> Vec<WordColumn> {
        let Self { outcome, units, .. } = self;
        let mut columns = Vec::new();
        for quantity in outcome.drive.columns.iter().chain(&FLOW_COLUMNS) {
            if is_shown(*quantity, &outcome.rows) {
                let words = outcome.rows.iter().map(|row| cell(*quantity, row, *units)).collect();
                columns.push(WordColumn { heading: quantity.row().short, words });
            }
        }
        columns.extend(self.exact_areas());
        if outcome.rows.iter().any(|row| row.fault.is_some()) {
            let words = outcome.rows.iter().map(|row| row.status.name().to_owned()).collect();
            columns.push(WordColumn { heading: "status", words });
        }
        if outcome.drive.has_claims {
            let words = outcome.rows.iter().map(|row| <&str>::from(row.claim).to_owned()).collect();
            columns.push(WordColumn { heading: "claim", words });
        }
        columns
    }

    /// The areas of the exact solution, of a list of loads on an indenter that has one.
    fn exact_areas(&self) -> Option<WordColumn> {
        let exact = |state: &Map<String, Value>, key: &str| state.get("exact")?.get(key).cloned();
        let name = self.states.iter().find_map(|state| exact(state, "name"))?;
        let heading = match exact_words(name.as_str()?, self.has_neighbours) {
            "exact" => "exact area",
            _ => "area without neighbouring cells",
        };
        let mut words = Vec::new();
        for state in &self.states {
            // a contact that would not fit into the cell has no such solution
            let area = exact(state, "relative_area").and_then(|area| area.as_f64());
            words.push(area.map_or("-".into(), number_in_words));
        }
        Some(WordColumn { heading, words })
    }

    /// Writes the largest errors of all states by their sources, where they were estimated.
    fn write_errors(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut lines = Vec::new();
        // This error is relative, and is printed in percent. All others are in the unit of their quantity.
        let errors = self.outcome.rows.iter().filter_map(|row| row.get(Quantity::PressureInContactError));
        if let Some(error) = errors.reduce(f64::max) {
            lines.push(format!("largest estimated error of p_m / Y by the grid: {:.1} %", 1e2 * error));
        }
        for quantity in Quantity::all() {
            let mut sources = Vec::new();
            for error in quantity.row().errors.iter().filter_map(|name| Quantity::find(name)) {
                if let (Some(largest), Some(cause)) = (self.largest(error), error.row().cause()) {
                    sources.push(format!("{largest} by {cause}"));
                }
            }
            if !sources.is_empty() {
                let name = quantity.row().short;
                lines.push(format!("largest estimated error of the {name}: {}", sources.join(", ")));
            }
        }
        if lines.is_empty() { Ok(()) } else { writeln!(out, "\n{}", lines.join("\n")) }
    }

    /// The largest value of a quantity among all states, in words.
    fn largest(&self, quantity: Quantity) -> Option<String> {
        let known = self.outcome.rows.iter().filter(|row| row.get(quantity).is_some());
        let largest = known.max_by(|one, two| one.value(quantity).total_cmp(&two.value(quantity)))?;
        Some(cell(quantity, largest, self.units))
    }

    /// The energies that the cycles lost, each with its error over the energy, where there is one.
    fn write_cycles(&self, out: &mut dyn Write) -> io::Result<()> {
        if self.energy_per_cycle.is_empty() {
            return Ok(());
        }
        let mut energies = Vec::new();
        for (i, energy) in self.energy_per_cycle.iter().enumerate() {
            let error = self.energy_per_cycle_error[i].filter(|error| *error > 0.0);
            let relative = error.map_or_else(String::new, |error| format!(" (relative error {:.1e})", error / energy));
            energies.push(self.units.energy_per_area(*energy) + &relative);
        }
        writeln!(out, "\nenergy lost per cycle and area: {}", energies.join(", "))
    }
}

impl SolveReport for StatesReport {
    fn setup(&self) -> &Setup {
        &self.setup
    }

    fn warnings(&self) -> &[String] {
        &self.warnings
    }

    fn has_lost_recording(&self) -> bool {
        self.outcome.failure.is_some()
    }

    fn archive(&self) -> io::Result<Vec<u8>> {
        let text = self.setup.to_saved_toml();
        archive_of_states(&self.outcome.states, self.subject.rank, &text).map_err(io::Error::other)
    }

    fn write_table(&self, path: &Path) -> Result<()> {
        Ok(self.outcome.write_table(path)?)
    }

    fn figure(&self) -> Figure {
        let (title, outcome) = (&self.subject.title, &self.outcome);
        if !outcome.drive.is_list {
            return history_picture::draw(title, outcome, self.units);
        }
        let observables: Vec<Observables> = outcome.rows.iter().map(StateRow::observables).collect();
        picture::of_loads(title, &observables, self.setup.load, self.units)
    }

    /// The imprint of the last state, of a body that yields.
    fn write_further_files(&self, outputs: &Outputs) -> Result<()> {
        match (&outputs.imprint, self.outcome.states.last()) {
            (Some(path), Some(last)) => imprint::write(path, last),
            _ => Ok(()),
        }
    }

    fn write_text(&self, is_verbose: bool, out: &mut dyn Write) -> io::Result<()> {
        let Self { outcome, units, .. } = self;
        let count = outcome.rows.len();
        let states = if count == 1 { "1 state".to_owned() } else { format!("{count} states") };
        writeln!(out, "{}: {}, {states}", self.subject.line(), self.process)?;
        let mut rows = self.subject.rows(*units, is_verbose);
        // states that differ in what they claim have a column for it
        if !outcome.drive.has_claims {
            rows.push(row("claim", self.claim));
        }
        if let Some(adhesion) = &self.adhesion {
            rows.extend(adhesion::rows(adhesion, *units));
        }
        write_rows(rows, out)?;
        writeln!(out)?;
        write_columns(&self.columns(), out)?;
        if let Some(adhesion) = &self.adhesion
            && (count > 1 || adhesion.totals.separated)
        {
            adhesion::write_totals(adhesion, *units, out)?;
        }
        self.write_errors(out)?;
        self.write_cycles(out)
    }
}

/// A column of the table for reading: its heading, and a word for each state.
struct WordColumn {
    heading: &'static str,
    words: Vec<String>,
}

impl WordColumn {
    /// The letters of the longest word, or of the heading if that is longer.
    fn width(&self) -> usize {
        let length = |word: &str| word.chars().count();
        self.words.iter().map(|word| length(word)).fold(length(self.heading), usize::max)
    }
}

/// Writes columns beside each other, each as wide as its widest word, with the words to the right.
fn write_columns(columns: &[WordColumn], out: &mut dyn Write) -> io::Result<()> {
    let widths: Vec<usize> = columns.iter().map(WordColumn::width).collect();
    for (column, width) in columns.iter().zip(&widths) {
        write!(out, "   {:>width$}", column.heading)?;
    }
    writeln!(out)?;
    let states = columns.first().map_or(0, |column| column.words.len());
    for state in 0..states {
        for (column, width) in columns.iter().zip(&widths) {
            write!(out, "   {:>width$}", column.words[state])?;
        }
        writeln!(out)?;
    }
    Ok(())
}

/// Whether no cycle has an estimated error.
fn has_no_errors(errors: &[Option<f64>]) -> bool {
    errors.iter().all(Option::is_none)
}

/// Whether a column of a quantity is shown: where some state has it. Errors of the path are shown where there are any, since exact steps have none.
fn is_shown(quantity: Quantity, rows: &[StateRow]) -> bool {
    let least = match quantity {
        Quantity::ShiftPathError | Quantity::DissipatedPathError => 0.0,
        _ => f64::NEG_INFINITY,
    };
    rows.iter().any(|row| row.get(quantity).is_some_and(|value| value > least))
}

/// A number of a state with its unit, where that is known; a dash where there is none, or where the grid does not resolve it.
fn cell(quantity: Quantity, state: &StateRow, units: Units) -> String {
    let Some(value) = state.resolved(quantity) else { return "-".into() };
    let row = quantity.row();
    // the unit of a conductance is that of the resistivities in the scene, and not one of the table of quantities
    if let (Quantity::ConductancePerArea, Some(unit)) = (quantity, units.conductance) {
        return format!("{} {unit}", number_in_words(value));
    }
    match row.unit {
        Unit::Length => units.length(value),
        Unit::Pressure => units.pressure(value),
        Unit::EnergyPerArea => units.energy_per_area(value),
        _ if row.kind == QuantityKind::Bound => format!("{value:.1e}"),
        _ => number_in_words(value),
    }
}
