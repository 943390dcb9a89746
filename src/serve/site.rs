//! The replies to requests, free of any network.

use super::stream::RecordingBytes;
use crate::explore::{Answer, Refusal, Request};
use axum::body::Bytes;

/// An answer.
pub enum Reply {
    /// A file of the page, whose kind is its MIME type.
    Page(&'static str, Bytes),
    /// A part of the page that is the same for all of a release.
    Fixed(&'static str, Bytes),
    /// A file to save under a name.
    Download(String, Vec<u8>),
    /// A recording, as it grows; with a name it is saved.
    Recording(RecordingBytes, Option<String>),
    /// A status, and why the request is refused.
    Error(u16, Refusal),
}

impl Reply {
    pub fn json(value: &impl serde::Serialize) -> Self {
        Answer::json(value).into()
    }

    pub fn missing(path: &str) -> Self {
        Answer::missing(path).into()
    }

    pub fn wrong_method(right: &str) -> Self {
        Answer::wrong_method(right).into()
    }
}

impl From<Answer> for Reply {
    fn from(answer: Answer) -> Self {
        match answer {
            Answer::Json(json) => Self::Page("application/json", json.into()),
            Answer::Download(name, bytes) => Self::Download(name, bytes),
            Answer::Refused(status, refusal) => Self::Error(status, refusal),
        }
    }
}

/// The bodies that a path takes.
#[derive(Clone, Copy)]
pub struct Intake {
    /// Their MIME type, which pages of other origins cannot send without permission.
    pub kind: &'static str,
    /// Their largest size in bytes.
    pub most: usize,
}

impl Intake {
    /// Orders of the page.
    pub const JSON: Self = Self { kind: "application/json", most: 1 << 16 };
}

/// The content of a server.
pub trait Site: Send + Sync + 'static {
    /// What a path takes.
    fn intake(&self, _path: &str) -> Intake {
        Intake::JSON
    }

    /// Whether a path has a part that nobody can guess. Who knows it has had the key, so it is served without the cookie: the viewer in the page
    /// asks for recordings without cookies.
    fn is_secret(&self, path: &str) -> bool;

    /// Answers a request; it may take its time.
    fn reply(&self, request: &Request<'_>) -> Reply;
}
