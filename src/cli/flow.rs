//! The rows of a summary about flow through a contact: leakage and conductance.

use super::units::{Units, significant};
use anyhow::Result;
use asperity::contact::Contact;
use asperity::flow::{Conductance, FlowAxis, Leakage, Percolation};
use serde::Serialize;

/// The goal for the relative distance of the bounds of a leakage.
const TOLERANCE: f64 = 1e-6;

/// Leakage and conductance of a contact, each where its flag is given.
#[derive(Serialize, Default)]
pub struct FlowFinding {
    /// The leakage along x and y; of a line along x only.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    along: Vec<AxisFinding>,
    /// The conductance per area, one over resistivity and length; none where it is infinite.
    #[serde(skip_serializing_if = "Option::is_none")]
    conductance_per_area: Option<f64>,
    /// Whether all nodes touch, so that nothing constricts the current.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    is_unconstricted: bool,
}

/// The leakage through the gap along one axis, by Reynolds' equation.
#[derive(Serialize)]
struct AxisFinding {
    axis: &'static str,
    /// Whether the open area connects both sides.
    open_percolates: bool,
    /// Whether the contact connects both sides.
    contact_percolates: bool,
    /// Bounds of the cube of the gap of parallel plates that leak as much, a length cubed.
    leakage: [f64; 2],
    /// The gap of these plates, a length.
    hydraulic_gap: f64,
}

impl FlowFinding {
    /// What is asked for: the leakage, and the conductance between bodies of some resistivities.
    pub fn new(contact: &Contact, leaks: bool, resistivities: Option<[f64; 2]>) -> Result<Self> {
        let is_line = contact.problem.surface().grid().is_line();
        let axes: &[FlowAxis] = if is_line { &[FlowAxis::X] } else { &[FlowAxis::X, FlowAxis::Y] };
        let percolation = leaks.then(|| Percolation::from_contact(contact));
        let along =
            percolation.map_or(Ok(Vec::new()), |it| axes.iter().map(|&axis| leak(contact, &it, axis)).collect());
        let conductance = resistivities.map(|it| Conductance::new(contact, it)).transpose()?.map(|it| it.per_area);
        Ok(Self {
            along: along?,
            conductance_per_area: conductance.filter(|it| it.is_finite()),
            is_unconstricted: conductance.is_some_and(f64::is_infinite),
        })
    }

    /// Names and values for reading.
    pub fn rows(&self, units: Units) -> Vec<(String, String)> {
        let along = self.along.iter().map(|it| {
            let said = match it.leakage {
                [_, 0.0] => "nothing, the contact seals".to_owned(),
                [lower, upper] => format!(
                    "as between plates {} apart (bounds within {:.0e}{})",
                    units.length(it.hydraulic_gap),
                    (upper - lower) / upper,
                    if upper - lower > TOLERANCE * upper { ", not converged" } else { "" }
                ),
            };
            let joined = if it.contact_percolates { "; the contact reaches from side to side" } else { "" };
            (format!("leaks along {}", it.axis), said + joined)
        });
        let per_area = self.conductance_per_area.map(significant);
        let per_area = per_area.or(self.is_unconstricted.then(|| "infinite, since all nodes touch".to_owned()));
        along.chain(per_area.map(|it| ("conductance per area".to_owned(), it))).collect()
    }
}

fn leak(contact: &Contact, percolation: &Percolation, axis: FlowAxis) -> Result<AxisFinding> {
    let leakage = Leakage::from_contact(contact, axis, TOLERANCE)?;
    Ok(AxisFinding {
        axis: match axis {
            FlowAxis::X => "x",
            FlowAxis::Y => "y",
        },
        open_percolates: percolation.open_percolates(axis),
        contact_percolates: percolation.contact_percolates(axis),
        leakage: [leakage.lower, leakage.upper],
        hydraulic_gap: leakage.sigma().cbrt(),
    })
}
