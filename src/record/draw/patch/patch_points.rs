//! Contact patches as points, which show their numbers when the pointer is on them.

use crate::plot::Colour;
use crate::record::draw::fields::PatchReading;
use crate::record::draw::ink::canvas;
use crate::record::draw::ink::palette::colour;
use crate::record::sdk::Float32;
use rerun::{AnyValues, AsComponents, Points2D, Radius, RecordingStream, RecordingStreamResult};

/// Records how the points under `entity` look.
pub(crate) fn log_style(to: &RecordingStream, entity: &str, rgb: Colour) -> RecordingStreamResult<()> {
    let points = Points2D::update_fields().with_colors([colour(rgb)]).with_radii([Radius::new_ui_points(2.5)]);
    to.log_static(entity, &points.with_draw_order(canvas::POINTS).with_show_labels(false))
}

/// Records the patches of a frame, each where `place` puts the node of its largest pressure: nodes, area, load and `kappa_r` of
/// its own, and for how many steps that node has been in contact, where it has not been so from the start.
///
/// The columns carry the word `patch`, as a component name must have one type in a whole recording: viewers from 0.38 on take
/// a recording for one table, and `kappa_r`, `load` and others are names of properties or timelines.
pub(crate) fn log(
    to: &RecordingStream,
    entity: &str,
    patches: &[PatchReading],
    place: impl Fn(usize) -> Option<[f32; 2]>,
) -> RecordingStreamResult<()> {
    let shown: Vec<(&PatchReading, [f32; 2])> =
        patches.iter().filter_map(|it| Some((it, place(it.patch.peak)?))).collect();
    let column = |of: fn(&PatchReading) -> f64| shown.iter().map(|(it, _)| of(it) as f32).collect::<Vec<f32>>();
    let values = AnyValues::default()
        .with_component_override::<Float32>("patch_nodes", "count", column(|it| it.patch.nodes as f64))
        .with_component_override::<Float32>("patch_area", "area", column(|it| it.patch.area))
        .with_component_override::<Float32>("patch_load", "load", column(|it| it.patch.load))
        .with_component_override::<Float32>("patch_kappa_r", "kappa_r", column(|it| it.patch.kappa_r))
        .with_component_override::<Float32>(
            "patch_steps_in_contact",
            "steps",
            column(|it| it.age.map_or(f64::NAN, f64::from)),
        );
    let points = Points2D::update_fields().with_positions(shown.iter().map(|(_, place)| *place));
    to.log(entity, &[&points as &dyn AsComponents, &values])
}
