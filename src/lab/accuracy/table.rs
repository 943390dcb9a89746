//! The tables for reading, 120 columns wide.

use super::curve::{ConvergenceCurve, ConvergencePoint};
use super::experiment::Measurements;
use super::ladder::{LOADS, Ladder};
use super::quantity::{BEST, QUANTITIES};
use crate::lab::table::{or_dash, points};
use std::fmt::{self, Formatter};

/// Certificates for which the table lists the work.
const MILESTONES: [f64; 4] = [1e-2, 1e-4, 1e-6, 1e-8];
/// The accuracies that advice is given for.
const ACCURACIES: [f64; 2] = [0.01, 0.001];
const INDENT: &str = "    ";

impl fmt::Display for Measurements {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.scene.name())?;
        write_ladder(&self.ladder, f)?;
        write_models(self, f)?;
        write_work(self, f)?;
        write_settled(self, f)?;
        write_advice(self, f)
    }
}

fn write_ladder(ladder: &Ladder, f: &mut Formatter<'_>) -> fmt::Result {
    writeln!(f, "  discretisation: errors compared with {}, rms over {LOADS} loads", ladder.against)?;
    write_row("points", 13, QUANTITIES, f)?;
    let entry = |error| or_dash(error, percent);
    ladder.rungs.iter().try_for_each(|rung| write_row(&points(rung.shape), 13, rung.errors.map(entry), f))?;
    write_row("order", 13, ladder.orders().map(|order| or_dash(order, |order| format!("{order:.1}"))), f)
}

fn write_models(findings: &Measurements, f: &mut Formatter<'_>) -> fmt::Result {
    writeln!(f, "  model: relative errors of the predictions")?;
    write_row("theory", 13, &QUANTITIES[..BEST], f)?;
    let entry = |error| or_dash(error, |error| format!("{:+.2} %", 100.0 * error));
    findings.models.iter().try_for_each(|model| write_row(model.theory, 13, &model.errors.map(entry)[..BEST], f))
}

/// Writes a line of a table: a name, and entries that each fill a given number of columns.
fn write_row(
    name: &str,
    width: usize,
    entries: impl IntoIterator<Item = impl fmt::Display>,
    f: &mut Formatter<'_>,
) -> fmt::Result {
    write!(f, "{INDENT}{name:<28}")?;
    entries.into_iter().try_for_each(|entry| write!(f, " {entry:>width$}"))?;
    writeln!(f)
}

/// Seconds with their spread and transforms to reach the milestones on the finest grid.
fn write_work(findings: &Measurements, f: &mut Formatter<'_>) -> fmt::Result {
    let Some(ConvergenceCurve { shape, reference_eta, .. }) = findings.finest().next() else { return Ok(()) };
    writeln!(
        f,
        "  algebraic: ms (half the spread in %) and transforms to eta, {} points; L2 error of p at the end, for eta \
         {:.0e}",
        points(*shape),
        reference_eta
    )?;
    let [a, b, c, d] = MILESTONES.map(|eta| format!("eta {eta:.0e}"));
    writeln!(f, "{INDENT}{:<28} {a:>18} {b:>18} {c:>18} {d:>18} {:>8}", "solver", "L2 of p")?;
    for curve in findings.finest() {
        let [a, b, c, d] = MILESTONES.map(|eta| work(curve, eta));
        let last = or_dash(curve.points.last(), |point| format!("{:.0e}", point.pressure_error));
        writeln!(f, "{INDENT}{:<28} {a:>18} {b:>18} {c:>18} {d:>18} {last:>8}", curve.rival.title)?;
    }
    Ok(())
}

fn work(curve: &ConvergenceCurve, eta: f64) -> String {
    let Some(point) = curve.reaching(eta) else { return "-".into() };
    let (least, most) = (point.seconds[0], point.seconds[point.seconds.len() - 1]);
    let spread = 50.0 * (most - least) / point.median();
    format!("{} ({spread:.0}) {:>5}", milliseconds(point.median()), point.transforms)
}

/// Seconds as milliseconds with three digits or more.
fn milliseconds(seconds: f64) -> String {
    let milliseconds = 1e3 * seconds;
    let decimals = (2.0 - milliseconds.log10().floor()).clamp(0.0, 3.0) as usize;
    format!("{milliseconds:.decimals$}")
}

