//! A contact of a surface from above, which the page draws without the viewer.

use super::section::columns;
use crate::contact::Contact;
use serde::Serialize;
use std::ops::Range;

/// The most rows and columns of a map of a run that has ended, and of one under the hand.
const MOST: usize = 256;
const MOST_HELD: usize = 128;

/// The fields of a contact of a surface on a coarser grid. A place shows the node at which the rigid surface is highest in it, which touches
/// first and is the same node at all loads. Lengths are in metres, pressures over the contact modulus; heights are those of a
/// [`Section`](super::section::Section).
#[derive(Clone, Serialize)]
pub struct Top {
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
}

impl Top {
    /// A contact that is at rest; none of a line.
    pub fn from_contact(contact: &Contact) -> Option<Self> {
        Self::coarser(contact, MOST)
    }

    /// A contact that moves under the hand; none of a line.
    pub fn of_hand(contact: &Contact) -> Option<Self> {
        Self::coarser(contact, MOST_HELD)
    }

    fn coarser(contact: &Contact, most: usize) -> Option<Self> {
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
        let of = |value: &dyn Fn([usize; 2]) -> f64| nodes.iter().map(|node| value(*node) as f32).collect();
        Some(Self {
            shape: [rows.len(), places.len()],
            size: grid.size(),
            rigid: of(&|node| contact.gap[node] - contact.displacement[node]),
            gap: of(&|node| contact.gap[node]),
            pressure: of(&|node| contact.pressure[node] / modulus),
            highest_pressure: contact.max_pressure() / modulus,
        })
    }
}
