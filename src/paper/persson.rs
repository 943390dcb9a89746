//! Beyond the paper: the pressures of lines and surfaces beside Persson's theory, and the contact stiffness.
//!
//! The mean square of the pressure in contact is `c` times the square of its mean, `P/a_rel`, so that
//!
//! ```text
//! kappa = a_rel/p* = c P^2 / (p* <p^2>),    <p^2> = P^2 + the integral of (E* q/2)^2 C(q) W(q)
//! ```
//!
//! exactly: `kappa` drifts with the load if the shape of the distribution does, `c`, or if the waves are pressed flat otherwise
//! than in Persson's theory, `W(q)`, for which `kappa` is level.

use super::measure::{Measure, ObservableFn};
use super::reproduction::{Ramp, RampCurve, Reproduction, captions};
use super::rough::{Rough, shade};
use super::verdict::Verdict;
use crate::contact::Contact;
use crate::plot::{Axis, AxisScale, Colour, Dot, Mark, Panel, Symbol};
use crate::study::{Estimate, Point, Realisation, Spread};
use crate::surface::PowerSpectrum;
use crate::theory::persson::Pressures;
use serde::Serialize;
use std::f64::consts::PI;

/// Largest number of profiles of lines, and of surfaces, per Hurst exponent.
const LINES: usize = 4;
const SURFACES: usize = 2;
/// Loads, about.
const LOADS: usize = 6;
/// Bins of the pressure, and the largest one over its mean in contact.
const BINS: usize = 40;
const LARGEST: f64 = 4.0;
/// Bins of the wavenumber per octave.
const BINS_PER_OCTAVE: f64 = 2.0;

/// The area, and `kappa`, of contacts.
const AREA: ObservableFn = Measure::Resolved.area();
const KAPPA: ObservableFn = Measure::Resolved.kappa();

/// A contact as it is compared.
pub(crate) struct Seen {
    point: Point,
    /// Density of the pressure in contact over its mean there, in equal bins.
    density: Vec<f64>,
    /// Variance of the pressure by bins of the wavenumber: found, of Persson's theory, and in full contact.
    waves: Vec<[f64; 3]>,
    /// Mean square of the pressure, found and of Persson's theory.
    mean_square: [f64; 2],
}

impl Seen {
    /// What is seen of a contact.
    pub(crate) fn new(point: &Point, contact: &Contact) -> Self {
        let (mean, modulus) = (contact.mean_pressure(), contact.problem.contact_modulus());
        let heights = PowerSpectrum::new(contact.problem.surface());
        let (found, theory) = (contact.pressure_spectrum(), Pressures::spectrum(mean, modulus, &heights));
        let area = AREA(&point.observables);
        let scale = mean / area;
        let distribution = contact.pressure_distribution(BINS, LARGEST * scale);
        let square = mean * mean;
        Self {
            point: point.clone(),
            density: distribution.density.iter().map(|density| density * scale / area).collect(),
            waves: by_octaves(point, &heights, [&found, &theory], modulus),
            mean_square: [&found, &theory].map(|spectrum| square + spectrum.integral(|_, density| density)),
        }
    }

    /// `c`, the mean square of the pressure in contact over the square of its mean.
    fn shape(&self) -> f64 {
        AREA(&self.point.observables) * self.mean_square[0] / self.point.observables.mean_pressure.powi(2)
    }
}

/// Variances by bins of the wavenumber, up to the short cut-off.
fn by_octaves(point: &Point, heights: &PowerSpectrum, spectra: [&PowerSpectrum; 2], modulus: f64) -> Vec<[f64; 3]> {
    let mut bins: Vec<[f64; 3]> = Vec::new();
    let shortest = point.short_cutoff.unwrap_or(0.0);
    for (i, &q) in heights.wavenumber.iter().enumerate().filter(|(_, q)| **q * shortest < 2.0 * PI) {
        let bin = (BINS_PER_OCTAVE * (q / heights.wavenumber[0]).log2()).round() as usize;
        if bins.len() <= bin {
            bins.resize(bin + 1, [0.0; 3]);
        }
        let full = (0.5 * modulus * q).powi(2) * heights.density[i];
        let variances = [spectra[0].density[i], spectra[1].density[i], full];
        bins[bin].iter_mut().zip(variances).for_each(|(sum, variance)| *sum += variance * heights.measure[i]);
    }
    bins
}

