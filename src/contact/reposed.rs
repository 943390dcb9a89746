//! Problems that are posed again: with another law, other ceilings, or other heights.

use crate::contact::problem::{Yielded, check_magnitude};
use crate::contact::{Ceiling, Law, Load, Problem, chunks};
use crate::error::{ProblemError, SurfaceError};
use crate::surface::{Field, Surface};
use std::sync::{Arc, OnceLock};

impl Problem {
    /// The problem with a law of contact.
    ///
    /// # Errors
    /// [`ProblemError::NotPositive`] for a hardness that is not positive and finite, [`ProblemError::AboveHardness`] for one below the
    /// mean pressure.
    pub fn with_law(self, law: Law) -> Result<Self, ProblemError> {
        if let Law::Hardness(hardness) = law {
            check_magnitude("hardness", hardness)?;
        }
        Self { law, ceiling: Ceiling::Uniform(law.ceiling()), ..self }.below_ceiling()
    }

    /// The problem with a ceiling of the pressure at each node, row by row, in place of a law. Some ceilings may be zero, but not
    /// all of them.
    ///
    /// # Errors
    /// [`ProblemError::NotPositive`] for a ceiling that is negative or not finite, or if all are zero,
    /// [`ProblemError::AboveHardness`] for ceilings whose mean is below the mean pressure.
    ///
    /// # Panics
    /// If there is not one ceiling for each node.
    ///
    /// ```
    /// use asperity::contact::{ContactModulus, Load, Multilevel, Solver};
    /// use asperity::{Grid, Indenter, Problem, Stop};
    /// let sine = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(256, 1.0)?)?;
    /// let problem = Problem::new(sine, ContactModulus(1.0), Load::MeanPressure(0.01))?;
    /// // no pressure is allowed on the left half of the cell
    /// let ceilings: Vec<f64> = (0..256).map(|i| if i < 128 { 0.0 } else { 0.05 }).collect();
    /// let contact = Multilevel.solve(&problem.with_ceilings(ceilings)?, &Stop::default(), &mut ())?.converged()?;
    /// assert!(contact.pressure.iter().take(128).all(|&p| p == 0.0) && contact.max_pressure() <= 0.05);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn with_ceilings(self, ceilings: impl Into<Arc<[f64]>>) -> Result<Self, ProblemError> {
        let ceilings = ceilings.into();
        assert_eq!(ceilings.len(), self.nodes(), "one ceiling for each node");
        if let Some(&value) = ceilings.iter().find(|it| !(it.is_finite() && **it >= 0.0)) {
            return Err(ProblemError::NotPositive { name: "ceiling of the pressure", value });
        }
        let ceiling = Ceiling::Field(ceilings);
        check_magnitude("mean ceiling of the pressure", ceiling.mean(self.nodes()))?;
        Self { law: Law::HardWall, ceiling, ..self }.below_ceiling()
    }

    /// The elastic problem of the surface after a contact with a hardness, see
    /// [`crate::contact::Contact::unloaded_surface`], under a mean pressure. Rms height, rms gradient, highest peak and
    /// mean gap stay those of the surface as it was, so that numbers on the way up and back are divided by the same
    /// values.
    ///
    /// # Errors
    /// The errors of [`Problem::new`].
    pub fn yielded(&self, left: impl Into<Arc<Surface>>, mean_pressure: f64) -> Result<Self, ProblemError> {
        let (left, solid) = (left.into(), self.solid().clone());
        // its heights are given about the mean of this one
        let overlap = -left.mean_height();
        let yielded = self.law.hardness().map(|hardness| Yielded { overlap, hardness });
        let start = (self.rms_height, self.highest, OnceLock::from(self.rms_gradient()));
        let elastic = Self::new(left, solid, Load::MeanPressure(mean_pressure))?;
        Ok(Self { yielded, rms_height: start.0, highest: start.1, rms_gradient: start.2, ..elastic })
    }

    /// The same problem with other heights, on the same grid, solid and plans. Heights are counted from the mean plane of
    /// this problem's surface, shape `(ny, nx)`. Rms height, rms gradient and highest peak stay those of that surface: so a
    /// certificate, a reduced pressure, a mean gap and an approach mean the same as before.
    ///
    /// A step of a history is such a problem: the displacement that a solid remembers is subtracted from the heights.
    ///
    /// # Errors
    /// [`SurfaceError::Shape`] for an array that does not fit the grid, [`SurfaceError::NonFinite`] for a NaN or infinity.
    ///
    /// ```
    /// use asperity::contact::{ContactModulus, Load, Multilevel, Solver};
    /// use asperity::{Grid, Indenter, Problem, Stop};
    /// let sine = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(256, 1.0)?)?;
    /// let problem = Problem::new(sine, ContactModulus(1.0), Load::MeanPressure(0.01))?;
    /// // heights that are twice as large under twice the pressure make twice the gap
    /// let twice = problem.with_heights(2.0 * problem.surface().height())?.with_load(Load::MeanPressure(0.02))?;
    /// let [one, two] = [&problem, &twice].map(|problem| Multilevel.solve(problem, &Stop::default(), &mut ()));
    /// assert!((two?.mean_gap() / one?.mean_gap() - 2.0).abs() < 1e-6);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn with_heights(&self, height: Field) -> Result<Self, SurfaceError> {
        let surface = Surface::new(*self.surface.grid(), height)?;
        let rms_gradient = OnceLock::from(self.rms_gradient());
        let (shift, mean_height) = (self.shift + surface.mean_height(), chunks::compensated_mean(surface.heights()));
        Ok(Self { surface: surface.into(), shift, mean_height, rms_gradient, ..self.clone() })
    }

    /// The problem of other heights as if it were posed for them, with their own highest peak and mean plane; only the rms height, by which
    /// certificates are divided, stays. The load is that of this problem, and a new one must be given that suits the heights.
    pub(crate) fn posed_for(&self, height: Field) -> Result<Self, SurfaceError> {
        let posed = self.with_heights(height)?;
        let highest = posed.surface.heights().iter().fold(0.0, |most: f64, &h| most.max(h)) - posed.mean_height;
        Ok(Self { highest, shift: 0.0, ..posed })
    }
}
