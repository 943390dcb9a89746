//! The HFM texts of profiles that say which of their points are valid.

use super::bytes::latin;
use super::channel::Channel;
use super::format::malformed;
use super::instrument::Instrument;
use super::unit::metres;
use std::io;

/// Lines of three words between semicolons: names, units in brackets, and then position, height and validity of each point. A point whose
/// validity is 0 is void.
///
/// # Source
/// The files themselves, which are text; SurfaceTopography 1.27 (`XYZ.py`) for their name.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "HFM", is_it, channels };

/// What a file begins with.
const MAGIC: &[u8] = b"X;Y;valid";

fn is_it(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let text = latin(bytes);
    let mut lines = text.lines().map(str::trim).enumerate().skip(1).filter(|(_, line)| !line.is_empty());
    let (_, units) = lines.next().ok_or_else(|| malformed("it has no line of units"))?;
    let known = |unit: &str| metres(unit).ok_or_else(|| malformed(format!("its unit {unit:?} is no length")));
    let [x_unit, unit, _] =
        words(units).ok_or_else(|| malformed(format!("its units are {units:?}, not three words")))?;
    let [lateral_unit, unit] = [known(x_unit)?, known(unit)?];
    let points = lines.map(|(place, line)| HfmPoint::new(place + 1, line)).collect::<io::Result<Vec<_>>>()?;
    if points.is_empty() {
        return Err(malformed("it contains no points"));
    }
    Ok(vec![Channel {
        is_profile: true,
        positions: Some(points.iter().map(|it| it.x).collect()),
        lateral_unit: Some(lateral_unit),
        unit: Some(unit),
        ..Channel::map("height", [1, points.len()], move || Ok(points.iter().map(|it| it.height).collect()))
    }])
}

/// The three words of a line.
fn words(line: &str) -> Option<[&str; 3]> {
    let words: Vec<&str> = line.split(';').map(str::trim).collect();
    words.try_into().ok()
}

/// A position and the height there, NaN if it is void.
struct HfmPoint {
    x: f64,
    height: f64,
}

impl HfmPoint {
    /// The point of the line at some place.
    fn new(place: usize, line: &str) -> io::Result<Self> {
        let wrong = || malformed(format!("line {place} has {line:?} instead of position, height and 0 or 1"));
        let [x, height, valid] = words(line).ok_or_else(wrong)?;
        let number = |word: &str| word.parse::<f64>().map_err(|_| wrong());
        let x = number(x)?;
        match valid {
            "1" => Ok(Self { x, height: number(height)? }),
            "0" => Ok(Self { x, height: f64::NAN }),
            _ => Err(wrong()),
        }
    }
}
