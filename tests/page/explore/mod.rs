//! The explorer, asked as a browser would ask it.

mod bodies;
mod export;
mod facets;
mod front_ends;
mod hand;
mod heights;
mod lessons;
mod played;
mod rubber;
mod rubbing;
mod scenes;
mod schema;
mod scripts;
mod sessions;
mod sticking;
mod texts;
mod yielding;

use asperity::Stop;
use asperity::contact::{Multilevel, Quantity, Solver};
use asperity::explore::{Knobs, Lesson, Start};
use asperity::serve::{Explorer, Server, Sessions, Viewing};
use asperity::setup::Setup;
use assert_cmd::Command;
use rerun::components::Color;
use rerun::external::re_sdk_types::blueprint::archetypes::Background;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::{BufRead, BufReader, Cursor, Read, Write};
use std::net::TcpStream;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// An explorer on a port of its own.
struct Page {
    port: u16,
    /// The key in the address that is printed.
    key: String,
    session: String,
}

/// An answer: status, headers in lower case, body; of a refusal the sentence as its body, and the whole refusal.
struct Answer {
    status: u16,
    headers: String,
    body: Vec<u8>,
    refusal: Value,
}

impl Answer {
    fn text(&self) -> &str {
        std::str::from_utf8(&self.body).unwrap()
    }

    fn json(&self) -> Value {
        serde_json::from_slice(&self.body).unwrap()
    }
}

impl Page {
    fn open() -> Self {
        Self::serve(Explorer::new(Arc::new(Sessions::default()), Start::RoughLine.knobs(), Lesson::all()).unwrap())
    }

    /// A page of an explorer on a port of its own.
    fn serve(explorer: Explorer) -> Self {
        let server = Server::bind(0).unwrap();
        let address = server.address();
        std::thread::spawn(move || server.run(explorer).unwrap());
        Self::at(&address)
    }

    /// A page of the server whose address is in a text, with a session of its own.
    fn at(text: &str) -> Self {
        let (port, key) = port_and_key(text);
        Self::new(port, key)
    }

    /// A page of the server on a port, with a session of its own.
    fn new(port: u16, key: String) -> Self {
        let page = Self { port, key, session: String::new() };
        let begun = page.post("/api/session", "0");
        assert_eq!(begun.status, 200, "{}", begun.text());
        Self { session: begun.json()["session"].as_str().unwrap().into(), ..page }
    }

    /// The full path of one that is below the session, as most are.
    fn full(&self, path: &str) -> String {
        let is_below = ["/api/", "/run/", "/save/"].iter().any(|start| path.starts_with(start));
        if is_below && path != "/api/session" { format!("/session/{}{path}", self.session) } else { path.into() }
    }

    /// The line of a head with the cookie that a browser has, once it was at the address with the key.
    fn cookie(&self) -> String {
        format!("Cookie: asperity-{}={}\r\n", self.port, self.key)
    }

    /// Sends `request` as it is and reads the answer.
    fn send(&self, request: &[u8]) -> Answer {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
        stream.write_all(request).ok(); // a server that refuses need not read on
        answer(stream)
    }

    fn ask(&self, method: &str, path: &str, headers: &str, body: &str) -> Answer {
        let (port, length, path, cookie) = (self.port, body.len(), self.full(path), self.cookie());
        self.send(
            format!(
                "{method} {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nConnection: close\r\nContent-Length: {length}\r\n\
                 {cookie}{headers}\r\n{body}"
            )
            .as_bytes(),
        )
    }

    fn get(&self, path: &str) -> Answer {
        self.ask("GET", path, "", "")
    }

    fn post(&self, path: &str, body: &str) -> Answer {
        self.ask("POST", path, "Content-Type: application/json\r\n", body)
    }

    /// Orders a solve and waits for its end.
    fn solve(&self, knobs: &Value) -> Value {
        self.order("/api/solve", knobs);
        self.wait(|state| state["busy"] == false)["run"].clone()
    }

    fn order(&self, path: &str, knobs: &Value) {
        let accepted = self.post(path, &knobs.to_string());
        assert_eq!(accepted.status, 200, "{}", accepted.text());
    }

    /// The first state of which `is_so`.
    fn wait(&self, is_so: impl Fn(&Value) -> bool) -> Value {
        let begun = Instant::now();
        let mut revision = 0;
        while begun.elapsed() < Duration::from_secs(120) {
            let state = self.get(&format!("/api/state?since={revision}")).json();
            if is_so(&state) {
                return state;
            }
            revision = state["revision"].as_u64().unwrap();
        }
        panic!("it never came");
    }
}

/// Port and key in what the program prints: `http://127.0.0.1:PORT/?key=KEY  (...)`.
pub fn port_and_key(said: &str) -> (u16, String) {
    let (port, rest) = said.split_once("127.0.0.1:").and_then(|(_, rest)| rest.split_once("/?key=")).unwrap();
    (port.parse().unwrap(), rest.split_whitespace().next().unwrap().into())
}

