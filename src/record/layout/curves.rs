//! The curves of a scene, beside its pictures.

use crate::contact::Quantity;
use crate::record::draw::{
    ContainerKind, Corner, PHASE, Pane, PaneView, Place, Stage, drawn, entity_under, title, traced,
};
use crate::setup::Part;

/// The entities of some traces, and behind them that of an earlier solve of the first one.
fn beside_earlier(stage: &Stage, names: &[&str]) -> Vec<String> {
    let traces = names.iter().map(|name| format!("{}/trace/{name}", stage.root));
    traces.chain(stage.has_ghost.then(|| entity_under(&stage.root, names[0]))).collect()
}

/// The relative area.
pub(crate) fn area(stage: &Stage) -> Pane {
    let curves = beside_earlier(stage, &["relative_area", "relative_area_counted", "relative_area_theory"]);
    PaneView::settling(&titled("Relative area", stage), curves, [0.0, stage.ends().relative_area], None)
}

fn kappa_r(stage: &Stage) -> Pane {
    let curves = beside_earlier(stage, &["kappa_r", "kappa_r_counted", "kappa_r_theory"]);
    PaneView::settling(&titled("kappa_r", stage), curves, [0.0, stage.ends().kappa_r], legend(stage))
}

/// The corner of a legend, which shows the name and colour of a curve of one step, where there is nothing else to see.
fn legend(stage: &Stage) -> Option<Corner> {
    stage.is_of_other_code().then_some(Corner::RightTop)
}

/// The title of curves whose edges are resolved, with the colours of those beside them: a legend would cover curves that settle.
fn titled(name: &str, stage: &Stage) -> String {
    let exact = if stage.exact.iter().any(Option::is_some) { "; green: exact" } else { "" };
    let earlier = if stage.has_ghost { " and earlier solve" } else { "" };
    format!("{name} (grey: nodes counted{earlier}{exact})")
}

/// The certificate.
pub(crate) fn certificate(stage: &Stage) -> Pane {
    let earlier = if stage.has_ghost { " (grey: earlier solve)" } else { "" };
    let title = format!("Certificate: log10 of the error bound eta{earlier}");
    let curves = beside_earlier(stage, &["certificate_log10"]);
    if stage.is_of_other_code() { PaneView::falling(&title, curves) } else { PaneView::named(&title, curves) }
}

/// Curves of every step and the text, or the text alone; in a low window the certificate is a tab.
pub(crate) fn curves(stage: &Stage, is_low: bool) -> Pane {
    let text = PaneView::text("Parameters", stage.description());
    let run = stage.panes(&[Place::RunCurves]).into_iter().map(|(_, pane)| pane);
    if !stage.what.has(Part::Traces) {
        return Pane::even(ContainerKind::Vertical, "curves", run.chain([text]).collect());
    }
    let traces = |names: &[&str]| names.iter().map(|name| format!("{}/trace/{name}", stage.root)).collect::<Vec<_>>();
    let free = |title: &str, names: &[&str]| PaneView::falling(title, traces(names));
    let mut more: Vec<Pane> = [text, area(stage)].into_iter().chain(others(stage)).collect();
    more.push(free("energy", &["complementary_energy", "potential_energy"]));
    more.push(free("Grid level, outer and inner steps", &[PHASE]));
    more.extend(run);
    let mut rows = vec![kappa_r(stage)];
    if is_low {
        more.insert(0, certificate(stage));
    } else {
        rows.push(certificate(stage));
    }
    rows.push(Pane::even(ContainerKind::Tabs, "more", more));
    Pane::even(ContainerKind::Vertical, "curves", rows)
}

/// Views of observables that are not beside others: `kappa` on the axis of the area over the reduced pressure, the others on axes that
/// fit them.
fn others(stage: &Stage) -> impl Iterator<Item = Pane> {
    let elsewhere = [
        Quantity::KappaR,
        Quantity::KappaRCounted,
        Quantity::RelativeArea,
        Quantity::RelativeAreaCounted,
        Quantity::Certificate,
    ];
    traced().filter(move |quantity| !elsewhere.contains(quantity)).map(|observable| {
        let entity = format!("{}/trace/{}", stage.root, drawn(observable));
        match (observable, stage.ends().kappa) {
            (Quantity::Kappa, Some(most)) => PaneView::settling(&title(observable), vec![entity], [0.0, most], None),
            _ => PaneView::named(&title(observable), vec![entity]),
        }
    })
}
