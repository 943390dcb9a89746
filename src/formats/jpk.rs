//! The image files of JPK's scanning probe microscopes.

use super::channel::{Channel, may_be_height, new_name};
use super::format::malformed;
use super::instrument::Instrument;
use super::raster::from_below;
use super::tiff::{TiffPage, is_tiff, pages};
use super::unit::metres_of_si;
use std::io;

/// A TIFF file whose first page says lengths in metres and shows a picture, and of whose other pages each is a channel. A channel has slots,
/// each with a name and a way to turn numbers into values: the default one does so by a factor and an offset, and has a unit. Rows follow each
/// other upwards unless a flag says otherwise, so that the last one is at `y = 0`. No value is void.
///
/// # Source
/// The tags of JPK Instruments in Gwyddion (`jpk.h`), and what Gwyddion (`jpkscan.c`) and SurfaceTopography 1.27 (`JPK.py`) make of them.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "JPK image scan", is_it, channels };

/// Tags of the first page: lengths along x and y.
const LENGTHS: [u16; 2] = [0x8042, 0x8043];
/// Whether rows follow each other downwards.
const REFLECT: u16 = 0x8045;
/// Names of a channel, the better one first.
const NAMES: [u16; 2] = [0x8052, 0x8050];
/// Whether a channel is of the way back.
const RETRACE: u16 = 0x8051;
/// The name of the slot to take.
const DEFAULT_SLOT: u16 = 0x8081;
/// Tags of the first slot: its name, its unit, its way to turn numbers into values, factor and offset. Those of the next one are `STEP` higher.
const SLOT: [u16; 5] = [0x8090, 0x80a2, 0x80a3, 0x80a4, 0x80a5];
const STEP: u16 = 0x30;
/// The most slots for which there are tags.
const SLOTS: u16 = 600;
/// How zero is shown in a channel: as black.
const PHOTOMETRIC: u16 = 262;
/// Texts of the first page.
const TEXTS: [(u16, &str); 6] = [
    (0x8001, "Program"),
    (0x8003, "Start"),
    (0x8004, "Name"),
    (0x8005, "Comment"),
    (0x8006, "End"),
    (0x8007, "Sample"),
];

fn is_it(bytes: &[u8]) -> bool {
    let has_length = |pages: Vec<TiffPage>| pages.first().is_some_and(|it| it.number(LENGTHS[0]).is_some());
    is_tiff(bytes) && pages(bytes).is_ok_and(has_length)
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let pages = pages(bytes)?;
    let Some(first) = pages.first() else { return Ok(Vec::new()) };
    let length = |tag: u16| first.number(tag).ok_or_else(|| malformed(format!("it has no tag {tag:#06x} of a length")));
    let [width, height] = [length(LENGTHS[0])?, length(LENGTHS[1])?];
    let text = |(tag, name): (u16, &str)| Some((name.to_owned(), first.text(tag).filter(|it| !it.is_empty())?));
    let header: Vec<_> = TEXTS.into_iter().filter_map(text).collect();
    let is_black = |page: &&TiffPage| page.number(PHOTOMETRIC) == Some(1.0);
    let mut channels: Vec<Channel> = Vec::new();
    for page in pages.iter().filter(is_black) {
        let Some(name) = NAMES.into_iter().find_map(|tag| page.text(tag)) else { continue };
        let way = if page.number(RETRACE).is_some_and(|it| it != 0.0) { " (retrace)" } else { "" };
        let map = channel(page, new_name(&format!("{name}{way}"), &channels))?;
        let [ny, nx] = map.shape.map(|it| it as f64);
        channels.push(Channel { header: header.clone(), ..map.spaced([height / ny, width / nx], [Some(1.0); 2]) });
    }
    Ok(channels)
}

/// The channel of a page.
fn channel<'a>(page: &TiffPage<'a>, name: String) -> io::Result<Channel<'a>> {
    let image = page.image()?;
    let (shape, is_downwards) = (image.shape, page.number(REFLECT).is_some_and(|it| it != 0.0));
    let slot = page.text(DEFAULT_SLOT).and_then(|name| {
        let tags = (0..SLOTS).map(|i| SLOT.map(|tag| tag + i * STEP));
        tags.take_while(|tags| page.text(tags[0]).is_some()).find(|tags| page.text(tags[0]).as_ref() == Some(&name))
    });
    let linear = slot.filter(|tags| page.text(tags[2]).as_deref() == Some("LinearScaling"));
    let numbers = linear.and_then(|tags| Some([page.number(tags[3])?, page.number(tags[4])?]));
    let unit = linear.and_then(|tags| page.text(tags[1])).and_then(|unit| metres_of_si(&unit));
    let is_height = numbers.is_some() && unit.is_some() && may_be_height(&name);
    let [factor, offset] = numbers.unwrap_or([1.0, 0.0]);
    let values = move || {
        let heights: Vec<f64> = image.numbers()?.into_iter().map(|it| it * factor + offset).collect();
        Ok(if is_downwards { heights } else { from_below(&heights, shape[1]) })
    };
    Ok(Channel { is_height, unit, ..Channel::map(name, shape, values) })
}
