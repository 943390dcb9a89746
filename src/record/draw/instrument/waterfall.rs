//! Waterfalls: a quantity by step and wavelength, in decades.

use crate::diagnosis::{Bands, Diagnosis, History, SpectrogramRow};
use crate::plot::Axis;
use crate::record::draw::drawing::{Drawing, Place, RunDrawing, RunStep, Subject};
use crate::record::draw::ink::palette::ColourMap;
use crate::record::draw::ink::pane::Pane;
use crate::record::draw::ink::ruler::Ruler;
use crate::record::draw::ink::scale::ColourScale;
use crate::record::draw::instrument::step_image::{Passed, StepAxis, StepImage};
use crate::record::sdk::{ChannelDatatype, ImageFormat};
use rerun::components::{MagnificationFilter, ValueRange};
use rerun::{DepthImage, RecordingStream, RecordingStreamResult};

/// Decades below the largest value that the colours show.
const DECADES: f64 = 8.0;

/// A quantity of each band, step to the right, wavelength upwards.
#[derive(Clone)]
pub(crate) struct Waterfall {
    image: StepImage,
    /// The band of each row, from the longest waves on.
    rows: Vec<usize>,
    quantity: WaterfallQuantity,
}

/// A quantity of the rows of a spectrogram.
#[derive(Clone, Copy)]
pub(crate) struct WaterfallQuantity {
    /// The name of its entity below the root of the scene.
    pub entity: &'static str,
    /// The title of its pane, and its name at the scale.
    pub title: &'static str,
    pub name: &'static str,
    /// The value that the numbers are over.
    pub unit: f64,
    pub values: fn(&SpectrogramRow) -> &[f64],
}

impl Waterfall {
    /// The waterfall of a quantity of a scene.
    pub(crate) fn new(
        Subject { scene, root, options, palette, .. }: &Subject<'_>,
        quantity: WaterfallQuantity,
    ) -> Self {
        let grid = scene.problem.surface().grid();
        let bands = Bands::new(grid);
        let longest = grid.longest_wavelength();
        let shortest = longest * 0.5f64.powf(0.5 * bands.half_octaves().len() as f64);
        let unit = Ruler::new("wavelength", &options.length_unit, [0.0, longest]);
        let wavelength = Axis::log(unit.axis.name.as_str(), [shortest, longest].map(|length| length / unit.unit));
        let image = StepImage::new(format!("{root}/{}", quantity.entity), palette, Some(wavelength), true);
        Self { image, rows: bands.half_octaves(), quantity }
    }

    /// Records the image of the steps so far.
    fn log(&self, to: &RecordingStream, history: &History<SpectrogramRow>) -> RecordingStreamResult<()> {
        let columns = history.columns();
        if columns.iter().all(|row| (self.quantity.values)(row).is_empty()) {
            return Ok(());
        }
        let steps = StepAxis { columns: columns.len(), per_column: history.per_column() };
        let value = |row: &SpectrogramRow, band: usize| {
            (self.quantity.values)(row).get(band).map_or(f64::NAN, |value| (value / self.quantity.unit).log10())
        };
        let values: Vec<f64> =
            self.rows.iter().flat_map(|&band| columns.iter().map(move |row| value(row, band))).collect();
        let most = values.iter().copied().filter(|value| value.is_finite()).fold(f64::NEG_INFINITY, f64::max);
        let most = if most.is_finite() { most.ceil() } else { 0.0 };
        let range = [most - DECADES, most];
        // what is not finite, such as the error of the reference itself, lies at the lower end
        let bytes: Vec<u8> =
            values.iter().flat_map(|&value| (value.max(range[0]).min(range[1]) as f32).to_le_bytes()).collect();
        let format = ImageFormat::depth([steps.columns as u32, self.rows.len() as u32], ChannelDatatype::F32);
        let map = ColourMap::inferno();
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
        scale.log(to, &self.image.frame(steps), &Axis::linear(self.quantity.name, range))
    }
}

/// Waterfalls of a scene.
pub(crate) struct Waterfalls(pub Vec<Waterfall>);

/// The drawing of the errors of pressure and displacement, if there is a reference state.
pub(crate) fn draw(subject: &Subject<'_>) -> Option<Box<dyn Drawing>> {
    subject.scene.reference.as_ref()?;
    let pressure = WaterfallQuantity {
        entity: "error_pressure",
        title: "Error of the pressure by wavelength",
        name: "log10 error",
        unit: 1.0,
        values: |row| &row.pressure,
    };
    let displacement = WaterfallQuantity {
        entity: "error_displacement",
        title: "Error of the displacement by wavelength",
        values: |row| &row.displacement,
        ..pressure
    };
    let waterfalls = [pressure, displacement].map(|quantity| Waterfall::new(subject, quantity));
    Some(Box::new(Waterfalls(waterfalls.into())))
}

impl Drawing for Waterfalls {
    fn panes(&self) -> Vec<(Place, Pane)> {
        let panes = self.0.iter().map(|waterfall| waterfall.image.pane(waterfall.quantity.title));
        panes.map(|pane| (Place::RunWavelengths, pane)).collect()
    }

    fn fit(&mut self, size: &dyn Fn(&str) -> Option<[f64; 2]>) {
        self.0.iter_mut().for_each(|waterfall| waterfall.image.fit(size));
    }

    fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        self.0.iter().try_for_each(|waterfall| waterfall.image.log_cursor_style(to))
    }

    fn run(&self) -> Option<Box<dyn RunDrawing>> {
        let waterfalls = self.0.iter().map(|waterfall| (waterfall.clone(), Passed::default()));
        Some(Box::new(WaterfallsOfRun(waterfalls.collect())))
    }
}

/// The waterfalls of one run.
struct WaterfallsOfRun(Vec<(Waterfall, Passed)>);

impl RunDrawing for WaterfallsOfRun {
    fn add(&mut self, step: &RunStep<'_, '_>) {
        self.0.iter_mut().for_each(|(_, passed)| passed.add(step.step.work()));
    }

    fn show(&mut self, to: &RecordingStream, diagnosis: &Diagnosis) -> RecordingStreamResult<()> {
        let history = diagnosis.spectrogram().history();
        self.0.iter().try_for_each(|(waterfall, _)| waterfall.log(to, history))
    }

    fn flush(&mut self, to: &RecordingStream) -> RecordingStreamResult<()> {
        self.0.iter_mut().try_for_each(|(waterfall, passed)| waterfall.image.send_cursor(to, passed))
    }
}
