//! The pictures of a surface: pressure, gap and contact as images in the plane, the solid as a relief.

use super::Options;
use super::axes::{self, Axis, Frame};
use super::forecast::Forecast;
use super::palette::{self, Map, colour};
use super::part::{Part, Parts};
use super::reduce::Blocks;
use super::relief::Relief;
use super::scene::{self, Extent, Fields, Scene, range};
use crate::grid::Grid;
use rerun::components::{ImageFormat, MagnificationFilter, ValueRange};
use rerun::datatypes::ChannelDatatype;
use rerun::{
    AnnotationContext, AnnotationInfo, DepthImage, EntityPath, LineStrips2D, Radius, RecordingStream,
    RecordingStreamResult, SegmentationImage,
};

/// Class of nodes without contact.
const GAP_CLASS: u16 = 0;
/// Class of nodes in contact.
pub const CONTACT_CLASS: u16 = 1;
/// Pixels along the longer side of an image.
const PIXELS: usize = 512;
/// Height of a line of text, in lengths of the longer side.
const TEXT: f32 = 0.058;
/// Bars of a colour scale.
const SHADES: usize = 64;

/// What is drawn of a surface, and where.
pub struct SurfacePicture {
    what: Parts,
    blocks: Blocks,
    pressure: Image,
    gap: Image,
    relief: Option<Relief>,
    contact: EntityPath,
}

/// A field in colours, its frame and its scale.
struct Image {
    frame: Frame,
    scale: Axis,
    map: Map,
    /// What the field is divided by.
    unit: f64,
    root: String,
    pixels: EntityPath,
}

impl SurfacePicture {
    /// The picture of `scene`.
    pub fn new(scene: &Scene<'_>, forecast: Forecast, root: &str, options: &Options) -> Self {
        let Options { what, length_unit, .. } = options;
        let problem = scene.problem;
        let grid = problem.surface().grid();
        let blocks = Blocks::square(grid.shape(), grid.size(), PIXELS);
        let [ly, lx] = grid.size();
        let [height, width] = blocks.cells.map(|n| n as f32);
        let [x, y] = [("x", lx), ("y", ly)].map(|(symbol, l)| scene::length_axis(symbol, length_unit, 0.0, l));
        let frame = Frame { x, y, width, height, text: TEXT * width.max(height) };
        let (low, high) = range(problem.height().iter().copied());
        let image =
            |name: &str, scale, map, unit| Image::new(frame.clone(), scale, map, unit, format!("{root}/{name}"));
        let pressure_scale = scene::pressure_axis(forecast.max_pressure / problem.contact_modulus());
        let gap_scale = scene::gap_axis((high - low) / problem.rms_height());
        Self {
            what: *what,
            blocks,
            pressure: image("pressure", pressure_scale, Map::inferno(), problem.contact_modulus()),
            gap: image("gap", gap_scale, Map::viridis(), problem.rms_height()),
            relief: what.has(Part::Mesh).then(|| Relief::new(scene, forecast, root, length_unit)),
            contact: format!("{root}/contact").into(),
        }
    }

    /// The frame of each image.
    pub fn frame(&self) -> &Frame {
        &self.pressure.frame
    }

    /// The part of the canvas that each image takes, colour scale included.
    pub fn bounds(&self) -> [f64; 4] {
        self.pressure.bounds()
    }

    /// Records what stays: axes, classes, the triangles of the relief.
    pub fn log_static(&self, to: &RecordingStream, root: &str) -> RecordingStreamResult<()> {
        if self.what.has(Part::Fields) {
            self.pressure.log_static(to)?;
            self.gap.log_static(to)?;
        }
        if self.what.has(Part::Mask) {
            let style = SegmentationImage::update_fields().with_opacity(0.9).with_draw_order(10.0);
            to.log_static(self.contact.clone(), &style.with_format(self.format(ChannelDatatype::U8)))?;
        }
        if self.shows_contact_alone() {
            self.frame().log(to, &format!("{root}/contact/axes"))?;
        }
        self.relief.as_ref().map_or(Ok(()), |relief| relief.log_static(to, root))
    }

    /// Records a state at the current time.
    pub fn log_frame(&self, to: &RecordingStream, fields: &Fields<'_>) -> RecordingStreamResult<()> {
        if self.what.has_planes() {
            self.log_images(to, fields)?;
        }
        self.relief.as_ref().map_or(Ok(()), |relief| relief.log_frame(to, fields))
    }

    fn log_images(&self, to: &RecordingStream, fields: &Fields<'_>) -> RecordingStreamResult<()> {
        let pressure = self.blocks.fold(fields.pressure, fields.stride, 0.0, f64::max);
        if self.what.has(Part::Mask) {
            let classes = self.rows_down(&pressure).map(|p| if p > 0.0 { CONTACT_CLASS } else { GAP_CLASS } as u8);
            let mask = SegmentationImage::update_fields().with_buffer(classes.collect::<Vec<u8>>());
            to.log(self.contact.clone(), &mask)?;
        }
        if self.what.has(Part::Fields) {
            self.pressure.log(to, self.rows_down(&pressure))?;
            let gap = self.blocks.fold(fields.gap, fields.stride, f64::INFINITY, f64::min);
            self.gap.log(to, self.rows_down(&gap))?;
        }
        Ok(())
    }

    /// Whether the contact has a picture of its own, for want of the gap to lie on.
    pub fn shows_contact_alone(&self) -> bool {
        self.what.has(Part::Mask) && !self.what.has(Part::Fields)
    }

