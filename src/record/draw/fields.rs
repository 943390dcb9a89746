//! The fields of a frame, and how far they reach.

use crate::contact::{Contact, Edge, Edges, Patch, Problem, Step};
use crate::diagnosis::ContactHistory;
use crate::grid::Grid;
use crate::record::draw::ink::reduce::has_contour;
use crate::record::parts::Parts;
use crate::setup::Part;
use std::borrow::Cow;

/// Largest number of patches that show their numbers under the pointer.
const MOST_PATCHES: usize = 256;

/// The fields of a frame, row by row.
pub(crate) struct FrameFields<'a> {
    /// Distance of their nodes along y and x, in nodes of the scene: 1 on its own grid, a power of two on coarser ones.
    pub stride: [usize; 2],
    pub pressure: Cow<'a, [f64]>,
    /// Gap; empty if nothing shows it.
    pub gap: Cow<'a, [f64]>,
    /// Ones at the candidates, zeros elsewhere; empty if all nodes may come into contact, or nothing shows them.
    pub candidates: Cow<'a, [f64]>,
    /// The outline of the contact; empty if nothing shows it.
    pub outline: Outline,
    /// The largest contact patches; none if nothing shows them.
    pub patches: Vec<PatchReading>,
    /// Further fields of a state of a history, by their names.
    pub further: Vec<(&'static str, Cow<'a, [f64]>)>,
}

/// A contact patch at a step, and its past as far as it is known.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PatchReading {
    pub patch: Patch,
    /// Steps for which the node of its largest pressure has been in contact, if that is less than all.
    pub age: Option<u32>,
}

/// The outline of a contact.
#[derive(Default)]
pub(crate) struct Outline {
    /// The edges of a line, by their nodes.
    pub edges: Vec<Edge>,
    /// The lines of the contour of a surface, in nodes along y and x.
    pub contour: Vec<[[f64; 2]; 2]>,
}

impl Outline {
    /// The outline of a contact on `grid`, all edges of which are given; of a surface only where each node has a pixel.
    fn new<G: Fn(usize) -> f64 + Sync>(grid: &Grid, edges: &Edges<'_, G>, all: &[Edge]) -> Self {
        match grid.is_line() {
            true => Self { edges: all.to_vec(), ..Self::default() },
            false if has_contour(grid) => Self { contour: edges.contour_of(all), ..Self::default() },
            false => Self::default(),
        }
    }

    /// The distance of the edge from a node in contact of a line, in spacings to the left or right; half of one where none is known.
    pub(crate) fn place(&self, node: usize, is_right: bool) -> f64 {
        let first = self.edges.partition_point(|edge| edge.node < node);
        let mut edges = self.edges[first..].iter().take_while(|edge| edge.node == node);
        edges.find(|edge| (edge.towards[1] > 0) == is_right).map_or(0.5, |edge| edge.place)
    }
}

impl<'a> FrameFields<'a> {
    /// The fields of `step` that `parts` show.
    pub(crate) fn from_step(step: &'a Step<'_>, stride: [usize; 2], parts: Parts) -> Self {
        let gap = if parts.has_gap() { step.gap() } else { &[] };
        let outline = || Outline::new(step.problem().surface().grid(), &step.edges(), step.all_edges());
        let outline = if parts.has(Part::Mask) { outline() } else { Outline::default() };
        let patches = if parts.has(Part::Mask) { largest(step.problem(), step.pressure()) } else { Vec::new() };
        let candidates = step.candidates().filter(|_| parts.has(Part::Mask)).unwrap_or_default();
        let (pressure, gap, candidates) = (step.pressure().into(), gap.into(), candidates.into());
        Self { stride, pressure, gap, candidates, outline, patches, further: Vec::new() }
    }

    /// The fields with the past of their patches.
    pub(crate) fn with_past(mut self, contact: &ContactHistory) -> Self {
        let [nx, width] = [contact.grid().shape()[1] / self.stride[1], contact.grid().shape()[1]];
        let node = |coarse: usize| coarse / nx * self.stride[0] * width + coarse % nx * self.stride[1];
        self.patches.iter_mut().for_each(|it| it.age = contact.age(node(it.patch.peak)));
        self
    }

    pub(crate) fn from_contact(contact: &'a Contact) -> Self {
        let [pressure, gap] = [&contact.pressure, &contact.gap].map(|field| field.as_slice().unwrap_or_default());
        let edges = contact.edges();
        let outline = Outline::new(contact.problem.surface().grid(), &edges, &edges.all());
        let patches = largest(&contact.problem, pressure);
        let candidates = Cow::default();
        let (pressure, gap, further) = (pressure.into(), gap.into(), Vec::new());
        Self { stride: [1, 1], pressure, gap, candidates, outline, patches, further }
    }

