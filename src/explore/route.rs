//! The paths of the explorer.

use super::facet::{FACETS, MOTION};
use super::height_name::plain_name;
use super::knobs::Knobs;
use super::lesson::Lesson;
use super::page::Page;
use super::refusal::{Refusal, plain};
use super::schema::MOST_HEIGHTS;
use super::session::{RunKind, Session};
use super::session_recording::SessionRecording;
use super::sessions::Sessions;
use super::site::{Intake, Reply, Request, Site};
use super::stream::RecordingBytes;
use crate::contact::OBSERVABLES;
use crate::surface::HeightFile;
use serde::Serialize;
use serde::de::DeserializeOwned;
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
/// | `/api/observables`| GET    | names and meanings of the numbers in a report                         |
/// | `/api/state`      | GET    | the report, at once or when it is newer than `?since=`        |
/// | `/api/solve`      | POST   | takes [`Knobs`], ends what runs; the revision from which on news of it come |
/// | `/api/sweep`      | POST   | the same for a sweep                                                  |
/// | `/api/cancel`     | POST   | ends what runs                                                        |
/// | `/api/pin`        | POST   | takes the name of a recording, or null: its curves stand beside new ones |
/// | `/api/leave`      | POST   | notes that the page is closed, or opened anew                         |
/// | `/api/window`     | POST   | takes width and height of the viewer on the page; recordings are drawn for it |
/// | `/api/heights`    | POST   | takes the bytes of a file of heights, called `?name=`; a [`Description`](super::Description) of it |
/// |                   | GET    | the latest description, or null                                       |
/// | `/api/describe`   | POST   | takes [`HeightKnobs`](super::HeightKnobs); the description of that file as they take it |
/// | `/api/hold`       | POST   | takes a [`Hold`](super::Hold); the contact as a hand holds it, [`Held`](super::Held) |
/// | `/run/ID.rrd`     | GET    | one of the latest recordings, as it grows                             |
/// | `/api/runs`       | GET    | reports of the latest complete recordings               |
/// | `/api/run/ID/NAME`| GET    | a facet of a run that has ended, such as `steps`                      |
/// | `/save/ID.rrd`    | GET    | one of the latest recordings, once it is complete, to save            |
/// | `/save/ID.npz`    | GET    | the arrays of the result behind one of them, to save                  |
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
        Ok(Self { page: Page::new("explore")?, sessions, start, lessons })
    }

    /// A file of the page, or a new session.
    fn outside(&self, request: &Request<'_>) -> Reply {
        match (request.path, request.method) {
            ("/api/session", "POST") => match read(request.body).map(|after| self.sessions.begin(after)) {
                Ok(Ok(name)) => Reply::json(&json!({ "session": name })),
                Ok(Err(Refusal(sentence))) => Reply::Error(503, sentence),
                Err(Refusal(sentence)) => Reply::Error(400, sentence),
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
            return Reply::Error(410, "this session has ended: reload the page for a new one".into());
        };
        match (request.path, request.method) {
            ("/api/leave", "POST") => {
                self.sessions.leave(name);
                Reply::json(&())
            }
            (path, "POST") if GETS.contains(&path) => Reply::wrong_method("GET"),
            (path, "GET") if POSTS.contains(&path) => Reply::wrong_method("POST"),
            (_, "POST") => ordered(&session, request),
            ("/api/start", _) => Reply::json(&self.start),
            ("/api/lessons", _) => Reply::json(&self.lessons),
            _ => state_or_recording(&session, request),
        }
    }
}

/// Paths of a session that are only read, and those that only take orders.
const GETS: [&str; 5] = ["/api/start", "/api/observables", "/api/state", "/api/runs", "/api/lessons"];
const POSTS: [&str; 8] =
    ["/api/solve", "/api/sweep", "/api/cancel", "/api/pin", "/api/describe", "/api/hold", "/api/leave", "/api/window"];

/// Carries out an order.
fn ordered(session: &Session, request: &Request<'_>) -> Reply {
    let order = |kind| Knobs::read(request.body).and_then(|knobs| session.order(kind, knobs));
    let done = match request.path {
        "/api/heights" => return answer(session.open(file(request))),
        "/api/describe" => return answer(read(request.body).and_then(|knobs| session.describe(knobs))),
        "/api/hold" => return answer(read(request.body).and_then(|hold| session.hold(&hold))),
        "/api/solve" => order(RunKind::Solve),
        "/api/sweep" => order(RunKind::Sweep),
        "/api/window" => return answer(read(request.body).and_then(|size| session.set_window(size))),
        "/api/cancel" => Ok(session.cancel()),
        "/api/pin" => read(request.body).and_then(|name| session.pin(name)),
        path => return Reply::missing(path),
    };
    answer(done.map(|revision| json!({ "revision": revision })))
}

