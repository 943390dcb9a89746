//! The layout of a recording over steps: the views of each scene, and their places.

use super::blueprint::{Corner, GRID_COLUMNS, Kind, Pane, View, send};
use super::window::Sizes;
use crate::record::draw::{Instruments, PHASE, STEP, Stage, StepImage, drawn, entity_under, title, traced};
use crate::setup::Part;
use rerun::{RecordingStream, RecordingStreamResult};

/// Frames per second when the steps are played.
pub const FRAMES_PER_SEC: f64 = 30.0;

/// Width of the pictures of a scene beside its curves, and of those of a surface, of which there are two side by side.
const PICTURES: f32 = 1.9;
const PICTURES_OF_SURFACE: f32 = 2.1;
/// Width of the pictures of a surface beside its curves, where there are two, one above the other.
const NARROW: f32 = 0.65;
/// Height of the stress below a line, whose proportions are those in space, beside pictures of the height 1.
const STRESS: f32 = 1.4;
/// The least height of a row of pictures or curves, in points of the window: where rows would be lower, some of them become tabs.
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
pub fn fit_steps(stages: &mut [Stage], window: [f64; 2]) {
    let sizes = Sizes::new(&tabs(stages), window);
    stages.iter_mut().for_each(|stage| stage.fit(|root| sizes.of(root)));
}

/// Lays out all scenes.
pub fn send_steps(stages: &[Stage], recording: &RecordingStream) -> RecordingStreamResult<()> {
    send(tabs(stages), (STEP, FRAMES_PER_SEC), recording)
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
    let pictures: Vec<Pane> = stages.iter().filter_map(|stage| views(stage).into_iter().flatten().next()).collect();
    let height = (OVERVIEW_ROW * pictures.len().div_ceil(GRID_COLUMNS) as f32).min(MOST_OVERVIEW);
    if !pictures.is_empty() {
        panes.push((Pane::even(Kind::Grid, "pictures", pictures), height));
    }
    if stages.iter().any(|stage| stage.what.has(Part::Traces)) {
        let all = |name: &str| stages.iter().map(|stage| format!("{}/trace/{name}", stage.root)).collect::<Vec<_>>();
        let most = stages.iter().map(|stage| stage.ends().kappa_r).fold(0.0, f64::max);
        let corner = Some(Corner::RightBottom);
        let kappa_r = View::settling("kappa_r of all scenes", all("kappa_r"), [0.0, most], corner);
        let certificate = View::falling("log10 certificate of all scenes", all("certificate_log10"));
        panes.push((Pane::even(Kind::Horizontal, "curves", vec![kappa_r, certificate]), 1.0 - height));
    }
    Pane::container(Kind::Vertical, "Overview", panes)
}

/// Pictures on the left, curves and text on the right.
fn scene(stage: &Stage) -> Pane {
    let pictures = stage.what.has_pictures().then(|| (pictures(stage), width(stage)));
    let instruments = stage.instruments.as_ref().filter(|_| pictures.is_none());
    let instruments = instruments.and_then(instruments_below).map(|pane| (pane, PICTURES));
    let panes = pictures.into_iter().chain(instruments).chain([(curves(stage), 1.0)]);
    Pane::container(Kind::Horizontal, &stage.title, panes.collect())
}

/// Width of the pictures of a scene, beside curves of the width 1.
pub fn width(stage: &Stage) -> f32 {
    match (stage.grid.is_line(), views(stage).len()) {
        (true, _) => PICTURES,
        (false, 2) => NARROW,
        (false, _) => PICTURES_OF_SURFACE,
    }
}

/// The pictures of the whole run of a scene that has others, too, beside its curves.
fn run(stage: &Stage) -> Option<Pane> {
    let instruments = stage.instruments.as_ref().filter(|_| stage.what.has_pictures())?;
    Some(instruments_beside(instruments, stage)?.titled(&format!("{}: the run, step by step", stage.title)))
}

