//! The solver thread of a session.

use super::session::{Order, RunKind, Session, Stock};
use super::{solve, sweep};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::thread::JoinHandle;

impl Session {
    /// A session with its solver thread, which ends after [`Session::close`]. Its runs are numbered on from
    /// `after`.
    pub fn start(stock: Stock, after: u64) -> (Arc<Self>, JoinHandle<()>) {
        let session = Arc::new(Self::new(stock, after));
        let worker = Arc::clone(&session);
        (session, std::thread::spawn(move || work(&worker)))
    }
}

/// Carries out one order after the other.
fn work(session: &Session) {
    while let Some((turn, Order { kind, knobs, setup, beside })) = session.next() {
        let done = catch_unwind(AssertUnwindSafe(|| match kind {
            RunKind::Solve => solve::run(turn, knobs, setup, beside),
            RunKind::Sweep => sweep::run(turn, knobs, setup),
        }));
        turn.end(match done {
            Ok(done) => done.err(),
            Err(_) => Some("the solver failed on these settings: please report them".into()),
        });
    }
}
