//! Gwyddion's files.

use super::{SHAPE, VOID, heights, points};

/// A text with a zero at its end.
fn text(text: &str) -> Vec<u8> {
    [text.as_bytes(), &[0]].concat()
}

/// A component of an object.
fn component(name: &str, kind: char, value: &[u8]) -> Vec<u8> {
    [&text(name), &[kind as u8][..], value].concat()
}

/// An object of components.
fn object(name: &str, components: &[Vec<u8>]) -> Vec<u8> {
    let components = components.concat();
    [text(name), (components.len() as u32).to_le_bytes().to_vec(), components].concat()
}

/// An array of double-precision numbers.
fn doubles(numbers: impl Iterator<Item = f64>) -> Vec<u8> {
    let bytes: Vec<u8> = numbers.flat_map(f64::to_le_bytes).collect();
    [&((bytes.len() / 8) as u32).to_le_bytes(), &bytes[..]].concat()
}

/// A unit.
fn unit(name: &str, unit: &str) -> Vec<u8> {
    component(name, 'o', &object("GwySIUnit", &[component("unitstr", 's', &text(unit))]))
}

/// A data field.
fn field(along: &str, across: &str, numbers: impl Iterator<Item = f64>) -> Vec<u8> {
    let components = [
        component("xres", 'i', &(SHAPE[1] as i32).to_le_bytes()),
        component("yres", 'i', &(SHAPE[0] as i32).to_le_bytes()),
        component("xreal", 'd', &(SHAPE[1] as f64 * 2e-6).to_le_bytes()),
        component("yreal", 'd', &(SHAPE[0] as f64 * 3e-6).to_le_bytes()),
        component("xoff", 'd', &0.25f64.to_le_bytes()),
        unit("si_unit_xy", along),
        unit("si_unit_z", across),
        component("data", 'D', &doubles(numbers)),
    ];
    object("GwyDataField", &components)
}

/// A current, then heights with a mask, remarks, and components of every type.
pub fn file() -> Vec<u8> {
    let mask = points().map(|point| f64::from(point == VOID));
    let meta = object("GwyContainer", &[component("Tip", 's', &text("blunt"))]);
    let strings = [&2u32.to_le_bytes()[..], &text("a"), &text("b")].concat();
    let objects = [&1u32.to_le_bytes()[..], &object("GwySIUnit", &[])].concat();
    let components = [
        component("/filename", 's', &text("a.gwy")),
        component("/0/data/visible", 'b', &[1]),
        component("/3/data", 'o', &field("m", "m", heights(-1.0).map(|z| z * 1e-9))),
        component("/3/data/title", 's', &text("Topography")),
        component("/3/mask", 'o', &field("m", "", mask)),
        component("/3/meta", 'o', &meta),
        component("/0/data", 'o', &field("m", "A", heights(1.0))),
        component("/0/data/title", 's', &text("Current")),
        component("/texts", 'S', &strings),
        component("/objects", 'O', &objects),
        component("/bytes", 'C', &[1, 0, 0, 0, 7]),
        component("/long", 'q', &[0; 8]),
        component("/longs", 'Q', &[1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]),
        component("/integers", 'I', &[1, 0, 0, 0, 0, 0, 0, 0]),
    ];
    [b"GWYP".to_vec(), object("GwyContainer", &components)].concat()
}
