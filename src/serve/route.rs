//! The paths of the explorer.

use super::page::Page;
use super::sessions::Sessions;
use super::site::{Intake, Reply, Site};
use super::stream::RecordingBytes;
use crate::explore::{Knobs, Lesson, MOST_HEIGHTS, RefusalRule, Request, Session, SessionRecording, read};
use serde_json::json;
use std::io;
use std::sync::Arc;
use std::time::Duration;

/// Longest wait of a request for news.
const PATIENCE: Duration = Duration::from_millis(900);

/// The page and the sessions behind it.
///
/// | path              | method | answer                                                                |
/// |-------------------|--------|-----------------------------------------------------------------------|
/// | `/`, and its files| GET    | page, script, style, viewer                                           |
/// | `/api/session`    | POST   | takes the number after which runs are numbered, begins a session; its name |
///
/// All other paths are those of one session, below `/session/NAME`:
///
/// | path              | method | answer                                                                |
/// |-------------------|--------|-----------------------------------------------------------------------|
/// | `/api/start`      | GET    | the [`Knobs`] to start with                                           |
/// | `/api/lessons`    | GET    | the lessons, see [`Lesson`]                                           |
/// | `/api/state`      | GET    | the report, at once or when it is newer than `?since=`                |
/// | `/api/leave`      | POST   | notes that the page is closed, or opened anew                         |
/// | `/run/ID.rrd`     | GET    | one of the latest recordings, as it grows                             |
/// | `/save/ID.rrd`    | GET    | one of the latest recordings, once it is complete, to save            |
///
/// The session answers all others, see [`Session::answer`].
pub struct Explorer {
    page: Page,
    sessions: Arc<Sessions>,
    start: Knobs,
    lessons: Vec<Lesson>,
}

impl Explorer {
    /// The page, with controls that start at `start`, and its lessons.
    ///
    /// # Errors
    /// If the viewer is not in the binary.
    pub fn new(sessions: Arc<Sessions>, start: Knobs, lessons: Vec<Lesson>) -> io::Result<Self> {
        Ok(Self { page: Page::new("explore", String::new())?, sessions, start, lessons })
    }

    /// A file of the page, or a new session.
    fn outside(&self, request: &Request<'_>) -> Reply {
        match (request.path, request.method) {
            ("/api/session", "POST") => match read(request.body).map(|after| self.sessions.begin(after)) {
                Ok(Ok(name)) => Reply::json(&json!({ "session": name })),
                Ok(Err(refusal)) => Reply::Error(503, refusal),
                Err(refusal) => Reply::Error(400, refusal),
            },
            ("/api/session", _) => Reply::wrong_method("POST"),
            (path, method) => match self.page.file(path) {
                Some(_) if method == "POST" => Reply::wrong_method("GET"),
                file => file.unwrap_or_else(|| Reply::missing(path)),
            },
        }
    }

    /// What is at a path of a session.
    fn inside(&self, name: &str, request: &Request<'_>) -> Reply {
        let Some(session) = self.sessions.session(name) else {
            return Reply::Error(410, RefusalRule::SessionEnded.into());
        };
        match (request.path, request.method) {
            ("/api/leave", "POST") => {
                self.sessions.leave(name);
                Reply::json(&())
            }
            ("/api/leave", _) => Reply::wrong_method("POST"),
            ("/api/start" | "/api/lessons", "POST") => Reply::wrong_method("GET"),
            ("/api/start", _) => Reply::json(&self.start),
            ("/api/lessons", _) => Reply::json(&self.lessons),
            ("/api/state", "GET") => state(&session, request.query),
            (path, "GET") => recording(&session, path).unwrap_or_else(|| session.answer(request).into()),
            _ => session.answer(request).into(),
        }
    }
}

/// The name of a session in a path, and the path below it; none of a path that is of no session.
fn split(path: &str) -> Option<(&str, &str)> {
    let below = path.strip_prefix("/session/")?;
    below.find('/').map(|end| below.split_at(end))
}

/// The report, when it is newer than the query says.
fn state(session: &Session, query: &str) -> Reply {
    let since = query.split('&').find_map(|pair| pair.strip_prefix("since="));
    match since.map_or(Ok(0), str::parse::<u64>) {
        Ok(revision) => {
            let patience = if since.is_some() { PATIENCE } else { Duration::ZERO };
            Reply::json(&session.report_after(revision, patience))
        }
        Err(_) => Reply::Error(400, "`since` is not a revision: give a whole number".into()),
    }
}

/// One of the latest recordings, to show or to save.
fn recording(session: &Session, path: &str) -> Option<Reply> {
    let (folder, file) = path.strip_prefix('/')?.split_once('/')?;
    let (id, kind) = file.rsplit_once('.')?;
    let recording = session.recording(id)?;
    match (folder, kind) {
        ("run", "rrd") => Some(Reply::Recording(RecordingBytes::Live(recording.live), None)),
        ("save", "rrd") => Some(saved_recording(recording)),
        _ => None,
    }
}

/// The recording under the name of its run, once it is complete.
fn saved_recording(recording: SessionRecording) -> Reply {
    if recording.live.written().is_some() {
        return Reply::Error(409, RefusalRule::RunGoesOn.with([("run", recording.id)]));
    }
    Reply::Recording(RecordingBytes::Live(recording.live), Some(format!("{}.rrd", recording.file_stem)))
}

impl Site for Explorer {
    fn intake(&self, path: &str) -> Intake {
        match split(path) {
            Some((_, "/api/heights")) => Intake { kind: "application/octet-stream", most: MOST_HEIGHTS },
            _ => Intake::JSON,
        }
    }

    fn is_secret(&self, path: &str) -> bool {
        split(path).is_some_and(|(name, below)| below.starts_with("/run/") && self.sessions.has(name))
    }

    fn reply(&self, request: &Request<'_>) -> Reply {
        match split(request.path) {
            Some((session, path)) => self.inside(session, &Request { path, ..*request }),
            None => self.outside(request),
        }
    }
}
