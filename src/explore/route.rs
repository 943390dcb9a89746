//! The paths of the explorer.

use super::height_name::plain_name;
use super::knobs::Knobs;
use super::lesson::Lesson;
use super::page::Page;
use super::reel::Reel;
use super::refusal::Refusal;
use super::session::{Kind, Session};
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

/// The largest file of heights, in bytes.
const MOST_HEIGHTS: usize = 1 << 26;
/// Longest wait of a request for news.
const PATIENCE: Duration = Duration::from_millis(900);

/// The page and the session behind it.
///
/// | path              | method | answer                                                                |
/// |-------------------|--------|-----------------------------------------------------------------------|
/// | `/`, and its files| GET    | page, script, style, viewer                                           |
/// | `/api/start`      | GET    | the [`Knobs`] to start with                                           |
/// | `/api/lessons`    | GET    | the lessons, see [`Lesson`]                                           |
/// | `/api/observables`| GET    | names and meanings of the numbers in a report                         |
/// | `/api/state`      | GET    | the report, at once or when it is newer than `?since=`        |
/// | `/api/solve`      | POST   | takes [`Knobs`], ends what runs; the revision from which on news of it come |
/// | `/api/sweep`      | POST   | the same for a sweep                                                  |
/// | `/api/cancel`     | POST   | ends what runs                                                        |
/// | `/api/pin`        | POST   | takes the name of a recording, or null: its curves stand beside new ones |
/// | `/api/heights`    | POST   | takes the bytes of a file of heights, called `?name=`; a [`Description`](super::Description) of it |
/// |                   | GET    | the latest description, or null                                       |
/// | `/api/describe`   | POST   | takes [`HeightKnobs`](super::HeightKnobs); the description of that file as they take it |
/// | `/api/hold`       | POST   | takes a [`Hold`](super::Hold); the contact as a hand holds it, [`Held`](super::Held) |
/// | `/run/ID.rrd`     | GET    | one of the latest recordings, as it grows                             |
/// | `/api/runs`       | GET    | what is told of the latest recordings that are complete               |
/// | `/save/ID.rrd`    | GET    | one of the latest recordings, once it is complete, to save            |
/// | `/save/ID.npz`    | GET    | the arrays of the result behind one of them, to save                  |
pub struct Explorer {
    page: Page,
    session: Arc<Session>,
    start: Knobs,
    lessons: Vec<Lesson>,
}

impl Explorer {
    /// The page, with controls that start at `start`, and its lessons.
    ///
    /// # Errors
    /// If the viewer is not in the binary.
    pub fn new(session: Arc<Session>, start: Knobs, lessons: Vec<Lesson>) -> io::Result<Self> {
        Ok(Self { page: Page::new("explore")?, session, start, lessons })
    }

    fn post(&self, request: &Request<'_>) -> Reply {
        let order = |kind| Knobs::read(request.body).and_then(|knobs| self.session.order(kind, knobs));
        let done = match request.path {
            "/api/heights" => return answer(self.session.open(file(request))),
            "/api/describe" => return answer(read(request.body).and_then(|knobs| self.session.describe(knobs))),
            "/api/hold" => return answer(read(request.body).and_then(|hold| self.session.hold(&hold))),
            "/api/solve" => order(Kind::Solve),
            "/api/sweep" => order(Kind::Sweep),
            "/api/cancel" => Ok(self.session.cancel()),
            "/api/pin" => read(request.body).and_then(|name| self.session.pin(name)),
            path if self.page.file(path).is_some() || GETS.contains(&path) => return Reply::wrong_method("GET"),
            path => return Reply::missing(path),
        };
        answer(done.map(|revision| json!({ "revision": revision })))
    }

    fn get(&self, request: &Request<'_>) -> Reply {
        match request.path {
            "/api/start" => Reply::json(&self.start),
            "/api/lessons" => Reply::json(&self.lessons),
            "/api/observables" => Reply::json(&OBSERVABLES),
            "/api/state" => self.state(request.query),
            "/api/runs" => Reply::json(&self.session.told()),
            "/api/heights" => Reply::json(&self.session.description()),
            "/api/solve" | "/api/sweep" | "/api/cancel" | "/api/pin" | "/api/describe" | "/api/hold" => {
                Reply::wrong_method("POST")
            }
            path => self
                .page
                .file(path)
                .or_else(|| self.facet(path))
                .or_else(|| self.reel(path))
                .unwrap_or_else(|| Reply::missing(path)),
        }
    }

