//! The work of a session: its orders, one after the other.

use super::session::{Order, RunKind, Session, Turn};
use super::{solve, sweep};
use std::panic::{AssertUnwindSafe, catch_unwind};

impl Session {
    /// Waits for orders and carries them out, until the session is closed.
    pub fn work(&self) {
        while let Some((turn, order)) = self.next() {
            carry_out(turn, order);
        }
    }

    /// Carries out the order that was given last, if it waits, and returns. It does not wait for orders, so that it can run
    /// where there is one thread.
    pub fn work_once(&self) {
        if let Some((turn, order)) = self.take_order() {
            carry_out(turn, order);
        }
    }
}

/// Carries out an order, and reports how it ended.
fn carry_out(turn: Turn<'_>, Order { kind, knobs, setup, beside }: Order) {
    let done = catch_unwind(AssertUnwindSafe(|| match kind {
        RunKind::Solve => solve::run(turn, knobs, setup, beside),
        RunKind::Sweep => sweep::run(turn, knobs, setup),
    }));
    turn.end(match done {
        Ok(done) => done.err(),
        Err(_) => Some("the solver failed on these settings: please report them".into()),
    });
}
