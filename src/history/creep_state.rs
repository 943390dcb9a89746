//! The state of a viscoelastic contact at one time.

use super::kelvin::KelvinStep;
use crate::contact::{Contact, Edges, Law, Load, Resolved};
use crate::surface::Field;

/// Energies of a viscoelastic contact per area of the cell, pressure times length.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CreepEnergy {
    /// The elastic energy that is stored: `<p A p>/2 + sum_j <eps_j A eps_j>/(2 f_j)`.
    pub stored: f64,
    /// The energy that the dashpots have taken up so far: `sum_j tau_j/f_j int <eps_j' A eps_j'> dt`, exact for the
    /// pressures of the steps.
    pub lost: f64,
    /// The work of the load so far, `int <p> d(approach)`, by the trapezoidal rule over the steps; a step without time adds
    /// what it stores. Over a closed cycle it equals `lost`, except for the error in time.
    pub work: f64,
}

/// A viscoelastic contact at one time: the contact, and what the solid remembers.
///
/// | quantity | shape | unit | meaning |
/// |---|---|---|---|
/// | `contact.pressure` | `(ny, nx)` | pressure | `p >= 0`, the pressure now |
/// | `contact.displacement` | `(ny, nx)` | length | `u = A (p + sum_j eps_j)` |
/// | `contact.gap` | `(ny, nx)` | length | `u - h + d` with the heights of the surface |
/// | `memory` | one field per term | pressure | `eps_j` |
///
/// The certificate of the contact is that of the convex problem of the step: it bounds the error of the pressure for
/// the memory that the state before had. [`CreepState::error_bound`] adds up such errors over all steps. The length of
/// the steps causes another error, see [`CreepState::time_error`].
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
    /// The field `eps_j` of each term, a pressure, shape `(ny, nx)`.
    pub memory: Vec<Field>,
    /// Energies per area.
    pub energy: CreepEnergy,
    /// The estimated relative error of the effective pressure (root mean square) by finite steps in time, from step doubling;
    /// NaN if the steps were given.
    pub time_error: f64,
    pub(super) carried: Carried,
}

/// What a state carries on besides the memory.
#[derive(Debug, Clone)]
pub(super) struct Carried {
    /// `|eps_j|^2` and `<eps_j A p>` of each term.
    pub products: Vec<[f64; 2]>,
    /// `|p|^2`.
    pub square: f64,
    /// How far the surface has moved, a length from any datum.
    pub moved: f64,
    /// Whether the next step takes the pressure as constant: there was no step with time since the start or the last jump.
    pub has_jumped: bool,
    pub bounds: ErrorBounds,
    /// The displacement `A eps_1` by the memory of a solid of one term.
    pub remembered: Option<Field>,
    /// The signed pressure of the state before and the time since then.
    pub before: Option<(Field, f64)>,
}

/// Bounds of errors in the norm `|x|_A`, see [`CreepState::error_bound`].
#[derive(Debug, Clone, Default)]
pub(super) struct ErrorBounds {
    /// `b_j` of each term.
    pub memory: Vec<f64>,
    /// `N` with the weights `s_j` of the last step.
    pub joint: Option<(f64, Vec<f64>)>,
    /// Of the pressure.
    pub pressure: f64,
    /// Of the effective pressure.
    pub effective: f64,
}

impl ErrorBounds {
    /// The bounds after a step whose pressure is off by `error` for the memory that it was given.
    pub fn next(&self, steps: &[KelvinStep], error: f64) -> Self {
        let mut bounds = self.memory.clone();
        bounds.resize(steps.len(), 0.0);
        let carried = |step: &KelvinStep, bound: f64| step.keep * bound + step.before * self.pressure;
        let off: f64 = steps.iter().zip(&bounds).map(|(step, &bound)| carried(step, bound)).sum();
        let sum: f64 = steps.iter().map(|step| step.after).sum();
        let pressure = off / (1.0 + sum) + error;
        let joint = self.joint(steps, &bounds).map(|joint| joint + sum.sqrt() * error);
        let next = |(step, bound): (&KelvinStep, f64)| {
            let own = carried(step, bound) + step.after * pressure;
            joint.map_or(own, |joint| own.min(step.after.sqrt() * joint))
        };
        let memory = steps.iter().zip(bounds).map(next).collect();
        let joint = joint.map(|joint| (joint, steps.iter().map(|step| step.after).collect()));
        Self { memory, joint, pressure, effective: off + (1.0 + sum) * error }
    }

    /// `N` before the error of the step: from the bounds of the terms, or from that of the last step. None for a step
    /// without time and for the rule of linear pressure.
    fn joint(&self, steps: &[KelvinStep], bounds: &[f64]) -> Option<f64> {
        if steps.iter().any(|step| step.after == 0.0 || step.before > 0.0) {
            return None;
        }
        let squares = steps.iter().zip(bounds).map(|(step, bound)| (step.keep * bound).powi(2) / step.after);
        let own = squares.sum::<f64>().sqrt();
        let last = self.joint.as_ref().map(|(joint, weights)| {
            let growth = steps.iter().zip(weights).map(|(step, weight)| step.keep * (weight / step.after).sqrt());
            joint * growth.fold(0.0, f64::max)
        });
        Some(last.map_or(own, |last| last.min(own)))
    }
}

