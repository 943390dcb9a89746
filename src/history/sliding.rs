//! Steady sliding over viscoelastic solids.

use crate::contact::{
    Contact, MonotoneSets, Observer, Problem, Solver, Stop, coarser, directions, hysteretic_friction, spectrum,
};
use crate::elastic::SteadyMotion;
use crate::error::MotionError;
use crate::surface::Field;
use crate::theory::persson::Pressures;

/// Wavenumbers that differ by less than this part are equal but for rounding.
const SAME_WAVENUMBER: f64 = 1e-9;

/// The certificate to which the contact on half as many points is found, and the most updates for it: friction is then known to a part of the error
/// that the grid has.
const COARSE_TOLERANCE: f64 = 1e-6;
const COARSE_UPDATES: usize = 300;

/// The least relative error of friction that is stated: rounding of its sums over the waves.
const FRICTION_ROUNDING: f64 = 1e-12;

/// A rough surface that slides steadily over a viscoelastic solid without friction at the interface. The loss of
/// energy in the solid resists the motion.
///
/// The surface moves towards `+x` at the speed `V`. The pressure acts along the normal of the deformed solid, so that the force on the
/// solid along the surface is `-<p grad u>` per area. Its part along `+x` over the load is the coefficient of friction, positive where the
/// surface moves towards `+x`: the solid is dragged along.
///
/// | quantity          | equation                                                        |
/// |-------------------|-----------------------------------------------------------------|
/// | `friction`        | `-<p u_x'> / <p>`                                               |
/// | `lateral`         | `-<p u_y'> / <p>`: the force across the motion, of anisotropic surfaces; 0 for a line |
/// | `full_contact`    | `-sum_q q_x abs(h_q)^2 Im K(q) / <p>`, exact where all nodes touch   |
/// | `persson`         | `-sum_q q_x abs(h_q)^2 Im K(q) P(q) / <p>`, an estimate              |
///
/// Derivatives are taken by the spectrum, so that no edge is counted. `K(q) = 1/w(q)` is the complex stiffness, the inverse of the weight
/// of [`crate::elastic::Compliance::sliding`]. In Persson's theory each wave rubs on the share of the area that is in contact when all
/// longer waves are seen, `P(q) = erf(<p> / (sqrt2 s(q)))`, with the variance `s^2 = sum abs(K h)^2` of the pressure over these waves in full
/// contact. The theory leaves out a factor of order one, since the response of the solid in contact is stiffer. So it is no bound.
///
/// # Source
/// Friction in full contact and the theory: Persson, J. Chem. Phys. 115, 3840 (2001). Steady sliding of rough surfaces: Menga, Putignano,
/// Carbone and Demelio, Proc. R. Soc. A 470, 20140392 (2014).
///
/// ```
/// use asperity::contact::{ContactModulus, Load};
/// use asperity::history::Sliding;
/// use asperity::{Grid, Indenter, Problem, Stop};
/// use std::f64::consts::TAU;
/// // a sine in full contact, at the speed where it rubs most: q V tau = 1 + f
/// let sine = Indenter::Sine { amplitude: 1e-3 }.surface(Grid::line(64, 1.0)?)?;
/// let (creep, pressure) = (3.0, 0.02);
/// let problem = Problem::new(sine, ContactModulus(1.0), Load::MeanPressure(pressure))?;
/// let problem = problem.sliding((1.0 + creep) / TAU, &[(creep, 1.0)])?;
/// let sliding = Sliding::solve(&problem, &Stop::default(), &mut ())?;
/// // Im K = (E* q/2) f W/((1 + f)^2 + W^2), and <p u'> = 2 q |h_q|^2 Im K with |h_q| = D/2
/// let loss = 0.5 * TAU * 1e-6 * (0.5 * TAU) * creep / (2.0 * (1.0 + creep));
/// assert!((sliding.friction / (loss / pressure) - 1.0).abs() < 1e-9);
/// assert!((sliding.full_contact / sliding.friction - 1.0).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Sliding {
    /// The contact. Its certificate bounds the error of the pressure, and no energy.
    pub contact: Contact,
    /// The coefficient of friction by the loss in the solid, dimensionless.
    pub friction: f64,
    /// The coefficient of the force on the solid along `+y`, dimensionless.
    pub lateral: f64,
    /// The coefficient of friction in full contact under the same load, dimensionless.
    pub full_contact: f64,
    /// The coefficient of friction of Persson's theory, dimensionless.
    pub persson: f64,
    /// The estimated relative error of `friction` by the grid: the difference from the contact on half as many points along each axis, and the error
    /// of the area. None where the grid cannot be halved, or the contact on the half of it was not found.
    pub grid_error: Option<f64>,
}

