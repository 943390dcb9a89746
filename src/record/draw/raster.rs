//! The contact step by step: how long each node has been as it is.

use super::palette::{Palette, colour, mixed};
use super::step_image::{StepImage, Steps};
use crate::diagnosis::{ContactHistory, History};
use crate::plot::{Axis, Colour};
use crate::record::sdk::{ChannelDatatype, ImageFormat};
use rerun::{AnnotationContext, AnnotationInfo, RecordingStream, RecordingStreamResult, Rgba32, SegmentationImage};

/// Rows of the image at the most, and columns.
const ROWS: usize = 512;
pub const COLUMNS: usize = 1024;
/// Classes of ages: 1 step, 2 to 3, 4 to 7 and so on.
const AGES: u8 = 8;
/// The first class of nodes in contact, and of others.
const IN: u8 = 1;
const OUT: u8 = IN + AGES;
/// Nodes that just entered or left.
const ENTERED: Colour = Colour([0xff, 0xe6, 0x66]);
const LEFT: Colour = Colour([0x40, 0xd0, 0xff]);

/// The contact along a line of nodes, step to the right, position upwards.
pub struct Raster {
    pub image: StepImage,
    /// The nodes, in their order.
    nodes: Vec<usize>,
}

/// The classes of the nodes of a raster at each step.
pub struct RasterRows(History<Vec<u8>>);

impl Raster {
    pub fn new(root: String, palette: &'static Palette, position: Axis, nodes: Vec<usize>) -> Self {
        Self { image: StepImage::new(root, palette, Some(position), false), nodes }
    }

    /// Records the names and colours of the classes.
    pub fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
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
        to.log_static(self.image.root.as_str(), &AnnotationContext::new(classes))
    }

    pub fn rows(&self) -> RasterRows {
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

    pub fn add(&self, contact: &ContactHistory, rows: &mut RasterRows) {
        rows.0.add(self.classes(contact));
    }

    /// Records the image of the steps so far.
    pub fn log(&self, to: &RecordingStream, RasterRows(rows): &RasterRows) -> RecordingStreamResult<()> {
        let (columns, height) = (rows.columns(), self.height());
        let steps = Steps { columns: columns.len(), per_column: rows.per_column() };
        let bytes: Vec<u8> = (0..height).flat_map(|row| columns.iter().map(move |column| column[row])).collect();
        let format = ImageFormat::depth([steps.columns as u32, height as u32], ChannelDatatype::U8);
        let image = SegmentationImage::update_fields().with_buffer(bytes).with_format(format).with_opacity(1.0);
        self.image.log(to, &image, height, steps)
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
