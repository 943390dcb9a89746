//! The recordings of a session: of a run step by step, and of a sweep load by load.

use super::report::{SweepPoint, SweepReport};
use crate::contact::{Contact, Failure, Load, Problem};
use crate::error::FileError;
use crate::job::Job;
use crate::plot::Colour;
use crate::record::{
    CurveKind, Ghost, LoadAxis, LoadRecording, Loads, Options, Output, RecordedCurve, Scene, Target, Timeline,
};
use crate::setup::{Part, Record, Setup};
use std::sync::Arc;

/// The bytes of a recording, as it grows.
pub(crate) type TapeBytes = Output;
/// The curves of a run, which stand beside those of later runs in their recordings.
pub(crate) type TapeCurves = Ghost;

/// How a recording is drawn: the size of the viewer on the page, if the page has sent it, and the curves of an earlier run.
pub(crate) type TapeView = (Option<[f64; 2]>, Option<Arc<TapeCurves>>);

/// The curves of a run that begins.
pub(crate) fn curves(id: &str) -> TapeCurves {
    Ghost::new(&format!("pinned {id}"))
}

/// The job with its recording, whose bytes `begun` gets when the recording begins.
pub(crate) fn recorded<'a>(
    job: Job<'a>,
    id: &'a str,
    record: &Record,
    (window, ghost): TapeView,
    begun: impl FnOnce(TapeBytes) + 'a,
) -> Job<'a> {
    let options = Options { ghost, ..options(record, window) };
    job.recorded_with(options, Target::Temporary(id.into(), Box::new(begun)))
}

/// The options of a recording for the viewer on the page.
fn options(record: &Record, window: Option<[f64; 2]>) -> Options {
    let options = Options::from(record);
    // the viewer on the page has no bars of its own
    let window = window.map(|[width, height]| [width, height + Options::BARS]);
    Options { window: window.unwrap_or(options.window), ..options }
}

/// A curve of the recording of a sweep: its view, name, kind and colour, and its value at a point.
type PointCurve = (&'static str, &'static str, CurveKind, Colour, fn(&SweepPoint) -> f64);

const AREA: &str = "Relative area a_rel";
const KAPPA_R: &str = "kappa_r";
const KAPPA: &str = "kappa";
const GREY: Colour = Colour([0x80; 3]);

/// Curves of every sweep, behind them those of Persson's theory where it applies, and those of an exact solution where there is one.
const CURVES: [PointCurve; 3] = [
    (AREA, "a_rel", CurveKind::Computed, Colour::SKY, |point| point.observables.resolved_area().unwrap_or(f64::NAN)),
    (KAPPA_R, "kappa_r", CurveKind::Computed, Colour::ORANGE, |point| {
        point.observables.resolved_kappa_r().unwrap_or(f64::NAN)
    }),
    (KAPPA, "kappa", CurveKind::Computed, Colour::SKY, |point| point.observables.resolved_kappa().unwrap_or(f64::NAN)),
];
const PERSSON: [PointCurve; 2] = [
    (AREA, "Persson", CurveKind::Theory, GREY, |point| point.persson.unwrap_or(f64::NAN)),
    (KAPPA, "Persson", CurveKind::Theory, GREY, |point| {
        point.persson.unwrap_or(f64::NAN) / point.observables.reduced_pressure
    }),
];
const EXACT: [PointCurve; 2] = [
    (AREA, "exact", CurveKind::Exact, Colour::GREEN, |point| {
        point.exact.as_ref().map_or(f64::NAN, |exact| exact.relative_area)
    }),
    (KAPPA_R, "exact kappa_r", CurveKind::Exact, Colour::GREEN, |point| {
        point.exact.as_ref().and_then(|exact| exact.kappa_r).unwrap_or(f64::NAN)
    }),
];

/// The recording of a sweep.
pub(crate) struct SweepTape {
    recording: LoadRecording,
    curves: Vec<PointCurve>,
}

impl SweepTape {
    /// Begins the recording of a sweep over `loads`, with room for the contact of `problem`, the heaviest: the requested
    /// pictures, and always curves and contact. `theories` says whether Persson's theory applies, and whether there is an
    /// exact solution.
    ///
    /// # Errors
    /// [`FileError::Target`] and [`FileError::Write`] for a file that cannot be made or written.
    pub(crate) fn begin(
        (report, setup, problem): (&SweepReport, &Setup, &Problem),
        loads: &[f64],
        theories: [bool; 2],
        (window, _): TapeView,
    ) -> Result<(Self, TapeBytes), Failure> {
        let theories = [PERSSON, EXACT].into_iter().zip(theories).filter(|(_, applies)| *applies);
        let curves: Vec<PointCurve> = CURVES.into_iter().chain(theories.flat_map(|(curves, _)| curves)).collect();
        let (title, description) = (report.title.clone(), setup.surface.description());
        let loads = Loads {
            title: title.clone(),
            description: format!(
                "{description}, each load solved from the previous contact, until the contact is full."
            ),
            axis: LoadAxis::log("p*", loads.to_vec()),
            captions: loads.iter().map(|load| Load::ReducedPressure(*load).to_string()).collect(),
            curves: curves
                .iter()
                .map(|&(view, name, kind, colour, _)| RecordedCurve {
                    view: view.into(),
                    name: name.into(),
                    unit: String::new(),
                    colour: colour.0,
                    kind,
                })
                .collect(),
            figure: None,
            timeline: Timeline::Loads,
            followed: None,
            scenes: &[Scene { title, exact: None, ..Scene::from_setup(setup, problem) }],
        };
        let mut parts = setup.record.clone();
        parts.what.extend([Part::Traces, Part::Mask]);
        let mut live = None;
        let target = Target::Temporary(report.id.clone(), Box::new(|output| live = Some(output)));
        let recording = LoadRecording::to(target, &loads, options(&parts, window))?;
        Ok((Self { recording, curves }, live.ok_or("the recording has not begun")?))
    }

    /// Records the contact under load number `number`, from 0 on.
    ///
    /// # Errors
    /// [`FileError::Write`].
    pub(crate) fn contact(&self, number: usize, contact: &Contact) -> Result<(), FileError> {
        self.recording.contact(0, number, contact)
    }

    /// Records the numbers of a load.
    ///
    /// # Errors
    /// [`FileError::Write`].
    pub(crate) fn point(&self, point: &SweepPoint) -> Result<(), FileError> {
        let values: Vec<f64> = self.curves.iter().map(|(.., of)| of(point)).collect();
        self.recording.values(point.number - 1, &values)
    }

    /// Ends the recording.
    ///
    /// # Errors
    /// [`FileError::Write`].
    pub(crate) fn finish(self) -> Result<(), FileError> {
        self.recording.finish()
    }
}
