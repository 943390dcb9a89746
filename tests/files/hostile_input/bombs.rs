//! Small files that ask for much: time that grows faster than the file, or memory that is not there. Each is refused in a sentence.

use super::{folder, refuse, refuse_in_one_sentence};
use crate::command::{Folder, text};
use std::io::Write;
use std::process::Command;

/// The bytes of a file of NumPy with a header.
fn npy(header: &str) -> Vec<u8> {
    let length = u16::try_from(header.len()).unwrap().to_le_bytes();
    [b"\x93NUMPY\x01\x00", &length[..], header.as_bytes(), &[0; 8]].concat()
}

/// The time of the parser of such headers doubles with each bracket: forty of them would take weeks.
#[test]
fn brackets_in_brackets_are_refused() {
    let folder = folder();
    for depth in [8, 40, 1000] {
        let shape = format!("{}1{}", "(".repeat(depth), ")".repeat(depth));
        let header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}\n");
        std::fs::write(folder.join("nest.npy"), npy(&header)).unwrap();
        refuse_in_one_sentence(&folder, "surface nest.npy --size 1", "brackets around each other");
    }
}

/// A document of some megabytes would take a hundred bytes of memory for each of its elements.
#[test]
fn documents_of_too_many_elements_are_refused() {
    let folder = folder();
    let mut archive = zip::ZipWriter::new(std::fs::File::create(folder.join("many.x3p")).unwrap());
    let options = zip::write::SimpleFileOptions::default();
    archive.start_file("main.xml", options).unwrap();
    archive.write_all(format!("<a>{}</a>", "<b/>".repeat(1 << 23)).as_bytes()).unwrap();
    archive.start_file("junk", options.compression_method(zip::CompressionMethod::Stored)).unwrap();
    archive.write_all(&vec![b'j'; 1 << 20]).unwrap();
    archive.finish().unwrap();
    refuse_in_one_sentence(&folder, "surface many.x3p", "main.xml cannot be read");
}

/// A tag of a page of TIFF: number, type, count, and value or place.
fn tag(number: u16, kind: u16, count: u32, value: u32) -> Vec<u8> {
    [&number.to_be_bytes()[..], &kind.to_be_bytes(), &count.to_be_bytes(), &value.to_be_bytes()].concat()
}

/// Adds a page to a file, and returns the place of the number that tells where the next one is.
fn add_page(file: &mut Vec<u8>, link: usize, tags: &[Vec<u8>]) -> usize {
    let at = u32::try_from(file.len()).unwrap();
    file[link..link + 4].copy_from_slice(&at.to_be_bytes());
    file.extend(u16::try_from(tags.len()).unwrap().to_be_bytes());
    file.extend(tags.concat());
    file.extend([0; 4]);
    file.len() - 4
}

/// The beginning of a file of JPK, with a text of a megabyte behind its head, and the place of the link to the first page.
fn jpk() -> (Vec<u8>, [u32; 2]) {
    let mut file = b"MM\0*\0\0\0\0".to_vec();
    let text = u32::try_from(file.len()).unwrap();
    file.extend(vec![b'A'; 1 << 20]);
    let length = u32::try_from(file.len()).unwrap();
    file.extend(1e-5_f64.to_be_bytes());
    (file, [text, length])
}

/// Many names that stand in one place: read one after the other, they are gigabytes.
#[test]
fn tags_that_share_their_text_are_read_in_short() {
    let folder = folder();
    let (mut file, [text, length]) = jpk();
    let image = u32::try_from(file.len()).unwrap();
    file.extend([0; 32]);
    let lengths = || [tag(0x8042, 12, 1, length), tag(0x8043, 12, 1, length)];
    let first = [vec![tag(262, 3, 1, 2 << 16)], lengths().to_vec()].concat();
    let mut link = add_page(&mut file, 4, &first);
    for _ in 0..60 {
        let shape = [tag(256, 4, 1, 4), tag(257, 4, 1, 4), tag(258, 3, 1, 16 << 16), tag(262, 3, 1, 1 << 16)];
        let strip = [tag(273, 4, 1, image), tag(279, 4, 1, 32), tag(339, 3, 1, 2 << 16)];
        let names = [tag(0x8052, 2, 1 << 20, text), tag(0x8081, 2, (1 << 20) - 1, text)];
        let slots = (0..600).map(|i| tag(0x8090 + i * 0x30, 2, 1 << 20, text));
        let tags: Vec<Vec<u8>> = shape.into_iter().chain(strip).chain(names).chain(slots).collect();
        link = add_page(&mut file, link, &tags);
    }
    std::fs::write(folder.join("slots.jpk"), file).unwrap();
    assert!(refuse(&folder, "surface slots.jpk").chars().count() < 2500);
}

