//! Which views a scene gets, and where they stand.

use super::blueprint::{Blueprint, Kind, View};
use super::stage::{Picture, Stage};
use rerun::{RecordingStream, RecordingStreamResult};

type Placed = RecordingStreamResult<String>;

/// Lays out all scenes: alone, a scene fills the window; several get a tab each after an overview.
pub fn send(application: &'static str, stages: &[Stage], recording: &RecordingStream) -> RecordingStreamResult<()> {
    let mut blueprint = Blueprint::new(application)?;
    let mut tabs = Vec::new();
    if stages.len() > 1 {
        tabs.push((overview(&mut blueprint, stages)?, 1.0));
    }
    for stage in stages {
        tabs.push((scene(&mut blueprint, stage)?, 1.0));
    }
    blueprint.send(tabs, recording)
}

/// The pictures of all scenes, and their proportionality and convergence side by side.
fn overview(blueprint: &mut Blueprint, stages: &[Stage]) -> Placed {
    let mut pictures = Vec::new();
    for stage in stages {
        pictures.push((blueprint.view(main_view(stage))?, 1.0));
    }
    let grid = blueprint.container(Kind::Grid, "pictures", pictures)?;
    let all = |name: &str| stages.iter().map(|stage| format!("{}/trace/{name}", stage.root)).collect::<Vec<_>>();
    let most = stages.iter().map(|stage| stage.ranges.kappa).fold(0.0, f64::max);
    let kappa_r = blueprint.view(View::curves("kappa_r of all scenes", all("kappa_r"), Some([0.0, most])))?;
    let certificate = blueprint.view(View::curves("log10 certificate of all scenes", all("certificate"), None))?;
    let curves = blueprint.container(Kind::Vertical, "curves", vec![(kappa_r, 1.0), (certificate, 1.0)])?;
    blueprint.container(Kind::Horizontal, "Overview", vec![(grid, 2.4), (curves, 1.0)])
}

/// Pictures on the left, curves and text on the right.
fn scene(blueprint: &mut Blueprint, stage: &Stage) -> Placed {
    let pictures = match stage.picture {
        Picture::Line(_) => line(blueprint, stage)?,
        Picture::Surface(_) => surface(blueprint, stage)?,
    };
    let curves = curves(blueprint, stage)?;
    blueprint.container(Kind::Horizontal, &stage.title, vec![(pictures, 1.9), (curves, 1.0)])
}

fn line(blueprint: &mut Blueprint, stage: &Stage) -> Placed {
    let profile = blueprint.view(main_view(stage))?;
    let exact = if stage.reference.relative_area.is_some() { "Pressure (white: exact)" } else { "Pressure" };
    let pressure = blueprint.view(plane(stage, "pressure", exact, true))?;
    let gap = blueprint.view(plane(stage, "gap", "Gap", true))?;
    let below = blueprint.container(Kind::Tabs, "pressure and gap", vec![(pressure, 1.0), (gap, 1.0)])?;
    blueprint.container(Kind::Vertical, "pictures", vec![(profile, 1.0), (below, 1.0)])
}

fn surface(blueprint: &mut Blueprint, stage: &Stage) -> Placed {
    let relief = blueprint.view(main_view(stage))?;
    let pressure = blueprint.view(plane(stage, "pressure", "Pressure", false))?;
    let gap = blueprint.view(plane(stage, "gap", "Gap and contact", true))?;
    let images = blueprint.container(Kind::Horizontal, "images", vec![(pressure, 1.0), (gap, 1.0)])?;
    blueprint.container(Kind::Vertical, "pictures", vec![(relief, 1.0), (images, 1.0)])
}

/// The picture that stands for a scene.
fn main_view(stage: &Stage) -> View {
    let Stage { root, title, .. } = stage;
    match stage.picture {
        Picture::Line(_) => plane(stage, "profile", &format!("{title}: indenter above the solid"), true),
        Picture::Surface(_) => {
            let title = format!("{title}: the solid's surface, coloured by pressure");
            let origin = format!("{root}/relief");
            View::space(&title, &origin, vec![format!("{origin}/**")], [4.8, -10.4, 7.2])
        }
    }
}

fn plane(stage: &Stage, picture: &str, title: &str, contact: bool) -> View {
    let root = &stage.root;
    let mut contents = vec![format!("{root}/{picture}/**"), format!("{root}/caption")];
    contents.extend(contact.then(|| format!("{root}/contact")));
    View::plane(title, root, contents, stage.picture.bounds())
}

fn curves(blueprint: &mut Blueprint, stage: &Stage) -> Placed {
    let traces = |names: &[&str]| names.iter().map(|name| format!("{}/trace/{name}", stage.root)).collect::<Vec<_>>();
    let kappa = View::curves(
        "Proportionality kappa_r, kappa",
        traces(&["kappa_r", "kappa", "exact_kappa_r"]),
        Some([0.0, stage.ranges.kappa]),
    );
    let area = traces(&["relative_area", "exact_relative_area"]);
    let area = View::curves("Relative contact area", area, Some([0.0, stage.ranges.area]));
    let certificate = View::curves("Certificate: log10 of the error bound eta", traces(&["certificate"]), None);
    let mut below = vec![(blueprint.view(View::text("Parameters", format!("{}/description", stage.root)))?, 1.0)];
    for (name, title) in [("mean_gap", "Mean gap"), ("energy", "Energy"), ("patches", "Patches")] {
        below.push((blueprint.view(View::curves(title, traces(&[name]), None))?, 1.0));
    }
    below.push((levels(blueprint, traces(&["level"]), traces(&["outer", "inner"]))?, 1.0));
    let mut rows = Vec::new();
    for (view, share) in [(kappa, 1.3), (area, 0.9), (certificate, 1.2)] {
        rows.push((blueprint.view(view)?, share));
    }
    rows.push((blueprint.container(Kind::Tabs, "more", below)?, 1.2));
    blueprint.container(Kind::Vertical, "curves", rows)
}

/// Where solvers with coarse grids and inner steps stand.
fn levels(blueprint: &mut Blueprint, level: Vec<String>, steps: Vec<String>) -> Placed {
    let level = blueprint.view(View::curves("Grid level (0: finest)", level, None))?;
    let steps = blueprint.view(View::curves("Outer and inner steps on the level", steps, None))?;
    blueprint.container(Kind::Vertical, "Levels", vec![(level, 1.0), (steps, 1.0)])
}
