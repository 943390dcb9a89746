//! Ctrl-C as a wish to come to an end.

use asperity::contact::{Observer, Step, Wish};
use std::io;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use tokio::runtime::Builder;
use tokio::signal::ctrl_c;

/// Takes Ctrl-C from now on, and says whether it was pressed. Pressed once more, it ends the process.
pub fn interrupted() -> io::Result<Arc<AtomicBool>> {
    let is_over = Arc::new(AtomicBool::new(false));
    let runtime = Builder::new_current_thread().enable_io().build()?;
    let flag = is_over.clone();
    thread::spawn(move || {
        if runtime.block_on(ctrl_c()).is_ok() {
            flag.store(true, Ordering::Relaxed);
        }
        if runtime.block_on(ctrl_c()).is_ok() {
            std::process::exit(130);
        }
    });
    Ok(is_over)
}

/// The observer that ends a solve once Ctrl-C was pressed.
pub struct Interruption(pub Arc<AtomicBool>);

impl Observer for Interruption {
    fn step(&mut self, _: &Step<'_>) -> Wish {
        Ok(if self.0.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    }
}
