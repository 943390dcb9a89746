//! The module of the page, which runs in Node as in a browser, against the native library. Without Node the tests pass and say that they are
//! skipped. `MODULE` names another module than that of the page: `browser/build --check` names what it has built.

use crate::explore::said;
use asperity::explore::{Answer, Request, Session, Start, Stock};
use asperity::formats::Scan;
use asperity::surface::Field;
use base64::prelude::{BASE64_STANDARD, Engine};
use ndarray::Array1;
use ndarray_npy::NpzReader;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use serde_json::{Value, json};
use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The tolerance of solves that are compared: far below that of the page, so that what differs is rounding. With the tolerance of the page, one of
/// two solves may stop an iteration before the other.
const TOLERANCE: f64 = 1e-14;
/// Largest difference between numbers and pressures of the module and native ones.
const DIFFERENCE: f64 = 1e-12;
/// The same for any settings. Long lines on thick layers, steep bodies and load steps that follow each other make more of the rounding.
const DIFFERENCE_OF_ANY: f64 = 1e-10;
/// The state that is a history of load steps.
const YIELDING: &str = "a solid that yields below its surface";
/// How many of the random settings differ by less than [`DIFFERENCE`].
const MOST: usize = 44;

/// A request: method, path below `/api/` or `save/`, and body.
type Asked = (&'static str, String, Value);

/// The answers of the module to requests: status, text, and the latest news; none without Node.
fn answers(asked: &[Asked]) -> Option<Vec<(u16, String, Value)>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let module = std::env::var_os("MODULE").map_or_else(|| root.join("assets/explore/module.wasm.gz"), PathBuf::from);
    let node = Command::new("node")
        .arg(root.join("tests/page/module/answers.mjs"))
        .arg(module)
        .arg(root.join("assets/explore/worker.js"))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn();
    let Ok(mut node) = node else {
        writeln!(std::io::stderr(), "skipped: there is no Node for the module").ok();
        return None;
    };
    node.stdin.take().unwrap().write_all(&serde_json::to_vec(asked).unwrap()).unwrap();
    let output = node.wait_with_output().unwrap();
    assert!(output.status.success());
    Some(serde_json::from_slice(&output.stdout).unwrap())
}

/// The native answer to a request.
fn native(session: &Session, (method, path, body): &Asked) -> (u16, Vec<u8>) {
    let (path, query) = path.split_once('?').unwrap_or((path, ""));
    let path = if path.starts_with("save/") { format!("/{path}") } else { format!("/api/{path}") };
    let body = match body {
        Value::String(text) => text.clone().into_bytes(),
        other => BASE64_STANDARD.decode(other["base64"].as_str().unwrap_or_default()).unwrap(),
    };
    let answer = session.answer(&Request { method, path: &path, query, body: &body });
    session.work_once();
    match answer {
        Answer::Json(bytes) | Answer::Download(_, bytes) => (200, bytes),
        Answer::Refused(status, refusal) => (status, refusal.to_json()),
    }
}

/// The state of the knobs with changes.
fn knobs(start: Start, changes: Value) -> Value {
    let mut knobs = serde_json::to_value(start.knobs()).unwrap();
    knobs["stop"]["tolerance"] = json!(TOLERANCE);
    for (name, value) in changes.as_object().unwrap() {
        knobs[name] = value.clone();
    }
    knobs
}

fn order(knobs: &Value) -> Asked {
    ("POST", "solve".into(), knobs.to_string().into())
}

/// The numbers that are held against native ones, each over its own size, but for the mean gap, which is over the rms height: near full
/// contact it is a small difference of large numbers.
const NUMBERS: [&str; 9] = [
    "relative_area",
    "relative_area_counted",
    "kappa",
    "kappa_r",
    "reduced_pressure",
    "max_pressure_over_modulus",
    "rms_gradient_contact",
    "patches",
    "mean_gap_over_rms_height",
];

