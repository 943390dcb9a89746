//! Loops over long vectors, in parallel where it pays, with sums that do not depend on the number of threads.
//!
//! A vector is cut into chunks of fixed length; results of chunks are combined in their order. A vector of one chunk is
//! handled on the spot, since waking another core would cost more than the loop.

use ndarray::aview1;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// Values per chunk: 128 KiB, of which a few fit the second-level cache, and long against the cost of a task.
const CHUNK: usize = 1 << 14;

/// Values of a line that are worked on together, an even number: one row is too long for one task.
const TILE: usize = 1 << 12;

/// Values that are passed over together where none is positive.
const BLOCK: usize = 16;

/// The result of a loop over a chunk. All chunks come here, whether they are handled on the spot or on another core: a loop with one
/// caller is compiled with all that it calls in it, one with two may call a function for every value.
#[inline(never)]
fn run<A, T>(work: &impl Fn(A) -> T, chunk: A) -> T {
    work(chunk)
}

/// Whether there is one thread only. Then loops stay on the calling thread, which need not wake another one. In a browser this is known
/// to the compiler, which leaves out all else: a third of the module.
fn is_alone() -> bool {
    cfg!(target_arch = "wasm32") || rayon::current_num_threads() == 1
}

/// Does the tasks `0..count` on all threads. This function is not generic, so that a parallel loop is compiled once for all loops
/// of the crate. With one copy for each loop the crate took a quarter longer to compile.
///
/// A thread outside of the pool does tasks as well, together with the threads of the pool but one. If it only waited for the pool,
/// two threads would solve small contacts more slowly than one, since the operating system needs some 10 us to wake it again.
fn on_all_threads(count: usize, task: &(dyn Fn(usize) + Sync)) {
    if rayon::current_thread_index().is_some() {
        (0..count).into_par_iter().with_max_len(1).for_each(task);
        return;
    }
    let next = AtomicUsize::new(0);
    let take_tasks = || std::iter::repeat_with(|| next.fetch_add(1, Relaxed)).take_while(|n| *n < count).for_each(task);
    rayon::in_place_scope(|scope| {
        (1..rayon::current_num_threads().min(count)).for_each(|_| scope.spawn(|_| take_tasks()));
        take_tasks();
    });
}

/// Results of `work` on each item, in order: on the calling thread if there is one item or one thread, else on all threads.
///
/// The loops are plain, since this function is compiled for each of its callers, and iterators would be longer code for the compiler.
pub(crate) fn spread<A: Send, T: Send>(
    items: impl ExactSizeIterator<Item = A>,
    work: impl Fn(A) -> T + Sync,
) -> Vec<T> {
    let mut results = Vec::with_capacity(items.len());
    if items.len() <= 1 || is_alone() {
        for item in items {
            results.push(run(&work, item));
        }
        return results;
    }
    let mut places = Vec::with_capacity(items.len());
    for item in items {
        places.push(Mutex::new((Some(item), None)));
    }
    on_all_threads(places.len(), &|number| {
        let mut place = places[number].lock().expect("a place has one task");
        if let Some(item) = place.0.take() {
            place.1 = Some(run(&work, item));
        }
    });
    for place in places {
        results.push(place.into_inner().expect("a panic of a task is passed on").1.expect("each task leaves a result"));
    }
    results
}

/// Does work whose loops are over vectors of `len` values on a thread of the pool, where it pays. A loop that begins outside of the pool wakes the
/// other threads each time, which costs as much as a few loops over a vector of some chunks.
pub(crate) fn in_pool<T: Send>(len: usize, work: impl FnOnce() -> T + Send) -> T {
    if len <= CHUNK || is_alone() { work() } else { rayon::scope(|_| work()) }
}

/// The ranges of `length` that `0..len` is cut into; one of them is there in any case.
fn ranges(len: usize, length: usize) -> impl ExactSizeIterator<Item = Range<usize>> {
    (0..len.div_ceil(length).max(1)).map(move |c| c * length..len.min((c + 1) * length))
}

