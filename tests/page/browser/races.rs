//! Watching a solver converge: its steps, a race with another solver, and a cure that is tried.

use super::chromium::installed;
use super::explorer::{rested, sketched};
use super::page::Page;
use serde_json::{Value, json};

const TOLD: &str = "[...document.querySelectorAll('.race-lane p')].map((it) => it.innerText)";
const LANES: &str = "[...document.querySelectorAll('.race-lane h3')].map((it) => it.innerText)";

/// Chooses whom the run races with, and waits for the lanes.
fn race_with(page: &mut Page, rival: &str) {
    page.value(&format!("byId('race-rival').value = '{rival}', byId('race-rival').dispatchEvent(new Event('change'))"));
    page.until("document.querySelectorAll('.race-lane').length === 2");
}

/// The work after which each lane first had a certificate on the grid of the run, from the numbers of their steps.
fn work_for(page: &mut Page, run: &str, goal: f64) -> Value {
    page.value(&format!(
        "ask('run/{run}/steps').then(({{ certificate, level, transforms }}) => \
         transforms[certificate.findIndex((it, i) => level[i] === 0 && it !== null && it <= {goal})])"
    ))
}

/// One run step by step: from its first step, one state on, to its end.
fn a_run_is_watched(page: &mut Page) {
    page.click("watch");
    page.until("document.body.dataset.race === latest().id");
    assert_eq!(page.value(LANES), json!(["GFMD (uniform masses)"]));
    page.press_at("race-scrub", "Home");
    page.until("document.querySelector('.race-lane p').innerText.startsWith('Step ')");
    let first = page.value(TOLD);
    // from the beginning to the first step, and to the next one
    page.click("race-on");
    page.click("race-on");
    page.until(&format!("JSON.stringify({TOLD}) !== {}", json!(first.to_string())));
    page.press_at("race-scrub", "End");
    page.until("document.querySelector('.race-lane p').innerText.startsWith('Ended (converged)')");
    let kappa = page.value("document.querySelector('.race-lane p').innerText.split('κ_r ')[1]");
    let kappa: f64 = kappa.as_str().unwrap().parse().unwrap();
    assert!((kappa / page.value("latest().numbers.kappa_r").as_f64().unwrap() - 1.0).abs() < 5e-3);
}

/// Another solver on the same contact: the knobs and what the page shows stay those of the first run.
fn two_solvers_race(page: &mut Page) {
    let before = page.value("[words(knobs), document.body.dataset.run, byId('title').innerText]");
    let first = page.text("shownOrLatest().id");
    race_with(page, "multilevel");
    assert_eq!(page.value(LANES), json!(["GFMD (uniform masses)", "Multilevel"]));
    assert_eq!(page.value("[words(knobs), document.body.dataset.run, byId('title').innerText]"), before);
    assert_eq!(page.value("isWhole"), true);
    let second = page.text("document.body.dataset.race.split(' ')[1]");
    let rows =
        page.value("[...byId('race-goals').tBodies[0].rows].map((row) => [...row.cells].map((it) => it.innerText))");
    for row in rows.as_array().unwrap() {
        let cell = |i: usize| row[i].as_str().unwrap().parse::<f64>().unwrap();
        for (i, run) in [&first, &second].into_iter().enumerate() {
            assert_eq!(work_for(page, run, cell(0)).as_f64(), Some(cell(i + 1)), "{row} of {run}");
        }
        assert!(cell(2) < cell(1), "multilevel needs less work: {row}");
    }
    assert!(rows.as_array().unwrap().len() >= 3, "{rows}");
    let verdict = page.text("byId('race-verdict').innerText");
    assert!(verdict.starts_with("Multilevel had a certificate of "), "{verdict}");
    page.press("Escape");
    page.until("!byId('race-dialog').open");
    assert_eq!(page.value("isWhole"), true);
}

/// What held the run up is told with a cure, which changes the knobs and races with the run before.
fn a_cure_is_tried(page: &mut Page) {
    page.value("byId('why').click()");
    page.until("document.body.dataset.why === shownOrLatest().id");
    let cure = "#why-causes .race-cure";
    assert_eq!(page.text(&format!("document.querySelector('{cure}').innerText")), "Try it: masses ∝ stiffness");
    page.value(&format!("document.querySelector('{cure}').click()"));
    page.until("document.querySelectorAll('.race-lane').length === 2");
    assert_eq!(page.value(LANES), json!(["GFMD (uniform masses)", "GFMD (masses ∝ stiffness)"]));
    assert_eq!(
        page.value("[knobs.solver.masses, shownOrLatest().knobs.solver.masses]"),
        json!(["stiffness", "stiffness"])
    );
    let verdict = page.text("byId('race-verdict').innerText");
    assert!(verdict.starts_with("GFMD (") && verdict.contains(" had a certificate of "), "{verdict}");
    page.press("Escape");
    rested(page);
}

#[test]
fn convergence_is_watched() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = sketched(&program, "&view=picture&language=en");
    page.value("Object.assign(knobs, { points: 512, cutoff: 64, solver: { method: 'gfmd', masses: 'uniform', dynamics: 'damped', 'time-step': 0.5, damping: 1 } }), show(), changed()");
    rested(&mut page);
    a_run_is_watched(&mut page);
    two_solvers_race(&mut page);
    a_cure_is_tried(&mut page);
    assert_eq!(page.value("byId('fault').hidden"), true);
}
