//! The explorer as a process of its own, and its page in a browser.

use super::chromium::Chromium;
use super::page::Page;
use crate::explore::port_and_key;
use serde_json::Value;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};

/// `asperity explore` on a port of its own.
pub struct Explorer {
    process: Child,
    pub port: u16,
    /// The key in its address.
    key: String,
    /// The session whose state it tells.
    pub session: String,
}

impl Explorer {
    pub fn start() -> Self {
        Self::start_at(0)
    }

    /// One on a port, or on any for 0.
    pub fn start_at(port: u16) -> Self {
        let mut process = Command::new(env!("CARGO_BIN_EXE_asperity"))
            .args(["explore", "--no-open", "--port", &port.to_string()])
            .env("XDG_RUNTIME_DIR", env!("CARGO_TARGET_TMPDIR")) // where the key is kept for one that is started again
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut said = String::new();
        BufReader::new(process.stdout.take().unwrap()).read_line(&mut said).unwrap();
        let (port, key) = port_and_key(&said);
        Self { process, port, key, session: String::new() }
    }

    /// Ends it without a word.
    pub fn kill(mut self) -> u16 {
        self.process.kill().unwrap();
        self.process.wait().unwrap();
        self.port
    }

    pub fn id(&self) -> u32 {
        self.process.id()
    }

    pub fn origin(&self) -> String {
        format!("http://127.0.0.1:{}", self.port)
    }

    /// The address of the page with the key, and with more in its query, which may end with a part after #.
    pub fn address(&self, more: &str) -> String {
        format!("{}/?key={}{more}", self.origin(), self.key)
    }

    /// The state that the server reports of the session, asked without a browser.
    pub fn state(&self) -> Value {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        let path = format!("/session/{}/api/state", self.session);
        let (port, key) = (self.port, &self.key);
        let cookie = format!("Cookie: asperity-{port}={key}");
        write!(stream, "GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n{cookie}\r\nConnection: close\r\n\r\n")
            .unwrap();
        let mut answer = String::new();
        stream.read_to_string(&mut answer).unwrap();
        serde_json::from_str(answer.split_once("\r\n\r\n").unwrap().1).unwrap()
    }
}

impl Drop for Explorer {
    fn drop(&mut self) {
        self.process.kill().ok(); // it has most likely not gone
        self.process.wait().ok();
    }
}

/// A window in which the page shows its own picture and the viewer.
pub const ROOMY: [u32; 2] = [1440, 900];

/// The page with its viewer, at the end of its first run.
pub fn opened(program: &Path) -> (Explorer, Page) {
    opened_in(Chromium::start(program), "&view=both")
}

/// The page without a viewer, at the end of its first run, with more in its address: for what the viewer has no part in, sooner.
pub fn sketched(program: &Path, more: &str) -> (Explorer, Page) {
    opened_in(Chromium::without_graphics(program), more)
}

/// The page in a browser, with more in its address, at the end of its first run.
pub fn opened_in(chromium: Chromium, more: &str) -> (Explorer, Page) {
    let mut explorer = Explorer::start();
    let mut page = Page { chromium };
    page.resize(ROOMY);
    page.follow(&explorer.address(&format!("&renderer=webgl&theme=dark{more}")));
    page.until(
        "document.body.dataset.view === 'picture' || ['started', 'failed'].includes(document.body.dataset.viewer)",
    );
    rested(&mut page);
    explorer.session = page.text("session");
    (explorer, page)
}

/// Waits until nothing is held or solved, and page and viewer, or the page's own picture where there is none, show the run that the
/// controls ask for.
pub fn rested(page: &mut Page) {
    page.until(
        "session && !grip && !holding && !posting && ask('state').then(({ busy, revision, run }) => { \
           const seen = document.body.dataset; \
           const shown = seen.viewer === 'started' && seen.view !== 'picture' ? (seen.shown || '').split(' ')[0] : seen.section; \
           return !busy && run && run.ended && seen.run === run.id && seen.revision === String(revision) && shown === run.id \
             && words(knobs) === words(run.knobs) && (seen.viewer !== 'started' || knobs.theme === run.knobs.theme); })");
}
