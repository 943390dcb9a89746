//! The contact patches of states one after the other.

use super::patch_tracker::{PatchEvent, PatchEventKind, PatchTracker};
use crate::contact::{Contact, Observables, Patch};
use serde::Serialize;
use std::collections::HashMap;

/// The contact patches of states one after the other, with numbers that they keep, and what happened to them.
///
/// ```
/// use asperity::contact::{ContactModulus, Load, Multilevel, PatchHistory, Problem, Solver, Stop};
/// use asperity::surface::Field;
/// use asperity::{Grid, Surface};
/// use std::f64::consts::PI;
/// // two waves, of which one has the higher crest
/// let grid = Grid::line(256, 2.0)?;
/// let wave = |(_, i): (usize, usize)| 0.01 * (i as f64 * PI / 64.0).cos() + 0.001 * (i as f64 * PI / 128.0).cos();
/// let heights = Surface::new(grid, Field::from_shape_fn(grid.shape(), wave))?;
/// let problem = Problem::new(heights, ContactModulus(1.0), Load::MeanPressure(0.1))?;
/// let mut history = PatchHistory::new(grid.shape());
/// for load in [1e-4, 1e-2, 0.2] {
///     let problem = problem.clone().with_load(Load::MeanPressure(load))?;
///     history.add(&Multilevel.solve(&problem, &Stop::default(), &mut ())?);
/// }
/// assert_eq!(history.states.iter().map(|it| it.patches.len()).collect::<Vec<_>>(), [1, 2, 1]);
/// assert_eq!(history.states[1].strongest().map(|it| it.number), Some(1));
/// assert_eq!(history.merged_into(1).collect::<Vec<_>>(), [(2, 3)]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct PatchHistory {
    /// The states, in their order.
    pub states: Vec<PatchState>,
    /// What happened from state to state, see [`PatchTracker`].
    pub events: Vec<PatchEvent>,
    /// Rows and columns from the first node on whose patches count.
    part: [usize; 2],
    tracker: PatchTracker,
}

/// The patches of a state.
#[derive(Debug, Clone, Serialize)]
pub struct PatchState {
    /// The number of the state, from 1 on.
    pub state: usize,
    /// `p* = p / (E* gbar)`.
    pub reduced_pressure: f64,
    /// The mean pressure.
    pub mean_pressure: f64,
    /// The patches, the largest first.
    pub patches: Vec<NumberedPatch>,
}

/// A patch, with the number that it keeps from state to state.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct NumberedPatch {
    /// The number, from 1 on.
    #[serde(rename = "patch")]
    pub number: usize,
    /// Its measures.
    #[serde(flatten)]
    pub its: Patch,
}

/// A patch in a state, as a row of a table.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TrackedPatch {
    /// The number of the state, from 1 on.
    pub state: usize,
    /// The number of the patch, which it keeps.
    pub patch: usize,
    /// Nodes in contact.
    pub nodes: usize,
    /// Area, or length of a line, of its nodes.
    pub area: f64,
    /// Force, or force per length of a line.
    pub load: f64,
    /// The load over that of all patches of the state.
    pub load_share: f64,
    /// `kappa_r` of its own nodes.
    pub kappa_r: f64,
    /// The mean position of its nodes along x, a length.
    pub x: f64,
    /// The mean position of its nodes along y, a length.
    pub y: f64,
    /// The event that it begins with, in the first row of a patch that is not there from the first state on.
    pub begin: Option<PatchEventKind>,
    /// The patch that it was split from.
    pub begin_patch: Option<usize>,
    /// The event that it ends with, in the last row of a patch that is not there in the last state.
    pub end: Option<PatchEventKind>,
    /// The patch that it merged into.
    pub end_patch: Option<usize>,
}

/// Patches of about the same size.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PatchSizes {
    /// The fewest nodes of a patch, a power of two; all have less than twice as many.
    pub nodes: usize,
    /// The number of patches.
    pub patches: usize,
    /// Their share of the area of all.
    pub area_share: f64,
    /// Their share of the load of all.
    pub load_share: f64,
}

