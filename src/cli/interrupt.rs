//! Ctrl-C as a request to end early.

use asperity::contact::{Observer, Step, Wish};
use std::io;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use tokio::runtime::Builder;
use tokio::signal::ctrl_c;

/// Handles Ctrl-C and termination requests from now on. The returned flag shows whether one came. The second one ends
/// the process.
pub fn interrupted() -> io::Result<Arc<AtomicBool>> {
    let is_over = Arc::new(AtomicBool::new(false));
    let runtime = Builder::new_current_thread().enable_io().build()?;
    let flag = is_over.clone();
    thread::spawn(move || {
        if runtime.block_on(next()).is_ok() {
            flag.store(true, Ordering::Relaxed);
        }
        if runtime.block_on(next()).is_ok() {
            std::process::exit(130);
        }
    });
    Ok(is_over)
}

/// Waits for Ctrl-C, or for the request of the system to end.
#[cfg(unix)]
async fn next() -> io::Result<()> {
    use std::future::poll_fn;
    use std::pin::pin;
    use std::task::Poll;
    use tokio::signal::unix::{SignalKind, signal};
    let (mut interruption, mut termination) = (pin!(ctrl_c()), signal(SignalKind::terminate())?);
    poll_fn(|context| match interruption.as_mut().poll(context) {
        Poll::Ready(interrupted) => Poll::Ready(interrupted),
        Poll::Pending => termination.poll_recv(context).map(|_| Ok(())),
    })
    .await
}

/// Waits for Ctrl-C.
#[cfg(not(unix))]
async fn next() -> io::Result<()> {
    ctrl_c().await
}

/// The observer that ends a solve once Ctrl-C was pressed.
pub struct Interruption(pub Arc<AtomicBool>);

impl Observer for Interruption {
    fn step(&mut self, _: &Step<'_>) -> Wish {
        Ok(if self.0.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    }
}
