//! The stress below a contact.

use crate::contact::Contact;
use crate::elastic::stress::{Stress, below, depths, highest_row, is_known};
use crate::error::SolidError;

/// Depths at which the stress is given, the surface among them.
const DEPTHS: usize = 64;

impl Contact {
    /// The stress below row `row` of the contact, a line having the row 0, at some depths in a solid of Poisson's ratio `poisson`, see
    /// [`below`].
    ///
    /// # Errors
    /// [`SolidError::Poisson`], and [`SolidError::NoStress`] in a layer and below a surface with a free boundary.
    ///
    /// # Panics
    /// For a row that the grid does not have.
    ///
    /// ```
    /// use asperity::contact::{ContactModulus, Load, Multilevel, Solver};
    /// use asperity::{Grid, Indenter, Problem, Stop};
    /// let cylinder = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(4096, 4.0)?)?;
    /// let problem = Problem::new(cylinder, ContactModulus(1.0), Load::MeanPressure(1e-4))?;
    /// let contact = Multilevel.solve(&problem, &Stop::default(), &mut ())?.converged()?;
    /// let stress = contact.stress(contact.highest_row(), 0.3, &contact.usual_depths())?;
    /// let highest = stress.tau_max().iter().fold(0.0, |most: f64, &tau| most.max(tau));
    /// assert!((highest / contact.max_pressure() - 0.30).abs() < 0.01); // Hertz
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn stress(&self, row: usize, poisson: f64, depth: &[f64]) -> Result<Stress, SolidError> {
        let (pressure, grid) =
            (self.pressure.as_slice().expect("results are made in standard layout"), self.problem.surface().grid());
        if is_known(grid, self.problem.solid().as_ref()) {
            below(grid, pressure, row, poisson, depth)
        } else {
            Err(SolidError::NoStress)
        }
    }

    /// The normal stress along `x` and `y` that the mean pressure makes at all depths of a periodic solid, which cannot strain to its
    /// sides: `-nu/(1 - nu) <p>`; 0 without periods. Less this value, `sigma_xx` is that of a solid that is free to strain along `x`.
    pub fn confined_stress(&self, poisson: f64) -> f64 {
        let is_periodic = self.problem.surface().grid().is_periodic();
        if is_periodic { -poisson / (1.0 - poisson) * self.mean_pressure() } else { 0.0 }
    }

    /// The row of the largest pressure.
    pub fn highest_row(&self) -> usize {
        let pressure = self.pressure.as_slice().expect("results are made in standard layout");
        highest_row(self.problem.surface().grid(), pressure)
    }

    /// The surface, and depths from half of the spacing to half of the cell, at increasing distances.
    pub fn usual_depths(&self) -> Vec<f64> {
        let grid = self.problem.surface().grid();
        depths(0.5 * grid.spacing()[1], 0.5 * grid.size()[1], DEPTHS)
    }
}
