//! The recording of the states of a run: one frame for each, as soon as it is solved.

use super::loads::{LoadRecording, Loads, Timeline};
use super::target::Target;
use crate::contact::{Load, Observables, Problem, Quantity, State, StateField, Unit};
use crate::error::FileError;
use crate::plot::Colour;
use crate::record::description::load_in_words;
use crate::record::draw::{CurveKind, LoadAxis, RecordedCurve, STATE_CURVES};
use crate::record::options::Options;
use crate::record::scene::{FurtherField, Scene, YieldZone};
use crate::record::units::{RecordUnits, value_with_unit};
use crate::seen::capital;
use crate::setup::{Drive, Posed, Setup, StateSink};
use std::sync::Arc;

/// The end of the axis of a further field while its largest value is not known, over that of the first state. Loads and times of a path go up by some such
/// factor after its first point; the axis is fitted to all states at the end, so that the factor decides the picture of a running history alone.
const FURTHER_FIELD_ROOM: f64 = 4.0;

/// A recording of the states of a run, which grows state by state.
///
/// The loads of a list are known before, and with them the axes of its recording. The states of a history are not: its axes have room for what its
/// setup says, and are fitted to all states at the end. A killed run leaves what was reached.
pub struct StateRecording<'a> {
    target: Option<Target<'a>>,
    options: Options,
    /// The title of the first run, if it has one of its own.
    title: Option<String>,
    /// Scenes of runs that are recorded beside the first one.
    beside: Vec<Scene<'a>>,
    /// Curves over the states of the first run beside those of its own.
    further_curves: Vec<StateCurve>,
    begun: Option<Begun>,
}

/// A recording that has begun.
struct Begun {
    recording: LoadRecording,
    curves: Vec<StateCurve>,
    /// The quantities of the curves of a history, in the same order; none of a list of loads, whose curves are others.
    quantities: Vec<Quantity>,
}

/// A curve over the states: how it is drawn, and its value; NaN where a state has none.
pub type StateCurve = (RecordedCurve, Box<dyn Fn(&State) -> f64>);

impl<'a> StateRecording<'a> {
    /// The view of the relative area over a list of loads.
    pub const AREA: &'static str = "Relative area";

    /// The recording that goes to a target, which is opened at once.
    ///
    /// # Errors
    /// The errors of [`Target::opened`].
    pub fn open(target: Target<'a>, options: Options) -> Result<Self, FileError> {
        Ok(Self {
            target: Some(target.opened()?),
            options,
            title: None,
            beside: Vec::new(),
            further_curves: Vec::new(),
            begun: None,
        })
    }

    /// The recording under a title, with the scenes of further runs beside the first one. Without a title it is the surface that names it.
    pub fn with_scenes(mut self, title: Option<String>, beside: Vec<Scene<'a>>) -> Self {
        let beside = beside.into_iter().map(|scene| Scene { exact: None, ..scene }).collect();
        (self.title, self.beside) = (title, beside);
        self
    }

    /// The recording of a list of loads with further curves, such as those of theories.
    pub fn with_curves(mut self, curves: Vec<StateCurve>) -> Self {
        self.further_curves = curves;
        self
    }

    fn begin(&mut self, posed: &Posed<'_>, first: &State) -> Result<(), FileError> {
        let Some(target) = self.target.take() else { return Ok(()) };
        let is_list = posed.drive.is_list;
        let (units, is_line) = (self.options.units(), posed.problem.surface().grid().is_line());
        let quantities = if is_list { Vec::new() } else { in_order(posed.drive, told(posed, first)) };
        let of_history = || quantities.iter().map(|quantity| curve_of(*quantity, &units)).collect();
        let mut curves: Vec<StateCurve> = if is_list { curves_of_loads() } else { of_history() };
        curves.append(&mut self.further_curves);
        let problem = under_heaviest_load(posed, first);
        // a list has no load of its own; with adhesion the problem of a history has one that stands in for any
        let load = if is_list { problem.load() } else { posed.setup.load };
        let setup = Setup { load, ..posed.setup.clone() };
        let scene = Scene {
            exact: None,
            further: if is_list { Vec::new() } else { further(posed, first) },
            zone: YieldZone::new(posed.setup, first),
            ..Scene::from_setup(&setup, &problem)
        };
        let title = self.title.clone().unwrap_or_else(|| scene.title.clone());
        let description = surface_in_words(posed.setup, &units);
        let given = &posed.setup.loads;
        let count = given.len();
        let first_scene = Scene { title: title.clone(), ..scene };
        let scenes: Vec<Scene<'_>> = std::iter::once(first_scene).chain(self.beside.iter().cloned()).collect();
        let times = posed.setup.path_points().iter().filter_map(|point| point.time).collect();
        let loads = Loads {
            title: if is_list { format!("{title}, {count} loads") } else { title.clone() },
            description: match is_list {
                true => format!("{description}, each load solved from the previous contact."),
                false => format!("{description}. {}.", first.claim.words()),
            },
            captions: given.iter().map(|load| load_in_words(*load, is_line, &units)).collect(),
            curves: curves.iter().map(|(curve, _)| curve.clone()).collect(),
            axis: if is_list { axis_of_loads(given, is_line, &units) } else { axis(posed, &units) },
            figure: None,
            timeline: if is_list { Timeline::Loads } else { Timeline::States(times) },
            followed: is_list.then(|| posed.setup.surface.own_shape(posed.problem.surface().grid().shape())),
            scenes: &scenes,
        };
        let recording = LoadRecording::to(target, &loads, self.options.clone())?;
        self.begun = Some(Begun { recording, curves, quantities });
        Ok(())
    }