fn answer(stream: TcpStream) -> Answer {
    let mut reader = BufReader::new(stream);
    let mut head = String::new();
    while !head.ends_with("\r\n\r\n") {
        assert!(reader.read_line(&mut head).unwrap() > 0, "the connection ended after {head:?}");
    }
    let headers = head.to_lowercase();
    let mut body = Vec::new();
    if headers.contains("transfer-encoding: chunked") {
        loop {
            let mut size = String::new();
            reader.read_line(&mut size).unwrap();
            let size = u64::from_str_radix(size.trim(), 16).unwrap();
            reader.by_ref().take(size).read_to_end(&mut body).unwrap();
            reader.read_line(&mut String::new()).unwrap();
            if size == 0 {
                break;
            }
        }
    } else {
        reader.read_to_end(&mut body).unwrap();
    }
    let status = headers.split(' ').nth(1).unwrap().parse().unwrap();
    let refusal = if status == 200 { Value::Null } else { serde_json::from_slice(&body).unwrap_or_default() };
    let body = if refusal.is_null() { body } else { said(&refusal["sentence"]).into_bytes() };
    Answer { status, headers, body, refusal }
}

/// A sentence of an answer in English: a text, or words with sentences and lengths in their places.
pub(crate) fn said(sentence: &Value) -> String {
    let Some(places) = sentence["places"].as_object() else {
        return sentence.as_str().map_or_else(|| sentence["length"].to_string(), str::to_owned);
    };
    let words = sentence["template"].as_str().unwrap().to_owned();
    places.iter().fold(words, |words, (name, place)| words.replace(&format!("{{{name}}}"), &said(place)))
}

/// The knobs at the start with some of them turned.
fn with(changes: Value) -> Value {
    let mut knobs = serde_json::to_value(Start::RoughLine.knobs()).unwrap();
    for (name, value) in changes.as_object().unwrap() {
        knobs[name] = value.clone();
    }
    knobs
}

/// A number of a run.
fn number(run: &Value, of: &str) -> f64 {
    run["numbers"][of].as_f64().unwrap_or_else(|| panic!("{of} is {}", run["numbers"][of]))
}

/// The numbers of a list.
fn values(of: &Value) -> Vec<f64> {
    of.as_array().unwrap().iter().map(|it| it.as_f64().unwrap()).collect()
}

/// The knobs of a stop.
fn stop(tolerance: f64, max_iterations: u64) -> Value {
    json!({"tolerance": tolerance, "max-iterations": max_iterations})
}

/// A solve that takes for ever, nearly.
fn endless() -> Value {
    with(json!({"solver": {"method": "gfmd"}, "points": 1 << 15, "stop": stop(1e-13, 100_000)}))
}

#[test]
fn pages_of_others_are_refused() {
    let page = Page::open();
    let port = page.port;
    let hosts = ["example.com", "127.0.0.1", "127.0.0.1:1", ""].map(String::from);
    let like_ours = ["example.com", "127.0.0.1.example.com", "[::1]"].map(|host| format!("{host}:{port}"));
    for host in hosts.into_iter().chain(like_ours) {
        let refused =
            page.send(format!("GET /api/state HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n").as_bytes());
        assert_eq!(refused.status, 403, "{host}");
    }
    assert_eq!(page.send(b"GET /api/state HTTP/1.1\r\nConnection: close\r\n\r\n").status, 403);
    let foreign =
        ["http://example.com", "null", "https://127.0.0.1", "http://127.0.0.1.example.com", "http://localhost"];
    let foreign = foreign.map(|origin| format!("Origin: {origin}"));
    let like_ours = [format!("Origin: https://127.0.0.1:{port}"), "Origin: http://127.0.0.1:9".into()];
    for header in foreign
        .into_iter()
        .chain(like_ours)
        .chain(["cross-site", "same-site"].map(|site| format!("Sec-Fetch-Site: {site}")))
    {
        let headers = format!("{header}\r\nContent-Type: application/json\r\n");
        assert_eq!(page.ask("POST", "/api/cancel", &headers, "{}").status, 403, "{header}");
        assert_eq!(page.ask("GET", "/", &headers, "").status, 403, "{header}");
    }
    let unsent = page.ask("POST", "/api/cancel", "Content-Type: text/plain\r\n", "{}");
    assert_eq!(unsent.status, 415);
}

#[test]
fn own_pages_may_ask() {
    let page = Page::open();
    let port = page.port;
    let local = format!("GET / HTTP/1.1\r\nHost: localhost:{port}\r\n{}Connection: close\r\n\r\n", page.cookie());
    assert_eq!(page.send(local.as_bytes()).status, 200);
    let own = format!("Origin: http://127.0.0.1:{port}\r\nSec-Fetch-Site: same-origin\r\n");
    assert_eq!(page.ask("GET", "/", &own, "").status, 200);
    let json = format!("{own}Content-Type: application/json\r\n");
    assert_eq!(page.ask("POST", "/api/cancel", &json, "{}").status, 200);
}

/// Other users of the machine reach the port as well. What they do not have is the key; the page of its address gives a cookie and leads on to an
/// address that can be shared.
#[test]
fn those_without_the_key_are_refused() {
    let page = Page::open();
    let (port, key) = (page.port, &page.key);
    let ask = |path: &str, cookie: &str| {
        page.send(
            format!("GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n{cookie}Connection: close\r\n\r\n").as_bytes(),
        )
    };
    let other = "0".repeat(key.len());
    let state = page.full("/api/state");
    for path in
        ["/", "/explore.js", "/re_viewer_bg.wasm", &state, &format!("/?key={other}"), &format!("{state}?key={key}")]
    {
        for cookie in
            [String::new(), page.cookie().replace(key, &other), page.cookie().replace("asperity-", "asperity")]
        {
            let refused = ask(path, &cookie);
            assert_eq!(refused.status, 403, "{path}, {cookie}");
            assert!(refused.text().contains("open the address that asperity printed"), "{}", refused.text());
        }
    }
    let led = ask(&format!("/?language=de&key={key}"), "");
    assert_eq!(led.status, 303);
    assert!(led.headers.contains("location: /?language=de\r\n"), "{}", led.headers);
    let cookie = format!("set-cookie: asperity-{port}={key}; path=/; httponly; samesite=strict");
    assert!(led.headers.contains(&cookie), "{}", led.headers);
    assert_eq!(ask("/", &page.cookie()).status, 200);
    assert_eq!(ask(&state, &format!("Cookie: a=b; asperity-{port}={key}; c=d\r\n")).status, 200);
}

