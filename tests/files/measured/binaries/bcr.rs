//! BCR-STM: integers and heights in single precision.

use super::{POINTS, VOID, by_rows, height};

/// The lines of a header, with its length in letters if that is said.
fn header(kind: &str, is_big: bool, letters: usize) -> String {
    let [nx, ny] = POINTS;
    let length = if letters == 2048 { String::new() } else { format!("headersize = {letters}\n") };
    let lines = format!(
        "fileformat = {kind}\n% a remark\n{length}xpixels = {nx}\nypixels = {ny}\nxlength = 10\nylength = 12.0\n\
         xunit = um\n yunit = um\nintelmode = {}\nbit2nm = 0.5\nvoidpixels = 1\n",
        u8::from(!is_big)
    );
    format!("{lines:letters$}")
}

pub fn file() -> Vec<u8> {
    let number = |ix, iy| if [ix, iy] == VOID { i16::MAX } else { 2 * i16::from(height(ix, iy)) };
    let numbers = by_rows(|ix, iy| number(ix, iy).to_be_bytes()).concat();
    [header("bcrstm", true, 2048).into_bytes(), numbers].concat()
}

/// A header of letters of two bytes, and heights.
pub fn wide() -> Vec<u8> {
    let header = header("bcrf_unicode", false, 2100).replace("bit2nm", "zunit = pm\nbit2nm");
    let header: Vec<u8> = header.encode_utf16().take(2100).flat_map(u16::to_le_bytes).collect();
    let number = |ix, iy| if [ix, iy] == VOID { 3.4e38 } else { 1000.0 * f32::from(height(ix, iy)) };
    [header, by_rows(|ix, iy| number(ix, iy).to_le_bytes()).concat()].concat()
}
