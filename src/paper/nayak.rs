//! Beyond the paper: whether `kappa` and `kappa_r` depend on the breadth of the spectrum, Nayak's parameter, at equal gradient.
//!
//! In Persson's theory the area depends on the load and the rms gradient alone. In that of Bush, Gibson and Thomas, and in the
//! computations of Yastrebov, Anciaux and Molinari (2017, arXiv:1704.05650), it falls with Nayak's parameter `alpha`.
//! The same `alpha` comes from a low Hurst exponent and many octaves or from a high one and few: if both have the same `kappa`,
//! `alpha` is enough to tell it.

use super::breadths::Breadths;
use super::means::Points;
use super::measure::{Measure, ObservableFn};
use super::nayak_trend::{BreadthTrend, SolvedBreadth, SolvedBreadths};
use super::reproduction::{Ramp, RampCurve, Reproduction, captions};
use super::rough::shade;
use super::verdict::{StatementVerdict, Verdict};
use crate::error::SetupError;
use crate::plot::{Axis, AxisScale, Colour, Dot, Mark, Panel, Symbol};
use crate::study::Estimate;
use crate::theory::{BushGibsonThomas, persson};
use serde::Serialize;

/// The load whose values are compared is the one nearest to this reduced pressure.
const SHOWN: f64 = 1e-2;
/// Nayak's parameters along the axes.
const AXIS: [f64; 2] = [1.5, 400.0];
/// The narrowest spectrum of the curve of Bush, Gibson and Thomas, and its points.
const NARROWEST: f64 = 1.6;
const CURVE: i32 = 40;
/// The number of spectra whose curves against the load are shown.
const CURVES: usize = 3;

const KAPPA: ObservableFn = Measure::Resolved.kappa();
const KAPPA_R: ObservableFn = Measure::Resolved.kappa_r();
/// Both, with their names.
const QUANTITIES: [(&str, &str, ObservableFn); 2] = [("kappa", "κ", KAPPA), ("kappa_r", "κ_r", KAPPA_R)];

/// The factors of a spectrum under a load, in the continuum.
#[derive(Serialize)]
pub(crate) struct BreadthRow {
    name: &'static str,
    hurst: f64,
    /// Nayak's parameter of the spectrum.
    nayak_of_spectrum: f64,
    /// Mean over the realisations, and the standard deviation of one.
    nayak: f64,
    nayak_deviation: f64,
    short_cutoff_over_rolloff: f64,
    /// Roll-off wavelengths along a side of the cell.
    rolloffs: f64,
    /// Points along a side of the finest grid.
    points: usize,
    reduced_pressure: f64,
    kappa: f64,
    kappa_error: f64,
    kappa_grid_error: f64,
    kappa_r: f64,
    kappa_r_error: f64,
    kappa_r_grid_error: f64,
}

/// The factors of all spectra under all loads.
pub(crate) fn rows(all: &[SolvedBreadths<'_>]) -> Vec<BreadthRow> {
    let row = |name, it: &SolvedBreadth, load: f64| {
        let [kappa, kappa_r] = [KAPPA, KAPPA_R].map(|quantity| it.limit(load, quantity));
        BreadthRow {
            name,
            hurst: it.hurst,
            nayak_of_spectrum: it.wanted,
            nayak: it.nayak.mean,
            nayak_deviation: it.nayak.deviation,
            short_cutoff_over_rolloff: it.cutoff,
            rolloffs: it.waves,
            points: it.grids.last().copied().unwrap_or(0),
            reduced_pressure: load,
            kappa: kappa.mean,
            kappa_error: kappa.error,
            kappa_grid_error: kappa.grid,
            kappa_r: kappa_r.mean,
            kappa_r_error: kappa_r.error,
            kappa_r_grid_error: kappa_r.grid,
        }
    };
    let of = |group: &SolvedBreadths<'_>| {
        let pairs = group.all.iter().flat_map(|it| group.breadths.loads.iter().map(move |&load| (it, load)));
        pairs.map(|(it, load)| row(group.name(), it, load)).collect::<Vec<_>>()
    };
    all.iter().flat_map(of).collect()
}