    /// Ends the recording, on axes that fit all states.
    fn finish(&mut self, drive: &Drive) -> Result<(), FileError> {
        let Some(Begun { recording, quantities, .. }) = self.begun.take() else { return Ok(()) };
        if drive.is_list {
            return recording.finish();
        }
        let number = |it: &Quantity| quantities.iter().position(|other| other == it);
        let order: Vec<usize> = in_order(drive, quantities.clone()).iter().filter_map(number).collect();
        recording.finish_states(&order)
    }
}

impl Begun {
    /// Adds a state of a history, and a curve for each quantity that no state before had.
    fn add_state(
        &mut self,
        posed: &Posed<'_>,
        number: usize,
        state: &State,
        units: &RecordUnits,
    ) -> Result<(), FileError> {
        let place = posed.drive.axis.map_or(number as f64 + 1.0, |it| state.value(it));
        let words = caption(posed.drive, number, state, units);
        self.recording.add_state(words, place, state.get(Quantity::Time));
        let new: Vec<Quantity> = told(posed, state).into_iter().filter(|it| !self.quantities.contains(it)).collect();
        for quantity in new {
            let curve = curve_of(quantity, units);
            self.recording.add_curve(curve.0.clone())?;
            self.curves.push(curve);
            self.quantities.push(quantity);
        }
        Ok(())
    }
}

impl StateSink for StateRecording<'_> {
    fn state(&mut self, posed: &Posed<'_>, number: usize, state: &State) -> Result<(), FileError> {
        if self.begun.is_none() {
            self.begin(posed, state)?;
        }
        let Some(begun) = &mut self.begun else { return Ok(()) };
        // a run beside the first one may have more states
        if number >= begun.recording.count() {
            begun.add_state(posed, number, state, &self.options.units())?;
        }
        if posed.run == 0 {
            let values: Vec<f64> = begun.curves.iter().map(|(_, of)| of(state)).collect();
            begun.recording.values(number, &values)?;
        }
        let further: Vec<(&'static str, &[f64])> =
            state.fields.iter().map(|it| (it.name(), it.values.as_slice().unwrap_or_default())).collect();
        begun.recording.state(posed.run, number, &state.contact, &further)
    }

    fn end(&mut self, posed: &Posed<'_>, states: &[Arc<State>]) -> Result<(), FileError> {
        let Some(begun) = &self.begun else { return Ok(()) };
        let is_list = posed.drive.is_list;
        // surfaces under loads are never apart
        for (number, state) in states.iter().enumerate().filter(|_| !is_list) {
            begun.recording.redraw(posed.run, number, &state.contact)?;
        }
        let is_last = posed.run == self.beside.len();
        if is_last { self.finish(posed.drive) } else { Ok(()) }
    }
}

impl Drop for StateRecording<'_> {
    /// A run without a state leaves no file.
    fn drop(&mut self) {
        if let Some(target) = self.target.take() {
            target.discard();
        }
    }
}

/// The problem under the largest load of the path of a history, for which its pictures have room, or that of its first state where no contact has
/// such a load; that of a list of loads has it already.
fn under_heaviest_load(posed: &Posed<'_>, first: &State) -> Problem {
    if posed.drive.is_list {
        return posed.problem.clone();
    }
    let points = posed.setup.path_points().into_iter();
    let heaviest = points.map(|point| point.load).max_by(|one, two| one.value().total_cmp(&two.value()));
    let problem = &first.contact.problem;
    heaviest.and_then(|load| problem.clone().with_load(load).ok()).unwrap_or_else(|| problem.clone())
}

/// The axis of the charts of a history: the quantity along which its drive goes, with room for what its path says, or the number of the state.
fn axis(posed: &Posed<'_>, units: &RecordUnits) -> LoadAxis {
    let setup = posed.setup;
    let Some(quantity) = posed.drive.axis else {
        let states = setup.expected_states().unwrap_or(0).max(2);
        return LoadAxis::linear("state", Vec::new()).expecting(vec![0.5, states as f64 + 0.5]);
    };
    let times = setup.path_points().into_iter().filter_map(|point| point.time);
    let speeds = setup.sliding.iter().flat_map(|sliding| sliding.speed.iter().copied());
    let axis = match posed.drive.is_logarithmic {
        true => LoadAxis::log(quantity.name(), Vec::new()),
        false => LoadAxis::linear(quantity.name(), Vec::new()),
    };
    axis.with_unit(units.of_kind(quantity.row().unit)).expecting(times.chain(speeds).collect())
}