/// The largest difference of numbers.
fn difference(one: &Value, other: &Value) -> f64 {
    let apart = |name: &str| {
        // both leave out what has no meaning
        if one[name].is_null() && other[name].is_null() {
            return 0.0;
        }
        let [a, b] = [one, other].map(|numbers| numbers[name].as_f64().unwrap_or_else(|| panic!("no {name}")));
        let size = if name == "mean_gap_over_rms_height" { 1.0 } else { a.abs().max(b.abs()) };
        if a == b { 0.0 } else { (a - b).abs() / size }
    };
    NUMBERS.iter().map(|name| apart(name)).fold(0.0, f64::max)
}

/// The pressure in an archive.
fn pressure(npz: &[u8]) -> Vec<f64> {
    let mut archive = NpzReader::new(Cursor::new(npz)).unwrap();
    let name = archive.names().unwrap().into_iter().find(|name| name.starts_with("pressure")).unwrap();
    let flat: Result<Array1<f64>, _> = archive.by_name(&name);
    flat.map_or_else(
        |_| archive.by_name::<ndarray::OwnedRepr<f64>, ndarray::Ix2>(&name).unwrap().into_iter().collect(),
        |line| line.to_vec(),
    )
}

/// Solves states with the module and natively, and returns for each the largest difference of numbers and pressures.
fn differences(states: &[Value], before: &[Asked]) -> Option<Vec<[f64; 2]>> {
    let solves = states
        .iter()
        .enumerate()
        .flat_map(|(i, state)| [order(state), ("GET", format!("save/run-{}.npz", i + 1), "".into())]);
    let asked: Vec<Asked> = before.iter().cloned().chain(solves).collect();
    let found = answers(&asked)?;
    let session = Session::new(Stock::default(), 0);
    let mut differences = Vec::new();
    for (i, asked) in asked.iter().enumerate() {
        let ((status, bytes), (its_status, its_text, _)) = (native(&session, asked), &found[i]);
        assert_eq!((status, 200), (*its_status, status), "{asked:?}: {its_text}");
        if asked.1 != "solve" {
            if asked.1.starts_with("save/") {
                let [own, its] = [bytes, BASE64_STANDARD.decode(its_text).unwrap()].map(|npz| pressure(&npz));
                let most = own.iter().fold(0.0, |most: f64, p| most.max(*p));
                let apart = own.iter().zip(&its).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / most;
                assert_eq!(own.len(), its.len());
                differences.last_mut().map(|it: &mut [f64; 2]| it[1] = apart).unwrap();
            }
            continue;
        }
        let own = serde_json::to_value(session.report()).unwrap();
        let [own, its] = [&own, &found[i].2].map(|report| {
            assert_eq!(report["fault"], Value::Null, "{asked:?}");
            &report["run"]["numbers"]
        });
        differences.push([difference(own, its), 0.0]);
    }
    Some(differences)
}

/// A map of heights at odd positions, as a text.
fn map() -> String {
    let height = |y: usize, x: usize| (0.7 * x as f64).sin() * (0.4 * y as f64).cos() + 0.1 * ((x * y) as f64).sin();
    let row = |y: usize| (0..48).map(|x| format!("{:.6e}", 1e-7 * height(y, x))).collect::<Vec<_>>().join("\t");
    (0..40).map(row).collect::<Vec<_>>().join("\n")
}

