//! The BCR-STM files of scanning probe microscopes and of SPIP.

use super::bytes::{ByteReader, latin, left_over};
use super::channel::Channel;
use super::entries::Entries;
use super::format::malformed;
use super::instrument::Instrument;
use super::number_type::NumberType;
use super::raster::ChannelRaster;
use super::unit::metres;
use std::io;

/// A header of lines of `name = value` in letters of one byte or, since version 4.2 of SPIP, of two bytes, padded to 2048 letters or to
/// `headersize`, and numbers row by row. Those of `bcrstm` are integers of two bytes, each worth `bit2nm`, those of `bcrf` heights in single
/// precision; `intelmode` is 0 if the most significant byte comes first. Units are nanometres if nothing else is said. An integer of 32767 is
/// void, and a height above 1.7e38. The lowest height `zmin` is not applied: it moves the heights as a whole.
///
/// # Source
/// "BCR-STM File Format" in the reference guide of SPIP 6 (Image Metrology); Gwyddion (`bcrfile.c`) for voids.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "BCR-STM (BCR, BCRF)", is_it, channels };

/// What the header begins with.
const MAGIC: &str = "fileformat = bcr";
/// Letters of the header if it does not say so.
const HEADER: usize = 2048;
/// The most letters that a header is believed to have.
const LONGEST: usize = 1 << 20;
/// An integer that is void.
const VOID: f64 = 32767.0;
/// A height that is void is above this one.
const HIGHEST: f64 = 1.7e38;

fn is_it(bytes: &[u8]) -> bool {
    let wide: Vec<u8> = MAGIC.bytes().flat_map(|letter| [letter, 0]).collect();
    bytes.starts_with(MAGIC.as_bytes()) || bytes.starts_with(&wide)
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let is_wide = bytes.get(1) == Some(&0);
    let short = entries(bytes, is_wide, HEADER);
    let letters = short.find("headersize").map_or(Ok(HEADER), |_| short.number("headersize"))?;
    if letters > LONGEST {
        return Err(malformed(format!("it states a header of {letters} letters")));
    }
    let entries = entries(bytes, is_wide, letters);
    let is_big = entries.find("intelmode").is_some_and(|mode| mode == "0");
    let mut at = ByteReader::new(bytes).seek(if is_wide { 2 * letters } else { letters })?.big_endian(is_big);
    let shape = [entries.number("ypixels")?, entries.number("xpixels")?];
    let unit_of = |name: &str| metres(entries.find(name).unwrap_or("nm"));
    let Some(unit) = unit_of("zunit") else {
        return Err(malformed(format!("its heights are in {:?}, which is no length", entries.need("zunit")?)));
    };
    let is_integer = entries.need("fileformat")?.starts_with("bcrstm");
    let raster = ChannelRaster::new(&mut at, if is_integer { NumberType::I16 } else { NumberType::F32 }, shape)?;
    let is_void = move |it: f64| if is_integer { it == VOID } else { it > HIGHEST };
    let height = move |number| if is_void(number) { f64::NAN } else { number };
    let values = move || Ok(raster.numbers()?.into_iter().map(height).collect());
    let factor = if is_integer { entries.number("bit2nm")? } else { 1.0 };
    let [ny, nx] = raster.shape.map(|it| it as f64);
    let spacing = [entries.number::<f64>("ylength")? / ny, entries.number::<f64>("xlength")? / nx];
    Ok(vec![Channel {
        unit: Some(factor * unit),
        header: entries.header(),
        doubts: left_over(at.rest().len(), "the last row").into_iter().collect(),
        ..Channel::map("height", raster.shape, values).spaced(spacing, [unit_of("yunit"), unit_of("xunit")])
    }])
}

/// What the first letters say.
fn entries(bytes: &[u8], is_wide: bool, letters: usize) -> Entries {
    let text = if is_wide {
        let units = bytes.chunks_exact(2).take(letters).map(|it| u16::from_le_bytes([it[0], it[1]]));
        char::decode_utf16(units).map(|letter| letter.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
    } else {
        latin(&bytes[..letters.min(bytes.len())])
    };
    Entries::from_lines(text.lines().filter(|line| !line.starts_with(['%', '#'])), '=')
}
