//! A thread that writes the steps of a solve while the solver continues.

use super::writer::Writer;
use crate::contact::{Snapshot, Step};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// Largest size of the waiting states in bytes (or one state, if it is larger): some steps of a line, one step of a
/// surface.
const MOST_BYTES: usize = 5 << 20;
/// FrameFields of a state.
const FIELDS: usize = 2;
/// The most states on their way.
const MOST_STATES: usize = 32;
/// Parts of all states that are handed over together: to wake a thread costs as much as to copy a field of a line.
const PARTS: usize = 3;
/// The time after which states are handed over however few they are.
const PATIENCE: Duration = Duration::from_millis(10);

/// A writer on a separate thread, with a short queue of states.
///
/// Nothing is dropped: the solver waits if the writer is more than these states behind. The memory of written states is used again.
pub(crate) struct WriterThread {
    states: Sender<Vec<Snapshot>>,
    /// States that are written, whose memory is free.
    written: Receiver<Snapshot>,
    /// States that can still be made.
    unmade: usize,
    /// States that are handed over next, and their largest number.
    next: Vec<Snapshot>,
    together: usize,
    handed_over: Instant,
    thread: JoinHandle<Writer>,
}

impl WriterThread {
    /// Starts a writer.
    pub(crate) fn start(writer: Writer) -> Self {
        let states = (MOST_BYTES / (writer.nodes() * FIELDS * size_of::<f64>())).clamp(1, MOST_STATES);
        let (sender, unwritten) = channel();
        let (free, written) = channel();
        Self {
            states: sender,
            written,
            unmade: states,
            next: Vec::new(),
            together: (states / PARTS).max(1),
            handed_over: Instant::now(),
            thread: thread::spawn(move || write(writer, &unwritten, &free)),
        }
    }

    /// Queues a step for writing, when there is memory for it. Returns false if the writer has panicked.
    pub(crate) fn step(&mut self, step: &Step<'_>) -> bool {
        let Some(state) = self.copy(step) else { return false };
        self.next.push(state);
        let is_due = self.next.len() >= self.together || self.handed_over.elapsed() >= PATIENCE;
        !is_due || self.hand_over()
    }

    /// Waits for all states to be written, and returns the writer, or its panic.
    pub(crate) fn end(mut self) -> thread::Result<Writer> {
        self.hand_over();
        drop(self.states);
        self.thread.join()
    }

    fn copy(&mut self, step: &Step<'_>) -> Option<Snapshot> {
        if let Ok(written) = self.written.try_recv() {
            return Some(written.replaced_by(step));
        }
        if self.unmade > 0 {
            self.unmade -= 1;
            return Some(Snapshot::from_step(step));
        }
        // what waits here would never be written
        self.hand_over();
        self.written.recv().ok().map(|written| written.replaced_by(step))
    }

    fn hand_over(&mut self) -> bool {
        self.handed_over = Instant::now();
        self.states.send(std::mem::take(&mut self.next)).is_ok()
    }
}

fn write(mut writer: Writer, unwritten: &Receiver<Vec<Snapshot>>, free: &Sender<Snapshot>) -> Writer {
    for state in unwritten.iter().flatten() {
        writer.step(&state.step());
        free.send(state).ok(); // at the end nobody needs it
    }
    writer
}