/// A change of a factor from spectrum to spectrum.
#[derive(Serialize)]
pub(crate) struct TrendRow {
    name: &'static str,
    quantity: &'static str,
    /// `per decade` of Nayak's parameter at one Hurst exponent, or `at equal alpha`: the highest exponent less the lowest.
    change: &'static str,
    hurst: Option<f64>,
    nayak_from: f64,
    nayak_to: f64,
    reduced_pressure: f64,
    percent: f64,
    error: f64,
    grid_error: f64,
}

/// All changes under all loads.
pub(crate) fn trends(all: &[SolvedBreadths<'_>]) -> Vec<TrendRow> {
    let mut rows = Vec::new();
    for group in all {
        for (quantity, _, of) in QUANTITIES {
            for &load in &group.breadths.loads {
                let row = |change, hurst, BreadthTrend { percent, between }: BreadthTrend| TrendRow {
                    name: group.name(),
                    quantity,
                    change,
                    hurst,
                    nayak_from: between[0],
                    nayak_to: between[1],
                    reduced_pressure: load,
                    percent: percent.mean,
                    error: percent.error,
                    grid_error: percent.grid,
                };
                for &hurst in &group.breadths.hurst {
                    rows.extend(group.per_decade(hurst, load, of).map(|it| row("per decade", Some(hurst), it)));
                }
                rows.extend(group.at_equal_nayak(load, of).map(|it| row("at equal alpha", None, it)));
            }
        }
    }
    rows
}

/// The solved points of lines and of surfaces, by their spectra.
///
/// # Errors
/// For surfaces that cannot be.
pub(crate) fn spectra<'a>(both: [&'a Breadths; 2], points: &Points) -> Result<Vec<SolvedBreadths<'a>>, SetupError> {
    both.into_iter().map(|breadths| SolvedBreadths::new(breadths, points)).collect()
}

