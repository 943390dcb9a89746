//! The exchange of nodes between the sets: open, free, and yielding ones.

use super::level::Level;
use super::support::{RowOfValues, SparsePressure, Support};
use crate::chunks;
use std::ops::Range;

impl Level<'_> {
    /// Makes the set that of the pressure, and of the nodes where `v < lambda`; of those that yield, the ones where `v > lambda` are
    /// free again.
    pub(crate) fn admit(&mut self) {
        let lambda = self.lambda();
        self.exchange(lambda, |_| true);
    }

    /// Exchanges nodes after a correction. Where some yield, all that want it are exchanged only if they are fewer than ever
    /// before. Else, of neighbours in the order of nodes, the one that wants it most is: those that change together may overshoot
    /// together, and so for ever. If too few nodes were left to carry the load, none leaves. Returns whether the pressure changed, or the set.
    pub(crate) fn exchange_corrected(&mut self, lambda: f64) -> bool {
        if !self.pressure.reaches(self.ceiling()) {
            return self.exchange(lambda, |_| true);
        }
        let (urges, before) = (self.urges(lambda), self.pressure.clone());
        let n = urges.len();
        let count = urges.iter().filter(|urge| **urge > 0.0).count();
        let has_fewer = count < self.fewest;
        (self.has_fewer, self.fewest) = (has_fewer, self.fewest.min(count));
        let leads = |node: usize| urges[(node + n - 1) % n] < urges[node] && urges[(node + 1) % n] <= urges[node];
        let changed = self.exchange(lambda, |node| has_fewer || leads(node));
        let capacity = self.ceiling_on_set().total(self.pressure.values.len());
        if self.problem.mean_pressure().is_none_or(|mean_pressure| capacity >= mean_pressure * n as f64) {
            return changed;
        }
        self.pressure = before;
        chunks::update(&mut self.pressure.values, |_, p| p.iter_mut().for_each(|p| *p = p.max(0.0)));
        true
    }

    /// How far each node is beyond the bounds of its set, as a pressure; 0 where it is not. Gaps count by the pressure that the
    /// shortest wave needs for them.
    fn urges(&self, lambda: f64) -> Vec<f64> {
        let [_, stiffest] = self.problem.compliance().stiffness_range();
        let (u, h, ceiling) = (&self.u, self.problem.height(), self.ceiling());
        let depth = |node: usize| stiffest * (lambda - (u[node] - h[node]));
        let mut urges = vec![0.0; u.len()];
        let enters = |node: usize| if ceiling.at(node) > 0.0 { depth(node).max(0.0) } else { 0.0 };
        chunks::update(&mut urges, |range, urges| range.zip(urges).for_each(|(i, urge)| *urge = enters(i)));
        let SparsePressure { support, values } = &self.pressure;
        let [_, width] = support.shape();
        chunks::rows_mut(&mut urges, width, |row, urges| {
            for (run, at) in support.runs(row) {
                for (x, &p) in run.zip(&values[at]) {
                    let ceiling = ceiling.at(row * width + x);
                    let beyond = if p == ceiling { -depth(row * width + x) } else { (-p).max(p - ceiling) };
                    urges[x] = beyond.max(0.0);
                }
            }
        });
        urges
    }

    /// Takes nodes out of the set that have no pressure and in that have `v < lambda`; lets those yield that are above the ceiling, where
    /// [`SparsePressure::carry`] cuts them, frees those that yield and have `v > lambda`: as far as they `may`. Returns whether the
    /// pressure changed by that, or the set.
    pub(crate) fn exchange(&mut self, lambda: f64, may: impl Fn(usize) -> bool + Sync) -> bool {
        let (u, h, SparsePressure { support, values }) = (&self.u, self.problem.height(), &self.pressure);
        let (ceiling, on_set) = (self.ceiling(), self.ceiling_on_set());
        let mut changed = ceiling.is_finite() && values.iter().enumerate().any(|(i, &p)| p > on_set.at(i));
        let [count, width] = support.shape();
        let (support, values) = Support::choose_values([count, width], |row, nodes| {
            let at = row * width;
            let (u, h) = (&u[at..at + width], &h[at..at + width]);
            let mut column = 0;
            let enter = |columns: Range<usize>, nodes: &mut RowOfValues| {
                let enters = |x: &usize| u[*x] - h[*x] < lambda && ceiling.at(at + x) > 0.0 && may(at + x);
                columns.filter(enters).for_each(|x| nodes.push(x, 0.0));
            };
            for (run, entries) in support.runs(row) {
                enter(column..run.start, nodes);
                column = run.end;
                for (x, &p) in run.zip(&values[entries]) {
                    let (v, below, ceiling) = (u[x] - h[x], ceiling.below(at + x), ceiling.at(at + x));
                    if p > 0.0 || p == 0.0 && v < lambda {
                        // freed, or not to yield yet
                        let is_below =
                            if p == ceiling { v > lambda && may(at + x) } else { p > ceiling && !may(at + x) };
                        nodes.push(x, if is_below { below } else { p });
                    } else if p < 0.0 && !may(at + x) {
                        nodes.push(x, 0.0);
                    }
                }
            }
            enter(column..width, nodes);
        });
        changed |= support != self.pressure.support;
        self.pressure = SparsePressure { support, values };
        changed
    }
}