/// The views of the pictures. Those of a line stand one below the other, in front of the second row the map of patches, and in a low window
/// those of the third row; those of a surface stand in a grid, and in a low window they are tabs.
pub fn pictures(stage: &Stage) -> Pane {
    let mut rows = views(stage);
    if stage.grid.is_line() && rows.len() > 2 && is_low(stage, rows.len()) {
        let further = rows.remove(2);
        rows[1].splice(0..0, further);
    }
    let views = rows.len();
    if stage.grid.is_line() {
        if let Some(map) = &stage.patches {
            rows.resize_with(rows.len().max(2), Vec::new);
            let contents = vec![format!("{}/**", map.root), stage.caption_entity()];
            let map = (stage.root.clone(), stage.picture.bounds());
            rows[1].insert(0, View::plane("Contact patches, load upwards", &stage.root, contents, map, stage.palette));
        }
        let is_further = |row: usize| row > 0 && row + 1 == views && stage.below.is_some();
        let heights = (0..).map(|row| if is_further(row) { STRESS } else { 1.0 });
        let rows = rows.into_iter().zip(heights).filter(|(row, _)| !row.is_empty());
        let rows = rows.map(|(row, height)| (Pane::even(Kind::Tabs, "pictures", row), height));
        return Pane::container(Kind::Vertical, &stage.title, rows.collect());
    }
    if rows.len() > 1 && is_low(stage, ROWS_OF_GRID) {
        return Pane::even(Kind::Tabs, &stage.title, rows.into_iter().flatten().collect());
    }
    let mut panes: Vec<Pane> = rows.into_iter().map(|row| Pane::even(Kind::Tabs, "pictures", row)).collect();
    if panes.len() == 3 {
        panes.push(if stage.what.has(Part::Traces) {
            area(stage)
        } else {
            View::text("Parameters", stage.description())
        });
    }
    let kind = if panes.len() > 2 { Kind::Grid } else { Kind::Vertical };
    Pane::even(kind, &stage.title, panes)
}

/// The pictures that are recorded, in groups that share a pane; the first one stands for the scene.
fn views(stage: &Stage) -> Vec<Vec<Pane>> {
    let Stage { title, what, .. } = stage;
    let mut groups = Vec::new();
    if what.has(Part::Profile) {
        groups.push(vec![plane(stage, "profile", &format!("{title}: indenter above the solid"), true)]);
    }
    groups.extend(relief(stage).map(|relief| vec![relief]));
    if what.has(Part::Fields) {
        let is_exact = stage.grid.is_line() && stage.exact[1].is_some();
        let pressure = if is_exact { "Pressure (green, dashed: exact)" } else { "Pressure" };
        let gap = if !stage.grid.is_line() && what.has(Part::Mask) { "Gap and contact" } else { "Gap" };
        let fields = [plane(stage, "pressure", pressure, stage.grid.is_line()), plane(stage, "gap", gap, true)];
        if stage.grid.is_line() {
            groups.push(fields.into());
        } else {
            groups.extend(fields.map(|field| vec![field]));
        }
    }
    if what.has_mask_alone() {
        groups.push(vec![plane(stage, "contact", &format!("{title}: contact"), false)]);
    }
    groups.push(further(stage));
    groups.retain(|group| !group.is_empty());
    groups
}

/// The pictures that take work of their own: the stress below, spectra and the density of the error.
fn further(stage: &Stage) -> Vec<Pane> {
    let mut panes = Vec::new();
    if let Some(below) = &stage.below {
        panes.extend(below.images().map(|(title, image)| {
            let contents = vec![format!("{}/**", image.root)];
            View::plane(&title, &image.root, contents, (image.root.clone(), image.bounds()), stage.palette)
        }));
    }
    if let Some(spectrum) = &stage.spectrum {
        let (title, root) = ("Power spectra (blue: displacement, grey: heights)", spectrum.root());
        let picture = (root.to_owned(), spectrum.bounds());
        panes.push(View::plane(title, root, vec![format!("{root}/**")], picture, stage.palette));
    }
    if let Some(density) = &stage.density {
        let contents = vec![format!("{}/**", density.root())];
        let title = match stage.grid.is_line() {
            true => "Where the error sits: p (v - min v); contact by pressure (below) and by gap (above)",
            false => {
                "Where the error sits: p (v - min v); blue: pressed though apart, green: touching without pressure"
            }
        };
        let picture = (density.root().to_owned(), density.bounds());
        panes.push(View::plane(title, density.root(), contents, picture, stage.palette));
    }
    panes
}