/// The figure, and whether Nayak's parameter and the Hurst exponent matter.
pub(crate) fn reproduce(all: &[SolvedBreadths<'_>]) -> Reproduction {
    let panels = all.iter().flat_map(|group| {
        QUANTITIES.map(|(quantity, sign, of)| against_breadth(group, quantity, sign, of)).into_iter()
    });
    let panels = panels.chain(all.iter().map(against_load)).chain(all.iter().map(changes));
    let named = |(i, mut panel): (usize, Panel)| {
        panel.title = format!("({}) {}", char::from(b'a' + i as u8), panel.title);
        panel
    };
    let panels: Vec<Panel> = panels.enumerate().map(named).collect();
    let verdicts = all.iter().flat_map(|group| {
        QUANTITIES.iter().flat_map(move |&(quantity, _, of)| {
            [breadth_matters(group, quantity, of), hurst_matters(group, quantity, of)].into_iter().flatten()
        })
    });
    let title = "κ and κ_r against Nayak's parameter α at equal rms gradient, in the continuum";
    Reproduction::new(title, panels, ramp(all), verdicts.collect())
}

/// The load that is compared.
fn shown(group: &SolvedBreadths<'_>) -> f64 {
    let nearest = |a: &&f64, b: &&f64| (*a / SHOWN).ln().abs().total_cmp(&(*b / SHOWN).ln().abs());
    group.breadths.loads.iter().min_by(nearest).copied().unwrap_or(f64::NAN)
}

/// Whether a factor is the same at all breadths.
fn breadth_matters(group: &SolvedBreadths<'_>, quantity: &str, of: ObservableFn) -> Option<Verdict> {
    let load = shown(group);
    let slopes =
        group.breadths.hurst.iter().rev().filter_map(|&hurst| Some((hurst, group.per_decade(hurst, load, of)?)));
    let slopes: Vec<(f64, BreadthTrend)> = slopes.collect();
    let words = slopes.iter().map(|(hurst, it)| {
        let [low, high] = it.between;
        format!("H = {hurst}: {}, α {low:.1} to {high:.0}", change(it))
    });
    let words = format!("per decade of α at p* = {load}: {}", words.collect::<Vec<_>>().join("; "));
    let key = format!("nayak.{}.{quantity}.alpha", group.name());
    let answer = StatementVerdict::all(slopes.iter().map(|(_, it)| StatementVerdict::is_constant(it.percent)));
    (!slopes.is_empty()).then(|| Verdict::statement(&key, words, answer))
}

/// Whether a factor is the same at two Hurst exponents of equal breadth.
fn hurst_matters(group: &SolvedBreadths<'_>, quantity: &str, of: ObservableFn) -> Option<Verdict> {
    let load = shown(group);
    let (ends, it) = (group.ends()?, group.at_equal_nayak(load, of)?);
    let ([lowest, highest], [low, high]) = (ends, it.between);
    let words = format!("at p* = {load} H = {highest} less {lowest}: {}, α {low:.1} to {high:.0}", change(&it));
    let key = format!("nayak.{}.{quantity}.hurst", group.name());
    Some(Verdict::statement(&key, words, StatementVerdict::is_constant(it.percent)))
}

/// A change in per cent and standard errors.
fn change(it: &BreadthTrend) -> String {
    format!("{:+.2} ± {:.2} %, {:+.1} σ", it.percent.mean, it.percent.uncertainty(), it.sigma())
}

/// Symbol and colour of a Hurst exponent.
fn style(group: &SolvedBreadths<'_>, hurst: f64) -> (Symbol, Colour) {
    let number = group.breadths.hurst.iter().position(|it| *it == hurst).unwrap_or(0);
    (Symbol::of_curve(number), shade(number))
}

fn dot(x: f64, it: Estimate) -> Dot {
    Dot { x, y: it.mean, spread: it.uncertainty() }
}

/// A factor against Nayak's parameter under the load that is compared.
fn against_breadth(group: &SolvedBreadths<'_>, quantity: &str, sign: &str, of: ObservableFn) -> Panel {
    let load = shown(group);
    let is_area = quantity == "kappa";
    let range = match (is_area, group.breadths.is_line) {
        (true, true) => [1.5, 3.5],
        (true, false) => [1.0, 2.6],
        _ => [1.6, 2.0],
    };
    let title = format!("{sign} of {}s, p* = {load}", group.name());
    let mut panel = Panel::new(title, Axis::log("Nayak's parameter α", AXIS), Axis::linear(sign, range));
    if is_area {
        let area = persson::relative_area(load) / load;
        panel.add_curve("Persson", Colour::BLACK, Mark::Dotted, |_| area);
    }
    if is_area && !group.breadths.is_line {
        let place = |i: i32| NARROWEST * (AXIS[1] / NARROWEST).powf(f64::from(i) / f64::from(CURVE - 1));
        let dot = |nayak: f64| Dot::at(nayak, BushGibsonThomas { nayak }.kappa(load));
        panel.add("Bush, Gibson, Thomas", Colour::GREY, Mark::Dashed, (0..CURVE).map(place).map(dot));
        panel.add_curve("the same, p* to 0", Colour::GREY, Mark::Dotted, |_| persson::KAPPA_BGT);
    }
    for &hurst in &group.breadths.hurst {
        let (symbol, colour) = style(group, hurst);
        let dots = group.at_hurst(hurst).map(|it| dot(it.nayak.mean, it.limit(load, of)));
        panel.add(format!("H = {hurst}"), colour, Mark::Joined { symbol, filled: true }, dots);
    }
    panel
}

/// `kappa` of the highest Hurst exponent against the load, of some breadths.
fn against_load(group: &SolvedBreadths<'_>) -> Panel {
    let hurst = group.breadths.hurst.last().copied().unwrap_or(f64::NAN);
    let range = if group.breadths.is_line { [1.2, 3.5] } else { [0.8, 2.6] };
    let title = format!("κ of {}s against the load, H = {hurst}", group.name());
    let mut panel = Panel::new(title, load_axis(group), Axis::linear("κ", range));
    panel.add_curve("Persson", Colour::BLACK, Mark::Dotted, |load| persson::relative_area(load) / load);
    let all: Vec<&SolvedBreadth> = group.at_hurst(hurst).collect();
    let last = all.len().saturating_sub(1);
    let mut chosen: Vec<usize> = (0..CURVES).map(|i| i * last / (CURVES - 1)).collect();
    chosen.dedup();
    for (i, it) in chosen.into_iter().filter_map(|i| all.get(i)).enumerate() {
        let (nayak, loads) = (it.nayak.mean, &group.breadths.loads);
        if !group.breadths.is_line {
            let model = loads.iter().map(|&load| Dot::at(load, BushGibsonThomas { nayak }.kappa(load)));
            let name = if i == 0 { "Bush, Gibson, Thomas" } else { "" };
            panel.add(name, shade(i), Mark::Dashed, model);
        }
        let mark = Mark::Joined { symbol: Symbol::of_curve(i), filled: true };
        let dots = loads.iter().map(|&load| dot(load, it.limit(load, KAPPA)));
        panel.add(format!("α = {nayak:.1}"), shade(i), mark, dots);
    }
    panel
}

/// Changes of both factors against the load: per decade, and at equal breadth.
fn changes(group: &SolvedBreadths<'_>) -> Panel {
    let title = format!("changes of κ (filled) and κ_r of {}s", group.name());
    let range = if group.breadths.is_line { [-20.0, 6.0] } else { [-12.0, 4.0] };
    let mut panel = Panel::new(title, load_axis(group), Axis::linear("%", range));
    panel.add_curve("", Colour::BLACK, Mark::Dotted, |_| 0.0);
    for (quantity, _, of) in QUANTITIES {
        let filled = quantity == "kappa";
        let mut add = |name: String, symbol, colour, at: &dyn Fn(f64) -> Option<BreadthTrend>| {
            let dots = group.breadths.loads.iter().filter_map(|&load| Some(dot(load, at(load)?.percent)));
            let name = if filled { name } else { String::new() };
            panel.add(name, colour, Mark::Joined { symbol, filled }, dots);
        };
        for &hurst in &group.breadths.hurst {
            let (symbol, colour) = style(group, hurst);
            let at = |load| group.per_decade(hurst, load, of);
            add(format!("per decade of α, H = {hurst}"), symbol, colour, &at);
        }
        if let Some([low, high]) = group.ends() {
            let name = format!("at equal α, H = {high} less {low}");
            add(name, Symbol::Diamond, Colour::BLUE, &|load| group.at_equal_nayak(load, of));
        }
    }
    panel
}

fn load_axis(group: &SolvedBreadths<'_>) -> Axis {
    let loads = &group.breadths.loads;
    let [low, high] = [loads.first(), loads.last()].map(|load| load.copied().unwrap_or(1.0));
    Axis::log("p*", [low / 1.5, high * 1.5])
}

/// `kappa` and `kappa_r` of all spectra against the loads of the lines; no contacts.
fn ramp(all: &[SolvedBreadths<'_>]) -> Ramp {
    let loads = all.first().map_or(Vec::new(), |group| group.breadths.loads.clone());
    let curves = all.iter().flat_map(|group| group.all.iter().map(move |it| (group, it))).flat_map(|(group, it)| {
        let loads = &loads;
        QUANTITIES.map(move |(_, sign, of)| {
            let name = format!("{}, H = {}, α = {:.1}", group.name(), it.hurst, it.nayak.mean);
            RampCurve::new(sign, name, style(group, it.hurst).1, loads.iter().map(|&load| it.limit(load, of).mean))
        })
    });
    Ramp {
        captions: captions("p*", &loads),
        quantity: ("p*", AxisScale::Log),
        curves: curves.collect(),
        cursor: loads.clone(),
        contacts: Vec::new(),
        length_unit: "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{Observables, Status};
    use crate::study::{Point, Realisation};
    use crate::surface::RandomRoughness;

    fn breadths(seeds: u64) -> Breadths {
        Breadths {
            is_line: true,
            hurst: vec![0.3, 0.8],
            nayak: vec![3.0, 10.0, 30.0],
            points_per_wave: vec![4, 8, 16],
            least: 256,
            largest: 1 << 20,
            seeds: vec![(1..=seeds).collect()],
            loads: vec![0.01],
        }
    }

    /// The point of a realisation whose `kappa` is 2, less by `fall` per decade of Nayak's parameter, more by `high` at the higher
    /// Hurst exponent, and off by its seed and by the square of the spacing.
    fn point(it: &Realisation, nayak: f64, [fall, high]: [f64; 2]) -> Point {
        let (spectrum, seed) = (
            it.setup.surface.spectrum.as_ref().and_then(RandomRoughness::self_affine).unwrap(),
            it.setup.surface.seed(),
        );
        let nx = *it.setup.grid.points.last().unwrap();
        let scatter = 0.05 * (seed as f64).sin() + 0.005 * (seed as f64 * spectrum.short_cutoff * 1e9).sin();
        let kappa = 2.0 - fall * nayak.log10() + if spectrum.hurst > 0.5 { high } else { 0.0 };
        let kappa = kappa + scatter + 1e3 / (nx * nx) as f64;
        Point {
            name: it.name.clone(),
            ny: 1,
            nx,
            length: 1.0,
            hurst: Some(spectrum.hurst),
            rolloff_wavelength: spectrum.rolloff_wavelength(),
            short_cutoff: Some(spectrum.short_cutoff),
            seed: Some(seed),
            load: 1,
            tolerance: 1e-8,
            status: Status::Converged,
            setup: String::new(),
            version: String::new(),
            observables: Observables { reduced_pressure: 0.01, kappa, kappa_r: 1.7, ..Observables::default() },
            further: Vec::new(),
            seconds: 0.0,
        }
    }

    /// The verdicts on `kappa` at one gradient and at equal breadth.
    fn verdicts(breadths: &Breadths, change: [f64; 2]) -> [Verdict; 2] {
        let mut points = Vec::new();
        for it in breadths.all() {
            for grid in 0..3 {
                points.extend(breadths.on(&it, grid).iter().map(|one| point(one, it.nayak, change)));
            }
        }
        let all = SolvedBreadths::new(breadths, &Points(points)).unwrap();
        [breadth_matters(&all, "kappa", KAPPA).unwrap(), hurst_matters(&all, "kappa", KAPPA).unwrap()]
    }

    #[test]
    fn a_fall_with_the_breadth_and_a_step_with_the_exponent_are_told_apart() {
        let words = |change| verdicts(&breadths(8), change).map(|it| it.verdict);
        assert_eq!(words([0.0, 0.0]), ["holds", "holds"]);
        assert_eq!(words([0.1, 0.0]), ["does not hold", "holds"]);
        assert_eq!(words([0.0, 0.1]), ["holds", "does not hold"]);
        assert_eq!(words([0.1, 0.1]), ["does not hold", "does not hold"]);
        let [_, step] = verdicts(&breadths(8), [0.1, 0.1]);
        assert!(step.here.starts_with("at p* = 0.01 H = 0.8 less 0.3: +5."), "{step:?}");
    }

    #[test]
    fn a_single_seed_has_no_error_and_no_verdict() {
        assert_eq!(verdicts(&breadths(1), [0.1, 0.1]).map(|it| it.verdict), ["no error"; 2]);
    }
}
