//! Problems of contacts that move over their solid.

use crate::contact::Problem;
use crate::elastic::Compliance;
use crate::error::ProblemError;

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
    /// The errors of [`Compliance::sliding`], and [`ProblemError::OutOfRange`] for a creep that leaves the range of doubles.
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

    /// Whether the contact moves over its solid, so that its compliance is not symmetric, and no energy belongs to it.
    pub fn is_moving(&self) -> bool {
        !self.compliance().is_symmetric()
    }
}
