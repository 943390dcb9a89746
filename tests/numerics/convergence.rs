//! Smooth indenters against their exact solutions, on ladders of grids: the error and the order in the grid spacing.
//!
//! The tables are printed with `cargo test --release --test numerics convergence:: -- --nocapture`.

use crate::common::{relative_l2, solve};
use asperity::contact::{ContactModulus, Load, PolonskyKeer, Problem};
use asperity::theory::Exact;
use asperity::{Grid, Indenter};

/// Loads over which errors are averaged: where the edge of the contact falls between two nodes makes the error of a single
/// load jump by a factor of ten.
const LOADS: usize = 12;

/// Root-mean-square relative errors on one grid; the mean gap over the rms height.
#[derive(Default)]
struct Errors {
    pressure: f64,
    area: f64,
    area_resolved: f64,
    kappa_r: f64,
    mean_gap: f64,
}

impl Errors {
    fn new(indenter: &Indenter, grid: Grid, mean_pressure: f64) -> Self {
        let exact = Exact::new(indenter, &grid, 1.0, mean_pressure).unwrap();
        let problem =
            Problem::new(indenter.surface(grid).unwrap(), ContactModulus(1.0), Load::MeanPressure(mean_pressure))
                .unwrap();
        let contact = solve(&PolonskyKeer, &problem, 1e-11);
        let (measures, resolved) = (contact.counted(), contact.resolved());
        Self {
            pressure: relative_l2(&contact.pressure, &exact.pressure),
            area: measures.relative_area / exact.relative_area - 1.0,
            area_resolved: resolved.relative_area / exact.relative_area - 1.0,
            kappa_r: exact.kappa_r.map_or(0.0, |k| resolved.kappa_r / k - 1.0),
            mean_gap: exact.mean_gap.map_or(0.0, |g| (contact.mean_gap() - g) / problem.rms_height()),
        }
    }

    fn row(&self, head: &str) -> String {
        let Self { pressure, area, area_resolved, kappa_r, mean_gap } = self;
        format!("{head:>18} {pressure:>9.2e} {area:>8.2e} {area_resolved:>9.2e} {kappa_r:>9.2e} {mean_gap:>9.2e}\n")
    }

    /// Over loads from `mean_pressure` to twice that.
    fn averaged(indenter: &Indenter, grid: Grid, mean_pressure: f64) -> Self {
        let loads = (0..LOADS).map(|i| mean_pressure * 2f64.powf(i as f64 / LOADS as f64));
        let all: Vec<Self> = loads.map(|load| Self::new(indenter, grid, load)).collect();
        let rms = |error: fn(&Self) -> f64| (all.iter().map(|e| error(e).powi(2)).sum::<f64>() / LOADS as f64).sqrt();
        Self {
            pressure: rms(|e| e.pressure),
            area: rms(|e| e.area),
            area_resolved: rms(|e| e.area_resolved),
            kappa_r: rms(|e| e.kappa_r),
            mean_gap: rms(|e| e.mean_gap),
        }
    }
}

/// The errors on the finest grid, and the observed orders over the ladder.
struct Ladder {
    finest: Errors,
    order: Errors,
}

impl Ladder {
    fn new(indenter: Indenter, grids: &[Grid], mean_pressure: f64) -> Self {
        let all: Vec<Errors> = grids.iter().map(|&grid| Errors::averaged(&indenter, grid, mean_pressure)).collect();
        let octaves = (grids.len() - 1) as f64;
        let order = |error: fn(&Errors) -> f64| (error(&all[0]) / error(&all[all.len() - 1])).log2() / octaves;
        let order = Errors {
            pressure: order(|e| e.pressure),
            area: order(|e| e.area),
            area_resolved: order(|e| e.area_resolved),
            kappa_r: order(|e| e.kappa_r),
            mean_gap: order(|e| e.mean_gap),
        };
        let heads = grids.iter().map(|grid| grid.shape()[1].to_string()).chain(["order".into()]);
        let rows: String = heads.zip(all.iter().chain([&order])).map(|(head, errors)| errors.row(&head)).collect();
        println!("\n{:<19} pressure     area  resolved   kappa_r  mean gap\n{rows}", indenter.name());
        Self { finest: all.into_iter().next_back().unwrap_or_default(), order }
    }
}

fn lines() -> Vec<Grid> {
    [128, 256, 512, 1024, 2048, 4096].map(|n| Grid::line(n, 4.0).unwrap()).to_vec()
}

fn surfaces() -> Vec<Grid> {
    [64, 128, 256].map(|n| Grid::surface([n, n], [4.0, 4.0]).unwrap()).to_vec()
}

/// The pressure converges as fast as its singularity allows, the area with the spacing, the mean gap with its square.
fn assert_orders(ladder: &Ladder, pressure: f64, finest_pressure: f64) {
    let Ladder { finest, order } = ladder;
    assert!(order.pressure > pressure - 0.15, "order of the pressure {}", order.pressure);
    assert!(order.area > 0.8, "order of the area {}", order.area);
    assert!(order.kappa_r > 0.8, "order of kappa_r {}", order.kappa_r);
    assert!(finest.pressure < finest_pressure, "error of the pressure {}", finest.pressure);
    assert!(finest.area_resolved < finest.area, "resolved {} of {}", finest.area_resolved, finest.area);
}

fn assert_line(indenter: Indenter, mean_pressure: f64, pressure: f64, finest_pressure: f64) {
    let ladder = Ladder::new(indenter, &lines(), mean_pressure);
    assert_orders(&ladder, pressure, finest_pressure);
    assert!(ladder.order.mean_gap > 1.85, "order of the mean gap {}", ladder.order.mean_gap);
    assert!(ladder.finest.mean_gap < 1e-6, "error of the mean gap {}", ladder.finest.mean_gap);
    assert!(ladder.finest.kappa_r < 4e-3, "error of kappa_r {}", ladder.finest.kappa_r);
}

fn assert_surface(indenter: Indenter, mean_pressure: f64, finest_pressure: f64) {
    let ladder = Ladder::new(indenter, &surfaces(), mean_pressure);
    assert_orders(&ladder, 1.0, finest_pressure);
    assert!(ladder.finest.kappa_r < 2e-2, "error of kappa_r {}", ladder.finest.kappa_r);
}

#[test]
fn sine() {
    assert_line(Indenter::Sine { amplitude: 0.1 }, 0.02, 1.0, 2e-4);
}

#[test]
fn cylinder() {
    assert_line(Indenter::Cylinder { radius: 1.0 }, 0.02, 1.0, 6e-4);
}

#[test]
fn wedge_with_its_logarithmic_tip() {
    assert_line(Indenter::Wedge { slope: 0.1 }, 0.01, 0.5, 1.5e-2);
}

#[test]
fn fourth_power() {
    assert_line(Indenter::PowerLaw { coefficient: 1.0, exponent: 4.0 }, 0.01, 1.0, 1e-3);
}

#[test]
fn sphere() {
    assert_surface(Indenter::Sphere { radius: 1.0 }, 1e-3, 1.2e-2);
}

#[test]
fn cone() {
    assert_surface(Indenter::Cone { slope: 0.1 }, 5e-4, 3e-2);
}
