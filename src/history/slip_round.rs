//! One round of a step with friction: a pressure, and the traction under it.

use super::discs::{Pair, add, length};
use super::slip_state::{SlipCertificate, SlipState, Zone};
use super::slip_traction::{Traction, at, certify, length_at, sliding_length};
use crate::chunks;
use crate::contact::{Contact, ResultClaim, Work};
use crate::surface::Field;
use ndarray::Array2;

/// The energy that a node loses which leaves the contact in a step, over its limit of friction before times its slip: its pressure falls to zero
/// steadily, which gives a half, and on average it leaves in the middle of the step, which gives another one.
const LEAVING: f64 = 0.25;

/// What one step finds, before it is a state.
pub(super) struct SlipRound {
    pub contact: Contact,
    /// `A_t p` along `x`.
    pub pressed: Vec<f64>,
    /// `w_0`: the slip is the displacement by the traction less this and the shift.
    pub before: [Vec<f64>; 2],
    /// By how much nodes that do not touch move relative to the rigid surface as their gap changes, where that is known.
    pub rate: Option<Pair>,
    pub found: Traction,
    pub target: Pair,
    pub work: Work,
}

/// The traction that a round asks for.
pub(super) struct SlipTask<'a> {
    pub contact: &'a Contact,
    pub pressed: &'a [f64],
    /// The mean traction along `x` and `y`.
    pub target: Pair,
    /// `w_0` less the displacement before the step: what moves nodes besides the traction.
    pub moved: &'a [Vec<f64>; 2],
    /// The traction that the search starts from.
    pub start: &'a [Vec<f64>; 2],
    /// Whether the pressure displaces the surface along `x` as well.
    pub is_coupled: bool,
}

impl SlipRound {
    /// The slip along `x` and `y`.
    fn slip(&self) -> [Vec<f64>; 2] {
        [0, 1].map(|axis| {
            let both = self.found.displacement[axis].iter().zip(&self.before[axis]);
            both.map(|(now, before)| now - before - self.found.shift[axis]).collect()
        })
    }

    /// The error of the traction, for the pressure as it is.
    pub(crate) fn certificate(&self, mu: f64) -> SlipCertificate {
        certify(mu, values(&self.contact.pressure), &self.found, &self.slip(), &self.pressed)
    }

    /// The state at the end of some rounds.
    pub(crate) fn state(
        &self,
        mu: f64,
        earlier: Option<&Contact>,
        claim: ResultClaim,
        (rounds, work): (usize, Work),
    ) -> SlipState {
        let Self { contact, pressed, found, target, .. } = self;
        let (shape, p) = (contact.pressure.raw_dim(), values(&contact.pressure));
        let n = p.len();
        let mut slip = self.slip();
        let certificate = certify(mu, p, found, &slip, pressed);
        let reach = sliding_length(mu, pressed);
        let zone = |i: usize| match mu * p[i] {
            _ if p[i] <= 0.0 => Zone::Open,
            limit if !found.slips(i, limit, at(&slip, i), reach) => Zone::Stick,
            _ if found.values[0][i] >= 0.0 => Zone::Forward,
            _ => Zone::Backward,
        };
        let zones: Vec<Zone> = (0..n).map(zone).collect();
        let is_still = |zone: Zone| matches!(zone, Zone::Open | Zone::Stick);
        let earlier = earlier.map(|contact| values(&contact.pressure));
        let gap = values(&contact.gap);
        let dissipated = |i: usize| match (zones[i], earlier) {
            // a node that leaves the contact has slipped on about half of the way, and then moves with its gap
            (Zone::Open, Some(earlier)) if earlier[i] > 0.0 => {
                self.rate.map_or(0.0, |rate| LEAVING * mu * earlier[i] * length(add(at(&slip, i), -gap[i], rate)))
            }
            (zone, _) if is_still(zone) => 0.0,
            _ => 0.5 * mu * (p[i] + earlier.map_or(p[i], |earlier| earlier[i])) * length_at(&slip, i),
        };
        let dissipated = chunks::sum(n, dissipated) / n as f64;
        let work_at = |i: usize| {
            let ([a, b], [u, v]) = (at(&found.values, i), at(&found.displacement, i));
            a * u + b * v
        };
        let stored = 0.5 * chunks::sum(n, work_at) / n as f64;
        for slip in &mut slip {
            slip.iter_mut().zip(&zones).filter(|(_, zone)| **zone == Zone::Stick).for_each(|(slip, _)| *slip = 0.0);
        }
        let field = |values: Vec<f64>| Field::from_shape_vec(shape, values).expect("one value per node");
        let across = |values: Vec<f64>| (!values.is_empty()).then(|| field(values));
        let [along_x, along_y] = slip;
        SlipState {
            tangential: target[0],
            tangential_across: target[1],
            traction: field(found.values[0].clone()),
            traction_across: across(found.values[1].clone()),
            slip: field(along_x),
            slip_across: across(along_y),
            zones: Array2::from_shape_vec(shape, zones).expect("one zone per node"),
            shift: found.shift[0],
            shift_across: found.shift[1],
            dissipated,
            stored,
            certificate,
            pressure_certificate: contact.certificate.eta,
            rounds,
            claim,
            work,
            contact: contact.clone(),
        }
    }
}

pub(super) fn values(field: &Field) -> &[f64] {
    field.as_slice().expect("results are made in standard layout")
}
