//! A surface as a relief, coloured by its height.

use crate::record::draw::drawing::Drawing;
use crate::record::draw::field::relief::Relief;
use crate::record::draw::fields::{FrameFields, Outline, range};
use crate::record::draw::ink::eye::Eye;
use crate::record::draw::ink::palette::Palette;
use crate::surface::Surface;
use rerun::{RecordingStream, RecordingStreamResult};
use std::borrow::Cow;

/// A surface in three dimensions, peaks up.
pub struct SurfaceRelief {
    relief: Relief,
    fields: FrameFields<'static>,
}

impl SurfaceRelief {
    /// The relief of a surface under `root`, lengths in `unit`.
    pub fn new(surface: &Surface, palette: &'static Palette, root: &str, unit: &str) -> Self {
        let heights = surface.heights();
        let [low, high] = range(heights.iter().copied());
        let relief = Relief::over(surface.grid(), heights, high - low, palette, root, unit);
        // what is drawn lies at the negative of height and gap: that of the surface as far below its highest peak as it is
        let gap = heights.iter().map(|h| high - 2.0 * h).collect::<Vec<_>>().into();
        let pressure = heights.iter().map(|h| h - low).collect::<Vec<_>>().into();
        let (outline, patches, candidates) = (Outline::default(), Vec::new(), Cow::default());
        let fields = FrameFields { stride: [1, 1], pressure, gap, candidates, outline, patches, further: Vec::new() };
        Self { relief, fields }
    }

    /// The root of its entities, and the eye that sees it.
    pub fn view(&self) -> (&str, Eye) {
        (self.relief.root(), self.relief.eye())
    }

    /// Takes the proportions of a pane, width and height in points.
    pub fn fit(&mut self, pane: [f64; 2]) {
        self.relief.fit_pane(pane);
    }

    /// Records it.
    pub fn log(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        self.relief.log_static(to)?;
        self.relief.log_frame(to, &self.fields)
    }
}
