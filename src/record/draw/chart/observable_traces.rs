//! Numbers of observables at every step, and how they are called.

use crate::contact::{Contact, Quantity, Reading, Step, Work};
use rerun::{RecordingStream, RecordingStreamResult, Scalars, TimeColumn};
use std::borrow::Cow;
use strum::IntoEnumIterator;

/// Timeline of relaxation steps.
pub(crate) const STEP: &str = "step";
/// Timeline of seconds spent by the solver.
pub(crate) const SECONDS: &str = "seconds";
/// Timeline of transforms made by the solver.
pub(crate) const TRANSFORMS: &str = "transforms";

/// Observables that are compared between scenes and with an earlier solve.
pub(crate) const COMPARED: [Quantity; 3] = [Quantity::KappaR, Quantity::RelativeArea, Quantity::Certificate];

/// Observables that are recorded for programs, and not drawn.
const NOT_DRAWN: [Quantity; 1] = [Quantity::MeanGap];

/// The observables that are drawn step by step; the certificate as its logarithm.
pub(crate) fn traced() -> impl Iterator<Item = Quantity> {
    Quantity::traced()
}

/// The observables that are recorded step by step.
pub(crate) fn recorded() -> impl Iterator<Item = Quantity> {
    Quantity::iter().filter(|it| it.row().is_traced || NOT_DRAWN.contains(it))
}

pub(crate) fn title(quantity: Quantity) -> String {
    let words = quantity.name().replace('_', " ") + " ";
    let name = words.replace("kappa r ", "kappa_r ").trim_end().to_owned();
    let name = name.replace(" counted", ", nodes counted");
    if is_logarithmic(quantity) { format!("log10 {name} {}", quantity.row().symbol) } else { name }
}

pub(crate) fn is_logarithmic(quantity: Quantity) -> bool {
    quantity == Quantity::Certificate
}

/// The name of the entity that is drawn for an observable.
pub(crate) fn drawn(quantity: Quantity) -> String {
    let end = if is_logarithmic(quantity) { "_log10" } else { "" };
    format!("{}{end}", quantity.name())
}

/// Curves of observables.
#[derive(Debug, Clone)]
pub(crate) struct ObservableTraces(pub Vec<(Quantity, Trace)>);

/// A number of every step, each with the work up to it.
#[derive(Debug, Clone, Default)]
pub(crate) struct Trace(pub Vec<(Work, f64)>);

impl ObservableTraces {
    pub(crate) fn new(quantities: impl Iterator<Item = Quantity>) -> Self {
        Self(quantities.map(|quantity| (quantity, Trace::default())).collect())
    }

    pub(crate) fn add(&mut self, step: &Step<'_>) {
        let reading = Reading::from(step);
        for (quantity, trace) in &mut self.0 {
            trace.add(step.work(), reading.get(*quantity));
        }
    }

    /// Ends with the numbers of the contact, whose fields are the last frame: they take the place of those of the last step, which may be
    /// another state.
    pub(crate) fn end(&mut self, contact: &Contact) {
        let reading = Reading::from(contact);
        for (quantity, trace) in &mut self.0 {
            trace.0.pop_if(|(work, _)| work.iterations == contact.work.iterations);
            trace.add(contact.work, reading.get(*quantity));
        }
    }
}

impl Trace {
    /// The curve of an observable that is drawn of these values.
    pub(crate) fn drawn(&self, quantity: Quantity) -> Cow<'_, Self> {
        if !is_logarithmic(quantity) {
            return Cow::Borrowed(self);
        }
        let logarithms = self.0.iter().map(|&(work, value)| (work, value.log10()));
        Cow::Owned(Self(logarithms.filter(|(_, logarithm)| logarithm.is_finite()).collect()))
    }

    /// Adds a value; one that is not finite is left out.
    pub(crate) fn add(&mut self, work: Work, value: Option<f64>) {
        self.0.extend(value.filter(|value| value.is_finite()).map(|value| (work, value)));
    }

    /// Sends its values under `entity`, each at the time at which it was added.
    pub(crate) fn log(&self, to: &RecordingStream, entity: String) -> RecordingStreamResult<()> {
        if self.0.is_empty() {
            return Ok(());
        }
        let times = times(&self.0);
        to.send_columns(entity, times, Scalars::new(self.0.iter().map(|(_, value)| *value)).columns_of_unit_batches()?)
    }
}

/// The times of values, each with the work up to it.
pub(crate) fn times<T>(values: &[(Work, T)]) -> [TimeColumn; 3] {
    let work = || values.iter().map(|(work, _)| work);
    [
        TimeColumn::new_sequence(STEP, work().map(|work| work.iterations as i64)),
        TimeColumn::new_duration_secs(SECONDS, work().map(|work| work.seconds)),
        TimeColumn::new_sequence(TRANSFORMS, work().map(|work| work.transforms as i64)),
    ]
}
