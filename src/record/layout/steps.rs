//! The layout of a recording over steps: the views of each scene, and their places.

use super::blueprint::{PlayedTimeline, send};
use super::curves::{area, certificate, curves};
use super::window::Sizes;
use crate::record::draw::{ContainerKind, Corner, GRID_COLUMNS, Pane, PaneView, Place, STEP, Stage};
use crate::setup::Part;
use rerun::{RecordingStream, RecordingStreamResult};

/// Frames per second when the steps are played.
pub(crate) const FRAMES_PER_SEC: f64 = 30.0;

/// Width of the pictures of a scene beside its curves, and of those of a surface, of which there are two side by side.
const PICTURES: f32 = 1.9;
const PICTURES_OF_SURFACE: f32 = 2.1;
/// Width of the pictures of a surface beside its curves, where there are two, one above the other.
const NARROW: f32 = 0.65;
/// Height of the stress below a line, whose proportions are those in space, beside pictures of the height 1.
const STRESS: f32 = 1.4;
/// The smallest height of a row of pictures or curves, in points of the window. If rows would be lower, some of them
/// become tabs.
const LEAST_ROW: f64 = 200.0;
/// Rows of the curves of a scene.
const ROWS_OF_CURVES: usize = 3;
/// Rows of the grid of the pictures of a surface.
const ROWS_OF_GRID: usize = 2;
/// Height of a row of pictures in the overview, which leaves them about the proportions that they have beside their curves; and of all rows at
/// the most.
const OVERVIEW_ROW: f32 = 0.38;
const MOST_OVERVIEW: f32 = 0.72;

/// Gives the pictures of all scenes the proportions of their panes in a window.
pub(crate) fn fit_steps(stages: &mut [Stage], window: [f64; 2]) {
    let sizes = Sizes::new(&tabs(stages), window);
    stages.iter_mut().for_each(|stage| stage.fit(|root| sizes.get(root)));
}

/// Lays out all scenes.
pub(crate) fn send_steps(stages: &[Stage], recording: &RecordingStream) -> RecordingStreamResult<()> {
    send(tabs(stages), PlayedTimeline { timeline: STEP, frames_per_sec: FRAMES_PER_SEC }, recording)
}

/// A tab for each scene after an overview; alone, a scene fills the window. The instruments of a scene that has pictures, too, have a tab of
/// their own.
fn tabs(stages: &[Stage]) -> Vec<Pane> {
    let overview = (stages.len() > 1).then(|| overview(stages));
    overview.into_iter().chain(stages.iter().flat_map(|stage| [Some(scene(stage)), run(stage)]).flatten()).collect()
}

/// A picture of each scene, and below them their proportionality and convergence side by side.
fn overview(stages: &[Stage]) -> Pane {
    let mut panes = Vec::new();
    let pictures: Vec<Pane> =
        stages.iter().filter_map(|stage| views(stage).into_iter().flatten().next().map(|(_, pane)| pane)).collect();
    let height = (OVERVIEW_ROW * pictures.len().div_ceil(GRID_COLUMNS) as f32).min(MOST_OVERVIEW);
    if !pictures.is_empty() {
        panes.push((Pane::even(ContainerKind::Grid, "pictures", pictures), height));
    }
    if stages.iter().any(|stage| stage.what.has(Part::Traces)) {
        let all = |name: &str| stages.iter().map(|stage| format!("{}/trace/{name}", stage.root)).collect::<Vec<_>>();
        let most = stages.iter().map(|stage| stage.ends().kappa_r).fold(0.0, f64::max);
        let corner = Some(Corner::RightBottom);
        let kappa_r = PaneView::settling("kappa_r of all scenes", all("kappa_r"), [0.0, most], corner);
        let certificate = PaneView::falling("log10 certificate of all scenes", all("certificate_log10"));
        panes.push((Pane::even(ContainerKind::Horizontal, "curves", vec![kappa_r, certificate]), 1.0 - height));
    }
    Pane::container(ContainerKind::Vertical, "Overview", panes)
}

/// Pictures on the left, curves and text on the right.
fn scene(stage: &Stage) -> Pane {
    let pictures = stage.what.has_pictures().then(|| (pictures(stage), width(stage)));
    let instruments = if pictures.is_none() { instruments_below(stage) } else { None }.map(|pane| (pane, PICTURES));
    let panes = pictures.into_iter().chain(instruments).chain([(curves(stage, is_low(stage, ROWS_OF_CURVES)), 1.0)]);
    Pane::container(ContainerKind::Horizontal, &stage.title, panes.collect())
}

/// Width of the pictures of a scene, beside curves of the width 1.
pub(crate) fn width(stage: &Stage) -> f32 {
    match (stage.grid.is_line(), views(stage).len()) {
        (true, _) => PICTURES,
        (false, 2) => NARROW,
        (false, _) => PICTURES_OF_SURFACE,
    }
}

/// The pictures of the whole run of a scene that has others, too, beside its curves.
fn run(stage: &Stage) -> Option<Pane> {
    if !stage.what.has_pictures() || !stage.what.has_instruments() {
        return None;
    }
    Some(instruments_beside(stage)?.titled(&format!("{}: the run, step by step", stage.title)))
}

/// The views of the pictures. Those of a line stand one below the other, in front of the second row the map of patches, and in a low window
/// those of the third row; those of a surface stand in a grid, and in a low window they are tabs.
pub(crate) fn pictures(stage: &Stage) -> Pane {
    if stage.grid.is_line() { pictures_of_line(stage) } else { pictures_of_surface(stage) }
}