impl CreepState {
    /// The effective pressure `p + sum_j eps_j`, shape `(ny, nx)`: the pressure that would displace an elastic solid of the
    /// glassy modulus as this one is displaced. Under a load that has never fallen it is the pressure of the elastic contact
    /// under the load `int J dP`.
    pub fn effective_pressure(&self) -> Field {
        self.memory.iter().fold(self.contact.pressure.clone(), |sum, eps| sum + eps)
    }

    /// `E*_0 <p> / <p + sum_j eps_j>`, the modulus of the elastic solid that the load would displace as much: between the
    /// glassy and the relaxed modulus under a load that never falls, a pressure.
    pub fn effective_modulus(&self) -> f64 {
        let effective = self.effective_pressure().mean().unwrap_or(0.0);
        self.contact.problem.contact_modulus() * self.contact.mean_pressure() / effective
    }

    /// Area, gradient and `kappa_r` with edges interpolated between the nodes. The law of the edges and the reduced
    /// pressure use the effective pressure `p + sum_j eps_j` of the nodes in contact with the glassy modulus. So the
    /// reduced pressure is `<p + sum_j eps_j> / (gbar_r E*_0)`, that of the mean pressure with
    /// [`CreepState::effective_modulus`], and `kappa_r` can be compared with that of an elastic contact.
    ///
    /// Where a contact recedes the pressure does not fall to its edges as the effective one does, and the place of an edge
    /// is that of an elastic contact with these pressures and gaps only approximately. A hardness is not considered.
    pub fn resolved(&self) -> Resolved {
        let effective = self.effective_pressure();
        let mean = effective.mean().unwrap_or(0.0);
        let pairs = effective.iter().zip(&self.contact.pressure);
        let touching: Vec<f64> = pairs.map(|(&all, &now)| if now > 0.0 { all } else { 0.0 }).collect();
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

    /// The rigorous bound of the relative error of the effective pressure `p + sum_j eps_j` by all solves so far, in the norm
    /// `|x|^2 = <x A x>`. It compares with the exact solution of the same steps in time.
    ///
    /// **One step.** The exact step has the pressure `p' = m p` with the smallest `|p' + hist - A^-1 h|` of all pressures under
    /// the load, so it is a projection in this norm. Projections are firmly nonexpansive: if `hist` is off by `d`, then `p'`
    /// changes by `x` with `<x A d> <= -|x|^2`. So the pressure changes by at most `|d|/m`, and `p' + hist`, which is the
    /// effective pressure, by at most `|d|`. The solver adds at most `e`, the pressure error of the certificate, to the pressure, and
    /// `m e` to the effective one.
    ///
    /// **Many steps.** With `e_j = exp(-dt/tau_j)`, `s_j = f_j (1 - e_j)`, `m = 1 + sum s_j` and bounds `b_j` of the error of
    /// `eps_j`, `|d| <= sum e_j b_j`, and
    ///
    /// ```text
    /// b_j <- e_j b_j + s_j (|d|/m + e)
    /// ```
    ///
    /// For one term firm nonexpansiveness gives `b <- e_1 b + s_1 e`: errors of earlier steps fade. For several terms
    /// the sum over `|d eps_j|^2 / s_j` does not grow for the same reason, so `N^2 = sum b_j^2 / s_j` obeys
    /// `N <- sqrt(sum (e_j b_j)^2 / s_j) + sqrt(m - 1) e`, and `b_j <= sqrt(s_j) N`. The smaller bound is used.
    /// The rule of linear pressure has the first bound only, with the error of the pressure before in it.
    ///
    /// At a given mean gap or approach the bound holds as far as that of the certificate does, see
    /// [`crate::contact::Certificate::pressure_error_bound`].
    pub fn error_bound(&self) -> f64 {
        let effective = self.effective_pressure();
        // scaled, since a memory that has faded squares to zero
        let [pressure, displacement] = [&effective, &self.contact.displacement].map(largest);
        let pairs = self.contact.displacement.iter().zip(&effective);
        let sum: f64 = pairs.map(|(u, p)| (u / displacement) * (p / pressure)).sum();
        let length = (sum / effective.len() as f64).sqrt() * pressure.sqrt() * displacement.sqrt();
        match self.carried.bounds.effective {
            0.0 => 0.0,
            bound if length > 0.0 => bound / length,
            _ => f64::INFINITY,
        }
    }
}

fn largest(field: &Field) -> f64 {
    field.iter().fold(0.0, |most, value| value.abs().max(most))
}
