//! Bends of heights over several distances, and the part of them that is white.

/// Bends that grow by less than this factor from the spacing to twice the spacing are white: those of independent heights do not grow, and
/// those of a self-affine surface grow by `2^(2H)`.
const WHITE: f64 = 1.1;
/// Smallest growth from two to four spacings, divided by that from one to two, at which white heights can be distinguished from
/// roughness.
const LEAST: f64 = 1.05;

/// The mean square of independent heights, of the mean squares of bends at one, two, four, ... spacings.
///
/// The mean square `B(s)` of the bends `h(x + s) - 2 h(x) + h(x - s)` is that of independent heights of the mean square `n`, which does not
/// depend on `s`, and that of the rest, which grows as `s^(2H)` where it is self-affine: `B(s) = 6 n + b s^(2H)`. The values at one, two and
/// four spacings give `n`.
pub(super) fn white(bends: &[f64]) -> f64 {
    let [one, two, four] = [bends[0], bends[1], bends[2]];
    let growth = (four - two) / (two - one);
    if two <= WHITE * one {
        one / 6.0
    } else if growth > LEAST {
        (one - (two - one) / (growth - 1.0)).max(0.0) / 6.0
    } else {
        0.0
    }
}

/// The mean squares of the bends of a sequence at one, two, four, ... places, as far as a quarter of it.
pub(super) fn bends(sequence: &[f64]) -> Vec<f64> {
    let doubles = std::iter::successors(Some(1), |s| Some(2 * s)).take_while(|s| *s == 1 || 4 * s <= sequence.len());
    let mean_square = |s: usize| {
        let count = sequence.len().saturating_sub(2 * s).max(1) as f64;
        sequence.windows(2 * s + 1).map(|it| (it[2 * s] - 2.0 * it[s] + it[0]).powi(2)).sum::<f64>() / count
    };
    doubles.map(mean_square).collect()
}

/// The median of some numbers, which are put in another order; none without numbers.
pub(super) fn median(values: &mut [f64]) -> Option<f64> {
    let middle = values.len().checked_sub(1)? / 2;
    Some(*values.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// The standard deviation of normally distributed numbers about 0, over the median of their magnitudes.
pub(super) const DEVIATION: f64 = 1.4826;