impl PatchHistory {
    /// A history without a state. Patches count within the first rows and columns of the grid: its shape, or that of the part of which the rest is mirror
    /// images.
    pub fn new(part: [usize; 2]) -> Self {
        Self { states: Vec::new(), events: Vec::new(), part, tracker: PatchTracker::default() }
    }

    /// Adds the contact of the next state.
    pub fn add(&mut self, contact: &Contact) {
        let pressure = contact.pressure.as_slice().unwrap_or_default();
        let (patches, nodes): (Vec<_>, Vec<_>) =
            Patch::within(&contact.problem, pressure, self.part).into_iter().unzip();
        let (numbers, events) = self.tracker.follow(nodes);
        let patches = numbers.into_iter().zip(patches).map(|(number, its)| NumberedPatch { number, its }).collect();
        let Observables { reduced_pressure, mean_pressure, .. } = Observables::new(contact);
        self.states.push(PatchState { state: self.states.len() + 1, reduced_pressure, mean_pressure, patches });
        self.events.extend(events);
    }

    /// All patches of all states as rows of a table, state by state, with their events: an event that ends a patch is in its last row.
    pub fn rows(&self) -> Vec<TrackedPatch> {
        let (begins, ends): (Vec<&PatchEvent>, Vec<&PatchEvent>) = self.events.iter().partition(|it| it.event.begins());
        let by_place = |events: Vec<&PatchEvent>, before: usize| -> HashMap<(usize, usize), PatchEvent> {
            events.into_iter().map(|it| ((it.state - before, it.patch), *it)).collect()
        };
        let (begins, ends) = (by_place(begins, 0), by_place(ends, 1));
        let row = |state: &PatchState, load: f64, NumberedPatch { number, its }: &NumberedPatch| {
            let [begin, end] = [&begins, &ends].map(|events| events.get(&(state.state, *number)));
            TrackedPatch {
                state: state.state,
                patch: *number,
                nodes: its.nodes,
                area: its.area,
                load: its.load,
                load_share: its.load / load,
                kappa_r: its.kappa_r,
                x: its.centre[1],
                y: its.centre[0],
                begin: begin.map(|it| it.event),
                begin_patch: begin.and_then(|it| it.other),
                end: end.map(|it| it.event),
                end_patch: end.and_then(|it| it.other),
            }
        };
        let rows_of = |state: &PatchState| {
            let load = state.load();
            state.patches.iter().map(|patch| row(state, load, patch)).collect::<Vec<_>>()
        };
        self.states.iter().flat_map(rows_of).collect()
    }

    /// The patches that merged into one, directly, each with the state that shows it first.
    pub fn merged_into(&self, patch: usize) -> impl Iterator<Item = (usize, usize)> {
        let merged = move |it: &&PatchEvent| it.event == PatchEventKind::Merged && it.other == Some(patch);
        self.events.iter().filter(merged).map(|it| (it.patch, it.state))
    }
}

impl PatchState {
    /// The load of all patches, a force, or a force per length of a line.
    pub fn load(&self) -> f64 {
        self.patches.iter().map(|it| it.its.load).sum()
    }

    /// The area of all patches, or their length on a line.
    pub fn area(&self) -> f64 {
        self.patches.iter().map(|it| it.its.area).sum()
    }

    /// The patch that carries most.
    pub fn strongest(&self) -> Option<&NumberedPatch> {
        self.patches.iter().max_by(|a, b| a.its.load.total_cmp(&b.its.load))
    }

    /// The distribution of sizes, in classes of powers of two, the smallest first.
    pub fn sizes(&self) -> Vec<PatchSizes> {
        let (area, load) = (self.area(), self.load());
        let mut sizes: Vec<PatchSizes> = Vec::new();
        for patch in self.patches.iter().rev() {
            let nodes = 1 << patch.its.nodes.ilog2();
            if sizes.last().is_none_or(|it| it.nodes != nodes) {
                sizes.push(PatchSizes { nodes, patches: 0, area_share: 0.0, load_share: 0.0 });
            }
            if let Some(size) = sizes.last_mut() {
                size.patches += 1;
                size.area_share += patch.its.area / area;
                size.load_share += patch.its.load / load;
            }
        }
        sizes
    }
}
