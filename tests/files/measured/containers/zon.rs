//! ZON: a picture, and an archive of heights in rows that are filled up, and of marks.

use super::{SHAPE, VOID, heights, points, zipped};

const HEIGHTS: &str = "4cdb0c75-5706-48cc-a9a1-adf395d609ae";
const MARKS: &str = "9e7ca6dd-0e6a-4d7b-8986-f0a7b773c916";
const UNITS: &str = "686613b8-27b5-4a29-8ffc-438c2780873e";

/// Points of some bytes row by row, each row filled up by three bytes.
fn grid(size: usize, points: &[u8]) -> Vec<u8> {
    let [ny, nx] = SHAPE;
    let head = [nx, ny, size, nx * size + 3].map(|it| (it as i32).to_le_bytes()).concat();
    let rows = points.chunks(nx * size).flat_map(|row| [row, &[0; 3]].concat());
    [head, rows.collect()].concat()
}

/// The file of a kind.
pub fn of_kind(kind: &[u8; 4]) -> Vec<u8> {
    let units = "<Calibration><XYCalibration><MeterPerPixel>2e-6</MeterPerPixel></XYCalibration>\
                 <ZCalibration><MeterPerUnit>1e-9</MeterPerUnit></ZCalibration></Calibration>";
    let heights: Vec<u8> = heights(-5.0).flat_map(|z| (z as i32).to_le_bytes()).collect();
    let marks: Vec<u8> = points().map(|point| if point == VOID { 0x41 } else { 0x80 }).collect();
    let files = [(UNITS, units.as_bytes()), (HEIGHTS, &grid(4, &heights)), (MARKS, &grid(1, &marks))];
    [&kind[..], &6_u32.to_le_bytes(), b"BM....", &zipped(&files)].concat()
}

pub fn file() -> Vec<u8> {
    of_kind(b"KPK0")
}
