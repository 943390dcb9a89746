//! The waves that a filter scales.

/// One of the waves of a grid: its wavenumber, and its place in the tables of the filter that scales it.
///
/// Waves that differ only in the direction in which they run along an axis share one place.
#[derive(Clone, Copy)]
pub(crate) struct Wave {
    /// Wavenumber `|q|`.
    pub q: f64,
    /// Place in a table, see [`super::Filter::places`].
    pub place: usize,
}
