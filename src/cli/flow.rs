//! The rows of a summary about flow through a contact: leakage and conductance.

use super::units::{Units, significant};
use asperity::contact::{Contact, Quantity, StateField};
use asperity::error::FlowError;
use asperity::flow::{FlowAxis, Leakage};
use asperity::quantity::number_in_words;
use asperity::setup::Flow;
use serde::Serialize;

/// Leakage and conductance of a contact, each where it is asked for.
#[derive(Serialize, Default)]
pub struct FlowFinding {
    /// The leakage along x and y; of a line along x only.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    along: Vec<AxisFinding>,
    /// The conductance per area, one over resistivity and length; none where it is infinite.
    #[serde(skip_serializing_if = "Option::is_none")]
    conductance_per_area: Option<f64>,
    /// The conductance per area times the sum of both resistivities, one over a length.
    #[serde(skip_serializing_if = "Option::is_none")]
    conductance_times_resistivity: Option<f64>,
    /// Whether all nodes touch, so that nothing constricts the current.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    is_unconstricted: bool,
    /// All values by their quantities.
    #[serde(skip)]
    pub numbers: Vec<(Quantity, f64)>,
    /// Flux over its mean, and pressure of the fluid, by their names in archives.
    #[serde(skip)]
    pub fields: Vec<StateField>,
}

/// The leakage through the gap along one axis, by Reynolds' equation.
#[derive(Serialize)]
struct AxisFinding {
    axis: FlowAxis,
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
    /// What is asked for, if anything is. The fields of the flow are kept for an archive only.
    pub fn new(contact: &Contact, asked: &Flow, is_archived: bool) -> Result<Option<Self>, FlowError> {
        if asked.is_none() {
            return Ok(None);
        }
        let flow = asked.measure(contact)?;
        let found = |it: &Leakage| {
            let is_x = it.axis == FlowAxis::X;
            let [open, joined] = match is_x {
                true => [Quantity::OpenPercolatesX, Quantity::ContactPercolatesX],
                false => [Quantity::OpenPercolatesY, Quantity::ContactPercolatesY],
            }
            .map(|it| flow.get(it) == Some(1.0));
            AxisFinding {
                axis: it.axis,
                open_percolates: open,
                contact_percolates: joined,
                leakage: [it.lower, it.upper],
                hydraulic_gap: it.sigma().cbrt(),
            }
        };
        let along = flow.leakages.iter().map(found).collect();
        let per_area = flow.get(Quantity::ConductancePerArea);
        let times_resistivity = flow.get(Quantity::ConductanceTimesResistivity);
        let fields = flow.leakages.into_iter().filter(|_| is_archived).flat_map(Leakage::into_fields);
        let is_finite = |it: &f64| it.is_finite();
        Ok(Some(Self {
            along,
            conductance_per_area: per_area.filter(is_finite),
            conductance_times_resistivity: times_resistivity.filter(is_finite),
            is_unconstricted: per_area.is_some_and(f64::is_infinite),
            numbers: flow.numbers,
            fields: fields.collect(),
        }))
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
                    if upper - lower > Leakage::TOLERANCE * upper { ", not converged" } else { "" }
                ),
            };
            let joined = if it.contact_percolates { "; the contact connects these sides" } else { "" };
            (format!("leaks along {}", it.axis.name()), said + joined)
        });
        let per_area = self.conductance_per_area.map(|it| match units.conductance {
            Some(unit) => format!("{} {unit}", number_in_words(it)),
            None => significant(it),
        });
        let per_area = per_area.or(self.is_unconstricted.then(|| "infinite, since all nodes touch".to_owned()));
        along.chain(per_area.map(|it| ("conductance per area".to_owned(), it))).collect()
    }
}
