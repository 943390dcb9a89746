//! The least curvature of the energy of a state: whether it is stable.

use super::gap_energy::{GapEnergy, GapState};
use super::newton::{OpenNodes, add_scaled, norm};
use crate::chunks::{self, dot};
use crate::contact::{Observer, goes_on};
use crate::error::AdhesionError;

/// Curvatures below this part of the softest stiffness are marginal.
pub(super) const MARGINAL: f64 = 1e-3;

/// Most rounds of the search.
const ROUNDS: usize = 80;

/// The vectors that are searched at once: the second one keeps the first from ending at an eigenvector of a symmetry that the least one does not have.
const VECTORS: usize = 2;

/// The residual of an eigenvalue, over the larger of its magnitude and a part of the softest stiffness, at which it is found.
const RESIDUAL: f64 = 0.01;
const SMALL: f64 = 0.01;

/// The part of the range by which a step off a saddle moves the gap.
const NUDGE: f64 = 0.05;

/// Sweeps of rotations after which a small matrix is diagonal to the last digit.
const SWEEPS: usize = 20;

/// The length of a vector without its parts along others, over its length before, below which nothing is left of it.
const NOTHING: f64 = 1e-8;

/// An estimate of the least eigenvalue of `K + V''` on the nodes that do not touch, and a vector that belongs to it. At a given mean gap
/// only changes with the sum zero count.
pub(super) struct LeastCurvature {
    /// The eigenvalue, a pressure per length. It is never below the true one, so a negative one proves a saddle.
    pub value: f64,
    /// The length of `(K + V'') x - value x` for the vector `x` of length one: there is an eigenvalue at most so far away.
    pub error: f64,
    pub vector: Vec<f64>,
}

impl LeastCurvature {
    /// Whether a state is a saddle, on a solid of a softest stiffness.
    pub(crate) fn is_saddle(&self, softest: f64) -> bool {
        self.value < -MARGINAL * softest
    }
}

/// A vector and its image.
type Imaged = [Vec<f64>; 2];

/// Finds the least curvature by the locally optimal conjugate gradients of Knyazev, SIAM J. Sci. Comput. 23, 517 (2001), with two vectors:
/// the least Rayleigh quotients of the vectors, of the last steps and of the preconditioned residuals. All of these are kept perpendicular to
/// each other, with length one: the new ones as fields, and the vectors and their steps by their weights.
///
/// # Errors
/// [`AdhesionError::Stopped`] by an observer, which is asked in each round.
pub(super) fn least_curvature(
    energy: &mut GapEnergy<'_>,
    state: &GapState,
    observer: &mut dyn Observer,
) -> Result<Option<LeastCurvature>, AdhesionError> {
    let open = OpenNodes::new(energy, state);
    let free = open.count().saturating_sub(usize::from(energy.keeps_mean()));
    // the vectors come first, and then their last steps
    let mut basis: Vec<Imaged> = Vec::new();
    chunks::in_pool(state.gap.len(), || {
        for start in 0..VECTORS.min(free) {
            let vector = improved(energy, &open, first_vector(energy, state, start));
            extend(&mut basis, energy, &open, vector);
        }
    });
    let count = basis.len();
    if count == 0 {
        return Ok(None);
    }
    for _ in 0..ROUNDS {
        if !goes_on(observer) {
            return Err(AdhesionError::Stopped);
        }
        if !chunks::in_pool(state.gap.len(), || advance(&mut basis, count, energy, &open)) {
            break;
        }
    }
    let first = basis.swap_remove(0);
    let error = norm(&residual(&first));
    let [vector, image] = first;
    Ok(Some(LeastCurvature { value: dot(&vector, &image), error, vector }))
}