    fn facet(&self, path: &str) -> Option<Reply> {
        let (id, name) = path.strip_prefix("/api/run/")?.split_once('/')?;
        let solved = self.session.reel(id)?.solved()?;
        match name {
            "section" => Some(Reply::json(&super::section::Section::of(&solved.contact, true))),
            "beside" => Some(Reply::json(&solved.beside.as_ref().map(|it| super::section::Section::of(it, true)))),
            "patches" => Some(Reply::json(&super::patches::PatchTable::of(&solved.contact))),
            _ => None,
        }
    }

    /// The report, when it is newer than the query says.
    fn state(&self, query: &str) -> Reply {
        let since = query.split('&').find_map(|pair| pair.strip_prefix("since="));
        match since.map_or(Ok(0), str::parse::<u64>) {
            Ok(revision) => {
                let patience = if since.is_some() { PATIENCE } else { Duration::ZERO };
                Reply::json(&self.session.report(revision, patience))
            }
            Err(_) => Reply::Error(400, "since is not a revision: give a whole number".into()),
        }
    }

    /// One of the latest recordings, to show or to save, or the arrays of its result.
    fn reel(&self, path: &str) -> Option<Reply> {
        let (folder, file) = path.strip_prefix('/')?.split_once('/')?;
        let (id, kind) = file.rsplit_once('.')?;
        let reel = self.session.reel(id)?;
        match (folder, kind) {
            ("run", "rrd") => Some(Reply::Recording(RecordingBytes::Live(reel.live), None)),
            ("save", "rrd") => Some(saved_recording(reel)),
            ("save", "npz") => Some(saved_arrays(&reel)),
            _ => None,
        }
    }
}

/// What was asked for, or why it is refused.
fn answer(done: Result<impl Serialize, Refusal>) -> Reply {
    match done {
        Ok(value) => Reply::json(&value),
        Err(Refusal(sentence)) => Reply::Error(400, sentence),
    }
}

/// What JSON stands for.
fn read<T: DeserializeOwned>(json: &[u8]) -> Result<T, Refusal> {
    serde_json::from_slice(json).map_err(|error| Refusal(error.to_string()))
}

/// The file of heights in a request.
fn file(request: &Request<'_>) -> HeightFile {
    let name = request.query.split('&').find_map(|pair| pair.strip_prefix("name="));
    HeightFile::in_memory(plain_name(name.unwrap_or_default()), request.body)
}

/// Paths that are only read.
const GETS: [&str; 5] = ["/api/start", "/api/observables", "/api/state", "/api/runs", "/api/lessons"];

/// The recording under the name of its run, once it is complete.
fn saved_recording(reel: Reel) -> Reply {
    if reel.live.written().is_some() {
        return Reply::Error(409, format!("{} still runs: wait for its end, or cancel it", reel.id));
    }
    Reply::Recording(RecordingBytes::Live(reel.live), Some(format!("{}.rrd", reel.file_stem)))
}

/// The arrays under the name of their run, once there are any.
fn saved_arrays(reel: &Reel) -> Reply {
    match reel.solved().and_then(|solved| solved.archive()) {
        Some(archive) => Reply::Download(format!("{}.npz", reel.file_stem), archive),
        None => Reply::Error(409, format!("{} has no arrays: save those of a solve that has ended", reel.id)),
    }
}

impl Site for Explorer {
    fn intake(&self, path: &str) -> Intake {
        match path {
            "/api/heights" => Intake { kind: "application/octet-stream", most: MOST_HEIGHTS },
            _ => Intake::JSON,
        }
    }

    fn reply(&self, request: &Request<'_>) -> Reply {
        if request.method == "POST" { self.post(request) } else { self.get(request) }
    }
}
