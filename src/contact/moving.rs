//! Problems of contacts that move over their solid.

use crate::contact::Problem;
use crate::elastic::{Compliance, SteadyMotion};
use crate::error::ProblemError;
use crate::fourier::{Complex, Fourier};
use crate::grid::Grid;

impl Problem {
    /// The problem of the same surface that slides steadily over a viscoelastic solid, at a `speed` `V`, a length per time, towards
    /// `+x`, or towards `-x` if it is negative. The solid of this problem is that of fast loads, and each of the `terms` is a pair
    /// `(f, tau)` of a Prony series in creep form: after a long time it adds `f` times the compliance of fast loads, with the
    /// retardation time `tau`. So a wave is displaced by
    ///
    /// `u_q = A_q (1 + sum_j f_j / (1 - i q_x V tau_j)) p_q`,
    ///
    /// see [`Compliance::sliding`]. At a speed of zero the solid is relaxed, and at a high speed it is that of fast loads.
    ///
    /// This compliance is not symmetric: the problem is not that of a smallest energy, but the monotone variational inequality
    /// `p >= 0`, `g = u - h + d >= 0`, `p g = 0`. Its solution is unique. [`crate::contact::MonotoneSets`] finds it; the other solvers
    /// refuse it.
    ///
    /// # Errors
    /// The errors of [`Compliance::sliding`], and [`ProblemError::OutOfRange`] for a compliance outside the range of doubles.
    ///
    /// # Source
    /// Menga, Putignano, Carbone and Demelio, Proc. R. Soc. A 470, 20140392 (2014), for the kernel of steady sliding.
    ///
    /// ```
    /// use asperity::contact::{ContactModulus, Load, MonotoneSets, Multilevel, Solver};
    /// use asperity::{Grid, Indenter, Problem, Stop};
    /// let cylinder = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(512, 1.0)?)?;
    /// let rest = Problem::new(cylinder, ContactModulus(1.0), Load::MeanPressure(0.01))?;
    /// let moving = rest.clone().sliding(0.1, &[(2.0, 1.0)])?;
    /// let contact = MonotoneSets.solve(&moving, &Stop::default(), &mut ())?.converged()?;
    /// assert!(contact.certificate.eta <= 1e-8);
    /// assert!(Multilevel.solve(&moving, &Stop::default(), &mut ()).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn sliding(self, speed: f64, terms: &[(f64, f64)]) -> Result<Self, ProblemError> {
        let (grid, solid) = (*self.surface().grid(), self.solid().clone());
        let compliance = Compliance::sliding(&grid, solid, self.load().keeps_uniform(), speed, terms)?;
        self.with_compliance(compliance)
    }

    /// The contact modulus that acts under a pressure, row by row: the modulus of the elastic solid that the pressure would displace with
    /// the same rms gradient of its surface. At rest it is the contact modulus `E*`. Of a contact that slides,
    ///
    /// `E*_V = E* (<|grad A p|^2> / <|grad u|^2>)^(1/2)`
    ///
    /// with the compliance `A` of the solid under fast loads. It goes from the relaxed to the glassy modulus as the speed grows. In full
    /// contact it does not depend on the load.
    ///
    /// # Panics
    /// If the length of `pressure` does not fit the grid.
    pub fn effective_modulus(&self, pressure: &[f64]) -> f64 {
        let Some(motion @ SteadyMotion::Sliding { .. }) = self.compliance().motion() else {
            return self.contact_modulus();
        };
        let grid = *self.surface().grid();
        let weights = self.compliance().weights().unwrap_or_default();
        let waves = grid.wave_vectors().zip(spectrum(&grid, pressure)).zip(grid.multiplicities()).zip(weights);
        let [mut glassy, mut moving] = [0.0; 2];
        for ((([qy, qx], p), multiplicity), weight) in waves {
            let square = multiplicity * (qx * qx + qy * qy) * (p * weight).norm_sqr();
            moving += square;
            glassy += square / motion.factor(qx).norm_sqr();
        }
        // a uniform pressure bends nothing
        let ratio = f64::sqrt(glassy / moving);
        if ratio.is_finite() { self.contact_modulus() * ratio } else { self.contact_modulus() }
    }

    /// Whether the contact moves over its solid. Its compliance is then not symmetric, and no energy belongs to the contact.
    pub fn is_moving(&self) -> bool {
        !self.compliance().is_symmetric()
    }
}

/// `-<p u_y'> / <p>` and `-<p u_x'> / <p>` of a pressure and its displacement, both row by row: the coefficients of the force on the
/// solid along both axes, by the spectrum, so that no edge is counted. NaN for a problem at rest.
pub(crate) fn hysteretic_friction(problem: &Problem, pressure: &[f64], displacement: &[f64]) -> [f64; 2] {
    if !problem.is_moving() {
        return [f64::NAN; 2];
    }
    let grid = *problem.surface().grid();
    let [p, u] = [pressure, displacement].map(|field| spectrum(&grid, field));
    let mut force = [0.0; 2];
    for (((p, u), weight), q) in p.iter().zip(&u).zip(grid.multiplicities()).zip(directions(&grid)) {
        // <p u'> is the sum over both signs of conj(p_q) i q u_q
        let product = weight * (p.conj() * Complex::new(0.0, 1.0) * u).re;
        force.iter_mut().zip(q).for_each(|(force, q)| *force += q * product);
    }
    force.map(|force| -force / problem.mean_pressure_of(pressure))
}

pub(crate) fn spectrum(grid: &Grid, field: &[f64]) -> Vec<Complex> {
    let mut spectrum = vec![Complex::default(); grid.modes()];
    Fourier::new(grid).forward(field, &mut spectrum);
    spectrum
}

/// Wave vectors `[q_y, q_x]` of derivatives: zero along an axis at its Nyquist wave, which has no direction there.
pub(crate) fn directions(grid: &Grid) -> impl Iterator<Item = [f64; 2]> {
    let nyquist = grid.spacing().map(|spacing| std::f64::consts::PI / spacing * (1.0 - 1e-12));
    let is_even = grid.shape().map(|n| n.is_multiple_of(2));
    grid.wave_vectors()
        .map(move |q| [0, 1].map(|axis| if is_even[axis] && q[axis].abs() >= nyquist[axis] { 0.0 } else { q[axis] }))
}
