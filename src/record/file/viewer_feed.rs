//! The way of messages to a viewer, on a thread of its own.

use rerun::log::{Chunk, LogMsg};
use rerun::sink::{LogSink, SinkFlushError};
use rerun::{Scalars, SizeBytes, TextDocument};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::Duration;

/// Bytes that wait for a viewer from which on pictures are left out.
const MOST_BYTES: usize = 64 << 20;

/// The number of pictures that a viewer was too slow to get. Clones count together.
#[derive(Debug, Clone, Default)]
pub struct LeftOut(Arc<AtomicUsize>);

impl LeftOut {
    /// The number so far.
    pub fn pictures(&self) -> usize {
        self.0.load(Ordering::Relaxed)
    }

    /// What a person should know of them, and what to do; none if the viewer got all. `fewer` says how fewer pictures are recorded.
    pub fn warning(&self, fewer: &str) -> Option<String> {
        let pictures = Some(self.pictures()).filter(|pictures| *pictures > 0)?;
        Some(format!(
            "The viewer was too slow for {pictures} pictures of steps or states, which it did not get. It has all numbers, and a file that is \
             recorded has everything. Record into a file and open that, or record fewer pictures ({fewer})."
        ))
    }
}

/// What goes to the viewer: a message with its size, or who waits until all before is there.
enum Parcel {
    Message(LogMsg, usize),
    Flush(Sender<()>, Duration),
}

/// A viewer that gets messages from a thread of its own, so that a slow one never makes the solver wait.
///
/// If too much waits for it, pictures of steps and states are left out. Numbers, texts and what does not change with time always wait.
pub(crate) struct ViewerFeed {
    parcels: Sender<Parcel>,
    /// Bytes that wait.
    waiting: Arc<AtomicUsize>,
    left_out: LeftOut,
}

impl ViewerFeed {
    /// The feed of a viewer, which counts what is left out.
    pub(crate) fn new(viewer: impl LogSink + 'static, left_out: LeftOut) -> Self {
        let (parcels, on_the_way) = channel();
        let waiting = Arc::new(AtomicUsize::new(0));
        let taken = Arc::clone(&waiting);
        // it is not waited for: a viewer that hangs would never let it end
        thread::spawn(move || deliver(&viewer, &on_the_way, &taken));
        Self { parcels, waiting, left_out }
    }
}

impl LogSink for ViewerFeed {
    fn send(&self, message: LogMsg) {
        let size = message.heap_size_bytes() as usize;
        if self.waiting.load(Ordering::Relaxed) + size > MOST_BYTES && is_picture(&message) {
            self.left_out.0.fetch_add(1, Ordering::Relaxed);
            return;
        }
        self.waiting.fetch_add(size, Ordering::Relaxed);
        self.parcels.send(Parcel::Message(message, size)).ok(); // nobody looks on any more
    }

    fn flush_blocking(&self, timeout: Duration) -> Result<(), SinkFlushError> {
        let (done, all) = channel();
        self.parcels.send(Parcel::Flush(done, timeout)).ok();
        all.recv_timeout(timeout).map_err(|_| SinkFlushError::Timeout)
    }
}

/// Hands over what comes until nothing more can come.
fn deliver(viewer: &dyn LogSink, parcels: &Receiver<Parcel>, waiting: &AtomicUsize) {
    for parcel in parcels {
        match parcel {
            Parcel::Message(message, size) => {
                viewer.send(message);
                waiting.fetch_sub(size, Ordering::Relaxed);
            }
            Parcel::Flush(done, timeout) => {
                viewer.flush_blocking(timeout).ok(); // a viewer that was closed gets nothing more
                done.send(()).ok();
            }
        }
    }
}

/// Whether a message is a picture of a step or a state.
fn is_picture(message: &LogMsg) -> bool {
    let LogMsg::ArrowMsg(_, message) = message else { return false };
    let kept = [Scalars::descriptor_scalars().component, TextDocument::descriptor_text().component];
    let has = |chunk: &Chunk| chunk.component_descriptors().any(|it| kept.contains(&it.component));
    Chunk::from_arrow_msg(message).is_ok_and(|chunk| !chunk.is_static() && !has(&chunk))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::sdk;
    use rerun::Points2D;
    use std::sync::Mutex;

    /// A viewer that takes nothing until it is let.
    struct SlowViewer {
        gate: Arc<Mutex<()>>,
        got: Arc<Mutex<Vec<LogMsg>>>,
    }

    impl LogSink for SlowViewer {
        fn send(&self, message: LogMsg) {
            drop(self.gate.lock().unwrap());
            self.got.lock().unwrap().push(message);
        }

        fn flush_blocking(&self, _: Duration) -> Result<(), SinkFlushError> {
            Ok(())
        }
    }

    #[test]
    fn a_slow_viewer_misses_pictures_but_no_numbers_and_nobody_waits_for_it() {
        let (gate, got, left_out) = (Arc::new(Mutex::new(())), Arc::default(), LeftOut::default());
        let viewer = SlowViewer { gate: Arc::clone(&gate), got: Arc::clone(&got) };
        let closed = gate.lock().unwrap();
        let feed = ViewerFeed::new(viewer, left_out.clone());
        let (stream, made) = sdk::layout(&"test".into()).unwrap();
        for step in 0..40i64 {
            stream.set_time_sequence("step", step);
            stream.log("picture", &Points2D::new(vec![[0.0, 0.0]; 1 << 19])).unwrap();
            stream.log("number", &Scalars::single(step as f64)).unwrap();
            made.take().into_iter().for_each(|message| feed.send(message));
        }
        stream.disconnect();
        assert!(left_out.warning("N").unwrap().contains(&format!("too slow for {} pictures", left_out.pictures())));
        assert!(left_out.pictures() > 0 && got.lock().unwrap().is_empty(), "{left_out:?}");
        drop(closed);
        feed.flush_blocking(Duration::from_secs(600)).unwrap();
        let numbers = |name: &str| {
            let got = got.lock().unwrap();
            let chunks = got.iter().filter_map(|message| match message {
                LogMsg::ArrowMsg(_, message) => Chunk::from_arrow_msg(message).ok(),
                _ => None,
            });
            chunks.filter(|chunk| chunk.entity_path().to_string() == name).map(|chunk| chunk.num_rows()).sum::<usize>()
        };
        assert_eq!(numbers("/number"), 40);
        assert_eq!(numbers("/picture") + left_out.pictures(), 40);
    }
}
