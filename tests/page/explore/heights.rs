//! Files of heights that are dropped on the page.

use super::{Answer, Page, said, with};
use asperity::setup::Setup;
use assert_cmd::Command;
use ndarray::{Array1, Array2};
use ndarray_npy::WriteNpyExt;
use serde_json::{Value, json};
use std::io::{Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

/// What a page says of the bytes that it sends.
const KIND: &str = "Content-Type: application/octet-stream\r\n";

impl Page {
    fn head(&self, path: &str, headers: &str, length: usize) -> String {
        format!(
            "POST {} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: close\r\nContent-Length: {length}\r\n{}{headers}\r\n",
            self.full(path),
            self.port,
            self.cookie()
        )
    }

    fn drop_with(&self, headers: &str, name: &str, file: &[u8]) -> Answer {
        let head = self.head(&format!("/api/heights?name={name}"), headers, file.len());
        self.send(&[head.as_bytes(), file].concat())
    }

    /// Drops a file on the page.
    fn drop_file(&self, name: &str, file: &[u8]) -> Answer {
        self.drop_with(KIND, name, file)
    }

    /// Drops a file that can be read.
    fn describe(&self, name: &str, file: &[u8]) -> Value {
        let answer = self.drop_file(name, file);
        assert_eq!(answer.status, 200, "{}", answer.text());
        answer.json()
    }

    /// Solves the file that was dropped, as knobs take it.
    fn press(&self, heights: &Value) -> Value {
        self.solve(&with(json!({"body": "file", "heights": heights, "record": ["traces", "fields"]})))
    }
}

/// Heights that jump across the period: a tilt and a few waves.
fn height(y: usize, x: usize) -> f64 {
    let (y, x) = (y as f64, x as f64);
    1e-9 * (40.0 * (0.3 * y).sin() * (0.2 * x).cos() + 7.0 * (1.1 * x + 0.4 * y).sin() + 3.0 * x)
}

fn npy(shape: (usize, usize), height: impl Fn(usize, usize) -> f64) -> Vec<u8> {
    let mut file = Vec::new();
    Array2::from_shape_fn(shape, |(y, x)| height(y, x)).write_npy(&mut file).unwrap();
    file
}

/// A matrix in text that says its channel, size and unit, with a void.
fn matrix() -> Vec<u8> {
    let mut text = "# Channel: Topography\n# Width: 4.8 µm\n# Height: 3.2 µm\n# Value units: nm\n".to_owned();
    for y in 0..32 {
        let value = |x: usize| if [y, x] == [5, 7] { "nan".into() } else { format!("{:.6}", 1e9 * height(y, x)) };
        text += &((0..48).map(value).collect::<Vec<_>>().join("\t") + "\n");
    }
    text.into_bytes()
}

/// A profile in text of positions and heights.
fn profile() -> Vec<u8> {
    let line = |i: usize| format!("{:.9e} {:.9e}\n", 1e-7 * i as f64, height(0, i));
    (0..200).map(line).collect::<String>().into_bytes()
}

fn row(description: &Value, name: &str) -> String {
    let rows = description["rows"].as_array().unwrap();
    let found = rows.iter().find(|row| row[0] == name).unwrap_or_else(|| panic!("no {name} in {rows:?}"));
    said(&found[1])
}

/// Asserts that the command line gives the numbers of a run from its setup and the file beside it.
fn assert_repeated(run: &Value, name: &str, file: &[u8]) {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.toml");
    std::fs::write(&scene, run["setup"].as_str().unwrap()).unwrap();
    std::fs::write(folder.path().join(name), file).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_asperity")).arg("solve").arg(&scene).arg("--json").output().unwrap();
    assert!(output.status.success(), "{}: {}", run["setup"], String::from_utf8_lossy(&output.stderr));
    let repeated: Value = serde_json::from_slice(&output.stdout).unwrap();
    for number in ["kappa_r", "relative_area", "certificate", "iterations"] {
        assert_eq!(run["numbers"][number], repeated[number], "{number} of {}", run["setup"]);
    }
}

/// The pressure that is saved of a run, whose rank must be that of the file.
fn pressure<D: ndarray::Dimension>(page: &Page, run: &Value) -> ndarray::Array<f64, D> {
    let arrays = page.get(&format!("/save/{}.npz", run["id"].as_str().unwrap()));
    let mut npz = ndarray_npy::NpzReader::new(std::io::Cursor::new(arrays.body)).unwrap();
    npz.by_name("pressure").unwrap()
}

#[test]
fn a_map_in_text_is_described_prepared_and_solved() {
    let page = Page::open();
    assert_eq!(page.get("/api/heights").json(), Value::Null);
    let told = page.describe("sample%201.txt", &matrix());
    assert_eq!(
        (&told["name"], &told["is_profile"], &told["fault"]),
        (&json!("sample 1.txt"), &json!(false), &Value::Null)
    );
    assert_eq!((row(&told, "points"), row(&told, "size")), ("32 x 48".into(), "3.2 µm x 4.8 µm".into()));
    assert_eq!(
        (row(&told, "channel"), row(&told, "lengths")),
        ("Topography".into(), "metres, as given in the file".into())
    );
    assert_eq!(row(&told, "voids"), "1 of 1536 heights");
    let prepare = &told["knobs"]["prepare"];
    assert_eq!((&prepare["fill"], prepare["mirror"].is_string()), (&json!("harmonic"), true), "{prepare}");
    assert!(said(&told["reasons"][0]).starts_with("1 of 1536 heights (0.1 %) are void"), "{}", told["reasons"]);
    assert_eq!(page.get("/api/heights").json(), told);
    let run = page.press(&told["knobs"]);
    assert_eq!(run["numbers"]["status"], "converged");
    assert_eq!(said(&run["prepared"][0]), "1 voids filled with the smoothest heights");
    assert_eq!(run["prepared"].as_array().unwrap().len(), prepare.as_object().unwrap().len());
    assert_eq!(
        (&run["title"], &run["file_stem"]),
        (&json!("sample 1, p* = 0.05"), &json!("sample-1_p0.05_multilevel"))
    );
    assert!(run["command"].as_str().unwrap().starts_with("asperity solve --height 'sample 1.txt' --fill harmonic"));
    assert_repeated(&run, "sample 1.txt", &matrix());
    assert!(pressure::<ndarray::Ix2>(&page, &run).iter().all(|p| *p >= 0.0));
}

#[test]
fn a_profile_is_a_line() {
    let page = Page::open();
    let told = page.describe("trace.txt", &profile());
    assert_eq!(
        (&told["is_profile"], &told["has_spacing"], row(&told, "points")),
        (&json!(true), &json!(true), "200".into())
    );
    let mut knobs = told["knobs"].clone();
    let run = page.press(&knobs);
    assert_repeated(&run, "trace.txt", &profile());
    assert!(pressure::<ndarray::Ix1>(&page, &run).len() >= 200);
    knobs["boundary"] = "free".into();
    knobs["prepare"] = json!({});
    let free = page.press(&knobs);
    assert!(free["setup"].as_str().unwrap().contains("boundary = \"free\""), "{}", free["setup"]);
    assert_repeated(&free, "trace.txt", &profile());
}

#[test]
fn an_array_needs_a_width_and_takes_a_unit() {
    let page = Page::open();
    let file = npy((24, 40), |y, x| 1e9 * height(y, x));
    let told = page.describe("h.npy", &file);
    assert_eq!((&told["is_in_metres"], &told["has_spacing"]), (&json!(false), &json!(false)));
    assert!(said(&told["fault"]).contains("no size is given"), "{}", told["fault"]);
    let knobs = json!({"width": "4 um", "unit": "1 nm"});
    let told = page.post("/api/describe", &knobs.to_string()).json();
    assert_eq!(
        (&told["fault"], &told["knobs"]["width"], &told["knobs"]["unit"]),
        (&Value::Null, &json!(4e-6), &json!(1e-9))
    );
    assert_eq!((row(&told, "lengths"), row(&told, "size")), ("1 in the file is 1 nm".into(), "2.4 µm x 4 µm".into()));
    let run = page.press(&told["knobs"]);
    assert_eq!(run["numbers"]["status"], "converged");
    assert_repeated(&run, "h.npy", &file);
}

#[test]
fn heights_that_jump_are_warned_of_and_voids_refused() {
    let page = Page::open();
    let told = page.describe("sample.txt", &matrix());
    let raw = json!({"auto": false, "prepare": {"fill": "harmonic"}});
    let run = page.press(&raw);
    let warnings = run["warnings"].as_array().unwrap();
    assert!(said(&warnings[0]["statement"]).contains("rms steps across the period along x"), "{warnings:?}");
    assert_eq!(warnings[0]["remedies"][0]["key"], "surface.prepare.steps");
    let prepared = page.press(&told["knobs"])["warnings"].to_string();
    assert!(!prepared.contains("across the period"), "{prepared}");
    let knobs = with(json!({"body": "file", "heights": {"auto": false}}));
    page.order("/api/solve", &knobs);
    let state = page.wait(|state| state["busy"] == false && !state["fault"].is_null());
    assert_eq!(said(&state["fault"]), "1 of 1536 heights in sample.txt are void: fill them, or crop the heights");
}

#[test]
fn what_is_too_much_to_wait_for_is_cropped_or_refused() {
    let page = Page::open();
    let file = npy((900, 900), height);
    page.describe("large.npy", &file);
    let told = page.post("/api/describe", "{\"width\": 9e-6}").json();
    let crop: Vec<usize> = serde_json::from_value(told["knobs"]["prepare"]["crop"].clone()).unwrap();
    assert_eq!((crop[0] + crop[1], crop[2] + crop[3]), (900, 900), "{crop:?} is not in the middle");
    assert!(said(&told["reasons"][0]).contains("only the middle part is kept"), "{}", told["reasons"]);
    assert!((2 * (crop[1] - crop[0])) * (crop[3] - crop[2]) <= 1 << 20, "{crop:?}");
    assert_eq!(told["fault"], Value::Null);
    let by_hand = json!({"width": 9e-6, "auto": false, "prepare": {"mirror": "both"}});
    let told = page.post("/api/describe", &by_hand.to_string()).json();
    assert!(said(&told["fault"]).starts_with("1798 x 1798 points are too many here: crop"), "{told}");
    let refused = page.post("/api/solve", &with(json!({"body": "file", "heights": by_hand})).to_string());
    assert_eq!((refused.status, refused.text()), (400, said(&told["fault"]).as_str()));
}

#[test]
fn without_a_file_there_is_none_to_press() {
    let page = Page::open();
    let refused = page.post("/api/solve", &with(json!({"body": "file"})).to_string());
    assert_eq!(
        (refused.status, refused.text()),
        (400, "there is no file of heights: drop one on the page, or open it")
    );
    assert_eq!(page.post("/api/describe", "{}").status, 400);
}

#[test]
fn files_of_anyone_get_a_sentence_and_leave_the_one_before() {
    let page = Page::open();
    let kept = page.describe("kept.txt", &matrix());
    let whole = npy((8, 8), height);
    let with_shape = |shape: &[u8; 6]| {
        let mut file = whole.clone();
        let place = file.windows(6).position(|it| it == b"(8, 8)").unwrap();
        file[place..place + 6].copy_from_slice(shape);
        file
    };
    let hostile: [(&str, &[u8]); 10] = [
        ("empty", b""),
        ("zeros", &[0; 100_000]),
        ("half.npy", &whole[..whole.len() / 2]),
        ("claim.npy", &with_shape(b"(8,99)")),
        ("broken.npy", &with_shape(b"(8(99)")),
        ("bomb.zip", b"PK\x03\x04\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff"),
        ("cut.gwy", b"GWYP\xff\xff\xff\xff\xff\xff\xff\xff"),
        ("cut.sur", b"DIGITAL SURF\0\0\0\0"),
        ("entity.x3p", b"<!DOCTYPE a [<!ENTITY b SYSTEM 'file:///etc/passwd'>]><a>&b;</a>"),
        ("prose.txt", "no numbers at all, <script>alert(1)</script>".as_bytes()),
    ];
    for (name, file) in hostile {
        let answer = page.drop_file(name, file);
        assert_eq!(answer.status, 400, "{name}: {}", answer.text());
        assert!(answer.text().starts_with(name) && answer.text().lines().count() == 1, "{}", answer.text());
        assert!(answer.headers.contains("content-type: application/json"), "{}", answer.headers);
    }
    assert_eq!(page.get("/api/heights").json(), kept);
    for knobs in [
        "",
        "null",
        "{\"path\": \"/etc/passwd\"}",
        "{\"channel\": \"none\"}",
        "{\"prepare\": {\"crop\": [-1]}}",
        "{\"width\": \"wide\"}",
        "{\"width\": -1.0}",
        "{\"unit\": 0}",
        "{\"prepare\": {\"low-pass\": -1e-9}}",
    ] {
        assert_eq!(page.post("/api/describe", knobs).status, 400, "{knobs}");
    }
    for knobs in [json!({"auto": false, "prepare": {"crop": [30, 99, 0, 9]}}), json!({"unit": 2})] {
        let told = page.post("/api/describe", &knobs.to_string());
        assert_eq!(told.status, 200, "{knobs}: {}", told.text());
        assert!(!told.json()["fault"].is_null(), "{knobs}: {}", told.json());
    }
}

#[test]
fn only_the_page_may_drop_a_file() {
    let page = Page::open();
    for headers in [
        "Content-Type: text/plain\r\n",
        "Content-Type: application/json\r\n",
        "Content-Type: multipart/form-data\r\n",
        "",
    ] {
        assert_eq!(page.drop_with(headers, "h.txt", &matrix()).status, 415, "{headers}");
    }
    for foreign in ["Origin: http://example.com", "Origin: null", "Sec-Fetch-Site: cross-site"] {
        assert_eq!(page.drop_with(&format!("{foreign}\r\n{KIND}"), "h.txt", &matrix()).status, 403, "{foreign}");
    }
    for path in ["/api/solve", "/api/describe", "/api/pin", "/api/heights/"] {
        assert_eq!(page.ask("POST", path, KIND, "{}").status, 415, "{path}");
    }
    assert_eq!(page.get("/api/describe").status, 405);
    assert_eq!(page.ask("PUT", "/api/heights", KIND, "1 2 3").status, 405);
    assert_eq!(page.get("/api/heights").json(), Value::Null);
}

#[test]
fn a_file_is_bounded_and_one_comes_at_a_time() {
    let page = Page::open();
    let head = page.head("/api/heights?name=huge", KIND, (1 << 26) + 1);
    assert_eq!(page.send(head.as_bytes()).status, 413);
    let chunked = page.head("/api/heights", KIND, 0).replace("Content-Length: 0", "Transfer-Encoding: chunked");
    let mut stream = TcpStream::connect(("127.0.0.1", page.port)).unwrap();
    stream.write_all(chunked.as_bytes()).unwrap();
    let chunk = [b"100000\r\n".as_slice(), &[b'1'; 1 << 20], b"\r\n"].concat();
    // the buffers of the system take up to 36 MiB more than the 64 MiB that the server reads, and other systems more
    let sent = (0..256).take_while(|_| stream.write_all(&chunk).is_ok()).count();
    assert!(sent < 256, "256 MiB were taken");
    let deadline = Instant::now() + Duration::from_secs(60);
    let in_time = || assert!(Instant::now() < deadline, "the right to send a file never changed hands");
    // the file that comes second may be taken first
    let begun = loop {
        let mut begun = TcpStream::connect(("127.0.0.1", page.port)).unwrap();
        begun.write_all(page.head("/api/heights?name=slow", KIND, 1000).as_bytes()).unwrap();
        match page.drop_file("h.txt", &matrix()).status {
            503 => break begun,
            status => assert_eq!(status, 200),
        }
        in_time();
    };
    let large = "1 2\n".repeat(1 << 20);
    assert_eq!(page.drop_file("large.txt", large.as_bytes()).status, 503, "what is refused is read to its end");
    assert_eq!(page.get("/api/state").status, 200);
    drop(begun);
    while page.drop_file("h.txt", &matrix()).status != 200 {
        in_time();
    }
}

#[test]
fn names_are_text_and_nothing_else() {
    let page = Page::open();
    let name = "a'; rm -rf b \"$HOME\" <img src=x>.txt";
    let encoded: String = name.bytes().map(|byte| format!("%{byte:02x}")).collect();
    let told = page.describe(&format!("..%2f..%5c{encoded}"), &matrix());
    assert_eq!(told["name"], name);
    let run = page.press(&told["knobs"]);
    let quoted = r#"--height 'a'\''; rm -rf b "$HOME" <img src=x>.txt'"#;
    assert!(run["command"].as_str().unwrap().contains(quoted), "{}", run["command"]);
    let saved = page.get(&format!("/save/{}.rrd", run["id"].as_str().unwrap()));
    assert!(
        saved.headers.contains("filename=\"a---rm--rf-b---home---img-src-x-_p0.05_multilevel.rrd\""),
        "{}",
        saved.headers
    );
    let setup = Setup::from_toml(run["setup"].as_str().unwrap()).unwrap();
    assert_eq!(setup.surface.height.unwrap().path().to_str(), Some(name));
}

#[test]
fn knobs_of_another_file_are_refused() {
    let page = Page::open();
    let first = page.describe("first.txt", &matrix());
    page.describe("second.txt", &profile());
    let order = with(json!({"body": "file", "heights": first["knobs"]})).to_string();
    for (path, body) in [("/api/solve", order), ("/api/describe", first["knobs"].to_string())] {
        let refused = page.post(path, &body);
        assert_eq!(refused.status, 400, "{path}");
        assert!(refused.text().starts_with("this file was replaced by another file, second.txt"), "{}", refused.text());
    }
    let third = page.describe("third.txt", &matrix());
    assert_eq!(third["knobs"], first["knobs"]);
}

/// The command starts with a file as if it were dropped, and refuses one that it cannot read.
#[cfg(unix)]
#[test]
fn the_command_starts_with_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ramp.npy");
    let mut file = Vec::new();
    Array1::from_shape_fn(64, |i| 1e-9 * (i as f64).sin()).write_npy(&mut file).unwrap();
    std::fs::write(&path, file).unwrap();
    let explore = |path: &std::path::Path| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_asperity"));
        command.args(["explore", "--no-open", "--port", "0", "--height"]).arg(path);
        command.stdout(std::process::Stdio::piped()).stderr(std::process::Stdio::piped());
        command
    };
    let refused = explore(&folder.path().join("none.npy")).output().unwrap();
    assert!(!refused.status.success() && String::from_utf8_lossy(&refused.stderr).contains("none.npy"));
    let mut child = explore(&path).spawn().unwrap();
    let mut said = [0; 256];
    let read = child.stdout.take().unwrap().read(&mut said).unwrap();
    let said = String::from_utf8_lossy(&said[..read]).into_owned();
    let page = Page::at(&said);
    let told = page.get("/api/heights").json();
    assert_eq!((told["name"].as_str(), &told["is_profile"]), (path.to_str(), &json!(true)));
    child.kill().unwrap();
    child.wait().unwrap();
}
