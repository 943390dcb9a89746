//! Work that is done beside other work.

use std::panic::resume_unwind;
use std::sync::{Mutex, PoisonError};
use std::thread::{self, JoinHandle};

/// Work on a thread of its own, which ends before the task is dropped.
pub struct Task(Mutex<Option<JoinHandle<()>>>);

impl Task {
    /// Begins to work.
    pub fn start(work: impl FnOnce() + Send + 'static) -> Self {
        Self(Mutex::new(Some(thread::spawn(work))))
    }

    /// Waits for the end of the work, and passes on its panic.
    pub fn wait(&self) {
        if let Err(panic) = self.join() {
            resume_unwind(panic);
        }
    }

    fn join(&self) -> thread::Result<()> {
        let thread = self.0.lock().unwrap_or_else(PoisonError::into_inner).take();
        thread.map_or(Ok(()), JoinHandle::join)
    }
}

impl Drop for Task {
    fn drop(&mut self) {
        self.join().ok(); // a panic that nobody waited for has been told by the thread itself
    }
}
