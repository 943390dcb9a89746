//! The rows of a summary about flow through a contact: leakage and conductance.

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
        let is_finite = |it: &f64| it.is_finite();
        let per_area = get(Quantity::ConductancePerArea);
        let along: Vec<AxisFlow> = FlowAxis::ALL.into_iter().filter_map(|axis| AxisFlow::find(axis, get)).collect();
        (!along.is_empty() || per_area.is_some()).then(|| Self {
            along,
            conductance_per_area: per_area.filter(is_finite),
            conductance_times_resistivity: get(Quantity::ConductanceTimesResistivity).filter(is_finite),
            is_unconstricted: per_area.is_some_and(f64::is_infinite),
        })
    }

    /// Names and values for reading.
    pub(crate) fn rows(&self, units: Units) -> Vec<(String, String)> {
        let along = self.along.iter().map(|it| {
            let said = match it.leakage {
                [_, 0.0] => "nothing, the contact seals".to_owned(),
                [lower, upper] if it.is_unknown() => {
                    let [least, most] = [lower, upper].map(|cube| units.length(cube.cbrt()));
                    format!("not known: as between plates {least} to {most} apart")
                }
                [lower, upper] => format!(
                    "as between plates {} apart (bounds within {:.0e})",
                    units.length(it.hydraulic_gap),
                    (upper - lower) / upper,
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
