//! A thread that writes the steps of a solve while the solver goes on.

use super::scribe::Scribe;
use crate::contact::{Snapshot, Step};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::{self, JoinHandle};

/// Bytes of the states that are on their way, unless a single one takes more: some steps of a line, one of a surface.
const MOST_BYTES: usize = 2 << 20;
/// Fields of a state at the most.
const FIELDS: usize = 3;
/// The most states on their way.
const MOST_STATES: usize = 32;

/// A scribe on a thread of its own, to which few states are on their way at a time.
///
/// Nothing is dropped: the solver waits where the scribe is so many states behind. Their memory is used again and again.
pub struct Worker {
    states: Sender<Snapshot>,
    /// States that are written, whose memory is free.
    written: Receiver<Snapshot>,
    /// States that can still be made.
    unmade: usize,
    thread: JoinHandle<Scribe>,
}

impl Worker {
    /// Sets a scribe to work.
    pub fn start(scribe: Scribe) -> Self {
        let unmade = (MOST_BYTES / (scribe.nodes() * FIELDS * size_of::<f64>())).clamp(1, MOST_STATES);
        let (states, unwritten) = channel();
        let (free, written) = channel();
        Self { states, written, unmade, thread: thread::spawn(move || write(scribe, &unwritten, &free)) }
    }

    /// Has a step written, as soon as there is memory for it; false if the scribe is gone, having panicked.
    pub fn step(&mut self, step: &Step<'_>) -> bool {
        let state = match self.written.try_recv().ok() {
            None if self.unmade > 0 => {
                self.unmade -= 1;
                Some(Snapshot::of(step))
            }
            written => written.or_else(|| self.written.recv().ok()).map(|written| written.replaced_by(step)),
        };
        state.is_some_and(|state| self.states.send(state).is_ok())
    }

    /// Waits for all states to be written, and returns the scribe, or its panic.
    pub fn end(self) -> thread::Result<Scribe> {
        drop(self.states);
        self.thread.join()
    }
}

fn write(mut scribe: Scribe, unwritten: &Receiver<Snapshot>, free: &Sender<Snapshot>) -> Scribe {
    for state in unwritten {
        scribe.step(&state.step());
        free.send(state).ok(); // at the end nobody needs it
    }
    scribe
}