/// The viewer in the page asks for recordings without cookies. The name of the session in their paths is what others do not have.
#[test]
fn recordings_need_the_name_of_their_session() {
    let page = Page::open();
    let own = json!(Start::HertzLine.knobs());
    page.solve(&own);
    let ask = |path: &str| {
        let head = format!("GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: close\r\n\r\n", page.port);
        page.send(head.as_bytes())
    };
    assert_eq!(ask(&page.full("/run/run-1.rrd")).status, 200);
    for path in ["/save/run-1.rrd", "/api/state", "/run"] {
        assert_eq!(ask(&page.full(path)).status, 403, "{path}");
    }
    for name in ["", "1", &page.key, &"0".repeat(page.session.len())] {
        assert_eq!(ask(&format!("/session/{name}/run/run-1.rrd")).status, 403, "{name}");
    }
}

/// A recording that is viewed has a path that nobody can guess, which the page alone tells.
#[test]
fn a_viewed_recording_has_a_secret_path() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.rrd");
    std::fs::write(&file, "bytes of a recording").unwrap();
    let server = Server::bind(0).unwrap();
    let (port, key) = port_and_key(&server.address());
    let viewing = Viewing::new(file).unwrap();
    std::thread::spawn(move || server.run(viewing).unwrap());
    let page = Page { port, key, session: String::new() };
    let ask = |path: &str| {
        page.send(format!("GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nConnection: close\r\n\r\n").as_bytes())
    };
    assert_eq!([ask("/").status, ask("/recording.rrd").status], [403, 403]);
    let html = page.get("/").text().to_owned();
    let path = html.split_once("data-recording=\"").unwrap().1.split('"').next().unwrap();
    assert!(path.len() > 32, "{path}");
    assert_eq!(ask(&format!("/{path}")).text(), "bytes of a recording");
    assert_eq!(page.get("/recording.rrd").status, 404);
}

#[test]
fn every_answer_confines_the_page() {
    let page = Page::open();
    for path in [
        "/",
        "/en.js",
        "/explore.js",
        "/explore.css",
        "/favicon.svg",
        "/re_viewer.js",
        "/re_viewer_bg.wasm",
        "/api/state",
        "/no",
    ] {
        let answer = page.get(path);
        assert_eq!(answer.status, if path == "/no" { 404 } else { 200 }, "{path}");
        assert!(answer.headers.contains("x-content-type-options: nosniff"), "{path}: {}", answer.headers);
        assert!(answer.headers.contains("content-security-policy: default-src 'none'"), "{path}: {}", answer.headers);
        assert!(answer.headers.contains("cross-origin-resource-policy: same-origin"), "{path}: {}", answer.headers);
        assert!(!answer.headers.contains("access-control"), "{path}: {}", answer.headers);
        assert!(!answer.body.is_empty(), "{path}");
    }
}

