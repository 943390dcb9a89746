//! The flow of a thin film through a gap.

use super::FlowAxis;
use super::balance::Balance;
use super::cycle::{Gradients, GroupCycle, GroupSize};
use super::network::Network;
use super::tree::ChannelTree;
use crate::chunks;
use crate::contact::{Contact, FieldKind, StateField};
use crate::error::FlowError;
use crate::grid::Grid;
use crate::surface::Field;
use std::sync::atomic::{AtomicBool, Ordering};

/// Largest number of steps of conjugate gradients.
const MOST_STEPS: usize = 500;
/// Groups become small where a step gains more than this part of what the one before it gained, but not in the first steps, with which
/// the flow finds its channels.
const SLOW: f64 = 0.4;
const FIRST_STEPS: usize = 6;
/// The relative gain of a step at which bounds are first computed, in parts of the tolerance.
const FIRST_GOAL: f64 = 0.1;
/// Bounds that are too far from each other are computed again at this part of the gain that would do if their distance fell as the gain does.
const NEXT_GOAL: f64 = 0.5;
/// Smallest tolerance: sums over all faces err by rounding.
const SMALLEST_TOLERANCE: f64 = 1e-12;
/// Nodes up to which both axes are solved at the same time: with more of them, their memory counts.
const TOGETHER: usize = 1 << 22;

/// The flow of a fluid through the gap of a contact, with bounds of it.
///
/// A thin film of viscosity `eta` flows by Reynolds' equation, without inertia and with the surfaces at rest:
///
/// ```text
/// J = -g^3/(12 eta) grad P     div J = 0     <J> = -sigma/(12 eta) dP/L
/// ```
///
/// with the gap `g`, a length, the pressure `P` of the fluid, and `J`, the volume per time and width. The pressure falls by `dP` from one side
/// of the cell to the other over its length `L`, along one axis. Across it, the cell is periodic or has tight walls, as its
/// grid has. The result is `sigma`, a length cubed: the cube of the gap of parallel plates that leak as much.
/// The solid does not feel the pressure of the fluid.
///
/// # Discretisation
/// Nodes are centres of cells. A face between cells of `k = g^3` conducts with the harmonic mean of both, and sides lie half
/// a spacing from the first and last nodes. Nodes in contact carry nothing. Cells that are not connected
/// to both sides are left out; where none is left, the contact seals, and `sigma` is exactly zero. That is so if the open area does not
/// [percolate](crate::flow::Percolation).
///
/// # Bounds
/// Both hold for the discrete equation, except for rounding.
/// - From above, by any pressure that is 1 at the inlet and 0 at the outlet: its power `sum c (P_i - P_j)^2` over the faces of conductance `c` is
///   at least that of the solution, which is the flow (Dirichlet).
/// - From below, by any flow `J` that is conserved in each cell, with the total `Q`: its power `sum J^2/c` is at least
///   `Q^2` over that flow (Thomson). The flow of an approximate pressure is not quite conserved. What is missing in each cell is sent to the sides along
///   a tree of the widest channels, and the flow is conserved then. The power of this correction grows with the square of the residual,
///   so the bound closes with the error.
///
/// The first pressure falls linearly, and steps do not raise its power. So the upper bound is at most `<g^3>`.
///
/// # Solver
/// Conjugate gradients, preconditioned by multigrid on groups of cells, until the bounds are close. It uses 200 to 250 bytes a node and axis.
///
/// # Source
/// Dapp, Luecke, Persson & Mueser, Phys. Rev. Lett. 108, 244301 (2012), for the leakage of rough contacts.
///
/// ```
/// use asperity::Grid;
/// use asperity::flow::{FlowAxis, Leakage};
/// use std::f64::consts::TAU;
/// let grid = Grid::surface([64, 64], [1.0, 1.0])?;
/// let gap = ndarray::Array2::from_shape_fn((64, 64), |(_, x)| 1.0 + 0.6 * (TAU * x as f64 / 64.0).cos());
/// // across the waves: (1 - e^2)^(5/2) / (1 + e^2/2), along them: 1 + 3/2 e^2
/// for (axis, exact) in [(FlowAxis::X, 0.8f64.powi(5) / 1.18), (FlowAxis::Y, 1.54)] {
///     let leakage = Leakage::new(&grid, &gap, axis, 1e-9)?.converged()?;
///     assert!((leakage.sigma() / exact - 1.0).abs() < 2e-9);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Leakage {
    /// The axis of the flow.
    pub axis: FlowAxis,
    /// `sigma` is at least this, a length cubed.
    pub lower: f64,
    /// `sigma` is at most this, a length cubed.
    pub upper: f64,
    /// The goal: the largest relative distance of the bounds.
    pub tolerance: f64,
    /// Steps of the solver.
    pub steps: usize,
    /// The pressure of the fluid over its drop, from 1 at the inlet to 0 at the outlet, shape `(ny, nx)`; NaN in nodes through which
    /// nothing flows.
    pub pressure: Field,
    /// The magnitude of the flux `|J|` over its mean `<J>`, shape `(ny, nx)`. It is large where all of the fluid passes a
    /// constriction, and zero in nodes through which nothing flows.
    pub flux: Field,
}

