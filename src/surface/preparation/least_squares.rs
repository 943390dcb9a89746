//! Fits of least squares.

/// A pivot below this part of the sum of squares of its function is rounding: the function is a sum of those before it.
const DEPENDENT: f64 = 1e-10;
/// The most steps of Gauss and Newton, and the most times that one is halved.
const STEPS: usize = 100;
const HALVINGS: usize = 30;
/// A step that changes the sum of squares by less than this part of it is the last one.
const SETTLED: f64 = 1e-13;

/// The normal equations of values that are to be sums of `N` functions.
struct NormalEquations<const N: usize> {
    matrix: [[f64; N]; N],
    right: [f64; N],
}

impl<const N: usize> NormalEquations<N> {
    fn new(points: impl Iterator<Item = ([f64; N], f64)>) -> Self {
        let mut all = Self { matrix: [[0.0; N]; N], right: [0.0; N] };
        for (functions, value) in points {
            for i in 0..N {
                all.right[i] += functions[i] * value;
                (0..=i).for_each(|j| all.matrix[i][j] += functions[i] * functions[j]);
            }
        }
        all
    }

    /// The coefficients, by the factors `L D L^T`; 0 for a function that is a sum of those before it.
    fn solve(mut self) -> [f64; N] {
        let (m, b) = (&mut self.matrix, &mut self.right);
        let mut pivots = [0.0; N];
        for i in 0..N {
            let whole = m[i][i];
            for j in 0..i {
                let above: f64 = (0..j).map(|k| m[i][k] * m[j][k] * pivots[k]).sum();
                m[i][j] = if pivots[j] > 0.0 { (m[i][j] - above) / pivots[j] } else { 0.0 };
            }
            let rest = whole - (0..i).map(|k| m[i][k] * m[i][k] * pivots[k]).sum::<f64>();
            pivots[i] = if rest > DEPENDENT * whole { rest } else { 0.0 };
            b[i] -= (0..i).map(|k| m[i][k] * b[k]).sum::<f64>();
        }
        let mut x = [0.0; N];
        for i in (0..N).rev() {
            let below: f64 = (i + 1..N).map(|k| m[k][i] * x[k]).sum();
            x[i] = if pivots[i] > 0.0 { b[i] / pivots[i] - below } else { 0.0 };
        }
        x
    }
}

/// The coefficients with which the sum of `N` functions is nearest to the values at the points; 0 for functions that
/// the points do not distinguish from those before.
pub(super) fn linear<const N: usize>(points: impl Iterator<Item = ([f64; N], f64)>) -> [f64; N] {
    NormalEquations::new(points).solve()
}

/// The parameters with which a model is nearest to the values at some points, by the method of Gauss and Newton with halved steps; none
/// where the model has no value at the start, or it does not settle.
///
/// `model(parameters, point)` is the value at a point and its derivatives, or none beyond the model.
pub(super) fn nearest<const N: usize, P: Copy>(
    start: [f64; N],
    points: &[(P, f64)],
    model: impl Fn(&[f64; N], P) -> Option<(f64, [f64; N])>,
) -> Option<[f64; N]> {
    let rests = |at: &[f64; N]| {
        points
            .iter()
            .map(|(point, value)| model(at, *point).map(|(is, slopes)| (slopes, value - is)))
            .collect::<Option<Vec<_>>>()
    };
    let square = |rests: &[([f64; N], f64)]| rests.iter().map(|(_, rest)| rest * rest).sum::<f64>();
    let (mut at, mut here) = (start, rests(&start)?);
    for _ in 0..STEPS {
        let (before, step) = (square(&here), linear(here.iter().copied()));
        let shorter = |halvings: usize| {
            let share = 0.5f64.powi(halvings as i32);
            let next: [f64; N] = std::array::from_fn(|i| at[i] + share * step[i]);
            Some((next, rests(&next)?)).filter(|(_, there)| square(there) <= before)
        };
        let Some((next, there)) = (0..HALVINGS).find_map(shorter) else { return Some(at) };
        let is_settled = before - square(&there) <= SETTLED * before;
        (at, here) = (next, there);
        if is_settled {
            return Some(at);
        }
    }
    None
}
