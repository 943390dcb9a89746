//! Contacts of a file, certified again.

use crate::contact::multilevel::hierarchy::coarser;
use crate::contact::{
    Ceiling, Certificate, Contact, Multilevel, Problem, Resolved, SavedDoubt, Solver, Status, Stop, Work,
};
use crate::error::SurfaceError;
use crate::surface::Field;

/// The part of the largest value up to which lengths that were computed twice are the same.
const SAME: f64 = 1e-6;

/// The part of the load up to which a pressure carries it; solvers carry it but for rounding.
const SAME_LOAD: f64 = 1e-6;

/// How much larger a certificate may be that is computed again, from heights whose mean plane was taken off again.
const ROUNDED: f64 = 1.01;

/// The certificate to which the contact on the coarser grid is solved, and the most iterations of this solve.
const COARSE: (f64, usize) = (1e-3, 10_000);

/// The part up to which two contacts on the coarser grid are the same: solvers end there with certificates of up to 0.1.
const SAME_COARSE: f64 = 0.2;

/// A contact as a file has it, of which nothing is believed yet.
#[derive(Debug, Clone)]
pub struct SavedContact {
    /// Pressure, shape `(ny, nx)`.
    pub pressure: Field,
    /// Displacement, shape `(ny, nx)`.
    pub displacement: Field,
    /// Gap, shape `(ny, nx)`.
    pub gap: Field,
    /// How the solver stopped.
    pub status: Status,
    /// The name of the solver.
    pub solver: String,
    /// Work, of which the seconds are not known.
    pub work: Work,
    /// The contact on the next coarser grid.
    pub coarser: Option<Resolved>,
    /// Whether the stiffness was known.
    pub has_stiffness: bool,
    /// The certificate, of which `eta` alone is known.
    pub certificate: Certificate,
}

/// A contact that was certified again, and what is wrong with its file. With any doubt its status is [`Status::Unconfirmed`].
#[derive(Debug, Clone)]
pub struct CertifiedContact {
    /// The contact.
    pub contact: Contact,
    /// What is wrong.
    pub doubts: Vec<SavedDoubt>,
}

impl SavedContact {
    /// The contact of a problem, certified from its pressure alone: whether it is allowed, carries the load and meets the goals of `stop`, whether
    /// displacement and gap are its own, and whether the contact on the next coarser grid is that of the problem.
    ///
    /// Fields that are not those of the pressure are computed again.
    ///
    /// # Errors
    /// [`SurfaceError::Shape`] for fields that do not fit the grid.
    pub fn certified(&self, problem: &Problem, stop: &Stop) -> Result<CertifiedContact, SurfaceError> {
        let found = Contact::from_pressure(problem, self.pressure.clone(), self.work, &self.solver)?;
        let mut doubts = pressure_doubts(problem, &self.pressure);
        let scale = largest(&found.displacement);
        let has_displacement = is_same(&self.displacement, &found.displacement, scale);
        doubts.extend((!has_displacement).then_some(SavedDoubt::Displacement));
        let is_claimed = self.status == Status::Converged;
        if doubts.is_empty() && is_claimed && !is_met(stop, &found.certificate) {
            doubts.push(SavedDoubt::Certificate { eta: found.certificate.eta });
        }
        let has_gap = is_same(&self.gap, &found.gap, scale + largest(&found.gap));
        doubts.extend((!has_gap && has_displacement).then_some(SavedDoubt::Gap));
        let coarser = self.coarser.filter(|_| doubts.is_empty()).map(|saved| compared(saved, problem));
        doubts.extend(coarser.and_then(|(_, is_same)| (!is_same).then_some(SavedDoubt::Coarser)));
        let displacement = if has_displacement { self.displacement.clone() } else { found.displacement };
        let gap = if has_gap { self.gap.clone() } else { found.gap };
        let status = if doubts.is_empty() { self.status } else { Status::Unconfirmed };
        let fields = [self.pressure.clone(), displacement, finite_or(gap, &self.gap)];
        let parts = (found.certificate, self.work, status);
        let coarser = coarser.and_then(|(coarser, _)| coarser);
        let contact = Contact::from_parts(problem.clone(), fields, parts, self.solver.clone(), coarser)?;
        if self.has_stiffness && doubts.is_empty() {
            contact.stiffness();
        }
        Ok(CertifiedContact { contact, doubts })
    }
}

/// What is wrong with a pressure, whatever else is in its file: tension, an excess of the hardness, or another load.
pub fn pressure_doubts(problem: &Problem, pressure: &Field) -> Vec<SavedDoubt> {
    let mut doubts = Vec::new();
    let lowest = pressure.iter().fold(0.0, |least: f64, p| least.min(*p));
    if lowest < 0.0 {
        let nodes = pressure.iter().filter(|p| **p < 0.0).count();
        doubts.push(SavedDoubt::Tension { nodes, lowest: lowest / largest(pressure) });
    }
    let shares = pressure.iter().enumerate().map(|(node, p)| problem.ceiling().share(node, *p));
    let excess = Ceiling::excess(shares.fold(0.0, f64::max));
    if excess > 0.0 {
        doubts.push(SavedDoubt::AboveHardness { excess });
    }
    if let Some(prescribed) = problem.mean_pressure() {
        let carried = pressure.mean().unwrap_or(0.0) / prescribed;
        if carried.is_nan() || (carried - 1.0).abs() > SAME_LOAD {
            doubts.push(SavedDoubt::Load { carried });
        }
    }
    doubts
}

/// Whether a certificate meets the goals of a stop, but for rounding.
pub fn is_met(stop: &Stop, certificate: &Certificate) -> bool {
    let eta = certificate.eta / ROUNDED - certificate.rounding;
    let pressure_error_bound = certificate.pressure_error_bound / ROUNDED;
    stop.is_met(&Certificate { eta, pressure_error_bound, ..*certificate })
}

/// Whether lengths that were saved are those that were computed again, where lengths of the size `scale` come in.
pub fn is_same(saved: &Field, computed: &Field, scale: f64) -> bool {
    saved.iter().zip(computed).all(|(saved, computed)| (saved - computed).abs() <= SAME * scale)
}

/// The largest magnitude of a field.
pub fn largest(field: &Field) -> f64 {
    field.iter().fold(0.0, |most: f64, value| most.max(value.abs()))
}

/// A field, or another one where it has values that are not finite.
fn finite_or(field: Field, other: &Field) -> Field {
    if field.iter().all(|value| value.is_finite()) { field } else { other.clone() }
}

/// The contact on the next coarser grid, and whether it is that of a file, which is kept then.
fn compared(saved: Resolved, problem: &Problem) -> (Option<Resolved>, bool) {
    let solved = coarser(problem).and_then(|problem| {
        let stop = Stop::new(COARSE.0, COARSE.1).ok()?;
        Some(Multilevel.solve(&problem, &stop, &mut ()).ok()?.resolved())
    });
    let is_near = |a: f64, b: f64| (a - b).abs() <= SAME_COARSE * a.abs().max(b.abs()) || a.is_nan() && b.is_nan();
    match solved {
        Some(found) => {
            let is_same = is_near(saved.relative_area, found.relative_area)
                && is_near(saved.rms_gradient_contact, found.rms_gradient_contact)
                && is_near(saved.kappa_r, found.kappa_r);
            (Some(if is_same { saved } else { found }), is_same)
        }
        None => (None, false),
    }
}
