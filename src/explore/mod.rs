//! The explorer: a page on this machine with controls on the left and the viewer on the right.
//!
//! ```text
//! page --(Knobs)--> Session: orders --> worker: solve, sweep --(record::Output)--> GET /run/ID.rrd --> viewer in the page
//!   ^                 |                      |
//!   +----(Report)-----+<---(Turn)------------+
//! ```
//!
//! Everything goes over one port of the loopback interface: page, viewer, state and the recording as it grows. A request
//! changes nothing but the one [`Session`]; what the page saves, the browser downloads.

mod guard;
mod knobs;
mod page;
mod reel;
mod report;
mod route;
mod server;
mod session;
mod site;
mod solve;
mod stream;
mod sweep;
mod worker;

pub use knobs::{Knobs, Refusal, Start};
pub use page::Viewing;
pub use route::Explorer;
pub use server::Server;
pub use session::Session;
