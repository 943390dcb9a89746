//! The paths of the explorer.

use super::knobs::{Knobs, Refusal};
use super::page::Page;
use super::reel::Reel;
use super::session::{Order, Session};
use super::site::{Reply, Request, Site};
use super::stream::RecordingBytes;
use crate::contact::OBSERVABLES;
use serde_json::json;
use std::io;
use std::sync::Arc;
use std::time::Duration;

/// Longest wait of a request for news.
const PATIENCE: Duration = Duration::from_millis(900);

/// The page and the session behind it.
///
/// | path              | method | answer                                                                |
/// |-------------------|--------|-----------------------------------------------------------------------|
/// | `/`, and its files| GET    | page, script, style, viewer                                           |
/// | `/api/start`      | GET    | the [`Knobs`] to start with                                           |
/// | `/api/observables`| GET    | names and meanings of the numbers in a report                         |
/// | `/api/state`      | GET    | the report, at once or when it is newer than `?since=`        |
/// | `/api/solve`      | POST   | takes [`Knobs`], ends what runs; the revision from which on news of it come |
/// | `/api/sweep`      | POST   | the same for a sweep                                                  |
/// | `/api/cancel`     | POST   | ends what runs                                                        |
/// | `/api/pin`        | POST   | takes the name of a recording, or null: its curves stand beside new ones |
/// | `/run/ID.rrd`     | GET    | one of the latest recordings, as it grows                             |
/// | `/api/runs`       | GET    | what is told of the latest recordings that are complete               |
/// | `/save/ID.rrd`    | GET    | one of the latest recordings, once it is complete, to save            |
/// | `/save/ID.npz`    | GET    | the arrays of the result behind one of them, to save                  |
pub struct Explorer {
    page: Page,
    session: Arc<Session>,
    start: Knobs,
}

impl Explorer {
    /// The page, with controls that start at `start`.
    ///
    /// # Errors
    /// If the viewer is not in the binary.
    pub fn new(session: Arc<Session>, start: Knobs) -> io::Result<Self> {
        Ok(Self { page: Page::new("explore")?, session, start })
    }

    fn post(&self, request: &Request<'_>) -> Reply {
        let order =
            |order: fn(Knobs) -> Order| Knobs::read(request.body).and_then(|knobs| self.session.order(order(knobs)));
        let done = match request.path {
            "/api/solve" => order(Order::Solve),
            "/api/sweep" => order(Order::Sweep),
            "/api/cancel" => Ok(self.session.cancel()),
            "/api/pin" => match serde_json::from_slice(request.body) {
                Ok(name) => self.session.pin(name),
                Err(error) => Err(Refusal(error.to_string())),
            },
            path if self.page.file(path).is_some() || GETS.contains(&path) => return Reply::wrong_method("GET"),
            path => return Reply::missing(path),
        };
        match done {
            Ok(revision) => Reply::json(&json!({ "revision": revision })),
            Err(Refusal(sentence)) => Reply::Error(400, sentence),
        }
    }

    fn get(&self, request: &Request<'_>) -> Reply {
        match request.path {
            "/api/start" => Reply::json(&self.start),
            "/api/observables" => Reply::json(&OBSERVABLES),
            "/api/state" => self.state(request.query),
            "/api/runs" => Reply::json(&self.session.told()),
            "/api/solve" | "/api/sweep" | "/api/cancel" | "/api/pin" => Reply::wrong_method("POST"),
            path => self.page.file(path).or_else(|| self.reel(path)).unwrap_or_else(|| Reply::missing(path)),
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

/// Paths that are only read.
const GETS: [&str; 4] = ["/api/start", "/api/observables", "/api/state", "/api/runs"];

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
    fn reply(&self, request: &Request<'_>) -> Reply {
        if request.method == "POST" { self.post(request) } else { self.get(request) }
    }
}
