//! The edges of a contact, interpolated between the nodes.
//!
//! Letters of this file: `l` spacing, `P = p l / E*` pressure of the last node in contact as a length, `G` gap of the next node,
//! `s` distance of the edge from the last node in spacings along the link of the two, `k` cosine of the angle between that
//! link and the normal of the edge, `c` the excess of counting.

mod contour;
mod law;
mod moving;
mod normal;
mod saturated;

use crate::contact::links::for_each_in_contact;
use crate::contact::{Problem, chunks};
use crate::grid::Grid;
pub use law::NODE_EXCESS_PER_SWITCH_LINE;
use law::{EdgeSide, GAP_WEIGHT};
use moving::EdgeLaws;
use normal::EdgeNormal;
use saturated::{SaturatedSide, unit_of_opening};
use std::ops::Range;

/// If more than this share of the edges of a contact is given by its shape, the gradient over the contact is
/// meaningless.
const MOST_OF_SHAPE: f64 = 0.5;

/// Where a contact moves, the pressure may rise towards a free edge too. The edge of a punch then has a gap that is this many times as large
/// as that of a free edge in the middle of its range.
const OPEN: f64 = 10.0;

/// Error of the place of a saturated edge, in spacings, and independent from edge to edge: the area of a contact of `n` of them is off by `sqrt(n)` times
/// this. Of 150 lines and 100 surfaces with a hardness, held against grids that are 6 to 16 times as fine, one each was off by more than 1.5 times
/// the error that is told (1.8 and 2.2 times).
const SATURATED_ERROR: f64 = 0.15;

/// Error of the place of an edge over a solid that flows, in spacings, and the same for all edges of a contact, whose areas are too small rather than too large.
/// Of 118 states of cylinders on grids of 32 to 256 points, held against 512 points, the mean was -0.05, the root mean square 0.09 and the
/// largest error 0.21; by the elastic law -0.26, 0.35 and 0.83. Of 144 other states of cylinders, rough lines and balls none was off by more than 1.5
/// times the error that is told.
const LIMITED_ERROR: f64 = 0.15;

/// The edges of a contact, each found between the last node in contact and the next one.
///
/// Pressure falls to a free edge as the square root of the distance and the gap opens as its power of three halves. On
/// a grid such edges are a family of two parameters, strength and place, and the pressure `P` of the last node with the
/// gap `G` of the next one determine both:
///
/// ```text
/// s = -c + P / (P + (pi / 2e) G)
/// ```
///
/// **Why.** Take the nodes `j >= 0` in contact, and `|theta| = G+(z) G+(1/z)`, `z = exp(i theta)`, the factors of Wiener and
/// Hopf of the stiffness `E* |theta| / 2l`. Solutions that do not grow faster than contact does have the pressures
/// `G+(z) [a / (1-z)^2 + b / (1-z)]`, whose coefficients at `z^0` and, over the symbol, at `z^-1` are `P` and `G`:
/// `P = G+(0) (a + b) / 2` and `G = -b / G+(0)`, with `G+(0)^2 = pi / e`. The pressure far inside is that of an edge at
/// `s = 1 - c + b / a`, and `b / a` follows from `P` and `G`. The place is uniform over one spacing, so counting nodes is too
/// large by `c` per edge on average.
///
/// **Surfaces.** A straight edge along the grid, and one along its diagonal, obey the same law with `P k` instead of
/// `P`. At other angles the nodes have several distances from the edge; the error of the law is then 0.03 spacings for
/// one node and less than 0.002 on average (from the factors along lattice directions up to (8, 5)). The cosine comes
/// from how the distance from the edge, as computed from pressures and gaps, changes along the link and across it. A
/// link counts by `k^2` in area, so that those along rows and columns add up to the contour.
///
/// **What is not an edge of this kind.** The edge of a punch is given by its shape. It is recognised by a pressure that
/// rises towards the edge over three nodes, and put halfway between the nodes, as counting does. Where the last node or the one behind it
/// is at the hardness, the pressure falls from there to zero within less than a spacing: such an edge is saturated, see `saturated.rs` for its
/// law. Where the solid flows below the contact, the pressure of the node behind the edge limits its strength. No node touches over less than
/// its pressure needs at the highest one that is allowed. The law of an edge assumes that the other edge is far away, which is wrong for
/// patches of one or two nodes: the error of their area may be as large as the area, but the area is never negative.
///
/// **Sliding.** Below a contact that slides over a viscoelastic solid each wave has a stiffness of its own. The same law then holds with
/// the geometric mean of the stiffness over all waves of the grid instead of `E*`, by which the gap is multiplied, and with another
/// excess `c`, which lies between 0.19 and 0.38. It takes the modulus of the shortest waves: the relaxed one where the surface slides by
/// much less than a spacing in the retardation time, and the glassy one where it slides by much more.
///
/// # Source
/// This crate's own; [`crate::theory::counting_excess`] has the excess at any angle.
pub struct Edges<'a, G> {
    problem: &'a Problem,
    grid: &'a Grid,
    pressure: &'a [f64],
    gap: G,
    laws: EdgeLaws,
    /// Whether the solid flows below the contact, which limits the pressure at its edges.
    flows: bool,
    /// Spacings along y and x over the contact modulus: the length of a pressure in the law of an edge.
    per_modulus: [f64; 2],
}

