//! The file of Gwyddion.

use super::file_writer::FileWriter;
use crate::formats::Scan;
use std::io::{self, Write};

/// Writes a file with one channel in metres. Voids are masked, and have the mean height below the mask, as Gwyddion keeps them.
///
/// # Source
/// "Gwyddion file format" in the user's guide of Gwyddion 2.
pub(super) fn write(scan: &Scan, file: &mut FileWriter) -> io::Result<()> {
    let heights = || scan.height.iter().copied();
    let known = heights().filter(|height| height.is_finite());
    let (sum, count) = known.fold((0.0, 0), |(sum, count), height| (sum + height, count + 1));
    let mean = if count > 0 { sum / f64::from(count) } else { 0.0 };
    let filled = heights().map(|height| if height.is_finite() { height } else { mean });
    let mut parts = vec![
        component("/0/data", b'o', &field(scan, "m", filled)),
        component("/0/data/title", b's', &text("height")),
        component("/0/data/visible", b'b', &[1]),
    ];
    if heights().any(|height| !height.is_finite()) {
        let mask = heights().map(|height| f64::from(!height.is_finite()));
        parts.push(component("/0/mask", b'o', &field(scan, "", mask)));
    }
    file.write_all(b"GWYP")?;
    file.write_all(&object("GwyContainer", &parts))
}

/// A data field of numbers in a unit on the grid of a scan.
fn field(scan: &Scan, unit_of_values: &str, values: impl Iterator<Item = f64>) -> Vec<u8> {
    let ([ny, nx], [dy, dx]) = (scan.shape(), scan.spacing);
    let unit = |name: &str, unit: &str| {
        component(name, b'o', &object("GwySIUnit", &[component("unitstr", b's', &text(unit))]))
    };
    let mut data = ((ny * nx) as u32).to_le_bytes().to_vec();
    data.extend(values.flat_map(f64::to_le_bytes));
    let parts = [
        component("xres", b'i', &(nx as u32).to_le_bytes()),
        component("yres", b'i', &(ny as u32).to_le_bytes()),
        component("xreal", b'd', &(nx as f64 * dx).to_le_bytes()),
        component("yreal", b'd', &(ny as f64 * dy).to_le_bytes()),
        unit("si_unit_xy", "m"),
        unit("si_unit_z", unit_of_values),
        component("data", b'D', &data),
    ];
    object("GwyDataField", &parts)
}

/// A text with the zero at its end.
fn text(text: &str) -> Vec<u8> {
    [text.as_bytes(), &[0]].concat()
}

/// A component of a name, a type and a value.
fn component(name: &str, kind: u8, value: &[u8]) -> Vec<u8> {
    [&text(name)[..], &[kind], value].concat()
}

/// An object of components: its name, its length and them.
fn object(name: &str, parts: &[Vec<u8>]) -> Vec<u8> {
    let length: usize = parts.iter().map(Vec::len).sum();
    [text(name), (length as u32).to_le_bytes().to_vec(), parts.concat()].concat()
}
