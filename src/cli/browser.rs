//! The browser of the person at the keyboard.

use std::process::{Command, Stdio};

#[cfg(target_os = "macos")]
const OPEN: &[&str] = &["open"];
#[cfg(target_os = "windows")]
const OPEN: &[&str] = &["rundll32", "url.dll,FileProtocolHandler"];
#[cfg(not(any(target_os = "macos", target_os = "windows")))]
const OPEN: &[&str] = &["xdg-open"];

/// Opens `address`, and says whether that could be tried.
pub fn open(address: &str) -> bool {
    let mut command = Command::new(OPEN[0]);
    command.args(&OPEN[1..]).arg(address).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.spawn().is_ok()
}
