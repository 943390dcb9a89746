//! A scene, prepared for recording.

use super::field::{self, SurfacePicture};
use super::forecast::Forecast;
use super::line::LinePicture;
use super::scene::{Fields, Scene};
use super::thinning::Pace;
use super::traces::{self, Reference};
use crate::contact::{Contact, Status};
use rerun::{RecordingStream, RecordingStreamResult, TextDocument};

/// Everything about a scene that its recorder and its layout need, without the problem itself.
pub struct Stage {
    /// Root of the entities, with a leading `/`.
    pub root: String,
    /// Title.
    pub title: String,
    /// What the caller says of it.
    description: String,
    /// Exact values of the curves.
    pub reference: Reference,
    /// Upper ends of the axes of curves.
    pub ranges: Ranges,
    /// What is drawn of the fields.
    pub picture: Picture,
}

/// Upper ends of the axes of curves, known before solving so that the first steps do not dwarf the last.
pub struct Ranges {
    /// Of `kappa` and `kappa_r`.
    pub kappa: f64,
    /// Of the relative area.
    pub area: f64,
}

impl Ranges {
    fn of(scene: &Scene<'_>, forecast: Forecast) -> Self {
        let exact = scene.exact.as_ref().and_then(|exact| exact.kappa_r);
        Self { kappa: exact.map_or(4.0, |kappa_r| 1.8 * kappa_r), area: (2.5 * forecast.relative_area).min(1.05) }
    }
}

/// The fields of a line or a surface.
pub enum Picture {
    /// Curves.
    Line(Box<LinePicture>),
    /// Images and a relief.
    Surface(Box<SurfacePicture>),
}

impl Picture {
    fn new(scene: &Scene<'_>, forecast: Forecast, root: &str, unit: &str) -> Self {
        if scene.problem.surface().grid().is_line() {
            Self::Line(Box::new(LinePicture::new(scene, forecast, root, unit)))
        } else {
            Self::Surface(Box::new(SurfacePicture::new(scene, forecast, root, unit)))
        }
    }

    /// How far apart its frames are unless the caller says otherwise.
    pub fn pace(&self) -> Pace {
        match self {
            Self::Line(_) => Pace::LINE,
            Self::Surface(_) => Pace::SURFACE,
        }
    }

    /// The part of the canvas that a picture in the plane takes: left, right, top, bottom.
    pub fn bounds(&self) -> [f64; 4] {
        match self {
            Self::Line(line) => line.bounds(),
            Self::Surface(surface) => surface.bounds(),
        }
    }
}

impl Stage {
    /// Prepares `scene` under `root`, with lengths in `unit`.
    pub fn new(scene: &Scene<'_>, root: String, unit: &str) -> Self {
        let forecast = Forecast::of(scene);
        Self {
            title: scene.title.clone(),
            description: scene.description.clone(),
            reference: Reference::of(scene.exact.as_ref()),
            ranges: Ranges::of(scene, forecast),
            picture: Picture::new(scene, forecast, &root, unit),
            root,
        }
    }

    /// Records what stays; `place` is that of the scene among several.
    pub fn log_static(
        &self,
        to: &RecordingStream,
        scene: &Scene<'_>,
        place: Option<usize>,
    ) -> RecordingStreamResult<()> {
        let Self { root, title, .. } = self;
        self.log_description(to, "still running, or ended by force")?;
        to.log_static(root.as_str(), &field::classes())?;
        traces::log_styles(to, root, self.reference, place.map(|place| (place, title.as_str())))?;
        match &self.picture {
            Picture::Line(line) => line.log_static(to, root, scene),
            Picture::Surface(surface) => surface.log_static(to, root),
        }
    }

    /// Records the description with how the run ended.
    pub fn log_result(&self, to: &RecordingStream, contact: &Contact) -> RecordingStreamResult<()> {
        let Contact { status, certificate, work, .. } = contact;
        let how = if *status == Status::Converged { status.to_string() } else { format!("not converged ({status})") };
        let result = format!(
            "{how} at a certificate of {:.2e}, after {} steps, {} transforms and {:.3} s",
            certificate.eta, work.iterations, work.transforms, work.seconds
        );
        self.log_description(to, &result)
    }

    fn log_description(&self, to: &RecordingStream, result: &str) -> RecordingStreamResult<()> {
        let text = format!("**Result**: {result}\n\n{}", self.description);
        to.log_static(format!("{}/description", self.root), &TextDocument::from_markdown(text))
    }

    /// Records a state at the current time.
    pub fn log_frame(&self, to: &RecordingStream, fields: &Fields<'_>) -> RecordingStreamResult<()> {
        match &self.picture {
            Picture::Line(line) => line.log_frame(to, fields),
            Picture::Surface(surface) => surface.log_frame(to, fields),
        }
    }

    /// Fits axes and scales to the final state.
    pub fn settle(&self, to: &RecordingStream, fields: &Fields<'_>) -> RecordingStreamResult<()> {
        match &self.picture {
            Picture::Line(line) => line.settle(to, &self.root, fields),
            Picture::Surface(surface) => surface.settle(to, fields),
        }
    }
}
