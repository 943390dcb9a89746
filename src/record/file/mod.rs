//! Streams of recordings into files and viewers, and the observers that fill them.

#[cfg(feature = "explore")]
mod live;
mod loads;
mod output;
mod recorder;
mod recording;
mod schedule;
mod viewer;

#[cfg(feature = "explore")]
pub use live::Live;
pub use loads::{LoadRecording, Loads};
pub use recorder::Recorder;
pub use recording::Recording;
pub use schedule::Schedule;