/// Some of the lines, on their finest grid, and some of the surfaces, on their coarsest.
pub(crate) fn realisations([lines, surfaces]: [&Rough; 2]) -> Vec<Realisation> {
    let few = |rough: &Rough, grid: usize, count: usize| Rough {
        points: vec![rough.points[grid]],
        seeds: vec![rough.seeds_on(grid).iter().take(count).copied().collect()],
        loads: lines.loads.iter().step_by((lines.loads.len() / LOADS).max(1)).copied().collect(),
        ..rough.clone()
    };
    let (lines, surfaces) = (few(lines, lines.points.len() - 1, LINES), few(surfaces, 0, SURFACES));
    lines.lines().into_iter().chain(surfaces.surfaces()).collect()
}

/// The realisations of lines or of surfaces of one Hurst exponent, each under its loads.
struct Ensemble<'a> {
    hurst: f64,
    is_line: bool,
    all: Vec<&'a [Seen]>,
}

/// The groups of what is seen, lines first.
fn groups(seen: &[Vec<Seen>]) -> Vec<Ensemble<'_>> {
    let mut groups: Vec<Ensemble<'_>> = Vec::new();
    for seen in seen.iter().filter(|seen| seen.iter().all(|it| it.point.is_resolved())) {
        let Some(Point { ny, hurst: Some(hurst), .. }) = seen.first().map(|it| &it.point) else { continue };
        match groups.last_mut() {
            Some(group) if (group.hurst, group.is_line) == (*hurst, *ny == 1) => group.all.push(seen),
            _ => groups.push(Ensemble { hurst: *hurst, is_line: *ny == 1, all: vec![seen] }),
        }
    }
    groups
}

impl Ensemble<'_> {
    fn name(&self) -> String {
        format!("{}, H = {}", if self.is_line { "lines" } else { "surfaces" }, self.hurst)
    }

    /// What is seen under a load by its number, realisation by realisation.
    fn under(&self, load: usize) -> impl Iterator<Item = &Seen> {
        self.all.iter().filter_map(move |seen| seen.get(load))
    }

    /// The numbers of the loads.
    fn loads(&self) -> std::ops::Range<usize> {
        0..self.all.first().map_or(0, |seen| seen.len())
    }

    /// The reduced pressure of a load.
    fn pressure(&self, load: usize) -> f64 {
        self.under(load).next().map_or(f64::NAN, |it| it.point.observables.reduced_pressure)
    }

    /// The mean over realisations of a number under a load.
    fn mean(&self, load: usize, of: impl Fn(&Seen) -> f64) -> f64 {
        Spread::from_values(self.under(load).map(of)).mean
    }

    /// Variances by bins of the wavenumber, summed over realisations.
    fn waves(&self, load: usize) -> Vec<[f64; 3]> {
        let mut sums: Vec<[f64; 3]> = Vec::new();
        for waves in self.under(load).map(|it| &it.waves) {
            sums.resize(sums.len().max(waves.len()), [0.0; 3]);
            sums.iter_mut().zip(waves).for_each(|(sum, wave)| (0..3).for_each(|i| sum[i] += wave[i]));
        }
        sums
    }

    /// Around each load but the first and the last: the load, the stiffness `-dp/d<g>` over `p/h_rms`, the gain of elastic energy
    /// over the work of the load, from the load before to the one after it, and by how much that is off for lack of loads.
    fn steps(&self) -> Vec<[Estimate; 4]> {
        let steps: Vec<Vec<[f64; 4]>> = self.all.iter().map(|seen| seen.windows(3).map(step).collect()).collect();
        let count = self.loads().len().saturating_sub(2);
        (0..count).map(|i| [0, 1, 2, 3].map(|j| Estimate::from_values(steps.iter().map(|steps| steps[i][j])))).collect()
    }
}

