//! The layout of a recording over steps: the views of each scene, and their places.

use super::blueprint::{Corner, Kind, Pane, View, send};
use crate::record::draw::{Image, Instruments, PHASE, STEP, Stage, StepImage, drawn, entity_under, title, traced};
use crate::setup::Part;
use rerun::{RecordingStream, RecordingStreamResult};

/// Frames per second when the steps are played.
pub const FRAMES_PER_SEC: f64 = 30.0;

/// Lays out all scenes: alone, a scene fills the window; several get a tab each after an overview.
pub fn send_steps(stages: &[Stage], recording: &RecordingStream) -> RecordingStreamResult<()> {
    let overview = (stages.len() > 1).then(|| overview(stages));
    let tabs = overview.into_iter().chain(stages.iter().map(scene)).collect();
    send(tabs, (STEP, FRAMES_PER_SEC), stages.first().map(|stage| stage.palette), recording)
}

/// A picture of each scene, and their proportionality and convergence side by side.
fn overview(stages: &[Stage]) -> Pane {
    let mut panes = Vec::new();
    let pictures: Vec<Pane> = stages.iter().filter_map(|stage| views(stage).into_iter().flatten().next()).collect();
    if !pictures.is_empty() {
        panes.push((Pane::even(Kind::Grid, "pictures", pictures), 2.4));
    }
    if stages.iter().any(|stage| stage.what.has(Part::Traces)) {
        let all = |name: &str| stages.iter().map(|stage| format!("{}/trace/{name}", stage.root)).collect::<Vec<_>>();
        let most = stages.iter().map(|stage| stage.most_kappa).fold(0.0, f64::max);
        let kappa_r =
            View::settling("kappa_r of all scenes", all("kappa_r_resolved"), [0.0, most], Corner::RightBottom);
        let certificate = View::falling("log10 certificate of all scenes", all("certificate_log10"));
        panes.push((Pane::even(Kind::Vertical, "curves", vec![kappa_r, certificate]), 1.0));
    }
    Pane::container(Kind::Horizontal, "Overview", panes)
}

/// Pictures on the left, curves and text on the right.
fn scene(stage: &Stage) -> Pane {
    let pictures = (stage.what.has_pictures() || stage.instruments.is_some()).then(|| (pictures(stage), 1.9));
    Pane::container(Kind::Horizontal, &stage.title, pictures.into_iter().chain([(curves(stage), 1.0)]).collect())
}

/// The views of the pictures, one row below the other, the map of patches in front of the second row.
pub fn pictures(stage: &Stage) -> Pane {
    let beside = if stage.grid.is_line() { Kind::Tabs } else { Kind::Horizontal };
    let mut rows = views(stage);
    if let Some(map) = &stage.patches {
        rows.resize_with(rows.len().max(2), Vec::new);
        let contents = vec![format!("{}/**", map.root), stage.caption_entity()];
        rows[1].insert(
            0,
            View::plane("Contact patches, load upwards", &stage.root, contents, map.bounds(), stage.palette),
        );
    }
    let rows = rows.into_iter().filter(|row| !row.is_empty());
    let rows = rows.map(|row| (Pane::even(beside, "pictures", row), 1.0));
    let rows = rows.chain(stage.instruments.as_ref().and_then(instruments)).collect();
    Pane::container(Kind::Vertical, &stage.title, rows)
}

/// The pictures that are recorded, row by row; the first one stands for the scene.
fn views(stage: &Stage) -> Vec<Vec<Pane>> {
    let Stage { title, what, .. } = stage;
    let mut rows = Vec::new();
    if what.has(Part::Profile) {
        rows.push(vec![plane(stage, "profile", &format!("{title}: indenter above the solid"), true)]);
    }
    if what.has(Part::Mesh) {
        rows.push(vec![relief(stage)]);
    }
    if let Some(below) = &stage.below {
        let pane = |(title, image): (String, &Image)| {
            View::plane(&title, &image.root, vec![format!("{}/**", image.root)], image.bounds(), stage.palette)
        };
        rows.push(below.images().map(pane).collect());
    }
    if what.has(Part::Fields) {
        let is_exact = stage.grid.is_line() && stage.exact[1].is_some();
        let pressure = if is_exact { "Pressure (green, dashed: exact)" } else { "Pressure" };
        let gap = if !stage.grid.is_line() && what.has(Part::Mask) { "Gap and contact" } else { "Gap" };
        rows.push(vec![plane(stage, "pressure", pressure, stage.grid.is_line()), plane(stage, "gap", gap, true)]);
    }
    if let Some(spectrum) = &stage.spectrum {
        let (title, origin) = ("Power spectra (blue: displacement, grey: heights)", format!("{}/spectrum", stage.root));
        rows.push(vec![View::plane(title, &origin, vec![format!("{origin}/**")], spectrum.bounds(), stage.palette)]);
    }
    if let Some(density) = &stage.density {
        let contents = vec![format!("{}/**", density.root())];
        let title = match stage.grid.is_line() {
            true => "Where the error sits: p (v - min v); contact by pressure (below) and by gap (above)",
            false => {
                "Where the error sits: p (v - min v); blue: pressed though apart, green: touching without pressure"
            }
        };
        rows.push(vec![View::plane(title, density.root(), contents, density.bounds(), stage.palette)]);
    }
    if what.has_mask_alone() {
        rows.push(vec![plane(stage, "contact", &format!("{title}: contact"), false)]);
    }
    rows
}