/// A round of the search on a basis of so many vectors and their last steps. Returns whether the vectors have changed.
fn advance(basis: &mut Vec<Imaged>, count: usize, energy: &mut GapEnergy<'_>, open: &OpenNodes) -> bool {
    let residuals: Vec<Vec<f64>> = basis[..count].iter().map(residual).collect();
    let [vector, image] = &basis[0];
    if norm(&residuals[0]) <= RESIDUAL * dot(vector, image).abs().max(SMALL * energy.softest()) {
        return false;
    }
    let known = basis.len();
    for residual in residuals {
        let better = improved(energy, open, residual);
        extend(basis, energy, open, better);
    }
    if basis.len() == known {
        return false;
    }
    let mut weights = least_of(basis, count);
    add_steps(&mut weights, count);
    *basis = weights.iter().map(|weights| combined(basis, weights)).collect();
    true
}

/// Moves a state off a saddle, to the side of the unstable direction with the lower energy.
pub(super) fn leave_saddle(energy: &mut GapEnergy<'_>, state: &mut GapState, least: &LeastCurvature) {
    let largest = least.vector.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let mut best: Option<(f64, GapState)> = None;
    for sign in [1.0, -1.0] {
        let length = sign * NUDGE * energy.attraction.range() / largest;
        let mut gap: Vec<f64> = state.gap.iter().zip(&least.vector).map(|(g, x)| g + length * x).collect();
        energy.carry(&mut gap, |i| !state.touches(i));
        let by: Vec<f64> = gap.iter().zip(&state.gap).map(|(to, from)| to - from).collect();
        let mut stiff = vec![0.0; by.len()];
        energy.stiffness(&by, &mut stiff);
        let change = energy.change(state, &by, &stiff);
        if best.as_ref().is_none_or(|(least, _)| change < *least) {
            let force = state.force.iter().zip(&stiff).map(|(f, k)| f + k).collect();
            best = Some((change, energy.with_force(gap, force)));
        }
    }
    if let Some((_, moved)) = best {
        *state = moved;
    }
}

/// The vectors that the search begins with: one that is large where the attraction bends the energy down, and one without any symmetry.
fn first_vector(energy: &GapEnergy<'_>, state: &GapState, start: usize) -> Vec<f64> {
    let noise = |i: usize| (i as f64 * 0.618_033_988_749_895).fract() - 0.5;
    let bent = |i: usize| 1e-3 * (1.0 + noise(i)) - energy.attraction.slope(state.gap[i]) / energy.softest();
    (0..state.gap.len()).map(|i| if start == 0 { bent(i) } else { noise(i * i) }).collect()
}

/// A vector on the open nodes after the preconditioner.
fn improved(energy: &mut GapEnergy<'_>, open: &OpenNodes, mut vector: Vec<f64>) -> Vec<f64> {
    open.project(&mut vector);
    let mut better = vec![0.0; vector.len()];
    energy.precondition(&vector, &mut better);
    open.project(&mut better);
    better
}

/// The part of the image of a vector of length one that is perpendicular to the vector.
fn residual([vector, image]: &Imaged) -> Vec<f64> {
    let value = dot(vector, image);
    image.iter().zip(vector).map(|(a, x)| a - value * x).collect()
}

/// Extends a basis of vectors of length one that are perpendicular to each other by what a vector has of its own, and its image.
fn extend(basis: &mut Vec<Imaged>, energy: &mut GapEnergy<'_>, open: &OpenNodes, mut vector: Vec<f64>) {
    let size = norm(&vector);
    // twice, because of rounding
    for _ in 0..2 {
        let along: Vec<f64> = basis.iter().map(|[other, _]| dot(&vector, other)).collect();
        for ([other, _], along) in basis.iter().zip(along) {
            add_scaled(&mut vector, -along, other);
        }
    }
    let left = norm(&vector);
    if left.is_finite() && left > NOTHING * size {
        vector.iter_mut().for_each(|x| *x /= left);
        let mut image = vec![0.0; vector.len()];
        open.curved(energy, &vector, &mut image);
        basis.push([vector, image]);
    }
}