/// Load, stiffness, energy over work and its error, as [`Ensemble::steps`], of one contact under three loads.
///
/// The mean gap is a parabola in `x = ln p` through the three, of slope `a + b x`, so that the work is the integral of
/// `-e^x (a + b x)`. With straight lines from load to load, each of a logarithmic mean pressure, it is another: the error.
fn step(three: &[Seen]) -> [f64; 4] {
    let at = [0, 1, 2].map(|i| three[i].point.observables);
    let x = at.map(|it| (it.mean_pressure / at[1].mean_pressure).ln());
    let slope = |i: usize| (at[i + 1].mean_gap - at[i].mean_gap) / (x[i + 1] - x[i]);
    let bend = (slope(1) - slope(0)) / (x[2] - x[0]);
    let [a, b] = [slope(0) - bend * x[0], 2.0 * bend];
    let integral = |x: f64| x.exp() * (a + b * (x - 1.0));
    let work = at[1].mean_pressure * (integral(x[0]) - integral(x[2]));
    let straight = |i: usize| (at[i].mean_pressure - at[i + 1].mean_pressure) * slope(i);
    let gain = at[2].elastic_energy - at[0].elastic_energy;
    let error = gain / work - gain / (straight(0) + straight(1));
    [at[1].reduced_pressure, -at[1].rms_height / a, gain / work, error.abs()]
}

/// The pressures of a group under one load.
#[derive(Serialize)]
pub(crate) struct PressureRow {
    name: &'static str,
    hurst: f64,
    reduced_pressure: f64,
    realisations: usize,
    kappa: f64,
    /// `c`, the mean square of the pressure in contact over the square of its mean.
    shape: f64,
    /// Mean square of the pressure over that of Persson's theory.
    mean_square_over_persson: f64,
    /// The stiffness `-dp/d<g>` over `p/h_rms`; none at the ends of the curve.
    stiffness: Option<f64>,
    /// The gain of elastic energy over the work of the load, from the load before to the next.
    energy_over_work: Option<f64>,
}

/// The pressures of all groups under all loads.
pub(crate) fn rows(seen: &[Vec<Seen>]) -> Vec<PressureRow> {
    let rows = |group: Ensemble<'_>| {
        let steps = group.steps();
        let around = |load: usize| load.checked_sub(1).and_then(|step| steps.get(step));
        let row = |load: usize| PressureRow {
            name: if group.is_line { "rough line" } else { "rough surface" },
            hurst: group.hurst,
            reduced_pressure: group.pressure(load),
            realisations: group.all.len(),
            kappa: group.mean(load, |it| KAPPA(&it.point.observables)),
            shape: group.mean(load, Seen::shape),
            mean_square_over_persson: group.mean(load, |it| it.mean_square[0] / it.mean_square[1]),
            stiffness: around(load).map(|step| step[1].mean),
            energy_over_work: around(load).map(|step| step[2].mean),
        };
        group.loads().map(row).collect::<Vec<_>>()
    };
    groups(seen).into_iter().flat_map(rows).collect()
}

/// A bin of the pressure or of the wavenumber of a group under one load.
#[derive(Serialize)]
pub(crate) struct CurveRow {
    name: &'static str,
    hurst: f64,
    reduced_pressure: f64,
    /// `pressure` or `wave`.
    curve: &'static str,
    /// The pressure over its mean in contact, or the wavenumber over that of the longest wave; the middle of the bin.
    at: f64,
    /// The density in contact, or `W(q)`, the power of the pressure over that in full contact.
    found: f64,
    /// The same of Persson's theory.
    persson: f64,
}

/// Distributions and spectra of all groups under all loads.
pub(crate) fn curves(seen: &[Vec<Seen>]) -> Vec<CurveRow> {
    let mut rows = Vec::new();
    for group in groups(seen) {
        let name = if group.is_line { "rough line" } else { "rough surface" };
        for load in group.loads() {
            let (hurst, reduced_pressure) = (group.hurst, group.pressure(load));
            let row = |curve, at, found, persson| CurveRow { name, hurst, reduced_pressure, curve, at, found, persson };
            rows.extend(density(&group, load).into_iter().map(|(x, found)| row("pressure", x, found, light(x))));
            let waves = group.waves(load).into_iter().enumerate().filter(|(_, [.., full])| *full > 0.0);
            rows.extend(waves.map(|(i, [found, theory, full])| row("wave", middle(i), found / full, theory / full)));
        }
    }
    rows
}

