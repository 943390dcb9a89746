//! The recording of a history: one frame for each state.

use super::history::HistoryOutcome;
use crate::contact::{Problem, Quantity, State, Unit};
use crate::error::FileError;
use crate::plot::Colour;
use crate::record::{CurveKind, FurtherField, LoadAxis, LoadRecording, Loads, Options, RecordedCurve, Scene, Timeline};
use crate::setup::Setup;
use std::path::Path;

/// The largest distance of surfaces apart that a picture has room for, in heights of the highest peak.
const MOST_APART: f64 = 3.0;

/// Quantities whose curves stand first, in the rows of their own.
const FIRST: [Quantity; 5] =
    [Quantity::Friction, Quantity::MeanPressure, Quantity::RelativeArea, Quantity::Dissipated, Quantity::KappaR];

impl HistoryOutcome {
    /// Writes a recording of all states, on the timelines `step` and, where states have times, the one of [`Timeline::States`].
    ///
    /// # Errors
    /// [`FileError::Target`] and [`FileError::Write`] for a file that cannot be made or written.
    pub fn record(&self, path: &Path, setup: &Setup, problem: &Problem) -> Result<(), FileError> {
        let Some(highest) =
            self.states.iter().max_by(|a, b| a.contact.max_pressure().total_cmp(&b.contact.max_pressure()))
        else {
            return Ok(());
        };
        let scene = Scene {
            exact: None,
            apart: self.apart(problem),
            further: self.further(problem),
            ..Scene::from_setup(setup, &highest.contact.problem)
        };
        let curves = self.curves();
        let loads = Loads {
            title: format!("{}, {} states", scene.title, self.states.len()),
            description: format!("{}. {}.", setup.surface.description(), self.states[0].claim.words()),
            captions: (0..self.states.len()).map(|i| self.caption(i)).collect(),
            curves: curves.iter().map(|it| recorded(*it)).collect(),
            axis: self.axis(),
            figure: None,
            timeline: Timeline::States(self.states.iter().filter_map(|state| state.get(Quantity::Time)).collect()),
            scenes: &[scene],
        };
        let recording = LoadRecording::create(path, &loads, Options::from(setup))?;
        for (i, state) in self.states.iter().enumerate() {
            let values: Vec<f64> = curves.iter().map(|it| state.value(*it)).collect();
            recording.values(i, &values)?;
            let further: Vec<(&'static str, &[f64])> =
                state.fields.iter().map(|it| (it.name, it.values.as_slice().unwrap_or_default())).collect();
            recording.state(0, i, &state.contact, &further)?;
        }
        recording.finish()
    }

    /// The largest distance between the surfaces where they are closest, as far as a picture has room for it.
    fn apart(&self, problem: &Problem) -> f64 {
        let least = |state: &State| state.contact.gap.iter().copied().fold(f64::INFINITY, f64::min);
        let most = self.states.iter().map(least).fold(0.0, f64::max);
        most.min(MOST_APART * problem.highest())
    }

    /// The quantities with curves, the most important ones first.
    fn curves(&self) -> Vec<Quantity> {
        let axis = self.kind.row().axis;
        let changes = |it: &Quantity| {
            let values = self.states.iter().filter_map(|state| state.get(*it));
            let values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
            values.iter().any(|value| *value != values[0]) || values.len() == 1
        };
        let all = self.quantities().into_iter();
        let mut curves: Vec<_> = all.filter(|it| Some(*it) != axis && it.row().has_curve && changes(it)).collect();
        curves.sort_by_key(|it| FIRST.iter().position(|first| first == it).unwrap_or(FIRST.len()));
        curves
    }

    /// The axis of the charts: time, speed, or the number of the state.
    fn axis(&self) -> LoadAxis {
        let row = self.kind.row();
        match row.axis {
            Some(it) if row.is_logarithmic => LoadAxis::log(it.name(), self.values(it)),
            Some(it) => LoadAxis::linear(it.name(), self.values(it)),
            None => LoadAxis::linear("state", (1..=self.states.len()).map(|i| i as f64).collect()),
        }
    }

    /// The state in a few words.
    fn caption(&self, i: usize) -> String {
        let state = &self.states[i];
        let words = self.kind.row().caption.iter().filter_map(|it| {
            let value = state.get(*it)?;
            Some(format!("{} {}", it.row().title, crate::quantity::number_in_words(value)))
        });
        let words: Vec<String> = words.collect();
        if words.is_empty() { format!("state {}", i + 1) } else { words.join(", ") }
    }

    /// The further fields, with their ranges over all states.
    fn further(&self, problem: &Problem) -> Vec<FurtherField> {
        let Some(first) = self.states.first() else { return Vec::new() };
        let field = |place: usize| {
            let it = &first.fields[place];
            let values = self.states.iter().filter_map(|state| state.fields.get(place)).flat_map(|it| it.values.iter());
            let ends = [f64::INFINITY, f64::NEG_INFINITY];
            let range = values.fold(ends, |[low, high], value| [low.min(*value), high.max(*value)]);
            let unit = match it.is_pressure {
                true => (it.symbol, problem.contact_modulus()),
                false => (it.symbol, problem.rms_height()),
            };
            FurtherField::new(it.name, it.title, unit, range)
        };
        (0..first.fields.len()).map(field).collect()
    }
}

/// A quantity as a curve of a recording.
fn recorded(quantity: Quantity) -> RecordedCurve {
    let colour = if quantity.row().unit == Unit::One { Colour::ORANGE } else { Colour::SKY };
    let title = quantity.row().title;
    RecordedCurve { view: capital(title), name: title.into(), colour: colour.0, kind: CurveKind::Computed }
}

/// A title that begins with a capital letter, unless it is a symbol.
fn capital(title: &str) -> String {
    if title.contains('_') {
        return title.into();
    }
    let mut letters = title.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}
