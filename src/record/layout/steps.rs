//! The layout of a recording over steps: the views of each scene, and their places.

use super::blueprint::{Blueprint, Clock, Kind, View};
use crate::record::draw::{STEP, Stage, entity_under, title, traced};
use crate::setup::Part;
use rerun::external::re_log_types::ApplicationId;
use rerun::{RecordingStream, RecordingStreamResult};

/// Frames per second when the steps are played.
const FRAMES_PER_SEC: f64 = 30.0;

/// A pane by its path.
pub type Placed = RecordingStreamResult<String>;

/// Lays out all scenes: alone, a scene fills the window; several get a tab each after an overview.
pub fn send_steps(
    application: ApplicationId,
    stages: &[Stage],
    recording: &RecordingStream,
) -> RecordingStreamResult<()> {
    let mut blueprint = Blueprint::new(application)?;
    let mut tabs = Vec::new();
    if stages.len() > 1 {
        tabs.push((overview(&mut blueprint, stages)?, 1.0));
    }
    for stage in stages {
        tabs.push((scene(&mut blueprint, stage)?, 1.0));
    }
    blueprint.send(tabs, Clock { timeline: STEP, frames_per_sec: FRAMES_PER_SEC }, recording)
}

/// A picture of each scene, and their proportionality and convergence side by side.
fn overview(blueprint: &mut Blueprint, stages: &[Stage]) -> Placed {
    let mut panes = Vec::new();
    let pictures: Vec<View> = stages.iter().filter_map(|stage| views(stage).into_iter().flatten().next()).collect();
    if !pictures.is_empty() {
        panes.push((gather(blueprint, Kind::Grid, "pictures", pictures)?, 2.4));
    }
    if stages.iter().any(|stage| stage.what.has(Part::Traces)) {
        let all = |name: &str| stages.iter().map(|stage| format!("{}/trace/{name}", stage.root)).collect::<Vec<_>>();
        let most = stages.iter().map(|stage| stage.ranges.kappa).fold(0.0, f64::max);
        let kappa_r = View::curves("kappa_r of all scenes", all("kappa_r"), Some([0.0, most]));
        let certificate = View::curves("log10 certificate of all scenes", all("certificate"), None);
        panes.push((gather(blueprint, Kind::Vertical, "curves", vec![kappa_r, certificate])?, 1.0));
    }
    blueprint.container(Kind::Horizontal, "Overview", panes)
}

/// Pictures on the left, curves and text on the right.
fn scene(blueprint: &mut Blueprint, stage: &Stage) -> Placed {
    let mut panes = Vec::new();
    if stage.what.has_pictures() {
        panes.push((pictures(blueprint, stage, Vec::new())?, 1.9));
    }
    panes.push((curves(blueprint, stage)?, 1.0));
    blueprint.container(Kind::Horizontal, &stage.title, panes)
}

/// The views of the pictures, one row below the other, `more` in front of the second row.
pub fn pictures(blueprint: &mut Blueprint, stage: &Stage, more: Vec<View>) -> Placed {
    let beside = if stage.is_line() { Kind::Tabs } else { Kind::Horizontal };
    let mut rows = Vec::new();
    let mut views = views(stage).into_iter();
    let (first, second) = (views.next(), more.into_iter().chain(views.next().unwrap_or_default()).collect());
    for row in first.into_iter().chain([second]).chain(views).filter(|row| !row.is_empty()) {
        rows.push((gather(blueprint, beside, "pictures", row)?, 1.0));
    }
    blueprint.container(Kind::Vertical, &stage.title, rows)
}

/// Views with the same share of the room each; a single one needs no container.
pub fn gather(blueprint: &mut Blueprint, kind: Kind, title: &str, views: Vec<View>) -> Placed {
    let mut panes = Vec::new();
    for view in views {
        panes.push((blueprint.view(view)?, 1.0));
    }
    match panes.as_slice() {
        [(only, _)] => Ok(only.clone()),
        _ => blueprint.container(kind, title, panes),
    }
}