impl Leakage {
    /// A tolerance that suits most: with it, four digits of the hydraulic gap `sigma^(1/3)` are certain.
    pub const TOLERANCE: f64 = 1e-4;

    /// The flux and the pressure of the fluid as fields of a state.
    pub fn into_fields(self) -> [StateField; 2] {
        let [flux, pressure] = match self.axis {
            FlowAxis::X => [FieldKind::FluxX, FieldKind::FluidPressureX],
            FlowAxis::Y => [FieldKind::FluxY, FieldKind::FluidPressureY],
        };
        [StateField::new(flux, self.flux), StateField::new(pressure, self.pressure)]
    }

    /// The flow through gaps of shape `(ny, nx)`, along an axis, until the bounds are closer than the relative `tolerance`. Gaps of zero and
    /// below carry nothing.
    ///
    /// # Errors
    /// [`FlowError::Shape`] and [`FlowError::Gap`] for gaps that do not fit the grid or are not finite, [`FlowError::Tolerance`] for a tolerance
    /// below 1e-12 or from 1 on, and [`FlowError::TooLarge`] for 4e9 cells.
    pub fn new(grid: &Grid, gap: &Field, axis: FlowAxis, tolerance: f64) -> Result<Self, FlowError> {
        Self::until(grid, gap, (axis, tolerance), &AtomicBool::new(false))
    }

    /// The same, or what is known of it when `ended` becomes true: then the bounds are wide.
    fn until(
        grid: &Grid,
        gap: &Field,
        (axis, tolerance): (FlowAxis, f64),
        ended: &AtomicBool,
    ) -> Result<Self, FlowError> {
        if gap.shape() != grid.shape() {
            return Err(FlowError::Shape { found: gap.shape().to_vec(), expected: grid.shape() });
        }
        if !(SMALLEST_TOLERANCE..1.0).contains(&tolerance) {
            return Err(FlowError::Tolerance { value: tolerance });
        }
        // a face has a number as well, and each cell has two, besides those at the sides
        if grid.len() >= u32::MAX as usize / 4 {
            return Err(FlowError::TooLarge { cells: grid.len() });
        }
        if let Some(((y, x), &value)) = gap.indexed_iter().find(|(_, value)| !value.is_finite()) {
            return Err(FlowError::Gap { index: [y, x], value });
        }
        Ok(solve(grid, gap, (axis, tolerance), ended))
    }

    /// The flow through the gap of a contact, see [`Leakage::new`]. Nodes with a pressure carry nothing.
    ///
    /// # Errors
    /// The errors of [`Leakage::new`].
    pub fn from_contact(contact: &Contact, axis: FlowAxis, tolerance: f64) -> Result<Self, FlowError> {
        Self::new(contact.problem.surface().grid(), &open_gap(contact), axis, tolerance)
    }

    /// The flow through the gap of a contact along each of some axes, see [`Leakage::from_contact`]. The solver of one axis works on one thread. Up to
    /// 4 million nodes, both axes are solved at the same time, which takes twice the memory.
    ///
    /// # Errors
    /// The errors of [`Leakage::new`].
    pub fn along(contact: &Contact, axes: &[FlowAxis], tolerance: f64) -> Result<Vec<Self>, FlowError> {
        Self::along_until(contact, axes, tolerance, &AtomicBool::new(false))
    }

    /// The same as [`Leakage::along`], or what is known of it when `ended` becomes true: then the bounds are wide.
    ///
    /// # Errors
    /// The errors of [`Leakage::new`].
    pub(crate) fn along_until(
        contact: &Contact,
        axes: &[FlowAxis],
        tolerance: f64,
        ended: &AtomicBool,
    ) -> Result<Vec<Self>, FlowError> {
        let (grid, gap) = (contact.problem.surface().grid(), open_gap(contact));
        let solve = |axis: &FlowAxis| Self::until(grid, &gap, (*axis, tolerance), ended);
        match Self::together(contact.problem.surface().grid()) {
            1 => axes.iter().map(solve).collect(),
            _ => chunks::spread(axes.iter(), solve).into_iter().collect(),
        }
    }

    /// The number of axes that [`Leakage::along`] solves at the same time.
    pub(crate) fn together(grid: &Grid) -> usize {
        if grid.len() <= TOGETHER && !grid.is_line() {
            rayon::current_num_threads().min(FlowAxis::ALL.len())
        } else {
            1
        }
    }

    /// The upper bound, a length cubed. It is closer to the solution than the lower one.
    pub fn sigma(&self) -> f64 {
        self.upper
    }

    /// The distance of the bounds relative to the upper one; zero where the contact seals.
    pub fn width(&self) -> f64 {
        if self.is_sealed() { 0.0 } else { (self.upper - self.lower) / self.upper }
    }

