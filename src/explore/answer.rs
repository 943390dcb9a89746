//! Requests to a session and their answers, free of any network.

use super::facet::{FACETS, MOTION};
use super::height_name::plain_name;
use super::knobs::Knobs;
use super::refusal::Refusal;
use super::session::{RunKind, Session};
use crate::contact::Quantity;
use crate::formats::HeightFile;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::json;

/// A request to a session.
#[derive(Clone, Copy)]
pub struct Request<'a> {
    /// `GET` to read, `POST` to order.
    pub method: &'a str,
    /// Path, from the first `/` on.
    pub path: &'a str,
    /// Query, all after the `?`.
    pub query: &'a str,
    /// What comes with an order: JSON, or the bytes of a file.
    pub body: &'a [u8],
}

/// The answer to a request.
pub enum Answer {
    /// A value as JSON.
    Json(Vec<u8>),
    /// A file to save under a name.
    Download(String, Vec<u8>),
    /// A status as in HTTP, and why the request is refused.
    Refused(u16, Refusal),
}

impl Answer {
    /// A value as JSON.
    pub fn json(value: &impl Serialize) -> Self {
        match serde_json::to_vec(value) {
            Ok(json) => Self::Json(json),
            Err(error) => Self::Refused(500, error.to_string().into()),
        }
    }

    /// There is nothing at a path.
    pub fn missing(path: &str) -> Self {
        let path: String = path.chars().take(80).collect();
        Self::Refused(404, format!("there is nothing at {path}").into())
    }

    /// A path takes another method.
    pub fn wrong_method(right: &str) -> Self {
        Self::Refused(405, format!("only {right} is accepted here").into())
    }

    /// The requested data, or why they are refused.
    fn done(done: Result<impl Serialize, Refusal>) -> Self {
        match done {
            Ok(value) => Self::json(&value),
            Err(refusal) => Self::Refused(400, refusal),
        }
    }
}

/// Paths that are only read, and those that only take orders.
const GETS: [&str; 3] = ["/api/observables", "/api/state", "/api/runs"];
const POSTS: [&str; 7] =
    ["/api/solve", "/api/sweep", "/api/cancel", "/api/pin", "/api/describe", "/api/hold", "/api/window"];

impl Session {
    /// Answers a request.
    ///
    /// | path              | method | answer                                                                |
    /// |-------------------|--------|-----------------------------------------------------------------------|
    /// | `/api/observables`| GET    | names and meanings of the numbers in a report                         |
    /// | `/api/state`      | GET    | the [`Report`](super::Report)                                         |
    /// | `/api/solve`      | POST   | takes [`Knobs`], ends what runs; the revision from which on news of it come |
    /// | `/api/sweep`      | POST   | the same for a sweep                                                  |
    /// | `/api/cancel`     | POST   | ends what runs                                                        |
    /// | `/api/pin`        | POST   | takes the name of a run, or null: its curves stand beside new ones    |
    /// | `/api/window`     | POST   | takes width and height of the viewer on the page; recordings are drawn for it |
    /// | `/api/heights`    | POST   | takes the bytes of a file of heights, called `?name=`; a [`Description`](super::Description) of it |
    /// |                   | GET    | the latest description, or null                                       |
    /// | `/api/describe`   | POST   | takes [`HeightKnobs`](super::HeightKnobs); the description of that file as they take it |
    /// | `/api/hold`       | POST   | takes a [`Hold`](super::Hold); the contact as a hand holds it, [`Held`](super::Held) |
    /// | `/api/runs`       | GET    | reports of the latest complete runs                                   |
    /// | `/api/run/ID/NAME`| GET    | a facet of a run that has ended, such as `steps`                      |
    /// | `/save/ID.npz`    | GET    | the arrays of the result of a run, to save                            |
    pub fn answer(&self, request: &Request<'_>) -> Answer {
        match (request.path, request.method) {
            (path, "POST") if GETS.contains(&path) => Answer::wrong_method("GET"),
            (path, "GET") if POSTS.contains(&path) => Answer::wrong_method("POST"),
            (_, "POST") => self.carry_out(request),
            ("/api/observables", _) => Answer::json(&Quantity::all().map(Quantity::row).collect::<Vec<_>>()),
            ("/api/state", _) => Answer::json(&self.report()),
            ("/api/runs", _) => Answer::json(&self.reports()),
            ("/api/heights", _) => Answer::json(&self.description()),
            (path, _) => self.facet(path).or_else(|| self.saved_arrays(path)).unwrap_or_else(|| Answer::missing(path)),
        }
    }

    /// Carries out an order.
    fn carry_out(&self, request: &Request<'_>) -> Answer {
        let order = |kind| Knobs::read(request.body).and_then(|knobs| self.order(kind, knobs));
        let done = match request.path {
            "/api/heights" => return Answer::done(self.open(file(request))),
            "/api/describe" => return Answer::done(read(request.body).and_then(|knobs| self.describe(knobs))),
            "/api/hold" => return Answer::done(read(request.body).and_then(|hold| self.hold(&hold))),
            "/api/solve" => order(RunKind::Solve),
            "/api/sweep" => order(RunKind::Sweep),
            "/api/window" => return Answer::done(read(request.body).and_then(|size| self.set_window(size))),
            "/api/cancel" => Ok(self.cancel()),
            "/api/pin" => read(request.body).and_then(|name| self.pin(name)),
            path => return Answer::missing(path),
        };
        Answer::done(done.map(|revision| json!({ "revision": revision })))
    }

    /// A facet of one of the latest runs or sweeps, once it has ended; of a sweep there is its motion.
    fn facet(&self, path: &str) -> Option<Answer> {
        let (id, name) = path.strip_prefix("/api/run/")?.split_once('/')?;
        let (recording, facet) = (self.recording(id)?, FACETS.iter().find(|facet| facet.name == name)?);
        if let Some(motion) = recording.swept().filter(|_| name == MOTION) {
            return Some(Answer::json(&*motion));
        }
        Some(match recording.solved() {
            Some(solved) => Answer::json(&(facet.of)(&solved)),
            None => Answer::Refused(409, format!("{id} has no {name}: request it after the solve has ended").into()),
        })
    }

    /// The arrays of one of the latest runs under its name, once there are any.
    fn saved_arrays(&self, path: &str) -> Option<Answer> {
        let id = path.strip_prefix("/save/")?.strip_suffix(".npz")?;
        let recording = self.recording(id)?;
        Some(match recording.solved().and_then(|solved| solved.archive()) {
            Some(archive) => Answer::Download(format!("{}.npz", recording.file_stem), archive),
            None => Answer::Refused(409, format!("{id} has no arrays: save them after the solve has ended").into()),
        })
    }
}

/// The value of a JSON text.
///
/// # Errors
/// A sentence on the fault of the text.
pub(crate) fn read<T: DeserializeOwned>(json: &[u8]) -> Result<T, Refusal> {
    Ok(serde_json::from_slice(json)?)
}

/// The file of heights in a request.
fn file(request: &Request<'_>) -> HeightFile {
    let name = request.query.split('&').find_map(|pair| pair.strip_prefix("name="));
    HeightFile::in_memory(plain_name(name.unwrap_or_default()), request.body)
}