/// The density of the pressure in contact over its mean there.
fn density(group: &Ensemble<'_>, load: usize) -> Vec<(f64, f64)> {
    let bin = |i: usize| (LARGEST * (i as f64 + 0.5) / BINS as f64, group.mean(load, |it| it.density[i]));
    (0..BINS).map(bin).collect()
}

/// The same of Persson's theory at light loads.
fn light(x: f64) -> f64 {
    0.5 * PI * x * (-0.25 * PI * x * x).exp()
}

/// The wavenumber of a bin over that of the longest wave.
fn middle(bin: usize) -> f64 {
    (bin as f64 / BINS_PER_OCTAVE).exp2()
}

/// The figure, and the work of the load.
pub(crate) fn reproduce(seen: &[Vec<Seen>]) -> Reproduction {
    let groups = groups(seen);
    let [lines, surfaces]: [Vec<&Ensemble<'_>>; 2] =
        [true, false].map(|is_line| groups.iter().filter(|group| group.is_line == is_line).collect());
    let ratio = |it: &Seen| it.mean_square[0] / it.mean_square[1];
    let panels = vec![
        densities("(a) pressures of lines", &lines),
        densities("(b) pressures of surfaces", &surfaces),
        waves("(c) W(q) of lines", &lines),
        waves("(d) W(q) of surfaces", &surfaces),
        along("(e) waves pressed flat", "⟨p²⟩ over Persson's", [0.3, 1.0], &groups, &ratio),
        along("(f) shape of the distribution", "⟨p²⟩/⟨p⟩² in contact", [1.1, 1.6], &groups, &Seen::shape),
        between("(g) contact stiffness", "−dp/d⟨g⟩ over p/h_rms", [1.5, 4.5], &groups, 1),
        between("(h) −dU/d⟨g⟩ over p", "energy over work", [0.98, 1.02], &groups, 2),
    ];
    let work = |key, groups: &[&Ensemble<'_>]| {
        let steps: Vec<_> = groups.iter().flat_map(|group| group.steps()).collect();
        let over = |i: usize| Estimate::from_values(steps.iter().map(|step| step[i].mean));
        Verdict::number(key, "", Estimate { grid: over(3).mean, ..over(2) })
    };
    let verdicts = vec![work("persson.line", &lines), work("persson.surface", &surfaces)];
    Reproduction::new(
        "Pressures of lines and surfaces beside Persson's theory",
        panels,
        ramp(&groups, &ratio),
        verdicts,
    )
}

/// Marks of the lightest and the heaviest load.
fn ends<'a>(group: &'a Ensemble<'_>) -> impl Iterator<Item = (usize, Mark)> + use<'a> {
    let last = group.loads().len().saturating_sub(1);
    [(0, Mark::Line), (last, Mark::Dashed)].into_iter().filter(move |(load, _)| group.loads().contains(load))
}

fn densities(title: &str, groups: &[&Ensemble<'_>]) -> Panel {
    let [x, y] = [Axis::linear("p over its mean in contact", [0.0, LARGEST]), Axis::log("density", [3e-4, 2.0])];
    let mut panel = Panel::new(title, x, y);
    panel.add_curve("Persson, light load", Colour::BLACK, Mark::Dotted, light);
    for (i, group) in groups.iter().enumerate() {
        for (load, mark) in ends(group) {
            let name = format!("H = {}, p* = {:.0e}", group.hurst, group.pressure(load));
            panel.add(name, shade(i), mark, density(group, load).into_iter().map(|(x, y)| Dot::at(x, y)));
        }
    }
    panel
}

fn waves(title: &str, groups: &[&Ensemble<'_>]) -> Panel {
    let bins = groups.iter().map(|group| group.waves(0).len()).max().unwrap_or(1);
    let x = Axis::log("q over that of the longest wave", [0.8, 1.3 * middle(bins)]);
    let mut panel = Panel::new(title, x, Axis::log("found over Persson's", [0.02, 3.0]));
    panel.add_curve("", Colour::BLACK, Mark::Dotted, |_| 1.0);
    for (i, group) in groups.iter().enumerate() {
        for (load, mark) in ends(group) {
            let name = format!("H = {}, p* = {:.0e}", group.hurst, group.pressure(load));
            let waves = group.waves(load).into_iter().enumerate().filter(|(_, [.., full])| *full > 0.0);
            panel.add(name, shade(i), mark, waves.map(|(i, [found, theory, _])| Dot::at(middle(i), found / theory)));
        }
    }
    panel
}

/// Mark and colour of a group among all: lines are filled.
fn style(groups: &[Ensemble<'_>], group: &Ensemble<'_>) -> (Colour, Mark) {
    let mut exponents: Vec<f64> = groups.iter().map(|group| group.hurst).collect();
    exponents.sort_unstable_by(f64::total_cmp);
    exponents.dedup();
    let number = exponents.iter().position(|&hurst| hurst == group.hurst).unwrap_or(0);
    let symbol = if group.is_line { Symbol::Circle } else { Symbol::Square };
    (shade(number), Mark::Joined { symbol, filled: group.is_line })
}

fn load_axis(groups: &[Ensemble<'_>]) -> Axis {
    let loads = || groups.iter().flat_map(|group| group.loads().map(|load| group.pressure(load)));
    Axis::log("p*", [loads().fold(f64::INFINITY, f64::min) / 1.3, loads().fold(0.0, f64::max) * 1.3])
}

/// A number of each contact against the load, averaged over the realisations of each group.
fn along(title: &str, name: &str, range: [f64; 2], groups: &[Ensemble<'_>], of: &dyn Fn(&Seen) -> f64) -> Panel {
    let mut panel = Panel::new(title, load_axis(groups), Axis::linear(name, range));
    for group in groups {
        let (colour, mark) = style(groups, group);
        let dot = |load| {
            let Spread { mean, deviation, .. } = Spread::from_values(group.under(load).map(of));
            Dot { x: group.pressure(load), y: mean, spread: deviation }
        };
        panel.add(group.name(), colour, mark, group.loads().map(dot));
    }
    panel
}

/// A number of the steps from load to load.
fn between(title: &str, name: &str, range: [f64; 2], groups: &[Ensemble<'_>], number: usize) -> Panel {
    let mut panel = Panel::new(title, load_axis(groups), Axis::linear(name, range));
    for group in groups {
        let (colour, mark) = style(groups, group);
        let dot = |step: [Estimate; 4]| {
            let it = step[number];
            Dot { x: step[0].mean, y: it.mean, spread: it.scatter }
        };
        panel.add(group.name(), colour, mark, group.steps().into_iter().map(dot));
    }
    panel
}

/// `kappa` and the two factors that it is made of, against the load; no contacts.
fn ramp(groups: &[Ensemble<'_>], ratio: &dyn Fn(&Seen) -> f64) -> Ramp {
    let loads: Vec<f64> =
        groups.first().map_or(Vec::new(), |group| group.loads().map(|load| group.pressure(load)).collect());
    let curves = |view: &'static str, of: &dyn Fn(&Seen) -> f64| {
        let curve = |group: &Ensemble<'_>| {
            let (colour, _) = style(groups, group);
            RampCurve::new(view, group.name(), colour, group.loads().map(|load| group.mean(load, of)))
        };
        groups.iter().map(curve).collect::<Vec<_>>()
    };
    let kappa = curves("κ", &|it| KAPPA(&it.point.observables));
    let square = curves("⟨p²⟩ over Persson's", ratio);
    Ramp {
        captions: captions("p*", &loads),
        quantity: ("p*", AxisScale::Log),
        cursor: loads,
        curves: kappa.into_iter().chain(square).chain(curves("⟨p²⟩/⟨p⟩² in contact", &Seen::shape)).collect(),
        contacts: Vec::new(),
        length_unit: "",
    }
}
