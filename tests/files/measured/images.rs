//! Grey values of images as heights.

use asperity::formats::Measurement;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use std::io::Write;

/// Columns and rows.
const SHAPE: [usize; 2] = [7, 6];

/// The grey value of a point.
fn grey(x: usize, y: usize) -> u16 {
    (40_000 - 5_000 * y + 7 * x * x * (y + 1)) as u16
}

/// A chunk of a PNG; the check sum is not looked at.
fn chunk(name: &[u8], bytes: &[u8]) -> Vec<u8> {
    [&(bytes.len() as u32).to_be_bytes()[..], name, bytes, &[0; 4]].concat()
}

/// An image of 16 bits whose rows have the filters 0 to 4, and 0 again, written out by the definition of each.
fn png(colours: u8) -> Vec<u8> {
    let [nx, ny] = SHAPE;
    let byte = |x: isize, y: isize| -> u8 {
        if x < 0 || y < 0 { 0 } else { grey(x as usize / 2, y as usize).to_be_bytes()[x as usize % 2] }
    };
    let mut rows = Vec::new();
    for y in 0..ny as isize {
        let filter = y % 5;
        rows.push(filter as u8);
        for x in 0..2 * nx as isize {
            let [left, up, corner] = [byte(x - 2, y), byte(x, y - 1), byte(x - 2, y - 1)].map(i32::from);
            let guess = left + up - corner;
            let paeth = [left, up, corner].into_iter().min_by_key(|it| (guess - it).abs()).unwrap();
            let predicted = [0, left, up, (left + up) / 2, paeth][filter as usize];
            rows.push(byte(x, y).wrapping_sub(predicted as u8));
        }
    }
    let mut packed = ZlibEncoder::new(Vec::new(), Compression::default());
    packed.write_all(&rows).unwrap();
    let packed = packed.finish().unwrap();
    let sides = [(nx as u32).to_be_bytes(), (ny as u32).to_be_bytes()].concat();
    let header = [&sides[..], &[16, colours, 0, 0, 0]].concat();
    let (one, other) = packed.split_at(packed.len() / 2);
    let parts = [
        chunk(b"IHDR", &header),
        chunk(b"tEXt", b"a\0b"),
        chunk(b"IDAT", one),
        chunk(b"IDAT", other),
        chunk(b"IEND", b""),
    ];
    [b"\x89PNG\r\n\x1a\n".to_vec(), parts.concat()].concat()
}

/// A TIFF of one strip.
fn tiff(compression: u16) -> Vec<u8> {
    let [nx, ny] = SHAPE;
    let points: Vec<u8> = (0..ny).flat_map(|y| (0..nx).flat_map(move |x| grey(x, y).to_le_bytes())).collect();
    let tags = [
        (256, nx as u32),
        (257, ny as u32),
        (258, 16),
        (259, compression.into()),
        (273, 8),
        (277, 1),
        (279, points.len() as u32),
    ];
    let tag = |(number, value): (u16, u32)| {
        [&number.to_le_bytes()[..], &4u16.to_le_bytes(), &1u32.to_le_bytes(), &value.to_le_bytes()].concat()
    };
    let start = (8 + points.len()) as u32;
    let pages: Vec<u8> = tags.into_iter().flat_map(tag).collect();
    [&b"II*\0"[..], &start.to_le_bytes(), &points, &(tags.len() as u16).to_le_bytes(), &pages, &[0; 4]].concat()
}

#[test]
fn grey_values_are_heights_without_a_unit() {
    for (file, format) in [(png(0), "PNG image"), (tiff(1), "TIFF image")] {
        let measured = Measurement::from_bytes(&file, None).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!((measured.format, measured.height.dim()), (format, (SHAPE[1], SHAPE[0])));
        assert!(measured.spacing.is_none() && !measured.is_in_metres);
        let is_right = |((y, x), height): ((usize, usize), &f64)| *height == f64::from(grey(x, y));
        assert!(measured.height.indexed_iter().all(is_right), "{format}: {:?}", measured.height);
    }
    let reason = |file: &[u8]| Measurement::from_bytes(file, None).unwrap_err().to_string();
    assert!(reason(&png(2)).contains("its colours say no heights"));
    assert!(reason(&tiff(5)).contains("compressed or have colours"));
    let file = png(0);
    assert!(!reason(&file[..file.len() / 2]).is_empty());
}
