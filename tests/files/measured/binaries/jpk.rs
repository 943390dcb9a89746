//! JPK: a TIFF of a picture, a height and a deflection, from the lowest row on.

use super::{POINTS, by_rows, height};

/// A tag: its number, its type, and the bytes of its values.
type Tag = (u16, u16, Vec<u8>);

fn text(number: u16, text: &str) -> Tag {
    (number, 2, [text.as_bytes(), &[0]].concat())
}

fn long(number: u16, value: usize) -> Tag {
    (number, 4, (value as u32).to_be_bytes().to_vec())
}

fn double(number: u16, value: f64) -> Tag {
    (number, 12, value.to_be_bytes().to_vec())
}

/// Adds a page, and where it begins at the end of the page before.
fn add(file: &mut Vec<u8>, link: usize, tags: &[Tag]) -> usize {
    let start = file.len();
    file[link..link + 4].copy_from_slice(&(start as u32).to_be_bytes());
    let mut rest: Vec<u8> = Vec::new();
    file.extend((tags.len() as u16).to_be_bytes());
    for (number, kind, bytes) in tags {
        let size = match kind {
            3 => 2,
            4 => 4,
            12 => 8,
            _ => 1,
        };
        file.extend([number.to_be_bytes(), kind.to_be_bytes()].concat());
        file.extend(((bytes.len() / size) as u32).to_be_bytes());
        let place = start + 2 + 12 * tags.len() + 4 + rest.len();
        if bytes.len() > 4 {
            file.extend((place as u32).to_be_bytes());
            rest.extend(bytes);
        } else {
            file.extend(bytes.iter().copied().chain([0; 4]).take(4));
        }
    }
    let end = file.len();
    file.extend([0; 4]);
    file.extend(rest);
    end
}

/// The tags of a channel in two strips, one of two rows, whose default slot is the second one.
fn channel(file: &mut Vec<u8>, name: &str, unit: &str) -> Vec<Tag> {
    let [nx, ny] = POINTS;
    let place = file.len();
    file.extend(by_rows(|ix, row| i16::from(height(ix, ny - 1 - row)).to_be_bytes()).concat());
    let strips = |numbers: [usize; 2]| numbers.map(|it| (it as u32).to_be_bytes()).concat();
    let half = nx * ny;
    vec![
        long(256, nx),
        long(257, ny),
        (258, 3, vec![0, 16]),
        (262, 3, vec![0, 1]),
        (273, 4, strips([place, place + half])),
        (279, 4, strips([half, half])),
        (339, 3, vec![0, 2]),
        text(0x8050, "raw"),
        (0x8051, 4, vec![0, 0, 0, 1]),
        text(0x8052, name),
        text(0x8081, "nominal"),
        text(0x8090, "volts"),
        text(0x80c0, "nominal"),
        text(0x80d2, unit),
        text(0x80d3, "LinearScaling"),
        double(0x80d4, 1e-9),
        double(0x80d5, 0.0),
    ]
}

pub fn file() -> Vec<u8> {
    let mut file = b"MM\0*\0\0\0\0".to_vec();
    let picture = [(262, 3, vec![0, 2]), double(0x8042, 10e-6), double(0x8043, 12e-6), text(0x8005, "steel")];
    let mut link = add(&mut file, 4, &picture);
    for (name, unit) in [("Vertical Deflection", "V"), ("Height", "m")] {
        let tags = channel(&mut file, name, unit);
        link = add(&mut file, link, &tags);
    }
    file
}
