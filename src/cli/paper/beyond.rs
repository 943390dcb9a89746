//! Beyond the paper: `kappa_r` is not the same for all indenters, nor up to full contact.

use super::Made;
use super::comparison::Finding;
use super::means::Quantity;
use super::part::Part;
use super::smooth::{LINE, PERIOD, half_width, reduced_pressure, widths};
use super::study::Study;
use anyhow::Result;
use asperity::Grid;
use asperity::plot::{Axis, Colour, Corner, Figure, Mark, Panel, Point, Series, Symbol};
use asperity::study::{Realisation, Row, Shape, Spread};
use asperity::surface::Indenter;
use asperity::theory::{Geometry, PowerLaw, Westergaard};
use std::f64::consts::{PI, SQRT_2};

/// Half-widths of the contacts of power laws over the period, from and to, and the widest that counts as one without
/// neighbours.
const WIDTHS: [f64; 2] = [0.01, 0.1];
const WIDEST: f64 = 0.03;
/// Of the power law and the sine, in periods.
const COEFFICIENT: f64 = 0.1;
const AMPLITUDE: f64 = 0.01 * PERIOD;
/// Mean pressures of the sine over that of full contact.
pub const SINE: [f64; 13] = [0.001, 0.01, 0.03, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0];

/// Exponents with their names, colours and keys.
const POWERS: [(f64, &str, Colour, Symbol, &str); 4] = [
    (1.0, "power law, n = 1", Colour::VERMILION, Symbol::Circle, "beyond.n1"),
    (2.0, "power law, n = 2", Colour::BLUE, Symbol::Square, "beyond.n2"),
    (3.0, "power law, n = 3", Colour::GREEN, Symbol::Triangle, "beyond.n3"),
    (4.0, "power law, n = 4", Colour::PURPLE, Symbol::Diamond, "beyond.n4"),
];

const WAVE: Westergaard = Westergaard { amplitude: AMPLITUDE, period: PERIOD, contact_modulus: 1.0 };

fn power_law(exponent: f64) -> PowerLaw {
    PowerLaw { geometry: Geometry::Line, coefficient: COEFFICIENT, exponent, contact_modulus: 1.0 }
}

/// Power laws and a sine, on lines.
pub fn realisations(_: &Study) -> Result<Vec<Realisation>> {
    let grid = Grid::line(LINE, PERIOD)?;
    let realisation =
        |name: &str, indenter, loads| Realisation { name: name.into(), grid, shape: Shape::Smooth(indenter), loads };
    let powers = POWERS.map(|(exponent, name, ..)| {
        let loads = widths(WIDTHS, 31).into_iter().map(|width| reduced_pressure(&power_law(exponent), width)).collect();
        realisation(name, Indenter::PowerLaw { coefficient: COEFFICIENT, exponent }, loads)
    });
    let sine = realisation("sine", Indenter::Sine { amplitude: AMPLITUDE }, SINE.map(|share| share / SQRT_2).to_vec());
    Ok(powers.into_iter().chain([sine]).collect())
}

/// The figure, and theory beside what is measured.
pub fn make(study: &Study) -> Result<Made> {
    let points = study.points(Part::Beyond)?;
    let rows = |name: &str| points.0.iter().filter(|row| row.name == name).collect::<Vec<_>>();
    let mut findings: Vec<Finding> = POWERS
        .iter()
        .map(|&(.., name, _, _, key)| {
            let narrow = rows(name).into_iter().filter(|row| half_width(row) < 1.1 * WIDEST * PERIOD);
            Finding::number(key, "corrected", Spread::of(narrow.map(|row| row.kappa_r_corrected)))
        })
        .collect();
    let half = rows("sine").into_iter().find(|row| row.reduced_pressure == 0.5 / SQRT_2);
    findings.extend(half.map(|row| Finding::exact("beyond.sine", "corrected", row.kappa_r_corrected)));
    let title = "Beyond the paper: other shapes, and up to full contact".into();
    let panels = vec![powers(&rows), sine(&rows("sine"))];
    Ok(Made { figure: Some(Figure { title, panels }), findings })
}

fn powers<'a>(rows: &impl Fn(&str) -> Vec<&'a Row>) -> Panel {
    let range = [3e-3, 1.0];
    let x = Axis::log("p_r*", range);
    let mut panel =
        Panel::new("indenters |x|^n: κ_r is not universal", x, Axis::linear("κ_r", [1.1, 2.4]), Corner::TopRight);
    for (exponent, name, colour, symbol, _) in POWERS {
        let exact = power_law(exponent).kappa_r();
        let level = range.map(|p| Point::at(p, exact)).to_vec();
        panel.series.push(Series::new(format!("n = {exponent}, exact {exact:.4}"), colour, Mark::Line, level));
        let measured = rows(name).into_iter().map(|row| Point::at(row.reduced_pressure_contact, row.kappa_r_corrected));
        panel.series.push(Series::new("", colour, Mark::Symbol { symbol, filled: false }, measured.collect()));
    }
    panel
}

fn sine(rows: &[&Row]) -> Panel {
    let x = Axis::linear("p / p_full", [0.0, 1.05]);
    let y = Axis::linear("a_rel, κ_r", [0.0, 1.8]);
    let mut panel = Panel::new("single sine to full contact", x, y, Corner::BottomRight);
    let exact =
        |of: &dyn Fn(f64) -> f64| (1..=200).map(|i| 0.005 * f64::from(i)).map(|s| Point::at(s, of(s))).collect();
    let full = PI * AMPLITUDE / PERIOD;
    let measured =
        |quantity: Quantity| rows.iter().map(|row| Point::at(row.reduced_pressure * SQRT_2, quantity(row))).collect();
    let mark = |symbol| Mark::Symbol { symbol, filled: false };
    panel.series = vec![
        Series::new("a_rel, exact", Colour::VERMILION, Mark::Line, exact(&|s| WAVE.relative_area(s * full))),
        Series::new(
            "a_rel, corrected",
            Colour::VERMILION,
            mark(Symbol::Circle),
            measured(|row| row.relative_area_corrected),
        ),
        Series::new("κ_r, exact", Colour::BLUE, Mark::Line, exact(&|s| WAVE.kappa_r(s * full))),
        Series::new("κ_r, corrected", Colour::BLUE, mark(Symbol::Square), measured(|row| row.kappa_r_corrected)),
    ];
    panel
}
