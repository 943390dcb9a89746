//! What the SDK of the viewer moves or changes from release to release, in one place: its plain data types, the streams
//! that it makes, and what it adds to them.

use rerun::external::re_log_types::ApplicationId;
use rerun::sink::MemorySinkStorage;
use rerun::{RecordingStream, RecordingStreamBuilder, RecordingStreamResult};

pub(crate) use rerun::datatypes::{ChannelDatatype, Float32, ImageFormat, Range2D, TimeRange, Uuid};

/// A stream of a recording with a title, without the times that the SDK adds. The identity is random if none is given;
/// one that is given must not keep title and properties out of the recording.
pub(crate) fn recording(application: &str, title: &str, id: Option<&str>) -> RecordingStreamResult<RecordingStream> {
    let builder = RecordingStreamBuilder::new(ApplicationId::new_or_unknown(application));
    let builder = if let Some(id) = id { builder.recording_id(id) } else { builder };
    let stream = builder.recording_name(title).send_properties(true).enabled(true).buffered()?;
    stream.set_log_time_enabled(false);
    stream.set_log_tick_enabled(false);
    Ok(stream)
}

/// A stream into memory of the layout of recordings of an application.
pub(crate) fn layout(application: &ApplicationId) -> RecordingStreamResult<(RecordingStream, MemorySinkStorage)> {
    let builder = RecordingStreamBuilder::new(application.clone()).recording_id("default_blueprint");
    builder.send_properties(false).blueprint().enabled(true).memory()
}