/// Adds the weights of the steps of the vectors: of what was added to the last ones, the first `count` of the basis, what is perpendicular to the
/// vectors and to the other steps.
fn add_steps(weights: &mut Vec<Vec<f64>>, count: usize) {
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    for k in 0..count {
        let mut step = weights[k].clone();
        step[..count].fill(0.0);
        let size = product(&step, &step).sqrt();
        for _ in 0..2 {
            for other in weights.iter() {
                let along = product(&step, other);
                step.iter_mut().zip(other).for_each(|(x, other)| *x -= along * other);
            }
        }
        let left = product(&step, &step).sqrt();
        if left.is_finite() && left > NOTHING * size {
            step.iter_mut().for_each(|x| *x /= left);
            weights.push(step);
        }
    }
}

/// A combination of the vectors of a basis.
fn combined(basis: &[Imaged], weights: &[f64]) -> Imaged {
    [0, 1].map(|part| {
        let mut sum = vec![0.0; basis[0][part].len()];
        chunks::update(&mut sum, |range, sum| {
            for (vector, weight) in basis.iter().zip(weights) {
                sum.iter_mut().zip(&vector[part][range.clone()]).for_each(|(sum, x)| *sum += weight * x);
            }
        });
        sum
    })
}

/// The weights of the vectors of the least eigenvalues of the curvature in a basis.
fn least_of(basis: &[Imaged], count: usize) -> Vec<Vec<f64>> {
    let mut matrix = vec![vec![0.0; basis.len()]; basis.len()];
    for (i, j) in (0..basis.len()).flat_map(|i| (0..=i).map(move |j| (i, j))) {
        let entry = dot(&basis[i][0], &basis[j][1]);
        (matrix[i][j], matrix[j][i]) = (entry, entry);
    }
    let (values, vectors) = eigen(matrix);
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&i, &j| values[i].total_cmp(&values[j]));
    order[..count].iter().map(|&k| vectors.iter().map(|row| row[k]).collect()).collect()
}

