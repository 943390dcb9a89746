//! The sessions of the explorer as a WebAssembly module, for a page without a server.
//!
//! The module has one session, and answers the same requests as a server does: see [`Session::answer`]. It imports two
//! functions and a clock, exports the six functions below, and has one thread. The script `assets/explore/worker.js` calls it in a Web Worker.
//!
//! ```text
//! page --(method, path, body)--> room, write, ask --> Session --> status; answer and answer_length lead to the bytes
//!                                work             --> Session --> news: every report, while it solves
//! ```
//!
//! There is no unsafe code: the caller writes into memory that [`room`] has reserved, and reads what [`answer`] leads to
//! before its next call.

use asperity::explore::{Answer, Listener, Report, Request, Session, Stock};
use std::cell::RefCell;
use std::sync::OnceLock;

// The functions that the page gives to the module.
#[cfg(target_arch = "wasm32")]
#[link(wasm_import_module = "page")]
unsafe extern "C" {
    // Milliseconds from any beginning on.
    safe fn now() -> f64;
    // Takes a report as JSON, from an address on.
    safe fn news(start: *const u8, length: usize);
    // Whether the solve goes on: 0 for no.
    safe fn goes_on() -> u32;
}

/// Stand-ins where the crate is compiled for another target, for its lints.
#[cfg(not(target_arch = "wasm32"))]
mod stand_in {
    pub fn news(_: *const u8, _: usize) {}
    pub fn goes_on() -> u32 {
        1
    }
}
#[cfg(not(target_arch = "wasm32"))]
use stand_in::{goes_on, news};

/// The session of the module, and the number after which its runs are numbered.
static SESSION: OnceLock<Session> = OnceLock::new();

thread_local! {
    /// What comes in, and what goes out.
    static INCOMING: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static OUTGOING: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// Begins the session, whose runs are numbered on from `after`. It is called once, before all others.
#[unsafe(no_mangle)]
pub extern "C" fn begin(after: u32) {
    #[cfg(target_arch = "wasm32")]
    asperity::clock::set_clock(|| now());
    let listener = Listener { report, goes_on: || goes_on() != 0 };
    SESSION.get_or_init(|| Session::new(Stock { listener: Some(listener), ..Stock::default() }, after.into()));
}

/// Reserves memory for a request of some bytes, and returns where it begins. The caller writes the method, a space, the path with its query, a line
/// feed, and then the body.
#[unsafe(no_mangle)]
pub extern "C" fn room(length: usize) -> *mut u8 {
    INCOMING.with_borrow_mut(|incoming| {
        *incoming = vec![0; length];
        incoming.as_mut_ptr()
    })
}

/// Answers the request that was written, and returns a status as in HTTP: 200 for an answer, all others for JSON that says why the
/// request is refused.
#[unsafe(no_mangle)]
pub extern "C" fn ask() -> u32 {
    let request = INCOMING.take();
    let (status, bytes) = match SESSION.get().map(|session| reply(session, &request)) {
        Some(Answer::Json(bytes) | Answer::Download(_, bytes)) => (200, bytes),
        Some(Answer::Refused(status, refusal)) => (status.into(), refusal.to_json()),
        None => (503, b"the session has not begun".into()),
    };
    OUTGOING.set(bytes);
    status
}

/// Where the last answer begins.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> *const u8 {
    OUTGOING.with_borrow(|bytes| bytes.as_ptr())
}

/// The number of bytes of the last answer.
#[unsafe(no_mangle)]
pub extern "C" fn answer_length() -> usize {
    OUTGOING.with_borrow(Vec::len)
}

/// Carries out the order that waits, if there is one, to its end. The page hears of it by `news`, and ends it by `goes_on`.
#[unsafe(no_mangle)]
pub extern "C" fn work() {
    if let Some(session) = SESSION.get() {
        session.work_once();
    }
}

/// The answer of a session to a request as it was written.
fn reply(session: &Session, written: &[u8]) -> Answer {
    let refuse = || Answer::Refused(400, "a request begins with a method, a path and a line feed".into());
    let Some(end) = written.iter().position(|byte| *byte == b'\n') else { return refuse() };
    let (head, body) = (std::str::from_utf8(&written[..end]), &written[end + 1..]);
    let Some((method, address)) = head.ok().and_then(|head| head.split_once(' ')) else { return refuse() };
    let (path, query) = address.split_once('?').unwrap_or((address, ""));
    session.answer(&Request { method, path, query, body })
}

/// Sends a report to the page.
fn report(report: &Report) {
    if let Answer::Json(json) = Answer::json(report) {
        news(json.as_ptr(), json.len());
    }
}
