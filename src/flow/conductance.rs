//! The electrical and thermal conductance of a contact.

use crate::contact::Contact;
use crate::error::FlowError;

/// The conductance of a contact between two bodies, by Barber's analogy.
///
/// Current flows from one half-space to the other through the contact only, and each body conducts with the same resistivity
/// everywhere. On the contact the potential is constant, and elsewhere no current passes the surface. The potential in a half-space with the
/// resistivity `rho` follows from the current density `j` at its surface as the displacement follows from the pressure:
///
/// ```text
/// phi_q = rho j_q/|q|        u_q = 2 p_q/(E* |q|)
/// ```
///
/// When the surfaces approach a little more, the displacement rises by the same amount on all of the contact. So the pressure that is added is
/// distributed like the current, and
///
/// ```text
/// G/A = 2 k/(E* (rho_1 + rho_2))
/// ```
///
/// with the contact stiffness `k`, see [`Contact::stiffness`]. It holds for contacts of any form, and does not depend on `E*`. It is what
/// the constriction of the current adds to the resistance of the bodies. Where all nodes of a periodic cell touch, nothing is constricted, and the conductance is infinite.
///
/// Units: with resistivities in ohm metres, `per_area` is in siemens per square metre. For heat give the inverses of the thermal conductivities in
/// metre kelvin per watt: `per_area` is then in watt per square metre and kelvin. Films, oxides and the fluid in the gap are left out.
///
/// Below a hardness all touching nodes conduct, also those that yield: [`Contact::stiffness_of_all`].
///
/// On a free line the stiffness, and so the conductance, depends on the datum of the solid, since the potential of a line source has no limit
/// far away.
///
/// # Source
/// Barber, Proc. R. Soc. A 459, 53 (2003).
///
/// ```
/// use asperity::contact::{ContactModulus, Load, Multilevel, Solver};
/// use asperity::flow::Conductance;
/// use asperity::{Grid, Indenter, Problem, Stop};
/// use std::f64::consts::PI;
/// // strips on half of the surface: G/A = pi/((rho_1 + rho_2) L ln(1/sin psi)) with sin^2 psi = 1/2
/// let sine = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(1024, 1.0)?)?;
/// let problem = Problem::new(sine, ContactModulus(1.0), Load::MeanPressure(0.005 * PI))?;
/// let contact = Multilevel.solve(&problem, &Stop::default(), &mut ())?.converged()?;
/// let conductance = Conductance::new(&contact, [2.0, 3.0])?;
/// assert!((conductance.per_area * 5.0 * 2f64.ln() / (2.0 * PI) - 1.0).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conductance {
    /// The conductance per area of the cell, one over resistivity and length. On a line the area is a length times the width.
    pub per_area: f64,
    /// The conductance of the cell: `per_area` times its area, or its length on a line.
    pub total: f64,
}

impl Conductance {
    /// The conductance of a contact between bodies with the given resistivities, one of which may be zero.
    ///
    /// # Errors
    /// - [`FlowError::Resistivity`] for resistivities that are negative, not finite, or both zero;
    /// - [`FlowError::NeedsHalfSpace`] for a layer;
    /// - [`FlowError::NeedsRest`] for a contact that moves over its solid, to whose displacements its loss contributes.
    pub fn new(contact: &Contact, resistivities: [f64; 2]) -> Result<Self, FlowError> {
        let [first, second] = resistivities;
        let problem = &contact.problem;
        let is_resistivity = |value: f64| value.is_finite() && value >= 0.0;
        if !resistivities.into_iter().all(is_resistivity) || first + second == 0.0 {
            return Err(FlowError::Resistivity { first, second });
        }
        if problem.is_moving() {
            return Err(FlowError::NeedsRest);
        }
        if !problem.solid().is_half_space() {
            return Err(FlowError::NeedsHalfSpace { solid: problem.solid().description() });
        }
        let per_area = 2.0 * contact.stiffness_of_all() / (problem.contact_modulus() * (first + second));
        Ok(Self { per_area, total: per_area * problem.surface().grid().area() })
    }
}