/// The edge of a contact on the link between a node in contact and a neighbour that is not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// The node in contact, counted row by row.
    pub node: usize,
    /// The step to its neighbour, in nodes along y and x.
    pub towards: [isize; 2],
    /// Distance of the edge from the node along the link, in spacings: between -0.19 and 0.81.
    pub place: f64,
    /// Share of the link in the contour, `k^2`; 1 on a line.
    pub weight: f64,
    /// Whether the shape of the surface gives the edge, as that of a punch.
    pub is_of_shape: bool,
    /// Whether the flow of the solid below the contact limits the pressure at the edge.
    pub is_limited: bool,
    /// Of a saturated edge, at which the pressure falls from a plateau to zero within less than a spacing: the pressure of the node over that of the
    /// plateau, such as the hardness. None at other edges.
    pub filled: Option<f64>,
}

/// Area, gradient and `kappa_r` of a contact whose edges are resolved between the nodes; dimensionless.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolved {
    /// `a_rel`, the share of the area in contact.
    pub relative_area: f64,
    /// `gbar_r`, root-mean-square gradient over the contact, by differences of fourth order; 0 without contact, NaN where most
    /// edges are given by the shape, whose gradient there is a step.
    pub rms_gradient_contact: f64,
    /// `p_r* = <p> / (gbar_r E*)`; of a contact that slides with its [`Problem::effective_modulus`].
    pub reduced_pressure_contact: f64,
    /// `kappa_r = a_rel / p_r*`.
    pub kappa_r: f64,
    /// Links between contact and gap.
    pub edges: usize,
    /// Links between contact and gap at which the shape of the surface gives the edge, as that of a punch does.
    pub edges_of_shape: usize,
    /// Estimated relative error of the area by edges at which the pressure is limited, by a hardness or by flow; 0 without any, and where it was not kept.
    pub edge_error: f64,
}

impl Resolved {
    /// The values in the order of an archive; NaN where there are none.
    pub fn numbers(it: Option<Self>) -> [f64; 6] {
        it.map_or([f64::NAN; 6], |it| {
            let [edges, of_shape] = [it.edges, it.edges_of_shape].map(|edges| edges as f64);
            [it.relative_area, it.rms_gradient_contact, it.kappa_r, it.reduced_pressure_contact, edges, of_shape]
        })
    }

    /// The values of an archive, if there are any.
    pub fn from_numbers(numbers: [f64; 6]) -> Option<Self> {
        let [relative_area, rms_gradient_contact, kappa_r, reduced_pressure_contact, edges, of_shape] = numbers;
        let [edges, edges_of_shape] = [edges, of_shape].map(|edges| edges as usize);
        let it = Self {
            relative_area,
            rms_gradient_contact,
            reduced_pressure_contact,
            kappa_r,
            edges,
            edges_of_shape,
            edge_error: 0.0,
        };
        (!numbers[4].is_nan()).then_some(it)
    }
}