/// Rows of `width` values in a chunk.
fn rows_per_chunk(width: usize) -> usize {
    (CHUNK / width.max(1)).max(1)
}

/// The number of values of a field of `[height, width]` that are worked on together by [`rows_mut`]: a row, or a part of a line. In a part
/// that begins at a place, rows and columns follow from the place and the width.
pub(crate) fn tile([height, width]: [usize; 2]) -> usize {
    if height == 1 { width.min(TILE) } else { width }
}

/// Zeros that are written to memory here. The pages of `vec![0.0; len]` are set up at their first use. One that is read before it is written is set up
/// twice, and the second time stops the other threads for a moment.
pub(crate) fn touched(len: usize) -> Vec<f64> {
    let mut zeros = Vec::new();
    zeros.resize(len, 0.0);
    zeros
}

/// Results of `visit` on each chunk of `0..len`, in order.
pub(crate) fn visit<T: Send>(len: usize, visit: impl Fn(Range<usize>) -> T + Sync) -> Vec<T> {
    spread(ranges(len, CHUNK), visit)
}

/// Sum of `term(i)` over `0..len`.
pub(crate) fn sum(len: usize, term: impl Fn(usize) -> f64 + Sync) -> f64 {
    visit(len, |range| range.fold(0.0, |sum, i| sum + term(i))).into_iter().sum()
}

/// The scalar product of two equally long vectors.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    visit(a.len(), |range| aview1(&a[range.clone()]).dot(&aview1(&b[range]))).into_iter().sum()
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
    let chunks = ranges(values.len(), CHUNK).zip(values.chunks_mut(CHUNK));
    spread(chunks, |(range, values)| update(range, values))
}

/// Results of `update` on each chunk of two equally long vectors and the range it covers, in order.
pub(crate) fn update_both<T: Send>(
    a: &mut [f64],
    b: &mut [f64],
    update: impl Fn(Range<usize>, &mut [f64], &mut [f64]) -> T + Sync,
) -> Vec<T> {
    let chunks = ranges(a.len(), CHUNK).zip(a.chunks_mut(CHUNK).zip(b.chunks_mut(CHUNK)));
    spread(chunks, |(range, (a, b))| update(range, a, b))
}

/// Results of `make` for each of `count` rows of `width` values, in order.
pub(crate) fn rows<T: Send>(count: usize, width: usize, make: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let mut results = Vec::with_capacity(count);
    for chunk in spread(ranges(count, rows_per_chunk(width)), |rows| rows.map(&make).collect::<Vec<T>>()) {
        results.extend(chunk);
    }
    results
}

/// Visits the rows of `width` values of a field.
pub(crate) fn rows_mut<T: Send>(field: &mut [T], width: usize, visit: impl Fn(usize, &mut [T]) + Sync) {
    let rows = rows_per_chunk(width);
    spread(field.chunks_mut(rows * width).enumerate(), |(chunk, values)| {
        values.chunks_mut(width).zip(chunk * rows..).for_each(|(values, row)| visit(row, values));
    });
}

/// Visits items, each of about `width` values.
pub(crate) fn each<T: Send>(items: &mut [T], width: usize, visit: impl Fn(usize, &mut T) + Sync) {
    each_with(items, width, || (), |_, i, item| visit(i, item));
}

/// Visits items, each of about `width` values, with scratch that tasks make for themselves.
pub(crate) fn each_with<T: Send, S>(
    items: &mut [T],
    width: usize,
    make: impl Fn() -> S + Sync,
    visit: impl Fn(&mut S, usize, &mut T) + Sync,
) {
    let count = rows_per_chunk(width);
    spread(items.chunks_mut(count).enumerate(), |(chunk, items)| {
        let mut scratch = make();
        items.iter_mut().zip(chunk * count..).for_each(|(item, i)| visit(&mut scratch, i, item));
    });
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

/// Runs of positive values within `range`, in order.
pub(crate) fn positive_runs(values: &[f64], range: Range<usize>) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for place in positive(values, range) {
        match runs.last_mut() {
            Some(run) if run.end == place => run.end += 1,
            _ => runs.push(place..place + 1),
        }
    }
    runs
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
