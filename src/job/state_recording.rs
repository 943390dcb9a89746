//! The recording of the states of a run: one frame for each, as soon as it is solved.

use super::history::HistoryOutcome;
use super::posed::Posed;
use super::run::JobRun;
use super::sink::StateSink;
use crate::contact::{Load, Observables, Problem, Quantity, State, StateField, Unit};
use crate::error::FileError;
use crate::plot::Colour;
use crate::record::{
    CurveKind, FurtherField, LoadAxis, LoadRecording, Loads, Options, RecordUnits, RecordedCurve, Scene, Target,
    Timeline, YieldZone, load_in_words, value_with_unit,
};
use crate::seen::capital;
use crate::setup::{Drive, Setup};
use std::path::{Path, PathBuf};

/// The largest distance of surfaces apart that a picture has room for, in heights of the highest peak.
const MOST_APART: f64 = 3.0;

/// Room for further fields while their largest values are not known, over those of the first state.
const ROOM: f64 = 4.0;

/// Changes of a quantity below this part of it are rounding, and no curve.
const ROUNDING: f64 = 1e-7;

/// A recording of the states of a run, which grows state by state.
///
/// The loads of a list are known before, and with them the axes of its recording. The states of a history are not: they are recorded by their numbers
/// first, on axes by the first state. If the history ends, its file is replaced by the one of [`HistoryOutcome::record`], whose axes fit all states. A
/// killed run leaves what was reached.
pub struct StateRecording<'a> {
    target: Option<Target<'a>>,
    /// The file, if it has a name.
    path: Option<PathBuf>,
    options: Options,
    /// The title of the first run, if it has one of its own.
    title: Option<String>,
    /// Runs beside the first one, which are recorded beside it.
    beside: Vec<JobRun<'a>>,
    begun: Option<Begun>,
}

/// A recording that has begun.
struct Begun {
    recording: LoadRecording,
    curves: Vec<StateCurve>,
    /// The file of a history, which is written again at its end.
    draft: Option<PathBuf>,
}

/// A curve over the states: how it is drawn, and its value.
type StateCurve = (RecordedCurve, Box<dyn Fn(&State) -> f64>);

impl<'a> StateRecording<'a> {
    /// The recording that goes to a target, which is opened at once.
    ///
    /// # Errors
    /// The errors of [`Target::opened`].
    pub fn open(target: Target<'a>, options: Options) -> Result<Self, FileError> {
        let path = target.file().map(Path::to_owned);
        Ok(Self { target: Some(target.opened()?), path, options, title: None, beside: Vec::new(), begun: None })
    }

    /// The recording of some runs beside each other, whose problems are posed.
    pub(super) fn of_runs(mut self, runs: &[JobRun<'a>]) -> Self {
        (self.title, self.beside) = (runs[0].title.clone(), runs[1..].to_vec());
        self
    }

    /// Ends the recording of a list of loads.
    ///
    /// # Errors
    /// [`FileError::Write`].
    pub fn finish(mut self) -> Result<(), FileError> {
        self.begun.take().map_or(Ok(()), |begun| begun.recording.finish())
    }

    fn begin(&mut self, posed: &Posed<'_>, first: &State) -> Result<(), FileError> {
        let Some(target) = self.target.take() else { return Ok(()) };
        let is_list = posed.drive.is_list;
        let draft = self.path.take().filter(|_| !is_list && self.beside.is_empty());
        let (units, is_line) = (self.options.units(), posed.problem.surface().grid().is_line());
        let curves = if is_list { curves_of_loads() } else { curves(posed.drive, &told(posed, first), &units) };
        let expected = posed.setup.expected_states().unwrap_or(0).max(2);
        let setup = Setup { load: posed.problem.load(), ..posed.setup.clone() };
        let scene = Scene {
            exact: None,
            further: if is_list { Vec::new() } else { further(posed, &[first], ROOM) },
            zone: YieldZone::new(posed.setup, &[first], ROOM),
            ..Scene::from_setup(&setup, posed.problem)
        };
        let title = self.title.clone().unwrap_or_else(|| scene.title.clone());
        let description = surface_in_words(posed.setup, &units);
        let given = &posed.setup.loads;
        let count = given.len();
        let beside =
            self.beside.iter().filter_map(|run| Some(Scene { exact: None, ..run.scene(run.problem.as_ref()?) }));
        let scenes: Vec<Scene<'_>> = std::iter::once(Scene { title: title.clone(), ..scene }).chain(beside).collect();
        let loads = Loads {
            title: if is_list { format!("{title}, {count} loads") } else { title.clone() },
            description: match is_list {
                true => format!("{description}, each load solved from the previous contact."),
                false => format!("{description}. {}.", first.claim.words()),
            },
            captions: given.iter().map(|load| load_in_words(*load, is_line, &units)).collect(),
            curves: curves.iter().map(|(curve, _)| curve.clone()).collect(),
            axis: if is_list { axis_of_loads(given, is_line, &units) } else { numbered(expected) },
            figure: None,
            timeline: if is_list { Timeline::Loads } else { Timeline::States(Vec::new()) },
            followed: is_list.then(|| posed.setup.surface.own_shape(posed.problem.surface().grid().shape())),
            scenes: &scenes,
        };
        let recording = LoadRecording::to(target, &loads, self.options.clone())?;
        self.begun = Some(Begun { recording, curves, draft });
        Ok(())
    }
}

impl StateSink for StateRecording<'_> {
    fn state(&mut self, posed: &Posed<'_>, number: usize, state: &State) -> Result<(), FileError> {
        if self.begun.is_none() {
            self.begin(posed, state)?;
        }
        let Some(Begun { recording, curves, .. }) = &mut self.begun else { return Ok(()) };
        if !posed.drive.is_list {
            recording.caption(number, caption(posed.drive, number, state, &self.options.units()));
        }
        if posed.run == 0 {
            recording.values(number, &curves.iter().map(|(_, of)| of(state)).collect::<Vec<_>>())?;
        }
        add(recording, posed.run, number, state)
    }

