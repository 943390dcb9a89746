//! When waiting steps are written.

use rerun::log::ChunkBatcherConfig;
use std::time::{Duration, Instant};

/// Largest number of nodes of the steps that are written together: about one second of a solver. Each time some twenty
/// entities get a head of 1.8 kB, so that to write more often makes files longer.
const MOST: usize = 1 << 23;
/// Smallest number of nodes that a step counts for, so that at most 1024 steps are written together.
const LEAST: usize = 1 << 13;
/// Nodes of the steps that are written first.
const FIRST: usize = 1 << 21;
/// The longest time that a step waits for the next ones, so that slow runs can be viewed, and are not lost.
const LONGEST: Duration = Duration::from_secs(10);

/// When waiting steps are written.
#[derive(Clone, Copy)]
pub(crate) enum FlushPace {
    /// As steps come, so that a file does not depend on how busy the machine is. A run that is killed keeps half of its steps at the
    /// least, after the first few, and all but those of its last ten seconds where steps take long.
    Filed,
    /// At regular times, for a live viewer.
    Watched(Duration),
}

impl FlushPace {
    /// The pace of a viewer that runs.
    pub(crate) const SHOWN: Self = Self::Watched(Duration::from_millis(200));
    /// The pace of states, whether one takes a millisecond or an hour. A piece of the file for each entity of each state would take twice the time of
    /// quick histories: pieces have heads of kilobytes. A run that is killed loses the states of the last 0.2 s at most.
    pub(crate) const STATES: Self = Self::Watched(Duration::from_millis(200));
    /// The pace of the interactive page.
    #[cfg(feature = "explore")]
    pub(crate) const LIVE: Self = Self::Watched(Duration::from_millis(40));

    /// The time after which the SDK sends what it has gathered.
    pub(crate) fn tick(self) -> Duration {
        match self {
            Self::Filed => Duration::MAX,
            Self::Watched(_) => ChunkBatcherConfig::DEFAULT.flush_tick,
        }
    }
}

/// Steps that wait to be written.
pub(crate) struct Waiting {
    pace: FlushPace,
    since: Instant,
    /// Nodes of all steps so far, and those at which all is written next.
    nodes: usize,
    due: usize,
}

impl Waiting {
    pub(crate) fn new(pace: FlushPace) -> Self {
        Self { pace, since: Instant::now(), nodes: 0, due: FIRST }
    }

    /// Counts a step on `nodes` nodes. Returns true if the waiting steps should be written now.
    pub(crate) fn add(&mut self, nodes: usize) -> bool {
        self.nodes += nodes.max(LEAST);
        let is_due = match self.pace {
            FlushPace::Filed => self.nodes >= self.due || self.since.elapsed() >= LONGEST,
            FlushPace::Watched(interval) => self.since.elapsed() >= interval,
        };
        if is_due {
            self.due = self.nodes + self.nodes.min(MOST);
            self.since = Instant::now();
        }
        is_due
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(nodes: usize, steps: usize) -> Vec<usize> {
        let mut waiting = Waiting::new(FlushPace::Filed);
        (1..=steps).filter(|_| waiting.add(nodes)).collect()
    }

    #[test]
    fn a_killed_run_loses_half_of_its_steps_at_the_most_and_a_long_one_much_less() {
        assert_eq!(written(512, 4000), [256, 512, 1024, 2048, 3072]);
        assert_eq!(written(1 << 18, 100), [8, 16, 32, 64, 96]);
        assert_eq!(written(1 << 24, 4), [1, 2, 3, 4]);
    }
}
