//! The pictures of a surface: pressure, gap and contact as images in the plane, the solid as a relief.

use super::canvas;
use super::eye::Eye;
use super::fields::{Extent, Fields, range};
use super::mirror::MeasuredPart;
use super::palette::{CONTACT_CLASS, CONTOUR, GAP_CLASS, Map, Palette, YIELDING_CLASS};
use super::patch_points;
use super::picture::Picture;
use super::reduce::Blocks;
use super::relief::Relief;
use super::ruler::Ruler;
use super::scale::ColourScale;
use crate::contact::{Forecast, Law};
use crate::grid::Grid;
use crate::plot::{Axis, Frame};
use crate::record::options::Options;
use crate::record::parts::Parts;
use crate::record::scene::Scene;
use crate::record::sdk::{ChannelDatatype, ImageFormat};
use crate::setup::Part;
use rerun::components::{MagnificationFilter, ValueRange};
use rerun::{DepthImage, LineStrips2D, Radius, RecordingStream, RecordingStreamResult, SegmentationImage};

/// Pictures of a surface; the flat ones lie at the same place of the canvas.
pub struct SurfacePicture {
    what: Parts,
    root: String,
    law: Law,
    blocks: Blocks,
    pressure: Image,
    gap: Image,
    relief: Option<Relief>,
    /// The part that was measured, if the rest is its mirror images.
    measured: Option<MeasuredPart>,
}

/// A field in colours, its frame and its scale.
pub struct Image {
    pub root: String,
    pub frame: Frame,
    pub colours: ColourScale,
    pub scale: Ruler,
}

impl Image {
    /// The image under `root` in a frame, with its scale and its colours.
    pub fn new(root: String, frame: &Frame, palette: &'static Palette, scale: Ruler, map: Map) -> Self {
        let colours = ColourScale { root: format!("{root}/scale"), palette, map };
        Self { root, frame: frame.clone(), colours, scale }
    }
}

/// The frame of an image of a surface, a unit for each of its blocks.
pub fn frame(grid: &Grid, blocks: &Blocks, length_unit: &str) -> Frame {
    let [height, width] = blocks.cells.map(|n| n as f64);
    let axes = [1, 0].map(|i| Ruler::new(["y", "x"][i], length_unit, [0.0, grid.size()[i]]).axis);
    canvas::image_frame(canvas::PANE, axes, [width, height])
}

impl SurfacePicture {
    pub fn new(scene: &Scene<'_>, forecast: Forecast, root: &str, options: &Options) -> Self {
        let Options { what, length_unit, theme, .. } = options;
        let palette = Palette::of(*theme);
        let problem = scene.problem;
        let grid = problem.surface().grid();
        let blocks = Blocks::image(grid);
        let frame = frame(grid, &blocks, length_unit);
        let image = |name, scale, map| Image::new(format!("{root}/{name}"), &frame, palette, scale, map);
        let [low, high] = range(problem.height().iter().copied());
        let pressure = Ruler::pressure(forecast.max_pressure, problem.contact_modulus());
        Self {
            what: *what,
            root: root.into(),
            law: problem.law(),
            blocks,
            pressure: image("pressure", pressure, Map::inferno()),
            gap: image("gap", Ruler::gap(high - low, problem.rms_height()), Map::viridis()),
            relief: what.has(Part::Mesh).then(|| Relief::new(scene, forecast, palette, root, length_unit)),
            measured: MeasuredPart::of(scene),
        }
    }

    fn log_images(&self, to: &RecordingStream, fields: &Fields<'_>) -> RecordingStreamResult<()> {
        let pressure = self.blocks.fold(&fields.pressure, fields.stride, 0.0, f64::max);
        if self.what.has(Part::Mask) {
            let class = |p: f64| match p > 0.0 {
                true if self.law.yields(p) => YIELDING_CLASS,
                true => CONTACT_CLASS,
                false => GAP_CLASS,
            };
            let classes = self.blocks.rows_down(&pressure).map(|p| class(p) as u8);
            let mask = SegmentationImage::update_fields().with_buffer(classes.collect::<Vec<u8>>());
            to.log(format!("{}/contact", self.root), &mask)?;
            let contour = LineStrips2D::update_fields().with_strips(self.contour(fields));
            to.log(format!("{}/contact/contour", self.root), &contour)?;
            let nx = self.blocks.shape[1] / fields.stride[1];
            let place = |node: usize| Some(self.pixel([node / nx, node % nx].map(|n| n as f64), fields.stride));
            patch_points::log(to, &format!("{}/contact/patches", self.root), &fields.patches, place)?;
        }
        if self.what.has(Part::Fields) {
            self.pressure.log(to, self.blocks.rows_down(&pressure))?;
            let gap = self.blocks.fold(&fields.gap, fields.stride, f64::INFINITY, f64::min);
            self.gap.log(to, self.blocks.rows_down(&gap))?;
        }
        Ok(())
    }

    /// The lines of the contour in pixels.
    fn contour<'a>(&'a self, fields: &'a Fields<'_>) -> impl Iterator<Item = [[f32; 2]; 2]> + use<'a> {
        fields.outline.contour.iter().map(move |line| line.map(|place| self.pixel(place, fields.stride)))
    }

    /// The pixel at a place in nodes of the grid with every `stride`-th node.
    fn pixel(&self, [y, x]: [f64; 2], [stride_y, stride_x]: [usize; 2]) -> [f32; 2] {
        let [per_y, per_x] = [0, 1].map(|axis| self.blocks.cells[axis] as f64 / self.blocks.shape[axis] as f64);
        let height = self.blocks.cells[0] as f64;
        [((x * stride_x as f64 + 0.5) * per_x) as f32, (height - (y * stride_y as f64 + 0.5) * per_y) as f32]
    }
}

