//! A person who looks at a surface: from above, in space, and along a cut of it.

use super::chromium::installed;
use super::explorer::{opened, rested};
use super::page::Page;

/// Solves a rough surface, and waits for its map.
fn surface(page: &mut Page) {
    page.value("Object.assign(knobs, { domain: 'surface', points: 128, cutoff: 32 }); show(); changed()");
    rested(page);
    page.until("document.body.dataset.section === latest().id && above && !byId('top-box').hasAttribute('data-stale')");
}

/// The share of the pixels of the map that show a contact is the area.
fn the_map_shows_the_contact(page: &mut Page) {
    assert_eq!(page.value("byId('top-box').hidden"), false);
    let touching = page.value(
        "(() => { const at = frameOfTop(); const scale = devicePixelRatio; const to = byId('top').getContext('2d'); \
         const [r, g, b] = rgb(colours().ground); let count = 0, all = 0; \
         const { data, width } = to.getImageData(at.x * scale, at.y * scale, at.wide * scale, at.high * scale); \
         const cut = (section.y / above.size[0] + 0.5 / above.shape[0]) * at.high * scale; \
         for (let i = 0; i < data.length; i += 4) { \
           if (Math.abs(Math.floor(i / 4 / width) - cut) < 4) continue; \
           all += 1; count += data[i] !== r || data[i + 1] !== g || data[i + 2] !== b; } \
         return count / all; })()",
    );
    let area = page.value("latest().numbers.relative_area_counted").as_f64().unwrap();
    // less the rows that the line of the cut covers
    assert!((touching.as_f64().unwrap() - area).abs() < 0.02, "{touching} of the map for an area of {area}");
}

/// A click cuts the map along the row below it, and the section is that of this row.
fn a_click_cuts_it(page: &mut Page) {
    let [x, y, ..] = page.place("top");
    let number = |page: &mut Page, of: &str| page.value(of).as_f64().unwrap();
    // a click has whole pixels
    let place = [
        x + number(page, "frameOfTop().x + 0.3 * frameOfTop().wide"),
        y + number(page, "frameOfTop().y + 0.7 * frameOfTop().high"),
    ]
    .map(f64::round);
    let share = (place[1] - y - number(page, "frameOfTop().y")) / number(page, "frameOfTop().high");
    page.mouse("mouseMoved", place);
    assert!(page.text("byId('top-value').textContent").contains("µm"), "the value below the pointer");
    page.mouse("mousePressed", place);
    page.mouse("mouseReleased", place);
    page.until(&format!(
        "section.y / above.size[0] <= {share} && {share} - section.y / above.size[0] < 1 / above.shape[0]"
    ));
    let same = "(() => { const row = Math.round(section.y / above.size[0] * above.shape[0]); \
                const from = row * above.shape[1]; return section.pressure.every((p, i) => p === above.pressure[from + i]); })()";
    assert_eq!(page.value(same), true);
    let before = number(page, "section.y");
    page.press_at("top", "ArrowUp");
    page.until(&format!("section.y < {before}"));
}

/// Under the hand the map moves with the section.
fn it_moves_under_the_hand(page: &mut Page) {
    page.value("globalThis.kept = above; true");
    page.press_at("press", "ArrowDown");
    page.until("above !== globalThis.kept && !byId('top-box').hasAttribute('data-stale')");
    rested(page);
    page.until("document.body.dataset.section === latest().id");
}

/// The solid in space is drawn, or the page says that it cannot be.
fn it_is_seen_in_space(page: &mut Page) {
    page.click("map-solid");
    page.until("byId('map-solid').disabled || (!byId('solid').hidden && graphics.its === above)");
    if page.value("byId('map-solid').disabled") == true {
        assert_eq!(page.value("byId('top').hidden"), false);
        return;
    }
    let colours = "(() => { const its = byId('solid'); const to = document.createElement('canvas').getContext('2d'); \
                   Object.assign(to.canvas, { width: its.width, height: its.height }); to.drawImage(its, 0, 0); \
                   const { data } = to.getImageData(0, 0, its.width, its.height); const all = new Set(); \
                   for (let i = 0; i < data.length; i += 4) all.add(data[i] << 16 | data[i + 1] << 8 | data[i + 2]); return all.size; })()";
    assert!(page.value(colours).as_f64().unwrap() > 100.0, "a solid with light and shade");
    page.click("map-pressure");
}

/// The map of heights is over their mean, and where the pressure is largest it is high.
fn heights_are_seen(page: &mut Page) {
    page.click("map-height");
    let heights = "(() => { const { values, high } = mapOf('height'); const peak = above.pressure.indexOf(Math.max(...above.pressure)); \
                   return [values.reduce((sum, z) => sum + z, 0) / values.length / high, values[peak] / high]; })()";
    let [mean, peak] = serde_json::from_value::<[f64; 2]>(page.value(heights)).unwrap();
    assert!(mean.abs() < 1e-6 && peak > 0.3, "{mean} {peak}");
    page.click("map-pressure");
}

/// A line has no map.
fn a_line_has_none(page: &mut Page) {
    page.value("Object.assign(knobs, { domain: 'line' }); show(); changed()");
    rested(page);
    page.until("byId('top-box').hidden");
}

#[test]
fn a_person_who_looks_at_a_surface() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = opened(&program);
    surface(&mut page);
    the_map_shows_the_contact(&mut page);
    a_click_cuts_it(&mut page);
    it_moves_under_the_hand(&mut page);
    it_is_seen_in_space(&mut page);
    heights_are_seen(&mut page);
    a_line_has_none(&mut page);
    assert_eq!(page.value("document.getElementById('fault').hidden"), true);
}
