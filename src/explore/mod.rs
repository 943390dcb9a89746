//! The explorer: a page on this machine with controls on the left and the viewer on the right.
//!
//! ```text
//! page --(Knobs)--> Session: orders --> worker: solve, sweep --(record::Output)--> GET /run/ID.rrd --> viewer in the page
//!   ^                 |                      |
//!   +----(Report)-----+<---(Turn)------------+
//! ```
//!
//! Page, viewer, state and growing recordings all use one port of the loopback interface. Each tab has its own session
//! in [`Sessions`], and a request changes only this session. Saved files are downloads of the browser. A file of
//! heights that is dropped on the page stays in the memory of the session until the next file replaces it.

mod description;
mod export;
mod facet;
mod guard;
mod hand;
mod height_knobs;
mod height_name;
mod knobs;
mod lesson;
mod motion;
mod page;
mod patches;
mod policy;
mod question;
mod refusal;
mod report;
mod route;
mod schema;
mod section;
mod server;
mod session;
mod session_recording;
mod sessions;
mod site;
mod solve;
mod source;
mod step_numbers;
mod stream;
mod sweep;
mod why;
mod words;
mod worker;

pub use description::Description;
pub use export::SiteExport;
pub use hand::{Held, Hold};
pub use height_knobs::HeightKnobs;
pub use knobs::{Knobs, Start};
pub use lesson::{Challenge, End, Lesson, LessonStep};
pub use page::Viewing;
pub use question::{Choice, Goal, Question, SweepCurve};
pub use refusal::Refusal;
pub use route::Explorer;
pub use schema::{KNOBS, Knob, KnobGroup, KnobKind, KnobScenes, NumericKnob, SliderScale};
pub use server::Server;
pub use sessions::Sessions;
pub use source::{SceneFile, SurfaceSource};
pub use words::Words;
