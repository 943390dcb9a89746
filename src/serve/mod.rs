//! The explorer on this machine: a page with controls on the left and the viewer on the right. And the same page as a folder of files.
//!
//! ```text
//! page --(Knobs)--> Session: orders --> worker: solve, sweep --(record::Output)--> GET /run/ID.rrd --> viewer in the page
//!   ^                 |                      |
//!   +----(Report)-----+<---(Turn)------------+
//! ```
//!
//! Page, viewer, state and growing recordings all use one port of the loopback interface, and are for those who have the key in the address that is
//! printed. Each tab has its own session
//! in [`Sessions`], and a request changes only this session. Saved files are downloads of the browser.

mod export;
mod guard;
mod language;
mod packed;
mod page;
mod patience;
mod policy;
mod route;
mod server;
mod server_key;
mod sessions;
mod site;
mod stream;
mod worker;

pub use export::{LICENCES, SiteExport};
pub use page::Viewing;
pub use route::Explorer;
pub use server::Server;
pub use sessions::Sessions;