/// Eigenvalues and eigenvectors (as columns) of a symmetric matrix, by Jacobi's rotations.
fn eigen(mut a: Vec<Vec<f64>>) -> (Vec<f64>, Vec<Vec<f64>>) {
    let size = a.len();
    let mut vectors: Vec<Vec<f64>> =
        (0..size).map(|i| (0..size).map(|j| f64::from(u8::from(i == j))).collect()).collect();
    for _ in 0..SWEEPS {
        for (p, q) in (0..size).flat_map(|p| (p + 1..size).map(move |q| (p, q))) {
            if a[p][q] == 0.0 {
                continue;
            }
            let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
            let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
            let c = 1.0 / (t * t + 1.0).sqrt();
            let s = t * c;
            let turn = |row: &mut Vec<f64>| (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
            a.iter_mut().for_each(turn);
            vectors.iter_mut().for_each(turn);
            let (at_p, at_q) = (a[p].clone(), a[q].clone());
            for k in 0..size {
                (a[p][k], a[q][k]) = (c * at_p[k] - s * at_q[k], s * at_p[k] + c * at_q[k]);
            }
        }
    }
    ((0..size).map(|i| a[i][i]).collect(), vectors)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Grid;
    use crate::adhesion::{
        AdhesiveControl, AdhesiveMethod, AdhesiveOutcome, AdhesiveProblem, Attraction, AttractionForm,
    };
    use crate::contact::{ContactModulus, Load, Problem, Stop};
    use crate::surface::{Indenter, Spectrum, Surface};

    #[test]
    fn eigenvectors_of_small_matrices_are_found() {
        let a = [[2.0, -1.0, 0.5, 0.1], [-1.0, 3.0, 0.25, 0.0], [0.5, 0.25, -1.0, 0.7], [0.1, 0.0, 0.7, 0.3]];
        for size in 1..=4 {
            let matrix: Vec<Vec<f64>> = a[..size].iter().map(|row| row[..size].to_vec()).collect();
            let (values, vectors) = eigen(matrix);
            for k in 0..size {
                for i in 0..size {
                    let image: f64 = (0..size).map(|j| a[i][j] * vectors[j][k]).sum();
                    assert!((image - values[k] * vectors[i][k]).abs() < 1e-12);
                }
            }
        }
    }

    /// The least eigenvalue of the curvature on the open nodes, from the whole matrix. Directions that are not free get a large one.
    fn dense(energy: &mut GapEnergy<'_>, state: &GapState) -> f64 {
        let (n, large) = (state.gap.len(), 1e6 * energy.softest());
        let open = OpenNodes::new(energy, state);
        let mut column_of = |column: usize| -> Vec<f64> {
            let mut unit: Vec<f64> = (0..n).map(|i| f64::from(u8::from(i == column))).collect();
            open.project(&mut unit);
            let mut image = vec![0.0; n];
            open.curved(energy, &unit, &mut image);
            (0..n).map(|row| image[row] + large * (f64::from(u8::from(row == column)) - unit[row])).collect()
        };
        let matrix: Vec<Vec<f64>> = (0..n).map(&mut column_of).collect();
        let symmetric = (0..n).map(|i| (0..n).map(|j| 0.5 * (matrix[i][j] + matrix[j][i])).collect()).collect();
        eigen(symmetric).0.into_iter().fold(f64::INFINITY, f64::min)
    }

    /// For all forms, lines and surfaces, loads and mean gaps: the told value is within its error of the true one.
    #[test]
    fn the_least_curvature_is_that_of_the_whole_matrix() {
        let line = Grid::line(60, 1.0).unwrap();
        let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.5, short_cutoff: 0.26, rms_gradient: 0.05 };
        let surfaces = [
            Indenter::Sine { amplitude: 0.01 }.surface(line).unwrap(),
            Surface::rough(line, &spectrum, 3).unwrap(),
            Surface::rough(Grid::surface([9, 8], [1.0, 1.0]).unwrap(), &spectrum, 5).unwrap(),
        ];
        let table = Attraction::from_table(vec![0.0, 4e-3, 2e-2], vec![0.005, 0.004, 0.0]).unwrap();
        let forms = [AttractionForm::Exponential, AttractionForm::Cubic, AttractionForm::Dugdale];
        let forms = forms.map(|form| Attraction::new(form, 3e-5, 7e-3).unwrap());
        let mut seen = 0;
        for surface in &surfaces {
            for attraction in forms.iter().chain([&table]) {
                let problem = Problem::new(surface.clone(), ContactModulus(1.0), Load::ReducedPressure(0.1)).unwrap();
                let high = problem.highest();
                let adhesive = AdhesiveProblem::new(problem.clone(), attraction.clone()).unwrap();
                let gaps = [1.1, 0.9, 0.5].map(|part| AdhesiveControl::MeanGap(part * high));
                for control in
                    gaps.into_iter().chain([AdhesiveControl::MeanPressure(5e-4), AdhesiveControl::MeanPressure(5e-3)])
                {
                    let solved = adhesive.solve(control, None, AdhesiveMethod::Fast, &Stop::default(), &mut ());
                    let Ok(AdhesiveOutcome::State(found)) = solved else { continue };
                    let mut energy = GapEnergy::new(&problem, attraction, control);
                    let state = energy.state(found.contact.gap.iter().copied().collect());
                    let Some(least) = least_curvature(&mut energy, &state, &mut ()).unwrap() else { continue };
                    let exact = dense(&mut energy, &state);
                    let [missed, slack] = [least.value - exact, 1e-9 * energy.softest()];
                    assert!(
                        missed >= -slack && missed <= least.error + slack,
                        "{control:?} {attraction:?}: {} {exact}",
                        least.value
                    );
                    assert!(least.error <= RESIDUAL * least.value.abs().max(SMALL * energy.softest()));
                    seen += 1;
                }
            }
        }
        assert!(seen > 40, "{seen}");
    }
}
