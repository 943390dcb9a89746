//! The axis of the loads of a recording.

use crate::plot::{Axis, AxisScale};
use crate::record::draw::fields::range;
use crate::record::units::{FittingUnit, with_unit};

/// The quantity that distinguishes the loads, and its value at each load, in order. A value that has no place on the
/// axis leaves its load without one. Where the values come one after the other, the axis has room for expected ones.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadAxis {
    /// Name of the quantity.
    pub name: String,
    /// Unit of the values, such as `Pa`; empty if there is none. The axis shows them in the power of a thousand that fits them.
    pub unit: String,
    /// Spacing of the values.
    pub scale: AxisScale,
    /// Values of all loads that are known.
    pub values: Vec<f64>,
    /// Values that are expected, such as the ends of a path: the axis reaches over them until the recording ends.
    pub expected: Vec<f64>,
}

/// Half of the room of a load that is alone, in decades or over its value.
const ALONE: f64 = 0.5;

impl LoadAxis {
    /// Loads on a logarithmic axis.
    pub fn log(name: impl Into<String>, values: Vec<f64>) -> Self {
        Self { name: name.into(), unit: String::new(), scale: AxisScale::Log, values, expected: Vec::new() }
    }

    /// Loads on a linear axis.
    pub fn linear(name: impl Into<String>, values: Vec<f64>) -> Self {
        Self { name: name.into(), unit: String::new(), scale: AxisScale::Linear, values, expected: Vec::new() }
    }

    /// The axis of values in a unit.
    pub fn with_unit(self, unit: &str) -> Self {
        Self { unit: unit.into(), ..self }
    }

    /// The axis with room for values that are expected.
    pub fn expecting(self, expected: Vec<f64>) -> Self {
        Self { expected, ..self }
    }

    /// Takes the value of a load that has come. Where it lies beyond those that were expected, the axis becomes twice as long, so that it
    /// changes seldom, however many loads come.
    pub(in crate::record) fn place(&mut self, load: usize, value: f64) {
        if load >= self.values.len() {
            self.values.resize(load + 1, f64::NAN);
        }
        self.values[load] = value;
        let [low, high] = range(self.expected.iter().copied());
        if value > high && low < high {
            self.expected.push(value + (value - low));
        }
    }

    /// The same axis with room for the values that came and for no others.
    pub(in crate::record) fn settled(&self) -> Self {
        Self { expected: Vec::new(), ..self.clone() }
    }

    /// The name of the quantity with the unit of the numbers along the axis.
    pub(in crate::record) fn title(&self) -> String {
        with_unit(&self.name, &self.fitting().name)
    }

    /// The number of a load along the axis.
    pub(in crate::record) fn number(&self, load: usize) -> Option<f64> {
        Some(*self.values.get(load)? / self.size())
    }

    /// The value at the number 1 of the axis.
    pub(in crate::record) fn size(&self) -> f64 {
        self.fitting().size
    }

    /// The unit along the axis.
    fn fitting(&self) -> FittingUnit {
        let all = self.values.iter().chain(&self.expected);
        let sizes = all.map(|value| value.abs()).filter(|size| size.is_finite());
        FittingUnit::new(&self.unit, sizes.fold(0.0, f64::max))
    }

    /// The axis over the rooms of some loads.
    pub(in crate::record) fn over(&self, loads: impl IntoIterator<Item = usize>) -> Axis {
        let rooms = loads.into_iter().filter_map(|load| self.room(load)).flatten();
        let size = self.size();
        let expected = self.expected.iter().map(|value| value / size);
        match range(rooms.chain(expected)) {
            ends @ [low, high] if low < high => Axis { name: self.title(), scale: self.scale, range: ends },
            _ => Axis::linear(self.title(), [0.0, 1.0]),
        }
    }

    /// The axis over all loads.
    pub(in crate::record) fn whole(&self) -> Axis {
        self.over(0..self.values.len())
    }