#[test]
fn the_module_solves_as_the_native_library_does() {
    let file: Asked = ("POST", "heights?name=map.txt".into(), map().into());
    let heights = json!({"body": "file", "domain": "surface", "heights": {"width": 48e-6, "boundary": "free"}});
    let states = [
        ("a sine", knobs(Start::RoughLine, json!({"body": "sine", "roughness": 0.0}))),
        ("a rough line", knobs(Start::RoughLine, json!({}))),
        ("a rough surface", knobs(Start::RoughSurface, json!({"points": 128, "cutoff": 16.0}))),
        ("a layer", knobs(Start::RoughLine, json!({"layer": 0.05}))),
        (
            "a surface that slides",
            knobs(Start::RoughLine, json!({"creep": 9.0, "speed": 0.02, "points": 1024, "cutoff": 64.0})),
        ),
        (
            "a solid that creeps",
            knobs(Start::RoughLine, json!({"creep": 9.0, "time": 1.0, "points": 1024, "cutoff": 64.0})),
        ),
        (YIELDING, knobs(Start::HertzLine, json!({"yield-stress": 2e-4, "points": 256}))),
        ("a hardness", knobs(Start::RoughLine, json!({"hardness": 5e-4}))),
        ("a free boundary", knobs(Start::RoughSurface, heights)),
        ("GFMD", knobs(Start::RoughLine, json!({"solver": {"method": "gfmd"}, "points": 512, "cutoff": 64.0}))),
    ];
    let (names, states): (Vec<_>, Vec<_>) = states.into_iter().unzip();
    let Some(found) = differences(&states, &[file]) else { return };
    for (name, [numbers, pressures]) in names.iter().zip(found) {
        println!("{name}: numbers differ by {numbers:.1e}, pressures by {pressures:.1e}");
        let most = if *name == YIELDING { DIFFERENCE_OF_ANY } else { DIFFERENCE };
        assert!(numbers <= most && pressures <= most, "{name}: {numbers:.1e} {pressures:.1e}");
    }
}

/// A state of the knobs as a person may turn them.
fn any_state(random: &mut ChaCha8Rng) -> Value {
    let is_line = random.random_bool(0.7);
    let points = if is_line { 1 << random.random_range(7..14) } else { 1 << random.random_range(5..8) };
    let body = ["flat", "round", "sine", "power-law"][random.random_range(0..4)];
    let is_rough = body == "flat" || random.random_bool(0.5);
    let start = if is_line { Start::RoughLine } else { Start::RoughSurface };
    knobs(
        start,
        json!({
            "body": body,
            "points": points,
            "cutoff": (points / 8) as f64,
            "rolloff": 2.0,
            "roughness": if is_rough { 1e-3 } else { 0.0 },
            "hurst": random.random_range(0.2..1.0),
            "seed": random.random_range(0..1_000_000),
            "load": 10f64.powf(random.random_range(-2.5..0.3)),
            "layer": if random.random_bool(0.3) { random.random_range(0.02..0.5) } else { 0.0 },
            "solver": {"method": if random.random_bool(0.7) { "multilevel" } else { "polonsky-keer" }},
        }),
    )
}

#[test]
fn random_settings_of_the_knobs_give_the_native_numbers() {
    let mut random = ChaCha8Rng::seed_from_u64(33);
    let states: Vec<Value> = (0..50).map(|_| any_state(&mut random)).collect();
    let Some(found) = differences(&states, &[]) else { return };
    let largest: Vec<f64> = found.iter().map(|[numbers, pressures]| numbers.max(*pressures)).collect();
    let within = largest.iter().filter(|it| **it <= DIFFERENCE).count();
    let worst = largest.iter().copied().fold(0.0, f64::max);
    println!("50 settings: {within} differ by at most {DIFFERENCE:e}, all by at most {worst:.1e}");
    assert!(within >= MOST && worst <= DIFFERENCE_OF_ANY, "{largest:?}");
}

