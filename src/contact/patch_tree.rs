//! The lives of contact patches, and the order in which a tree of them has no crossings that can be avoided.

use super::patch_history::PatchHistory;
use super::patch_tracker::PatchEventKind;
use std::cmp::Reverse;
use std::collections::BTreeMap;

/// The life of a patch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PatchLife {
    /// The number of the patch.
    pub patch: usize,
    /// The first state in which it is there; states count from 1.
    pub first: usize,
    /// The last state in which it is there.
    pub last: usize,
    /// The event that it begins with, if it is not there from the first state on, and the patch that it was split from.
    pub begin: Option<(PatchEventKind, Option<usize>)>,
    /// The event that it ends with, if it is not there in the last state, and the patch that it merged into.
    pub end: Option<(PatchEventKind, Option<usize>)>,
    /// The largest share of the load of a state that it carries.
    pub most: f64,
}

/// The lives of the patches that carry most, in the order of their lanes: beside each patch are those that merged into it.
///
/// ```
/// use asperity::contact::{ContactModulus, Load, Multilevel, PatchHistory, PatchTree, Problem, Solver, Stop};
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
/// let tree = PatchTree::new(&history, 10);
/// let lives: Vec<_> = tree.lives.iter().map(|it| (it.patch, it.first, it.last)).collect();
/// assert_eq!((lives, tree.left_out), (vec![(1, 1, 3), (2, 2, 2)], 0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PatchTree {
    /// The lives, from the first lane on.
    pub lives: Vec<PatchLife>,
    /// The number of patches that carry less and are left out.
    pub left_out: usize,
}

impl PatchTree {
    /// The tree of at most `most` patches, those that carry the largest shares of the load of a state.
    pub fn new(history: &PatchHistory, most: usize) -> Self {
        let mut lives = lives(history);
        lives.sort_by(|a, b| b.most.total_cmp(&a.most).then(a.patch.cmp(&b.patch)));
        let left_out = lives.len().saturating_sub(most);
        lives.truncate(most);
        Self { lives: ordered(&lives), left_out }
    }

    /// The lane of a patch, from 0 on, if it is in the tree.
    pub fn lane(&self, patch: usize) -> Option<usize> {
        self.lives.iter().position(|life| life.patch == patch)
    }

    /// The patch at the root of the branch of a patch: the last one of those that merged into each other.
    pub fn root(&self, patch: usize) -> usize {
        let mut root = patch;
        while let Some(next) = self.lane(root).and_then(|lane| self.lives[lane].merged_into()) {
            if self.lane(next).is_none() {
                break;
            }
            root = next;
        }
        root
    }
}

impl PatchLife {
    /// The patch that it merged into.
    pub fn merged_into(&self) -> Option<usize> {
        self.end.and_then(|(_, other)| other)
    }
}

/// The lives of all patches.
fn lives(history: &PatchHistory) -> Vec<PatchLife> {
    let mut lives: BTreeMap<usize, PatchLife> = BTreeMap::new();
    for state in &history.states {
        let load = state.load();
        for it in &state.patches {
            let born = PatchLife {
                patch: it.number,
                first: state.state,
                last: state.state,
                begin: None,
                end: None,
                most: 0.0,
            };
            let life = lives.entry(it.number).or_insert(born);
            life.last = state.state;
            life.most = life.most.max(it.its.load / load);
        }
    }
    for event in &history.events {
        let Some(life) = lives.get_mut(&event.patch) else { continue };
        let place = if event.event.begins() { &mut life.begin } else { &mut life.end };
        *place = Some((event.event, event.other));
    }
    lives.into_values().collect()
}

/// Lives in the order of their lanes. Those that merged into a patch stand beside it, by turns on either side, the last to merge the farthest.
fn ordered(lives: &[PatchLife]) -> Vec<PatchLife> {
    let is_there = |patch: usize| lives.iter().any(|life| life.patch == patch);
    let is_root = |life: &&PatchLife| life.merged_into().is_none_or(|other| !is_there(other));
    lives.iter().filter(is_root).flat_map(|root| branch(root, lives)).collect()
}

/// A life with those that merged into it.
fn branch(root: &PatchLife, lives: &[PatchLife]) -> Vec<PatchLife> {
    let mut merged: Vec<&PatchLife> = lives.iter().filter(|life| life.merged_into() == Some(root.patch)).collect();
    merged.sort_by_key(|life| Reverse((life.last, life.patch)));
    let (before, after): (Vec<_>, Vec<_>) = merged.into_iter().enumerate().partition(|(place, _)| place % 2 == 1);
    let branches = |lives_of: Vec<(usize, &PatchLife)>| {
        lives_of.into_iter().map(|(_, life)| branch(life, lives)).collect::<Vec<_>>()
    };
    let before = branches(before).concat();
    let after = branches(after).into_iter().rev().collect::<Vec<_>>().concat();
    [before, vec![*root], after].concat()
}