    fn end(&mut self, posed: &Posed<'_>, outcome: &HistoryOutcome) -> Result<(), FileError> {
        let Some(Begun { recording, draft, .. }) = self.begun.take() else { return Ok(()) };
        recording.finish()?;
        match draft {
            Some(path) => outcome.record_with(&path, posed.setup, posed.problem, self.options.clone()),
            None => Ok(()),
        }
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

impl HistoryOutcome {
    /// Writes a recording of all states, on the timelines `step` and, where states have times, the one of [`Timeline::States`].
    ///
    /// # Errors
    /// [`FileError::Target`] and [`FileError::Write`] for a file that cannot be made or written.
    pub fn record(&self, path: &Path, setup: &Setup, problem: &Problem) -> Result<(), FileError> {
        self.record_with(path, setup, problem, Options::from(setup))
    }

    fn record_with(&self, path: &Path, setup: &Setup, problem: &Problem, options: Options) -> Result<(), FileError> {
        let states: Vec<&State> = self.states.iter().map(|it| &**it).collect();
        let highest = states.iter().max_by(|a, b| a.contact.max_pressure().total_cmp(&b.contact.max_pressure()));
        let Some(highest) = highest else { return Ok(()) };
        let posed = Posed { run: 0, setup, problem, drive: self.drive };
        let scene = Scene {
            exact: None,
            apart: self.apart(problem),
            further: further(&posed, &states, 1.0),
            zone: YieldZone::new(setup, &states, 1.0),
            ..Scene::from_setup(setup, &highest.contact.problem)
        };
        let units = options.units();
        let curves = curves(self.drive, &self.changing(), &units);
        let loads = Loads {
            title: format!("{}, {} states", scene.title, states.len()),
            description: format!("{}. {}.", surface_in_words(setup, &units), states[0].claim.words()),
            captions: states.iter().enumerate().map(|(i, state)| caption(self.drive, i, state, &units)).collect(),
            curves: curves.iter().map(|(curve, _)| curve.clone()).collect(),
            axis: self.axis(&units),
            figure: None,
            timeline: Timeline::States(states.iter().filter_map(|state| state.get(Quantity::Time)).collect()),
            followed: None,
            scenes: &[scene],
        };
        let recording = LoadRecording::create(path, &loads, options)?;
        for (i, state) in states.iter().enumerate() {
            recording.values(i, &curves.iter().map(|(_, of)| of(state)).collect::<Vec<_>>())?;
            add(&recording, 0, i, state)?;
        }
        recording.finish()
    }

    /// The largest distance between the surfaces where they are closest, as far as a picture has room for it.
    fn apart(&self, problem: &Problem) -> f64 {
        let least = |state: &State| state.contact.gap.iter().copied().fold(f64::INFINITY, f64::min);
        let most = self.states.iter().map(|state| least(state)).fold(0.0, f64::max);
        most.min(MOST_APART * problem.highest())
    }

    /// The quantities with curves whose values change.
    fn changing(&self) -> Vec<Quantity> {
        let axis = self.drive.axis;
        let changes = |it: &Quantity| {
            let values = self.states.iter().filter_map(|state| state.get(*it));
            let values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
            let ends = [f64::INFINITY, f64::NEG_INFINITY];
            let [low, high] = values.iter().fold(ends, |[low, high], &value| [low.min(value), high.max(value)]);
            high - low > ROUNDING * low.abs().max(high.abs()) || values.len() == 1
        };
        let all = self.quantities().into_iter();
        all.filter(|it| Some(*it) != axis && it.row().has_curve && changes(it)).collect()
    }

    /// The axis of the charts: the quantity along which the process goes, or the number of the state.
    fn axis(&self, units: &RecordUnits) -> LoadAxis {
        let drive = self.drive;
        match drive.axis {
            Some(it) if drive.is_logarithmic => {
                LoadAxis::log(it.name(), self.values(it)).with_unit(units.of_kind(it.row().unit))
            }
            Some(it) => LoadAxis::linear(it.name(), self.values(it)).with_unit(units.of_kind(it.row().unit)),
            None => numbered(self.states.len()),
        }
    }
}

/// The numbers of some states as an axis.
fn numbered(states: usize) -> LoadAxis {
    LoadAxis::linear("state", (1..=states).map(|i| i as f64).collect())
}

/// Adds the fields of a state of a scene to a recording.
fn add(recording: &LoadRecording, scene: usize, number: usize, state: &State) -> Result<(), FileError> {
    let further: Vec<(&'static str, &[f64])> =
        state.fields.iter().map(|it| (it.name(), it.values.as_slice().unwrap_or_default())).collect();
    recording.state(scene, number, &state.contact, &further)
}

/// The quantities with curves that the first state of a history has.
fn told(posed: &Posed<'_>, first: &State) -> Vec<Quantity> {
    let axis = posed.drive.axis;
    let all = first.numbers().iter().map(|(quantity, _)| *quantity);
    all.filter(|it| it.row().has_curve && Some(*it) != axis).collect()
}

/// The curves of quantities, first those that the drive shows first.
fn curves(drive: &Drive, quantities: &[Quantity], units: &RecordUnits) -> Vec<StateCurve> {
    let mut quantities = quantities.to_vec();
    quantities.sort_by_key(|it| drive.shown().position(|shown| shown == *it).unwrap_or(usize::MAX));
    let of = |it: Quantity| {
        let colour = if it.row().unit == Unit::One { Colour::ORANGE } else { Colour::SKY };
        let title = it.row().title;
        let curve = RecordedCurve { unit: units.of_kind(it.row().unit).into(), ..curve(&view(title), title, colour) };
        (curve, Box::new(move |state: &State| state.value(it)) as Box<_>)
    };
    quantities.into_iter().map(of).collect()
}

/// The curves over a list of loads.
fn curves_of_loads() -> Vec<StateCurve> {
    let of = |view: &str, name: &str, colour, of: fn(&Observables) -> Option<f64>| -> StateCurve {
        let value = move |state: &State| of(&Observables::new(&state.contact)).unwrap_or(f64::NAN);
        (curve(view, name, colour), Box::new(value))
    };
    vec![
        of("Relative area", "a_rel", Colour::SKY, Observables::resolved_area),
        of("kappa_r", "kappa_r", Colour::ORANGE, Observables::resolved_kappa_r),
        of("kappa", "kappa", Colour::SKY, Observables::resolved_kappa),
        of("Mean gap over rms height", "<g> / h_rms", Colour::ORANGE, |it| Some(it.mean_gap_over_rms_height)),
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

/// The further fields of some states, with their ranges over these, times some room.
fn further(posed: &Posed<'_>, states: &[&State], room: f64) -> Vec<FurtherField> {
    let Some(first) = states.first() else { return Vec::new() };
    // the fields of a cut and of a leakage have drawings of their own
    let is_drawn = |it: &&StateField| it.is_on_surface() && it.kind.row().unit != Unit::One;
    let field = |it: &StateField| {
        let row = it.kind.row();
        let values = states.iter().filter_map(|state| state.field(it.kind)).flatten();
        let ends = [f64::INFINITY, f64::NEG_INFINITY];
        let [low, high] = values.fold(ends, |[low, high], value| [low.min(*value), high.max(*value)]);
        let unit = match row.unit {
            Unit::Pressure => posed.problem.contact_modulus(),
            _ => posed.problem.rms_height(),
        };
        FurtherField::new(row.name, row.title, (row.symbol, unit), [room * low, room * high])
    };
    first.fields.iter().filter(is_drawn).map(field).collect()
}

/// The title of a view: with a capital letter, unless it is a symbol.
fn view(title: &str) -> String {
    if title.contains('_') { title.into() } else { capital(title) }
}
