//! The image files of Nanoscope atomic force microscopes of Digital Instruments, Veeco and Bruker.

use super::bytes::{ByteReader, latin, left_over, nodes};
use super::channel::{Channel, new_name};
use super::format::malformed;
use super::instrument::Instrument;
use super::unit::metres;
use std::io;
use std::str::FromStr;

/// A header of lists of `\Name: value` lines up to `\*File list end`, and images as integers, row by row from the last
/// one on, whichever way they were scanned. An image has a Z scale, such as `V [Sens. Zsens] (0.005 V/LSB) 2.91 V`: the
/// volts of all numbers of `Bytes/pixel` bytes, to multiply by the sensitivity of that name, such as `V 20.8 nm/V`. Its
/// scan size has a unit; a scan that is not square has an aspect ratio, in the list of the image or in another one, or a slow axis. From version 9.2 on a number has four bytes, independent of `Bytes/pixel`, if the file is long
/// enough. No value is void. Images of a height or of the Z sensor are heights if their unit is one of length: a
/// deflection in nanometres is none. Files older than version 4.3, curves and text are refused.
///
/// # Source
/// "Nanoscope 4.3x and later file format description" (S. Manne, University of Arizona) for the scales; Gwyddion 2.61 (`nanoscope.c`) for
/// version 9.2 and the order of rows.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "Nanoscope", is_it, channels };

/// What a file begins with: images, images with electrochemistry, curves, and images as text.
const MAGICS: [&[u8]; 4] = [b"\\*File list", b"\\*EC File list", b"\\*Force file list", b"?*File list"];
/// The most images that a file may have, each with a header of its own.
const MOST: usize = 32;
/// The most values of a list that are said of an image.
const VALUES: usize = 100;
/// The first version whose numbers all have four bytes.
const LONG: u32 = 0x0920_0000;
/// Lists whose values are said of each image.
const COMMON: [&str; 3] = ["File list", "EC File list", "Equipment list"];
/// Values of the list of the scan that are said of each image; there are hundreds of others.
const SCAN: [&str; 6] = ["Operating mode", "Scan Rate", "Rotate Ang.", "X Offset", "Y Offset", "Tip Serial Number"];

fn is_it(bytes: &[u8]) -> bool {
    MAGICS.iter().any(|magic| bytes.starts_with(magic))
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    if bytes.first() == Some(&b'?') {
        return Err(malformed("its images are text: export them as binary data"));
    }
    let header = bytes.split(|byte| matches!(byte, 0 | 0x1a)).next().unwrap_or_default();
    let text = latin(header);
    let lists = lists(&text);
    let images: Vec<&List> = lists.iter().filter(|list| list.is_image()).collect();
    if images.len() > MOST {
        return Err(malformed(format!("it contains {} images, but at most {MOST} are read", images.len())));
    }
    let mut channels: Vec<Channel> = Vec::new();
    for image in &images {
        let (kind, label) = image.kind();
        let name = new_name(label, &channels);
        let read = channel(bytes, &name, kind, image, &lists);
        channels.push(Channel::or_unreadable(name, read));
    }
    Ok(channels)
}

/// A part of the header.
struct List<'a> {
    name: &'a str,
    entries: Vec<(&'a str, &'a str)>,
}

fn lists(text: &str) -> Vec<List<'_>> {
    let mut lists: Vec<List> = Vec::new();
    for line in text.lines().filter_map(|line| line.strip_prefix('\\')) {
        match (line.strip_prefix('*'), lists.last_mut()) {
            (Some(name), _) if name.to_lowercase().trim_end().ends_with("file list end") => break,
            (Some(name), _) => lists.push(List { name: name.trim(), entries: Vec::new() }),
            (None, Some(list)) => list.entries.extend(line.split_once(": ").map(|it| (it.0.trim(), it.1.trim()))),
            (None, None) => {}
        }
    }
    lists
}

impl<'a> List<'a> {
    /// Whether it describes an image, not a series of curves.
    fn is_image(&self) -> bool {
        let name = self.name.to_lowercase();
        name.ends_with("image list") && !name.contains("force")
    }

    fn find(&self, name: &str) -> Option<&'a str> {
        self.entries.iter().find(|it| it.0.eq_ignore_ascii_case(name)).map(|it| it.1)
    }

    fn need(&self, name: &str) -> io::Result<&'a str> {
        self.find(name).ok_or_else(|| malformed(format!("its {} has no {name}", self.name)))
    }

    /// A value of a group, such as that of `@2:Z scale`.
    fn find_in_group(&self, name: &str) -> Option<&'a str> {
        let is_it = |key: &str| {
            key.strip_prefix('@').and_then(|key| key.split_once(':')).is_some_and(|it| it.1.eq_ignore_ascii_case(name))
        };
        self.entries.iter().find(|it| is_it(it.0)).map(|it| it.1)
    }

    /// The first word of a value, which is a number.
    fn number<T: FromStr>(&self, name: &str) -> io::Result<T> {
        let value = self.need(name)?;
        let number = value.split_whitespace().next().and_then(|word| word.parse().ok());
        number.ok_or_else(|| malformed(format!("its {} has an invalid {name}: {value}", self.name)))
    }

    /// What an image shows, as a word of the format and one for people, out of `S [ZSensor] "Height Sensor"`.
    fn kind(&self) -> (&'a str, &'a str) {
        let value = self.find_in_group("Image Data").unwrap_or("S [] \"image\"");
        let (kind, label) = bracketed(value.trim_start_matches('S').trim_start(), ['[', ']']);
        (kind.unwrap_or_default(), label.trim_matches('"'))
    }
}

