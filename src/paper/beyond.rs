//! Beyond the paper: `kappa_r` is not the same for all indenters, nor up to full contact.

use super::means::{Points, Quantity};
use super::reproduction::{Ramp, RampCurve, Reproduction};
use super::smooth::{LINE, PERIOD, half_width, loads, realisation, widths};
use super::theory_lines::level;
use super::verdict::Verdict;
use crate::plot::{Axis, Colour, Corner, Figure, Mark, Panel, Point, Series, Symbol};
use crate::setup::Cell;
use crate::study::{Realisation, Spread};
use crate::surface::Indenter;
use crate::theory::{Geometry, PowerLaw, Westergaard};
use std::f64::consts::{PI, SQRT_2};

/// Half-widths of the contacts of power laws over the period, from and to, and the widest that counts as one without
/// neighbours.
const WIDTHS: [f64; 2] = [0.01, 0.1];
const WIDEST: f64 = 0.03;
/// Coefficient of the power laws and amplitude of the sine, in periods.
const COEFFICIENT: f64 = 0.1;
const AMPLITUDE: f64 = 0.01 * PERIOD;
/// Mean pressures of the sine over that of full contact.
const SINE: [f64; 13] = [0.001, 0.01, 0.03, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0];

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
pub fn realisations() -> Vec<Realisation> {
    let cell = || Cell::line(LINE, PERIOD);
    let powers = POWERS.map(|(exponent, name, ..)| {
        let indenter = Indenter::PowerLaw { coefficient: COEFFICIENT, exponent };
        realisation(name, indenter, cell(), loads(&power_law(exponent), &widths(WIDTHS, 31)))
    });
    powers.into_iter().chain([sine()]).collect()
}

fn sine() -> Realisation {
    let loads = SINE.map(|share| share / SQRT_2).to_vec();
    realisation("sine", Indenter::Sine { amplitude: AMPLITUDE }, Cell::line(LINE, PERIOD), loads)
}

/// The figure, and theory beside what is measured.
pub fn reproduce(points: &Points) -> Reproduction {
    let power = |(_, name, _, _, key): (_, _, _, _, &'static str)| {
        let narrow = points.named(name).filter(|row| half_width(row) < 1.1 * WIDEST * PERIOD);
        Verdict::number(key, "corrected", Spread::of(narrow.map(|row| row.observables.kappa_r_corrected)))
    };
    let mut verdicts: Vec<Verdict> = POWERS.map(power).into();
    let half = points.named("sine").find(|row| row.observables.reduced_pressure == 0.5 / SQRT_2);
    verdicts.extend(half.map(|row| Verdict::exact("beyond.sine", "corrected", row.observables.kappa_r_corrected)));
    let title = "Beyond the paper: other shapes, and up to full contact".into();
    let figure = Figure { title, panels: vec![power_panel(points), sine_panel(points)] };
    Reproduction { figure: Some(figure), verdicts, ramp: Some(ramp(points)) }
}

fn power_panel(points: &Points) -> Panel {
    let x = Axis::log("p_r*", [3e-3, 1.0]);
    let mut panel =
        Panel::new("indenters |x|^n: κ_r is not universal", x, Axis::linear("κ_r", [1.1, 2.4]), Corner::TopRight);
    for (exponent, name, colour, symbol, _) in POWERS {
        let exact = power_law(exponent).kappa_r();
        let exact_line = level(&panel.x, exact);
        panel.series.push(Series::new(format!("n = {exponent}, exact {exact:.4}"), colour, Mark::Line, exact_line));
        let measured = points
            .named(name)
            .map(|row| row.observables)
            .map(|it| Point::at(it.reduced_pressure_contact, it.kappa_r_corrected));
        panel.series.push(Series::new("", colour, Mark::Symbol { symbol, filled: false }, measured.collect()));
    }
    panel
}

fn sine_panel(points: &Points) -> Panel {
    let x = Axis::linear("p / p_full", [0.0, 1.05]);
    let mut panel =
        Panel::new("single sine to full contact", x, Axis::linear("a_rel, κ_r", [0.0, 1.8]), Corner::BottomRight);
    let full = PI * AMPLITUDE / PERIOD;
    type Kind = (&'static str, Colour, Symbol, fn(f64) -> f64, Quantity);
    let kinds: [Kind; 2] = [
        ("a_rel", Colour::VERMILION, Symbol::Circle, |p| WAVE.relative_area(p), |it| it.relative_area_corrected),
        ("κ_r", Colour::BLUE, Symbol::Square, |p| WAVE.kappa_r(p), |it| it.kappa_r_corrected),
    ];
    for (name, colour, symbol, exact, quantity) in kinds {
        let exact_curve = (1..=200).map(|i| 0.005 * f64::from(i)).map(|s| Point::at(s, exact(s * full)));
        panel.series.push(Series::new(format!("{name}, exact"), colour, Mark::Line, exact_curve.collect()));
        let measured = points
            .named("sine")
            .map(|row| row.observables)
            .map(|it| Point::at(it.reduced_pressure * SQRT_2, quantity(&it)));
        let mark = Mark::Symbol { symbol, filled: false };
        panel.series.push(Series::new(format!("{name}, corrected"), colour, mark, measured.collect()));
    }
    panel
}

/// The sine to full contact.
fn ramp(points: &Points) -> Ramp {
    let curve = |name: &str, colour, quantity: Quantity| {
        let values = points.values("sine", quantity).collect();
        RampCurve { view: "sine", name: name.into(), colour, values }
    };
    Ramp {
        captions: SINE.map(|share| format!("p/p_full = {share}")).to_vec(),
        cursor: SINE.to_vec(),
        curves: vec![
            curve("a_rel corrected", Colour::VERMILION, |it| it.relative_area_corrected),
            curve("κ_r corrected", Colour::BLUE, |it| it.kappa_r_corrected),
        ],
        contacts: vec![sine()],
        length_unit: "L/4",
    }
}