/// The pictures that are recorded, row by row; the first one stands for the scene.
fn views(stage: &Stage) -> Vec<Vec<View>> {
    let Stage { title, what, .. } = stage;
    let mut rows = Vec::new();
    if what.has(Part::Profile) {
        rows.push(vec![plane(stage, "profile", &format!("{title}: indenter above the solid"), true)]);
    }
    if what.has(Part::Mesh) {
        rows.push(vec![relief(stage)]);
    }
    if what.has(Part::Fields) {
        let is_exact = stage.is_line() && stage.reference.relative_area.is_some();
        let pressure = if is_exact { "Pressure (white: exact)" } else { "Pressure" };
        let gap = if !stage.is_line() && what.has(Part::Mask) { "Gap and contact" } else { "Gap" };
        rows.push(vec![plane(stage, "pressure", pressure, stage.is_line()), plane(stage, "gap", gap, true)]);
    }
    if let Some(spectrum) = &stage.spectrum {
        let (title, origin) = ("Power spectra (blue: displacement, grey: heights)", format!("{}/spectrum", stage.root));
        rows.push(vec![View::plane(title, &origin, vec![format!("{origin}/**")], spectrum.bounds())]);
    }
    if what.has_mask_alone() {
        rows.push(vec![plane(stage, "contact", &format!("{title}: contact"), false)]);
    }
    rows
}

fn relief(stage: &Stage) -> View {
    let title = format!("{}: the solid's surface, coloured by pressure", stage.title);
    let origin = format!("{}/relief", stage.root);
    View::space(&title, &origin, vec![format!("{origin}/**")], [4.8, -10.4, 7.2])
}

fn plane(stage: &Stage, picture: &str, title: &str, contact: bool) -> View {
    let root = &stage.root;
    let mut contents = vec![format!("{root}/{picture}/**"), stage.caption_entity()];
    contents.extend((contact && stage.what.has(Part::Mask)).then(|| format!("{root}/contact")));
    View::plane(title, root, contents, stage.picture.bounds())
}

/// Curves of every step and the text, or the text alone.
fn curves(blueprint: &mut Blueprint, stage: &Stage) -> Placed {
    let text = blueprint.view(View::text("Parameters", format!("{}/description", stage.root)))?;
    if !stage.what.has(Part::Traces) {
        return Ok(text);
    }
    let traces = |names: &[&str]| names.iter().map(|name| format!("{}/trace/{name}", stage.root)).collect::<Vec<_>>();
    let earlier = |name: &str| stage.has_ghost.then(|| entity_under(&stage.root, name));
    let beside = |names: &[&str]| traces(names).into_iter().chain(earlier(names[0])).collect::<Vec<_>>();
    let kappa = beside(&["kappa_r", "kappa", "exact_kappa_r"]);
    let kappa = View::curves("Proportionality kappa_r, kappa", kappa, Some([0.0, stage.ranges.kappa]));
    let area = beside(&["relative_area", "exact_relative_area"]);
    let area = View::curves("Relative contact area", area, Some([0.0, stage.ranges.area]));
    let certificate = View::curves("Certificate: log10 of the error bound eta", beside(&["certificate"]), None);
    let mut below = vec![(text, 1.0)];
    let is_elsewhere = |name| ["kappa_r", "kappa", "relative_area", "certificate"].contains(&name);
    let others = traced().filter(|observable| !is_elsewhere(observable.name)).map(|it| (title(it), vec![it.name]));
    for (title, names) in others.chain([("energy".into(), vec!["complementary_energy", "potential_energy"])]) {
        below.push((blueprint.view(View::curves(&title, traces(&names), None))?, 1.0));
    }
    below.push((levels(blueprint, traces(&["level"]), traces(&["outer", "inner"]))?, 1.0));
    let mut rows = Vec::new();
    for (view, share) in [(kappa, 1.3), (area, 0.9), (certificate, 1.2)] {
        rows.push((blueprint.view(view)?, share));
    }
    rows.push((blueprint.container(Kind::Tabs, "more", below)?, 1.2));
    blueprint.container(Kind::Vertical, "curves", rows)
}

/// The places of solvers with coarse grids and inner steps in their schemes.
fn levels(blueprint: &mut Blueprint, level: Vec<String>, steps: Vec<String>) -> Placed {
    let level = blueprint.view(View::curves("Grid level (0: finest)", level, None))?;
    let steps = blueprint.view(View::curves("Outer and inner steps on the level", steps, None))?;
    blueprint.container(Kind::Vertical, "Levels", vec![(level, 1.0), (steps, 1.0)])
}