/// What is between brackets at the beginning of a text, which may contain such brackets, and what follows them.
fn bracketed(text: &str, [open, close]: [char; 2]) -> (Option<&str>, &str) {
    let mut depth = 0;
    let mut is_end = |letter| {
        depth += i32::from(letter == open) - i32::from(letter == close);
        depth == 0
    };
    match text.starts_with(open).then(|| text.find(&mut is_end)).flatten() {
        Some(end) => {
            let (inside, rest) = (&text[open.len_utf8()..end], &text[end + close.len_utf8()..]);
            (Some(inside).filter(|it| !it.is_empty()), rest.trim_start())
        }
        None => (None, text),
    }
}

fn channel<'a>(bytes: &'a [u8], name: &str, kind: &str, image: &List, lists: &[List]) -> io::Result<Channel<'a>> {
    let data = ByteReader::new(bytes).seek(image.number("Data offset")?)?.rest();
    let length: usize = image.number("Data length")?;
    let missing = length.saturating_sub(data.len());
    let missing =
        (missing > 0).then(|| format!("{name:?} has {length} bytes according to the file, but {missing} are missing"));
    let data = data.get(..length).unwrap_or(data);
    let [rows, columns] = [image.number("Number of lines")?, image.number("Samps/line")?];
    let [ny, nx] = nodes(rows, columns, 2, data.len())?;
    let (scaled, stored) = widths(image, lists, data.len() / (ny * nx))?;
    nodes(rows, columns, stored, data.len())?;
    let rest = left_over(data.len() - ny * nx * stored, &format!("the points of {name:?}"));
    let values = move || values(data, [ny, nx], stored);
    let map = Channel { doubts: missing.into_iter().chain(rest).collect(), ..Channel::map(name, [ny, nx], values) };
    let range = range(image, lists)?.filter(|_| matches!(kind, "Height" | "ZSensor") || map.name.contains("Height"));
    let Some(range) = range else { return Ok(Channel { is_height: false, ..map }) };
    if !range.is_finite() || range == 0.0 {
        return Err(malformed(format!("its Z scale is {range:?} metres")));
    }
    let [width, height] = scan_size(image, lists, [ny, nx])?;
    Ok(Channel {
        spacing: Some([height / ny as f64, width / nx as f64]),
        lateral_unit: Some(1.0),
        unit: Some(range / 256_f64.powi(scaled)),
        header: header(image, lists),
        ..map
    })
}

/// Bytes of a number as its scale counts them, and as they are stored, and their number.
fn widths(image: &List, lists: &[List], room: usize) -> io::Result<(i32, usize)> {
    let scaled: u8 = image.find("Bytes/pixel").map_or(Ok(2), |_| image.number("Bytes/pixel"))?;
    let version = lists.iter().find_map(|list| list.find("Version")).and_then(|it| it.strip_prefix("0x"));
    let is_long = version.and_then(|it| u32::from_str_radix(it, 16).ok()).is_some_and(|it| it >= LONG);
    match scaled {
        2 if is_long && room >= 4 => Ok((2, 4)),
        2 | 4 => Ok((scaled.into(), scaled.into())),
        _ => Err(malformed(format!("its images have {scaled} bytes per point, neither 2 nor 4"))),
    }
}

/// Integers row by row, the last row first in the file.
fn values(data: &[u8], [ny, nx]: [usize; 2], size: usize) -> io::Result<Vec<f64>> {
    let value = |bytes: &[u8]| match size {
        2 => ByteReader::new(bytes).i16().map(f64::from),
        _ => ByteReader::new(bytes).i32().map(f64::from),
    };
    let rows = data.chunks_exact(nx * size).take(ny).rev();
    rows.flat_map(|row| row.chunks_exact(size)).map(value).collect()
}

/// A number with a unit, and the name of the sensitivity to multiply it by.
struct ValueScale<'a> {
    sensitivity: Option<&'a str>,
    number: f64,
    unit: &'a str,
}

fn scale(text: &str) -> Option<ValueScale<'_>> {
    let (sensitivity, rest) = bracketed(text.strip_prefix('V')?.trim_start(), ['[', ']']);
    let (_, rest) = bracketed(rest, ['(', ')']);
    let (number, unit) = rest.split_once(' ').unwrap_or((rest, ""));
    let number = number.parse().ok().filter(|it: &f64| it.is_finite())?;
    Some(ValueScale { sensitivity, number, unit: unit.trim() })
}

