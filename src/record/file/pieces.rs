//! Recordings in pieces, for viewers that are handed bytes.

use super::output::io_error;
use rerun::external::re_log_encoding::{Encoder, EncodingOptions};
use rerun::log::LogMsg;
use rerun::sink::{LogSink, SinkFlushError};
use std::io;
use std::mem::take;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// The new data of a recording since the last request, for viewers inside other programs. Each piece has the head of a
/// stream, which a viewer needs; one behind the other they are the recording, as far as it has come. Its name is in the
/// first one alone.
#[derive(Clone, Default)]
pub struct Pieces(Arc<Mutex<Vec<LogMsg>>>);

impl Pieces {
    /// The next piece; none if nothing has come.
    ///
    /// # Errors
    /// The error of the encoder for a message that cannot be encoded.
    pub fn next_piece(&self) -> io::Result<Option<Vec<u8>>> {
        let messages = take(&mut *self.messages());
        (!messages.is_empty()).then(|| encoded(&messages)).transpose()
    }

    fn messages(&self) -> MutexGuard<'_, Vec<LogMsg>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl LogSink for Pieces {
    fn send(&self, message: LogMsg) {
        self.messages().push(message);
    }

    fn flush_blocking(&self, _: Duration) -> Result<(), SinkFlushError> {
        Ok(())
    }
}

/// A stream of some messages. It has no index, which in the midst of others would hide what is before it.
fn encoded(messages: &[LogMsg]) -> io::Result<Vec<u8>> {
    let version = rerun::build_info().version;
    let mut encoder =
        Encoder::new_eager(version, EncodingOptions::PROTOBUF_COMPRESSED, Vec::new()).map_err(io_error)?;
    encoder.do_not_emit_footer();
    messages.iter().try_for_each(|message| encoder.append(message).map(drop)).map_err(io_error)?;
    encoder.into_inner().map_err(io_error)
}