    /// Sets the fields, from the pressure of the cells of a network.
    fn lay_fields(&mut self, grid: &Grid, network: &Network, pressure: &[f64]) {
        let (nx, along, spacing) = (grid.shape()[1], self.axis.index(), grid.spacing());
        let flux = network.flux(pressure);
        // twice the flow through each cell along y and x: the sum over both faces
        let mut through = vec![[0.0; 2]; network.cells() + 2];
        for (face, flux) in flux.iter().enumerate() {
            network.ends(face).into_iter().for_each(|end| through[end][network.axis(face).index()] += flux);
        }
        // the mean flux is the total over the width, and that through a face is the flow over its own width
        let unit = 0.5 * grid.shape()[1 - along] as f64 / network.inflow(&flux);
        let widths = [0, 1].map(|axis| if axis == along { 1.0 } else { spacing[1 - along] / spacing[along] });
        for cell in (0..network.cells()).filter(|&cell| network.carries(cell)) {
            let node = [cell / nx, cell % nx];
            self.pressure[node] = pressure[cell];
            self.flux[node] = unit * f64::hypot(through[cell][0] * widths[0], through[cell][1] * widths[1]);
        }
    }

    /// Whether nothing flows.
    pub fn is_sealed(&self) -> bool {
        self.upper == 0.0
    }

    /// The leakage, if its bounds are as close as was asked for.
    ///
    /// # Errors
    /// [`FlowError::NotConverged`].
    pub fn converged(self) -> Result<Self, FlowError> {
        if self.width() <= self.tolerance {
            return Ok(self);
        }
        let Self { lower, upper, tolerance, steps, .. } = self;
        Err(FlowError::NotConverged { lower, upper, tolerance, steps })
    }
}

/// The gap of a contact, 0 in nodes with a pressure.
fn open_gap(contact: &Contact) -> Field {
    let mut gap = contact.gap.clone();
    gap.zip_mut_with(&contact.pressure, |gap, &pressure| *gap = if pressure > 0.0 { 0.0 } else { *gap });
    gap
}

/// The flow through finite gaps, as far as it is found until `ended` becomes true.
fn solve(grid: &Grid, gap: &Field, (axis, tolerance): (FlowAxis, f64), ended: &AtomicBool) -> Leakage {
    let widest = gap.fold(0.0, |most: f64, &gap| most.max(gap));
    let conductivity: Vec<f64> = gap.iter().map(|gap| (gap.max(0.0) / widest).powi(3)).collect();
    let network = Network::new(&axis.cut(grid), axis, conductivity);
    let size = grid.size();
    let unit = widest.powi(3) * size[axis.index()] / size[1 - axis.index()];
    let (pressure, flux) = (Field::from_elem(grid.shape(), f64::NAN), Field::zeros(grid.shape()));
    let mut leakage = Leakage { axis, lower: 0.0, upper: 0.0, tolerance, steps: 0, pressure, flux };
    if network.is_sealed() {
        return leakage;
    }
    let mut groups = GroupSize::Large;
    let mut cycle = GroupCycle::new(&network, groups);
    let tree = ChannelTree::new(&network);
    let linear = network.linear();
    let flux = network.flux(&linear);
    let mut gradients = Gradients::new(linear, network.surplus(&flux));
    let (mut power, mut goal, mut last_gain) = (network.power(&flux), FIRST_GOAL * tolerance, f64::INFINITY);
    leakage.upper = unit * power;
    // whether the next step is the first one from the residual of the pressure, and not from what steps have made of it
    let mut is_first = true;
    while leakage.steps < MOST_STEPS && leakage.width() > tolerance && !ended.load(Ordering::Relaxed) {
        let gain = cycle.step(&mut gradients);
        leakage.steps += 1;
        power -= gain.unwrap_or(0.0);
        if leakage.steps == MOST_STEPS || gain.is_none_or(|gain| gain <= goal * power) {
            let ([lower, upper], residual) = bounds(&network, &tree, &gradients.x);
            (leakage.lower, leakage.upper) = (leakage.lower.max(unit * lower), leakage.upper.min(unit * upper));
            power = upper;
            match gain {
                Some(gain) => {
                    goal = NEXT_GOAL * gain / power * tolerance / leakage.width();
                    gradients.residual = residual;
                }
                None if is_first => break,
                None => gradients = Gradients::new(gradients.x, residual),
            }
        }
        is_first = gain.is_none();
        let is_slow = leakage.steps >= FIRST_STEPS && gain.is_some_and(|gain| gain > SLOW * last_gain);
        if is_slow && groups == GroupSize::Large {
            groups = GroupSize::Small;
            cycle = cycle.with_groups(groups);
        }
        last_gain = gain.unwrap_or(0.0);
    }
    leakage.lay_fields(grid, &network, &gradients.x);
    leakage
}

/// The flow per pressure drop, from below by a conserved flow, and from above by a pressure; and the surplus of the cells.
fn bounds(network: &Network, tree: &ChannelTree, pressure: &[f64]) -> ([f64; 2], Vec<f64>) {
    let mut flux = network.flux(pressure);
    let (upper, surplus) = (network.power(&flux), network.surplus(&flux));
    tree.drain(network, &surplus, &mut flux);
    let total = network.inflow(&flux);
    ([total * total / network.power(&flux), upper], surplus)
}
