//! Pages of others in the same browser.

use super::chromium::{Chromium, installed};
use super::explorer::Explorer;
use super::page::Page;
use serde_json::json;
use std::io::{BufRead, BufReader, Write};
use std::net::TcpListener;

/// A server of an empty page, on a port of its own.
fn stranger() -> String {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = format!("http://{}/", listener.local_addr().unwrap());
    std::thread::spawn(move || {
        for mut stream in listener.incoming().flatten() {
            let mut head = BufReader::new(stream.try_clone().unwrap()).lines();
            while head.next().is_some_and(|line| line.is_ok_and(|line| !line.is_empty())) {}
            let page = "<!doctype html><title>stranger</title><body></body>";
            let (kind, length) = ("text/html", page.len());
            write!(
                stream,
                "HTTP/1.1 200 OK\r\nContent-Type: {kind}\r\nContent-Length: {length}\r\nConnection: close\r\n\r\n{page}"
            )
            .ok(); // a browser that has gone needs no page
        }
    });
    address
}

/// The outcome of a fetch: its status, or `refused` where the browser gives nothing away.
fn fetched(page: &mut Page, address: &str, options: &str) -> String {
    page.text(&format!("fetch('{address}', {options}).then((it) => `${{it.type}} ${{it.status}}`, () => 'refused')"))
}

/// Reading and ordering from a page that is not the explorer's.
fn tries(page: &mut Page, explorer: &Explorer) {
    let session = format!("{}/session/{}", explorer.origin(), explorer.session);
    let (state, solve) = (format!("{session}/api/state"), format!("{session}/api/solve"));
    let before = explorer.state();
    let body = json!(before["run"]["knobs"].to_string());
    assert_eq!(fetched(page, &state, "{}"), "refused");
    let gives_nothing = |it: String| assert!(it == "refused" || it == "opaque 0", "{it}");
    gives_nothing(fetched(page, &state, "{ mode: 'no-cors' }"));
    for kind in ["application/json", "text/plain"] {
        let post = format!("{{ method: 'POST', headers: {{ 'Content-Type': '{kind}' }}, body: {body} }}");
        assert_eq!(fetched(page, &solve, &post), "refused", "{kind}");
    }
    let silent = format!("{{ method: 'POST', mode: 'no-cors', body: {body} }}");
    gives_nothing(fetched(page, &solve, &silent));
    gives_nothing(fetched(page, &state.replace("state", "cancel"), "{ method: 'POST', mode: 'no-cors' }"));
    assert_eq!(explorer.state()["revision"], before["revision"], "a stranger has ordered something");
}

/// The page in a frame of another.
fn frames(page: &mut Page, explorer: &Explorer) {
    let frame = format!(
        "new Promise((loaded) => {{ const it = document.createElement('iframe'); it.onload = () => loaded(true); \
         it.src = '{}/'; document.body.append(it); }})",
        explorer.origin()
    );
    page.value(&frame);
    let refused = |entry: &serde_json::Value| {
        entry["entry"]["text"].as_str().is_some_and(|text| text.contains("frame-ancestors"))
    };
    page.chromium.told("Log.entryAdded", refused);
}

#[test]
fn pages_of_others_get_nothing() {
    let Some(program) = installed() else { return };
    let mut explorer = Explorer::start();
    let rebound = format!("http://rebound.test:{}/", explorer.port);
    let mut page = Page { chromium: Chromium::start(&program) };
    page.follow(&explorer.address(""));
    page.until("document.readyState === 'complete'");
    page.open(&format!("{}/favicon.svg", explorer.origin()));
    let sent =
        |body: &str| format!("{{ method: 'POST', headers: {{ 'Content-Type': 'application/json' }}, body: {body} }}");
    let begin = format!("fetch('/api/session', {}).then((it) => it.json()).then((it) => it.session)", sent("'0'"));
    explorer.session = page.text(&begin);
    let session = format!("/session/{}/api", explorer.session);
    let solve = format!(
        "fetch('{session}/start').then((it) => it.text()).then((body) => fetch('{session}/solve', {})).then((it) => it.status)",
        sent("body")
    );
    assert_eq!(page.value(&solve), 200, "the explorer refuses its own origin");
    page.until(&format!(
        "fetch('{session}/state').then((it) => it.json()).then((state) => !state.busy && state.run && state.run.ended)"
    ));
    for address in [stranger(), "data:text/html,<title>nowhere</title><body></body>".into()] {
        page.open(&address);
        tries(&mut page, &explorer);
        frames(&mut page, &explorer);
    }
    page.open(&rebound);
    assert!(
        page.text("document.body.innerText").contains("this server accepts requests to"),
        "a name that leads here is answered"
    );
    assert_eq!(fetched(&mut page, "/api/state", "{}"), "basic 403");
}
