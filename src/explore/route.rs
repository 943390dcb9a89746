//! The paths of the explorer.

use super::knobs::{Knobs, Refusal};
use super::page::Page;
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
/// | `/api/state`      | GET    | the report, at once    or when it is newer than `?since=`     |
/// | `/api/solve`      | POST   | takes [`Knobs`], ends what runs; the revision from which on news of it come |
/// | `/api/sweep`      | POST   | the same for a sweep                                                  |
/// | `/api/cancel`     | POST   | ends what runs                                                        |
/// | `/api/pin`        | POST   | takes the name of a recording, or null: its curves stand beside new ones |
/// | `/run/ID.rrd`     | GET    | one of the latest recordings, as it grows                             |
/// | `/api/run.rrd`    | GET    | the latest one, to save                                               |
/// | `/api/run.npz`    | GET    | the arrays of the latest result, to save                              |
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
            "/api/run.rrd" => match self.session.latest() {
                Some((_, live)) if live.written().is_some() => {
                    Reply::Error(409, "the solve still runs: wait for its end, or cancel it".into())
                }
                Some((id, live)) => Reply::Recording(RecordingBytes::Live(live), Some(format!("asperity-{id}.rrd"))),
                None => nothing_yet(),
            },
            "/api/run.npz" => match self.session.archive() {
                Some((id, archive)) => Reply::Download(format!("asperity-{id}.npz"), archive),
                None => nothing_yet(),
            },
            "/api/solve" | "/api/sweep" | "/api/cancel" | "/api/pin" => Reply::wrong_method("POST"),
            path => self.page.file(path).or_else(|| self.run(path)).unwrap_or_else(|| Reply::missing(path)),
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

    /// A recording, if the path is that of one of the latest.
    fn run(&self, path: &str) -> Option<Reply> {
        let name = path.strip_prefix("/run/")?.strip_suffix(".rrd")?;
        Some(Reply::Recording(RecordingBytes::Live(self.session.recording(name)?), None))
    }
}

/// Paths that are only read.
const GETS: [&str; 5] = ["/api/start", "/api/observables", "/api/state", "/api/run.rrd", "/api/run.npz"];

fn nothing_yet() -> Reply {
    Reply::Error(409, "there is no result yet: solve something first".into())
}

impl Site for Explorer {
    fn reply(&self, request: &Request<'_>) -> Reply {
        if request.method == "POST" { self.post(request) } else { self.get(request) }
    }
}