/// The reply about the state of a session, or with one of its recordings.
fn state_or_recording(session: &Session, request: &Request<'_>) -> Reply {
    match request.path {
        "/api/observables" => Reply::json(&OBSERVABLES),
        "/api/state" => state(session, request.query),
        "/api/runs" => Reply::json(&session.reports()),
        "/api/heights" => Reply::json(&session.description()),
        path => recording(session, path).or_else(|| facet(session, path)).unwrap_or_else(|| Reply::missing(path)),
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
            Reply::json(&session.report(revision, patience))
        }
        Err(_) => Reply::Error(400, "`since` is not a revision: give a whole number".into()),
    }
}

/// A facet of one of the latest runs or sweeps, once it has ended; of a sweep there is its motion.
fn facet(session: &Session, path: &str) -> Option<Reply> {
    let (id, name) = path.strip_prefix("/api/run/")?.split_once('/')?;
    let (recording, facet) = (session.recording(id)?, FACETS.iter().find(|facet| facet.name == name)?);
    if let Some(motion) = recording.swept().filter(|_| name == MOTION) {
        return Some(Reply::json(&motion));
    }
    Some(match recording.solved() {
        Some(solved) => Reply::json(&(facet.of)(&solved)),
        None => Reply::Error(409, format!("{id} has no {name}: request it after the solve has ended")),
    })
}

/// One of the latest recordings, to show or to save, or the arrays of its result.
fn recording(session: &Session, path: &str) -> Option<Reply> {
    let (folder, file) = path.strip_prefix('/')?.split_once('/')?;
    let (id, kind) = file.rsplit_once('.')?;
    let recording = session.recording(id)?;
    match (folder, kind) {
        ("run", "rrd") => Some(Reply::Recording(RecordingBytes::Live(recording.live), None)),
        ("save", "rrd") => Some(saved_recording(recording)),
        ("save", "npz") => Some(saved_arrays(&recording)),
        _ => None,
    }
}

/// The requested data, or why they are refused.
fn answer(done: Result<impl Serialize, Refusal>) -> Reply {
    match done {
        Ok(value) => Reply::json(&value),
        Err(Refusal(sentence)) => Reply::Error(400, sentence),
    }
}

/// The value of a JSON text.
fn read<T: DeserializeOwned>(json: &[u8]) -> Result<T, Refusal> {
    serde_json::from_slice(json).map_err(|error| Refusal(plain(&error)))
}

/// The file of heights in a request.
fn file(request: &Request<'_>) -> HeightFile {
    let name = request.query.split('&').find_map(|pair| pair.strip_prefix("name="));
    HeightFile::in_memory(plain_name(name.unwrap_or_default()), request.body)
}

/// The recording under the name of its run, once it is complete.
fn saved_recording(recording: SessionRecording) -> Reply {
    if recording.live.written().is_some() {
        return Reply::Error(409, format!("{} is still running: wait for its end, or cancel it", recording.id));
    }
    Reply::Recording(RecordingBytes::Live(recording.live), Some(format!("{}.rrd", recording.file_stem)))
}

/// The arrays under the name of their run, once there are any.
fn saved_arrays(recording: &SessionRecording) -> Reply {
    match recording.solved().and_then(|solved| solved.archive()) {
        Some(archive) => Reply::Download(format!("{}.npz", recording.file_stem), archive),
        None => Reply::Error(409, format!("{} has no arrays: save them after the solve has ended", recording.id)),
    }
}

impl Site for Explorer {
    fn intake(&self, path: &str) -> Intake {
        match split(path) {
            Some((_, "/api/heights")) => Intake { kind: "application/octet-stream", most: MOST_HEIGHTS },
            _ => Intake::JSON,
        }
    }

    fn reply(&self, request: &Request<'_>) -> Reply {
        match split(request.path) {
            Some((session, path)) => self.inside(session, &Request { path, ..*request }),
            None => self.outside(request),
        }
    }
}
