//! Section 6: the model of Greenwood and Williamson, with the gradient taken over the contact.

use super::Made;
use super::comparison::Finding;
use super::study::Study;
use anyhow::Result;
use asperity::plot::{Axis, Colour, Corner, Figure, Mark, Panel, Point, Series};
use asperity::theory::SummitHeights;
use serde::Serialize;

/// Separations over the scale of the heights.
const RANGE: [f64; 2] = [-2.0, 10.0];
const STEPS: i32 = 120;
/// A separation so large that it stands for the limit.
const FAR: f64 = 1e6;

/// `kappa_r` at one separation.
#[derive(Serialize)]
struct Row {
    separation: f64,
    exponential: f64,
    gaussian: f64,
}

/// The curve; its points go into gw.csv.
pub fn make(study: &Study) -> Result<Made> {
    let [low, high] = RANGE;
    let row = |i: i32| {
        let separation = low + (high - low) * f64::from(i) / f64::from(STEPS);
        let [exponential, gaussian] =
            [SummitHeights::Exponential, SummitHeights::Gaussian].map(|heights| heights.kappa_r(separation));
        Row { separation, exponential, gaussian }
    };
    let rows: Vec<Row> = (0..=STEPS).map(row).collect();
    super::write_csv(&study.file("gw", "csv"), &rows)?;
    let y = Axis::linear("κ_r", [1.70, 1.80]);
    let mut panel = Panel::new("independent spheres", Axis::linear("d/σ", RANGE), y, Corner::BottomRight);
    let limit = std::f64::consts::PI.sqrt();
    let exponential = rows.iter().filter(|row| row.separation >= 0.0);
    let exponential = exponential.map(|row| Point::at(row.separation, row.exponential)).collect();
    let gaussian = rows.iter().map(|row| Point::at(row.separation, row.gaussian)).collect();
    let level = RANGE.map(|d| Point::at(d, limit)).to_vec();
    panel.series = vec![
        Series::new("exponential heights", Colour::BLUE, Mark::Line, exponential),
        Series::new("Gaussian heights", Colour::VERMILION, Mark::Line, gaussian),
        Series::new(format!("√π = {limit:.4}"), Colour::BLACK, Mark::Dashed, level),
    ];
    let title = "Section 6: Greenwood and Williamson with the gradient over the contact".into();
    let findings = vec![
        Finding::exact("gw.exponential", "", SummitHeights::Exponential.kappa_r(3.0)),
        Finding::exact("gw.gaussian", "", SummitHeights::Gaussian.kappa_r(FAR)),
        Finding::statement("gw.finite", format!("{:.4} at d/σ = 3", SummitHeights::Gaussian.kappa_r(3.0)), true),
    ];
    Ok(Made { figure: Some(Figure { title, panels: vec![panel] }), findings })
}
