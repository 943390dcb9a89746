//! The rows of a summary about flow through a contact: leakage and conductance.

use super::output::{TextRow, row};
use super::units::{Units, significant};
use asperity::contact::Quantity;
use asperity::flow::FlowAxis;
use asperity::quantity::number_in_words;
use asperity::setup::AxisFlow;
use serde::Serialize;

/// Leakage and conductance of a contact, each where it is asked for.
#[derive(Serialize, Default)]
pub(crate) struct FlowFinding {
    /// The leakage along x and y; of a line along x only.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    along: Vec<AxisFlow>,
    /// The conductance per area, one over resistivity and length; none where it is infinite.
    #[serde(skip_serializing_if = "Option::is_none")]
    conductance_per_area: Option<f64>,
    /// The conductance per area times the sum of both resistivities, one over a length.
    #[serde(skip_serializing_if = "Option::is_none")]
    conductance_times_resistivity: Option<f64>,
    /// Whether all nodes touch, so that nothing constricts the current.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    is_unconstricted: bool,
}

impl FlowFinding {
    /// The flow through the gap, from the quantities of a state; none where the flow was not asked for.
    pub(crate) fn from_numbers(numbers: &[(Quantity, f64)]) -> Option<Self> {
        let get = |quantity: Quantity| numbers.iter().find(|(other, _)| *other == quantity).map(|(_, value)| *value);
        let along: Vec<AxisFlow> = FlowAxis::ALL.into_iter().filter_map(|axis| AxisFlow::find(axis, get)).collect();
        let conductance = get(Quantity::ConductancePerArea);
        if along.is_empty() && conductance.is_none() {
            return None;
        }
        // JSON has no infinity, so that full contact has a flag in place of a number
        let finite = |value: Option<f64>| value.filter(|value| value.is_finite());
        Some(Self {
            along,
            conductance_per_area: finite(conductance),
            conductance_times_resistivity: finite(get(Quantity::ConductanceTimesResistivity)),
            is_unconstricted: conductance.is_some_and(f64::is_infinite),
        })
    }

    /// Names and values for reading.
    pub(crate) fn rows(&self, units: Units) -> Vec<TextRow> {
        let mut rows = Vec::new();
        for flow in &self.along {
            let mut words = leakage(flow, units);
            if flow.contact_percolates {
                words += "; the contact connects these sides";
            }
            rows.push(row(&format!("leaks along {}", flow.axis.name()), words));
        }
        if let Some(conductance) = self.conductance_per_area {
            let words = match units.conductance {
                Some(unit) => format!("{} {unit}", number_in_words(conductance)),
                None => significant(conductance),
            };
            rows.push(row("conductance per area", words));
        } else if self.is_unconstricted {
            rows.push(row("conductance per area", "infinite, since all nodes touch"));
        }
        rows
    }
}

/// How much leaks along an axis, as the distance of two parallel plates that leak as much.
fn leakage(flow: &AxisFlow, units: Units) -> String {
    match flow.leakage {
        [_, 0.0] => "nothing, the contact seals".to_owned(),
        [lower, upper] if flow.is_unknown() => {
            // the flow between plates grows with the cube of their distance
            let [least, most] = [lower, upper].map(|leakage| units.length(leakage.cbrt()));
            format!("not known: as between plates {least} to {most} apart")
        }
        [lower, upper] => {
            let distance = units.length(flow.hydraulic_gap);
            format!("as between plates {distance} apart (bounds within {:.0e})", (upper - lower) / upper)
        }
    }
}