#[test]
fn the_page_names_nothing_outside() {
    let page = Page::open();
    let html = page.get("/");
    let scripts: Vec<&str> =
        html.text().split("script src=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
    assert!(scripts.contains(&"explore.js"), "{scripts:?}");
    let own = scripts.into_iter().filter(|path| *path != "en.js"); // compressed texts
    for path in own.chain(["", "explore.css"]) {
        let answer = page.get(&format!("/{path}"));
        let elsewhere = answer.text().replace("http://www.w3.org/2000/svg", "");
        assert!(
            !elsewhere.contains("http://") && !elsewhere.contains("https://") && !elsewhere.contains("//cdn"),
            "{path}"
        );
    }
}

#[test]
fn page_and_guide_explain_the_same_symbols() {
    let page = Page::open();
    let html = page.get("/");
    let words = html.text().split("<dt>").skip(1).filter_map(|rest| rest.split("</dt>").next());
    let symbols =
        ["E*", "a_rel", "p*", "κ", "κ_r", "η", "ḡ, ḡ_r", "h_rms", "H_c", "Y, H", "t, L", "f, τ", "V, T", "w, ρ"];
    assert_eq!(words.collect::<Vec<_>>(), symbols);
    let symbols = ["`a_rel`", "`p*`", "`kappa`", "`kappa_r`", "`eta`", "`gbar`, `gbar_r`", "`E*`", "`h_rms`"];
    for symbol in symbols.into_iter().chain(["`H_c`, `t`, `L`", "`f`, `tau`", "`V`, `T`", "`w`, `rho`", "`mu`"]) {
        assert!(
            include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/guide/words.md"))
                .contains(&format!("| {symbol} | ")),
            "{symbol}"
        );
    }
}

#[test]
fn no_path_leads_out() {
    let page = Page::open();
    for path in [
        "/../Cargo.toml",
        "/%2e%2e/Cargo.toml",
        "/run/../../Cargo.toml",
        "/run/..%2fx.rrd",
        "//etc/passwd",
        "/etc/passwd",
        "/run/run-1.rrd",
        "/run/.rrd",
        "/recording.rrd",
        "/assets/explore/explore.js",
        "/api",
        "/api/state/",
    ] {
        let answer = page.get(path);
        assert_eq!(answer.status, 404, "{path}");
        assert!(answer.text().starts_with("there is nothing at"), "{path}: {}", answer.text());
    }
}

#[test]
fn methods_are_kept_apart() {
    let page = Page::open();
    for path in ["/", "/api/state", "/api/start", "/api/observables", "/api/runs"] {
        assert_eq!(page.post(path, "{}").status, 405, "{path}");
    }
    for path in ["/api/solve", "/api/sweep", "/api/cancel"] {
        assert_eq!(page.get(path).status, 405, "{path}");
    }
    for method in ["DELETE", "PUT", "OPTIONS", "PATCH", "TRACE"] {
        assert_eq!(page.ask(method, "/", "", "").status, 405, "{method}");
    }
}

#[test]
fn malformed_input_gets_a_sentence() {
    let page = Page::open();
    let wrong = [
        ("".into(), "EOF"),
        ("{".into(), "EOF"),
        ("[]".into(), "invalid"),
        ("null".into(), "null is not possible: give a table"),
        ("\u{0}".into(), "expected value"),
        (json!({"load": 1}).to_string(), "missing field"),
        (with(json!({"file": "/etc/passwd"})).to_string(), "there is no `file` here: choose one of `domain`"),
        (with(json!({"points": -1})).to_string(), "-1 is not possible: give a whole number, not negative"),
        (with(json!({"points": 1e300})).to_string(), "is not possible: give a whole number, not negative"),
        (with(json!({"points": 1 << 30})).to_string(), "`points` cannot be 1073741824: give a whole number from 4"),
        (with(json!({"points": 2048, "domain": "surface"})).to_string(), "`points` cannot be 2048 for a surface"),
        (with(json!({"points": 2, "roughness": 0, "body": "round"})).to_string(), "`points` cannot be 2: "),
        (with(json!({"load": 0})).to_string(), "`load` cannot be 0: give a number from 1e-5 to 1000"),
        (with(json!({"load": -1})).to_string(), "`load` cannot be -1: "),
        (with(json!({"load": 1e300})).to_string(), "`load` cannot be 1e300: "),
        (with(json!({"load": null})).to_string(), "null is not possible: give a number"),
        (with(json!({"hurst": 2})).to_string(), "`hurst` cannot be 2: "),
        (with(json!({"cutoff": 1e9})).to_string(), "`cutoff` cannot be 1000000000: "),
        (
            with(json!({"rolloff": 500, "cutoff": 100})).to_string(),
            "`cutoff` cannot be 100: give more than `rolloff`, which is 500",
        ),
        (with(json!({"rolloff": 0})).to_string(), "`rolloff` cannot be 0: "),
        (
            with(json!({"cutoff": 3000})).to_string(),
            "`cutoff` cannot be 3000: give at most half of `points`, which is 4096",
        ),
        (with(json!({"hardness": -1})).to_string(), "`hardness` cannot be -1: "),
        (with(json!({"roughness": -1})).to_string(), "`roughness` cannot be -1: "),
        (with(json!({"roughness": 0})).to_string(), "flat"),
        (with(json!({"body": "cube"})).to_string(), "unknown variant"),
        (with(json!({"body": "power-law", "exponent": -1})).to_string(), "exponent"),
        (with(json!({"solver": {"method": "gfmd", "damping": 0}})).to_string(), "damping"),
        (with(json!({"solver": {"method": "gfmd", "time-step": 1}})).to_string(), "`solver.time-step` cannot be 1: "),
        (with(json!({"solver": {"method": "gfmd", "file": 1}})).to_string(), "there is no `file` here"),
        (with(json!({"solver": {"method": "magic"}})).to_string(), "unknown variant"),
        (with(json!({"stop": stop(0.0, 10)})).to_string(), "tolerance"),
        (with(json!({"stop": stop(1e-8, 0)})).to_string(), "`stop.max-iterations` cannot be 0: "),
        (with(json!({"stop": stop(1e-8, 1u64 << 40)})).to_string(), "`stop.max-iterations` cannot be "),
        (with(json!({"record": ["everything"]})).to_string(), "unknown variant"),
    ];
    for (body, offence) in &wrong {
        for path in ["/api/solve", "/api/sweep"] {
            let answer = page.post(path, body);
            assert_eq!(answer.status, 400, "{body}: {}", answer.text());
            assert!(answer.text().contains(offence), "{body}: {offence} is not in {}", answer.text());
        }
    }
    assert_eq!(page.get("/api/state?since=yesterday").status, 400);
    assert_eq!(page.get("/api/state").json()["busy"], false);
}

#[test]
fn hostile_requests_leave_it_running() {
    let page = Page::open();
    let port = page.port;
    let large = "x".repeat(1 << 17);
    assert_eq!(page.post("/api/solve", &large).status, 413);
    let claim = format!(
        "POST /api/session HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n{}Content-Type: application/json\r\nContent-Length: 99999999999999999\r\n\r\n{{",
        page.cookie()
    );
    assert_eq!(page.send(claim.as_bytes()).status, 413);
    let endless_header = format!("GET / HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nX: {}", "y".repeat(1 << 20));
    for junk in [endless_header.as_bytes(), b"\x16\x03\x01\x02\x00\x01\x00", b"GET", b"\r\n\r\n\r\n", &[0xff; 4096]] {
        let mut stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
        stream.write_all(junk).ok();
    }
    let _idle: Vec<TcpStream> = (0..100).map(|_| TcpStream::connect(("127.0.0.1", port)).unwrap()).collect();
    assert_eq!(page.get("/").status, 200);
}

#[test]
fn requests_that_stop_halfway_are_closed() {
    let page = Page::open();
    let head = format!("GET / HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n{}", page.port, page.cookie());
    let open = |_| {
        let mut stream = TcpStream::connect(("127.0.0.1", page.port)).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(50))).unwrap();
        stream.write_all(head.as_bytes()).unwrap();
        stream
    };
    let half: Vec<TcpStream> = (0..200).map(open).collect();
    assert_eq!(page.get("/").status, 200);
    for mut stream in half {
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).expect("the page closes the connection");
        assert!(!answer.starts_with(b"HTTP/1.1 200"));
    }
    assert_eq!(page.get("/").status, 200);
}