impl<'a, G: Fn(usize) -> f64 + Sync> Edges<'a, G> {
    /// The edges of the contact of nodes with `pressure > 0` (row by row), `gap` being that of a node, a length; of one at the hardness minus
    /// its overlap.
    ///
    /// # Panics
    /// If the length of `pressure` does not fit the grid.
    pub fn new(problem: &'a Problem, pressure: &'a [f64], gap: G) -> Self {
        let grid = problem.surface().grid();
        assert_eq!(pressure.len(), grid.len(), "pressure must fit the grid");
        let per_modulus = grid.spacing().map(|spacing| spacing / problem.contact_modulus());
        Self { problem, grid, pressure, gap, laws: EdgeLaws::new(problem), flows: false, per_modulus }
    }

    /// The edges of the contact with a solid that flows below it, if it does.
    pub(crate) fn with_flow(self, flows: bool) -> Self {
        Self { flows, ..self }
    }

    /// The edges around a node, none if it is not in contact.
    pub fn around(&self, node: usize) -> impl Iterator<Item = Edge> {
        let links = self.grid.neighbours(node).into_iter().zip(STEPS);
        // of a line, the neighbours along y are the node itself
        let ends = links.filter(move |&(next, _)| self.touches(node) && !self.touches(next));
        ends.map(move |(next, towards)| self.edge([node, next], towards))
    }

    /// All edges of the contact, in the order of their nodes.
    pub fn all(&self) -> Vec<Edge> {
        chunks::visit(self.pressure.len(), |nodes| self.among(nodes)).concat()
    }

    /// The edges around some nodes, in the order of these.
    fn among(&self, nodes: Range<usize>) -> Vec<Edge> {
        let mut edges = Vec::new();
        for_each_in_contact(self.grid, self.pressure, nodes, |node, links| {
            edges.extend(self.around(node).take(links));
        });
        edges
    }

    /// Area and gradient.
    pub fn resolved(&self) -> Resolved {
        self.summed(chunks::visit(self.pressure.len(), |nodes| self.sums(nodes.clone(), &self.among(nodes))))
    }

    /// Area and gradient of a contact of which [`Edges::all`] are known.
    pub(crate) fn resolved_of(&self, all: &[Edge]) -> Resolved {
        let sums = |nodes: Range<usize>| {
            let [start, end] = [nodes.start, nodes.end].map(|node| all.partition_point(|edge| edge.node < node));
            self.sums(nodes, &all[start..end])
        };
        self.summed(chunks::visit(self.pressure.len(), sums))
    }

    /// The sums over some nodes; `edges` are all edges around these.
    fn sums(&self, nodes: Range<usize>, mut edges: &[Edge]) -> EdgeSums {
        let square_slope = self.problem.surface().square_slope();
        let mut sums = EdgeSums::default();
        for_each_in_contact(self.grid, self.pressure, nodes, |node, links| {
            let (own, rest) = edges.split_at(links);
            edges = rest;
            sums.add(if links == 0 {
                EdgeSums::cell(square_slope(node))
            } else {
                self.share(node, own, &square_slope)
            });
        });
        sums
    }

    /// Area and gradient by the sums over all nodes.
    fn summed(&self, parts: Vec<EdgeSums>) -> Resolved {
        let mut sums = EdgeSums::default();
        parts.into_iter().for_each(|part| sums.add(part));
        let is_smooth = sums.edges_of_shape as f64 <= MOST_OF_SHAPE * sums.edges as f64;
        let mean_square = if sums.area > 0.0 { sums.squares / sums.area } else { 0.0 };
        let strain = self.problem.mean_pressure_of(self.pressure) / self.problem.effective_modulus(self.pressure);
        let relative_area = sums.area / self.grid.len() as f64;
        let rms_gradient_contact = if is_smooth { mean_square.max(0.0).sqrt() } else { f64::NAN };
        Resolved {
            relative_area,
            rms_gradient_contact,
            reduced_pressure_contact: strain / rms_gradient_contact,
            kappa_r: relative_area * rms_gradient_contact / strain,
            edges: sums.edges,
            edges_of_shape: sums.edges_of_shape,
            edge_error: sums.edge_error(),
        }
    }