fn write_settled(findings: &Measurements, f: &mut Formatter<'_>) -> fmt::Result {
    writeln!(
        f,
        "  when to stop: the largest eta from which on a quantity stays within 1 % / 0.1 % of its final value"
    )?;
    write_row("solver", 19, &QUANTITIES[..BEST], f)?;
    findings.finest().try_for_each(|curve| {
        let settled = |quantity, accuracy| or_dash(settled(curve, quantity, accuracy), certificate);
        let entry = |quantity| ACCURACIES.map(|accuracy| settled(quantity, accuracy)).join(" / ");
        write_row(curve.rival.title, 19, (0..BEST).map(entry), f)
    })
}

/// The largest certificate from which on `quantity` stays within `accuracy` of its final value.
fn settled(curve: &ConvergenceCurve, quantity: usize, accuracy: f64) -> Option<f64> {
    let is_settled = |&i: &usize| curve.error_from(i, quantity).is_some_and(|error| error <= accuracy);
    (0..curve.points.len()).find(is_settled).map(|i| curve.points[i].eta)
}

fn write_advice(findings: &Measurements, f: &mut Formatter<'_>) -> fmt::Result {
    writeln!(f, "  recommended: the fastest of the measured runs, total error = discretisation + algebraic")?;
    for (quantity, name) in QUANTITIES.iter().take(BEST).enumerate() {
        for accuracy in ACCURACIES {
            write!(f, "{INDENT}for {name} to {} % ", 100.0 * accuracy)?;
            let all = || choices(findings, quantity);
            let is_enough = |choice: &Candidate<'_>| choice.total() <= accuracy;
            match all().filter(is_enough).min_by(|a, b| a.point.median().total_cmp(&b.point.median())) {
                Some(choice) => writeln!(f, "{}", choice.sentence())?,
                None => {
                    let best = or_dash(all().map(|choice| choice.total()).min_by(f64::total_cmp), percent);
                    writeln!(f, "use a finer grid: the best of these grids has {best}")?;
                }
            }
        }
    }
    Ok(())
}

/// A solver on a grid, stopped at a point, with its errors in a quantity.
struct Candidate<'a> {
    curve: &'a ConvergenceCurve,
    point: &'a ConvergencePoint,
    discretisation: f64,
    algebraic: f64,
}

/// All points that were measured.
fn choices(findings: &Measurements, quantity: usize) -> impl Iterator<Item = Candidate<'_>> {
    findings.curves.iter().flat_map(move |curve| {
        let discretisation = findings.ladder.error_from(curve.shape[1], quantity);
        let choice = move |(i, point)| {
            let algebraic = curve.error_from(i, quantity)?;
            Some(Candidate { curve, point, discretisation: discretisation?, algebraic })
        };
        curve.points.iter().enumerate().filter_map(choice)
    })
}

impl Candidate<'_> {
    fn total(&self) -> f64 {
        self.discretisation + self.algebraic
    }

    fn sentence(&self) -> String {
        format!(
            "use {} points, eta = {}: {} ms by {} ({:.2} + {:.2} %)",
            points(self.curve.shape),
            certificate(self.point.eta),
            milliseconds(self.point.median()),
            self.curve.rival.title,
            100.0 * self.discretisation,
            100.0 * self.algebraic
        )
    }
}

fn percent(value: f64) -> String {
    if value >= 1e-4 { format!("{:.2} %", 100.0 * value) } else { format!("{:.0e} %", 100.0 * value) }
}

/// A certificate, rounded down: who stops there has come as far as the point that was found.
fn certificate(eta: f64) -> String {
    let unit = 10f64.powf(eta.log10().floor() - 1.0);
    format!("{:.1e}", (eta / unit).floor() * unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn certificates_are_rounded_down_and_times_keep_their_digits() {
        assert_eq!([certificate(1.29e-3), certificate(9.99e-7), certificate(0.5)], ["1.2e-3", "9.9e-7", "5.0e-1"]);
        let shown = [1.23456, 0.0123456, 1.23456e-4, 1.2e-7].map(milliseconds);
        assert_eq!(shown, ["1235", "12.3", "0.123", "0.000"]);
    }
}
