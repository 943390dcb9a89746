//! Files in archives of instruments, unpacked within limits.

#[cfg(feature = "microscopes")]
use super::bytes::latin;
use super::format::malformed;
#[cfg(feature = "microscopes")]
use super::limits::{LARGEST_RATIO, text_limit};
use super::limits::{XML_ATTRIBUTES, XML_NODES};
use crate::sentence::sentence;
use roxmltree::{Document, ParsingOptions};
use std::io::{self, Cursor, Read};
use zip::ZipArchive;
use zip::result::ZipError;

/// An archive in the bytes of a file.
pub(super) type Archive<'a> = ZipArchive<Cursor<&'a [u8]>>;

/// What an archive begins with.
const MAGIC: &[u8] = b"PK\x03\x04";

/// Whether bytes are an archive that has this name in it.
pub(super) fn names(bytes: &[u8], name: &str) -> bool {
    bytes.starts_with(MAGIC) && bytes.windows(name.len()).any(|it| it == name.as_bytes())
}

/// The archive in some bytes.
///
/// # Errors
/// For one that is damaged.
pub(super) fn open(bytes: &[u8]) -> io::Result<Archive<'_>> {
    ZipArchive::new(Cursor::new(bytes)).map_err(damaged)
}

/// The error of an archive.
pub(super) fn damaged(error: impl std::fmt::Display) -> io::Error {
    let reason = error.to_string();
    malformed(sentence!("it is an archive that cannot be unpacked: {reason}", reason))
}

/// The error of a file of an archive.
pub(super) fn missing(name: &str) -> impl Fn(ZipError) -> io::Error {
    move |error| match error {
        ZipError::FileNotFound => malformed(sentence!("it is an archive without {name:?}, which it refers to", name)),
        other => damaged(other),
    }
}

/// The bytes of a file of an archive, fewer than `limit`.
///
/// # Errors
/// For a file that is damaged or longer.
pub(super) fn bytes_of(file: impl Read, limit: u64) -> io::Result<Vec<u8>> {
    let mut text = Vec::new();
    file.take(limit).read_to_end(&mut text).map_err(damaged)?;
    match text.len() as u64 == limit {
        true => Err(malformed(format!("its description has more than {limit} bytes"))),
        false => Ok(text),
    }
}

/// The text of a file of an archive of some length, refused before it is unpacked if it states more bytes than a text may have.
///
/// # Errors
/// For a file that is missing, damaged or too long.
#[cfg(feature = "microscopes")]
pub(super) fn text(archive: &mut Archive, name: &str, length: usize) -> io::Result<String> {
    let limit = text_limit(length as u64);
    let file = archive.by_name(name).map_err(missing(name))?;
    match file.size() {
        size if size > limit => Err(malformed(format!("its file {name:?} has {size} bytes, more than {limit}"))),
        _ => Ok(latin(&bytes_of(file, limit)?)),
    }
}

/// The document in the text of a file.
///
/// # Errors
/// For a text that is no XML, or takes too long to read.
pub(super) fn document<'a>(text: &'a str, name: &str) -> io::Result<Document<'a>> {
    let attributes = text.split('<').map(|element| element.bytes().filter(|byte| *byte == b'=').count());
    let most = attributes.max().unwrap_or(0).max(text.matches("xmlns").count());
    if most > XML_ATTRIBUTES {
        return Err(malformed(format!(
            "its {name} has {most} attributes or spaces of names, more than {XML_ATTRIBUTES}"
        )));
    }
    let options = ParsingOptions { nodes_limit: XML_NODES, ..ParsingOptions::default() };
    let read = Document::parse_with_options(text, options);
    read.map_err(|error| malformed(format!("its {name} cannot be read: {error}")))
}

/// The number of bytes that a file of an archive of some length states, if that can hold them.
///
/// # Errors
/// For a file that is missing or damaged, or states more.
#[cfg(feature = "microscopes")]
pub(super) fn size(archive: &mut Archive, name: &str, length: usize) -> io::Result<usize> {
    let file = archive.by_name(name).map_err(missing(name))?;
    let size = usize::try_from(file.size()).unwrap_or(usize::MAX);
    match size <= length.saturating_mul(LARGEST_RATIO) {
        true => Ok(size),
        false => Err(malformed(format!("its file {name:?} states {size} bytes, which {length} cannot hold"))),
    }
}

/// The first `count` bytes of a file of an archive, whose check sum is compared if they are all.
///
/// # Errors
/// For a file that is missing, damaged or shorter.
#[cfg(feature = "microscopes")]
pub(super) fn first(archive: &mut Archive, name: &str, count: usize) -> io::Result<Vec<u8>> {
    let mut file = archive.by_name(name).map_err(missing(name))?;
    let mut bytes = Vec::new();
    file.by_ref().take(count as u64).read_to_end(&mut bytes).map_err(damaged)?;
    file.read(&mut [0]).map_err(damaged)?;
    match bytes.len() == count {
        true => Ok(bytes),
        false => Err(malformed(format!("its file {name:?} has {} bytes, fewer than {count}", bytes.len()))),
    }
}