    /// The area and the square gradients of a node in contact: those of its cell, cut off or extended at its `edges`, and
    /// no less than is needed to carry its pressure.
    fn share(&self, node: usize, edges: &[Edge], square_slope: &impl Fn(usize) -> f64) -> EdgeSums {
        let square = square_slope(node);
        let mut sums = EdgeSums::cell(square);
        // At saturated edges the cell is covered as far as it is loaded, once, however many links end here: so all cells of a plateau together carry
        // its pressure over its area, whatever the weights of the links.
        let weights: f64 = edges.iter().map(|edge| edge.weight).sum();
        for edge in edges {
            let beyond = match edge.filled {
                Some(filled) => edge.weight * (edge.place - (filled - 0.5)) - (1.0 - filled) * edge.weight / weights,
                None => edge.weight * (edge.place - 0.5),
            };
            let next = square_slope(self.grid.neighbour(node, edge.towards));
            sums.area += beyond;
            sums.squares += beyond * (square + 0.5 * (edge.place + 0.5) * (next - square));
            sums.edges += 1;
            sums.edges_of_shape += usize::from(edge.is_of_shape);
            sums.saturated += if edge.filled.is_some() { edge.weight } else { 0.0 };
            sums.limited += if edge.is_limited { edge.weight } else { 0.0 };
        }
        let least = (self.pressure[node] / self.problem.highest_pressure()).min(1.0);
        if sums.area > least { sums } else { EdgeSums { area: least, squares: least * square, ..sums } }
    }

    /// The edge on the link from a node in contact to one that is not.
    fn edge(&self, [node, next]: [usize; 2], towards: [isize; 2]) -> Edge {
        let link = [node, next].map(|node| self.side(node, towards));
        let EdgeNormal { cosine, weight } = self.normal([node, next], link, towards);
        let saturated = self.saturated([node, next], towards, cosine);
        let (p, g, law) = (link[0].pressure * cosine, link[1].gap, self.laws.at(towards, weight));
        let is_open = law.is_elastic() || law.stiffness * g > OPEN * p;
        let is_of_shape = saturated.is_none() && is_open && self.rises(node, towards);
        let limit = self.limit(node, towards) * cosine;
        // where nothing touches behind the edge, the limit is not known
        let is_limited = self.flows && saturated.is_none() && (limit < law.strength(p, g) || limit.is_infinite());
        let place = match saturated.and_then(SaturatedSide::place) {
            Some(place) => place,
            // the pressure of a solid that flows differs from node to node, and may rise towards the edge by chance
            None if is_of_shape && !is_limited => 0.5,
            None => law.place(p, law.strength(p, g).min(limit)),
        };
        let (place, filled) = (if place.is_finite() { place } else { 0.5 }, saturated.map(|side| side.filled));
        Edge { node, towards, place, weight, is_of_shape: is_of_shape && !is_limited, is_limited, filled }
    }

    /// The largest strength of an edge over a solid that flows, as a length in the law of edges; infinite over others.
    ///
    /// In an elastic solid the node behind the last one carries more than the strength `P + (pi / 2e) G` of the edge. Where the solid flows, the pressure at the
    /// edge is finite, the gap opens faster than by an elastic edge, and the strength that it pretends is never reached: the pressure of the last node
    /// grows with the distance of the edge up to that of the node behind it, and no farther. So that pressure is the strength.
    fn limit(&self, node: usize, [dy, dx]: [isize; 2]) -> f64 {
        let behind = self.pressure[self.grid.neighbour(node, [-dy, -dx])];
        match self.flows && behind > 0.0 {
            true => behind.max(self.pressure[node]) * along(self.per_modulus, [dy, dx]),
            false => f64::INFINITY,
        }
    }