#[test]
fn a_solve_gives_the_numbers_of_the_library() {
    let page = Page::open();
    let run = page.solve(&with(json!({})));
    for observable in page.get("/api/observables").json().as_array().unwrap() {
        let (name, numbers) = (observable["name"].as_str().unwrap(), run["numbers"].as_object().unwrap());
        assert!(!observable["sentence"].as_str().unwrap().is_empty(), "{name}");
        // others are known by a process
        let is_found = Quantity::found().any(|it| it.name() == name);
        assert_eq!(numbers.contains_key(name), is_found, "{name}");
    }
    let knobs = Start::RoughLine.knobs();
    let problem = knobs.setup().unwrap().problem().unwrap();
    let contact = Multilevel.solve(&problem, &Stop::new(1e-8, 20_000).unwrap(), &mut ()).unwrap();
    let measures = contact.counted();
    assert_eq!(run["numbers"]["status"], "converged");
    assert_eq!(run["numbers"]["kappa_r_counted"], measures.kappa_r);
    assert_eq!(run["numbers"]["relative_area_counted"], measures.relative_area);
    assert_eq!(run["numbers"]["certificate"], contact.certificate.eta);
    assert_eq!(run["numbers"]["iterations"], contact.work.iterations);
    assert_eq!(run["numbers"]["mean_gap_over_rms_height"], contact.mean_gap() / problem.rms_height());
    assert_eq!(run["knobs"], serde_json::to_value(&knobs).unwrap());
}

#[test]
fn the_command_repeats_the_run() {
    let page = Page::open();
    let small_surface = json!({"domain": "surface", "points": 64, "cutoff": 16});
    let cases = [
        json!({"seed": 4294967295u32, "hurst": 0.35, "load": 0.1234}),
        json!({"body": "round", "roughness": 0, "load": 0.02}),
        json!({"body": "round", "roughness": 0.0022, "points": 1000, "solver": {"method": "polonsky-keer"}}),
        json!({"body": "sine", "roughness": 0, "load": 0.3}),
        json!({"body": "power-law", "exponent": 3.5, "roughness": 0, "points": 512}),
        json!({
            "solver": {"method": "gfmd", "masses": "stiffness", "dynamics": "fire", "time-step": 0.35},
            "points": 512,
            "stop": stop(1e-6, 20_000)
        }),
        json!({"solver": {"method": "gfmd", "damping": 0.45}, "points": 256, "stop": stop(1e-5, 20_000), "cutoff": 32}),
        small_surface.clone(),
        json!({"domain": "surface", "points": 64, "cutoff": 16, "body": "sine", "roughness": 0.001}),
        json!({"points": 512, "cutoff": 64, "skewness": -0.5, "kurtosis": 3.5}),
        json!({"points": 512, "cutoff": 64, "bumps": [[0.3, -0.0005, 0.02], [0.7, 0.0002, 0.02]]}),
    ];
    for case in cases {
        let run = page.solve(&with(case.clone()));
        let line = run["command"].as_str().unwrap();
        let output =
            Command::new(env!("CARGO_BIN_EXE_asperity")).args(line.split(' ').skip(1)).arg("--json").output().unwrap();
        assert!(output.status.success(), "{line}: {}", String::from_utf8_lossy(&output.stderr));
        let repeated: Value = serde_json::from_slice(&output.stdout).unwrap();
        for name in ["kappa_r_counted", "kappa_r", "relative_area", "certificate", "iterations", "patches"] {
            assert_eq!(run["numbers"][name], repeated[name], "{name} of {line}");
        }
    }
}

