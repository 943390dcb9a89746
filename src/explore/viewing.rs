//! A recording in the viewer of the page, and nothing else.

use super::page::{Page, Purpose};
use super::site::{Reply, Request, Site};
use super::stream::RecordingBytes;
use std::fs::File;
use std::io;
use std::path::PathBuf;

/// The viewer, and the one file that it shows.
pub struct Viewing {
    page: Page,
    file: PathBuf,
}

impl Viewing {
    /// The viewer with the recording in `file`.
    ///
    /// # Errors
    /// If the viewer is not in the binary.
    pub fn new(file: PathBuf) -> io::Result<Self> {
        Ok(Self { page: Page::new(Purpose::View)?, file })
    }
}

impl Site for Viewing {
    fn reply(&self, request: &Request<'_>) -> Reply {
        match request.path {
            _ if request.method != "GET" => Reply::wrong_method("GET"),
            "/recording.rrd" => match File::open(&self.file) {
                Ok(file) => Reply::Recording(RecordingBytes::File(file), None),
                Err(error) => Reply::Error(404, error.to_string()),
            },
            path => self.page.file(path).unwrap_or_else(|| Reply::missing(path)),
        }
    }
}
