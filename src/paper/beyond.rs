//! Beyond the paper: `kappa_r` is not the same for all indenters, nor up to full contact.

use super::means::Points;
use super::measure::{Measure, ObservableFn};
use super::reproduction::{Ramp, RampCurve, Reproduction};
use super::smooth::{LINE, PERIOD, loads, narrow, realisation, widths};
use super::verdict::Verdict;
use crate::plot::{Axis, AxisScale, Colour, Mark, Panel, Symbol};
use crate::setup::Cell;
use crate::study::Realisation;
use crate::surface::Indenter;
use crate::theory::{Geometry, PowerLaw, Westergaard};
use std::f64::consts::SQRT_2;

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

/// Power laws whose contacts grow from 0.01 to 0.1 half-widths a period, and a sine, on lines.
pub(crate) fn realisations() -> Vec<Realisation> {
    let powers = POWERS.map(|(exponent, name, ..)| {
        let indenter = Indenter::PowerLaw { coefficient: COEFFICIENT, exponent };
        realisation(name, indenter, Cell::line(LINE, PERIOD), loads(&power_law(exponent), &widths([0.01, 0.1], 31)))
    });
    powers.into_iter().chain([sine()]).collect()
}

fn sine() -> Realisation {
    let loads = SINE.map(|share| share / SQRT_2).to_vec();
    realisation("sine", Indenter::Sine { amplitude: AMPLITUDE }, Cell::line(LINE, PERIOD), loads)
}

/// The figure, and theory beside what is measured.
pub(crate) fn reproduce(points: &Points) -> Reproduction {
    let [area, kappa_r] = [Measure::Resolved.area(), Measure::Resolved.kappa_r()];
    let power = |(_, name, _, _, key): (_, _, _, _, &'static str)| {
        Verdict::number(key, "resolved", narrow(points, name, 0.03, kappa_r))
    };
    let mut verdicts: Vec<Verdict> = POWERS.map(power).into();
    let half = points.named("sine").find(|row| row.observables.reduced_pressure == 0.5 / SQRT_2);
    verdicts.extend(half.map(|row| Verdict::exact("beyond.sine", "resolved", kappa_r(&row.observables))));
    let ramp = Ramp {
        captions: SINE.map(|share| format!("p/p_full = {share}")).to_vec(),
        quantity: ("p/p_full", AxisScale::Linear),
        cursor: SINE.to_vec(),
        curves: vec![
            RampCurve::new("a_rel and κ_r", "a_rel resolved", Colour::VERMILION, points.values("sine", area)),
            RampCurve::new("a_rel and κ_r", "κ_r resolved", Colour::BLUE, points.values("sine", kappa_r)),
        ],
        contacts: vec![sine()],
        length_unit: "L/4",
    };
    let title = "Beyond the paper: other shapes, and up to full contact";
    Reproduction::new(title, vec![power_panel(points), sine_panel(points)], ramp, verdicts)
}

fn power_panel(points: &Points) -> Panel {
    let [x, y] = [Axis::log("p_r*", [3e-3, 1.0]), Axis::linear("κ_r", [1.1, 2.4])];
    let mut panel = Panel::new("indenters |x|^n: κ_r is not universal", x, y);
    for (exponent, name, colour, symbol, _) in POWERS {
        let exact = power_law(exponent).kappa_r();
        panel.add_curve(format!("n = {exponent}, exact {exact:.4}"), colour, Mark::Line, |_| exact);
        let resolved = Measure::Resolved;
        let measured = points.dots(name, resolved.reduced_pressure_contact(), resolved.kappa_r());
        panel.add("", colour, Mark::Symbol { symbol, filled: false }, measured);
    }
    panel
}

fn sine_panel(points: &Points) -> Panel {
    let [x, y] = [Axis::linear("p / p_full", [0.0, 1.05]), Axis::linear("a_rel, κ_r", [0.0, 1.8])];
    let mut panel = Panel::new("single sine to full contact", x, y);
    type MeasuredCurve = (&'static str, Colour, Symbol, fn(f64) -> f64, ObservableFn);
    let kinds: [MeasuredCurve; 2] = [
        ("a_rel", Colour::VERMILION, Symbol::Circle, |p| WAVE.relative_area(p), Measure::Resolved.area()),
        ("κ_r", Colour::BLUE, Symbol::Square, |p| WAVE.kappa_r(p), Measure::Resolved.kappa_r()),
    ];
    for (name, colour, symbol, exact, quantity) in kinds {
        panel.add_curve(format!("{name}, exact"), colour, Mark::Line, |share| exact(share * WAVE.full_pressure()));
        let measured = points.dots("sine", |it| it.reduced_pressure * SQRT_2, quantity);
        panel.add(format!("{name}, resolved"), colour, Mark::Symbol { symbol, filled: false }, measured);
    }
    panel
}
