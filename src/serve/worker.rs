//! The solver thread of a session.

use crate::explore::{Session, Stock};
use std::sync::Arc;
use std::thread::JoinHandle;

/// A session with its solver thread, which ends after [`Session::close`]. Its runs are numbered on from `after`.
pub(crate) fn start(stock: Stock, after: u64) -> (Arc<Session>, JoinHandle<()>) {
    let session = Arc::new(Session::new(stock, after));
    let worker = Arc::clone(&session);
    (session, std::thread::spawn(move || worker.work()))
}
