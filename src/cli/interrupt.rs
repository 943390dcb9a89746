//! Ctrl-C as a request to end early.

use asperity::contact::{Observer, Step, Wish};
#[cfg(unix)]
use std::future::poll_fn;
use std::io;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
#[cfg(unix)]
use std::task::Poll;
use std::thread;
use tokio::runtime::Builder;
#[cfg(unix)]
use tokio::signal::unix::{Signal, SignalKind, signal};

/// Handles Ctrl-C and termination requests from now on. The returned flag shows whether one came. The second one ends
/// the process.
pub fn interrupted() -> io::Result<Arc<AtomicBool>> {
    let is_over = Arc::new(AtomicBool::new(false));
    let flag = is_over.clone();
    when_interrupted(move || flag.store(true, Ordering::Relaxed))?;
    Ok(is_over)
}

/// Does something when Ctrl-C or a termination request comes, from now on. The second one ends the process.
pub fn when_interrupted(act: impl FnOnce() + Send + 'static) -> io::Result<()> {
    let runtime = Builder::new_current_thread().enable_io().build()?;
    let mut requests = {
        let _inside = runtime.enter();
        Requests::new()?
    };
    thread::spawn(move || {
        runtime.block_on(requests.next());
        act();
        runtime.block_on(requests.next());
        std::process::exit(130);
    });
    Ok(())
}

/// Ctrl-C, and on Unix the request of the system to end. Both are taken from the moment that this is made.
struct Requests {
    #[cfg(unix)]
    interruption: Signal,
    #[cfg(unix)]
    termination: Signal,
    #[cfg(windows)]
    interruption: tokio::signal::windows::CtrlC,
}

impl Requests {
    fn new() -> io::Result<Self> {
        Ok(Self {
            #[cfg(unix)]
            interruption: signal(SignalKind::interrupt())?,
            #[cfg(unix)]
            termination: signal(SignalKind::terminate())?,
            #[cfg(windows)]
            interruption: tokio::signal::windows::ctrl_c()?,
        })
    }

    #[cfg(unix)]
    async fn next(&mut self) {
        poll_fn(|context| match self.interruption.poll_recv(context) {
            Poll::Ready(_) => Poll::Ready(()),
            Poll::Pending => self.termination.poll_recv(context).map(|_| ()),
        })
        .await;
    }

    #[cfg(windows)]
    async fn next(&mut self) {
        self.interruption.recv().await;
    }
}

/// The observer that ends a solve once Ctrl-C was pressed.
pub struct Interruption(pub Arc<AtomicBool>);

impl Observer for Interruption {
    fn step(&mut self, _: &Step<'_>) -> Wish {
        Ok(if self.0.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    }
}
