//! The leakage through a contact, which the page shows from above.

use super::columns::columns;
use crate::contact::Contact;
use crate::flow::{Conductance, FlowAxis, Leakage};
use crate::surface::Field;
use serde::Serialize;
use std::ops::Range;

/// The name of the [`conductance`] among the numbers of the page.
pub(crate) const CONDUCTANCE: &str = "conductance";

/// The most rows and columns of a map of the flux.
const MOST: usize = 256;

/// The leakage of a contact of a surface along both axes.
#[derive(Serialize)]
pub(crate) struct Leak {
    /// The leakage along x and along y.
    axes: [LeakAlong; 2],
}

/// The leakage along an axis.
#[derive(Serialize)]
struct LeakAlong {
    /// The gap of parallel plates that leak as much, in metres; 0 where the contact seals.
    hydraulic_gap: f64,
    /// Rows and columns of the maps.
    shape: [usize; 2],
    /// The flux over its mean, row by row: the largest one at each place.
    flux: Vec<f32>,
    /// The pressure of the fluid over its drop; null where nothing flows.
    fluid: Vec<f32>,
}

impl Leak {
    /// The flow through a contact; none of a line.
    pub(crate) fn through(contact: &Contact) -> Option<Self> {
        if contact.problem.surface().grid().is_line() {
            return None;
        }
        let along = Leakage::along(contact, &[FlowAxis::X, FlowAxis::Y], Leakage::TOLERANCE).ok()?;
        Some(Self { axes: [LeakAlong::new(&along[0]), LeakAlong::new(&along[1])] })
    }
}

/// The conductance per area between two bodies, times the sum of their resistivities and the length of the cell: that of the contact over
/// that of the bodies, if each is as thick as the cell is long. None of a layer, and of a contact that slides.
pub(crate) fn conductance(contact: &Contact) -> Option<f64> {
    let length = contact.problem.surface().grid().size()[1];
    Conductance::new(contact, [1.0, 0.0]).ok().map(|it| it.per_area * length)
}

impl LeakAlong {
    fn new(leakage: &Leakage) -> Self {
        let (rows, places) = leakage.flux.dim();
        let [rows, places] = [rows, places].map(|nodes| columns(nodes, MOST).collect::<Vec<Range<usize>>>());
        // the widest channel of a place is a channel of the map
        let most = |field: &Field| -> Vec<f32> {
            let place = |row: &Range<usize>, place: &Range<usize>| {
                let nodes = row.clone().flat_map(|row| place.clone().map(move |column| [row, column]));
                nodes.map(|node| field[node] as f32).fold(f32::NAN, f32::max)
            };
            rows.iter().flat_map(|row| places.iter().map(move |it| place(row, it))).collect()
        };
        Self {
            hydraulic_gap: leakage.sigma().cbrt(),
            shape: [rows.len(), places.len()],
            flux: most(&leakage.flux),
            fluid: most(&leakage.pressure),
        }
    }
}
