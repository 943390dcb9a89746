//! Streams of recordings into files and viewers, and the observers that fill them.

mod background_task;
mod comparison;
mod load_comparison;
mod loads;
mod output;
mod pace;
mod pieces;
mod recorder;
mod recording;
mod schedule;
mod state_recording;
mod state_times;
mod survey;
mod target;
mod viewer_feed;
mod writer;
mod writer_thread;

pub use comparison::compare;
pub(crate) use loads::VALUE;
pub use loads::{LoadRecording, Loads, Timeline};
pub use output::Output;
pub use pieces::Pieces;
pub use recorder::Recorder;
pub use recording::Recording;
pub(crate) use schedule::Schedule;
pub use state_recording::{StateCurve, StateRecording};
pub use survey::record_survey;
pub use target::Target;
pub use viewer_feed::LeftOut;
