//! The recordings of a session: of a run step by step, and of a sweep load by load. Without the feature `record`, as in a browser, the same
//! functions record nothing.

use crate::error::FileError;
use crate::job::Job;
use crate::theory::Exact;
use std::sync::Arc;
#[cfg(feature = "record")]
use {
    super::theories::{exact, is_rough_flat, persson},
    crate::contact::{Quantity, State},
    crate::plot::Colour,
    crate::record::{CurveKind, Ghost, Options, Output, RecordedCurve, StateCurve, StateRecording, Target},
    crate::setup::{Part, Record, Setup},
};

/// The bytes of a recording, as it grows.
#[cfg(feature = "record")]
pub(crate) type TapeBytes = Output;
#[cfg(not(feature = "record"))]
pub(crate) type TapeBytes = ();

/// The curves of a run, which stand beside those of later runs in their recordings.
#[cfg(feature = "record")]
pub(crate) type TapeCurves = Ghost;
#[cfg(not(feature = "record"))]
pub(crate) type TapeCurves = ();

/// How a recording is drawn: the size of the viewer on the page, if the page has sent it, and the curves of an earlier run.
pub(crate) type TapeView = (Option<[f64; 2]>, Option<Arc<TapeCurves>>);

/// The curves of a run that begins.
#[cfg_attr(not(feature = "record"), expect(unused_variables, reason = "nothing is recorded"))]
pub(crate) fn curves(id: &str) -> TapeCurves {
    #[cfg(feature = "record")]
    return Ghost::new(&format!("pinned {id}"));
}

/// The job with a recording of its steps or states, whose bytes `begun` gets when the recording begins.
#[cfg_attr(not(feature = "record"), expect(unused_variables, reason = "nothing is recorded"))]
pub(crate) fn recorded<'a>(
    job: Job<'a>,
    id: &str,
    (window, ghost): TapeView,
    begun: impl FnOnce(TapeBytes) + 'a,
) -> Job<'a> {
    #[cfg(feature = "record")]
    {
        let options = Options { ghost, ..options(&job.setup().record, window) };
        job.recorded_with(options, Target::Temporary(id.into(), Box::new(begun)))
    }
    #[cfg(not(feature = "record"))]
    {
        begun(());
        job
    }
}

/// The job of a sweep with a recording of its contacts under an id and a title, with the curves of theories: Persson's where it is about the
/// surface, and what is known of the exact solution, which is given under the first load if there is one. Curves and contact are always recorded.
///
/// # Errors
/// [`FileError::Target`] for a file that cannot be made.
#[cfg_attr(not(feature = "record"), expect(unused_variables, reason = "nothing is recorded"))]
pub(crate) fn swept<'a>(
    job: Job<'a>,
    (id, title): (&str, &str),
    first: Option<Exact>,
    (window, _): TapeView,
    begun: impl FnOnce(TapeBytes) + 'a,
) -> Result<Job<'a>, FileError> {
    #[cfg(feature = "record")]
    {
        let mut parts = job.setup().record.clone();
        parts.what.extend([Part::Traces, Part::Mask]);
        let target = Target::Temporary(id.into(), Box::new(begun));
        let recording = StateRecording::open(target, options(&parts, window))?;
        let curves = theories(job.setup(), first.as_ref());
        Ok(job.with_sink(recording.with_scenes(Some(title.into()), Vec::new()).with_curves(curves)))
    }
    #[cfg(not(feature = "record"))]
    {
        begun(());
        Ok(job)
    }
}

/// The options of a recording for the viewer on the page.
#[cfg(feature = "record")]
fn options(record: &Record, window: Option<[f64; 2]>) -> Options {
    let options = Options::from(record);
    // the viewer on the page has no bars of its own
    let window = window.map(|[width, height]| [width, height + Options::BARS]);
    Options { window: window.unwrap_or(options.window), ..options }
}

/// Curves of Persson's theory where it applies, and of what an exact solution knows under the first load, beside those of the contacts.
#[cfg(feature = "record")]
fn theories(setup: &Setup, first: Option<&Exact>) -> Vec<StateCurve> {
    const GREY: Colour = Colour([0x80; 3]);
    let curve = |view: &str, name: &str, kind, colour: Colour| RecordedCurve {
        view: view.into(),
        name: name.into(),
        unit: String::new(),
        colour: colour.0,
        kind,
    };
    let mut curves: Vec<StateCurve> = Vec::new();
    if is_rough_flat(setup) {
        let area = |state: &State| persson(&state.contact);
        let kappa = move |state: &State| area(state) / state.value(Quantity::ReducedPressure);
        curves.push((curve(StateRecording::AREA, "Persson", CurveKind::Theory, GREY), Box::new(area)));
        curves.push((curve("kappa", "Persson", CurveKind::Theory, GREY), Box::new(kappa)));
    }
    let readings: [fn(&Exact) -> Option<f64>; 2] = [|exact| Some(exact.relative_area), |exact| exact.kappa_r];
    let names = [(StateRecording::AREA, "exact"), ("kappa_r", "exact kappa_r")];
    // an exact solution may know the area alone, as that of a wave does
    for ((view, name), of) in names.into_iter().zip(readings).filter(|(_, of)| first.and_then(of).is_some()) {
        let setup = setup.clone();
        let value =
            move |state: &State| exact(&setup, &state.contact.problem).as_ref().and_then(of).unwrap_or(f64::NAN);
        curves.push((curve(view, name, CurveKind::Exact, Colour::GREEN), Box::new(value)));
    }
    curves
}
