//! Waterfalls: a quantity step by step against the wavelength, in decades.

use super::palette::{Map, Palette};
use super::scale::ColourScale;
use super::step_image::{StepImage, Steps};
use crate::diagnosis::{Bands, History, Row};
use crate::plot::Axis;
use crate::record::sdk::{ChannelDatatype, ImageFormat};
use rerun::components::{MagnificationFilter, ValueRange};
use rerun::{DepthImage, RecordingStream, RecordingStreamResult};

/// Decades below the largest value that the colours show.
const DECADES: f64 = 8.0;

/// A quantity of each band, step to the right, wavelength upwards.
pub struct Waterfall {
    pub image: StepImage,
    name: String,
    /// The band of each row, from the longest waves on.
    rows: Vec<usize>,
    of: fn(&Row) -> &[f64],
    /// The largest value, of quantities that have one.
    unit: f64,
}

impl Waterfall {
    /// A waterfall of a quantity of the rows, over its unit, for the waves of `bands` on an axis of wavelengths.
    pub fn new(
        root: String,
        palette: &'static Palette,
        (name, unit): (&str, f64),
        bands: &Bands,
        wavelength: Axis,
        of: fn(&Row) -> &[f64],
    ) -> Self {
        Self {
            image: StepImage::new(root, palette, Some(wavelength), true),
            name: name.into(),
            rows: bands.half_octaves(),
            of,
            unit,
        }
    }

    /// Records the image of the steps so far.
    pub fn log(&self, to: &RecordingStream, history: &History<Row>) -> RecordingStreamResult<()> {
        let columns = history.columns();
        if columns.iter().all(|row| (self.of)(row).is_empty()) {
            return Ok(());
        }
        let steps = Steps { columns: columns.len(), per_column: history.per_column() };
        let value =
            |row: &Row, band: usize| (self.of)(row).get(band).map_or(f64::NAN, |value| (value / self.unit).log10());
        let values: Vec<f64> =
            self.rows.iter().flat_map(|&band| columns.iter().map(move |row| value(row, band))).collect();
        let most = values.iter().copied().filter(|value| value.is_finite()).fold(f64::NEG_INFINITY, f64::max);
        let most = if most.is_finite() { most.ceil() } else { 0.0 };
        let range = [most - DECADES, most];
        // what is not finite, such as the error of the reference itself, lies at the lower end
        let bytes: Vec<u8> =
            values.iter().flat_map(|&value| (value.max(range[0]).min(range[1]) as f32).to_le_bytes()).collect();
        let format = ImageFormat::depth([steps.columns as u32, self.rows.len() as u32], ChannelDatatype::F32);
        let map = Map::inferno();
        let image = DepthImage::update_fields()
            .with_buffer(bytes)
            .with_format(format)
            .with_meter(1.0)
            .with_colormap(map.viewer)
            .with_depth_range(ValueRange::from(range))
            .with_magnification_filter(MagnificationFilter::Nearest)
            .with_draw_order(0.0);
        self.image.log(to, &image, self.rows.len(), steps)?;
        let scale = ColourScale { root: format!("{}/scale", self.image.root), palette: self.image.palette, map };
        scale.log(to, &self.image.frame(steps), &Axis::linear(self.name.as_str(), range))
    }
}
