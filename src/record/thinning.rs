//! Which steps are drawn in full.

/// Picks the steps whose fields are recorded: each n-th, or densely at first and ever more sparsely later.
#[derive(Debug, Clone)]
pub struct Thinning {
    pace: Pace,
    next: usize,
}

/// How far apart frames are.
#[derive(Debug, Clone, Copy)]
pub enum Pace {
    /// Each n-th step; 0 counts as 1.
    Every(usize),
    /// All of the first `dense` steps, then `per_decade` frames for ten times as many steps.
    Geometric {
        /// Steps drawn one by one.
        dense: usize,
        /// Frames per decade after that.
        per_decade: f64,
    },
}

impl Pace {
    /// For lines, whose frames take some 30 kB: 68 frames of 1000 steps, 116 of 100 000.
    pub const LINE: Self = Self::Geometric { dense: 32, per_decade: 24.0 };
    /// For surfaces, whose frames take up to 2 MB: half as many.
    pub const SURFACE: Self = Self::Geometric { dense: 16, per_decade: 12.0 };
}

impl Thinning {
    /// A schedule that starts with step 0.
    pub fn new(pace: Pace) -> Self {
        Self { pace, next: 0 }
    }

    /// Whether the step of this index is drawn. Indices must rise.
    pub fn picks(&mut self, index: usize) -> bool {
        if index < self.next {
            return false;
        }
        self.next = match self.pace {
            Pace::Every(every) => (index / every.max(1) + 1) * every.max(1),
            Pace::Geometric { dense, .. } if index < dense => index + 1,
            Pace::Geometric { per_decade, .. } => (index as f64 * 10f64.powf(1.0 / per_decade)).ceil() as usize,
        };
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frames(pace: Pace, steps: usize) -> Vec<usize> {
        let mut thinning = Thinning::new(pace);
        (0..steps).filter(|&i| thinning.picks(i)).collect()
    }

    #[test]
    fn the_automatic_schedule_is_dense_then_geometric() {
        let picked = frames(Pace::LINE, 100_000);
        assert!(picked[..=32].iter().copied().eq(0..=32));
        assert!((100..=150).contains(&picked.len()), "{}", picked.len());
        assert!(picked.windows(2).skip(40).all(|w| w[1] as f64 / w[0] as f64 <= 1.14));
        assert!((50..=75).contains(&frames(Pace::SURFACE, 100_000).len()));
    }

    #[test]
    fn each_nth_step_is_picked() {
        assert_eq!(frames(Pace::Every(4), 10), [0, 4, 8]);
        assert_eq!(frames(Pace::Every(0), 3), [0, 1, 2]);
    }
}