    /// The two sides of a saturated edge; none where no plateau lies behind it, or the pressure falls to zero over more than a spacing.
    fn saturated(&self, [node, next]: [usize; 2], towards: [isize; 2], cosine: f64) -> Option<SaturatedSide> {
        let plateau = self.plateau(node, towards)?;
        // the gap of a node at the hardness is minus its overlap
        let opening = (self.gap)(next).max(0.0) + (-(self.gap)(node)).max(0.0);
        let unit = unit_of_opening(plateau * along(self.per_modulus, towards) * cosine);
        let side = SaturatedSide { filled: (self.pressure[node] / plateau).min(1.0), opening: opening / unit };
        side.place().map(|_| side)
    }

    /// The pressure of the plateau behind an edge, if there is one: the hardness where the last node or the one behind it is there.
    fn plateau(&self, node: usize, [dy, dx]: [isize; 2]) -> Option<f64> {
        let (law, behind) = (self.problem.law(), self.grid.neighbour(node, [-dy, -dx]));
        let is_there = [node, behind].iter().any(|&node| law.yields(self.pressure[node]));
        law.hardness().filter(|_| is_there)
    }

    /// The normal of the edge against the link.
    fn normal(&self, nodes: [usize; 2], link: [EdgeSide; 2], [dy, dx]: [isize; 2]) -> EdgeNormal {
        if self.grid.is_line() {
            return EdgeNormal::ALONG;
        }
        let aside = nodes.map(|node| {
            let [right, left, above, below] = self.grid.neighbours(node);
            let both = if dy == 0 { [above, below] } else { [right, left] };
            both.map(|node| self.side(node, [dy, dx]))
        });
        let spacing = self.grid.spacing();
        let ratio = along(spacing, [dy, dx]) / along(spacing, [dx, dy]);
        EdgeNormal::new(link, aside, ratio, |share| self.laws.at([dy, dx], share))
    }

    /// Pressure and gap of a node as lengths in the law of an edge across a link.
    fn side(&self, node: usize, towards: [isize; 2]) -> EdgeSide {
        let touches = self.touches(node);
        let gap = if touches { 0.0 } else { GAP_WEIGHT * (self.gap)(node).max(0.0) };
        EdgeSide { touches, pressure: self.pressure[node] * along(self.per_modulus, towards), gap }
    }

    /// Whether the pressure rises towards the edge over three nodes, as that of a punch does.
    fn rises(&self, node: usize, [dy, dx]: [isize; 2]) -> bool {
        let behind = |node: usize| self.grid.neighbour(node, [-dy, -dx]);
        let inner = behind(node);
        let before = self.pressure[inner];
        let is_behind = |first: f64| first > 0.0 && before >= first;
        self.pressure[node] >= before && is_behind(self.pressure[behind(inner)])
    }

    fn touches(&self, node: usize) -> bool {
        self.pressure[node] > 0.0
    }
}

/// The value along the axis of a step.
fn along([of_y, of_x]: [f64; 2], [dy, _]: [isize; 2]) -> f64 {
    if dy != 0 { of_y } else { of_x }
}

/// Steps from a node to its neighbours, in the order of [`Grid::neighbours`].
const STEPS: [[isize; 2]; 4] = [[0, 1], [0, -1], [1, 0], [-1, 0]];

/// Sums over nodes in contact.
#[derive(Default)]
struct EdgeSums {
    area: f64,
    squares: f64,
    edges: usize,
    edges_of_shape: usize,
    /// Length of the contour where it is saturated, in spacings, and where the flow of the solid limits its pressure.
    saturated: f64,
    limited: f64,
}

impl EdgeSums {
    /// The sums of one node in contact that has no edge: the area of its cell, and its square gradient.
    fn cell(square: f64) -> Self {
        Self { area: 1.0, squares: square, ..Self::default() }
    }

    /// The estimated relative error of the area by edges at which the pressure is limited.
    fn edge_error(&self) -> f64 {
        let error = SATURATED_ERROR * self.saturated.sqrt() + LIMITED_ERROR * self.limited;
        if self.area > 0.0 { error / self.area } else { 0.0 }
    }

    fn add(&mut self, other: Self) {
        self.area += other.area;
        self.squares += other.squares;
        self.edges += other.edges;
        self.edges_of_shape += other.edges_of_shape;
        self.saturated += other.saturated;
        self.limited += other.limited;
    }
}