/// The quantities with curves that a state of a history has.
fn told(posed: &Posed<'_>, state: &State) -> Vec<Quantity> {
    let axis = posed.drive.axis;
    let all = state.numbers().iter().map(|(quantity, _)| *quantity);
    all.filter(|it| it.row().has_curve && Some(*it) != axis).collect()
}

/// Quantities in the order of their curves: first those that the drive shows first.
fn in_order(drive: &Drive, mut quantities: Vec<Quantity>) -> Vec<Quantity> {
    quantities.sort_unstable();
    quantities.sort_by_key(|it| drive.shown().position(|shown| shown == *it).unwrap_or(usize::MAX));
    quantities
}

/// The curve of a quantity over the states.
fn curve_of(quantity: Quantity, units: &RecordUnits) -> StateCurve {
    let row = quantity.row();
    let colour = STATE_CURVES[usize::from(row.unit == Unit::One)];
    let unit = units.of_kind(row.unit).into();
    let curve = RecordedCurve { unit, ..curve(&view(row.title), row.title, colour) };
    (curve, Box::new(move |state: &State| state.value(quantity)))
}

/// The curves over a list of loads.
fn curves_of_loads() -> Vec<StateCurve> {
    let of = |view: &str, name: &str, colour, of: fn(&Observables) -> Option<f64>| -> StateCurve {
        let value = move |state: &State| of(&Observables::of_state(state)).unwrap_or(f64::NAN);
        (curve(view, name, colour), Box::new(value))
    };
    let [first, second] = STATE_CURVES;
    vec![
        of(StateRecording::AREA, "a_rel", first, Observables::resolved_area),
        of("kappa_r", "kappa_r", second, Observables::resolved_kappa_r),
        of("kappa", "kappa", first, Observables::resolved_kappa),
        of("Mean gap over rms height", "<g> / h_rms", second, |it| Some(it.mean_gap_over_rms_height)),
    ]
}

fn curve(view: &str, name: &str, colour: Colour) -> RecordedCurve {
    let (view, name, unit) = (view.into(), name.into(), String::new());
    RecordedCurve { view, name, unit, colour: colour.0, kind: CurveKind::Computed }
}

/// The surface of a setup in words.
fn surface_in_words(setup: &Setup, units: &RecordUnits) -> String {
    setup.surface.described(Some(&|length| value_with_unit(length, &units.length)))
}

/// The axis of a list of loads: logarithmic for pressures, linear for mean gaps.
fn axis_of_loads(loads: &[Load], is_line: bool, units: &RecordUnits) -> LoadAxis {
    let values = loads.iter().map(Load::value).collect();
    let axis = match loads.first() {
        Some(Load::MeanGap(_)) => LoadAxis::linear("mean gap", values),
        Some(Load::MeanPressure(_)) => LoadAxis::log("mean pressure", values),
        Some(Load::Force(_)) => LoadAxis::log("force", values),
        Some(Load::Approach(_)) => LoadAxis::log("approach", values),
        Some(Load::ReducedPressure(_)) | None => LoadAxis::log("p*", values),
    };
    axis.with_unit(loads.first().map_or("", |load| units.of_load(*load, is_line)))
}

/// A state in a few words.
fn caption(drive: &Drive, number: usize, state: &State, units: &RecordUnits) -> String {
    let words = drive.caption.iter().filter_map(|it| {
        let value = state.get(*it)?;
        Some(format!("{} {}", it.row().title, value_with_unit(value, units.of_kind(it.row().unit))))
    });
    let words: Vec<String> = words.collect();
    if words.is_empty() { format!("state {}", number + 1) } else { words.join(", ") }
}

/// The further fields of the states of a history, on axes with room for values some times larger than those of the first state.
fn further(posed: &Posed<'_>, first: &State) -> Vec<FurtherField> {
    // the fields of a cut and of a leakage have drawings of their own
    let is_drawn = |it: &&StateField| it.is_on_surface() && it.kind.row().unit != Unit::One;
    let field = |it: &StateField| {
        let row = it.kind.row();
        let ends = [f64::INFINITY, f64::NEG_INFINITY];
        let [low, high] = it.values.iter().fold(ends, |[low, high], value| [low.min(*value), high.max(*value)]);
        let unit = match row.unit {
            Unit::Pressure => posed.problem.contact_modulus(),
            _ => posed.problem.rms_height(),
        };
        FurtherField::new(
            row.name,
            row.title,
            (row.symbol, unit),
            [FURTHER_FIELD_ROOM * low, FURTHER_FIELD_ROOM * high],
        )
    };
    first.fields.iter().filter(is_drawn).map(field).collect()
}

/// The title of a view: with a capital letter, unless it is a symbol.
fn view(title: &str) -> String {
    if title.contains('_') { title.into() } else { capital(title) }
}
