//! The explorer: a page on this machine with controls on the left and the viewer on the right.
//!
//! ```text
//! page --(Parameters)--> Session: one solver thread --(record::Live)--> GET /run/ID.rrd --> viewer in the page
//!   ^                        |
//!   +------(State)-----------+
//! ```
//!
//! Everything goes over one port of the loopback interface: page, viewer, state and the recording as it grows. A request
//! changes nothing but the one [`Session`]; what the page saves, the browser downloads.

mod command;
mod guard;
mod page;
mod parameters;
mod report;
mod route;
mod server;
mod session;
mod site;
mod stream;
mod sweep;
mod viewing;

pub use parameters::{Geometry, Parameters, Refusal, Start};
pub use report::{Numbers, Report};
pub use route::Explorer;
pub use server::Server;
pub use session::{Order, Session};
pub use site::{Reply, Request, Site};
pub use stream::Source;
pub use viewing::Viewing;
