//! Contact sets that recur.

use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};

/// Finds contact sets that recur in a run.
#[derive(Debug, Clone, Default)]
pub(crate) struct Returns {
    /// When each set was there last, by its hash.
    last: HashMap<u64, usize>,
    previous: Option<u64>,
    /// Sets so far.
    count: usize,
    period: usize,
    /// Consecutive sets that came back after the period, and the step of the first.
    run: usize,
    first: usize,
    longest: Option<Cycle>,
}

/// A cycle of contact sets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Cycle {
    /// Changes of the set until it is the same again.
    pub period: usize,
    /// The number of times that the cycle was repeated.
    pub rounds: usize,
    /// The step at which it began.
    pub from: usize,
}

impl Returns {
    /// Adds the contact set of a step.
    pub(crate) fn add(&mut self, step: usize, pressure: &[f64]) {
        let mut hasher = DefaultHasher::new();
        for nodes in pressure.chunks(64) {
            nodes.iter().fold(0u64, |bits, &p| bits << 1 | u64::from(p > 0.0)).hash(&mut hasher);
        }
        let set = hasher.finish();
        if self.previous == Some(set) {
            return;
        }
        self.previous = Some(set);
        let period = self.last.insert(set, self.count).map_or(0, |last| self.count - last);
        self.count += 1;
        if period == 0 || period != self.period {
            (self.period, self.run, self.first) = (period, 0, step);
        }
        if period > 0 {
            self.run += 1;
            let cycle = Cycle { period, rounds: self.run / period, from: self.first };
            if cycle.rounds > self.longest.map_or(0, |longest| longest.rounds) {
                self.longest = Some(cycle);
            }
        }
    }

    /// The cycle that was gone through most often.
    pub(crate) fn cycle(&self) -> Option<Cycle> {
        self.longest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_that_come_back_are_counted_and_those_that_stay_are_not() {
        let set = |number: u32| (0..70).map(|i| f64::from(number >> (i % 32) & 1)).collect::<Vec<_>>();
        let mut returns = Returns::default();
        (0..50).for_each(|step| returns.add(step, &set(1)));
        (0..50).for_each(|step| returns.add(50 + step, &set(step as u32)));
        assert_eq!(returns.cycle().map(|cycle| cycle.rounds), None);
        (0..30).for_each(|step| returns.add(100 + step, &set(1000 + step as u32 % 3)));
        let cycle = returns.cycle().unwrap();
        assert_eq!((cycle.period, cycle.rounds, cycle.from), (3, 9, 103));
    }
}
