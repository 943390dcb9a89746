//! The states of a history in one file.

use super::{HistoryQuantity, HistoryState};
use crate::contact::{Contact, archive_of_states};
use crate::surface::Field;
use ndarray_npy::WriteNpzError;

/// The states of a history as `.npz`: as [`archive_of_loads`](crate::contact::archive_of_loads), with the states in place of the loads, and
/// with arrays of the `quantities` and of the further fields of the states by their names, along a first axis of states. Two texts have a line for
/// each state: its claim (`claim`), and the point of the path that it has reached (`point`), from 0, or `-` between two points.
/// Where tractions of different bodies displace the surface into the solid, `displacement` includes it.
///
/// # Errors
/// [`WriteNpzError`] if there are no states; fields of doubles cause none.
pub fn archive_of_history(
    states: Vec<HistoryState>,
    quantities: &[&HistoryQuantity],
    rank: usize,
    setup: &str,
) -> Result<Vec<u8>, WriteNpzError> {
    let value = |it: &HistoryQuantity, state: &HistoryState| (it.value)(state).unwrap_or(f64::NAN);
    let numbers: Vec<(&str, Vec<f64>)> =
        quantities.iter().map(|it| (it.name, states.iter().map(|state| value(it, state)).collect())).collect();
    let names: Vec<&'static str> =
        states.first().map_or(Vec::new(), |first| first.fields.iter().map(|it| it.name).collect());
    let point = |it: &HistoryState| it.point.map_or("-".to_owned(), |point| point.to_string());
    let words = [
        ("claim", states.iter().map(|it| <&str>::from(it.claim).to_owned()).collect()),
        ("point", states.iter().map(point).collect()),
    ];
    let (contacts, fields): (Vec<Contact>, Vec<_>) = states.into_iter().map(|it| (it.contact, it.fields)).unzip();
    let of_name = |(place, name): (usize, &&'static str)| (*name, fields.iter().map(|it| &it[place].values).collect());
    let further: Vec<(&str, Vec<&Field>)> = names.iter().enumerate().map(of_name).collect();
    archive_of_states(&contacts, &numbers, &further, &words, rank, setup)
}
