//! The contact step by step: for how many steps each node has kept its state.

use crate::diagnosis::{ContactHistory, Diagnosis, History};
use crate::plot::{Axis, Colour};
use crate::record::draw::drawing::{Drawing, Place, RunDrawing, RunStep, Subject};
use crate::record::draw::ink::palette::{Palette, colour, mixed};
use crate::record::draw::ink::pane::Pane;
use crate::record::draw::ink::ruler::Ruler;
use crate::record::draw::instrument::flip_map::FlipMap;
use crate::record::draw::instrument::step_image::{Passed, StepAxis, StepImage};
use crate::record::draw::plane::Plane;
use crate::record::sdk::{ChannelDatatype, ImageFormat};
use rerun::{AnnotationContext, AnnotationInfo, RecordingStream, RecordingStreamResult, Rgba32, SegmentationImage};

/// Largest numbers of rows and columns of the image.
const ROWS: usize = 512;
pub(crate) const COLUMNS: usize = 1024;
/// Classes of ages: 1 step, 2 to 3, 4 to 7 and so on.
const AGES: u8 = 8;
/// The first class of nodes in contact, and of others.
const IN: u8 = 1;
const OUT: u8 = IN + AGES;
/// Nodes that just entered or left.
const ENTERED: Colour = Colour([0xff, 0xe6, 0x66]);
const LEFT: Colour = Colour([0x40, 0xd0, 0xff]);

/// The contact along a line of nodes, step to the right, position upwards.
#[derive(Clone)]
struct Raster {
    image: StepImage,
    /// The nodes, in their order.
    nodes: Vec<usize>,
}

/// The classes of the nodes of a raster at each step.
struct RasterRows(History<Vec<u8>>);

impl Raster {
    fn new(root: String, palette: &'static Palette, position: Axis, nodes: Vec<usize>) -> Self {
        Self { image: StepImage::new(root, palette, Some(position), false), nodes }
    }

    /// Records the names and colours of the classes.
    fn log_classes(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let palette = self.image.palette;
        let class = |(from, to, first, word): (Colour, Colour, u8, &'static str)| {
            (0..AGES).map(move |age| {
                let share = f64::from(age) / f64::from(AGES - 1);
                let label = format!("{word} for {}", steps_of(age));
                AnnotationInfo {
                    id: u16::from(first + age),
                    label: Some(label.into()),
                    color: Some(colour(mixed(from, to, share)).0),
                }
            })
        };
        let classes = [(ENTERED, palette.contact, IN, "in contact"), (LEFT, palette.ground, OUT, "out of contact")];
        let clear = AnnotationInfo { id: 0, label: None, color: Some(Rgba32::from_unmultiplied_rgba(0, 0, 0, 0)) };
        let classes = classes.into_iter().flat_map(class).chain([clear]);
        to.log_static(self.image.root.as_str(), &AnnotationContext::new(classes))?;
        self.image.log_cursor_style(to)
    }

    fn rows(&self) -> RasterRows {
        RasterRows(History::new(COLUMNS, |first, next| {
            first.iter_mut().zip(next).for_each(|(first, next)| *first = fresher(*first, next));
        }))
    }

    fn height(&self) -> usize {
        self.nodes.len().min(ROWS)
    }

    /// The classes of the rows of the image, from the last position on.
    fn classes(&self, contact: &ContactHistory) -> Vec<u8> {
        let height = self.height();
        let class = |&node: &usize| {
            let oldest = u32::from(AGES) - 1;
            let age = contact.age(node).map_or(oldest, |age| (age + 1).ilog2().min(oldest)) as u8;
            age + if contact.touches(node) { IN } else { OUT }
        };
        let row = |row: usize| {
            let (first, end) = (row * self.nodes.len() / height, (row + 1) * self.nodes.len() / height);
            self.nodes[first..end].iter().map(class).reduce(fresher).unwrap_or(0)
        };
        (0..height).rev().map(row).collect()
    }

    fn add(&self, contact: &ContactHistory, rows: &mut RasterRows) {
        rows.0.add(self.classes(contact));
    }

    /// Records the image of the steps so far.
    fn log(&self, to: &RecordingStream, RasterRows(rows): &RasterRows) -> RecordingStreamResult<()> {
        let (columns, height) = (rows.columns(), self.height());
        let steps = StepAxis { columns: columns.len(), per_column: rows.per_column() };
        let bytes: Vec<u8> = (0..height).flat_map(|row| columns.iter().map(move |column| column[row])).collect();
        let format = ImageFormat::depth([steps.columns as u32, height as u32], ChannelDatatype::U8);
        let image = SegmentationImage::update_fields().with_buffer(bytes).with_format(format).with_opacity(1.0);
        self.image.log(to, &image, height, steps)
    }
}

