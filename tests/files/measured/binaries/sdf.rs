//! SDF: all types of numbers in text and binary.

use super::{POINTS, VOID, by_rows, height};

/// A text of a dialect, whose heights are a word for the void node.
pub fn text(dialect: &str, kind: &str, void: &str, end: &str) -> Vec<u8> {
    let [nx, ny] = POINTS;
    let head = format!(
        "a{dialect}\nManufacID = steel\nCreateDate = 0\nModDate = 0\nNumPoints = {nx}\nNumProfiles = {ny}\nXscale = 2.0e-006\n\
         Yscale = 3.0e-006\nZscale = 1.0e-9\nZresolution = -1\nCompression = 0\nDataType = {kind}\nCheckType = 0\n*\n"
    );
    let words = by_rows(|ix, iy| if [ix, iy] == VOID { void.to_owned() } else { height(ix, iy).to_string() });
    let rows: String = words.chunks(nx).map(|row| row.join(" ") + "\n").collect();
    (head + &rows + "*\nOperator = Mr. Jones\n*\n").replace('\n', end).into_bytes()
}

/// A binary file of a dialect, whose numbers have a type, with heights as bytes.
pub fn fixed(dialect: &str, kind: u8, heights: Vec<u8>) -> Vec<u8> {
    let counts = POINTS.map(|count| (count as u32).to_le_bytes());
    let counts: Vec<u8> =
        counts.iter().flat_map(|it| it[..if dialect == "ISO-2.0" { 4 } else { 2 }].to_vec()).collect();
    let head = format!("b{dialect}steel     {:<24}", "040120100853050320101353");
    let scales = [2e-6, 3e-6, 1e-9, -1_f64].map(f64::to_le_bytes).concat();
    [head.into_bytes(), counts, scales, vec![0, kind, 0], heights, b"Mr. Jones".to_vec()].concat()
}

/// Heights as bytes of a type, with a number for the void node; unsigned ones have no negative heights and are shifted.
pub fn numbers<T, const N: usize>(number: impl Fn(i8) -> T, void: T, bytes: fn(T) -> [u8; N]) -> Vec<u8>
where
    T: Copy,
{
    by_rows(|ix, iy| bytes(if [ix, iy] == VOID { void } else { number(height(ix, iy)) })).concat()
}

pub fn file() -> Vec<u8> {
    text("ISO-1.0", "7", "BAD", "\r\n")
}

pub fn text_of_bcr() -> Vec<u8> {
    text("BCR-1.0", "INTEGER", "32767", "\r")
}

pub fn binary() -> Vec<u8> {
    fixed("ISO-1.0", 5, numbers(i16::from, i16::MIN, i16::to_le_bytes))
}

pub fn binary_of_iso_2() -> Vec<u8> {
    fixed("ISO-2.0", 7, numbers(f64::from, f64::MIN, f64::to_le_bytes))
}
