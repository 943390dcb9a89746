//! The state of a viscoelastic contact at one time.

use super::maxwell::MaxwellStep;
use super::time_errors::{TimeErrors, rms};
use crate::contact::{Contact, Edges, Law, Load, Resolved};
use crate::surface::{Field, largest};

/// Nodes that carry less than this part of the largest pressure do not count for the area: it is rounding where a contact recedes, but their
/// effective pressure is not small.
pub(super) const NEGLIGIBLE: f64 = 1e-10;

/// Energies of a viscoelastic contact per area of the cell, pressure times length.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CreepEnergy {
    /// The elastic energy that is stored: `g <p_e A p_e>/2 + sum_k <y_k A y_k>/(2 g_k)`.
    pub stored: f64,
    /// The energy that the dashpots have taken up so far: `sum_k 1/(g_k rho_k) int <y_k A y_k> dt`, exact for the course of the effective
    /// pressure in the steps.
    pub lost: f64,
    /// The work of the load so far, `int <p> d(approach)`, exact for the course of the mean pressure in the steps; a step without time adds
    /// what it stores. It equals `stored + lost`, except for the error in time.
    pub work: f64,
}

/// A viscoelastic contact at one time: the contact, and what the solid remembers.
///
/// | quantity | shape | unit | meaning |
/// |---|---|---|---|
/// | `contact.pressure` | `(ny, nx)` | pressure | `p >= 0`, the pressure now |
/// | `contact.displacement` | `(ny, nx)` | length | `u = A p_e` |
/// | `contact.gap` | `(ny, nx)` | length | `u - h + d` with the heights of the surface |
/// | `memory` | one field per term in relaxation form | pressure | `y_k`, what the element still holds of `p` |
/// | [`effective_pressure`](CreepState::effective_pressure) | `(ny, nx)` | pressure | `p_e` |
///
/// The certificate of the contact is that of the convex problem of the step: it bounds the error of the pressure for
/// the memory that the state before had. [`CreepState::error_bound`] adds up such errors over all steps. The length of
/// the steps causes other errors, see [`CreepState::time_errors`].
///
/// Measures of [`Contact`] that use the contact modulus, such as [`Contact::resolved`], use the glassy one. Use
/// [`CreepState::resolved`] instead. Without a load, and where the surfaces do not touch, `contact.problem`
/// has the load of an earlier state. The load of this state is [`CreepState::load`].
///
/// ```
/// use asperity::contact::{ContactModulus, Load, Multilevel, Stop};
/// use asperity::elastic::{Prony, PronyTerm};
/// use asperity::history::{Creep, CreepPath, CreepSteps};
/// use asperity::{Grid, Indenter, Problem};
/// let sine = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(256, 1.0)?)?;
/// let problem = Problem::new(sine, ContactModulus(1.0), Load::MeanPressure(0.001))?;
/// let prony = Prony::new(vec![PronyTerm { ratio: 4.0, time: 1.0 }])?;
/// // pressed and released within two seconds, then left alone
/// let points = [(0.0, 0.0), (1.0, 0.002), (2.0, 0.0), (30.0, 0.0)].map(|(t, p)| (t, Load::MeanPressure(p)));
/// let path = CreepPath::new(points.to_vec())?;
/// let steps = CreepSteps::fixed(Creep::new(problem, prony), path, 50, &Multilevel, Stop::default())?;
/// let end = steps.last().expect("there are states")?;
/// assert_eq!(end.contact.mean_pressure(), 0.0);
/// assert!(end.memory[0].iter().all(|&eps| eps < 1e-10));
/// // the work of the load is the energy that the solid has lost, except for the error in time
/// assert!((end.energy.work / end.energy.lost - 1.0).abs() < 0.1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct CreepState {
    /// The time.
    pub time: f64,
    /// The load, none before the first one.
    pub load: Option<Load>,
    /// The contact.
    pub contact: Contact,
    /// The field `y_k` of each term of [`Prony::to_relaxation`](crate::elastic::Prony::to_relaxation), a pressure, shape `(ny, nx)`.
    pub memory: Vec<Field>,
    /// Energies per area.
    pub energy: CreepEnergy,
    /// Estimated errors by finite steps in time, from the same history in steps of twice the length; none if the steps were given.
    pub time_errors: Option<TimeErrors>,
    pub(super) carried: Carried,
}

