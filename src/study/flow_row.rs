//! What flows through a contact, as a row of a table.

use crate::contact::Contact;
use crate::error::FlowError;
use crate::flow::{Conductance, FlowAxis, Leakage, Percolation};
use crate::setup::Flow;
use serde::{Deserialize, Serialize};

/// What flows through a contact, as far as it was asked for; all else is none. On a line, none of it is along `y`.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct FlowRow {
    /// Whether the open area connects both sides along `x`.
    pub open_percolates_x: Option<bool>,
    /// Whether it does along `y`.
    pub open_percolates_y: Option<bool>,
    /// Whether the contact connects both sides along `x`.
    pub contact_percolates_x: Option<bool>,
    /// Whether it does along `y`.
    pub contact_percolates_y: Option<bool>,
    /// Lower bound of the leakage `sigma` along `x`, a length cubed, see [`Leakage`].
    pub leakage_lower_x: Option<f64>,
    /// Upper bound of it.
    pub leakage_upper_x: Option<f64>,
    /// Lower bound of the leakage along `y`.
    pub leakage_lower_y: Option<f64>,
    /// Upper bound of it.
    pub leakage_upper_y: Option<f64>,
    /// The gap of parallel plates that leak as much along `x`, a length.
    pub hydraulic_gap_x: Option<f64>,
    /// The gap of parallel plates that leak as much along `y`.
    pub hydraulic_gap_y: Option<f64>,
    /// The conductance per area, see [`Conductance`]; infinite where all nodes touch.
    pub conductance_per_area: Option<f64>,
    /// The conductance per area times the sum of both resistivities, `2 k/E*`, one over a length.
    pub conductance_times_resistivity: Option<f64>,
}

/// A column of a table with flow: its name, and its value in a row.
pub enum FlowColumn {
    /// A number.
    Number(&'static str, fn(&FlowRow) -> Option<f64>),
    /// Whether something holds.
    Text(&'static str, fn(&FlowRow) -> Option<bool>),
}

/// The columns of a table with flow, by the names of their fields.
pub const FLOW_COLUMNS: &[FlowColumn] = &[
    FlowColumn::Text("open_percolates_x", |it| it.open_percolates_x),
    FlowColumn::Text("open_percolates_y", |it| it.open_percolates_y),
    FlowColumn::Text("contact_percolates_x", |it| it.contact_percolates_x),
    FlowColumn::Text("contact_percolates_y", |it| it.contact_percolates_y),
    FlowColumn::Number("leakage_lower_x", |it| it.leakage_lower_x),
    FlowColumn::Number("leakage_upper_x", |it| it.leakage_upper_x),
    FlowColumn::Number("leakage_lower_y", |it| it.leakage_lower_y),
    FlowColumn::Number("leakage_upper_y", |it| it.leakage_upper_y),
    FlowColumn::Number("hydraulic_gap_x", |it| it.hydraulic_gap_x),
    FlowColumn::Number("hydraulic_gap_y", |it| it.hydraulic_gap_y),
    FlowColumn::Number("conductance_per_area", |it| it.conductance_per_area),
    FlowColumn::Number("conductance_times_resistivity", |it| it.conductance_times_resistivity),
];

impl FlowRow {
    /// Finds what is asked for of a contact. Returns the leakages with their fields as well.
    ///
    /// # Errors
    /// The errors of [`Flow::resistivities`], [`Leakage::from_contact`] and [`Conductance::new`].
    pub fn measure(contact: &Contact, asked: &Flow) -> Result<(Self, Vec<Leakage>), FlowError> {
        let (mut row, mut leakages) = (Self::default(), Vec::new());
        if let Some([first, second]) = asked.resistivities()? {
            let Conductance { per_area, .. } = Conductance::new(contact, [first, second])?;
            row.conductance_per_area = Some(per_area);
            row.conductance_times_resistivity = Some(per_area * (first + second));
        }
        if asked.leakage {
            let is_line = contact.problem.surface().grid().is_line();
            let percolation = Percolation::from_contact(contact);
            for axis in FlowAxis::ALL.into_iter().take(if is_line { 1 } else { 2 }) {
                let leakage = Leakage::from_contact(contact, axis, Leakage::TOLERANCE)?;
                row.lay(&percolation, &leakage);
                leakages.push(leakage);
            }
        }
        Ok((row, leakages))
    }

    /// Sets the values along the axis of a leakage.
    fn lay(&mut self, percolation: &Percolation, leakage: &Leakage) {
        let (open, contact, lower, upper, gap) = match leakage.axis {
            FlowAxis::X => (
                &mut self.open_percolates_x,
                &mut self.contact_percolates_x,
                &mut self.leakage_lower_x,
                &mut self.leakage_upper_x,
                &mut self.hydraulic_gap_x,
            ),
            FlowAxis::Y => (
                &mut self.open_percolates_y,
                &mut self.contact_percolates_y,
                &mut self.leakage_lower_y,
                &mut self.leakage_upper_y,
                &mut self.hydraulic_gap_y,
            ),
        };
        *open = Some(percolation.open_percolates(leakage.axis));
        *contact = Some(percolation.contact_percolates(leakage.axis));
        (*lower, *upper, *gap) = (Some(leakage.lower), Some(leakage.upper), Some(leakage.sigma().cbrt()));
    }

    /// Whether anything was asked for.
    pub fn is_some(&self) -> bool {
        self.open_percolates_x.is_some() || self.conductance_per_area.is_some()
    }
}
