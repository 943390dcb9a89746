//! Sessions: every tab has its own, and there are few of them.

use super::{Page, endless, with};
use serde_json::{Value, json};
use std::time::{Duration, Instant};

/// Another tab on the same server.
fn beside(page: &Page) -> Page {
    Page::new(page.port, page.key.clone())
}

#[test]
fn every_session_has_runs_of_its_own() {
    let first = Page::open();
    let second = beside(&first);
    let small = |load: f64| with(json!({"points": 512, "cutoff": 64, "load": load}));
    first.order("/api/solve", &endless());
    let run = second.solve(&small(0.02));
    assert_eq!((&run["id"], run["knobs"]["load"].as_f64()), (&json!("run-1"), Some(0.02)));
    assert_eq!(first.get("/api/state").json()["busy"], true, "one session has ended the run of another");
    assert_eq!(first.get("/api/runs").json(), json!([]));
    assert_eq!(second.get("/api/runs").json(), json!([run]));
    assert_eq!(first.solve(&small(0.03))["id"], "run-2");
    assert_ne!(first.get("/run/run-2.rrd").body, second.get("/run/run-1.rrd").body);
    assert_eq!(second.get("/run/run-2.rrd").status, 404);
    assert_ne!(first.session, second.session);
}

#[test]
fn runs_are_numbered_on_where_a_page_has_some() {
    let page = Page::open();
    let session = page.post("/api/session", "41").json()["session"].as_str().unwrap().to_owned();
    let page = Page { session, ..page };
    assert_eq!(page.solve(&with(json!({"points": 512, "cutoff": 64})))["id"], "run-42");
    for wrong in ["-1", "null", "4294967296", "{}", ""] {
        assert_eq!(page.post("/api/session", wrong).status, 400, "{wrong}");
    }
}

#[test]
fn more_sessions_than_there_is_room_for_are_refused_until_one_leaves() {
    let page = Page::open();
    let others = [1, 2, 3].map(|_| beside(&page));
    let refused = page.post("/api/session", "0");
    assert_eq!(refused.status, 503);
    assert!(refused.text().starts_with("4 tabs are open, which"), "{}", refused.text());
    assert_eq!(others[1].post("/api/leave", "{}").status, 200);
    others[2].post("/api/leave", "{}");
    assert_eq!(others[2].get("/api/runs").status, 200, "one that comes back lives on");
    let next = beside(&page);
    assert_eq!(next.get("/api/state").json()["busy"], false);
    let ended = others[1].get("/api/state");
    assert_eq!((ended.status, ended.text()), (410, "this session has ended: reload the page for a new one"));
    assert_eq!(page.post("/api/session", "0").status, 503);
    for page in [&page, &others[0], &others[2]] {
        assert_eq!(page.get("/api/state").status, 200);
    }
}

/// A tab that was killed says no word: its session makes room for another one after some seconds, those of open tabs do not.
#[test]
fn the_session_of_a_tab_that_was_killed_makes_room() {
    let page = Page::open();
    let others = [1, 2, 3].map(|_| beside(&page));
    let begun = Instant::now();
    while page.post("/api/session", "0").status == 503 {
        assert!(begun.elapsed() < Duration::from_secs(30), "it never makes room");
        for open in [&page, &others[0], &others[2]] {
            assert_eq!(open.get("/api/state?since=0").status, 200);
        }
    }
    assert_eq!(others[1].get("/api/state").status, 410);
    for open in [&page, &others[0], &others[2]] {
        assert_eq!(open.get("/api/state").status, 200);
    }
}

#[test]
fn names_that_are_none_are_refused() {
    let page = Page::open();
    for session in ["", "x", "..", &"0".repeat(32), &"9".repeat(4000), "%00", "session/session"] {
        let other = Page { session: session.into(), key: page.key.clone(), port: page.port };
        for answer in [other.get("/api/state"), other.post("/api/solve", "{}"), other.get("/run/run-1.rrd")] {
            assert_eq!(answer.status, 410, "{session}: {}", answer.text());
        }
    }
    assert!(page.session.len() == 32 && page.session.bytes().all(|byte| byte.is_ascii_hexdigit()), "{}", page.session);
    for path in ["/session", "/session/", "/session/x"] {
        assert_eq!(page.get(path).status, 404, "{path}");
    }
    assert_eq!(page.ask("GET", "/api/session", "", "").status, 405);
    assert_eq!(page.get("/api/state").json()["run"], Value::Null);
}