#[test]
fn the_setup_repeats_the_run() {
    let page = Page::open();
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.toml");
    for case in [
        json!({"seed": 4294967295u32, "hurst": 0.35, "load": 0.1234}),
        json!({"body": "round", "domain": "surface", "points": 64, "cutoff": 16}),
        json!({"solver": {"method": "gfmd", "damping": 0.45}, "points": 256, "stop": stop(1e-5, 20_000), "cutoff": 32}),
    ] {
        let knobs = with(case);
        let run = page.solve(&knobs);
        let text = run["setup"].as_str().unwrap();
        let setup = Knobs::read(knobs.to_string().as_bytes()).unwrap().setup().unwrap();
        assert_eq!(Setup::from_toml(text).unwrap(), setup);
        std::fs::write(&scene, text).unwrap();
        let output =
            Command::new(env!("CARGO_BIN_EXE_asperity")).arg("solve").arg(&scene).arg("--json").output().unwrap();
        assert!(output.status.success(), "{text}: {}", String::from_utf8_lossy(&output.stderr));
        let repeated: Value = serde_json::from_slice(&output.stdout).unwrap();
        for name in ["kappa_r", "certificate", "iterations"] {
            assert_eq!(run["numbers"][name], repeated[name], "{name} of {text}");
        }
    }
}

#[test]
fn a_smooth_body_stands_beside_its_exact_solution() {
    let page = Page::open();
    let run = page.solve(&with(json!({"body": "round", "roughness": 0, "load": 0.02})));
    let number = |value: &Value| value.as_f64().unwrap();
    let (computed, exact) = (number(&run["numbers"]["kappa_r"]), number(&run["exact"]["kappa_r"]));
    assert!((computed / exact - 1.0).abs() < 0.01, "{computed} against {exact}");
    let rough = page.solve(&with(json!({"body": "round", "roughness": 0.001})));
    assert_eq!(rough["exact"], Value::Null);
}

#[test]
fn a_solve_can_be_ended_and_the_next_one_runs() {
    let page = Page::open();
    page.order("/api/solve", &endless());
    let running = page.wait(|state| state["run"]["numbers"]["status"] == "running");
    assert_eq!(page.get(&format!("/save/{}.rrd", running["run"]["id"].as_str().unwrap())).status, 409);
    assert_eq!(page.post("/api/cancel", "{}").status, 200);
    let ended = page.wait(|state| state["busy"] == false);
    assert_eq!(ended["run"]["id"], running["run"]["id"]);
    assert_eq!(ended["run"]["numbers"]["status"], "stopped by the observer");
    assert_eq!(page.solve(&with(json!({})))["numbers"]["status"], "converged");
}

#[test]
fn the_latest_order_wins() {
    let page = Page::open();
    for load in 1..=30 {
        page.order("/api/solve", &endless());
        page.order("/api/solve", &with(json!({"load": f64::from(load) * 1e-2})));
    }
    let state = page.wait(|state| state["busy"] == false);
    assert_eq!(state["run"]["knobs"]["load"], 0.3);
    assert_eq!(state["run"]["numbers"]["status"], "converged");
    assert_eq!(state["fault"], Value::Null);
}

/// The area that a sweep draws.
const AREA: &str = "relative_area";

#[test]
fn a_sweep_goes_from_first_touch_to_full_contact() {
    let page = Page::open();
    page.order("/api/sweep", &with(json!({"body": "sine", "roughness": 0, "points": 1024})));
    let state = page.wait(|state| state["sweep"]["ended"] == true);
    let points = state["sweep"]["points"].as_array().unwrap();
    let number = |point: &Value, name: &str| point[name].as_f64().unwrap();
    assert!(points.len() > 30, "{}", points.len());
    assert!(points.windows(2).all(|w| number(&w[0], AREA) <= number(&w[1], AREA) + 1e-12));
    assert!(number(points.last().unwrap(), AREA) > 0.999);
    for point in points.iter().filter(|point| number(point, AREA) > 0.1) {
        let (computed, exact) = (number(point, AREA), number(&point["exact"], "relative_area"));
        assert!((computed - exact).abs() < 4e-3, "{computed} against {exact}");
    }
}

/// The name of a recording, and the rows of each of its entities that change.
fn recorded(rrd: &[u8]) -> (String, BTreeMap<String, usize>) {
    let config = &rerun::ChunkStoreConfig::ALL_DISABLED;
    let stores = rerun::ChunkStore::from_rrd_reader(config, &mut Cursor::new(rrd)).unwrap();
    let (id, store) = stores.iter().find(|(id, _)| id.kind() == rerun::StoreKind::Recording).unwrap();
    let mut rows = BTreeMap::new();
    for chunk in store.iter_physical_chunks().filter(|chunk| !chunk.is_static()) {
        *rows.entry(chunk.entity_path().to_string()).or_default() += chunk.num_rows();
    }
    (id.recording_id().as_str().to_owned(), rows)
}

#[test]
fn a_sweep_is_recorded_load_by_load() {
    let page = Page::open();
    page.order("/api/sweep", &with(json!({"body": "sine", "roughness": 0, "points": 512, "record": []})));
    let sweep = page.wait(|state| state["busy"] == false)["sweep"].clone();
    let points = sweep["points"].as_array().unwrap();
    let saved = page.get("/save/sweep-1.rrd");
    assert!(saved.headers.contains("filename=\"sine_sweep_multilevel.rrd\""), "{}", saved.headers);
    assert_eq!(page.get("/save/sweep-1.npz").status, 409);
    assert_eq!(page.get("/api/runs").json()[0]["points"], sweep["points"]);
    let (id, rows) = recorded(&saved.body);
    assert_eq!(sweep["id"], id);
    // area, kappa_r, kappa and mean gap, and what the exact solution says of area and kappa_r
    for curve in [0, 1, 2, 3, 4, 5].map(|curve| format!("/curve/{curve}")) {
        assert_eq!(rows[&curve], points.len(), "{curve}");
    }
    assert!(!rows.contains_key("/curve/6"), "a sine has a curve of Persson's theory, which is about rough flats");
    assert!(points.iter().all(|point| point["persson"].is_null()));
    assert!(rows["/contact/contact/contact"] >= points.len());
    assert!(!rows.keys().any(|entity| entity.contains("pressure")), "{rows:?}");
}

