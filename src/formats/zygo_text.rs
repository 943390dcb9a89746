//! The text files of Zygo's interferometers.

use super::bytes::{latin, nodes};
use super::cells::{Comma, TextCell};
use super::channel::Channel;
use super::format::malformed;
use super::instrument::Instrument;
use std::io;
use std::str::FromStr;

/// Lines of a head at fixed places up to one with `#`, then points or numbers up to the next one with `#`. Line 4 has origin, columns and rows of
/// the heights; in line 8 are the scale factor S of the interferometer, the wavelength L, the obliquity factor O and the distance of pixels
/// along both axes, in metres. In `XYZ` files a point is a column, a row and a height in micrometres, or `No Data`. In `ASCII` files intensities
/// stand first, and then phases p row by row: a height is `p S O L / R` with R of 4096, 32768 or 131072 by the first number of line 11, and it is
/// void from 2147483640 on.
///
/// # Source
/// Zygo's "MetroPro Reference Guide" OMP-0347, for both formats and for the phases; readers of others for the micrometres of `XYZ` files.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "Zygo text", is_it, channels };

/// What a file of points begins with, and one of phases.
const POINTS: &[u8] = b"Zygo XYZ Data File";
const PHASES: &[u8] = b"Zygo ASCII Data File";
/// The line at the end of the head and of each part.
const END: &str = "#";
/// Metres in a unit of heights of points.
const MICROMETRE: f64 = 1e-6;
/// Phases from here on are void.
const VOID: f64 = 2_147_483_640.0;
/// Numbers of phase in a fringe, by the resolution in the head.
const RESOLUTIONS: [f64; 3] = [4096.0, 32768.0, 131_072.0];

fn is_it(bytes: &[u8]) -> bool {
    bytes.starts_with(POINTS) || bytes.starts_with(PHASES)
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let text = latin(bytes);
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let end = lines.iter().position(|line| *line == END).ok_or_else(|| malformed("its head has no end with #"))?;
    let head = ZygoHead { lines: &lines[..end] };
    let [x, y, columns, rows] = [0, 1, 2, 3].map(|at| head.number::<i64>(4, at));
    let (origin, shape) = ([y?, x?], nodes(rows?, columns?, 1, bytes.len())?);
    let body = &lines[end + 1..];
    let (values, unit, doubts) = match bytes.starts_with(POINTS) {
        true => {
            let (values, doubts) = points(body, end + 2, origin, shape)?;
            (values, MICROMETRE, doubts)
        }
        false => (phases(body, shape)?, head.metres_of_phase()?, Vec::new()),
    };
    let pixel: f64 = head.number(8, 6)?;
    let (said, names) = (
        |line: usize| head.lines.get(line - 1).map(|it| it.trim_matches('"')),
        [(5, "comment"), (6, "serial number"), (7, "part number")],
    );
    let header = names
        .into_iter()
        .filter_map(|(line, name)| Some((name.to_owned(), said(line).filter(|it| !it.is_empty())?.to_owned())));
    Ok(vec![Channel {
        spacing: (pixel != 0.0).then_some([pixel; 2]),
        lateral_unit: Some(1.0),
        unit: Some(unit),
        header: header.collect(),
        doubts,
        ..Channel::map("height", shape, move || Ok(values))
    }])
}

/// The lines of a head.
struct ZygoHead<'a> {
    lines: &'a [&'a str],
}

impl ZygoHead<'_> {
    /// The number at a place from 0 on in a line from 1 on.
    fn number<T: FromStr>(&self, line: usize, place: usize) -> io::Result<T> {
        let text = self.lines.get(line - 1).copied().unwrap_or_default();
        let number = text.split_whitespace().nth(place).and_then(|word| word.parse().ok());
        number
            .ok_or_else(|| malformed(format!("line {line} of its head has no number at place {}: {text:?}", place + 1)))
    }

    /// Metres in a unit of phases.
    fn metres_of_phase(&self) -> io::Result<f64> {
        let [scale, wavelength, obliquity] = [self.number::<f64>(8, 1)?, self.number(8, 2)?, self.number(8, 4)?];
        let resolution: usize = self.number(11, 0)?;
        let fringe =
            RESOLUTIONS.get(resolution).ok_or_else(|| malformed(format!("its phase resolution is {resolution}")))?;
        Ok(scale * wavelength * obliquity / fringe)
    }
}

/// Heights by points, the first of them in a line from 1 on, and the doubt that some are missing.
fn points(lines: &[&str], first: usize, origin: [i64; 2], [ny, nx]: [usize; 2]) -> io::Result<(Vec<f64>, Vec<String>)> {
    let mut values = vec![f64::NAN; ny * nx];
    let mut count = 0;
    for (at, line) in lines.iter().enumerate().take_while(|it| *it.1 != END).filter(|it| !it.1.is_empty()) {
        let wrong = || malformed(format!("line {} has {line:?} instead of column, row and height", first + at));
        let [TextCell::Number(x), TextCell::Number(y), TextCell::Number(height)] = Comma::Parts.cells(line)[..] else {
            return Err(wrong());
        };
        let [iy, ix] = [y - origin[0] as f64, x - origin[1] as f64];
        let is_inside =
            iy.fract() == 0.0 && ix.fract() == 0.0 && (0.0..ny as f64).contains(&iy) && (0.0..nx as f64).contains(&ix);
        if !is_inside {
            return Err(malformed(format!(
                "line {} has {line:?}, which is none of its {ny} rows of {nx} points",
                first + at
            )));
        }
        values[iy as usize * nx + ix as usize] = height;
        count += 1;
    }
    let missing = (ny * nx).saturating_sub(count);
    Ok((values, (missing > 0).then(|| format!("{missing} of {} points are missing", ny * nx)).into_iter().collect()))
}

/// Phases row by row behind the intensities, NaN where they are void.
fn phases(lines: &[&str], [ny, nx]: [usize; 2]) -> io::Result<Vec<f64>> {
    let start =
        lines.iter().position(|line| *line == END).ok_or_else(|| malformed("its intensities have no end with #"))?;
    let words = lines[start + 1..].iter().take_while(|line| **line != END).flat_map(|line| line.split_whitespace());
    let number =
        |word: &str| word.parse::<f64>().map_err(|_| malformed(format!("it has {word:?}, which is not a number")));
    let phases = words
        .map(|word| number(word).map(|it| if it >= VOID { f64::NAN } else { it }))
        .collect::<io::Result<Vec<f64>>>()?;
    match phases.len() == ny * nx {
        true => Ok(phases),
        false => Err(malformed(format!("it has {} phases, not {ny} rows of {nx}: it is incomplete", phases.len()))),
    }
}
