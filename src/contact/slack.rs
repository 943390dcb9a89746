//! The sums over the nodes that a certificate is made of besides, where the pressure has a ceiling.

use crate::contact::{Law, Problem, chunks};

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
    pub highest_pressure: f64,
}

impl Slack {
    /// The sums of a pressure with its displacement, both row by row.
    pub fn new(problem: &Problem, pressure: &[f64], displacement: &[f64]) -> Self {
        let (law, h) = (problem.law(), problem.height());
        let highest = chunks::visit(pressure.len(), |range| range.fold(0.0, |high: f64, i| high.max(pressure[i])));
        let highest_pressure = highest.into_iter().fold(0.0, f64::max);
        let level = level(problem, pressure, displacement);
        let lambda = match problem.datum() {
            Some(datum) => -datum,
            None if law.yields(highest_pressure) => threshold(problem, pressure, displacement),
            None => f64::NAN,
        };
        let n = pressure.len() as f64;
        let parts = chunks::visit(pressure.len(), |range| {
            let mut sums = Self::none(level, highest_pressure);
            range.for_each(|i| sums.add(law, pressure[i], displacement[i] - h[i], lambda));
            sums
        });
        let sums = parts.into_iter().fold(Self::none(level, highest_pressure), Self::plus);
        let gain = if lambda.is_nan() { f64::INFINITY } else { sums.gain / n };
        Self { gain, room: sums.room / n, square_room: sums.square_room / n, ..sums }
    }

    fn none(level: f64, highest_pressure: f64) -> Self {
        Self { gain: 0.0, room: 0.0, square_room: 0.0, level, lowest_v: f64::INFINITY, highest_pressure }
    }

    fn add(&mut self, law: Law, p: f64, v: f64, lambda: f64) {
        let room = law.room(p);
        self.gain += p * (v - lambda).max(0.0) + (law.ceiling() - p).max(0.0) * (lambda - v).max(0.0);
        self.room += room;
        self.square_room += room * room;
        if !law.yields(p) {
            self.lowest_v = self.lowest_v.min(v);
        }
    }

    fn plus(self, other: Self) -> Self {
        Self {
            gain: self.gain + other.gain,
            room: self.room + other.room,
            square_room: self.square_room + other.square_room,
            lowest_v: self.lowest_v.min(other.lowest_v),
            ..self
        }
    }
}

/// The mean of `v = u - h` weighted by the room `min(p, H_c - p)` of a pressure, both fields row by row: by the pressure itself on a
/// hard wall. Where no node has room it may lie anywhere between the nodes that yield and those that do not, and is the middle; NaN
/// where there is no pressure.
pub(super) fn level(problem: &Problem, pressure: &[f64], displacement: &[f64]) -> f64 {
    let (law, height) = (problem.law(), problem.height());
    let load = chunks::sum(pressure.len(), |i| law.room(pressure[i]));
    let share = |i: usize| law.room(pressure[i]) / load * (displacement[i] - height[i]);
    let parts = chunks::visit(pressure.len(), |nodes| nodes.filter(|&i| pressure[i] != 0.0).map(share).sum::<f64>());
    match load {
        0.0 if law.hardness().is_some() => between(problem, pressure, displacement),
        0.0 => f64::NAN,
        _ => parts.into_iter().sum::<f64>(),
    }
}

/// The value of `v` up to which the lowest nodes, all at the hardness, carry the load of a pressure.
fn threshold(problem: &Problem, pressure: &[f64], displacement: &[f64]) -> f64 {
    let (mut v, count) = (lengths(problem, displacement), count(problem, pressure));
    let rank = (count.floor() as usize).min(v.len() - 1);
    *v.select_nth_unstable_by(rank, f64::total_cmp).1
}

/// The middle between the nodes that carry the load of a pressure at the hardness and the next one. Where all nodes do, the highest
/// of them; NaN where none does.
fn between(problem: &Problem, pressure: &[f64], displacement: &[f64]) -> f64 {
    let (mut v, count) = (lengths(problem, displacement), count(problem, pressure).round() as usize);
    if count == 0 {
        return f64::NAN;
    }
    let rank = count.min(v.len() - 1);
    let (below, &mut next, _) = v.select_nth_unstable_by(rank, f64::total_cmp);
    let last = below.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if count > rank { next } else { last + 0.5 * (next - last) }
}

/// `v` of all nodes.
fn lengths(problem: &Problem, displacement: &[f64]) -> Vec<f64> {
    displacement.iter().zip(problem.height()).map(|(u, h)| u - h).collect()
}

/// Nodes at the hardness that would carry the load.
fn count(problem: &Problem, pressure: &[f64]) -> f64 {
    chunks::sum(pressure.len(), |i| pressure[i]) / problem.law().ceiling()
}