#[test]
fn pictures_follow_the_theme_of_the_page() {
    let page = Page::open();
    let small = json!({"points": 256, "cutoff": 64, "theme": "light"});
    let light = page.solve(&with(small.clone()));
    assert!(light["setup"].as_str().unwrap().contains("theme = \"light\""), "{}", light["setup"]);
    page.order("/api/sweep", &with(small));
    page.wait(|state| state["busy"] == false);
    let (run, sweep) = (page.get("/run/run-1.rrd").body, page.get("/run/sweep-2.rrd").body);
    for rrd in [run, sweep] {
        let config = &rerun::ChunkStoreConfig::ALL_DISABLED;
        let stores = rerun::ChunkStore::from_rrd_reader(config, &mut Cursor::new(rrd)).unwrap();
        let layout = stores.iter().find(|(id, _)| id.kind() == rerun::StoreKind::Blueprint).unwrap().1;
        let component = Background::descriptor_color().component;
        let grounds = layout.iter_physical_chunks().filter_map(|chunk| chunk.component_batch::<Color>(component, 0));
        let grounds: Vec<Color> = grounds.flat_map(Result::unwrap).collect();
        assert!(!grounds.is_empty() && grounds.iter().all(|ground| ground.to_array() == [255; 4]), "{grounds:?}");
    }
}

#[test]
fn a_sweep_that_is_ended_leaves_a_whole_recording() {
    let page = Page::open();
    let slow = json!({"points": 1 << 17, "cutoff": 1 << 14, "stop": stop(1e-12, 20_000)});
    page.order("/api/sweep", &with(slow));
    let id = page.wait(|state| state["sweep"]["points"][0].is_object())["sweep"]["id"].clone();
    page.post("/api/cancel", "{}");
    let ended = page.wait(|state| state["busy"] == false);
    assert_eq!(ended["sweep"]["ended"], true);
    let (name, rows) = recorded(&page.get(&format!("/run/{}.rrd", id.as_str().unwrap())).body);
    assert_eq!(id, name);
    assert_eq!(rows["/curve/0"], ended["sweep"]["points"].as_array().unwrap().len());
}

#[test]
fn the_curves_of_a_pinned_run_stand_beside_those_of_later_ones() {
    let page = Page::open();
    let small = |seed: u32| with(json!({"seed": seed, "points": 512, "cutoff": 64}));
    let has_ghost = |run: &Value| {
        let (_, rows) = recorded(&page.get(&format!("/run/{}.rrd", run["id"].as_str().unwrap())).body);
        rows.contains_key("/contact/ghost/certificate_log10")
    };
    assert_eq!(page.post("/api/pin", "\"run-1\"").status, 400);
    page.solve(&small(1));
    assert!(!has_ghost(&page.solve(&small(2))));
    assert_eq!(page.post("/api/pin", "\"run-1\"").status, 200);
    for seed in 3..12 {
        assert!(has_ghost(&page.solve(&small(seed))), "seed {seed}");
    }
    assert_eq!(page.get("/run/run-1.rrd").status, 200);
    assert_eq!(page.get("/run/run-2.rrd").status, 404);
    assert_eq!(page.post("/api/pin", "null").status, 200);
    assert!(!has_ghost(&page.solve(&small(1))));
}

#[test]
fn what_is_saved_opens() {
    let page = Page::open();
    assert_eq!(page.get("/save/run-1.rrd").status, 404);
    let run = page.solve(&with(json!({"points": 512, "cutoff": 64, "record": ["traces", "fields", "spectrum"]})));
    let (saved, streamed) =
        (page.get("/save/run-1.rrd"), page.get(&format!("/run/{}.rrd", run["id"].as_str().unwrap())));
    assert!(
        saved.headers.contains("content-disposition: attachment; filename=\"rough-line_p0.05_multilevel.rrd\""),
        "{}",
        saved.headers
    );
    assert!(!streamed.headers.contains("content-disposition"));
    assert_eq!(saved.body, streamed.body);
    let (id, rows) = recorded(&saved.body);
    assert_eq!(id, "run-1");
    assert!(rows.contains_key("/contact/trace/kappa_r_counted"), "{rows:?}");
    assert!(rows.contains_key("/contact/spectrum/displacement"), "{rows:?}");
    let mut npz = ndarray_npy::NpzReader::new(Cursor::new(page.get("/save/run-1.npz").body)).unwrap();
    let pressure: ndarray::Array1<f64> = npz.by_name("pressure").unwrap();
    let contact: ndarray::Array1<bool> = npz.by_name("contact").unwrap();
    let share = contact.iter().filter(|&&c| c).count() as f64 / pressure.len() as f64;
    assert_eq!(run["numbers"]["relative_area_counted"], share);
    let setup: ndarray::Array1<u8> = npz.by_name("setup").unwrap();
    assert_eq!(run["setup"], String::from_utf8(setup.to_vec()).unwrap());
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("run.rrd");
    std::fs::write(&file, &saved.body).unwrap();
    assert_eq!(asperity::record::setups(&file).unwrap().unwrap(), [run["setup"].as_str().unwrap()]);
}

