//! Profiles given as pairs of position and height.

use super::format::malformed;
use crate::grid::Grid;
use crate::sentence::sentence;
use ndarray::{Array1, ArrayD, ArrayView1, Axis};
use std::io;

/// The largest deviation from an even spacing, as a share of it: what positions that are rounded to a tenth of it come to.
const TOLERANCE: f64 = 0.1;

/// The heights of an array. One of two columns or two rows, which no surface has, holds positions and heights of a profile.
///
/// # Errors
/// For positions that are not evenly spaced.
pub(super) fn heights(array: ArrayD<f64>) -> io::Result<ArrayD<f64>> {
    let (heights, positions) = split(array);
    if let Some(positions) = positions {
        check(positions.view())?;
    }
    Ok(heights)
}

/// The heights of an array, and the positions beside them if it holds some.
pub(super) fn split(array: ArrayD<f64>) -> (ArrayD<f64>, Option<Array1<f64>>) {
    let Some(pairs) = pairs(array.shape()) else { return (array, None) };
    let positions = array.index_axis(pairs, 0).iter().copied().collect();
    (array.index_axis(pairs, 1).to_owned(), Some(positions))
}

/// The shape of the heights in an array of some shape.
pub(super) fn shape(shape: Vec<usize>) -> Vec<usize> {
    match pairs(&shape) {
        Some(Axis(pairs)) => vec![shape[1 - pairs]],
        None => shape,
    }
}

/// The axis along which an array of some shape holds pairs, if it does.
fn pairs(shape: &[usize]) -> Option<Axis> {
    match *shape {
        [n, 2] if n >= Grid::MIN_POINTS => Some(Axis(1)),
        [2, n] if n >= Grid::MIN_POINTS => Some(Axis(0)),
        _ => None,
    }
}

/// Refuses positions that are not evenly spaced.
fn check(position: ArrayView1<f64>) -> io::Result<()> {
    let (first, last) = (position[0], position[position.len() - 1]);
    let spacing = (last - first) / (position.len() - 1) as f64;
    let is_off = |(i, x): (usize, &f64)| {
        let off = (x - first - i as f64 * spacing).abs();
        (off.is_nan() || off > TOLERANCE * spacing.abs()).then_some((i, *x))
    };
    match position.iter().enumerate().find_map(is_off) {
        None if spacing != 0.0 => Ok(()),
        None => Err(malformed(sentence!(
            "its first column or row, the positions, is {first:?} everywhere: give the heights alone",
            first
        ))),
        Some((i, x)) => Err(malformed(format!(
            "it contains pairs of position and height, but position number {}, {x:?}, is not evenly spaced between \
             {first:?} and {last:?}: interpolate the heights to even spacing, and give the heights alone",
            i + 1
        ))),
    }
}