/// The rasters of a line, or those along a row and a column of a surface, and of a surface the map of changes.
struct Rasters {
    /// Rasters with their titles.
    rasters: Vec<(String, Raster)>,
    flips: Option<FlipMap>,
}

/// The drawing of the rasters of a scene.
pub(crate) fn draw(subject: &Subject<'_>) -> Option<Box<dyn Drawing>> {
    let Subject { scene, root, options, palette, plane, .. } = *subject;
    let grid = subject.grid();
    let [ny, nx] = grid.shape();
    let axis = |i: usize| Ruler::new(["y", "x"][i], &options.length_unit, [0.0, grid.size()[i]]).axis;
    let Plane::Surface(plane) = plane else {
        let raster = Raster::new(format!("{root}/raster"), palette, axis(1), (0..nx).collect());
        let rasters = vec![("Contact by step (yellow: entered, blue: left)".into(), raster)];
        return Some(Box::new(Rasters { rasters, flips: None }));
    };
    let height = scene.problem.height();
    let highest = (0..height.len()).fold(0, |best, node| if height[node] > height[best] { node } else { best });
    let [row, column] = options.raster_at.unwrap_or([highest / nx, highest % nx]);
    let along = |name: &str, at: usize, axis: Axis, nodes: Vec<usize>| {
        let raster = Raster::new(format!("{root}/raster_{name}"), palette, axis, nodes);
        (format!("Contact by step along {name} {at} (yellow: entered, blue: left)"), raster)
    };
    let rasters = vec![
        along("row", row, axis(1), (0..nx).map(|x| row * nx + x).collect()),
        along("column", column, axis(0), (0..ny).map(|y| y * nx + column).collect()),
    ];
    Some(Box::new(Rasters { rasters, flips: Some(FlipMap::new(plane)) }))
}

impl Drawing for Rasters {
    fn panes(&self) -> Vec<(Place, Pane)> {
        let rasters = self.rasters.iter().map(|(title, raster)| raster.image.pane(title));
        rasters.chain(self.flips.iter().map(FlipMap::pane)).map(|pane| (Place::RunContact, pane)).collect()
    }

    fn fit(&mut self, size: &dyn Fn(&str) -> Option<[f64; 2]>) {
        self.rasters.iter_mut().for_each(|(_, raster)| raster.image.fit(size));
        self.flips.iter_mut().for_each(|map| map.fit(size));
    }

    fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        self.rasters.iter().try_for_each(|(_, raster)| raster.log_classes(to))
    }

    fn run(&self) -> Option<Box<dyn RunDrawing>> {
        let rasters = self.rasters.iter().map(|(_, raster)| (raster.clone(), raster.rows(), Passed::default()));
        Some(Box::new(RastersOfRun { rasters: rasters.collect(), flips: self.flips.clone() }))
    }
}

/// The rasters of one run.
struct RastersOfRun {
    rasters: Vec<(Raster, RasterRows, Passed)>,
    flips: Option<FlipMap>,
}

impl RunDrawing for RastersOfRun {
    fn add(&mut self, step: &RunStep<'_, '_>) {
        let Some(diagnosis) = step.diagnosis else { return };
        for (raster, rows, passed) in &mut self.rasters {
            raster.add(diagnosis.contact(), rows);
            passed.add(step.step.work());
        }
    }

    fn show(&mut self, to: &RecordingStream, diagnosis: &Diagnosis) -> RecordingStreamResult<()> {
        self.rasters.iter().try_for_each(|(raster, rows, _)| raster.log(to, rows))?;
        self.flips.as_ref().map_or(Ok(()), |map| map.log(to, diagnosis.contact().flips()))
    }

    fn flush(&mut self, to: &RecordingStream) -> RecordingStreamResult<()> {
        self.rasters.iter_mut().try_for_each(|(raster, _, passed)| raster.image.send_cursor(to, passed))
    }
}

/// The class that changed later; of two as old, the one in contact.
fn fresher(a: u8, b: u8) -> u8 {
    let age = |class: u8| (class - IN) % AGES;
    match age(a).cmp(&age(b)) {
        std::cmp::Ordering::Less => a,
        std::cmp::Ordering::Greater => b,
        std::cmp::Ordering::Equal => a.min(b),
    }
}

fn steps_of(age: u8) -> String {
    match age {
        0 => "1 step".into(),
        _ if age + 1 == AGES => format!("{} steps or more, or always", 1u32 << age),
        _ => format!("{} to {} steps", 1u32 << age, (2u32 << age) - 1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_that_just_changed_stand_out_among_others() {
        assert_eq!((fresher(IN + 3, OUT + 1), fresher(OUT, IN + 7), fresher(OUT + 2, IN + 2)), (OUT + 1, OUT, IN + 2));
        assert_eq!([0, 1, 7].map(steps_of), ["1 step", "2 to 3 steps", "128 steps or more, or always"]);
    }
}
