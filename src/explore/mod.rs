//! What the page of the explorer does: knobs, lessons, and sessions that solve what the knobs describe.
//!
//! ```text
//! page --(Knobs)--> Session: orders --> solve, sweep --> Report, facets --> page
//! ```
//!
//! There is no network here. The server in [`serve`](crate::serve) runs each session in a thread of its own, and records its runs. A browser
//! runs a session without a server: the crate in the folder `browser` compiles this module to WebAssembly. Both answer the same
//! [`Request`]s, so that the page is the same with and without a server.
//!
//! A file of heights that is dropped on the page stays in the memory of the session until the next file replaces it.

mod answer;
mod columns;
mod description;
mod facet;
mod hand;
mod height_knobs;
mod height_name;
mod knobs;
mod leak;
mod lesson;
mod listener;
mod motion;
mod patches;
mod point;
mod question;
mod refusal;
mod report;
mod scale;
mod schema;
mod section;
mod session;
mod session_recording;
mod solve;
mod source;
mod step_numbers;
mod sticking_hand;
mod sweep;
mod tape;
mod theories;
mod top;
mod why;
mod words;
mod work;
mod zone;

pub use answer::{Answer, Request};
pub use description::Description;
pub use hand::{Held, Hold};
pub use height_knobs::HeightKnobs;
pub use knobs::{Knobs, Start};
pub use lesson::{Challenge, End, Lesson, LessonStep};
pub use listener::Listener;
pub use question::{Choice, Goal, Question, SweepCurve};
pub use refusal::{KNOWN_ERRORS, KnownFault, Refusal, RefusalRule};
pub use report::{Beside, ExactNumbers, Numbers, Report, RunReport, RunWarning, SweepPoint, SweepReport};
pub use schema::{
    KNOBS, Knob, KnobGroup, KnobKind, KnobScenes, MOST_HEIGHTS, MOST_POINTS_OF_MODULE, NumericKnob, SliderScale,
    schema_script,
};
pub use section::Section;
pub use session::{RunKind, Session, Stock};
pub use source::{SceneFile, SurfaceSource};
pub use top::TopMap;
pub use words::Words;

#[cfg(feature = "serve")]
pub(crate) use answer::read;
#[cfg(feature = "serve")]
pub(crate) use session_recording::SessionRecording;
