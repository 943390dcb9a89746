//! The identity of contact patches from state to state.

use serde::Serialize;
use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::ops::Range;
use strum::IntoStaticStr;

/// What happened to a patch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum PatchEventKind {
    /// It came into contact where there was none.
    Born,
    /// It lost contact.
    Died,
    /// It became part of another one.
    Merged,
    /// It was cut off from another one.
    Split,
}

impl PatchEventKind {
    /// Whether a patch begins with it.
    pub fn begins(self) -> bool {
        matches!(self, Self::Born | Self::Split)
    }
}

/// An event in the life of a patch, in the first state that shows it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct PatchEvent {
    /// The number of the state, from 1 on.
    pub state: usize,
    /// What happened.
    pub event: PatchEventKind,
    /// The number of the patch.
    pub patch: usize,
    /// The patch that it merged into, or was cut off from.
    pub other: Option<usize>,
}

/// Numbers the patches of successive states, so that each keeps its number as long as it lives.
///
/// A patch is found again by the nodes that it shares with those of the state before. Of all pairs of a patch before and a patch now, those that
/// share the most nodes come first: the patch now takes the number of the patch before, if neither has a partner yet. Of the others,
///
/// - a patch before that shares nodes with a patch now has merged into it, and one that shares none has died,
/// - a patch now that shares nodes with a patch before was split from it, and one that shares none was born.
///
/// Where several are possible, it is the one with the most shared nodes, and among equals the one with the first node on the grid. Of patches that merge, so the number of the largest overlap stays; of the parts
/// of one that splits, the part with the most nodes in common keeps it. Patches of the first state have no events.
///
/// ```
/// use asperity::contact::{PatchEventKind, PatchTracker};
/// let mut tracker = PatchTracker::default();
/// assert_eq!(tracker.follow(vec![vec![10..18], vec![20..24]]).0, [1, 2]);
/// let (numbers, events) = tracker.follow(vec![vec![9..25], vec![40..41]]);
/// assert_eq!(numbers, [1, 3]);
/// let told: Vec<_> = events.iter().map(|it| (it.state, it.event, it.patch, it.other)).collect();
/// assert_eq!(told, [(2, PatchEventKind::Merged, 2, Some(1)), (2, PatchEventKind::Born, 3, None)]);
/// ```
#[derive(Debug, Clone, Default)]
pub struct PatchTracker {
    /// The patches of the last state: their numbers and their nodes.
    last: Vec<(usize, Vec<Range<usize>>)>,
    /// The largest number that was given.
    given: usize,
    /// The number of states so far.
    states: usize,
}

/// Nodes that a patch before and a patch now share.
struct Overlap {
    nodes: usize,
    before: usize,
    now: usize,
}

impl PatchTracker {
    /// The numbers of the patches of the next state, each given by its nodes as runs that are apart, and what happened since the state before.
    pub fn follow(&mut self, patches: Vec<Vec<Range<usize>>>) -> (Vec<usize>, Vec<PatchEvent>) {
        self.states += 1;
        let overlaps = overlaps(&self.last, &patches);
        let mut numbers: Vec<Option<usize>> = vec![None; patches.len()];
        let mut heirs: Vec<Option<usize>> = vec![None; self.last.len()];
        for &Overlap { before, now, .. } in &overlaps {
            if heirs[before].is_none() && numbers[now].is_none() {
                (heirs[before], numbers[now]) = (Some(now), Some(self.last[before].0));
            }
        }
        let is_old: Vec<bool> = numbers.iter().map(Option::is_some).collect();
        let mut number = |known: Option<usize>| {
            known.unwrap_or_else(|| {
                self.given += 1;
                self.given
            })
        };
        let numbers: Vec<usize> = numbers.into_iter().map(&mut number).collect();
        let state = self.states;
        let ended = (0..heirs.len()).filter(|&it| heirs[it].is_none()).map(|before| {
            let other = overlaps.iter().find(|it| it.before == before).map(|it| numbers[it.now]);
            let event = if other.is_some() { PatchEventKind::Merged } else { PatchEventKind::Died };
            PatchEvent { state, event, patch: self.last[before].0, other }
        });
        let begun = (0..numbers.len()).filter(|&it| !is_old[it] && state > 1).map(|now| {
            let other = overlaps.iter().find(|it| it.now == now).map(|it| self.last[it.before].0);
            let event = if other.is_some() { PatchEventKind::Split } else { PatchEventKind::Born };
            PatchEvent { state, event, patch: numbers[now], other }
        });
        let events = ended.chain(begun).collect();
        self.last = numbers.iter().copied().zip(patches).collect();
        (numbers, events)
    }
}

/// The overlaps of the patches of two states, those of the most nodes first.
fn overlaps(before: &[(usize, Vec<Range<usize>>)], now: &[Vec<Range<usize>>]) -> Vec<Overlap> {
    let runs =
        before.iter().enumerate().flat_map(|(patch, (_, runs))| runs.iter().map(move |run| (run.clone(), patch)));
    let mut runs: Vec<(Range<usize>, usize)> = runs.collect();
    runs.sort_unstable_by_key(|(run, _)| run.start);
    let mut shared: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    for (patch, run) in now.iter().enumerate().flat_map(|(patch, runs)| runs.iter().map(move |run| (patch, run))) {
        let first = runs.partition_point(|(it, _)| it.end <= run.start);
        for (it, older) in runs[first..].iter().take_while(|(it, _)| it.start < run.end) {
            *shared.entry((*older, patch)).or_default() += it.end.min(run.end) - it.start.max(run.start);
        }
    }
    let overlap = |((before, now), nodes)| Overlap { nodes, before, now };
    let mut overlaps: Vec<Overlap> = shared.into_iter().map(overlap).collect();
    let first = |runs: &[Range<usize>]| runs.iter().map(|run| run.start).min();
    overlaps.sort_by_cached_key(|it| (Reverse(it.nodes), first(&before[it.before].1), first(&now[it.now])));
    overlaps
}
