//! Warnings of the library as warnings of Python, with keywords as remedies.

use crate::contact::Contact;
use crate::warn::warn_sentence;
use crate::words::given_as;
use asperity::contact::Status;
use asperity::job::warnings_of_contacts;
use asperity::warning::{Remedy, Warning};
use pyo3::prelude::*;

/// Warnings about contacts under one load or several, and about their surface.
pub fn warnings_about(contacts: &[&Contact]) -> Vec<Warning> {
    let Some(first) = contacts.first() else { return Vec::new() };
    let all: Vec<&asperity::Contact> = contacts.iter().map(|it| &*it.contact).collect();
    let mut warnings = first.setup.surface.warnings(&first.surface);
    warnings.extend(warnings_of_contacts(&first.setup, &all));
    warnings
}

/// The warning that a solver did not converge, or that its recording failed. There is none for a run that somebody has stopped.
pub fn warning_of_failure(contact: &asperity::Contact) -> Option<String> {
    contact.fault().filter(|_| contact.status != Status::StoppedByObserver).map(|fault| fault.to_string())
}

/// Raises warnings.
pub fn warn(py: Python<'_>, warnings: &[Warning]) -> PyResult<()> {
    warnings.iter().try_for_each(|warning| warn_sentence(py, &warning.in_words(keyword)))
}

/// The keyword of a remedy, such as `refine='auto'` or `law={'hardness': ...}`.
fn keyword(remedy: &Remedy) -> Option<String> {
    let value = match remedy.value.as_deref() {
        None => "...".into(),
        Some(value) if value.parse::<f64>().is_ok() => value.into(),
        Some(values) if values.contains(',') => format!("({})", values.replace(',', ", ")),
        Some(name) => format!("'{name}'"),
    };
    given_as(remedy.key, &value)
}
