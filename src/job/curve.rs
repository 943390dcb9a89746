//! The recording of contacts under one load after the other.

use crate::contact::{Contact, Load, Observables, Problem};
use crate::error::FileError;
use crate::plot::Colour;
use crate::record::{CurveKind, LoadAxis, LoadRecording, Loads, Options, RecordedCurve, Scene, Timeline};
use crate::setup::Setup;
use crate::study::LoadCurve;
use std::path::Path;

/// A curve over the loads: its view, name and colour, and its value.
type LoadTrace = (&'static str, &'static str, Colour, fn(&Observables) -> f64);

const AREA: &str = "Relative area";
const KAPPA_R: &str = "kappa_r";
const KAPPA: &str = "kappa";
const GAP: &str = "Mean gap over rms height";

const CURVES: [LoadTrace; 4] = [
    (AREA, "a_rel", Colour::SKY, |it| it.resolved_area().unwrap_or(f64::NAN)),
    (KAPPA_R, "kappa_r", Colour::ORANGE, |it| it.resolved_kappa_r().unwrap_or(f64::NAN)),
    (KAPPA, "kappa", Colour::SKY, |it| it.resolved_kappa().unwrap_or(f64::NAN)),
    (GAP, "<g> / h_rms", Colour::ORANGE, |it| it.mean_gap_over_rms_height),
];

/// A recording of contacts under several loads that is being written into a file.
pub struct CurveRecording(LoadRecording);

impl CurveRecording {
    /// Begins the recording of a curve in a file, with room for the contact of `problem`, the heaviest.
    ///
    /// # Errors
    /// [`FileError::Target`] and [`FileError::Write`] for a file that cannot be made or written.
    pub fn create(path: &Path, curve: &LoadCurve, problem: &Problem) -> Result<Self, FileError> {
        let setup = Setup { load: problem.load(), ..curve.setup.clone() };
        let scene = Scene { exact: None, ..Scene::from_setup(&setup, problem) };
        let loads = Loads {
            title: format!("{}, {} loads", scene.title, curve.loads.len()),
            description: format!("{}, each load solved from the previous contact.", curve.setup.surface.description()),
            captions: curve.loads.iter().map(Load::to_string).collect(),
            curves: CURVES
                .map(|(view, name, colour, _)| RecordedCurve {
                    view: view.into(),
                    name: name.into(),
                    colour: colour.0,
                    kind: CurveKind::Computed,
                })
                .into(),
            axis: axis(&curve.loads),
            figure: None,
            timeline: Timeline::Loads,
            scenes: &[scene],
        };
        Ok(Self(LoadRecording::create(path, &loads, Options::from(&curve.setup))?))
    }

    /// Records the contact under load number `load`, from 0, and its numbers.
    ///
    /// # Errors
    /// [`FileError::Write`].
    pub fn add(&self, load: usize, contact: &Contact, observables: &Observables) -> Result<(), FileError> {
        self.0.values(load, &CURVES.map(|(.., of)| of(observables)))?;
        self.0.contact(0, load, contact)
    }

    /// Ends the file.
    ///
    /// # Errors
    /// [`FileError::Write`].
    pub fn finish(self) -> Result<(), FileError> {
        self.0.finish()
    }
}

/// The axis of the loads: logarithmic for pressures, linear for mean gaps.
fn axis(loads: &[Load]) -> LoadAxis {
    let values = loads.iter().map(Load::value).collect();
    match loads.first() {
        Some(Load::MeanGap(_)) => LoadAxis::linear("mean gap", values),
        Some(Load::MeanPressure(_)) => LoadAxis::log("mean pressure", values),
        Some(Load::Force(_)) => LoadAxis::log("force", values),
        Some(Load::Approach(_)) => LoadAxis::log("approach", values),
        Some(Load::ReducedPressure(_)) | None => LoadAxis::log("p*", values),
    }
}