#[test]
fn earlier_runs_are_told_and_saved_as_long_as_they_are_kept() {
    let page = Page::open();
    let knobs = |load: f64| with(json!({"points": 512, "cutoff": 64, "load": load}));
    assert_eq!(page.get("/api/runs").json(), json!([]));
    let runs: Vec<Value> = (1..=8).map(|load| page.solve(&knobs(f64::from(load) * 0.01))).collect();
    assert_eq!(page.get("/api/runs").json(), json!(runs[2..]));
    let saved = page.get("/save/run-3.npz");
    assert!(saved.headers.contains("filename=\"rough-line_p0.03_multilevel.npz\""), "{}", saved.headers);
    let mut npz = ndarray_npy::NpzReader::new(Cursor::new(saved.body)).unwrap();
    let setup: ndarray::Array1<u8> = npz.by_name("setup").unwrap();
    assert_eq!(runs[2]["setup"], String::from_utf8(setup.to_vec()).unwrap());
    for gone in ["/save/run-2.npz", "/save/run-2.rrd", "/run/run-2.rrd", "/save/run-3.exe", "/save/run-3"] {
        assert_eq!(page.get(gone).status, 404, "{gone}");
    }
}

#[test]
fn a_recording_can_be_read_while_it_grows() {
    let page = Page::open();
    page.order("/api/solve", &endless());
    let id = page.wait(|state| state["run"]["numbers"]["status"] == "running")["run"]["id"].clone();
    let mut stream = TcpStream::connect(("127.0.0.1", page.port)).unwrap();
    let path = page.full(&format!("/run/{}.rrd", id.as_str().unwrap()));
    write!(stream, "GET {path} HTTP/1.1\r\nHost: localhost:{}\r\n{}\r\n", page.port, page.cookie()).unwrap();
    let mut first = [0; 1 << 12];
    stream.read_exact(&mut first).unwrap();
    assert_eq!(page.get("/api/state").json()["busy"], true);
    drop(stream);
    page.post("/api/cancel", "{}");
    page.wait(|state| state["busy"] == false);
    assert_eq!(page.get("/").status, 200);
}

#[test]
fn only_the_latest_recordings_are_kept() {
    let page = Page::open();
    for seed in 0..8 {
        page.solve(&with(json!({"seed": seed, "points": 512, "cutoff": 64})));
    }
    assert_eq!(page.get("/run/run-1.rrd").status, 404);
    assert_eq!(page.get("/run/run-8.rrd").status, 200);
}

#[test]
fn a_port_in_use_gives_the_next_one() {
    let first = Server::bind(0).unwrap();
    let second = Server::bind(first.port()).unwrap();
    assert!(second.port() > first.port() && second.port() <= first.port() + 32);
    assert!(second.address().starts_with("http://127.0.0.1:"));
}

#[test]
fn every_start_stands_for_a_setup_and_survives_json() {
    for start in [Start::HertzLine, Start::HertzSurface, Start::RoughLine, Start::RoughSurface] {
        let knobs = start.knobs();
        knobs.setup().unwrap();
        assert_eq!(Knobs::read(&serde_json::to_vec(&knobs).unwrap()).unwrap(), knobs);
    }
}

#[test]
fn view_refuses_what_is_no_recording() {
    for file in ["missing.rrd", "Cargo.toml", "src"] {
        let output = Command::new(env!("CARGO_BIN_EXE_asperity"))
            .args(["view", "--no-open", "--port", "0", file])
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(2), "{file}");
        let complaint = String::from_utf8(output.stderr).unwrap();
        assert!(complaint.contains(file) && output.stdout.is_empty(), "{complaint}");
    }
}

/// The command runs, says where, and an interrupt ends it well, as does the wish of the system.
#[cfg(unix)]
#[test]
fn an_interrupt_ends_it() {
    for signal in ["-INT", "-TERM"] {
        ends_at(signal);
    }
}

#[cfg(unix)]
fn ends_at(signal: &str) {
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_asperity"))
        .args(["explore", "hertz-line", "--no-open", "--port", "0"])
        .stdout(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    let mut said = String::new();
    let mut out = BufReader::new(child.stdout.take().unwrap());
    out.read_line(&mut said).unwrap();
    let page = Page::at(&said);
    page.order("/api/solve", &endless());
    page.wait(|state| state["run"]["numbers"]["status"] == "running");
    std::process::Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
    assert!(child.wait().unwrap().success(), "{signal}");
}

#[test]
fn refusals_carry_their_ids_and_values() {
    let page = Page::open();
    let rough = serde_json::to_value(Start::RoughLine.knobs()).unwrap();
    let with = |key: &str, value: Value| {
        let mut knobs = rough.clone();
        knobs[key] = value;
        page.post("/api/solve", &knobs.to_string()).refusal
    };
    let given = json!({"knob": "hurst", "value": "2", "least": "0.01", "most": "1"});
    let refusal = with("hurst", json!(2));
    assert_eq!((&refusal["key"], &refusal["places"]), (&json!("knob-range"), &given));
    assert_eq!(said(&refusal["sentence"]), "`hurst` cannot be 2: give a number from 0.01 to 1");
    assert_eq!(with("load", json!("much"))["key"], "wrong-value");
    assert_eq!(with("body", json!("file"))["key"], "no-heights");
    assert_eq!(page.get("/api/nothing").refusal["key"], Value::Null);
}
