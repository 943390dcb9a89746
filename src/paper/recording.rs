//! The recordings of the figures: their curves over the loads, and contacts that grow.

use super::reproduction::{Ramp, RampCurve};
use crate::contact::Problem;
use crate::error::StudyError;
use crate::plot::Figure;
use crate::record::{CurveKind, LoadAxis, LoadRecording, Loads, Options, RecordedCurve, Scene, Timeline};
use crate::study::Realisation;
use crate::surface::RandomRoughness;
use std::path::Path;

const DESCRIPTION: &str = "Tribology Letters 66:115 (2018), reproduced. To see the contact under a load, choose the load on the time line, or click a point of a curve.";

/// Records `figure`, the curves of `ramp`, and `contacts` under its loads.
pub(crate) fn record(path: &Path, figure: &Figure, ramp: &Ramp, contacts: &[Realisation]) -> Result<(), StudyError> {
    let problems = contacts.iter().map(|contact| contact.setup.problem()).collect::<Result<Vec<_>, _>>()?;
    let scenes: Vec<Scene<'_>> =
        contacts.iter().zip(&problems).map(|(contact, problem)| scene(contact, problem)).collect();
    let loads = Loads {
        title: figure.title.clone(),
        description: DESCRIPTION.into(),
        captions: ramp.captions.clone(),
        axis: LoadAxis { scale: ramp.quantity.1, ..LoadAxis::linear(ramp.quantity.0, ramp.cursor.clone()) },
        curves: ramp.curves.iter().map(curve).collect(),
        figure: Some(figure),
        timeline: Timeline::Loads,
        followed: None,
        scenes: &scenes,
    };
    let options = Options { length_unit: ramp.length_unit.into(), ..Options::default() };
    let recording = LoadRecording::create(path, &loads, options)?;
    for load in 0..ramp.captions.len() {
        let value = |curve: &RampCurve| curve.values.get(load).copied().unwrap_or(f64::NAN);
        recording.values(load, &ramp.curves.iter().map(value).collect::<Vec<_>>())?;
    }
    for (scene, contact) in contacts.iter().enumerate() {
        let mut load = 0;
        contact.press(
            |_| (),
            |contact| {
                recording.contact(scene, load, contact)?;
                load += 1;
                Ok::<(), StudyError>(())
            },
        )?;
    }
    Ok(recording.finish()?)
}

/// The scene of a realisation, on axes for all of its loads.
fn scene<'a>(contact: &Realisation, problem: &'a Problem) -> Scene<'a> {
    let title = match contact.setup.surface.spectrum.as_ref().and_then(RandomRoughness::self_affine) {
        Some(spectrum) => {
            format!("{}, H = {}, seed {}", contact.name, spectrum.hurst, contact.setup.surface.seed())
        }
        None => contact.name.clone(),
    };
    Scene { name: title.clone(), title, exact: None, ..Scene::from_setup(&contact.setup, problem) }
}

fn curve(RampCurve { view, name, colour, .. }: &RampCurve) -> RecordedCurve {
    RecordedCurve {
        view: (*view).into(),
        name: name.clone(),
        unit: String::new(),
        colour: colour.0,
        kind: CurveKind::Computed,
    }
}
