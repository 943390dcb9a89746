//! Measurements of the explorer in a browser, asked for by name:
//! `cargo test --release --test page browser::measures:: -- --ignored --nocapture --test-threads 1`.

use super::chromium::{Chromium, installed};
use super::explorer::{Explorer, opened, opened_in, rested};
use super::page::Page;
use serde_json::{Value, json};

/// Sets a control as a hand does: value and input event.
const TURN: &str = "const turn = (id, value) => { const it = document.getElementById(`control-${id}`); \
    it.value = value; for (const kind of ['input', 'change']) it.dispatchEvent(new Event(kind, { bubbles: true })); };";

/// Times, in milliseconds, from an input event to the first steps of its run in the viewer, to the next frame of the page
/// after them, and to the numbers of the converged run in the page.
const WATCH: &str = "(seed) => new Promise((told) => { \
    const seen = document.body.dataset; const before = seen.run; const begun = performance.now(); const at = {}; \
    turn('seed', seed); \
    const look = () => { const now = performance.now() - begun; \
      const isNew = seen.run !== before && knobs.seed === latest().knobs.seed; \
      if (isNew && !at.first && (seen.shown || '').startsWith(`${seen.run} `)) { \
        at.first = now; requestAnimationFrame(() => requestAnimationFrame(() => { at.drawn = performance.now() - begun; })); } \
      if (isNew && !at.converged && seen.status === 'converged') at.converged = now; \
      if (at.first && at.drawn && at.converged) told(at); else setTimeout(look, 1); }; \
    look(); })";

fn median_and_most(mut times: Vec<f64>) -> String {
    times.sort_by(f64::total_cmp);
    format!("median {:.0} ms, most {:.0} ms", times[times.len() / 2], times[times.len() - 1])
}

fn latencies(page: &mut Page, name: &str) {
    let times: Vec<Value> = (100..120)
        .map(|seed| {
            rested(page);
            page.value(&format!("(() => {{ {TURN} return ({WATCH})({seed}); }})()"))
        })
        .collect();
    for (moment, what) in
        [("first", "first steps in the viewer"), ("drawn", "drawn"), ("converged", "converged in the page")]
    {
        let of = |time: &Value| time[moment].as_f64().unwrap();
        println!("{name}: {what}: {}", median_and_most(times.iter().map(of).collect()));
    }
}

/// From a knob to its picture, for a line of 4096 points and a surface of 256 x 256.
#[test]
#[ignore = "a measurement"]
fn latency() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = opened(&program);
    latencies(&mut page, "line of 4096");
    page.value(&format!("(() => {{ {TURN} turn('domain', 'surface'); }})()"));
    latencies(&mut page, "surface of 256 x 256");
}

/// Resident memory of a process in MB, 0 of one that has gone.
fn resident(process: &str) -> f64 {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    line.map_or(0.0, |line| line.trim().trim_end_matches(" kB").parse::<f64>().unwrap() / 1024.0)
}

/// Memory of server, page and graphics process in MB, after collecting what is dropped.
fn memory(explorer: &Explorer, page: &mut Page) -> [f64; 3] {
    page.chromium.page("HeapProfiler.collectGarbage", json!({}));
    let told = page.chromium.browser("SystemInfo.getProcessInfo", json!({}));
    let of = |kind: &str| {
        let processes = told["processInfo"].as_array().unwrap().iter().filter(|process| process["type"] == kind);
        processes.map(|process| resident(&process["id"].to_string())).sum()
    };
    [resident(&explorer.id().to_string()), of("renderer"), of("GPU")]
}

/// Memory of the server, the page and its graphics in megabytes, printed with what was done until then.
fn told_memory(explorer: &Explorer, page: &mut Page, deeds: &str) -> [f64; 3] {
    let memory = memory(explorer, page);
    let [server, renderer, graphics] = memory.map(f64::round);
    println!("{deeds}: server {server} MB, page {renderer} MB, graphics {graphics} MB");
    memory
}

/// Asserts that the memory of the server has grown by no more than a fifth and 20 MB since the second measurement.
fn assert_settled(measured: &[[f64; 3]]) {
    let (first, last) = (measured[1], measured[measured.len() - 1]);
    assert!(last[0] < 1.2 * first[0] + 20.0, "the server has grown from {} to {} MB", first[0], last[0]);
}

