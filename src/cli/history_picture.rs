//! The picture of a history.

use super::units::Units;
use asperity::contact::{Quantity, ResultClaim, State, Unit};
use asperity::job::HistoryOutcome;
use asperity::plot::{Axis, Colour, Dot, Figure, Mark, Panel, Symbol, label, unit};
use asperity::quantity::{LENGTHS, PRESSURES};
use asperity::setup::StateChart;

/// Room beyond the extreme values of a curve, over their distance.
const AXIS_MARGIN: f64 = 0.05;

/// Ends of a curve that are closer than this, over the distance of its extreme values, are the same.
const LOOP_CLOSURE: f64 = 1e-6;

/// The picture of the states of a history, without the frames of motions: a jump is an arrow.
pub(crate) fn draw(title: &str, outcome: &HistoryOutcome, units: Units) -> Figure {
    let states: Vec<&State> =
        outcome.states.iter().map(|it| &**it).filter(|it| it.claim != ResultClaim::Moving).collect();
    let panels = outcome.drive.charts.map(|chart| panel(outcome, chart, &states, units));
    Figure { title: title.into(), panels: panels.into() }
}

/// A panel of the picture.
fn panel(outcome: &HistoryOutcome, chart: StateChart, states: &[&State], units: Units) -> Panel {
    let [x, y] = [chart.x, Some(chart.y)].map(|quantity| {
        let value = |(number, state): (usize, &State)| match quantity {
            _ if state.claim == ResultClaim::Separated => f64::NAN,
            Some(it) => state.value(it),
            None => (number + 1) as f64,
        };
        let values: Vec<f64> = states.iter().copied().enumerate().map(value).collect();
        match quantity {
            Some(quantity) => in_units(quantity, values, units),
            None => ("state".into(), values),
        }
    });
    let axis = |(title, values): &(String, Vec<f64>), is_logarithmic: bool| {
        let [low, high] = range(values);
        match is_logarithmic && low > 0.0 {
            true => Axis::log(title.clone(), [low / 1.2, high * 1.2]),
            false => Axis::linear(title.clone(), [low - AXIS_MARGIN * (high - low), high + AXIS_MARGIN * (high - low)]),
        }
    };
    let dots: Vec<Dot> = x.1.iter().zip(&y.1).map(|(x, y)| Dot::at(*x, *y)).collect();
    let name = |quantity: Option<Quantity>| quantity.map_or("state", |it| it.row().title);
    let title = format!("{} against {}", name(Some(chart.y)), name(chart.x));
    let mut panel = Panel::new(title, axis(&x, outcome.drive.is_logarithmic), axis(&y, false));
    let is_loop = is_closed(&x.1) || is_closed(&y.1);
    if is_loop && chart.y == Quantity::MeanPressure {
        panel.add("", Colour::ORANGE, Mark::Area, dots.iter().copied());
    }
    panel.add("", Colour::ORANGE, Mark::Joined { symbol: Symbol::Circle, filled: true }, dots.iter().copied());
    for jump in (1..states.len()).filter(|&i| states[i].get(Quantity::Jump).is_some()) {
        panel.add("", Colour::BLACK, Mark::Arrow, [dots[jump - 1], dots[jump]]);
    }
    panel
}

/// The name of the axis of a quantity with its unit, and the values in this unit.
fn in_units(quantity: Quantity, values: Vec<f64>, units: Units) -> (String, Vec<f64>) {
    let row = quantity.row();
    let largest = values.iter().filter(|it| it.is_finite()).fold(0.0f64, |most, it| most.max(it.abs()));
    let (unit, size) = match row.unit {
        Unit::Length => unit(units.metres, &LENGTHS, largest),
        Unit::Pressure => unit(units.pascals, &PRESSURES, largest),
        Unit::EnergyPerArea if units.metres && units.pascals => ("J/m²", 1.0),
        _ => ("", 1.0),
    };
    (label(row.title, unit), values.into_iter().map(|it| it / size).collect())
}

/// Whether the finite values of a curve end where they have begun, and were elsewhere between.
fn is_closed(values: &[f64]) -> bool {
    let finite: Vec<f64> = values.iter().copied().filter(|it| it.is_finite()).collect();
    let [low, high] = range(&finite);
    matches!(finite.as_slice(), [first, .., last] if (last - first).abs() <= LOOP_CLOSURE * (high - low))
}

/// The least and the largest finite value, with zero beside values that are all the same.
fn range(values: &[f64]) -> [f64; 2] {
    let finite = values.iter().filter(|it| it.is_finite());
    let [low, high] = finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], it| [low.min(*it), high.max(*it)]);
    match low < high {
        true => [low, high],
        false if low.is_finite() && low != 0.0 => [low.min(0.0), low.max(0.0)],
        false => [0.0, 1.0],
    }
}
