//! A state that several objects of Python share.

use asperity::contact::State;
use std::ops::Deref;
use std::sync::Arc;

/// A state, whose contact it stands for: its fields are in memory once, however many objects show them.
#[derive(Clone)]
pub struct SharedState(pub Arc<State>);

impl Deref for SharedState {
    type Target = asperity::Contact;

    fn deref(&self) -> &asperity::Contact {
        &self.0.contact
    }
}

impl From<State> for SharedState {
    fn from(state: State) -> Self {
        Self(Arc::new(state))
    }
}

impl From<asperity::Contact> for SharedState {
    fn from(contact: asperity::Contact) -> Self {
        Self(Arc::new(State::from_contact(contact, None)))
    }
}
