//! Results of other codes.

use super::given_field::GivenField;
use super::wave_stiffness::WaveStiffness;
use crate::contact::{Certificate, ContactModulus, Load, Problem};
use crate::error::{ClaimError, ProblemError};
use crate::surface::{Field, Surface};
use std::sync::Arc;

/// A field from another code that is claimed to solve the contact of a surface on a solid.
///
/// The load may be left out: it is then that of the field itself, the mean of a pressure, or that of a gap.
#[derive(Debug, Clone)]
pub struct Claim {
    pub(super) surface: Arc<Surface>,
    pub(super) contact_modulus: f64,
    /// The load that is prescribed.
    pub(super) load: Option<Load>,
    pub(super) quantity: GivenField,
    /// The field, row by row.
    pub(super) values: Vec<f64>,
    /// The stiffness that it is taken to be computed with.
    pub(super) kernel: WaveStiffness,
    /// The problem with its own solid or law, if that is no half-space or no hard wall.
    special: Option<Problem>,
}

impl Claim {
    /// The claim that `values` of a quantity solve the contact of `surface` on a solid under a load.
    ///
    /// # Errors
    /// [`ClaimError`] for a field that does not fit the surface or is not finite, and for a displacement without a load.
    pub fn new(
        surface: impl Into<Arc<Surface>>,
        ContactModulus(contact_modulus): ContactModulus,
        load: Option<Load>,
        quantity: GivenField,
        values: &Field,
    ) -> Result<Self, ClaimError> {
        let surface = surface.into();
        let expected = surface.grid().shape();
        check(quantity, values, expected)?;
        if load.is_none() && quantity == GivenField::Displacement {
            return Err(ClaimError::NoLoad);
        }
        let values = values.iter().copied().collect();
        Ok(Self { surface, contact_modulus, load, quantity, values, kernel: WaveStiffness::Norm, special: None })
    }

    /// The same claim for a problem of the same surface with a solid or a law of its own. The load of the problem is not used.
    pub fn with_problem(self, problem: Problem) -> Self {
        Self { special: Some(problem), ..self }
    }

    /// Whether the solid is a half-space below a hard wall, for which everyday errors are looked for.
    pub(super) fn is_plain(&self) -> bool {
        self.special.is_none()
    }

    /// The quantity that is claimed.
    pub fn quantity(&self) -> GivenField {
        self.quantity
    }

    /// The load that is prescribed, if one is.
    pub fn load(&self) -> Option<Load> {
        self.load
    }

    /// The field, row by row.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The mean of the field.
    pub fn mean(&self) -> f64 {
        self.values.iter().sum::<f64>() / self.values.len() as f64
    }

    /// The problem that it is claimed to solve.
    ///
    /// # Errors
    /// The errors of [`Problem::new`] and of [`Problem::with_load`], such as for a load of the field that presses nothing.
    pub fn problem(&self) -> Result<Problem, ProblemError> {
        let mean = self.mean();
        let own = match self.quantity {
            GivenField::Pressure => Load::MeanPressure(mean.abs()),
            GivenField::Gap | GivenField::Displacement => Load::MeanGap(mean),
        };
        let load = self.load.unwrap_or(own);
        match &self.special {
            Some(problem) => problem.clone().with_load(load),
            None => Problem::new(self.surface.clone(), ContactModulus(self.contact_modulus), load),
        }
    }

    /// The state that it makes of its problem.
    ///
    /// # Errors
    /// The errors of [`Claim::problem`].
    pub(super) fn state(&self) -> Result<ClaimedState, ProblemError> {
        let problem = self.problem()?;
        let mut response = problem.response();
        let pressure = self.quantity.pressure_by(self.kernel, &problem, &self.values, &mut response);
        Ok(ClaimedState::new(problem, pressure, self.kernel))
    }
}

/// Refuses a field that does not fit a grid or is not finite.
pub(super) fn check(quantity: GivenField, values: &Field, expected: [usize; 2]) -> Result<(), ClaimError> {
    let (quantity, found) = (quantity.name(), values.shape());
    if found != expected {
        let is_transposed = found == [expected[1], expected[0]];
        return Err(ClaimError::Shape { quantity, found: found.to_vec(), expected, is_transposed });
    }
    match values.indexed_iter().find(|(_, value)| !value.is_finite()) {
        Some(((row, column), &value)) => Err(ClaimError::NonFinite { quantity, index: [row, column], value }),
        None => Ok(()),
    }
}

/// A pressure, feasible or not, and the displacement that it makes.
pub(super) struct ClaimedState {
    pub problem: Problem,
    pub pressure: Vec<f64>,
    pub displacement: Vec<f64>,
    kernel: WaveStiffness,
}

impl ClaimedState {
    fn new(problem: Problem, pressure: Vec<f64>, kernel: WaveStiffness) -> Self {
        let mut displacement = vec![0.0; pressure.len()];
        problem.response().displacement(&pressure, &mut displacement);
        kernel.soften(problem.surface().grid(), &mut displacement);
        Self { problem, pressure, displacement, kernel }
    }

    /// The same with another pressure.
    pub(crate) fn with_pressure(&self, pressure: &[f64]) -> Self {
        Self::new(self.problem.clone(), pressure.to_vec(), self.kernel)
    }

    /// The certificate of the pressure as it is.
    pub(crate) fn certificate(&self) -> Certificate {
        Certificate::from_displacement(&self.problem, &self.pressure, &self.displacement)
    }
}