/// The pictures of the whole run: the contact above the lanes, and the waterfalls beside them.
fn instruments(instruments: &Instruments) -> Option<(Pane, f32)> {
    let image = |title: &str, image: &StepImage| {
        let contents = vec![format!("{}/**", image.root), instruments.cursor()];
        View::plane(title, "/", contents, image.bounds(), image.palette)
    };
    let mut rasters: Vec<Pane> =
        instruments.rasters.iter().map(|(title, raster)| image(title, &raster.image)).collect();
    if let Some(map) = &instruments.flips {
        let contents = vec![format!("{}/**", map.root)];
        rasters.push(View::plane("How often nodes entered or left", &map.root, contents, map.bounds(), map.palette));
    }
    let waterfalls: Vec<Pane> =
        instruments.waterfalls.iter().map(|(title, waterfall)| image(title, &waterfall.image)).collect();
    let lanes = instruments.lanes.as_ref().map(|lanes| {
        let states = View::lanes("As states", &lanes.root);
        Pane::even(Kind::Tabs, "decisions", vec![image("What the solver decided", &lanes.image), states])
    });
    let tabs = |panes: Vec<Pane>| (!panes.is_empty()).then(|| Pane::even(Kind::Tabs, "by step", panes));
    let columns: Vec<Pane> = [[tabs(rasters), lanes], [tabs(waterfalls), None]]
        .into_iter()
        .map(|column| column.into_iter().flatten().collect::<Vec<_>>())
        .filter(|column| !column.is_empty())
        .map(|column| Pane::even(Kind::Vertical, "by step", column))
        .collect();
    let height = if instruments.lanes.is_some() && !instruments.rasters.is_empty() { 1.8 } else { 1.0 };
    (!columns.is_empty()).then(|| (Pane::even(Kind::Horizontal, "instruments", columns), height))
}

fn relief(stage: &Stage) -> Pane {
    let title = format!("{}: the solid's surface, coloured by pressure", stage.title);
    let origin = format!("{}/relief", stage.root);
    View::space(&title, &origin, vec![format!("{origin}/**")], [4.8, -10.4, 7.2], stage.palette)
}

fn plane(stage: &Stage, picture: &str, title: &str, contact: bool) -> Pane {
    let root = &stage.root;
    let mut contents = vec![format!("{root}/{picture}/**"), stage.caption_entity()];
    if stage.what.has(Part::Mask) {
        contents.extend(contact.then(|| format!("{root}/contact")));
        contents.extend(contact.then(|| format!("{root}/contact/patches")));
        contents.extend((!stage.grid.is_line()).then(|| format!("{root}/contact/contour")));
    }
    View::plane(title, root, contents, stage.picture.bounds(), stage.palette)
}

/// Curves of every step and the text, or the text alone.
fn curves(stage: &Stage) -> Pane {
    let text = View::text("Parameters", stage.description());
    let ritz = stage.instruments.as_ref().and_then(Instruments::ritz);
    let ritz = ritz.map(|entity| View::falling("Ritz values of conjugate gradients", vec![entity]));
    if !stage.what.has(Part::Traces) {
        return Pane::even(Kind::Vertical, "curves", ritz.into_iter().chain([text]).collect());
    }
    let traces = |names: &[&str]| names.iter().map(|name| format!("{}/trace/{name}", stage.root)).collect::<Vec<_>>();
    let earlier = |name: &str| stage.has_ghost.then(|| entity_under(&stage.root, name));
    let beside = |names: &[&str]| traces(names).into_iter().chain(earlier(names[0])).collect::<Vec<_>>();
    let kappa = beside(&["kappa_r_resolved", "kappa_resolved", "kappa_r", "kappa_r_theory"]);
    let area = beside(&["relative_area_resolved", "relative_area", "relative_area_theory"]);
    let free = |title: &str, names: &[&str]| View::falling(title, traces(names));
    let is_elsewhere = |name: &str| {
        ["kappa_r", "kappa_resolved", "kappa_r_resolved", "relative_area", "relative_area_resolved", "certificate"]
            .contains(&name)
    };
    let others = traced().filter(|observable| !is_elsewhere(observable.name)).map(|it| free(&title(it), &[&drawn(it)]));
    let area = View::settling("Relative contact area", area, [0.0, stage.most_area], Corner::RightTop);
    let mut more: Vec<Pane> = [text, area].into_iter().chain(others).collect();
    more.push(free("energy", &["complementary_energy", "potential_energy"]));
    more.push(free("Grid level, outer and inner steps", &[PHASE]));
    more.extend(ritz);
    let kappa = View::settling("Proportionality kappa_r, kappa", kappa, [0.0, stage.most_kappa], Corner::RightBottom);
    let certificate = View::falling("Certificate: log10 of the error bound eta", beside(&["certificate_log10"]));
    Pane::even(Kind::Vertical, "curves", vec![kappa, certificate, Pane::even(Kind::Tabs, "more", more)])
}
