//! A page as a person has it: keys, clicks, and what is to be seen.

use super::chromium::Chromium;
use base64::prelude::{BASE64_STANDARD, Engine};
use resvg::tiny_skia::Pixmap;
use serde_json::{Value, json};
use std::time::{Duration, Instant};

/// Keys, their codes and what they type.
const KEYS: &[(&str, u32, &str)] = &[
    ("ArrowDown", 40, ""),
    ("ArrowLeft", 37, ""),
    ("ArrowRight", 39, ""),
    ("ArrowUp", 38, ""),
    ("End", 35, ""),
    ("Enter", 13, "\r"),
    ("Escape", 27, ""),
    ("Home", 36, ""),
    ("Tab", 9, ""),
];

/// How long a state is waited for: no test passes or fails by the time that a busy machine takes.
const PATIENCE: Duration = Duration::from_secs(240);

/// What the page shows, and what its viewer is about.
const SEEN: &str = "({ ...document.body.dataset, text: document.body.innerText.slice(0, 2000), \
    ...(typeof awake === 'object' && viewer && { awake, now: performance.now(), read: read(), shownRun }) })";

/// An expression in which what the page gives to tests, its `asperity`, goes by its own names.
fn within(expression: &str) -> String {
    format!("with (globalThis.asperity ?? {{}}) {{ {expression} }}")
}

/// The share of pixels that differ; all do in pictures of different sizes.
pub fn difference(one: &[[u8; 3]], other: &[[u8; 3]]) -> f64 {
    if one.len() != other.len() {
        return 1.0;
    }
    one.iter().zip(other).filter(|(a, b)| a != b).count() as f64 / one.len() as f64
}

/// A page in a browser of its own.
pub struct Page {
    pub chromium: Chromium,
}

impl Page {
    /// Goes to an address.
    pub fn open(&mut self, address: &str) {
        self.chromium.page("Page.navigate", json!({"url": address}));
        self.until(&format!("location.href === {} && document.readyState === 'complete'", json!(address)));
    }

    /// Follows a link, to a page that may then write its address anew.
    pub fn follow(&mut self, address: &str) {
        self.chromium.page("Page.navigate", json!({"url": address}));
        self.until("document.readyState === 'complete' && typeof byId === 'function'");
    }

    /// The value of an expression in the page, awaited.
    pub fn value(&mut self, expression: &str) -> Value {
        let asked = json!({"expression": within(expression), "returnByValue": true, "awaitPromise": true});
        let answer = self.chromium.page("Runtime.evaluate", asked);
        assert!(answer["exceptionDetails"].is_null(), "{expression}: {}", answer["exceptionDetails"]);
        answer["result"]["value"].clone()
    }

    pub fn text(&mut self, expression: &str) -> String {
        let value = self.value(expression);
        value.as_str().unwrap_or_else(|| panic!("{expression} is {value}")).to_owned()
    }

