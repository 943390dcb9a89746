//! MI: a topography and frictions, from the lowest row on.

use super::{POINTS, by_rows, height};

/// A file of a kind with these numbers.
fn written(kind: &str, numbers: &[u8]) -> Vec<u8> {
    let [nx, ny] = POINTS;
    let line = |name: &str, value: &str| format!("{name:14}{value}\n");
    let common = [
        ("fileType", "Image"),
        ("version", "PicoView 0x10c04"),
        ("xNonlinearity2", "1.0"),
        ("xPixels", &nx.to_string()),
        ("yPixels", &ny.to_string()),
        ("xLength", "1.0e-005"),
        ("yLength", "1.2e-005"),
    ];
    let parts = [("Friction", "1.0", "V"), ("Topography", "32.768", "um"), ("Topography", "3.2768", "um")];
    let parts = parts.map(|(label, range, unit)| {
        [("bufferLabel", label), ("bufferRange", range), ("bufferUnit", unit)].map(|it| line(it.0, it.1)).concat()
    });
    let head = common.map(|it| line(it.0, it.1)).concat() + &parts.concat() + &line("data", kind);
    [head.as_bytes(), numbers].concat()
}

/// A height of the last row first.
fn heights<T>(of: impl Fn(i8) -> T) -> Vec<T> {
    by_rows(|ix, row| of(height(ix, POINTS[1] - 1 - row)))
}

pub fn file() -> Vec<u8> {
    written("BINARY", &heights(|z| i16::from(z).to_le_bytes()).concat().repeat(3))
}

pub fn long() -> Vec<u8> {
    written("BINARY_32", &heights(|z| (i32::from(z) << 16).to_le_bytes()).concat().repeat(3))
}

pub fn text() -> Vec<u8> {
    written("ASCII", heights(|z| format!("{z}\n")).concat().repeat(3).as_bytes())
}

/// Values of all channels in a line.
pub fn columns() -> Vec<u8> {
    let rows = heights(|z| format!("0.5\t{}\t{}\n", f64::from(z) * 1e-3, f64::from(z) * 1e-4)).concat();
    written("ASCII_MULTICOLUMN", format!("Friction(V) Topography(um) Topography(um)\n{rows}").as_bytes())
}
