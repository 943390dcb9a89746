//! NID: a deflection and two heights, from the lowest row on.

use super::{POINTS, by_rows, height};

/// The part of a channel: its number, what its axis z is, the bits of its numbers, and their sign and order of bytes.
fn part(channel: usize, axis: &str, bits: usize, kind: &str) -> String {
    let [nx, ny] = POINTS;
    let name = ["Scan forward", "Scan backward"][channel / 2];
    format!(
        "[DataSet-{}:{}]\nVersion=2\nPoints={nx}\nLines={ny}\nFrame={name}\nDim0Name=X*\nDim0Unit=um\nDim0Range=10\n\
         Dim0Min=0\nDim1Name=Y*\nDim1Unit=nm\nDim1Range=12000\nDim1Min=0\n{axis}\nSaveMode=Binary\nSaveBits={bits}\n\
         {kind}\n\n",
        channel / 2,
        channel % 2
    )
}

/// The last row first.
fn numbers<const N: usize>(number: impl Fn(i8) -> [u8; N]) -> Vec<u8> {
    by_rows(|ix, row| number(height(ix, POINTS[1] - 1 - row))).concat()
}

pub fn file() -> Vec<u8> {
    let parts = [
        part(0, "Dim2Name=Deflection\nDim2Unit=m\nDim2Range=4\nDim2Min=-2", 16, "SaveSign=Signed\nSaveOrder=Intel"),
        part(
            1,
            "Dim2Name=Z-Axis\nDim2Unit=um\nDim2Range=65.536\nDim2Min=-32.768",
            16,
            "SaveSign=Signed\nSaveOrder=Intel",
        ),
        part(
            2,
            "Dim2Name=Z-AxisSensor\nDim2Unit=nm\nDim2Range=256\nDim2Min=-100",
            8,
            "SaveSign=Unsigned\nSaveOrder=Motorola",
        ),
    ];
    let head = "[DataSet]\nVersion=2\nGroupCount=2\nGr0-Name=Scan forward\nGr0-Count=3\nGr0-Ch0=DataSet-0:0\n\
                Gr0-Ch1=DataSet-0:1\nGr0-Ch2=DataSet-0:9\nGr1-Ch0=DataSet-1:0\n[DataSet-Info]\n-- Scan --=-----\n\
                Op. mode=Static \u{b0}\n";
    let header = [head, &parts.concat()].concat().replace('\n', "\r\n");
    let header: Vec<u8> = header.chars().map(|letter| letter as u8).collect();
    let wide = numbers(|z| i16::from(z).to_le_bytes());
    [header, b"#!".to_vec(), wide.clone(), wide, numbers(|z| [(i16::from(z) + 100) as u8])].concat()
}
