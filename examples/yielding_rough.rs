//! A rough surface on a metal, by two laws of yielding: no pressure above the hardness, and flow below the surface.
//!
//! `cargo run --release --example yielding_rough` prints both and draws them into `yielding_rough.png` in the folder for temporary files.

use asperity::contact::{Contact, Law, Load, Quantity};
use asperity::error::SetupError;
use asperity::job::HistoryOutcome;
use asperity::plot::{Axis, Colour, Dot, Figure, FigureStyle, Mark, Panel, write_figure};
use asperity::setup::{LoadPath, Setup};

/// Under one load: mean pressure over yield stress, relative area, and mean gap and depth of the imprint over the rms height.
type Row = [f64; 4];
type ValueOf = fn(&Row) -> f64;

const TABOR: f64 = 2.8; // the hardness of a metal over its yield stress
const YIELD_STRESS: f64 = 1e9;
const SCENE: &str = "
    surface = { spectrum = { hurst = 0.8, rolloff-wavelength = '50 um', short-cutoff = '10 um', rms-gradient = 0.03 }, seed = 3 }
    grid = { points = [96, 96], size = '100 um' }
    load.mean-pressure = '10 MPa'
    solid = { young = '210 GPa', poisson = 0.3";

fn capped(loads: &[f64]) -> Result<Vec<Row>, SetupError> {
    let setup = Setup { law: Law::Hardness(TABOR * YIELD_STRESS), ..Setup::from_toml(&format!("{SCENE} }}"))? };
    let setup = setup.under_loads(loads.iter().map(|load| Load::MeanPressure(*load)).collect());
    let outcome = HistoryOutcome::solve(&setup, &setup.problem()?, &mut ())?;
    let row = |contact: &Contact| {
        let height = contact.problem.rms_height();
        let deepest = contact.overlap().iter().copied().fold(0.0, f64::max);
        let area = contact.resolved().relative_area;
        [contact.mean_pressure() / YIELD_STRESS, area, contact.mean_gap() / height, deepest / height]
    };
    Ok(outcome.states.iter().map(|state| row(&state.contact)).collect())
}

fn flowing(loads: &[f64]) -> Result<Vec<Row>, SetupError> {
    let scene = format!("{SCENE}, yield-stress = '1 GPa', hardening-modulus = '2 GPa', yield-depth = '50 um' }}");
    let path = LoadPath { load: [loads, &[0.0]].concat(), ..LoadPath::default() };
    let setup = Setup { path: Some(path), ..Setup::from_toml(&scene)? };
    let outcome = HistoryOutcome::solve(&setup, &setup.problem()?, &mut ())?;
    let of = |quantity: Quantity| outcome.values(quantity);
    let [pressure, area] = [Quantity::MeanPressure, Quantity::RelativeArea].map(of);
    let [gap, imprint, height] = [Quantity::MeanGap, Quantity::ImprintDepth, Quantity::RmsHeight].map(of);
    println!("largest plastic strain: {:.3}", of(Quantity::MaxPlasticStrain).into_iter().fold(0.0, f64::max));
    let row = |i: usize| [pressure[i] / YIELD_STRESS, area[i], gap[i] / height[i], imprint[i] / height[i]];
    Ok((0..loads.len()).map(row).collect())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let loads: Vec<f64> = (0..9).map(|i| 10e6 * 40f64.powf(f64::from(i) / 8.0)).collect();
    let (cap, flow) = (capped(&loads)?, flowing(&loads)?);
    println!("{:>8} {:>16} {:>16} {:>16} (by hardness, by flow)", "<p> / Y", "area", "gap / h_rms", "imprint / h_rms");
    for (a, b) in cap.iter().zip(&flow) {
        println!("{:>8.4} {:>8.4}{:>8.4} {:>8.4}{:>8.4} {:>8.4}{:>8.4}", a[0], a[1], b[1], a[2], b[2], a[3], b[3]);
    }
    let panels: [(&str, ValueOf); 4] = [
        ("relative area", |row| row[1]),
        ("mean pressure in contact over yield stress", |row| row[0] / row[1]),
        ("mean gap over rms height", |row| row[2]),
        ("depth of the imprint over rms height", |row| row[3]),
    ];
    let panel = |(title, of): (&str, ValueOf)| {
        let highest = cap.iter().chain(&flow).map(of).fold(0.0, f64::max);
        let mut panel = Panel::new(title, Axis::log("<p> / Y", [8e-3, 0.5]), Axis::linear("", [0.0, 1.1 * highest]));
        let dots = |rows: &[Row]| rows.iter().map(|row| Dot::at(row[0], of(row))).collect::<Vec<_>>();
        panel.add("hardness 2.8 Y", Colour::ORANGE, Mark::Dashed, dots(&cap));
        panel.add("J2 flow", Colour::BLUE, Mark::Line, dots(&flow));
        panel
    };
    let figure = Figure { title: "a rough surface on a metal".into(), panels: panels.map(panel).into() };
    write_figure(&std::env::temp_dir().join("yielding_rough.png"), &figure, &FigureStyle::default())?;
    Ok(())
}
