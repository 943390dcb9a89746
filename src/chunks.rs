//! Loops over long vectors, in parallel where it pays, with sums that do not depend on the number of threads.
//!
//! A vector is cut into chunks of fixed length; results of chunks are combined in their order. A vector of one chunk is
//! handled on the spot, since waking another core would cost more than the loop.

use rayon::prelude::*;
use std::ops::Range;

/// Values per chunk: 128 KiB, of which a few fit the second-level cache, and long against the cost of a task.
const CHUNK: usize = 1 << 14;

/// Values that are passed over together where none is positive.
const BLOCK: usize = 16;

/// The result of a loop over a chunk. All chunks come here, whether they are handled on the spot or on another core: a loop with one
/// caller is compiled with all that it calls in it, one with two may call a function for every value.
#[inline(never)]
fn run<A, T>(work: &impl Fn(A) -> T, chunk: A) -> T {
    work(chunk)
}

/// Whether there is one thread only. Then loops stay on the calling thread, which need not wake another one.
pub(crate) fn is_alone() -> bool {
    rayon::current_num_threads() == 1
}

/// Results of `visit` on each chunk of `0..len`, in order.
pub(crate) fn visit<T: Send>(len: usize, visit: impl Fn(Range<usize>) -> T + Sync) -> Vec<T> {
    if len <= CHUNK {
        return vec![run(&visit, 0..len)];
    }
    if is_alone() {
        return (0..len.div_ceil(CHUNK)).map(|c| run(&visit, c * CHUNK..len.min((c + 1) * CHUNK))).collect();
    }
    (0..len.div_ceil(CHUNK)).into_par_iter().map(|c| run(&visit, c * CHUNK..len.min((c + 1) * CHUNK))).collect()
}

/// Sum of `term(i)` over `0..len`.
pub(crate) fn sum(len: usize, term: impl Fn(usize) -> f64 + Sync) -> f64 {
    visit(len, |range| range.fold(0.0, |sum, i| sum + term(i))).into_iter().sum()
}

/// Mean of `values` with the rounding of its sums made up for (Neumaier), so that it keeps its digits where the values cancel.
pub(crate) fn compensated_mean(values: &[f64]) -> f64 {
    let add = |[sum, lost]: [f64; 2], value: f64| {
        let next = sum + value;
        let rest = if sum.abs() >= value.abs() { (sum - next) + value } else { (value - next) + sum };
        [next, lost + rest]
    };
    let parts = visit(values.len(), |range| values[range].iter().fold([0.0; 2], |sums, value| add(sums, *value)));
    let [sum, lost] = parts.into_iter().fold([0.0; 2], |sums, [sum, lost]| {
        let [sum, rest] = add(sums, sum);
        [sum, rest + lost]
    });
    (sum + lost) / values.len() as f64
}

/// Results of `update` on each chunk of `values` and the range it covers, in order.
pub(crate) fn update<T: Send>(values: &mut [f64], update: impl Fn(Range<usize>, &mut [f64]) -> T + Sync) -> Vec<T> {
    let update = |(range, values): (Range<usize>, &mut [f64])| update(range, values);
    if values.len() <= CHUNK {
        return vec![run(&update, (0..values.len(), values))];
    }
    let with_range = |(c, chunk): (usize, &mut [f64])| run(&update, (c * CHUNK..c * CHUNK + chunk.len(), chunk));
    if is_alone() {
        return values.chunks_mut(CHUNK).enumerate().map(with_range).collect();
    }
    values.par_chunks_mut(CHUNK).enumerate().map(with_range).collect()
}

/// Results of `update` on each chunk of two equally long vectors and the range it covers, in order.
pub(crate) fn update_both<T: Send>(
    a: &mut [f64],
    b: &mut [f64],
    update: impl Fn(Range<usize>, &mut [f64], &mut [f64]) -> T + Sync,
) -> Vec<T> {
    let update = |(range, a, b): (Range<usize>, &mut [f64], &mut [f64])| update(range, a, b);
    if a.len() <= CHUNK {
        return vec![run(&update, (0..a.len(), a, b))];
    }
    let update = |(c, (a, b)): (usize, (&mut [f64], &mut [f64]))| run(&update, (c * CHUNK..c * CHUNK + a.len(), a, b));
    if is_alone() {
        return a.chunks_mut(CHUNK).zip(b.chunks_mut(CHUNK)).enumerate().map(update).collect();
    }
    a.par_chunks_mut(CHUNK).zip(b.par_chunks_mut(CHUNK)).enumerate().map(update).collect()
}

/// Results of `make` for each of `count` rows of `width` values, in order.
pub(crate) fn rows<T: Send>(count: usize, width: usize, make: impl Fn(usize) -> T + Sync) -> Vec<T> {
    if count * width <= CHUNK || is_alone() {
        return (0..count).map(|row| run(&make, row)).collect();
    }
    (0..count).into_par_iter().map(|row| run(&make, row)).collect()
}

/// Visits the rows of `width` values of a field.
pub(crate) fn rows_mut<T: Send>(field: &mut [T], width: usize, visit: impl Fn(usize, &mut [T]) + Sync) {
    if field.len() <= CHUNK || is_alone() {
        field.chunks_mut(width).enumerate().for_each(|(row, values)| visit(row, values));
    } else {
        field.par_chunks_mut(width).enumerate().for_each(|(row, values)| visit(row, values));
    }
}

/// Visits items, each of about `width` values.
pub(crate) fn each<T: Send>(items: &mut [T], width: usize, visit: impl Fn(usize, &mut T) + Sync) {
    if items.len() * width <= CHUNK || is_alone() {
        items.iter_mut().enumerate().for_each(|(i, item)| visit(i, item));
    } else {
        items.par_iter_mut().enumerate().for_each(|(i, item)| visit(i, item));
    }
}

/// Visits items, each of about `width` values, with scratch that tasks make for themselves.
pub(crate) fn each_with<T: Send, S>(
    items: &mut [T],
    width: usize,
    make: impl Fn() -> S + Sync + Send,
    visit: impl Fn(&mut S, usize, &mut T) + Sync + Send,
) {
    if items.len() * width <= CHUNK || is_alone() {
        let mut scratch = make();
        items.iter_mut().enumerate().for_each(|(i, item)| visit(&mut scratch, i, item));
    } else {
        items.par_iter_mut().enumerate().for_each_init(make, |scratch, (i, item)| visit(scratch, i, item));
    }
}

/// The places of positive values within `range`, in order. Blocks without any are passed over at once.
pub(crate) fn positive(values: &[f64], range: Range<usize>) -> impl Iterator<Item = usize> {
    let start = range.start;
    let blocks = values[range].chunks(BLOCK).enumerate();
    let blocks = blocks.filter(|(_, block)| block.iter().fold(false, |any, &value| any | (value > 0.0)));
    blocks.flat_map(move |(number, block)| {
        let places = (start + number * BLOCK..).zip(block);
        places.filter(|(_, value)| **value > 0.0).map(|(place, _)| place)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_positive_places_are_found_in_order() {
        let values: Vec<f64> = (0..1000).map(|i| if i % 7 == 0 || i / 100 == 3 { 1.0 } else { -0.0 }).collect();
        for range in [0..1000, 3..17, 250..999, 400..400] {
            let expected: Vec<usize> = range.clone().filter(|&i| values[i] > 0.0).collect();
            assert_eq!(positive(&values, range).collect::<Vec<_>>(), expected);
        }
        assert_eq!(positive(&[f64::NAN, -1.0, f64::INFINITY], 0..3).collect::<Vec<_>>(), [2]);
    }
}
