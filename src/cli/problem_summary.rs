//! The subject of a solve: surface, grid, solid and solver, which are the same under all loads.

use super::output::{TextRow, row};
use super::units::Units;
use asperity::contact::Problem;
use asperity::error::SetupError;
use asperity::quantity::{length_in_words, pressure_in_words};
use asperity::setup::{Setup, Solid};
use serde::Serialize;
use serde_json::{Map, Value};

/// Surface, grid, solid and solver of a solve, as text and as JSON.
#[derive(Serialize)]
pub(crate) struct ProblemSummary {
    /// The parts of the surface, such as a file, in words.
    pub source: String,
    pub points: Vec<usize>,
    pub size: Vec<f64>,
    /// Distances of rows and columns, or of the nodes of a line.
    pub spacing: Vec<f64>,
    /// Jumps across the period along the same axes.
    pub jump_in_rms_steps: Vec<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
    pub contact_modulus: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hardness: Option<f64>,
    pub prescribed: &'static str,
    /// The solver that is used, with the settings of the setup if it has any.
    pub solver: Map<String, Value>,
    #[serde(skip)]
    pub title: String,
    /// The name and the settings of the solver that is used.
    #[serde(skip)]
    name: String,
    #[serde(skip)]
    settings: String,
    /// The source with its lengths in metres.
    #[serde(skip)]
    source_in_metres: String,
    #[serde(skip)]
    solid: Option<Solid>,
    /// The solid and the boundary, if they are not a periodic half-space.
    #[serde(skip)]
    others: Vec<(&'static str, String)>,
    /// Axes of the arrays outside.
    #[serde(skip)]
    pub rank: usize,
}

impl ProblemSummary {
    /// The summary of a setup and its problem.
    pub(crate) fn new(setup: &Setup, problem: &Problem) -> Result<Self, SetupError> {
        let (surface, rank) = (problem.surface(), setup.surface.rank(&setup.grid)?);
        let (grid, outer) = (surface.grid(), 2 - rank.min(2));
        Ok(Self {
            source: setup.surface.description(),
            points: grid.shape()[outer..].into(),
            size: grid.size()[outer..].into(),
            spacing: grid.spacing()[outer..].into(),
            jump_in_rms_steps: surface.jumps()[outer..].into(),
            seed: surface.seed(),
            contact_modulus: problem.contact_modulus(),
            hardness: setup.law.hardness(),
            prescribed: setup.load.name(),
            solver: described(setup),
            title: setup.surface.title(grid),
            name: solver_of(setup).0,
            settings: solver_of(setup).1,
            source_in_metres: setup.surface.described(Some(&length_in_words)),
            solid: setup.solid.clone(),
            others: others(setup, problem),
            rank,
        })
    }

    /// Surface, points and solver in one line.
    pub(crate) fn line(&self) -> String {
        let points: Vec<String> = self.points.iter().map(usize::to_string).collect();
        format!("{}, {} points, by {}", self.title, points.join(" x "), self.name)
    }

    /// Names and values for reading, with the jumps across the period and the settings of the solver if `is_verbose`.
    pub(crate) fn rows(&self, units: Units, is_verbose: bool) -> Vec<TextRow> {
        let source = if units.metres { &self.source_in_metres } else { &self.source };
        let mut rows =
            vec![row("source", &**source), row("spacing", along_axes(&self.spacing, |length| units.length(length)))];
        if is_verbose {
            let jumps = along_axes(&self.jump_in_rms_steps, |jump| format!("{jump:.3}"));
            rows.push(row("jump across the period", format!("{jumps} rms steps")));
        }
        let modulus = units.pressure(self.contact_modulus);
        rows.push(row("contact modulus E*", format!("{modulus} ({})", self.solid(units))));
        if is_verbose {
            rows.push(row("solver", &*self.settings));
        }
        rows.push(row("prescribed", self.prescribed));
        rows.extend(self.others.iter().map(|(name, value)| row(name, &**value)));
        if let Some(hardness) = self.hardness {
            rows.push(row("hardness H_c", format!("{}, the highest pressure", units.pressure(hardness))));
        }
        rows
    }

    /// The solid in words.
    fn solid(&self, units: Units) -> String {
        match &self.solid {
            Some(solid) if units.pascals => solid.described(&pressure_in_words),
            Some(solid) => solid.description(),
            None => "not given: pressures are divided by it".into(),
        }
    }
}

/// Name and settings of the solver that is used.
pub(crate) fn solver_of(setup: &Setup) -> (String, String) {
    match &setup.adhesion {
        Some(adhesion) => (adhesion.method.name().into(), adhesion.method.words().into()),
        None => (setup.solver().name().into(), setup.solver().settings()),
    }
}

/// The solver that is used, in the form of the section `solver`. Sliding and adhesion have solvers of their own, which have no settings.
fn described(setup: &Setup) -> Map<String, Value> {
    if setup.feels().attraction {
        return [("method".to_owned(), Value::from(solver_of(setup).0))].into_iter().collect();
    }
    let section = match serde_json::to_value(setup.solver) {
        Ok(Value::Object(section)) if setup.solver().name() == setup.solver.name() => section,
        _ => Map::new(),
    };
    let name = Value::from(setup.solver().name());
    section.into_iter().filter(|(key, _)| key != "method").chain([("method".to_owned(), name)]).collect()
}

/// Solid and boundary in words, where they are not a half-space and periodic.
fn others(setup: &Setup, problem: &Problem) -> Vec<(&'static str, String)> {
    let (grid, solid) = (problem.surface().grid(), problem.solid());
    let layer = (!solid.is_half_space()).then(|| ("solid", solid.description()));
    let length = (0..2).filter(|&axis| !grid.periodic()[axis]).map(|axis| grid.size()[axis]).next_back();
    let is_of_lines = grid.is_line() || grid.periodic() != [false; 2];
    let boundary = length.map(|length| {
        let datum = setup.grid.datum.unwrap_or(length);
        let said = format!(", zero displacement at the distance {datum:.6e} from a line load");
        ("boundary", format!("{}{}", grid.boundary(), if is_of_lines { said } else { String::new() }))
    });
    layer.into_iter().chain(boundary).collect()
}

/// One value, or two of the rows and the columns.
pub(crate) fn along_axes(values: &[f64], word: impl Fn(f64) -> String) -> String {
    match *values {
        [y, x] => format!("y {} (rows), x {} (columns)", word(y), word(x)),
        _ => values.iter().copied().map(word).collect(),
    }
}