    /// The fields with further ones.
    pub(crate) fn with_further(self, further: &[(&'static str, &'a [f64])]) -> Self {
        Self { further: further.iter().map(|(name, values)| (*name, (*values).into())).collect(), ..self }
    }

    /// A copy that outlives its step.
    pub(crate) fn into_owned(self) -> FrameFields<'static> {
        let [pressure, gap, candidates] =
            [self.pressure, self.gap, self.candidates].map(|values| values.into_owned().into());
        let further = self.further.into_iter().map(|(name, values)| (name, values.into_owned().into())).collect();
        let Self { stride, outline, patches, .. } = self;
        FrameFields { stride, pressure, gap, candidates, outline, patches, further }
    }
}

fn largest(problem: &Problem, pressure: &[f64]) -> Vec<PatchReading> {
    Patch::all(problem, pressure)
        .into_iter()
        .take(MOST_PATCHES)
        .map(|patch| PatchReading { patch, age: None })
        .collect()
}

/// The reach of the fields of some states: the largest pressure, the largest gap, the largest shear stress below.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FieldExtent {
    pub pressure: f64,
    pub gap: f64,
    pub shear: f64,
    /// The lowest and the highest place of the relief.
    pub relief: [f64; 2],
    /// The largest distance between the surfaces of a state where they are closest, 0 where they touch.
    pub apart: f64,
    /// The least and the largest value of each further field, by its name.
    pub further: Vec<(&'static str, [f64; 2])>,
}

impl FieldExtent {
    pub(crate) const NONE: Self = Self {
        pressure: 0.0,
        gap: 0.0,
        shear: 0.0,
        relief: [f64::INFINITY, f64::NEG_INFINITY],
        apart: 0.0,
        further: Vec::new(),
    };

    pub(crate) fn and(mut self, other: Self) -> Self {
        self.pressure = self.pressure.max(other.pressure);
        self.gap = self.gap.max(other.gap);
        self.shear = self.shear.max(other.shear);
        self.relief = widest(self.relief, other.relief);
        self.apart = self.apart.max(other.apart);
        for (name, range) in other.further {
            match self.further.iter_mut().find(|(own, _)| *own == name) {
                Some((_, own)) => *own = widest(*own, range),
                None => self.further.push((name, range)),
            }
        }
        self
    }

    /// The reach as if the surfaces touched, so that the axis of the profile stays: for the steps of a solver, which are not drawn again.
    pub(crate) fn touching(self) -> Self {
        Self { apart: 0.0, ..self }
    }

    /// The reach of one further field of a state.
    pub(crate) fn of_further(name: &'static str, values: &[f64]) -> Self {
        Self { further: vec![(name, range(values.iter().copied()))], ..Self::NONE }
    }

    /// The least and the largest value of a further field, if a state has it.
    pub(crate) fn further(&self, name: &str) -> Option<[f64; 2]> {
        let found = self.further.iter().find(|(other, _)| *other == name);
        found.map(|(_, range)| *range).filter(|[low, high]| low <= high)
    }
}

/// The range over two ranges.
fn widest([low, high]: [f64; 2], [other_low, other_high]: [f64; 2]) -> [f64; 2] {
    [low.min(other_low), high.max(other_high)]
}

/// Smallest and largest finite value.
pub(crate) fn range(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    let finite = values.into_iter().filter(|v| v.is_finite());
    finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extents_reach_as_far_as_all_states() {
        let further = vec![("traction", [-1.0, 0.5])];
        let near = FieldExtent { pressure: 1.0, gap: 5.0, shear: 0.5, relief: [0.0, 1.0], apart: 0.2, further };
        let further = vec![("slip", [0.0, 2.0]), ("traction", [-0.5, 3.0])];
        let far = FieldExtent { pressure: 3.0, gap: 2.0, shear: 0.1, relief: [-1.0, 0.5], apart: 0.1, further };
        let both = near.clone().and(far.clone());
        assert_eq!((both.pressure, both.gap, both.shear, both.relief, both.apart), (3.0, 5.0, 0.5, [-1.0, 1.0], 0.2));
        assert_eq!((both.further("traction"), both.further("slip")), (Some([-1.0, 3.0]), Some([0.0, 2.0])));
        assert_eq!(both.further("strain"), None);
        assert_eq!(FieldExtent::NONE.and(far.clone()), far);
    }
}