/// The change of a knob that comes at place `at`: mixed controls, some of them slow to solve.
fn knob(at: usize) -> String {
    match at % 10 {
        0 => format!("turn('seed', {at})"),
        1 => format!("turn('load', {})", -3.0 + (at % 37) as f64 / 10.0),
        2 => format!("turn('hurst', {})", 0.3 + (at % 7) as f64 / 10.0),
        3 => format!("turn('roughness', {})", 0.0002 * (1 + at % 11) as f64),
        4 => "turn('solver', 'gfmd')".into(),
        5 => format!("turn('damping', {})", -(((at / 10) % 10) as f64) / 10.0),
        6 => "turn('solver', 'multilevel')".into(),
        7 => format!("turn('body', '{}')", ["round", "sine", "flat"][(at / 10) % 3]),
        8 => format!("turn('rolloff', {})", 1 + at % 9),
        _ => format!("turn('domain', '{}')", ["surface", "line"][(at / 10) % 2]),
    }
}

/// 500 knobs in a row: the end is that of the last one, and memory stays.
#[test]
#[ignore = "a measurement"]
fn soak() {
    let Some(program) = installed() else { return };
    let (explorer, mut page) = opened(&program);
    let mut measured = Vec::new();
    for at in 0..500 {
        page.value(&format!("(() => {{ {TURN} {}; }})()", knob(at)));
        if at % 5 == 4 {
            std::thread::sleep(std::time::Duration::from_millis(150)); // some solves come to their pictures, some do not
        }
        if at % 50 == 49 {
            rested(&mut page);
            let state = explorer.state();
            assert_eq!(page.text("shownRun"), state["run"]["id"].as_str().unwrap());
            assert_eq!(page.value("document.getElementById('fault').hidden"), true);
            measured.push(told_memory(&explorer, &mut page, &format!("{} knobs", at + 1)));
        }
    }
    assert_settled(&measured);
}

/// Presses the contact for some seconds to another gap at each frame, as a hand does; tells pictures of contacts and frames a second.
const PRESS: &str = "async (seconds) => { takeGrip('press'); const gap = section.mean_gap; const seen = document.body.dataset; \
    let [frames, pictures, shown] = [0, 0, seen.held]; const begun = performance.now(); let now = begun; \
    for (; now < begun + 1000 * seconds; now = performance.now()) { press(gap * (1 - 0.4 * Math.sin((now - begun) / 700))); \
      await new Promise(requestAnimationFrame); frames += 1; if (seen.held !== shown) { pictures += 1; shown = seen.held; } } \
    letGo(); return [pictures, frames].map((it) => 1000 * it / (now - begun)); }";

/// How fast the contact under the hand follows, of a line with and without the stress below, of a surface on its map and in space.
#[test]
#[ignore = "a measurement"]
fn rate() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = opened_in(Chromium::start(&program), "&view=picture");
    for (domain, points) in [("line", 1024), ("line", 4096), ("line", 16384), ("surface", 128), ("surface", 256)] {
        page.value(&format!(
            "(() => {{ {TURN} turn('domain', '{domain}'); turn('points', {}); }})()",
            f64::from(points).log2()
        ));
        rested(&mut page);
        page.value("byId('fringes').checked = false; byId('map-pressure').click()");
        let other = if domain == "line" {
            ("stress below", "byId('fringes').checked = true")
        } else {
            ("in space", "byId('map-solid').click()")
        };
        for (name, manner) in [("plain", ""), other] {
            page.value(manner);
            let rates = page.value(&format!("({PRESS})(5)"));
            println!("{domain} of {points}, {name}: {rates} pictures and frames a second");
            assert!((0..2).all(|i| rates[i].as_f64().unwrap() > 0.0), "the contact did not follow the hand");
            rested(&mut page);
        }
    }
}

/// A drag of the rigid surface, or of a point of its profile, by the pointer.
fn drag(page: &mut Page, at: usize) {
    let id = if at % 5 == 4 { "bend" } else { "press" };
    if id == "bend" {
        page.value(&format!("moveHandle({})", (at % 17) as f64 / 17.0));
    }
    let [x, y, width, height] = page.place(id);
    let (x, y) = (x + width / 2.0, y + height / 2.0);
    let far = ((at * 7) % 23) as f64 - 11.0;
    page.mouse("mousePressed", [x, y]);
    (1..=5).for_each(|part| page.mouse("mouseMoved", [x, y + far * f64::from(part) / 5.0]));
    page.mouse("mouseReleased", [x, y + far]);
}

/// 500 drags in a row: the page goes on, and memory stays.
#[test]
#[ignore = "a measurement"]
fn soak_of_drags() {
    let Some(program) = installed() else { return };
    let (explorer, mut page) = opened(&program);
    let mut measured = Vec::new();
    for at in 0..500 {
        drag(&mut page, at);
        if at % 25 == 24 {
            page.value("unbend(); knobs.load = 0.05; show(); changed()");
        }
        if at % 50 == 49 {
            rested(&mut page);
            assert_eq!(page.value("document.getElementById('fault').hidden"), true);
            measured.push(told_memory(&explorer, &mut page, &format!("{} drags", at + 1)));
        }
    }
    assert_settled(&measured);
}
