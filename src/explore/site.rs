//! Requests and replies, free of any network.

use super::stream::RecordingBytes;
use axum::body::Bytes;

/// A request that passed the guards.
pub struct Request<'a> {
    pub method: &'a str,
    /// Path, from the first `/` on.
    pub path: &'a str,
    /// Query, all after the `?`.
    pub query: &'a str,
    pub body: &'a [u8],
}

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
    /// An error and what to say about it.
    Error(u16, String),
}

impl Reply {
    pub fn json(value: &impl serde::Serialize) -> Self {
        match serde_json::to_vec(value) {
            Ok(json) => Self::Page("application/json", json.into()),
            Err(error) => Self::Error(500, error.to_string()),
        }
    }

    pub fn missing(path: &str) -> Self {
        let path: String = path.chars().take(80).collect();
        Self::Error(404, format!("there is nothing at {path}"))
    }

    pub fn wrong_method(right: &str) -> Self {
        Self::Error(405, format!("only {right} is accepted here"))
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

    /// Answers a request; it may take its time.
    fn reply(&self, request: &Request<'_>) -> Reply;
}