    /// The values half-way from a load to those beside it, the smaller one first.
    pub(in crate::record) fn room(&self, load: usize) -> Option<[f64; 2]> {
        let own = self.level(load)?;
        let beside = [load.checked_sub(1), load.checked_add(1)].map(|other| Some(0.5 * (self.level(other?)? - own)));
        let alone = match self.scale {
            AxisScale::Log => ALONE,
            AxisScale::Linear if own == 0.0 => ALONE,
            AxisScale::Linear => ALONE * own.abs(),
        };
        let [before, after] = match beside {
            [Some(before), Some(after)] if before * after > 0.0 => [before, -after], // where the load turns back
            [Some(before), Some(after)] => [before, after],
            [Some(one), None] | [None, Some(one)] => [-one, one],
            [None, None] => [-alone, alone],
        };
        let ends = [own + before, own + after].map(|level| match self.scale {
            AxisScale::Linear => level,
            AxisScale::Log => 10f64.powf(level),
        });
        Some([ends[0].min(ends[1]), ends[0].max(ends[1])])
    }

    /// The value of a load, or its logarithm, where it has one.
    fn level(&self, load: usize) -> Option<f64> {
        let value = self.number(load)?;
        let level = match self.scale {
            AxisScale::Linear => value,
            AxisScale::Log => value.log10(),
        };
        level.is_finite().then_some(level)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_load_that_turns_back_has_room_on_both_sides() {
        let there_and_back = LoadAxis::linear("d", vec![1.0, 2.0, 1.0]);
        assert_eq!(there_and_back.room(1), Some([1.5, 2.5]));
    }

    #[test]
    fn values_are_shown_in_the_unit_that_fits_them() {
        let pressures = LoadAxis::log("mean pressure", vec![1e5, 1e6, 2e7]).with_unit("Pa");
        let gaps = LoadAxis::linear("mean gap", vec![2e-7, 1e-7]).with_unit("m");
        assert_eq!((pressures.title(), pressures.number(2)), ("mean pressure [MPa]".into(), Some(20.0)));
        assert_eq!((gaps.title(), gaps.whole().name), ("mean gap [nm]".into(), "mean gap [nm]".into()));
        assert!((gaps.whole().range[1] - 250.0).abs() < 1e-9);
    }

    #[test]
    fn there_is_room_for_what_is_expected_until_the_end() {
        let mut times = LoadAxis::linear("time", Vec::new()).expecting(vec![0.0, 10.0]);
        assert_eq!(times.whole().range, [0.0, 10.0]);
        for (load, time) in [0.0, 1.0, 3.0].into_iter().enumerate() {
            times.place(load, time);
        }
        assert_eq!(times.whole().range, [-0.5, 10.0]);
        assert_eq!(times.settled().whole().range, [-0.5, 4.0]);
        times.place(3, 12.0);
        assert_eq!(times.whole().range, [-0.5, 24.0]);
    }

    #[test]
    fn rooms_of_neighbours_meet_half_way() {
        let loads = LoadAxis::log("p*", vec![1e-4, 1e-2, 1e-1]);
        let rooms = [0, 1, 2].map(|load| loads.room(load).unwrap().map(f64::log10));
        for (room, expected) in rooms.into_iter().zip([[-5.0, -3.0], [-3.0, -1.5], [-1.5, -0.5]]) {
            assert!((0..2).all(|end| (room[end] - expected[end]).abs() < 1e-9), "{room:?}");
        }
        let falling = LoadAxis::linear("d", vec![3.0, 2.0, 1.0]);
        assert_eq!([0, 1, 2].map(|load| falling.room(load).unwrap()), [[2.5, 3.5], [1.5, 2.5], [0.5, 1.5]]);
    }

    #[test]
    fn axes_reach_over_the_loads_that_are_there() {
        let loads = LoadAxis::log("p*", vec![1e-4, 1e-2, f64::NAN, 1.0]);
        let range = loads.over([1]).range.map(f64::log10);
        assert!((range[0] + 3.0).abs() < 1e-9 && (range[1] + 1.0).abs() < 1e-9, "{range:?}");
        assert_eq!((loads.room(2), loads.room(9)), (None, None));
        assert!(loads.whole().range[1] > 1.0);
        assert_eq!(loads.over([2]).range, [0.0, 1.0]);
        assert_eq!(LoadAxis::linear("p", vec![4.0]).whole().range, [2.0, 6.0]);
    }
}
