//! OPDx: a map of heights, one of intensities, and a profile.

use super::{POINTS, height, singles};

/// A text or bytes behind their number in four bytes.
fn named(bytes: &[u8]) -> Vec<u8> {
    [&(bytes.len() as u32).to_le_bytes(), bytes].concat()
}

/// Bytes behind their number, which takes as many bytes as the first byte says.
fn sized(bytes: &[u8]) -> Vec<u8> {
    match u8::try_from(bytes.len()) {
        Ok(length) => [&[1, length], bytes].concat(),
        Err(_) => [&[2], &(bytes.len() as u16).to_le_bytes()[..], bytes].concat(),
    }
}

fn item(name: &str, kind: u8, content: &[u8]) -> Vec<u8> {
    [&named(name.as_bytes())[..], &[kind], content].concat()
}

fn text(name: &str, text: &str) -> Vec<u8> {
    item(name, 0x12, &sized(text.as_bytes()))
}

fn end() -> Vec<u8> {
    item("", 0x7f, &[0xff, 0xff])
}

pub fn container(name: &str, items: &[Vec<u8>]) -> Vec<u8> {
    item(name, 0x7d, &sized(&[items.concat(), end()].concat()))
}

/// A unit: its name, its symbol, its number in a metre and its dimension.
fn unit(symbol: &str) -> Vec<u8> {
    [&named(b"Unit"), &named(symbol.as_bytes()), &1e6_f64.to_le_bytes()[..], &[1], &[0; 11]].concat()
}

fn quantity(name: &str, value: f64, symbol: &str) -> Vec<u8> {
    item(name, 0x13, &sized(&[&value.to_le_bytes()[..], &unit(symbol)].concat()))
}

fn doubles(name: &str, numbers: &[f64]) -> Vec<u8> {
    let numbers: Vec<u8> = numbers.iter().flat_map(|it| it.to_le_bytes()).collect();
    let content = sized(&[&[0x0d, 8, 0, 0, 0], &numbers[..]].concat());
    item(name, 0x40, &[named(b"double *"), content].concat())
}

/// A map whose matrix has a name of its own or none.
fn map(name: &str, kind: u8, scale: Vec<u8>) -> Vec<u8> {
    let [nx, ny] = POINTS;
    let points = [&[ny as u32, nx as u32].map(u32::to_le_bytes).concat()[..], &singles(f32::NAN)].concat();
    let head = if kind == 0 { [&[7, 0, 0, 0][..], &named(b"m")].concat() } else { Vec::new() };
    let matrix = item("Matrix", kind, &[named(b"Matrix<float>"), head, sized(&points)].concat());
    let extents = [("Dimension1Extent", 3.0 * (ny - 1) as f64), ("Dimension2Extent", 2.0 * (nx - 1) as f64)];
    let extents = extents.map(|(name, extent)| quantity(name, extent, "µm")).concat();
    container(name, &[extents, scale, matrix])
}

fn written(parts: &[Vec<u8>]) -> Vec<u8> {
    [b"VCA DATA\x01\x00\x00\x55".to_vec(), parts.concat(), end()].concat()
}

/// The containers of a list of channels of heights and of what is said of the measurement.
fn about(dimension: &str, heights: &[&str]) -> Vec<u8> {
    let names: Vec<u8> = heights.iter().flat_map(|it| named(it.as_bytes())).collect();
    let list = item("Height", 0x42, &[named(b"vector<wstring>"), sized(&names)].concat());
    let settings = [text("InstrumentName", "Dektak"), quantity("StylusForce", 3.0, "mg"), item("IsTilted", 1, &[1])];
    container(
        "MetaData",
        &[
            text("PrimaryData2D", "Raw"),
            container(dimension, &[list]),
            container("Settings", &settings),
            item("TimeStamp", 0x15, &[7; 9]),
        ],
    )
}

pub fn file() -> Vec<u8> {
    let maps = [
        map("Image", 0x45, quantity("DataScale", 1.0, "")),
        map("Analyzed", 0x45, quantity("DataScale", 1.0, "nm")),
        map("Raw", 0, quantity("DataScale", 2.0, "nm")),
        container("Broken", &[text("DataKind", "Height")]),
    ];
    written(&[container("1D_Data", &[]), container("2D_Data", &maps), about("2D_Channels", &["Analyzed", "Raw"])])
}

/// A profile of the first row, at positions that are even or not.
pub fn of_positions(positions: &[f64]) -> Vec<u8> {
    let heights: Vec<f64> = (0..POINTS[0]).map(|ix| height(ix, 0).into()).collect();
    let raw = [
        item("PositionUnits", 0x18, &sized(&unit("µm"))),
        doubles("PositionArray", positions),
        quantity("Extent", 2.0 * (POINTS[0] - 1) as f64, "µm"),
        item("NumPoints", 0x0b, &(POINTS[0] as u64).to_le_bytes()),
        quantity("DataScale", 2.0, "nm"),
        doubles("Array", &heights),
    ];
    written(&[container("1D_Data", &[container("Raw", &raw)]), about("1D_Channels", &["Raw"])])
}

pub fn profile() -> Vec<u8> {
    of_positions(&[0.0, 2.0, 4.0, 6.0, 8.0])
}
