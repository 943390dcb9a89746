//! Work in the background.

use std::panic::resume_unwind;
use std::sync::{Mutex, PoisonError};
use std::thread::{self, JoinHandle};

/// Work on a separate thread, which ends before the task is dropped. The default is no work.
#[derive(Default)]
pub(crate) struct BackgroundTask(Mutex<Option<JoinHandle<()>>>);

impl BackgroundTask {
    /// Begins to work.
    pub(crate) fn start(work: impl FnOnce() + Send + 'static) -> Self {
        Self(Mutex::new(Some(thread::spawn(work))))
    }

    /// Waits for the end of the work, and passes on its panic; others who wait at the same time see the end as well.
    pub(crate) fn wait(&self) {
        if let Err(panic) = self.join() {
            resume_unwind(panic);
        }
    }

    fn join(&self) -> thread::Result<()> {
        let mut thread = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        thread.take().map_or(Ok(()), JoinHandle::join)
    }
}

impl Drop for BackgroundTask {
    fn drop(&mut self) {
        self.join().ok(); // the thread has reported a panic that nobody waited for
    }
}
