//! Chromium without a window, led over a pipe in its DevTools protocol. Messages stay JSON: none is lost for being new.

use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Longest wait for an answer: a page that draws in software is slow to answer.
const PATIENCE: Duration = Duration::from_secs(120);

/// No name is found but one that leads here, so that neither page nor browser gets out of this machine.
const FLAGS: &[&str] = &[
    "--headless=new",
    "--remote-debugging-pipe",
    "--no-sandbox",
    "--disable-dev-shm-usage",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-default-apps",
    "--disable-extensions",
    "--disable-sync",
    "--host-resolver-rules=MAP rebound.test 127.0.0.1, MAP * ~NOTFOUND, EXCLUDE 127.0.0.1",
    "--window-size=1280,720",
];

/// Graphics in software as on a machine without a graphics processor: pictures in space are drawn by it, the page itself is not. And none at all.
const SOFTWARE: &[&str] = &["--disable-gpu", "--enable-unsafe-swiftshader"];
const NO_GRAPHICS: &[&str] = &["--disable-gpu", "--disable-3d-apis"];

/// Pipes 3 and 4 are those of the protocol.
const PIPED: &str = r#"exec "$0" "$@" 3<&0 4>&1 </dev/null >/dev/null 2>/dev/null"#;

/// A browser with one page, and all events that it told.
pub struct Chromium {
    process: Child,
    orders: ChildStdin,
    messages: Receiver<Value>,
    calls: u64,
    session: String,
    events: Vec<Value>,
    folder: TempDir,
    _turn: MutexGuard<'static, ()>,
}

/// Browsers draw in software, on all processors there are: two at once would be too slow for either of their tests.
static TURN: Mutex<()> = Mutex::new(());

/// Browser tests that ran, and those that were skipped.
static TESTS: [AtomicUsize; 2] = [AtomicUsize::new(0), AtomicUsize::new(0)];

/// Counts a test as one that ran (0) or was skipped (1), and says how many there were: the last such line tells of all tests.
/// It goes past the capture of tests that pass.
fn count(kind: usize) {
    TESTS[kind].fetch_add(1, Ordering::Relaxed);
    let [ran, skipped] = TESTS.each_ref().map(|tests| tests.load(Ordering::Relaxed));
    writeln!(std::io::stderr(), "browser tests: {ran} ran, {skipped} skipped").ok();
}

/// The program, if it is installed; if not, says that the test is skipped.
pub fn installed() -> Option<PathBuf> {
    let named = ["CHROME", "CHROMIUM"].iter().find_map(std::env::var_os).map(PathBuf::from);
    let path = std::env::var_os("PATH").unwrap_or_default();
    let on_path =
        |name: &&str| std::env::split_paths(&path).map(|folder| folder.join(name)).find(|file| file.is_file());
    let found = named.or_else(|| ["chromium", "chromium-browser", "google-chrome"].iter().find_map(on_path));
    if found.is_none() {
        let test = std::thread::current();
        let test = test.name().unwrap_or("a test");
        writeln!(std::io::stderr(), "skipped: no Chromium is installed for {test}").ok();
        count(1);
    }
    found
}

impl Chromium {
    /// Starts `program` with an empty page.
    pub fn start(program: &Path) -> Self {
        Self::start_with(program, SOFTWARE)
    }

    /// Starts `program` so that no page can draw in three dimensions.
    pub fn without_graphics(program: &Path) -> Self {
        Self::start_with(program, NO_GRAPHICS)
    }

    fn start_with(program: &Path, graphics: &[&str]) -> Self {
        let turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
        let folder = tempfile::tempdir().unwrap();
        let mut process = Command::new("sh")
            .args(["-c", PIPED])
            .arg(program)
            .arg(format!("--user-data-dir={}", folder.path().join("profile").display()))
            .args(FLAGS)
            .args(graphics)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let (told, messages) = channel();
        let mut pieces = BufReader::new(process.stdout.take().unwrap()).split(0);
        std::thread::spawn(move || {
            while let Some(Ok(piece)) = pieces.next() {
                told.send(serde_json::from_slice(&piece).unwrap()).ok();
            }
        });
        let orders = process.stdin.take().unwrap();
        let (calls, session, events) = (0, String::new(), Vec::new());
        let mut chromium = Self { process, orders, messages, calls, session, events, folder, _turn: turn };
        chromium.attach();
        chromium
    }

    fn attach(&mut self) {
        let folder = self.downloads();
        self.browser(
            "Browser.setDownloadBehavior",
            json!({"behavior": "allow", "downloadPath": folder, "eventsEnabled": true}),
        );
        self.open_tab();
    }

    /// Opens an empty tab, which is then the page, and returns the one that was the page before.
    pub fn open_tab(&mut self) -> String {
        let target = self.browser("Target.createTarget", json!({"url": "about:blank"}))["targetId"].clone();
        self.attach_to(&target)
    }

