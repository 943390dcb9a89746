//! The times of the states of a history on a time line.

use rerun::{RecordingStream, TimeCell, TimelineName};
use std::collections::BTreeMap;

/// The time line in seconds, and the nanoseconds in one.
const SECONDS: &str = "time";
const PER_SECOND: f64 = 1e9;
/// Ticks of a time line in the shortest difference of two times, at least.
const RESOLVED: f64 = 100.0;
/// The first tick that a time line can have.
const FIRST: i64 = i64::MIN + 1;
/// The last tick, below the largest whole number of 64 bits.
const LAST: f64 = 9e18;
/// The largest and the smallest power of ten of a tick.
const POWERS: [i32; 2] = [-306, 306];

/// The part of the shortest way between two points of a path that its steps are expected to be.
const SHORTEST_STEP: f64 = 1e-3;

/// The times of states as ticks of a time line, each at its own tick.
///
/// The ticks are nanoseconds, and the time line `time` is a duration, where these resolve the times. Otherwise it counts a power of a
/// thousand of the unit of the times, such as `time in 1e-18 s`, that resolves the shortest difference of two times and reaches to the last
/// one. States that no tick separates, such as those before and after a jump, stand one tick apart.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct StateTimes {
    /// The ticks of the states, by their numbers.
    ticks: BTreeMap<usize, i64>,
    /// The power of ten of a tick; none for nanoseconds.
    power: Option<i32>,
}

impl StateTimes {
    /// The time line of a path between some times, from 0 on.
    pub(crate) fn new(path: &[f64]) -> Self {
        let mut sorted: Vec<f64> = path.iter().copied().filter(|time| time.is_finite()).chain([0.0]).collect();
        sorted.sort_by(f64::total_cmp);
        let differences = sorted.windows(2).map(|pair| pair[1] - pair[0]).filter(|difference| *difference > 0.0);
        let shortest = differences.fold(f64::INFINITY, f64::min);
        let longest = sorted.iter().map(|time| time.abs()).fold(0.0, f64::max);
        Self { ticks: BTreeMap::new(), power: power_of_tick(SHORTEST_STEP * shortest, longest) }
    }

    /// Gives a state its tick: that of its time, or the one after the tick of the state before.
    pub(crate) fn add(&mut self, state: usize, time: f64) {
        let of_tick = |time: f64| self.power.map_or(time * PER_SECOND, |power| time / 10f64.powi(power));
        let own = if time.is_finite() { of_tick(time).round() as i64 } else { FIRST };
        let before = self.ticks.range(..state).next_back();
        let next = before.map_or(FIRST, |(_, tick)| tick.saturating_add(1));
        self.ticks.insert(state, own.max(next));
    }

    /// Sets the time of a stream to that of a state, if it has one.
    pub(crate) fn turn(&self, stream: &RecordingStream, state: usize) {
        let (Some(&tick), Ok(name)) = (self.ticks.get(&state), TimelineName::try_new(self.name())) else { return };
        let cell =
            if self.power.is_none() { TimeCell::from_duration_nanos(tick) } else { TimeCell::from_sequence(tick) };
        stream.set_time(name, cell);
    }

    /// The name of the time line, with the unit of its ticks if they are no nanoseconds.
    fn name(&self) -> String {
        self.power.map_or(SECONDS.into(), |power| format!("{SECONDS} in {} s", in_words(power)))
    }

    /// What a reader of the recording has to know, in Markdown; empty for nanoseconds.
    pub(crate) fn note(&self) -> String {
        let Some(unit) = self.power.map(in_words) else { return String::new() };
        format!(
            "The time line `{}` counts steps of {unit} s, or of {unit} of the unit of the times if they are not in seconds. The exact times \
             are the values of `/load/value`.",
            self.name()
        )
    }
}

fn in_words(power: i32) -> String {
    if power == 0 { "1".into() } else { format!("1e{power}") }
}

/// The power of ten of a tick that resolves the shortest difference of two times and reaches to the longest time; none for nanoseconds.
fn power_of_tick(shortest: f64, longest: f64) -> Option<i32> {
    let is_fine = shortest * PER_SECOND >= RESOLVED;
    if is_fine && longest * PER_SECOND <= LAST {
        return None;
    }
    let fine = ((shortest / RESOLVED).log10() / 3.0).floor().min(0.0);
    let far = ((longest / LAST).log10() / 3.0).ceil();
    let [least, most] = POWERS;
    Some(3 * (fine.max(far) as i32).clamp(least / 3, most / 3))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The ticks of states on the time line of a path.
    fn on_path(path: &[f64], times: &[f64]) -> StateTimes {
        let mut found = StateTimes::new(path);
        times.iter().enumerate().for_each(|(state, time)| found.add(state, *time));
        found
    }

    fn is_rising(found: &StateTimes) -> bool {
        found.ticks.values().zip(found.ticks.values().skip(1)).all(|(before, after)| before < after)
    }

    /// The times that the ticks of a time line stand for.
    fn read_back(found: &StateTimes) -> Vec<f64> {
        let tick = found.power.map_or(1e-9, |power| 10f64.powi(power));
        found.ticks.values().map(|it| *it as f64 * tick).collect()
    }

    #[test]
    fn every_state_has_a_tick_of_its_own_near_its_time() {
        let even = |step: f64| (0..50).map(|i| f64::from(i) * step).collect::<Vec<_>>();
        let graded = |first: f64, last: f64| {
            let ratio = (last / first).powf(1.0 / 49.0);
            [0.0].into_iter().chain((0..50).map(|i| first * ratio.powi(i))).collect::<Vec<_>>()
        };
        let cases = [
            (even(1e-3), "time"),
            (even(1e-15), "time in 1e-21 s"),
            (even(2e-11), "time in 1e-18 s"),
            (even(1e15), "time in 1 s"),
            (even(1e25), "time in 1e9 s"),
            (graded(1e-9, 1e3), "time in 1e-15 s"),
            (graded(1e-12, 1e-3), "time in 1e-18 s"),
            (even(3e-250), "time in 1e-255 s"),
        ];
        for (times, name) in cases {
            let found = on_path(&times, &times);
            assert_eq!(found.name(), name);
            assert!(is_rising(&found), "{name}");
            let shortest = times.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
            let back = read_back(&found);
            assert!(
                times.iter().zip(&back).all(|(time, back)| (time - back).abs() < 0.01 * shortest + 1e-15 * time),
                "{name}"
            );
            assert_eq!(found.note().is_empty(), name == "time");
        }
    }

    #[test]
    fn jumps_and_times_that_no_tick_separates_do_not_collide() {
        let found = on_path(&[2.0], &[0.0, 0.0, 1.0, 1.0, 1.0, 2.0]);
        let ticks: Vec<i64> = found.ticks.values().copied().collect();
        assert_eq!(ticks, [0, 1, 1_000_000_000, 1_000_000_001, 1_000_000_002, 2_000_000_000]);
        let apart = [0.0, 1e-15, 3e-15, 1e15, 2e15];
        assert!(is_rising(&on_path(&apart, &apart)) && is_rising(&on_path(&[1.0], &apart[..3])));
        for odd in [vec![], vec![0.0], vec![f64::NAN, 1.0, f64::INFINITY], vec![5e-324, 1e-323, 1e308, 1.7e308]] {
            let found = on_path(&odd, &odd);
            let distinct: std::collections::BTreeSet<_> = found.ticks.values().collect();
            assert_eq!(distinct.len(), odd.len(), "{odd:?}: {found:?}");
        }
    }
}
