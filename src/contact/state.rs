//! A state: a contact that a process has made, whatever process it is.

use crate::contact::{
    Contact, CutLayers, FieldKind, Observables, Quantity, Reading, ResultClaim, StateField, StateValues, Work,
};
use crate::surface::Field;
use std::sync::OnceLock;
use strum::IntoEnumIterator;

/// A state: a contact, and what the process that has made it knows besides. One contact alone is a state as well.
#[derive(Debug, Clone)]
pub struct State {
    /// The contact under the normal load of the state, with the numbers of the process among its [`values`](Contact::values), and with the work since the
    /// state before.
    pub contact: Contact,
    /// The point of the path that it has reached, from 0; none between two points.
    pub point: Option<usize>,
    /// The claim of the state: what its certificate proves about energy, pressure and mean gap.
    pub claim: ResultClaim,
    /// Further fields of the process.
    pub fields: Vec<StateField>,
    /// The layers of the cut that some of the fields lie in; none where there are no such fields.
    pub layers: Option<CutLayers>,
    /// All numbers, after they were read.
    numbers: OnceLock<Vec<(Quantity, f64)>>,
}

impl State {
    /// The state of a contact that was solved for itself.
    pub fn from_contact(contact: Contact, point: Option<usize>) -> Self {
        let claim = contact.claim();
        Self::new(contact, claim).at(point)
    }

    /// The state of a contact with a claim, between two points, without further fields. The solution of a contact that is not converged is not
    /// claimed.
    pub fn new(contact: Contact, claim: ResultClaim) -> Self {
        let claim = claim.if_converged(&contact);
        Self { contact, point: None, claim, fields: Vec::new(), layers: None, numbers: OnceLock::new() }
    }

    /// The state at a point of the path, from 0.
    pub fn at(self, point: Option<usize>) -> Self {
        Self { point, ..self }
    }

    /// The state with further fields.
    pub fn with_fields(self, fields: Vec<StateField>) -> Self {
        Self { fields, ..self }
    }

    /// The state with the layers of the cut that some of its fields lie in.
    pub fn with_layers(self, layers: Option<CutLayers>) -> Self {
        Self { layers, ..self }
    }

    /// The state with the first layers of its cut alone, if it has a cut. It keeps all of them where there are fewer.
    pub fn down_to(mut self, layers: usize) -> Self {
        self.layers.iter_mut().for_each(|it| it.interfaces.truncate(layers + 1));
        self.fields = self.fields.into_iter().map(|field| field.down_to(layers)).collect();
        self
    }

    /// The state with more numbers of its process.
    pub fn with_numbers(self, numbers: &[(Quantity, f64)]) -> Self {
        let values = self.contact.values().clone();
        let values = numbers.iter().fold(values, |values, (quantity, value)| values.with(*quantity, *value));
        Self { contact: self.contact.with_values(values), numbers: OnceLock::new(), ..self }
    }

    /// The state of a contact whose numbers and further fields were saved. Its kind is that of the [`values`](Contact::values) of the contact.
    pub fn from_parts(
        contact: Contact,
        (point, claim): (Option<usize>, ResultClaim),
        number: impl Fn(Quantity) -> Option<f64>,
        fields: Vec<StateField>,
    ) -> Self {
        let none = StateValues::new(contact.values().feels);
        // The numbers as they were saved, also those that could be read of the contact: some belong to the way to the state.
        let values = Quantity::iter().fold(none, |values, it| values.with(it, number(it)));
        let values = if claim == ResultClaim::Separated { values.parted() } else { values };
        let transforms = number(Quantity::Transforms).map_or(contact.work.transforms, |it| it as u64);
        let work = Work { transforms, ..contact.work };
        let contact = contact.with_work(work).with_values(values);
        Self::new(contact, claim).at(point).with_fields(fields)
    }

    /// A number of the state, if it has it. Whoever wants many of them reads all of them first, see [`State::numbers`].
    pub fn get(&self, quantity: Quantity) -> Option<f64> {
        if let Some(own) = self.contact.values().get(quantity) {
            return Some(own).filter(|value| !value.is_nan());
        }
        if quantity.row().is_known_by_process {
            return None;
        }
        match self.numbers.get() {
            Some(numbers) => numbers.iter().find(|(other, _)| *other == quantity).map(|(_, value)| *value),
            None if quantity.tells_of(&self.contact) => Reading::from(&self.contact).get(quantity),
            None => None,
        }
    }

    /// The same; NaN where the state does not have it.
    pub fn value(&self, quantity: Quantity) -> f64 {
        self.get(quantity).unwrap_or(f64::NAN)
    }

    /// All numbers of the state, in the order of the table, read once: the contact is not to be changed afterwards.
    pub fn numbers(&self) -> &[(Quantity, f64)] {
        self.numbers.get_or_init(|| {
            let reading = Reading::from(&self.contact);
            let told = Quantity::iter().filter(|it| it.tells_of(&self.contact));
            told.filter_map(|it| Some((it, reading.get(it)?))).collect()
        })
    }

    /// A further field, if the state has it.
    pub fn field(&self, kind: FieldKind) -> Option<&Field> {
        self.fields.iter().find(|it| it.kind == kind).map(|it| &it.values)
    }
}

impl Observables {
    /// All of them of a state, whose numbers are read once.
    pub fn of_state(state: &State) -> Self {
        Self::of_numbers(state.numbers())
    }

    /// All of them by the numbers of a state; NaN where these have none.
    pub fn of_numbers(numbers: &[(Quantity, f64)]) -> Self {
        let value =
            |quantity| numbers.iter().find(|(other, _)| *other == quantity).map_or(f64::NAN, |(_, value)| *value);
        Self::by(value)
    }
}