/// The pictures of the whole run one below the other.
fn instruments_below(instruments: &Instruments) -> Option<Pane> {
    let rows: Vec<Pane> =
        [rasters(instruments), lanes(instruments), waterfalls(instruments)].into_iter().flatten().collect();
    (!rows.is_empty()).then(|| Pane::even(Kind::Vertical, "by step", rows))
}

/// The contact above the lanes on the left, the waterfalls above convergence and Ritz values on the right.
fn instruments_beside(instruments: &Instruments, stage: &Stage) -> Option<Pane> {
    let left: Vec<Pane> = [rasters(instruments), lanes(instruments)].into_iter().flatten().collect();
    let right: Vec<Pane> = waterfalls(instruments).into_iter().chain(convergence(stage)).collect();
    let columns = [left, right].into_iter().filter(|column| !column.is_empty());
    let columns: Vec<Pane> = columns.map(|column| Pane::even(Kind::Vertical, "by step", column)).collect();
    (!columns.is_empty())
        .then(|| Pane::container(Kind::Horizontal, "", columns.into_iter().map(|it| (it, 1.0)).collect()))
}

/// The curves that show how a run converges, step by step as the instruments do.
fn convergence(stage: &Stage) -> Option<Pane> {
    let certificate = stage.what.has(Part::Traces).then(|| certificate(stage));
    let curves: Vec<Pane> = certificate.into_iter().chain(ritz(stage)).collect();
    (!curves.is_empty()).then(|| Pane::even(Kind::Tabs, "convergence", curves))
}

fn rasters(instruments: &Instruments) -> Option<Pane> {
    let rasters = instruments.rasters.iter().map(|(title, raster)| image(title, &raster.image));
    let flips = instruments.flips.as_ref().map(|map| {
        let contents = vec![format!("{}/**", map.root)];
        let picture = (map.root.clone(), map.bounds());
        View::plane("How often nodes entered or left", &map.root, contents, picture, map.palette)
    });
    tabbed(rasters.chain(flips).collect())
}

fn waterfalls(instruments: &Instruments) -> Option<Pane> {
    tabbed(instruments.waterfalls.iter().map(|(title, waterfall)| image(title, &waterfall.image)).collect())
}

fn lanes(instruments: &Instruments) -> Option<Pane> {
    let lanes = instruments.lanes.as_ref()?;
    tabbed(vec![image("What the solver decided", &lanes.image), View::lanes("As states", &lanes.root)])
}

fn tabbed(panes: Vec<Pane>) -> Option<Pane> {
    (!panes.is_empty()).then(|| Pane::even(Kind::Tabs, "by step", panes))
}

fn image(title: &str, image: &StepImage) -> Pane {
    let contents = vec![format!("{}/**", image.root)];
    View::plane(title, &image.root, contents, (image.root.clone(), image.bounds()), image.palette)
}

fn relief(stage: &Stage) -> Option<Pane> {
    let title = format!("{}: the solid's surface, coloured by pressure", stage.title);
    Some(View::space(&title, stage.picture.relief()?, stage.palette))
}

fn plane(stage: &Stage, picture: &str, title: &str, contact: bool) -> Pane {
    let root = &stage.root;
    let mut contents = vec![format!("{root}/{picture}/**"), stage.caption_entity()];
    if stage.what.has(Part::Mask) {
        contents.extend(contact.then(|| format!("{root}/contact")));
        contents.extend(contact.then(|| format!("{root}/contact/patches")));
        contents.extend((!stage.grid.is_line()).then(|| format!("{root}/contact/contour")));
    }
    View::plane(title, root, contents, (root.clone(), stage.picture.bounds()), stage.palette)
}

