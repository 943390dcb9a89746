//! Ctrl-C as a request to end early.

use super::warnings;
use asperity::contact::{Observer, Step, Wish};
use asperity::files::abandon_drafts;
#[cfg(unix)]
use std::future::poll_fn;
use std::io;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
#[cfg(unix)]
use std::task::Poll;
use std::thread;
use tokio::runtime::Builder;
#[cfg(unix)]
use tokio::signal::unix::{Signal, SignalKind, signal};

/// The request to end this process, from the moment that it is listened to.
static END: OnceLock<EndRequest> = OnceLock::new();

/// A request to end, and whether a command takes it.
#[derive(Default)]
struct EndRequest {
    came: Arc<AtomicBool>,
    is_taken: AtomicBool,
    /// What is done before the process ends.
    last_act: Mutex<Option<LastAct>>,
}

/// Something that is done once.
type LastAct = Box<dyn FnOnce() + Send>;

/// Handles Ctrl-C and termination requests from now on: they end the process and leave no draft but those that grow, which are named.
pub(crate) fn listen() -> io::Result<()> {
    if END.get().is_some() {
        return Ok(());
    }
    let runtime = Builder::new_current_thread().enable_io().build()?;
    let mut requests = {
        let _inside = runtime.enter();
        Requests::new()?
    };
    let end = END.get_or_init(EndRequest::default);
    thread::spawn(move || {
        runtime.block_on(requests.next());
        end.came.store(true, Ordering::Relaxed);
        if end.is_taken.load(Ordering::Relaxed) {
            runtime.block_on(requests.next());
        }
        let last_act = end.last_act.lock().unwrap_or_else(PoisonError::into_inner).take();
        last_act.into_iter().for_each(|act| act());
        for draft in abandon_drafts() {
            warnings::print(&[format!("interrupted: {} has what was written until then", draft.display())]);
        }
        std::process::exit(130);
    });
    Ok(())
}

/// Does something when Ctrl-C or a termination request ends the process, from now on.
pub(crate) fn when_interrupted(act: impl FnOnce() + Send + 'static) -> io::Result<()> {
    listen()?;
    let end = END.get_or_init(EndRequest::default);
    *end.last_act.lock().unwrap_or_else(PoisonError::into_inner) = Some(Box::new(act));
    Ok(())
}

/// The command takes Ctrl-C and termination requests itself from now on. The returned flag shows whether one came. The second one ends the process.
pub(crate) fn interrupted() -> io::Result<Arc<AtomicBool>> {
    listen()?;
    let end = END.get_or_init(EndRequest::default);
    end.is_taken.store(true, Ordering::Relaxed);
    Ok(end.came.clone())
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
pub(crate) struct Interruption(pub Arc<AtomicBool>);

impl Observer for Interruption {
    fn step(&mut self, _: &Step<'_>) -> Wish {
        self.ask()
    }

    fn ask(&mut self) -> Wish {
        Ok(if self.0.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    }
}