impl Sliding {
    /// Solves a problem that slides, see [`Problem::sliding`], with [`MonotoneSets`].
    ///
    /// # Errors
    /// [`MotionError::NeedsSliding`] for a problem that does not slide, and [`MotionError::Solve`] if the contact did not converge.
    pub fn solve(problem: &Problem, stop: &Stop, observer: &mut dyn Observer) -> Result<Self, MotionError> {
        if !matches!(problem.compliance().motion(), Some(SteadyMotion::Sliding { .. })) {
            return Err(MotionError::NeedsSliding);
        }
        Self::new(MonotoneSets.solve(problem, stop, observer)?.converged()?)
    }

    /// The friction of a contact that slides, whichever solver found it.
    ///
    /// # Errors
    /// [`MotionError::NeedsSliding`] for the contact of a problem that does not slide.
    pub fn new(contact: Contact) -> Result<Self, MotionError> {
        if !matches!(contact.problem.compliance().motion(), Some(SteadyMotion::Sliding { .. })) {
            return Err(MotionError::NeedsSliding);
        }
        let mean_pressure = contact.mean_pressure();
        let [pressure, displacement] = [&contact.pressure, &contact.displacement]
            .map(|field| field.as_slice().expect("results are made in standard layout"));
        let [lateral, friction] = hysteretic_friction(&contact.problem, pressure, displacement);
        let [full_contact, persson] = losses(&contact.problem, mean_pressure).map(|loss| loss / mean_pressure);
        let grid_error = grid_error(&contact, friction);
        Ok(Self { contact, friction, lateral, full_contact, persson, grid_error })
    }
}

/// `-<p u_x'>` in full contact, and by Persson's theory.
fn losses(problem: &Problem, mean_pressure: f64) -> [f64; 2] {
    let grid = *problem.surface().grid();
    let heights = spectrum(&grid, problem.height());
    let weights = problem.compliance().weights().unwrap_or_default();
    // wavenumber, variance of the pressure, and loss of each wave
    let mut waves: Vec<[f64; 3]> = grid
        .wavenumbers()
        .zip(directions(&grid))
        .zip(grid.multiplicities())
        .zip(heights.iter().zip(weights))
        .filter(|(((q, _), _), (_, weight))| *q > 0.0 && weight.norm_sqr() > 0.0)
        .map(|(((q, [_, qx]), multiplicity), (height, weight))| {
            let (square, stiffness) = (multiplicity * height.norm_sqr(), weight.inv());
            [q, square * stiffness.norm_sqr(), -qx * square * stiffness.im]
        })
        .collect();
    waves.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let (mut variance, mut sums) = (0.0, [0.0; 2]);
    // waves of one length are seen at once: their order is that of rounding, which changes with the unit of length
    for shell in waves.chunk_by(|a, b| b[0] <= a[0] * (1.0 + SAME_WAVENUMBER)) {
        let [own, loss] = [1, 2].map(|part| shell.iter().map(|wave| wave[part]).sum::<f64>());
        let deviation = f64::sqrt(variance + 0.5 * own);
        variance += own;
        let share = if deviation > 0.0 { Pressures { mean: mean_pressure, deviation }.relative_area() } else { 1.0 };
        sums[0] += loss;
        sums[1] += share * loss;
    }
    sums
}

/// The estimated relative error of the friction coefficient of a contact by its grid, from the contact on half as many points along each axis. The
/// difference alone crosses zero by chance: of 148 contacts (rough lines and surfaces, cylinders) that were not used to choose the sum, against grids of
/// 4 to 8 times as many points, the difference was more than 1.5 times too small in 10 %, and by up to 22 times. With the error of the area added it was
/// so in 2, by up to 2.4 times; half of the errors are below a tenth of what is stated.
fn grid_error(contact: &Contact, friction: f64) -> Option<f64> {
    // a contact that was stopped or not found has larger errors, and nobody waits for a second one
    let coarse = coarser(&contact.problem).filter(|_| contact.is_converged())?;
    let shape = coarse.surface().grid().shape();
    let step = [0, 1].map(|axis| contact.pressure.shape()[axis] / shape[axis]);
    let start = Field::from_shape_fn(shape, |(y, x)| contact.pressure[[y * step[0], x * step[1]]]);
    let stop = Stop::new(COARSE_TOLERANCE, COARSE_UPDATES).ok()?;
    let found = MonotoneSets.solve_from(Some(&start), &coarse, &stop, &mut ()).ok()?;
    let difference = (found.friction() / friction - 1.0).abs();
    let error = difference.max(FRICTION_ROUNDING) + contact.resolution().relative_area_error;
    Some(error).filter(|error| found.is_converged() && error.is_finite())
}
