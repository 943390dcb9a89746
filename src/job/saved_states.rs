//! States of histories that are read from a file.

use crate::contact::{
    ArchiveReader, CutLayers, FieldKind, Load, Problem, Quantity, ResultClaim, SavedContact, State, StateField,
    StateValues, read_cut_layers, read_state_fields,
};
use crate::error::{FileError, SetupError, StudyError};
use crate::setup::Setup;
use crate::surface::Field;
use ndarray::Axis;
use strum::IntoEnumIterator;

/// Numbers that all states have, and that may be undefined.
const ALWAYS: [Quantity; 2] = [Quantity::RelativeArea, Quantity::KappaR];

/// The numbers and fields of the states in a file besides their contacts.
struct StateColumns {
    numbers: Vec<(Quantity, Vec<f64>)>,
    /// The fields that the states have, each with its values in all of them.
    fields: Vec<(FieldKind, Vec<Field>)>,
    claims: Vec<ResultClaim>,
    points: Vec<Option<usize>>,
    /// The layers of the cut below a solid that yields.
    layers: Option<CutLayers>,
}

impl StateColumns {
    fn read(reader: &ArchiveReader) -> Result<Self, FileError> {
        let mut numbers = Vec::new();
        for quantity in Quantity::iter() {
            numbers.extend(reader.numbers(quantity.name())?.map(|values| (quantity, values)));
        }
        let wrong =
            |reason: String| FileError::Format { path: reader.path().into(), what: "result", reason: reason.into() };
        let claim = |word: String| word.parse().map_err(|_| wrong(format!("its claim {word:?} is not known")));
        let claims = reader.words("claim")?.into_iter().map(claim).collect::<Result<_, _>>()?;
        let points = reader.words("point")?.iter().map(|word| word.parse().ok()).collect();
        let (fields, layers) = (read_state_fields(reader)?, read_cut_layers(reader)?);
        Ok(Self { numbers, fields, claims, points, layers })
    }

    /// A number of a state, if it has it.
    fn number(&self, quantity: Quantity, state: usize) -> Option<f64> {
        let (_, values) = self.numbers.iter().find(|(known, _)| *known == quantity)?;
        Some(values[state]).filter(|it| !it.is_nan() || ALWAYS.contains(&quantity))
    }

    /// The further fields of a state.
    fn fields(&self, state: usize) -> Vec<StateField> {
        self.fields.iter().map(|(kind, of)| StateField::new(*kind, of[state].clone())).collect()
    }
}

/// The states of a history of a problem, as they were saved.
///
/// # Errors
/// For arrays that do not fit each other.
pub(super) fn saved_states(
    reader: &ArchiveReader,
    contacts: Vec<SavedContact>,
    setup: &Setup,
    problem: &Problem,
) -> Result<Vec<State>, StudyError> {
    let columns = StateColumns::read(reader)?;
    let mut states = Vec::with_capacity(contacts.len());
    for (number, saved) in contacts.into_iter().enumerate() {
        let (point, claim) = (columns.points[number], columns.claims[number]);
        let of = |quantity: Quantity| columns.number(quantity, number);
        let under = moving(setup, under_load(setup, problem, point, &saved), of(Quantity::Speed))?;
        let contact = saved.into_contact(under).map_err(SetupError::from)?.with_values(StateValues::new(setup.feels()));
        let state = State::from_parts(contact, (point, claim), of, columns.fields(number));
        states.push(state.with_layers(columns.layers.clone()));
    }
    Ok(states)
}

/// The problem of a state: at rest, or at its speed where that is one of the setup.
fn moving(setup: &Setup, problem: Problem, speed: Option<f64>) -> Result<Problem, SetupError> {
    let is_of_setup = |speed: &f64| setup.sliding.iter().any(|it| it.speed.contains(speed));
    match speed.filter(is_of_setup) {
        Some(speed) => Ok(problem.sliding(speed, &setup.memory()?)?),
        None => Ok(problem),
    }
}

/// The problem under the load of a state: that of the point of the path, or its mean pressure between two points.
fn under_load(setup: &Setup, problem: &Problem, point: Option<usize>, contact: &SavedContact) -> Problem {
    let path = setup.path_points();
    if setup.feels().attraction {
        // no load of another contact is one with adhesion, but at an approach the displacement contains the uniform one
        let like = Load::Approach(0.5 * problem.highest());
        let posed = matches!(setup.load, Load::Approach(_)).then(|| problem.clone().with_load(like).ok()).flatten();
        return posed.unwrap_or_else(|| problem.clone());
    }
    let mean = contact.pressure.mean_axis(Axis(1)).and_then(|rows| rows.mean()).unwrap_or(0.0);
    let load = match (point.and_then(|at| path.get(at)), setup.load) {
        (Some(point), _) => point.load,
        (None, load) if path.is_empty() || !load.is_pressure() => load,
        (None, load) => load.with_value(load.value() * mean / problem.mean_pressure().unwrap_or(mean)),
    };
    problem.clone().with_load(load).unwrap_or_else(|_| problem.clone())
}
