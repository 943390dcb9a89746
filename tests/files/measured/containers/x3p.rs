//! Archives of X3P.

use super::{SHAPE, VOID, heights, points, zipped};

/// The archive of a description and of files of points and valid points.
pub fn archive(main: &[u8], data: &[u8], valid: &[u8]) -> Vec<u8> {
    zipped(&[("bindata/data.bin", data), ("bindata/valid.bin", valid), ("main.xml", main)])
}

/// A description of a kind of feature, axes and record of points.
fn description(feature: &str, axes: &str, record: &str) -> String {
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2">
  <Record1><Revision>ISO5436 - 2000</Revision><FeatureType>{feature}</FeatureType><Axes>{axes}</Axes></Record1>
  <Record2><Date>2026-11-22T09:00:00</Date><Instrument><Model>probe</Model></Instrument><Comment/></Record2>
  <Record3>{record}</Record3>
</p:ISO5436_2>"#
    )
}

/// An axis of even steps.
fn even(name: &str, step: f64) -> String {
    format!("<{name}><AxisType>I</AxisType><Increment>{step:?}</Increment><Offset>7</Offset></{name}>")
}

/// An axis whose coordinates are stored as numbers of a type.
fn stored(name: &str, kind: &str, rest: &str) -> String {
    format!("<{name}><AxisType>A</AxisType><DataType>{kind}</DataType>{rest}</{name}>")
}

/// The size of the map.
fn size() -> String {
    let [ny, nx] = SHAPE;
    format!("<MatrixDimension><SizeX>{nx}</SizeX><SizeY>{ny}</SizeY><SizeZ>1</SizeZ></MatrixDimension>")
}

const LINK: &str = "<PointDataLink>bindata/data.bin</PointDataLink>";
const VALID: &str = "<ValidPointsLink>bindata/valid.bin</ValidPointsLink>";

/// The axes of a map.
fn axes(height: &str) -> String {
    [even("CX", 2e-6), even("CY", 3e-6), height.to_owned()].concat()
}

/// The description and the points of a surface of double-precision numbers.
pub fn doubles() -> (String, Vec<u8>) {
    let record = format!("{}<DataLink>{LINK}</DataLink>", size());
    let points = heights(f64::NAN).flat_map(|z| (z * 1e-9).to_le_bytes()).collect();
    (description("SUR", &axes(&stored("CZ", "D", "")), &record), points)
}

/// A surface of double-precision numbers.
pub fn file() -> Vec<u8> {
    let (main, points) = doubles();
    archive(main.as_bytes(), &points, &[])
}

/// A surface of integers of 16 bits, some of them negative, with a file of valid points.
pub fn integers() -> Vec<u8> {
    let scale = "<Increment>1e-9</Increment><Offset>2e-7</Offset>";
    let record = format!("{}<DataLink>{LINK}{VALID}</DataLink>", size());
    let mut valid = vec![0xff; 3];
    let void = points().position(|it| it == VOID).unwrap();
    valid[void / 8] &= !(1 << (void % 8));
    let points: Vec<u8> = heights(0.0).flat_map(|z| (z as i16 - 200).to_le_bytes()).collect();
    archive(description("SUR", &axes(&stored("CZ", "I", scale)), &record).as_bytes(), &points, &valid)
}

/// A surface as a list of texts.
pub fn list() -> Vec<u8> {
    let datum = |z: f64| if z < 0.0 { "<Datum></Datum>".to_owned() } else { format!("<Datum>{:?}</Datum>", z * 1e-9) };
    let data: String = heights(-1.0).map(datum).collect();
    let record = format!("{}<DataList>{data}</DataList>", size());
    archive(description("SUR", &axes(&stored("CZ", "F", "")), &record).as_bytes(), &[], &[])
}

/// A profile of three points, its positions integers of 32 bits and its heights single-precision numbers.
pub fn profile() -> Vec<u8> {
    let axes = [stored("CX", "L", "<Increment>1e-6</Increment>"), even("CY", 0.0), stored("CZ", "F", "")].concat();
    let record = format!("<ListDimension>3</ListDimension><DataLink>{LINK}</DataLink>");
    let points = [(0i32, 1e-6f32), (1, f32::NAN), (3, 3e-6)];
    let points: Vec<u8> = points.iter().flat_map(|(x, z)| [x.to_le_bytes(), z.to_le_bytes()].concat()).collect();
    archive(description("PRF", &axes, &record).as_bytes(), &points, &[])
}