    /// Has the page open another one, as a person who copies a tab does, which is then the page; returns the one before.
    pub fn open_copy(&mut self, address: &str) -> String {
        self.browser("Target.setDiscoverTargets", json!({"discover": true}));
        let open = format!("window.open({}) !== null", json!(address));
        let opened = self.page("Runtime.evaluate", json!({"expression": open, "userGesture": true}));
        assert_eq!(opened["result"]["value"], true, "no window was opened");
        let told = self.told("Target.targetCreated", |event| event["targetInfo"]["openerId"].is_string());
        self.attach_to(&told["targetInfo"]["targetId"])
    }

    fn attach_to(&mut self, target: &Value) -> String {
        let attached = self.browser("Target.attachToTarget", json!({"targetId": target, "flatten": true}));
        std::mem::replace(&mut self.session, attached["sessionId"].as_str().unwrap().into())
    }

    /// Makes another tab the page, in front of all others, and returns the one that was it before.
    pub fn switch_to(&mut self, tab: String) -> String {
        let before = std::mem::replace(&mut self.session, tab);
        self.page("Page.bringToFront", json!({}));
        before
    }

    /// Where downloads are put.
    pub fn downloads(&self) -> PathBuf {
        self.folder.path().join("downloads")
    }

    /// Calls a method of the browser.
    pub fn browser(&mut self, method: &str, parameters: Value) -> Value {
        self.call("", method, parameters)
    }

    /// Calls a method of the page.
    pub fn page(&mut self, method: &str, parameters: Value) -> Value {
        let session = self.session.clone();
        self.call(&session, method, parameters)
    }

    /// Calls a method of the page, which may be on its way to another one: that is then the error.
    pub fn page_at_rest(&mut self, method: &str, parameters: Value) -> Result<Value, Value> {
        let session = self.session.clone();
        self.answer(&session, method, parameters)
    }

    fn call(&mut self, session: &str, method: &str, parameters: Value) -> Value {
        self.answer(session, method, parameters).unwrap_or_else(|error| panic!("{method}: {error}"))
    }

    fn answer(&mut self, session: &str, method: &str, parameters: Value) -> Result<Value, Value> {
        let id = self.send(session, method, parameters);
        let deadline = Instant::now() + PATIENCE;
        loop {
            let message = self.message(deadline).unwrap_or_else(|| panic!("no answer to {method}"));
            assert_ne!(message["method"], "Runtime.exceptionThrown", "nobody catches {:#}", message["params"]);
            if message["id"] == id {
                let error = message["error"].clone();
                return if error.is_null() { Ok(message["result"].clone()) } else { Err(error) };
            }
        }
    }

    fn send(&mut self, session: &str, method: &str, parameters: Value) -> u64 {
        self.calls += 1;
        let mut message = json!({"id": self.calls, "method": method, "params": parameters});
        if !session.is_empty() {
            message["sessionId"] = session.into();
        }
        write!(self.orders, "{message}\0").expect("Chromium has gone");
        self.calls
    }

    /// The next message. Events are kept, and what starts is watched from its first request on.
    fn message(&mut self, deadline: Instant) -> Option<Value> {
        let message = self.messages.recv_timeout(deadline.saturating_duration_since(Instant::now())).ok()?;
        if message["method"] == "Target.attachedToTarget" {
            self.watch(message["params"]["sessionId"].as_str().unwrap());
        }
        if message["method"].is_string() {
            self.events.push(message.clone());
        }
        Some(message)
    }

    /// Has a page or a worker report its requests, errors and workers.
    fn watch(&mut self, session: &str) {
        for method in ["Network.enable", "Runtime.enable", "Log.enable"] {
            self.send(session, method, json!({}));
        }
        let workers = json!({"autoAttach": true, "waitForDebuggerOnStart": true, "flatten": true});
        self.send(session, "Target.setAutoAttach", workers);
        self.send(session, "Runtime.runIfWaitingForDebugger", json!({}));
    }

    /// Events under the name `method` until now.
    pub fn events(&self, method: &str) -> impl Iterator<Item = &Value> {
        self.events.iter().filter(move |event| event["method"] == method).map(|event| &event["params"])
    }

    /// Waits for the event after the first `known` ones of its kind.
    pub fn told_after(&mut self, known: usize, method: &str) -> Value {
        let deadline = Instant::now() + PATIENCE;
        loop {
            if let Some(event) = self.events(method).nth(known) {
                return event.clone();
            }
            assert!(self.message(deadline).is_some(), "{method} never came");
        }
    }

    /// Waits for an event.
    pub fn told(&mut self, method: &str, is_so: impl Fn(&Value) -> bool) -> Value {
        let deadline = Instant::now() + PATIENCE;
        loop {
            if let Some(event) = self.events(method).find(|event| is_so(event)) {
                return event.clone();
            }
            assert!(self.message(deadline).is_some(), "{method} never came");
        }
    }
}

impl Drop for Chromium {
    fn drop(&mut self) {
        self.send("", "Browser.close", json!({}));
        let deadline = Instant::now() + Duration::from_secs(5);
        while self.message(deadline).is_some() {}
        self.process.kill().ok(); // it has most likely gone
        self.process.wait().ok();
        count(0);
    }
}
