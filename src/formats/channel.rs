//! The channels of a file of an instrument.

use super::format::malformed;
use crate::sentence::{Sentence, sentence};
use std::io;

/// Words in the names of channels that are lengths, but no heights.
#[cfg(feature = "microscopes")]
const NO_HEIGHTS: [&str; 3] = ["amplitude", "deflection", "error"];

/// One of the fields in a file of an instrument. Its values are read on request.
///
/// Rows follow each other along y and columns along x, the first row at `y = 0`, as in the file. Values times `unit`
/// are metres, and so are distances times `lateral_unit`; a file without units has neither.
pub(super) struct Channel<'a> {
    /// The name by which it is chosen.
    pub name: String,
    /// Whether its values are heights: other fields, such as a phase, are listed but not read.
    pub is_height: bool,
    /// Why it cannot be read, if that is so; it is listed all the same.
    pub fault: Option<String>,
    /// Rows and columns; a profile has one row.
    pub shape: [usize; 2],
    /// Whether it is a profile, not a map of one row.
    pub is_profile: bool,
    /// Spacing of rows and of columns, if the file has it.
    pub spacing: Option<[f64; 2]>,
    /// Positions along x of a profile that is not known to be evenly spaced.
    pub positions: Option<Vec<f64>>,
    /// Metres in a unit of distances.
    pub lateral_unit: Option<f64>,
    /// Metres in a unit of heights.
    pub unit: Option<f64>,
    /// Other metadata of the file: names and values.
    pub header: Vec<(String, String)>,
    /// Inconsistencies in the file, such as bytes that belong to no part.
    pub doubts: Vec<String>,
    /// Values row by row, NaN where there are none.
    pub values: Box<dyn FnOnce() -> io::Result<Vec<f64>> + 'a>,
}

impl<'a> Channel<'a> {
    /// A channel of heights on a map, without units, distances and header.
    pub(crate) fn map(
        name: impl Into<String>,
        shape: [usize; 2],
        values: impl FnOnce() -> io::Result<Vec<f64>> + 'a,
    ) -> Self {
        let (is_height, is_profile, values) = (true, false, Box::new(values));
        let (fault, spacing, positions, lateral_unit, unit, header, doubts) = Default::default();
        let name = name.into();
        Self {
            name,
            is_height,
            fault,
            shape,
            is_profile,
            spacing,
            positions,
            lateral_unit,
            unit,
            header,
            doubts,
            values,
        }
    }

    /// The channel of a name, or one with a fault where it cannot be read: the other channels of the file can be read all the same.
    pub(crate) fn or_unreadable(name: impl Into<String>, found: io::Result<Self>) -> Self {
        found.unwrap_or_else(|error| Self {
            is_height: false,
            fault: Some(error.to_string()),
            ..Self::map(name, [0, 0], || Ok(Vec::new()))
        })
    }

    /// The channel with the spacing of its rows and of its columns, each in a unit of so many metres, or without any.
    #[cfg(feature = "microscopes")]
    pub(crate) fn spaced(self, spacing: [f64; 2], units: [Option<f64>; 2]) -> Self {
        let (spacing, lateral_unit) = match (units, spacing) {
            ([Some(along), Some(across)], [y, x]) => ([y * along, x * across], Some(1.0)),
            _ => (spacing, None),
        };
        Self { spacing: Some(spacing), lateral_unit, ..self }
    }
}

/// The name of the next channel: the same, or with its number behind it if one before has that name.
pub(super) fn new_name(name: &str, before: &[Channel]) -> String {
    let is_new = before.iter().all(|it| it.name != name);
    if is_new { name.to_owned() } else { format!("{name} ({})", before.len() + 1) }
}

/// Whether a channel of lengths holds heights, judged by its name.
#[cfg(feature = "microscopes")]
pub(super) fn may_be_height(name: &str) -> bool {
    let name = name.to_lowercase();
    !NO_HEIGHTS.iter().any(|word| name.contains(word))
}

/// The channels of these names. One that cannot be read is listed as one that contains no heights.
///
/// # Errors
/// The first error, if no channel of heights can be read.
#[cfg(feature = "microscopes")]
pub(super) fn listed<'a>(found: Vec<(impl Into<String>, io::Result<Channel<'a>>)>) -> io::Result<Vec<Channel<'a>>> {
    let channels: Vec<_> = found.into_iter().map(|(name, channel)| Channel::or_unreadable(name, channel)).collect();
    match channels.iter().find_map(|it| it.fault.as_ref()).filter(|_| channels.iter().all(|it| !it.is_height)) {
        Some(fault) => Err(malformed(fault.as_str())),
        None => Ok(channels),
    }
}

/// The channel with a name or a number (1, 2, ...); by default, the first channel of heights that can be read.
///
/// # Errors
/// For a channel that is not there, holds no heights or cannot be read, with the names of those that can.
pub(super) fn choose<'a>(channels: Vec<Channel<'a>>, wanted: Option<&str>) -> io::Result<Channel<'a>> {
    let names: Vec<String> = channels.iter().filter(|it| it.is_height).map(|it| format!("{:?}", it.name)).collect();
    let names = names.join(", ");
    let all: Vec<String> = channels.iter().map(|it| format!("{:?}", it.name)).collect();
    let number = wanted.and_then(|name| name.parse::<usize>().ok());
    let is_wanted = |(i, it): &(usize, Channel)| match wanted {
        None => it.is_height,
        Some(name) => it.name == name || number == Some(i + 1),
    };
    let fault = channels.iter().find_map(|it| it.fault.clone());
    let found = channels.into_iter().enumerate().find(is_wanted).map(|(_, it)| it);
    Err(malformed(match (found, wanted) {
        (Some(channel), _) if channel.is_height => return Ok(channel),
        (Some(Channel { name, fault: Some(fault), .. }), _) => {
            let others = if names.is_empty() { String::new() } else { format!(": choose one of {names}") };
            format!("its channel {name:?} cannot be read, because {fault}{others}").into()
        }
        (Some(channel), _) => {
            sentence!("its channel {name:?} contains no heights: choose one of {names}", name = channel.name, names)
        }
        (None, Some(name)) => sentence!("it has no channel {name:?}: choose one of {names}", name, names),
        (None, None) if all.is_empty() => "it contains no heights".into(),
        (None, None) => fault.map_or_else(
            || sentence!("it contains no heights: none of its channels {names} is a length", names = all.join(", ")),
            Sentence::from,
        ),
    }))
}
