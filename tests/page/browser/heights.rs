//! A person with a file of heights.

use super::chromium::installed;
use super::downloads::save;
use super::explorer::{rested, sketched};
use super::page::{Page, difference};
use asperity::setup::Setup;
use serde_json::{Value, json};

/// A tilted map of two waves in text that says its size, and where it has a void.
pub fn map() -> String {
    let mut text = "# Channel: Topography\n# Width: 6.4 µm\n# Height: 4.8 µm\n# Value units: nm\n".to_owned();
    for y in 0..48 {
        let wave = |x: usize| 30.0 * (0.3 * x as f64).sin() * (0.4 * y as f64).cos() + 5.0 * x as f64;
        let value = |x: usize| if [y, x] == [3, 4] { "nan".into() } else { format!("{:.4}", wave(x)) };
        text += &((0..64).map(value).collect::<Vec<_>>().join("\t") + "\n");
    }
    text
}

/// Drops a file on an element, as a browser tells a page of it.
pub fn drop_on(page: &mut Page, id: &str, name: &str, text: &str) {
    page.value(&format!(
        "(() => {{ const dataTransfer = new DataTransfer(); dataTransfer.items.add(new File([{}], {})); \
         for (const kind of ['dragenter', 'dragover', 'drop']) document.getElementById('{id}') \
           .dispatchEvent(new DragEvent(kind, {{ dataTransfer, bubbles: true, cancelable: true }})); }})()",
        json!(text),
        json!(name)
    ));
}

fn fault(page: &mut Page) -> String {
    page.text("document.getElementById('fault').innerText")
}

/// A file that is dropped is described, prepared and solved, and its contact is seen.
fn a_dropped_file_is_pressed(page: &mut Page) {
    let before = page.picture("section");
    drop_on(page, "section", "<img src=x onerror=document.title='run'>.txt", &map());
    page.until("knobs.body === 'file' && description.name.startsWith('<img')");
    rested(page);
    let told = page.text("document.getElementById('heights').innerText");
    for words in [
        "<img src=x onerror=document.title='run'>.txt",
        "1 of 3072 heights (0.0 %) are void",
        "1 voids filled with the smoothest heights",
        "4.8 µm x 6.4 µm",
        "Topography",
        "shortest wavelength above the noise",
    ] {
        assert!(told.contains(words), "{words} is not in {told}");
    }
    assert_eq!(page.value("document.querySelectorAll('img').length"), 0, "the name of a file became part of the page");
    assert_eq!(page.text("document.body.dataset.status"), "converged");
    assert_eq!(page.value("document.body.hasAttribute('data-drop')"), false);
    let changed = difference(&before, &page.picture("section"));
    assert!(changed > 0.05, "{changed} of the picture has changed");
}

/// Turning a step takes over from the choice; what it does to the heights is warned of.
fn steps_are_taken_by_hand(page: &mut Page) {
    assert_eq!(page.text("document.getElementById('heights-auto').value"), "true");
    for (id, value) in [("heights-detrend", ""), ("heights-mirror", "")] {
        page.value(&format!(
            "(() => {{ const it = document.getElementById('{id}'); it.value = '{value}'; it.dispatchEvent(new Event('change')); }})()"
        ));
        page.until("!knobs.heights.auto");
        rested(page);
    }
    assert_eq!(page.text("document.getElementById('heights-auto').value"), "false");
    assert_eq!(page.value("Object.keys(latest().knobs.heights.prepare)"), json!(["fill"]));
    page.until("document.getElementById('warnings').innerText.includes('across the period along x')");
    page.type_into("heights-low-pass", "1 nm");
    page.until("!document.getElementById('fault').hidden");
    page.type_into("heights-low-pass", "wide");
    page.until("document.getElementById('fault').innerText.startsWith('Low-pass cannot be wide')");
    page.type_into("heights-low-pass", "400 nm");
    rested(page);
    assert_eq!(page.value("latest().knobs.heights.prepare['low-pass']"), 4e-7);
    let stem = page.text("current().file_stem");
    let scene = std::fs::read_to_string(save(page, "save-setup", &format!("{stem}.toml"))).unwrap();
    let setup = Setup::from_toml(&scene).unwrap();
    assert_eq!(setup.surface.prepare.low_pass, Some(4e-7));
    assert!(setup.surface.height.unwrap().path().to_str().unwrap().starts_with("<img"));
}

/// News of a run that come while somebody types leave the field alone.
fn news_do_not_interrupt(page: &mut Page) {
    page.value("byId('heights-low-pass').focus(); byId('heights-low-pass').select()");
    page.chromium.page("Input.insertText", json!({"text": "300 n"}));
    page.value("showHeights()");
    assert_eq!(page.text("byId('heights-low-pass').value"), "300 n");
    page.press("m");
    page.press("Enter");
    page.until("knobs.heights.prepare['low-pass'] === 3e-7");
    rested(page);
}

/// What cannot be read is refused in one sentence, and the file before stays.
fn what_is_no_file_of_heights_is_refused(page: &mut Page) {
    drop_on(page, "controls", "prose.txt", "<b>no numbers</b> at all");
    page.until("document.getElementById('fault').innerText.startsWith('prose.txt is not')");
    assert!(fault(page).contains("nor a text of numbers"), "{}", fault(page));
    assert!(page.text("description.name").starts_with("<img"));
}

/// A file is opened from the keyboard, where the system asks for it.
fn a_file_is_opened_by_the_keyboard(page: &mut Page) {
    let path = page.chromium.downloads().join("profile.txt");
    let line = |i: usize| format!("{:e} {:e}\n", 1e-7 * f64::from(i as u32), 1e-8 * (0.2 * i as f64).sin());
    std::fs::write(&path, (0..256).map(line).collect::<String>()).unwrap();
    page.chromium.page("Page.enable", json!({}));
    page.chromium.page("Page.setInterceptFileChooserDialog", json!({"enabled": true}));
    page.press_at("open-file", "Enter");
    let asked = page.chromium.told("Page.fileChooserOpened", |event| event["mode"] == "selectSingle");
    let node: Value = asked["backendNodeId"].clone();
    page.chromium.page("DOM.setFileInputFiles", json!({"files": [path], "backendNodeId": node}));
    page.until("description.name === 'profile.txt'");
    rested(page);
    assert_eq!(page.text("latest().knobs.domain"), "line");
    assert!(page.text("document.getElementById('title').innerText").starts_with("profile, p* ="));
}

#[test]
fn a_person_with_a_file() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = sketched(&program, "");
    a_dropped_file_is_pressed(&mut page);
    steps_are_taken_by_hand(&mut page);
    news_do_not_interrupt(&mut page);
    what_is_no_file_of_heights_is_refused(&mut page);
    a_file_is_opened_by_the_keyboard(&mut page);
}