/// The metres that all numbers of an image span, none if they are of another unit.
fn range(image: &List, lists: &[List]) -> io::Result<Option<f64>> {
    let text = image.find_in_group("Z scale");
    let text = text.ok_or_else(|| malformed("its images have no @2:Z scale: the file is older than version 4.3"))?;
    let hard = scale(text).ok_or_else(|| malformed(format!("its Z scale is {text:?}")))?;
    let Some(name) = hard.sensitivity else { return Ok(metres(hard.unit).map(|unit| hard.number * unit)) };
    let name = format!("@{name}");
    let soft = lists.iter().find_map(|list| list.find(&name)).and_then(scale);
    let span = |soft: ValueScale| {
        let (length, volts) = soft.unit.split_once('/')?;
        Some(hard.number * ratio(hard.unit, volts)? * soft.number * metres(length)?)
    };
    Ok(soft.and_then(span))
}

/// A unit in another one, if both are volts or the same.
fn ratio(unit: &str, other: &str) -> Option<f64> {
    let volts = |unit: &str| match unit {
        "V" | "" => Some(1.0),
        "mV" => Some(1e-3),
        _ => None,
    };
    if unit == other { Some(1.0) } else { Some(volts(unit)? / volts(other)?) }
}

/// Width and height of an image of some rows, in metres. The scan may be given by its width alone, or by its width twice, and then its
/// aspect ratio says the height, or the size of its slow axis; an image of fewer rows than its scan has is a part of it.
fn scan_size(image: &List, lists: &[List], [ny, nx]: [usize; 2]) -> io::Result<[f64; 2]> {
    let size = size(image.need("Scan Size")?)?;
    let ratio = find(image, lists, "Aspect Ratio").map(|text| aspect(text, [ny, nx])).transpose()?.unwrap_or(1.0);
    let width = size[0];
    Ok(match (find(image, lists, "Slow Axis Size"), size[..] == [width, width] || size.len() == 1) {
        (Some(slow), _) => {
            let whole: Option<i64> = lists.iter().find_map(|list| list.number("Lines").ok());
            let part = whole
                .filter(|whole| ratio != 1.0 && (ny as i64) < *whole)
                .map_or(1.0, |whole| ny as f64 / whole as f64);
            [width, self::size(slow)?[0] * part]
        }
        (None, true) => [width, width / ratio],
        (None, false) => [width, size[1]],
    })
}

/// A value of an image, or else of the first list that has it and describes no other image.
fn find<'a>(image: &List<'a>, lists: &[List<'a>], name: &str) -> Option<&'a str> {
    image.find(name).or_else(|| lists.iter().filter(|list| !list.is_image()).find_map(|list| list.find(name)))
}

/// The ratio of width and height of an image of rows and columns, such as 2 in `2:1`. A number alone is that ratio or its inverse: the one that
/// makes the pixels more nearly square is taken, and of equally good ones that of an image with lines longer than it is high.
fn aspect(text: &str, [ny, nx]: [usize; 2]) -> io::Result<f64> {
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|it| *it > 0.0 && it.is_finite());
    let ratio = match text.split_once(':') {
        Some((width, height)) => number(width).zip(number(height)).map(|(x, y)| x / y),
        None => number(text).map(|ratio| {
            let [wide, high] = [ratio.max(1.0 / ratio), ratio.min(1.0 / ratio)];
            let distortion = |ratio: f64| (ny as f64 * ratio / nx as f64).ln().abs();
            if distortion(high) < distortion(wide) - 1e-9 { high } else { wide }
        }),
    };
    let ratio = ratio.filter(|ratio| *ratio > 0.0 && ratio.is_finite());
    ratio.ok_or_else(|| malformed(format!("its aspect ratio is {text:?}")))
}

/// One or two lengths with a unit, in metres.
fn size(text: &str) -> io::Result<Vec<f64>> {
    let wrong = || malformed(format!("its scan size is {text:?}"));
    let words: Vec<&str> = text.split_whitespace().collect();
    let (unit, numbers) = words.split_last().ok_or_else(wrong)?;
    let unit = metres(unit).ok_or_else(wrong)?;
    let lengths = numbers.iter().map(|it| it.parse::<f64>().map(|it| it * unit));
    let lengths: Vec<f64> = lengths.collect::<Result<_, _>>().map_err(|_| wrong())?;
    if (1..=2).contains(&lengths.len()) { Ok(lengths) } else { Err(wrong()) }
}

/// What the file says of an image.
fn header(image: &List, lists: &[List]) -> Vec<(String, String)> {
    let common = lists.iter().filter(|list| COMMON.contains(&list.name)).flat_map(|list| &list.entries).take(VALUES);
    let scan = SCAN.iter().filter_map(|name| Some((*name, lists.iter().find_map(|list| list.find(name))?)));
    let all = common.copied().chain(scan).chain(image.entries.iter().copied().take(VALUES));
    all.filter(|it| !it.1.is_empty()).map(|(name, value)| (name.to_owned(), value.to_owned())).collect()
}
