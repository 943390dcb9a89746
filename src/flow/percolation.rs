//! Whether a contact seals.

use super::FlowAxis;
use crate::contact::Contact;
use crate::error::FlowError;
use crate::forest::Forest;
use crate::grid::Grid;
use ndarray::Array2;

/// Steps to the nodes that share a side with a node, in one sense.
const SIDES: [[isize; 2]; 2] = [[0, 1], [1, 0]];
/// Steps to the nodes that share a side or a corner with a node, in one sense.
const SIDES_AND_CORNERS: [[isize; 2]; 4] = [[0, 1], [1, 0], [1, 1], [1, -1]];

/// Whether the open area and the contact reach from side to side of the cell, along `x` and along `y`.
///
/// A set of nodes percolates along an axis if it connects the first row or column with the last one. Nodes of the open area are
/// connected if they share a side (4 neighbours), and those of the contact if they share a side or a corner (8 neighbours): then two
/// diagonals do not cross. The sides between which it percolates are not joined, also where the cell is periodic. *Across* this
/// axis the cell is as its grid is, periodic or free.
///
/// Where the open area does not percolate along `x`, the contact seals against flow along `x`, and percolates along `y`. On a grid that is
/// free along both axes exactly one of the two percolates. On a periodic one both may: a contact that is shifted from one period to the
/// next does not close up, and leaves a channel open that winds. So on periodic grids, ask the open area whether a contact seals.
///
/// On a line, a single node in contact seals along `x`.
///
/// The mask is that of nodes with a pressure. It is larger than the contact by about 0.19 spacings along its edges. With 256 points a side, a roll-off of an eighth of the cell and a
/// cut-off of 8 spacings, the counted area of a contact that just seals is 0.015 to 0.02 above the [resolved](Contact::resolved) one.
///
/// ```
/// use asperity::Grid;
/// use asperity::flow::{FlowAxis, Percolation};
/// use ndarray::array;
/// let grid = Grid::surface([4, 4], [1.0, 1.0])?.with_periodic([false, false]);
/// // a diagonal of contact: its corners are connected, and those of the open area are not
/// let touches = ndarray::Array2::from_shape_fn((4, 4), |(y, x)| y == x);
/// let percolation = Percolation::new(&grid, &touches)?;
/// assert!(percolation.contact_percolates(FlowAxis::X) && percolation.contact_percolates(FlowAxis::Y));
/// assert!(!percolation.open_percolates(FlowAxis::X) && !percolation.open_percolates(FlowAxis::Y));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Percolation {
    open: [bool; 2],
    contact: [bool; 2],
}

impl Percolation {
    /// The percolation of a mask of shape `(ny, nx)` that is true where the surfaces touch.
    ///
    /// # Errors
    /// [`FlowError::Shape`] for a mask that does not fit the grid.
    pub fn new(grid: &Grid, touches: &Array2<bool>) -> Result<Self, FlowError> {
        if touches.shape() != grid.shape() {
            return Err(FlowError::Shape { found: touches.shape().to_vec(), expected: grid.shape() });
        }
        let touches: Vec<bool> = touches.iter().copied().collect();
        let opens: Vec<bool> = touches.iter().map(|touches| !touches).collect();
        // in the order [y, x]
        let axes = [FlowAxis::Y, FlowAxis::X];
        let open = axes.map(|axis| percolates(&axis.cut(grid), axis, &opens, &SIDES));
        let contact = axes.map(|axis| percolates(&axis.cut(grid), axis, &touches, &SIDES_AND_CORNERS));
        Ok(Self { open, contact })
    }

    /// The percolation of a contact: nodes touch if they have a pressure.
    pub fn from_contact(contact: &Contact) -> Self {
        let grid = contact.problem.surface().grid();
        Self::new(grid, &contact.mask()).expect("a contact has one pressure per node")
    }

    /// Whether the open area connects the two sides along an axis. If not, the contact seals.
    pub fn open_percolates(&self, axis: FlowAxis) -> bool {
        self.open[axis.index()]
    }

    /// Whether the contact connects the two sides along an axis.
    pub fn contact_percolates(&self, axis: FlowAxis) -> bool {
        self.contact[axis.index()]
    }
}

/// Whether the nodes that `belong` connect the sides of the grid, which is free along the axis.
fn percolates(grid: &Grid, axis: FlowAxis, belong: &[bool], steps: &[[isize; 2]]) -> bool {
    let sides = [grid.len(), grid.len() + 1];
    let mut forest = Forest::new(grid.len() + 2);
    for node in (0..grid.len()).filter(|&node| belong[node]) {
        // beyond a free rim, this is the node itself or one that shares a side
        for other in steps.iter().map(|&step| grid.neighbour(node, step)).filter(|&other| belong[other]) {
            forest.join(node, other);
        }
        for (side, _) in sides.into_iter().zip(axis.sides(grid, node)).filter(|(_, is_there)| *is_there) {
            forest.join(node, side);
        }
    }
    forest.root(sides[0]) == forest.root(sides[1])
}
