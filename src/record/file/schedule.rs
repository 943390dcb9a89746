//! The steps whose fields are drawn.

use crate::grid::Grid;
use std::collections::BTreeMap;

/// Picks the steps whose fields are recorded: each n-th, or on each grid level densely at first and ever more sparsely
/// later.
#[derive(Debug, Clone)]
pub struct Thinning {
    schedule: Schedule,
    /// Steps seen of each level.
    seen: BTreeMap<usize, usize>,
}

/// Distance from frame to frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Schedule {
    /// Each n-th step; 0 counts as 1.
    Every(usize),
    /// All of the first `dense` steps, then `per_decade` frames for ten times as many steps; fewer on coarse grids.
    Geometric {
        /// Steps drawn one by one.
        dense: usize,
        /// Frames per decade after that.
        per_decade: f64,
    },
}

impl Schedule {
    /// The schedule of lines, whose frames take some 30 kB: 68 frames of 1000 steps, 116 of 100 000.
    pub const LINE: Self = Self::Geometric { dense: 32, per_decade: 24.0 };
    /// The schedule of surfaces, whose frames take up to 2 MB: half as many.
    pub const SURFACE: Self = Self::Geometric { dense: 16, per_decade: 12.0 };
    /// Frames of a coarse grid, which is left after some tens of steps.
    const COARSE: usize = 4;

    /// The schedule on `grid` unless the caller says otherwise.
    pub fn on(grid: &Grid) -> Self {
        if grid.is_line() { Self::LINE } else { Self::SURFACE }
    }

    /// Frames at the most, of so many steps on the finest grid above `coarser` ones; the last state counts.
    pub fn most_frames(self, steps: usize, coarser: usize) -> usize {
        match self {
            Self::Every(every) => steps / every.max(1) + 1 + coarser,
            Self::Geometric { dense, per_decade } => {
                let decades = (steps.max(dense) as f64 / dense as f64).log10();
                steps.min(dense) + (per_decade * decades).ceil() as usize + 1 + Self::COARSE * coarser
            }
        }
    }
}

impl Thinning {
    /// Frames of the finest grid for each frame of a coarse one.
    const COARSE: usize = 6;

    /// The choice of `schedule`, before the first step.
    pub fn new(schedule: Schedule) -> Self {
        Self { schedule, seen: BTreeMap::new() }
    }

    /// Whether no step of this level was seen yet.
    pub fn is_new(&self, level: usize) -> bool {
        !self.seen.contains_key(&level)
    }

    /// Whether the step of this index, the next one seen of `level`, is drawn.
    pub fn picks(&mut self, index: usize, level: usize) -> bool {
        let seen = self.seen.entry(level).or_default();
        *seen += 1;
        match self.schedule {
            Schedule::Every(every) => index.is_multiple_of(every.max(1)),
            Schedule::Geometric { dense, per_decade } => {
                let fewer = if level == 0 { 1 } else { Self::COARSE };
                let place = |n: usize| (per_decade / fewer as f64 * (n as f64).log10()).floor();
                *seen <= dense / fewer || place(*seen) > place(*seen - 1)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frames(schedule: Schedule, steps: usize) -> Vec<usize> {
        let mut thinning = Thinning::new(schedule);
        (0..steps).filter(|&i| thinning.picks(i, 0)).collect()
    }

    #[test]
    fn the_automatic_schedule_is_dense_then_geometric() {
        let picked = frames(Schedule::LINE, 100_000);
        assert!(picked[..32].iter().copied().eq(0..32));
        assert!((100..=150).contains(&picked.len()), "{}", picked.len());
        assert!(picked.windows(2).skip(40).all(|w| w[1] as f64 / w[0] as f64 <= 1.14));
        assert!((50..=75).contains(&frames(Schedule::SURFACE, 100_000).len()));
        for steps in [5, 16, 100, 1234, 100_000] {
            for schedule in [Schedule::LINE, Schedule::SURFACE] {
                let (made, most) = (frames(schedule, steps).len() + 1, schedule.most_frames(steps, 0));
                assert!((made..=made + 2).contains(&most), "{made} frames of {steps} steps, not {most}");
            }
        }
    }

    #[test]
    fn each_nth_step_is_picked() {
        assert_eq!(frames(Schedule::Every(4), 10), [0, 4, 8]);
        assert_eq!(frames(Schedule::Every(0), 3), [0, 1, 2]);
    }

    #[test]
    fn each_level_starts_anew_and_many_levels_stay_affordable() {
        let mut thinning = Thinning::new(Schedule::LINE);
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