#[test]
fn the_module_answers_what_a_session_answers() {
    let rough = knobs(
        Start::RoughLine,
        json!({"points": 256, "cutoff": 32.0, "stop": {"tolerance": 1e-8, "max-iterations": 20000}}),
    );
    let asked: Vec<Asked> = vec![
        order(&rough),
        ("GET", "run/run-1/section".into(), "".into()),
        ("GET", "run/run-1/patches".into(), "".into()),
        ("GET", "run/run-1/shear".into(), "".into()),
        ("GET", "run/run-1/why".into(), "".into()),
        ("POST", "hold".into(), json!({"knobs": rough, "mean-gap": null, "is-deep": true}).to_string().into()),
        ("POST", "sweep".into(), rough.to_string().into()),
        ("GET", "runs".into(), "".into()),
        ("POST", "solve".into(), knobs(Start::RoughLine, json!({"load": -1.0})).to_string().into()),
        ("POST", "solve".into(), "{".into()),
        ("POST", "heights?name=prose.txt".into(), "no numbers".into()),
        ("POST", "heights?name=prose.x3p".into(), json!({"base64": "UEsDBAoAAAA="})),
        ("POST", "describe".into(), "{}".into()),
        ("GET", "nothing".into(), "".into()),
        ("POST", "state".into(), "".into()),
    ];
    let Some(found) = answers(&asked) else { return };
    let session = Session::new(Stock::default(), 0);
    for (asked, (its_status, its_text, _)) in asked.iter().zip(found) {
        let (status, bytes) = native(&session, asked);
        assert_eq!(status, its_status, "{asked:?}: {its_text}");
        let text = String::from_utf8(bytes).unwrap();
        if status != 200 {
            assert_eq!(text, its_text, "{asked:?}");
        } else {
            // rounding, and times, change digits and not what is there
            let [own, its]: [Value; 2] = [&text, &its_text].map(|json| serde_json::from_str(json).unwrap());
            assert_eq!(shape(&own), shape(&its), "{asked:?}");
        }
    }
}

/// The names in a value, and the kinds of what they stand for.
fn shape(value: &Value) -> Value {
    match value {
        Value::Object(map) => map.iter().map(|(name, it)| (name.clone(), shape(it))).collect(),
        Value::Array(list) => json!([list.len(), list.first().map(shape)]),
        Value::Number(_) => json!(0),
        other => other.clone(),
    }
}

/// What is too large for a browser is refused by the module alone.
#[test]
fn the_module_has_limits_of_its_own() {
    let large = knobs(Start::RoughLine, json!({"points": 131072}));
    let Some(found) = answers(&[order(&large)]) else { return };
    let (status, refusal, _) = &found[0];
    let refusal: Value = serde_json::from_str(refusal).unwrap();
    assert_eq!(
        (*status, said(&refusal["sentence"]).as_str()),
        (400, "`points` cannot be 131072: give a whole number from 4 to 65536")
    );
    assert_eq!(native(&Session::new(Stock::default(), 0), &order(&large)).0, 200);
}

/// A measured map of 576 x 768 heights is too large for a browser, the more so with mirror images: the part that is kept automatically can be
/// solved, and is about as large as it can be.
#[test]
fn a_large_map_is_cut_to_what_a_browser_solves() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("map.sdf");
    // waves that fit the map along neither axis
    let height = |(y, x): (usize, usize)| 1e-6 * ((0.071 * x as f64).sin() + (0.043 * (x + 2 * y) as f64).cos());
    let scan = Scan { height: Field::from_shape_fn((576, 768), height), spacing: [1.66e-6; 2] };
    scan.write(&file).unwrap();
    let bytes = std::fs::read(&file).unwrap();
    let open: Asked = ("POST", "heights?name=map.sdf".into(), json!({"base64": BASE64_STANDARD.encode(bytes)}));
    let Some(found) = answers(&[open]) else { return };
    let told: Value = serde_json::from_str(&found[0].1).unwrap();
    assert_eq!(told["fault"], Value::Null);
    let crop: Vec<usize> = serde_json::from_value(told["knobs"]["prepare"]["crop"].clone()).unwrap();
    let points = (crop[1] - crop[0]) * (crop[3] - crop[2]);
    assert_eq!(told["knobs"]["prepare"]["mirror"], "both");
    assert!(points.abs_diff(1 << 16) < 1000, "{points} points, of which mirror images make four times as many");
}