    /// How far the fields of a state and its relief reach.
    pub fn extent(&self, fields: &Fields<'_>) -> Extent {
        let [pressure, gap] = [fields.pressure, fields.gap].map(|values| range(values.iter().copied()).1);
        let relief = self.relief.as_ref().map_or(Extent::NONE.relief, |relief| relief.extent(fields));
        Extent { pressure, gap, relief }
    }

    /// Fits colour scales and the height of the relief, for all times.
    pub fn settle(&self, to: &RecordingStream, extent: Extent) -> RecordingStreamResult<()> {
        if self.what.has(Part::Fields) {
            self.pressure.settle(to, extent.pressure, 0.0)?;
            self.gap.settle(to, extent.gap, scene::LEAST_GAP)?;
        }
        self.relief.as_ref().map_or(Ok(()), |relief| relief.settle(to, extent.relief))
    }

    fn format(&self, datatype: ChannelDatatype) -> ImageFormat {
        let [height, width] = self.blocks.cells.map(|n| n as u32);
        ImageFormat(rerun::datatypes::ImageFormat::depth([width, height], datatype))
    }

    /// Pixels row by row from the upper edge, where y is largest.
    fn rows_down<'a>(&self, blocks: &'a [f64]) -> impl Iterator<Item = f64> + use<'a> {
        blocks.rchunks(self.blocks.cells[1]).flatten().copied()
    }
}

impl Image {
    fn new(frame: Frame, scale: Axis, map: Map, unit: f64, root: String) -> Self {
        let pixels = format!("{root}/image").into();
        Self { frame, scale, map, unit, root, pixels }
    }

    fn bounds(&self) -> [f64; 4] {
        let [left, right, top, bottom] = self.frame.bounds();
        [left, right + 3.0 * f64::from(self.frame.text), top, bottom]
    }

    fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        self.frame.log(to, &format!("{}/axes", self.root))?;
        let [height, width] = [self.frame.height, self.frame.width].map(|n| n as u32);
        let style = DepthImage::update_fields()
            .with_format(ImageFormat(rerun::datatypes::ImageFormat::depth([width, height], ChannelDatatype::F32)))
            .with_meter(1.0)
            .with_colormap(self.map.viewer)
            .with_magnification_filter(MagnificationFilter::Nearest)
            .with_draw_order(0.0);
        to.log_static(self.pixels.clone(), &style)?;
        self.log_scale(to, &self.scale)
    }

    fn log(&self, to: &RecordingStream, values: impl Iterator<Item = f64>) -> RecordingStreamResult<()> {
        let bytes: Vec<u8> = values.flat_map(|v| (self.scale.number(v / self.unit) as f32).to_le_bytes()).collect();
        to.log(self.pixels.clone(), &DepthImage::update_fields().with_buffer(bytes))
    }

    fn settle(&self, to: &RecordingStream, highest: f64, least: f64) -> RecordingStreamResult<()> {
        let highest = (highest / self.unit).max(least);
        self.log_scale(to, &self.scale.up_to(scene::headroom(highest)))
    }

    /// The range of the colours, and beside the image the bar that explains it.
    fn log_scale(&self, to: &RecordingStream, scale: &Axis) -> RecordingStreamResult<()> {
        let most = scale.number(scale.high());
        let range = DepthImage::update_fields().with_depth_range(ValueRange::from([0.0, most]));
        to.log_static(self.pixels.clone(), &range)?;
        to.log_static(format!("{}/scale/colours", self.root), &self.colour_bar())?;
        to.log_static(format!("{}/scale/labels", self.root), &axes::labels(self.scale_labels(scale)))
    }

    /// Shades one above the other, each overlapped by the next.
    fn colour_bar(&self) -> LineStrips2D {
        let Frame { width, height, text, .. } = self.frame;
        let y = |shade: usize| (1.0 - shade as f32 / SHADES as f32) * height;
        let x = width + 1.1 * text;
        let bars = (0..SHADES).map(|shade| [[x, y(shade)], [x, y((shade + 2).min(SHADES))]]);
        let colours = (0..SHADES).map(|shade| self.map.at((shade as f64 + 0.5) / SHADES as f64));
        LineStrips2D::new(bars).with_colors(colours).with_radii([Radius::new_scene_units(0.3 * text)])
    }

    fn scale_labels(&self, scale: &Axis) -> Vec<([f32; 2], String)> {
        let Frame { width, height, text, .. } = self.frame;
        let at = |place: f64| (1.0 - place) as f32 * height - 0.6 * text;
        let ticks = scale.ticks().into_iter().map(|tick| ([width + 2.7 * text, at(tick.place)], tick.label));
        ticks.chain([([width + 1.1 * text, -1.9 * text], scale.title())]).collect()
    }
}

/// Pixels of an image of a surface on `grid`.
pub fn pixels(grid: &Grid) -> usize {
    Blocks::square(grid.shape(), grid.size(), PIXELS).cells.iter().product()
}

/// The names and colours of contact and gap.
pub fn classes() -> AnnotationContext {
    let class = |id, name: &str, color| AnnotationInfo { id, label: Some(name.into()), color: Some(color) };
    let clear = rerun::Rgba32::from_unmultiplied_rgba(0, 0, 0, 0);
    let [gap, contact] = [class(GAP_CLASS, "gap", clear), class(CONTACT_CLASS, "contact", colour(palette::CONTACT).0)];
    AnnotationContext::new([gap, contact])
}