impl Picture for SurfacePicture {
    fn frame(&self) -> &Frame {
        &self.pressure.frame
    }

    fn fit(&mut self, pane: [f64; 2]) {
        [&mut self.pressure, &mut self.gap].into_iter().for_each(|image| image.fit(pane));
    }

    fn fit_relief(&mut self, pane: [f64; 2]) {
        self.relief.iter_mut().for_each(|relief| relief.fit(pane));
    }

    fn relief(&self) -> Option<(&str, Eye)> {
        self.relief.as_ref().map(|relief| (relief.root(), relief.eye()))
    }

    fn bounds(&self) -> [f64; 4] {
        self.pressure.bounds()
    }

    fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        if self.what.has(Part::Fields) {
            for image in [&self.pressure, &self.gap] {
                image.log_static(to)?;
                let entity = format!("{}/measured", image.root);
                self.measured.map_or(Ok(()), |it| it.log(to, &entity, image.frame.size, image.colours.palette))?;
            }
        }
        let contact = format!("{}/contact", self.root);
        if self.what.has(Part::Mask) {
            let style = SegmentationImage::update_fields().with_opacity(0.9).with_draw_order(10.0);
            let format = format(&self.pressure.frame, ChannelDatatype::U8);
            to.log_static(contact.as_str(), &style.with_format(format))?;
            patch_points::log_style(to, &format!("{contact}/patches"), CONTOUR)?;
            let line = canvas::style(CONTOUR, Radius::new_ui_points(0.6), 15.0);
            to.log_static(format!("{contact}/contour"), &line)?;
        }
        if self.what.has_mask_alone() {
            let Image { frame, colours, .. } = &self.pressure;
            let entity = format!("{contact}/measured");
            self.measured.map_or(Ok(()), |measured| measured.log(to, &entity, frame.size, colours.palette))?;
            canvas::log_axes(to, self.pressure.colours.palette, &format!("{contact}/axes"), &self.pressure.frame)?;
        }
        self.relief.as_ref().map_or(Ok(()), |relief| relief.log_static(to))
    }

    fn log_frame(&self, to: &RecordingStream, fields: &Fields<'_>) -> RecordingStreamResult<()> {
        if self.what.has_planes() {
            self.log_images(to, fields)?;
        }
        self.relief.as_ref().map_or(Ok(()), |relief| relief.log_frame(to, fields))
    }

    fn extent(&self, fields: &Fields<'_>) -> Extent {
        let [pressure, gap] = [&fields.pressure, &fields.gap].map(|values| range(values.iter().copied())[1]);
        let relief = self.relief.as_ref().map_or(Extent::NONE.relief, |relief| relief.extent(fields));
        Extent { pressure, gap, relief, ..Extent::NONE }
    }

    fn settle(&self, to: &RecordingStream, extent: Extent) -> RecordingStreamResult<()> {
        if self.what.has(Part::Fields) {
            for (image, highest) in [(&self.pressure, extent.pressure), (&self.gap, extent.gap)] {
                image.log_scale(to, &image.scale.fitted(highest))?;
            }
        }
        self.relief.as_ref().map_or(Ok(()), |relief| relief.settle(to, extent.relief))
    }
}

impl Image {
    /// Makes it as large as a pane of so many points allows.
    pub fn fit(&mut self, pane: [f64; 2]) {
        canvas::fit_image(&mut self.frame, pane);
    }

    /// The part of the canvas that it takes.
    pub fn bounds(&self) -> [f64; 4] {
        canvas::bounds(&self.frame, canvas::SCALE_ROOM)
    }

    fn pixels(&self) -> String {
        format!("{}/image", self.root)
    }

    pub fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        canvas::log_axes(to, self.colours.palette, &format!("{}/axes", self.root), &self.frame)?;
        let style = DepthImage::update_fields()
            .with_format(format(&self.frame, ChannelDatatype::F32))
            .with_meter(1.0)
            .with_colormap(self.colours.map.viewer)
            .with_magnification_filter(MagnificationFilter::Nearest)
            .with_draw_order(0.0);
        to.log_static(self.pixels(), &style)?;
        self.log_scale(to, &self.scale.axis)
    }

    pub fn log(&self, to: &RecordingStream, values: impl Iterator<Item = f64>) -> RecordingStreamResult<()> {
        let bytes: Vec<u8> = values.flat_map(|value| (value as f32).to_le_bytes()).collect();
        to.log(self.pixels(), &DepthImage::update_fields().with_buffer(bytes))
    }

    /// Records the range of the colours, and beside the image the bar that explains it.
    pub fn log_scale(&self, to: &RecordingStream, scale: &Axis) -> RecordingStreamResult<()> {
        let range = ValueRange::from(scale.range.map(|number| number * self.scale.unit));
        let range = DepthImage::update_fields().with_depth_range(range);
        to.log_static(self.pixels(), &range)?;
        self.colours.log(to, &self.frame, scale)
    }
}

pub fn format(frame: &Frame, datatype: ChannelDatatype) -> ImageFormat {
    ImageFormat::depth(frame.size.map(|n| n as u32), datatype)
}
