//! States of histories that are read from a file, certified as far as their fields allow.

use super::doubts::Doubts;
use super::state_check::StateCheck;
use crate::contact::{
    ArchiveReader, Contact, CutLayers, FieldKind, Load, Problem, Quantity, ResultClaim, SavedContact, State,
    StateField, StateKind, StateValues, Status, read_cut_layers, read_state_fields,
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
        let wrong = |reason: String| FileError::Format { path: reader.path().into(), what: "result", reason };
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

/// The states of a history of a problem, each certified as far as its fields allow. A state that is not confirmed, or cannot be, has no claim.
///
/// # Errors
/// For arrays that do not fit each other.
pub(super) fn certified_states(
    reader: &ArchiveReader,
    contacts: Vec<SavedContact>,
    setup: &Setup,
    problem: &Problem,
    doubts: &mut Doubts<'_>,
) -> Result<Vec<State>, StudyError> {
    let columns = StateColumns::read(reader)?;
    let mut check = StateCheck::new(setup, problem)?;
    let kind = setup.process()?.map_or_else(StateKind::default, |it| it.row().state);
    let mut states = Vec::with_capacity(contacts.len());
    for (number, saved) in contacts.into_iter().enumerate() {
        let (point, claim) = (columns.points[number], columns.claims[number]);
        let of = |quantity: Quantity| columns.number(quantity, number);
        let under = under_load(setup, problem, point, &saved);
        let under = check.moving(under, of(Quantity::Speed))?;
        let parts = ([saved.pressure, saved.displacement, saved.gap], (saved.certificate, saved.work, saved.status));
        let contact = Contact::from_parts(under, parts.0, parts.1, saved.solver, saved.coarser);
        let contact = contact.map_err(SetupError::from)?.with_values(StateValues::new(kind));
        let state = State::from_parts(contact, (point, claim), of, columns.fields(number));
        let mut state = state.with_layers(columns.layers.clone());
        let found = check.doubts(&mut state)?;
        if !found.is_empty() {
            state.claim = ResultClaim::Unchecked;
            state.contact.status = Status::Unconfirmed;
        }
        doubts.add(Some(number), found);
        states.push(state);
    }
    Ok(states)
}

/// The problem under the load of a state: that of the point of the path, or its mean pressure between two points.
fn under_load(setup: &Setup, problem: &Problem, point: Option<usize>, contact: &SavedContact) -> Problem {
    let path = setup.path_points();
    if setup.adhesion.is_some() {
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