/// What a state carries on besides the memory.
#[derive(Debug, Clone)]
pub(super) struct Carried {
    /// `p_e`.
    pub effective: Field,
    /// The displacements `A y_k`.
    pub displaced: Vec<Field>,
    /// `1 - 1/m` of the last step: the part of a new effective pressure that its elements let flow.
    pub flowed: f64,
    /// How far the surface has moved, a length from any datum.
    pub moved: f64,
    pub bounds: ErrorBounds,
    /// The signed pressure of the state before and the time since then.
    pub before: Option<(Field, f64)>,
}

/// Bounds of errors in the norm `|x|_A`, see [`CreepState::error_bound`].
#[derive(Debug, Clone, Default)]
pub(super) struct ErrorBounds {
    /// `b_k` of `p_e - y_k/g_k` for each term.
    pub flowed: Vec<f64>,
    /// Of the effective pressure.
    pub effective: f64,
}

impl ErrorBounds {
    /// The bounds after a step whose `m p` is off by `error` for the memory that it was given.
    pub(crate) fn next(&self, elements: &[MaxwellStep], compliance: f64, error: f64) -> Self {
        let mut flowed = self.flowed.clone();
        flowed.resize(elements.len(), 0.0);
        let carried = |it: &MaxwellStep, bound: f64| it.keep * bound + (it.held - it.keep).abs() * self.effective;
        let pairs = || elements.iter().zip(&flowed);
        let off: f64 = pairs().map(|(it, &bound)| it.ratio * carried(it, bound)).sum();
        let effective = compliance * off + error;
        let next = |(it, &bound): (&MaxwellStep, &f64)| carried(it, bound) + (1.0 - it.held).abs() * effective;
        Self { flowed: pairs().map(next).collect(), effective }
    }
}

impl CreepState {
    /// The effective pressure `p_e`, shape `(ny, nx)`: the pressure that would displace an elastic solid of the
    /// glassy modulus as this one is displaced, `u = A p_e`. In creep form it is `p + sum_j eps_j`. Under a load that has never fallen it is
    /// the pressure of the elastic contact under the load `int J dP`.
    pub fn effective_pressure(&self) -> &Field {
        &self.carried.effective
    }

    /// `E*_0 <p> / <p_e>`, the modulus of the elastic solid that the load would displace as much: between the
    /// glassy and the relaxed modulus under a load that never falls, a pressure.
    pub fn effective_modulus(&self) -> f64 {
        let effective = self.effective_pressure().mean().unwrap_or(0.0);
        self.contact.problem.contact_modulus() * self.contact.mean_pressure() / effective
    }

    /// The relative area with edges interpolated between the nodes, as [`CreepState::resolved`] has it; 0 where nothing touches.
    pub fn relative_area(&self) -> f64 {
        if self.contact.mean_pressure() > 0.0 { self.resolved().relative_area } else { 0.0 }
    }

    /// The estimated relative error of the contact pressure (root mean square over the nodes) by finite steps in time; none if the steps were
    /// given, and infinite where there is an error but no pressure.
    pub fn time_error(&self) -> Option<f64> {
        let error = self.time_errors.as_ref()?.pressure;
        Some(if error > 0.0 { error / rms(&self.contact.pressure) } else { 0.0 })
    }