/// The Ritz values of conjugate gradients, if they are recorded.
fn ritz(stage: &Stage) -> Option<Pane> {
    let entity = stage.instruments.as_ref().and_then(Instruments::ritz)?;
    Some(View::falling("Ritz values of conjugate gradients", vec![entity]))
}

/// The entities of some traces, and behind them that of an earlier solve of the first one.
fn beside_earlier(stage: &Stage, names: &[&str]) -> Vec<String> {
    let traces = names.iter().map(|name| format!("{}/trace/{name}", stage.root));
    traces.chain(stage.has_ghost.then(|| entity_under(&stage.root, names[0]))).collect()
}

/// Whether so many rows would be too low in the window of a scene.
fn is_low(stage: &Stage, rows: usize) -> bool {
    stage.window_height < LEAST_ROW * rows as f64
}

fn area(stage: &Stage) -> Pane {
    let curves = beside_earlier(stage, &["relative_area", "relative_area_counted", "relative_area_theory"]);
    View::settling(&titled("Relative area", stage), curves, [0.0, stage.ends().relative_area], None)
}

fn kappa_r(stage: &Stage) -> Pane {
    let curves = beside_earlier(stage, &["kappa_r", "kappa_r_counted", "kappa_r_theory"]);
    View::settling(&titled("kappa_r", stage), curves, [0.0, stage.ends().kappa_r], None)
}

/// The title of curves whose edges are resolved, with the colours of those beside them: a legend would cover curves that settle.
fn titled(name: &str, stage: &Stage) -> String {
    let exact = if stage.exact.iter().any(Option::is_some) { "; green: exact" } else { "" };
    let earlier = if stage.has_ghost { " and earlier solve" } else { "" };
    format!("{name} (grey: nodes counted{earlier}{exact})")
}

fn certificate(stage: &Stage) -> Pane {
    View::falling("Certificate: log10 of the error bound eta", beside_earlier(stage, &["certificate_log10"]))
}

/// Curves of every step and the text, or the text alone.
fn curves(stage: &Stage) -> Pane {
    let text = View::text("Parameters", stage.description());
    let ritz = ritz(stage);
    if !stage.what.has(Part::Traces) {
        return Pane::even(Kind::Vertical, "curves", ritz.into_iter().chain([text]).collect());
    }
    let traces = |names: &[&str]| names.iter().map(|name| format!("{}/trace/{name}", stage.root)).collect::<Vec<_>>();
    let free = |title: &str, names: &[&str]| View::falling(title, traces(names));
    let mut more: Vec<Pane> = [text, area(stage)].into_iter().chain(others(stage)).collect();
    more.push(free("energy", &["complementary_energy", "potential_energy"]));
    more.push(free("Grid level, outer and inner steps", &[PHASE]));
    more.extend(ritz);
    let mut rows = vec![kappa_r(stage)];
    if is_low(stage, ROWS_OF_CURVES) {
        more.insert(0, certificate(stage));
    } else {
        rows.push(certificate(stage));
    }
    rows.push(Pane::even(Kind::Tabs, "more", more));
    Pane::even(Kind::Vertical, "curves", rows)
}

/// Views of observables that are not beside others: `kappa` on the axis of the area over the reduced pressure, the others on axes that
/// fit them.
fn others(stage: &Stage) -> impl Iterator<Item = Pane> {
    let elsewhere = ["kappa_r", "kappa_r_counted", "relative_area", "relative_area_counted", "certificate"];
    traced().filter(move |observable| !elsewhere.contains(&observable.name)).map(|observable| {
        let entity = format!("{}/trace/{}", stage.root, drawn(observable));
        match (observable.name, stage.ends().kappa) {
            ("kappa", Some(most)) => View::settling(&title(observable), vec![entity], [0.0, most], None),
            _ => View::single(&title(observable), entity),
        }
    })
}