fn pictures_of_line(stage: &Stage) -> Pane {
    let mut rows = views(stage);
    if rows.len() > 2 && is_low(stage, rows.len()) {
        let further = rows.remove(2);
        rows[1].splice(0..0, further);
    }
    let is_deep = |row: &[(Place, Pane)]| row.iter().any(|(place, _)| *place == Place::Deep);
    let heights: Vec<f32> =
        rows.iter().enumerate().map(|(i, row)| if i > 0 && is_deep(row) { STRESS } else { 1.0 }).collect();
    let mut rows: Vec<Vec<Pane>> = rows.into_iter().map(tabs_of).collect();
    if let Some(map) = &stage.patches {
        rows.resize_with(rows.len().max(2), Vec::new);
        rows[1].insert(0, map.pane());
    }
    rows.extend(stage.tree.iter().map(|tree| vec![tree.pane()]));
    let heights = heights.into_iter().chain(std::iter::repeat(1.0));
    let rows = rows.into_iter().zip(heights).filter(|(row, _)| !row.is_empty());
    let rows = rows.map(|(row, height)| (Pane::even(ContainerKind::Tabs, "pictures", row), height));
    Pane::container(ContainerKind::Vertical, &stage.title, rows.collect())
}

fn pictures_of_surface(stage: &Stage) -> Pane {
    let rows: Vec<Vec<Pane>> = views(stage).into_iter().map(tabs_of).collect();
    if rows.len() > 1 && is_low(stage, ROWS_OF_GRID) {
        return Pane::even(ContainerKind::Tabs, &stage.title, rows.into_iter().flatten().collect());
    }
    let mut panes: Vec<Pane> = rows.into_iter().map(|row| Pane::even(ContainerKind::Tabs, "pictures", row)).collect();
    if panes.len() == 3 {
        let text = || PaneView::text("Parameters", stage.description());
        panes.push(match &stage.tree {
            Some(tree) => Pane::even(ContainerKind::Tabs, "patches", vec![tree.pane(), text()]),
            None if stage.what.has(Part::Traces) => area(stage),
            None => text(),
        });
    }
    let kind = if panes.len() > 2 { ContainerKind::Grid } else { ContainerKind::Vertical };
    Pane::even(kind, &stage.title, panes)
}

/// The pictures that are recorded, in groups that share a pane; the first one represents the scene.
fn views(stage: &Stage) -> Vec<Vec<(Place, Pane)>> {
    let mut groups: Vec<Vec<(Place, Pane)>> = Vec::new();
    for (place, pane) in stage.panes(&[Place::Main, Place::Field, Place::OfState]) {
        let has_tabs = stage.grid.is_line() && place != Place::Main;
        match groups.last_mut().filter(|group| has_tabs && group[0].0 == place) {
            Some(group) => group.push((place, pane)),
            None => groups.push(vec![(place, pane)]),
        }
    }
    groups.push(stage.panes(&[Place::Further, Place::Deep]));
    groups.retain(|group| !group.is_empty());
    groups
}

fn tabs_of(group: Vec<(Place, Pane)>) -> Vec<Pane> {
    group.into_iter().map(|(_, pane)| pane).collect()
}

/// Whether a number of rows would be too low in the window of a scene.
fn is_low(stage: &Stage, rows: usize) -> bool {
    stage.window_height < LEAST_ROW * rows as f64
}

/// The pictures of the whole run one below the other.
fn instruments_below(stage: &Stage) -> Option<Pane> {
    let places = [Place::RunContact, Place::RunDecisions, Place::RunWavelengths];
    let rows: Vec<Pane> = places.into_iter().filter_map(|place| by_step(stage, place)).collect();
    (!rows.is_empty()).then(|| Pane::even(ContainerKind::Vertical, "by step", rows))
}

/// The contact above the decisions on the left, the wavelengths above the convergence on the right.
fn instruments_beside(stage: &Stage) -> Option<Pane> {
    let left = [by_step(stage, Place::RunContact), by_step(stage, Place::RunDecisions)];
    let right = [by_step(stage, Place::RunWavelengths), convergence(stage)];
    let columns = [left, right].map(|column| column.into_iter().flatten().collect::<Vec<_>>());
    let columns = columns.into_iter().filter(|column| !column.is_empty());
    let columns: Vec<_> = columns.map(|column| (Pane::even(ContainerKind::Vertical, "by step", column), 1.0)).collect();
    (!columns.is_empty()).then(|| Pane::container(ContainerKind::Horizontal, "", columns))
}

/// The curves that show how a run converges, step by step as the instruments do.
fn convergence(stage: &Stage) -> Option<Pane> {
    let certificate = stage.what.has(Part::Traces).then(|| certificate(stage));
    let curves: Vec<Pane> = certificate.into_iter().chain(tabs_of(stage.panes(&[Place::RunCurves]))).collect();
    (!curves.is_empty()).then(|| Pane::even(ContainerKind::Tabs, "convergence", curves))
}

/// The pictures of the whole run in a place, as tabs.
fn by_step(stage: &Stage, place: Place) -> Option<Pane> {
    let panes = tabs_of(stage.panes(&[place]));
    (!panes.is_empty()).then(|| Pane::even(ContainerKind::Tabs, "by step", panes))
}