    /// Waits until a condition holds.
    pub fn until(&mut self, condition: &str) {
        let deadline = Instant::now() + PATIENCE;
        while !self.is_so(condition) {
            if Instant::now() > deadline {
                let seen = self.value(SEEN);
                panic!("after {PATIENCE:?} it is not so: {condition}\n{seen:#}");
            }
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// Whether a condition holds; it does not in a page that is left for another one.
    fn is_so(&mut self, condition: &str) -> bool {
        let expression = format!("(async () => Boolean(await ({condition})))()");
        let asked = json!({"expression": within(&expression), "returnByValue": true, "awaitPromise": true});
        let Ok(answer) = self.chromium.page_at_rest("Runtime.evaluate", asked) else { return false };
        assert!(answer["exceptionDetails"].is_null(), "{condition}: {}", answer["exceptionDetails"]);
        answer["result"]["value"] == true
    }

    /// Presses a key that has a name, or a letter, where the focus is.
    pub fn press(&mut self, key: &str) {
        self.press_with(key, 0);
    }

    /// Presses a key with the shift key.
    pub fn press_shifted(&mut self, key: &str) {
        self.press_with(key, 8);
    }

    fn press_with(&mut self, key: &str, modifiers: u32) {
        let letter = (key, key.to_uppercase().bytes().next().unwrap().into(), key);
        let (_, code, typed) = KEYS.iter().find(|known| known.0 == key).copied().unwrap_or(letter);
        for kind in ["keyDown", "keyUp"] {
            let text = if kind == "keyDown" { typed } else { "" };
            let mut event = json!({"type": kind, "key": key, "code": key, "windowsVirtualKeyCode": code, "text": text});
            event["modifiers"] = modifiers.into();
            self.chromium.page("Input.dispatchKeyEvent", event);
        }
    }

    /// Focuses a control and presses a key.
    pub fn press_at(&mut self, id: &str, key: &str) {
        self.unfold(id);
        self.value(&format!("document.getElementById('{id}').focus()"));
        assert_eq!(self.text("document.activeElement.id"), id);
        self.press(key);
    }

    /// Clicks the middle of an element.
    pub fn click(&mut self, id: &str) {
        let [x, y, width, height] = self.place(id);
        for kind in ["mousePressed", "mouseReleased"] {
            self.mouse(kind, [x + width / 2.0, y + height / 2.0]);
        }
    }

    /// Presses, moves or lets go of the left button of the mouse at a place.
    pub fn mouse(&mut self, kind: &str, [x, y]: [f64; 2]) {
        let pressed = u32::from(kind != "mouseReleased");
        let event = json!({"type": kind, "x": x, "y": y, "button": "left", "buttons": pressed, "clickCount": 1});
        self.chromium.page("Input.dispatchMouseEvent", event);
    }

    /// Types a value into a field, instead of what is there.
    pub fn fill(&mut self, id: &str, value: &str) {
        self.unfold(id);
        self.value(&format!("document.getElementById('{id}').focus(); document.getElementById('{id}').select()"));
        self.chromium.page("Input.insertText", json!({"text": value}));
    }

    /// Types a value into a field and leaves it with the Enter key.
    pub fn type_into(&mut self, id: &str, value: &str) {
        self.fill(id, value);
        self.press("Enter");
    }

    /// Taps the middle of an element with a finger.
    pub fn tap(&mut self, id: &str) {
        let [x, y, width, height] = self.place(id);
        let point = json!([{"x": x + width / 2.0, "y": y + height / 2.0}]);
        self.chromium.page("Input.dispatchTouchEvent", json!({"type": "touchStart", "touchPoints": point}));
        self.chromium.page("Input.dispatchTouchEvent", json!({"type": "touchEnd", "touchPoints": []}));
    }

    /// Moves the pointer to a place, in pixels of the page.
    pub fn point(&mut self, [x, y]: [f64; 2]) {
        self.chromium.page("Input.dispatchMouseEvent", json!({"type": "mouseMoved", "x": x, "y": y}));
    }

    /// Sets the size of the page.
    pub fn resize(&mut self, [width, height]: [u32; 2]) {
        let size = json!({"width": width, "height": height, "deviceScaleFactor": 1, "mobile": false});
        self.chromium.page("Emulation.setDeviceMetricsOverride", size);
    }

    /// The picture of the viewer, once it stands still.
    pub fn settled(&mut self) -> Vec<[u8; 3]> {
        let deadline = Instant::now() + PATIENCE;
        self.until("!isAwake() && (!current().ended || wholeRuns.has(current().id))");
        let mut before = self.picture("canvas");
        while Instant::now() < deadline {
            let now = self.picture("canvas");
            if now == before {
                return now;
            }
            before = now;
        }
        panic!("the viewer never stands still");
    }

    /// Waits until more than a share of the viewer's pixels are others than they were.
    pub fn until_redrawn(&mut self, before: &[[u8; 3]], share: f64) {
        let deadline = Instant::now() + PATIENCE;
        loop {
            let changed = difference(before, &self.settled());
            if changed > share {
                return;
            }
            assert!(Instant::now() < deadline, "{changed} of the viewer has changed: {}", self.value("read()"));
        }
    }

    /// Opens what hides an element, as a person does who looks for it.
    fn unfold(&mut self, id: &str) {
        self.value(&format!("typeof unfold === 'function' && unfold(document.getElementById('{id}'))"));
    }

    /// Left, top, width and height of an element, unfolded and scrolled into view.
    pub fn place(&mut self, id: &str) -> [f64; 4] {
        self.unfold(id);
        let place = self.value(&format!(
            "(() => {{ const it = document.getElementById('{id}'); it.scrollIntoView({{ block: 'nearest' }}); \
             const box = it.getBoundingClientRect(); return [box.x, box.y, box.width, box.height]; }})()"
        ));
        serde_json::from_value(place).unwrap()
    }

    /// The pixels of an element.
    pub fn picture(&mut self, id: &str) -> Vec<[u8; 3]> {
        let [x, y, width, height] = self.place(id);
        let clip = json!({"x": x, "y": y, "width": width, "height": height, "scale": 1});
        let shot = self.chromium.page("Page.captureScreenshot", json!({"format": "png", "clip": clip}));
        let png = BASE64_STANDARD.decode(shot["data"].as_str().unwrap()).unwrap();
        let pixels = Pixmap::decode_png(&png).unwrap();
        pixels.pixels().iter().map(|p| [p.red(), p.green(), p.blue()]).collect()
    }
}
