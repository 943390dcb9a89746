//! Documents of MNT: a surface with a mask, and an object that is none.

use super::{SHAPE, VOID, heights};
use flate2::Compression;
use flate2::write::ZlibEncoder;
use std::io::Write;

/// Bytes of a sector.
const SECTOR: usize = 512;
/// The mark of the end of a chain of sectors, and that of the table of sectors.
const END: u32 = 0xffff_fffe;
const TABLE: u32 = 0xffff_fffd;

/// The bytes filled up to whole sectors.
fn whole(mut bytes: Vec<u8>) -> Vec<u8> {
    bytes.resize(bytes.len().next_multiple_of(SECTOR), 0);
    bytes
}

fn letters(text: &str) -> Vec<u8> {
    text.encode_utf16().flat_map(u16::to_le_bytes).collect()
}

/// An entry of the directory.
fn entry(name: &str, kind: u8, start: u32, length: usize) -> Vec<u8> {
    let mut entry = letters(name);
    let bytes = entry.len() as u16 + 2;
    entry.resize(128, 0);
    entry[64..66].copy_from_slice(&bytes.to_le_bytes());
    entry[66] = kind;
    entry[116..120].copy_from_slice(&start.to_le_bytes());
    entry[120..128].copy_from_slice(&(length as u64).to_le_bytes());
    entry
}

/// A compound document of one stream: the table of sectors, the directory and the stream, whose sectors are in turned order.
pub fn compound(name: &str, stream: &[u8]) -> Vec<u8> {
    let sectors: Vec<Vec<u8>> = whole(stream.to_vec()).chunks(SECTOR).map(<[u8]>::to_vec).collect();
    let last = sectors.len() as u32 + 1;
    let mut table = vec![TABLE, END, END];
    table.extend(2..last);
    let mut header = vec![0; 76];
    header[..8].copy_from_slice(&[0xd0, 0xcf, 0x11, 0xe0, 0xa1, 0xb1, 0x1a, 0xe1]);
    header[24..34].copy_from_slice(&[0x3e, 0, 3, 0, 0xfe, 0xff, 9, 0, 6, 0]);
    let numbers = [1, 1, 0, 4096, END, 0, END, 0].map(u32::to_le_bytes).concat();
    header[44..76].copy_from_slice(&numbers);
    header.extend(0_u32.to_le_bytes());
    header.resize(SECTOR, 0xff);
    let mut table: Vec<u8> = table.into_iter().flat_map(u32::to_le_bytes).collect();
    table.resize(SECTOR, 0xff);
    let directory = [entry("Root Entry", 5, END, 0), entry(name, 2, last, stream.len())].concat();
    [header, table, whole(directory), sectors.into_iter().rev().flatten().collect()].concat()
}

/// An entry of a tree.
fn tag(tag: u16, data: &[u8]) -> Vec<u8> {
    [&tag.to_le_bytes()[..], &(data.len() as u64).to_le_bytes(), data].concat()
}

fn tags(of: u16, inner: &[Vec<u8>]) -> Vec<u8> {
    tag(of, &inner.concat())
}

fn count(of: u16, number: u32) -> Vec<u8> {
    tag(of, &number.to_le_bytes())
}

fn text(of: u16, text: &str) -> Vec<u8> {
    tag(of, &[vec![4], letters(text)].concat())
}

/// An object of a class.
fn object(of: u16, class: u32, body: &[Vec<u8>]) -> Vec<u8> {
    tags(of, &[tags(1, &[count(1, class)]), tags(2, body)])
}

/// A scale: a step in a unit, and an origin in another one.
fn scale(step: f64, unit: &str, shown: &str, origin: f64) -> Vec<u8> {
    let numbers = [tag(1, &step.to_le_bytes()), text(2, unit), text(3, shown), tag(5, &origin.to_le_bytes())];
    tags(0xffff, &numbers)
}

fn axis(of: u16, step: f64, points: usize) -> Vec<u8> {
    tags(of, &[tags(0xffff, &[scale(step, "mm", "µm", 7.0), count(1, points as u32)])])
}

fn packed(bytes: &[u8]) -> Vec<u8> {
    let mut stream = ZlibEncoder::new(Vec::new(), Compression::default());
    stream.write_all(bytes).unwrap();
    stream.finish().unwrap()
}

/// An array of numbers of some bytes in two blocks, the second one first.
fn array(of: u16, class: u32, bytes: &[u8], size: usize) -> Vec<u8> {
    let total = bytes.len() / size;
    let block = |start: usize, end: usize| {
        let stream = packed(&bytes[start * size..end * size]);
        let head = [(end - start) as u32, stream.len() as u32].map(u32::to_le_bytes).concat();
        [&(start as u64).to_le_bytes()[..], &head, &stream].concat()
    };
    let data = [(bytes.len() as u64).to_le_bytes().to_vec(), block(7, total), block(0, 7)].concat();
    object(of, class, &[count(1, total as u32), tag(2, &data)])
}

/// A surface whose heights have some bytes and a step in a unit.
fn surface(size: usize, unit: &str) -> Vec<u8> {
    let [ny, nx] = SHAPE;
    let numbers =
        heights(f64::from(i16::MAX)).flat_map(|z| ((2.0 * (z - 100.0)) as i32).to_le_bytes()[..size].to_vec());
    let mut marks = vec![22; (nx + 2) * (ny + 2)];
    (0..ny).for_each(|iy| marks[(iy + 1) * (nx + 2) + 1..][..nx].fill(9));
    marks[(VOID[0] + 1) * (nx + 2) + VOID[1] + 1] = 22;
    let mask = [count(1, nx as u32), count(2, ny as u32), array(5, 9048, &marks, 1)];
    let name = tags(0xffff, &[tags(0xffff, &[text(1, "steel")])]);
    let grid = [name, axis(1, 2e-3, nx), axis(2, 3e-3, ny), object(3, 9056, &mask)];
    let measurement = [
        tags(0xffff, &grid),
        array(1, 9049, &numbers.collect::<Vec<u8>>(), size),
        tags(2, &[scale(0.5, unit, "µm", 0.1), count(1, 0)]),
    ];
    let title = tags(0xffff, &[text(4, "title")]);
    object(1, 9012, &[title, object(1, 9062, &[tags(0xffff, &measurement)])])
}

/// The document of some objects.
fn document(objects: &[Vec<u8>]) -> Vec<u8> {
    let list = objects.iter().flat_map(|it| [&(it.len() as u64).to_le_bytes()[..], it].concat()).collect::<Vec<u8>>();
    let version = tags(0xc8, &[count(1, 9), count(2, 2), count(3, 0), count(4, 10023)]);
    let main = [version, text(0xcb, "DS-1"), tags(0x02bd, &[tag(1, &[2]), tags(2, &[tag(1, &list)])])];
    let tree = [tag(3, &[1]), tags(1, &main), tag(0x7777, &[0; 4096])].concat();
    compound("ScopedContents", &[(tree.len() as u64).to_le_bytes().to_vec(), tree].concat())
}

pub fn file() -> Vec<u8> {
    document(&[object(1, 9000, &[count(1, 1)]), surface(4, "nm")])
}

/// Heights of two bytes, and before them a surface of another quantity.
pub fn short() -> Vec<u8> {
    document(&[surface(4, "mV"), surface(2, "nm")])
}
