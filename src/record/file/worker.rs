//! A thread that writes the steps of a solve while the solver goes on.

use super::scribe::Scribe;
use crate::contact::{Snapshot, Step};
use std::sync::mpsc::{Receiver, Sender, SyncSender, channel, sync_channel};
use std::thread::{self, JoinHandle};

/// Bytes of the states that wait to be written, unless a single one takes more, and the most of them.
const WAITING_BYTES: usize = 2 << 20;
const MOST_WAITING: usize = 32;

/// A scribe on a thread of its own, behind a queue of few states.
///
/// Nothing is dropped: where the queue is full, the solver waits. The memory of states is used again, so that no more is held
/// than those that wait, one that is written and one that is handed over.
pub struct Worker {
    states: SyncSender<Snapshot>,
    /// States that are written, whose memory is free.
    written: Receiver<Snapshot>,
    thread: JoinHandle<Scribe>,
}

impl Worker {
    /// Sets a scribe to work.
    pub fn start(scribe: Scribe) -> Self {
        let places = WAITING_BYTES / (scribe.nodes() * 3 * size_of::<f64>());
        let (states, waiting) = sync_channel(places.clamp(1, MOST_WAITING));
        let (free, written) = channel();
        Self { states, written, thread: thread::spawn(move || write(scribe, &waiting, &free)) }
    }

    /// Has a step written, as soon as there is a place in the queue; false if the scribe is gone, having panicked.
    pub fn step(&self, step: &Step<'_>) -> bool {
        let written = self.written.try_recv().ok();
        let state = written.map_or_else(|| Snapshot::of(step), |written| written.replaced_by(step));
        self.states.send(state).is_ok()
    }

    /// Waits for all states to be written, and returns the scribe, or its panic.
    pub fn end(self) -> thread::Result<Scribe> {
        drop(self.states);
        self.thread.join()
    }
}

fn write(mut scribe: Scribe, waiting: &Receiver<Snapshot>, free: &Sender<Snapshot>) -> Scribe {
    for state in waiting {
        scribe.step(&state.step());
        free.send(state).ok(); // at the end nobody needs it
    }
    scribe
}
