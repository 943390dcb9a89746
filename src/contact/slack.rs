//! The further sums over the nodes that a certificate is made of where the pressure has a ceiling.

use crate::contact::{Ceiling, Problem, chunks};

/// What a pressure `p` below a hardness `H_c` leaves to gain, and what it says of the level `lambda` at which nodes neither open nor
/// yield; `v = u - h`.
#[derive(Clone, Copy)]
pub(super) struct Slack {
    /// `G = <p max(v - lambda, 0)> + <(H_c - p) max(lambda - v, 0)>` with the best `lambda`, or at a datum `D` with
    /// `-D`; infinite if no node yields and it is not needed.
    pub gain: f64,
    /// `<m>` of the room `m = min(p, H_c - p)`.
    pub room: f64,
    /// `<m^2>`.
    pub square_room: f64,
    /// Minus the datum of the gap: `<m v> / <m>`, or where no node has room the middle between those that yield and those that do not.
    pub level: f64,
    /// The lowest `v` of the nodes that do not yield.
    pub lowest_v: f64,
    /// The largest pressure of a node divided by its ceiling.
    pub highest_share: f64,
    /// `<H_c - p>`.
    pub left: f64,
}

impl Slack {
    /// The sums of a pressure with its displacement, both row by row.
    pub(crate) fn new(problem: &Problem, pressure: &[f64], displacement: &[f64]) -> Self {
        let (ceiling, h) = (problem.ceiling(), problem.height());
        let share = |i: usize| ceiling.share(i, pressure[i]);
        let highest = chunks::visit(pressure.len(), |range| range.fold(0.0, |high: f64, i| high.max(share(i))));
        let highest_share = highest.into_iter().fold(0.0, f64::max);
        let level = level(problem, pressure, displacement);
        let lambda = match problem.datum() {
            Some(datum) => -datum,
            None if Ceiling::is_reached(highest_share) => threshold(problem, pressure, displacement),
            None => f64::NAN,
        };
        let n = pressure.len() as f64;
        let parts = chunks::visit(pressure.len(), |range| {
            let mut sums = Self::none(level, highest_share);
            range.for_each(|i| sums.add(ceiling, i, pressure[i], [displacement[i] - h[i], lambda]));
            sums
        });
        let sums = parts.into_iter().fold(Self::none(level, highest_share), Self::plus);
        let gain = if lambda.is_nan() { f64::INFINITY } else { sums.gain / n };
        Self { gain, room: sums.room / n, square_room: sums.square_room / n, left: sums.left / n, ..sums }
    }

    fn none(level: f64, highest_share: f64) -> Self {
        Self { gain: 0.0, room: 0.0, square_room: 0.0, level, lowest_v: f64::INFINITY, highest_share, left: 0.0 }
    }

    fn add(&mut self, ceiling: &Ceiling, node: usize, p: f64, [v, lambda]: [f64; 2]) {
        let room = ceiling.room(node, p);
        let left = (ceiling.at(node) - p).max(0.0);
        let more = if ceiling.yields(node, p) { 0.0 } else { left };
        self.left += left;
        self.gain += p * (v - lambda).max(0.0) + more * (lambda - v).max(0.0);
        self.room += room;
        self.square_room += room * room;
        if !ceiling.yields(node, p) {
            self.lowest_v = self.lowest_v.min(v);
        }
    }

    fn plus(self, other: Self) -> Self {
        Self {
            gain: self.gain + other.gain,
            room: self.room + other.room,
            square_room: self.square_room + other.square_room,
            lowest_v: self.lowest_v.min(other.lowest_v),
            left: self.left + other.left,
            ..self
        }
    }
}

/// The mean of `v = u - h` weighted by the room `min(p, H_c - p)` of a pressure, both fields row by row: by the pressure itself on a
/// hard wall. Below a hardness of which less than half is left in all, no node is open, and it is that of the highest node. Where no node has room it may lie anywhere between the nodes that yield and those that do not, and is the middle; NaN
/// where there is no pressure.
pub(super) fn level(problem: &Problem, pressure: &[f64], displacement: &[f64]) -> f64 {
    let (ceiling, height) = (problem.ceiling(), problem.height());
    if let Some(hardness) = problem.law().hardness()
        && chunks::sum(pressure.len(), |i| (hardness - pressure[i]).max(0.0)) <= 0.5 * hardness
    {
        return lengths(problem, displacement).into_iter().fold(f64::NEG_INFINITY, f64::max);
    }
    let load = chunks::sum(pressure.len(), |i| ceiling.room(i, pressure[i]));
    let share = |i: usize| ceiling.room(i, pressure[i]) / load * (displacement[i] - height[i]);
    let parts = chunks::visit(pressure.len(), |nodes| nodes.filter(|&i| pressure[i] != 0.0).map(share).sum::<f64>());
    match load {
        0.0 if ceiling.is_finite() => between(problem, pressure, displacement),
        0.0 => f64::NAN,
        _ => parts.into_iter().sum::<f64>(),
    }
}

/// The value of `v` up to which the lowest nodes, all at their ceilings, carry the load of a pressure.
fn threshold(problem: &Problem, pressure: &[f64], displacement: &[f64]) -> f64 {
    let (mut v, load) = (lengths(problem, displacement), chunks::sum(pressure.len(), |i| pressure[i]));
    match problem.ceiling() {
        Ceiling::Uniform(ceiling) => {
            let rank = ((load / ceiling).floor() as usize).min(v.len() - 1);
            *v.select_nth_unstable_by(rank, f64::total_cmp).1
        }
        Ceiling::Field(ceilings) => {
            let filled = filled(&v, ceilings);
            let last = filled.iter().find(|(_, carried)| *carried > load).or(filled.last());
            last.map_or(f64::NAN, |(v, _)| *v)
        }
    }
}

/// The middle between the nodes that carry the load of a pressure at their ceilings and the next one. Where all nodes do, the highest
/// of them; NaN where none does.
fn between(problem: &Problem, pressure: &[f64], displacement: &[f64]) -> f64 {
    let (mut v, load) = (lengths(problem, displacement), chunks::sum(pressure.len(), |i| pressure[i]));
    let [last, next] = match problem.ceiling() {
        Ceiling::Uniform(ceiling) => {
            let count = (load / ceiling).round() as usize;
            if count == 0 {
                return f64::NAN;
            }
            let rank = count.min(v.len() - 1);
            let (below, &mut next, _) = v.select_nth_unstable_by(rank, f64::total_cmp);
            let last = below.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            if count > rank { [next, next] } else { [last, next] }
        }
        Ceiling::Field(ceilings) => {
            let filled = filled(&v, ceilings);
            let distance = |i: &usize| (filled[*i].1 - load).abs();
            let Some(last) = (0..filled.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))) else {
                return f64::NAN;
            };
            [filled[last].0, filled[(last + 1).min(filled.len() - 1)].0]
        }
    };
    last + 0.5 * (next - last)
}

/// `v` of the nodes that may carry pressure, from the lowest on, each with the load of all up to it at their ceilings.
fn filled(v: &[f64], ceilings: &[f64]) -> Vec<(f64, f64)> {
    let mut nodes: Vec<_> = v.iter().copied().zip(ceilings.iter().copied()).filter(|(_, most)| *most > 0.0).collect();
    nodes.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let mut load = 0.0;
    nodes.iter_mut().for_each(|(_, most)| {
        load += *most;
        *most = load;
    });
    nodes
}

/// `v` of all nodes.
fn lengths(problem: &Problem, displacement: &[f64]) -> Vec<f64> {
    displacement.iter().zip(problem.height()).map(|(u, h)| u - h).collect()
}