    /// Area, gradient and `kappa_r` with edges interpolated between the nodes. The law of the edges and the reduced
    /// pressure use the effective pressure `p_e` of the nodes in contact with the glassy modulus. So the
    /// reduced pressure is `<p_e> / (gbar_r E*_0)`, that of the mean pressure with
    /// [`CreepState::effective_modulus`], and `kappa_r` can be compared with that of an elastic contact.
    ///
    /// Where a contact recedes the pressure does not fall to its edges as the effective one does, and the place of an edge
    /// is that of an elastic contact with these pressures and gaps only approximately. A hardness is not considered.
    pub fn resolved(&self) -> Resolved {
        let mean = self.effective_pressure().mean().unwrap_or(0.0);
        let touching = self.touching();
        let gap = self.contact.gap.as_slice().expect("results are made in standard layout");
        let problem = self.contact.problem.clone().with_law(Law::HardWall).expect("any load suits a hard wall");
        let resolved = Edges::new(&problem, &touching, |node| gap[node]).resolved();
        let strain = mean / problem.contact_modulus();
        let gradient = resolved.rms_gradient_contact;
        Resolved {
            reduced_pressure_contact: strain / gradient,
            kappa_r: resolved.relative_area * gradient / strain,
            ..resolved
        }
    }

    /// Whether nothing touches.
    pub(super) fn is_apart(&self) -> bool {
        self.contact.pressure.iter().all(|&p| p <= 0.0)
    }

    /// The effective pressure of the nodes in contact, row by row; 0 for the others.
    pub(super) fn touching(&self) -> Vec<f64> {
        let pairs = self.effective_pressure().iter().zip(&self.contact.pressure);
        let least = NEGLIGIBLE * largest(&self.contact.pressure);
        pairs.map(|(&effective, &now)| if now > least { effective } else { 0.0 }).collect()
    }

    /// The rigorous bound of the relative error of the effective pressure `p_e` by all solves so far, in the norm
    /// `|x|^2 = <x A x>`. It compares with the exact solution of the same steps in time.
    ///
    /// **One step.** The exact step has the pressure `p' = m p` with the smallest `|p' + hist - A^-1 h|` of all pressures under
    /// the load, so it is a projection in this norm. Projections are firmly nonexpansive: if `hist` is off by `d`, then
    /// `p_e = p' + hist` changes by at most `|d|`. The solver adds at most `e'`, the pressure error of the certificate of `p'`.
    ///
    /// **Many steps.** Of `z_k = g_k p_e - y_k`, what the element has let flow, `hist` is
    /// `m sum [e_k z_k + g_k (psi_k - e_k) p_e0]`, and `z_k <- e_k z_k + g_k (psi_k - e_k) p_e0 + g_k (1 - psi_k) p_e`. With bounds `g_k b_k`
    /// of the error of `z_k` and `b` of that of `p_e`,
    ///
    /// ```text
    /// c_k = e_k b_k + (psi_k - e_k) b,    b <- m sum g_k c_k + e',    b_k <- c_k + (1 - psi_k) b
    /// ```
    ///
    /// A profile that rises has `e_k <= psi_k <= 1`. So if no bound is above `B`, then
    /// `m sum g_k c_k <= B (sum g_k psi_k) / (1 - sum g_k + sum g_k psi_k) < B`: errors of earlier steps fade, however many steps there are.
    ///
    /// At a given mean gap or approach the bound holds as far as that of the certificate does, see
    /// [`crate::contact::Certificate::pressure_error_bound`].
    pub fn error_bound(&self) -> f64 {
        let effective = self.effective_pressure();
        // scaled, since a memory that has faded squares to zero
        let [pressure, displacement] = [effective, &self.contact.displacement].map(largest);
        let pairs = self.contact.displacement.iter().zip(effective);
        let sum: f64 = pairs.map(|(u, p)| (u / displacement) * (p / pressure)).sum();
        let length = (sum / effective.len() as f64).sqrt() * pressure.sqrt() * displacement.sqrt();
        match self.carried.bounds.effective {
            0.0 => 0.0,
            bound if length > 0.0 => bound / length,
            _ => f64::INFINITY,
        }
    }
}