/// A page whose successor it is itself would be read for ever.
#[test]
fn pages_in_a_ring_are_refused() {
    let folder = folder();
    let (mut file, [_, length]) = jpk();
    let at = file.len();
    let tags: Vec<Vec<u8>> = (0..60_000).map(|i| tag(0x8042 + i % 2, 12, 1, length)).collect();
    let link = add_page(&mut file, 4, &tags);
    file[link..].copy_from_slice(&u32::try_from(at).unwrap().to_be_bytes());
    std::fs::write(folder.join("ring.jpk"), file).unwrap();
    refuse(&folder, "surface ring.jpk");
}

/// A word of any length in a file, and any number of words, are told of in a sentence that can be read.
#[test]
fn long_words_of_files_are_not_printed_whole() {
    let folder = folder();
    let creep = "solve --indenter sine --amplitude 1um --points 64 --size 20um --modulus 1MPa --pressure 10kPa --creep 1,9ms --path p.csv";
    for word in ["x".repeat(1 << 20), "x ".repeat(1 << 16), "µ".repeat(1 << 20)] {
        std::fs::write(folder.join("p.csv"), format!("time,load\n0,1kPa\n1,{word}\n")).unwrap();
        let said = refuse(&folder, creep);
        assert!(said.chars().count() < 2500, "{} letters: {}", said.chars().count(), &said[..300]);
        std::fs::write(folder.join("s.toml"), format!("[surface]\n{} = 1\n", word.replace(' ', ""))).unwrap();
        let said = refuse(&folder, "solve s.toml");
        assert!(said.chars().count() < 2500, "{} letters", said.chars().count());
    }
}

/// Zeros as a packed block of LZ4: a literal, one match of nearly all, and five literals at the end.
#[cfg(all(target_os = "linux", feature = "record"))]
fn packed_zeros(count: usize) -> Vec<u8> {
    let rest = count - 1 - 5 - 4 - 15;
    let length = [vec![0xff; rest / 255], vec![(rest % 255) as u8]].concat();
    [&[0x1f, 0, 1, 0][..], &length, &[0x50, 0, 0, 0, 0, 0]].concat()
}

/// A number of the protocol of recordings: seven bits in each byte.
#[cfg(all(target_os = "linux", feature = "record"))]
fn varied(mut number: usize) -> Vec<u8> {
    let mut bytes = Vec::new();
    while number > 0x7f {
        bytes.push(number as u8 | 0x80);
        number >>= 7;
    }
    bytes.push(number as u8);
    bytes
}

/// A recording whose one message unpacks to gigabytes is refused where these are not to be had, before they are asked for.
#[cfg(all(target_os = "linux", feature = "record"))]
#[test]
fn recordings_that_do_not_fit_in_memory_are_refused() {
    let folder = Folder::new();
    let run = "solve --indenter cylinder --radius 1 --points 64 --size 4 --reduced-pressure 0.01 --record small.rrd";
    assert!(folder.run(run).status.success());
    let head = std::fs::read(folder.join("small.rrd")).unwrap()[..12].to_vec();
    let unpacked = 4 << 30;
    let packed = packed_zeros(unpacked);
    let message = [&[0x10, 2, 0x18][..], &varied(unpacked), &[0x2a], &varied(packed.len()), &packed].concat();
    let kind = |kind: u64, length: usize| [kind.to_le_bytes(), (length as u64).to_le_bytes()].concat();
    let end = [&kind(0, 0)[..], &[0; 20], b"RRF2FOOT", &[0; 4]].concat();
    std::fs::write(folder.join("bomb.rrd"), [&head, &kind(2, message.len())[..], &message, &end].concat()).unwrap();
    for line in ["compare bomb.rrd bomb.rrd --out o.rrd", "solve --setup-of bomb.rrd --dry-run"] {
        let limited = format!("ulimit -v 3000000; exec {} {line}", env!("CARGO_BIN_EXE_asperity"));
        let output = Command::new("sh").args(["-c", &limited]).current_dir(folder.join("")).output().unwrap();
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{line}: {said}");
        assert!(said.contains("do not fit in memory") && said.lines().count() == 1, "{line}: {said}");
    }
}
