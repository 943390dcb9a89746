//! The PLUX archives of Sensofar's confocal and interferometric profilers.

use super::archive;
use super::axis::{child, find, number};
use super::bytes::{ByteReader, left_over, nodes};
use super::channel::{Channel, listed};
use super::format::malformed;
use super::instrument::Instrument;
use roxmltree::Node;
use std::io;

/// An archive whose `index.xml` says the columns and rows of an image, the distances of its points, and the file of each layer with heights
/// in single precision, row by row. All lengths are micrometres. Points that are not numbers are void.
///
/// # Source
/// Gwyddion 2.61 (`sensofarx.c`) and SurfaceTopography 1.27 (`PLUX.py`), for `FOV_X` and `FOV_Y` as the distances of points. Archives that follow
/// them are read; no file of an instrument has been tried yet.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "Sensofar PLUX", is_it, channels };

/// The name of the description.
const INDEX: &str = "index.xml";
/// The most layers that are listed.
const MOST: usize = 32;
/// Metres in the unit of all lengths.
const MICROMETRE: f64 = 1e-6;

fn is_it(bytes: &[u8]) -> bool {
    archive::names(bytes, INDEX)
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let mut archive = archive::open(bytes)?;
    let text = archive::text(&mut archive, INDEX, bytes.len())?;
    let document = archive::document(&text, INDEX)?;
    let root = document.root_element();
    let general = child(root, "GENERAL").ok_or_else(|| malformed(format!("its {INDEX} has no GENERAL")))?;
    let layers = root.children().filter(|it| it.tag_name().name().starts_with("LAYER_")).take(MOST);
    let found = layers.map(|layer| {
        let name = layer.tag_name().name().replacen("LAYER_", "layer ", 1);
        let channel = channel(bytes, general, layer, &name);
        (name, channel)
    });
    let found: Vec<_> = found.collect();
    match found.is_empty() {
        true => Err(malformed(format!("its {INDEX} has no LAYER_0"))),
        false => listed(found),
    }
}

/// The channel of a layer.
fn channel<'a>(bytes: &'a [u8], general: Node, layer: Node, name: &str) -> io::Result<Channel<'a>> {
    let file = find(layer, "FILENAME_Z").filter(|it| !it.is_empty());
    let file = file.ok_or_else(|| malformed(format!("its {name} has no FILENAME_Z")))?.to_owned();
    let needed = |path: &str| malformed(format!("its {INDEX} has no {path}"));
    let count = |path: &str| number::<i64>(general, path)?.ok_or_else(|| needed(path));
    let distance = |path: &str| number::<f64>(general, path)?.ok_or_else(|| needed(path));
    let mut archive = archive::open(bytes)?;
    let size = archive::size(&mut archive, &file, bytes.len())?;
    let [ny, nx] = nodes(count("IMAGE_SIZE_Y")?, count("IMAGE_SIZE_X")?, 4, size)?;
    let doubts = left_over(size - 4 * nx * ny, &format!("the heights in {file:?}")).into_iter().collect();
    let values = move || {
        let points = archive::first(&mut archive, &file, 4 * nx * ny)?;
        points.chunks_exact(4).map(|it| ByteReader::new(it).f32().map(f64::from)).collect()
    };
    let date = find(general, "DATE").map(|it| ("Date".to_owned(), it.to_owned()));
    Ok(Channel {
        spacing: Some([distance("FOV_Y")?, distance("FOV_X")?]),
        lateral_unit: Some(MICROMETRE),
        unit: Some(MICROMETRE),
        header: date.into_iter().collect(),
        doubts,
        ..Channel::map(name, [ny, nx], values)
    })
}
