//! The explorer: its server, and its page in a browser.

#[cfg(unix)]
mod browser;
mod explore;
mod module;
