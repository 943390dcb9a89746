//! What is wrong with a result, and where.

use super::claim::Claim;
use super::fault::load_error;
use super::tension::Tension;
use crate::contact::{Certificate, Contact, Stop, contact_reach, error_density};
use crate::error::ProblemError;
use serde::Serialize;

/// The errors of a claim and their places, in addition to the certificate of its contact.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Assessment {
    /// The certificate of its pressure as it is, under the load that it carries: infinite with any tension.
    pub given: Certificate,
    /// Relative error of the prescribed load; 0 at a mean gap, whose error the certificate contains.
    pub load_error: f64,
    /// Negative pressures.
    pub tension: Tension,
    /// The node with the largest share in the error of energy, and that share.
    pub densest: Spot,
    /// The node that penetrates most, and how deep over the rms height.
    pub deepest: Spot,
    /// Nodes in contact by their pressure.
    pub pressed: usize,
    /// Nodes in contact by their gap, see [`contact_reach`].
    pub closed: usize,
    /// Nodes that are in contact by their pressure but not by their gap, and the one with the largest gap.
    pub apart: Disagreement,
    /// Nodes that penetrate without pressure, and the deepest of them.
    pub unpressed: Disagreement,
}

/// A node, counted row by row, and a number of it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spot {
    /// The node.
    pub node: usize,
    /// The number.
    pub value: f64,
}

/// Nodes in one contact and not in the other.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Disagreement {
    /// How many they are.
    pub nodes: usize,
    /// The worst of them, and its gap divided by the rms height; none if there is no such node.
    pub worst: Option<Spot>,
}

impl Assessment {
    /// The assessment of a claim and the contact that a [`super::Replay`] makes of it.
    ///
    /// # Errors
    /// The errors of [`Claim::problem`].
    pub fn new(claim: &Claim, contact: &Contact) -> Result<Self, ProblemError> {
        let state = claim.state()?;
        let pressure = contact.pressure.as_slice().unwrap_or_default();
        let gap = &open_gap(contact);
        let over_rms = |node: usize| Spot { node, value: gap[node] / contact.problem.rms_height() };
        let nodes = || 0..gap.len();
        let deepest = nodes().min_by(|&a, &b| gap[a].total_cmp(&gap[b])).unwrap_or_default();
        let reach = contact_reach(gap);
        let disagreement = |is_in: &dyn Fn(usize) -> bool| Disagreement {
            nodes: nodes().filter(|&node| is_in(node)).count(),
            worst: nodes()
                .filter(|&node| is_in(node))
                .max_by(|&a, &b| gap[a].abs().total_cmp(&gap[b].abs()))
                .map(over_rms),
        };
        let density = error_density(pressure, gap);
        let densest = nodes().max_by(|&a, &b| density[a].total_cmp(&density[b])).unwrap_or_default();
        Ok(Self {
            given: state.certificate(),
            load_error: load_error(&state),
            tension: Tension::new(&state.pressure),
            densest: Spot { node: densest, value: density[densest] / density.iter().sum::<f64>() },
            deepest: Spot { node: deepest, value: -over_rms(deepest).value },
            pressed: nodes().filter(|&node| pressure[node] > 0.0).count(),
            closed: nodes().filter(|&node| gap[node] <= reach).count(),
            apart: disagreement(&|node| pressure[node] > 0.0 && gap[node] > reach),
            unpressed: disagreement(&|node| pressure[node] <= 0.0 && gap[node] < 0.0),
        })
    }

    /// Whether the claim holds: its contact meets the goals of `stop`, and the errors of load and tension, which are of
    /// first order, are at most the square root of its tolerance.
    pub fn holds(&self, contact: &Contact, stop: &Stop) -> bool {
        let first_order = stop.gap_tolerance();
        stop.is_met(&contact.certificate) && self.load_error <= first_order && self.tension.share <= first_order
    }
}

/// The gap of a contact, 0 where the surfaces overlap at the hardness: they may do so, as the solid is indented there.
fn open_gap(contact: &Contact) -> Vec<f64> {
    let law = contact.problem.law();
    let nodes = contact.pressure.iter().zip(&contact.gap);
    nodes.map(|(pressure, gap)| if law.yields(*pressure) { gap.max(0.0) } else { *gap }).collect()
}
