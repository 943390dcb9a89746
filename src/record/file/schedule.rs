//! The steps whose fields are drawn.

use crate::grid::Grid;
use std::collections::BTreeMap;

/// Frames that become less frequent: all of the first `dense` steps, then `per_decade` frames for ten times as many
/// steps; fewer on coarse grids.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Schedule {
    dense: usize,
    per_decade: f64,
}

/// Picks the steps whose fields are recorded: each n-th if n is given (0 counts as 1), or those of a schedule on each grid
/// level.
pub(crate) struct Thinning {
    every: Option<usize>,
    schedule: Schedule,
    /// Steps seen of each level.
    seen: BTreeMap<usize, usize>,
}

impl Schedule {
    /// The schedule of lines, whose frames take some 30 kB: 68 frames of 1000 steps, 116 of 100 000.
    const LINE: Self = Self { dense: 32, per_decade: 24.0 };
    /// The schedule of surfaces, whose frames take up to 2 MB: half as many.
    const SURFACE: Self = Self { dense: 16, per_decade: 12.0 };

    /// The schedule on `grid`.
    pub(crate) fn on(grid: &Grid) -> Self {
        if grid.is_line() { Self::LINE } else { Self::SURFACE }
    }

    /// Largest number of frames, for a number of steps on the finest grid above `coarser` ones, each of which is left
    /// after some tens of steps and four frames; the last state counts.
    pub(crate) fn most_frames(self, steps: usize, coarser: usize) -> usize {
        let decades = (steps.max(self.dense) as f64 / self.dense as f64).log10();
        steps.min(self.dense) + (self.per_decade * decades).ceil() as usize + 1 + 4 * coarser
    }
}

impl Thinning {
    /// Frames of the finest grid for each frame of a coarse one.
    const COARSE: usize = 6;

    pub(crate) fn new(every: Option<usize>, schedule: Schedule) -> Self {
        Self { every, schedule, seen: BTreeMap::new() }
    }

    /// Whether no step of this level was seen yet.
    pub(crate) fn is_new(&self, level: usize) -> bool {
        !self.seen.contains_key(&level)
    }

    /// Whether the step of this index, the next one seen of `level`, is drawn.
    pub(crate) fn picks(&mut self, index: usize, level: usize) -> bool {
        let seen = self.seen.entry(level).or_default();
        *seen += 1;
        if let Some(every) = self.every {
            return index.is_multiple_of(every.max(1));
        }
        let Schedule { dense, per_decade } = self.schedule;
        let fewer = if level == 0 { 1 } else { Self::COARSE };
        let place = |n: usize| (per_decade / fewer as f64 * (n as f64).log10()).floor();
        *seen <= dense / fewer || place(*seen) > place(*seen - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frames(every: Option<usize>, schedule: Schedule, steps: usize) -> Vec<usize> {
        let mut thinning = Thinning::new(every, schedule);
        (0..steps).filter(|&i| thinning.picks(i, 0)).collect()
    }

    #[test]
    fn the_automatic_schedule_is_dense_then_geometric() {
        let picked = frames(None, Schedule::LINE, 100_000);
        assert!(picked[..32].iter().copied().eq(0..32));
        assert!((100..=150).contains(&picked.len()), "{}", picked.len());
        assert!(picked.windows(2).skip(40).all(|w| w[1] as f64 / w[0] as f64 <= 1.14));
        assert!((50..=75).contains(&frames(None, Schedule::SURFACE, 100_000).len()));
        for steps in [5, 16, 100, 1234, 100_000] {
            for schedule in [Schedule::LINE, Schedule::SURFACE] {
                let (made, most) = (frames(None, schedule, steps).len() + 1, schedule.most_frames(steps, 0));
                assert!((made..=made + 2).contains(&most), "{made} frames of {steps} steps, not {most}");
            }
        }
    }

    #[test]
    fn each_nth_step_is_picked() {
        assert_eq!(frames(Some(4), Schedule::LINE, 10), [0, 4, 8]);
        assert_eq!(frames(Some(0), Schedule::LINE, 3), [0, 1, 2]);
    }

    #[test]
    fn each_level_starts_anew_and_many_levels_stay_affordable() {
        let mut thinning = Thinning::new(None, Schedule::LINE);
        let mut frames = 0;
        for level in (0..12).rev() {
            assert!(thinning.is_new(level));
            let picked: Vec<usize> = (0..300).filter(|&i| thinning.picks(i, level)).collect();
            assert!(picked.starts_with(&[0, 1, 2]) && !thinning.is_new(level), "{level}: {picked:?}");
            frames += picked.len() + 1;
        }
        assert!((100..250).contains(&frames), "{frames}");
    }
}
