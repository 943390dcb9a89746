//! A contact of a surface from above, which the page draws without the viewer.

use super::columns::columns;
use crate::contact::{Contact, StateField, Unit};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::ops::Range;
use strum::{EnumIter, IntoStaticStr};

/// The most rows and columns of a map of a run that has ended, and of one under the hand.
const MOST: usize = 256;
const MOST_HELD: usize = 128;

/// What a map of the page shows of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, EnumIter, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum TopMap {
    /// The pressure.
    Pressure,
    /// The gap.
    Gap,
    /// The heights of the surface.
    Height,
    /// The patches.
    Patches,
    /// The flux of a fluid that leaks through the gap.
    Flux,
    /// The pressure of that fluid.
    Fluid,
    /// The traction of a contact with friction.
    Traction,
    /// Where such a contact slips.
    Slip,
    /// The attraction of surfaces that adhere.
    Attraction,
    /// The deformed surface in space.
    Solid,
}

impl TopMap {
    /// Its name on the page.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// The fields of a contact of a surface on a coarser grid. A place shows the node at which the rigid surface is highest in it, which touches
/// first and is the same node at all loads. Lengths are in metres, pressures over the contact modulus; heights are those of a
/// [`Section`](super::section::Section).
#[derive(Clone, Serialize)]
pub(crate) struct Top {
    /// Rows and columns.
    shape: [usize; 2],
    /// Lengths of the cell along y and x.
    size: [f64; 2],
    /// The rigid surface where it stands, peaks down, row by row.
    rigid: Vec<f32>,
    /// The gap.
    gap: Vec<f32>,
    /// The pressure.
    pressure: Vec<f32>,
    /// The largest pressure of all nodes.
    highest_pressure: f64,
    /// Further fields of the state by their names, such as the traction.
    fields: BTreeMap<&'static str, TopField>,
}

/// A further field of a state from above. Values that are not known are null in JSON.
#[derive(Clone, Serialize)]
struct TopField {
    /// A pressure over the contact modulus, a length in metres, or a pure number.
    unit: Unit,
    /// Its values, row by row.
    values: Vec<f32>,
}

impl Top {
    /// A contact that is at rest, with the further fields of its state; none of a line.
    pub(crate) fn from_contact(contact: &Contact, fields: &[StateField]) -> Option<Self> {
        Self::coarser(contact, fields, MOST)
    }

    /// A contact that moves under the hand; none of a line.
    pub(crate) fn of_hand(contact: &Contact, fields: &[StateField]) -> Option<Self> {
        Self::coarser(contact, fields, MOST_HELD)
    }

    fn coarser(contact: &Contact, fields: &[StateField], most: usize) -> Option<Self> {
        let grid = contact.problem.surface().grid();
        if grid.is_line() {
            return None;
        }
        let [rows, places] = grid.shape().map(|nodes| columns(nodes, most).collect::<Vec<Range<usize>>>());
        let height = contact.problem.surface().height();
        let peak = |rows: &Range<usize>, places: &Range<usize>| {
            let nodes = rows.clone().flat_map(|row| places.clone().map(move |column| [row, column]));
            nodes.max_by(|a, b| height[*a].total_cmp(&height[*b])).unwrap_or_default()
        };
        let nodes: Vec<[usize; 2]> =
            rows.iter().flat_map(|rows| places.iter().map(move |places| peak(rows, places))).collect();
        let modulus = contact.problem.contact_modulus();
        let field = |it: &StateField| {
            let row = it.kind.row();
            let unit = if row.unit == Unit::Pressure { modulus } else { 1.0 };
            let values = nodes.iter().map(|node| (it.values[*node] / unit) as f32).collect();
            (row.name, TopField { unit: row.unit, values })
        };
        let of = |value: &dyn Fn([usize; 2]) -> f64| nodes.iter().map(|node| value(*node) as f32).collect();
        Some(Self {
            shape: [rows.len(), places.len()],
            size: grid.size(),
            rigid: of(&|node| contact.gap[node] - contact.displacement[node]),
            gap: of(&|node| contact.gap[node]),
            pressure: of(&|node| contact.pressure[node] / modulus),
            highest_pressure: contact.max_pressure() / modulus,
            fields: fields.iter().filter(|it| it.is_on_surface()).map(field).collect(),
        })
    }
}
