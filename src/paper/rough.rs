//! Self-affine lines and surfaces, the panels of their figures, and their curves over the loads.

use super::means::Points;
use super::measure::{Measure, ObservableFn};
use super::reproduction::{Ramp, RampCurve, captions};
use crate::contact::Load;
use crate::error::StudyError;
use crate::plot::{Axis, AxisScale, Colour, Dot, Mark, Panel, Symbol};
use crate::setup::{Cell, Recipe, Setup};
use crate::study::Realisation;
use crate::surface::Spectrum;
use std::fmt::Debug;

/// Roll-off wavelength `lambda_r`, in metres.
pub(super) const ROLLOFF: f64 = 20e-6;
pub(super) const RMS_GRADIENT: f64 = 1e-3;
/// Roll-off wavelengths in a line and along a side of a surface, `1/eps_t`.
pub(super) const LINE: f64 = 8.0;
pub(super) const SIDE: f64 = 4.0;
/// Points per shortest wavelength in the paper, `1/eps_c`.
const POINTS_PER_WAVE: f64 = 64.0;

/// Symbols of the Hurst exponents.
/// Colours of the Hurst exponents in recordings, three shades of a kind.
pub(crate) const WARM: [Colour; 4] = [Colour::VERMILION, Colour::ORANGE, Colour::PURPLE, Colour::GREY];
/// Colours beside [`WARM`].
pub(crate) const COLD: [Colour; 4] = [Colour::BLUE, Colour::SKY, Colour::GREEN, Colour::GREY];

/// The colour of Hurst exponent `number`, if colours distinguish Hurst exponents.
pub(crate) fn shade(number: usize) -> Colour {
    const SHADES: [Colour; 4] = [Colour::VERMILION, Colour::GREEN, Colour::BLUE, Colour::PURPLE];
    SHADES[number % SHADES.len()]
}

/// Rough lines or surfaces of several Hurst exponents and seeds on one or more grids. All lists ascend.
#[derive(Debug, Clone, PartialEq)]
pub struct Rough {
    /// Points along each side, coarsest first.
    pub points: Vec<usize>,
    /// Hurst exponents.
    pub hurst: Vec<f64>,
    /// Seeds on each grid; those of a finer one are among those of the coarser. With fewer lists than grids the first is that of
    /// all coarsest ones, with more the last is that of the finest.
    pub seeds: Vec<Vec<u64>>,
    /// Shortest wavelength over the roll-off, `eps_f`.
    pub cutoff: f64,
    /// Reduced pressures, lightest first.
    pub loads: Vec<f64>,
}

impl Rough {
    /// Lines, grid by grid, exponent by exponent, seed by seed.
    pub(super) fn lines(&self) -> Vec<Realisation> {
        self.realisations("rough line", |points| Cell::line(points, LINE * ROLLOFF))
    }

    /// Surfaces in the same order.
    pub(super) fn surfaces(&self) -> Vec<Realisation> {
        self.realisations("rough surface", |points| Cell::surface([points; 2], [SIDE * ROLLOFF; 2]))
    }

    fn realisations(&self, name: &str, cell: impl Fn(usize) -> Cell) -> Vec<Realisation> {
        let (short_cutoff, [_, heaviest]) = (self.cutoff * ROLLOFF, self.ends());
        let mut all = Vec::new();
        for (grid, &points) in self.points.iter().enumerate() {
            for &hurst in &self.hurst {
                let spectrum =
                    Spectrum { hurst, rolloff_wavelength: ROLLOFF, short_cutoff, rms_gradient: RMS_GRADIENT };
                all.extend(self.seeds_on(grid).iter().map(|&seed| Realisation {
                    name: name.into(),
                    setup: Setup::new(Recipe::rough(spectrum, seed), cell(points), Load::ReducedPressure(heaviest)),
                    loads: Realisation::reduced_pressures(&self.loads),
                }));
            }
        }
        all
    }

    /// The seeds on a grid, by its number from the coarsest.
    pub(super) fn seeds_on(&self, grid: usize) -> &[u64] {
        let finer = self.points.len() - 1 - grid;
        self.seeds.get((self.seeds.len() - 1).saturating_sub(finer)).map_or(&[], Vec::as_slice)
    }

    /// Checks that there is something to solve, in the right order.
    pub(super) fn check(&self) -> Result<(), StudyError> {
        check_ascending("points per side", &self.points)?;
        check_ascending("Hurst exponents", &self.hurst)?;
        if self.seeds.is_empty() {
            return Err(StudyError::List { what: "seeds", values: "[]".into() });
        }
        self.seeds.iter().try_for_each(|seeds| check_ascending("seeds", seeds))?;
        check_ascending("reduced pressures", &self.loads)
    }

    /// Points along a side with which a surface has the paper's 64 points per shortest wavelength.
    pub(super) fn paper_side(&self) -> usize {
        (POINTS_PER_WAVE * SIDE / self.cutoff).round() as usize
    }

    /// Points with which a line has the paper's 64 points per shortest wavelength.
    pub(super) fn paper_line(&self) -> usize {
        (POINTS_PER_WAVE * LINE / self.cutoff).round() as usize
    }

    /// Points per shortest wavelength, for a line of `points` points.
    pub(super) fn points_per_wave_of_line(&self, points: usize) -> f64 {
        points as f64 * self.cutoff / LINE
    }

    /// Points per shortest wavelength of a surface with `side` points per side.
    pub(super) fn points_per_wave(&self, side: usize) -> f64 {
        side as f64 * self.cutoff / SIDE
    }

    /// Lightest and heaviest load.
    pub(super) fn ends(&self) -> [f64; 2] {
        [self.loads.first(), self.loads.last()].map(|load| load.copied().unwrap_or(f64::NAN))
    }

    /// All Hurst exponents, each with all loads.
    pub(super) fn pairs(&self) -> impl Iterator<Item = (f64, f64)> {
        self.hurst.iter().flat_map(|&hurst| self.loads.iter().map(move |&load| (hurst, load)))
    }

    /// The range of loads on an axis, with some room.
    fn range(&self) -> [f64; 2] {
        let [low, high] = self.ends();
        [low / 1.3, high * 1.6]
    }

    /// Relative area against `p*` and `p_r*`.
    pub(super) fn area_panel(&self, points: &Points) -> Panel {
        let [low, high] = self.range();
        let x = Axis::log("p* (red), p_r* (blue)", [low, high]);
        let y = Axis::log("a_rel", [1.5 * low, 3.5 * high]);
        let counted = Measure::Counted;
        let curves: [SymbolCurve<[ObservableFn; 2]>; 2] = [
            SymbolCurve::new("a_rel against p*", Colour::VERMILION, true, [|it| it.reduced_pressure, counted.area()]),
            SymbolCurve::new(
                "a_rel against p_r*",
                Colour::BLUE,
                true,
                [counted.reduced_pressure_contact(), counted.area()],
            ),
        ];
        let panel = Panel::new("(a) relative contact area", x, y);
        self.drawn(panel, &curves, |hurst, of| points.curve(hurst, &self.loads, of))
    }

    /// `kappa` against `p*` and `kappa_r` against `p_r*`, counted and resolved.
    pub(super) fn kappa_panel(&self, points: &Points, range: [f64; 2]) -> Panel {
        let x = Axis::log("p* (red), p_r* (blue)", self.range());
        let [counted, resolved] = Measure::ALL;
        let curves: [SymbolCurve<[ObservableFn; 2]>; 3] = [
            SymbolCurve::new("κ counted", Colour::VERMILION, true, [|it| it.reduced_pressure, counted.kappa()]),
            SymbolCurve::new(
                "κ_r counted",
                Colour::BLUE,
                true,
                [counted.reduced_pressure_contact(), counted.kappa_r()],
            ),
            SymbolCurve::new(
                "κ_r resolved",
                Colour::SKY,
                false,
                [resolved.reduced_pressure_contact(), resolved.kappa_r()],
            ),
        ];
        let panel = Panel::new("(b) proportionality factors", x, Axis::linear("κ, κ_r", range));
        self.drawn(panel, &curves, |hurst, of| points.curve(hurst, &self.loads, of))
    }

    /// The panel with `curves` of symbols, one for each Hurst exponent; the colour shows the quantity.
    pub(super) fn drawn<Q: Copy>(
        &self,
        mut panel: Panel,
        curves: &[SymbolCurve<Q>],
        dots: impl Fn(f64, Q) -> Vec<Dot>,
    ) -> Panel {
        for &SymbolCurve { name, colour, filled, quantity } in curves {
            panel.add(name, colour, Mark::Line, []);
            for (hurst, symbol) in self.exponents() {
                panel.add("", colour, Mark::Joined { symbol, filled }, dots(hurst, quantity));
            }
        }
        for (hurst, symbol) in self.exponents() {
            panel.add(format!("H = {hurst}"), Colour::BLACK, Mark::Symbol { symbol, filled: false }, []);
        }
        panel
    }

    /// The Hurst exponents, each with its symbol.
    pub(super) fn exponents(&self) -> impl Iterator<Item = (f64, Symbol)> {
        self.hurst.iter().copied().zip((0..).map(Symbol::of_curve))
    }

    /// Means over the realisations against the loads, and the first of `realisations` of each Hurst exponent on the coarsest
    /// grid.
    pub(super) fn ramp_of(&self, points: &Points, realisations: Vec<Realisation>) -> Ramp {
        let curves: [ShadedCurve<ObservableFn>; 4] = [
            ShadedCurve::new("κ and κ_r", "κ", &WARM, Measure::Counted.kappa()),
            ShadedCurve::new("κ and κ_r", "κ_r", &COLD, Measure::Counted.kappa_r()),
            ShadedCurve::new("κ_r resolved", "κ_r resolved", &COLD, Measure::Resolved.kappa_r()),
            ShadedCurve::new("relative contact area", "log10 a_rel", &WARM, |it| it.relative_area_counted.log10()),
        ];
        let seeds = self.seeds_on(0).len();
        let coarsest = self.hurst.len() * seeds;
        let contacts = realisations.into_iter().take(coarsest).step_by(seeds.max(1)).collect();
        Ramp { contacts, ..self.ramp(&curves, |hurst, of| points.along(hurst, &self.loads, of)) }
    }

    /// Curves against the loads by their views, one for each Hurst exponent in a shade of its own; no contacts.
    pub(super) fn ramp<Q: Copy>(&self, curves: &[ShadedCurve<Q>], values: impl Fn(f64, Q) -> Vec<f64>) -> Ramp {
        let each = |&ShadedCurve { view, name, shades, quantity }: &ShadedCurve<Q>| {
            let curve = |(&hurst, &colour)| {
                RampCurve::new(view, format!("{name}, H = {hurst}"), colour, values(hurst, quantity).into_iter())
            };
            self.hurst.iter().zip(shades.iter().cycle()).map(curve).collect::<Vec<_>>()
        };
        Ramp {
            captions: captions("p*", &self.loads),
            quantity: ("p*", AxisScale::Log),
            cursor: self.loads.clone(),
            curves: curves.iter().flat_map(each).collect(),
            contacts: Vec::new(),
            length_unit: "m",
        }
    }
}

/// A quantity that is drawn with symbols in a colour of its own.
#[derive(Clone, Copy)]
pub(super) struct SymbolCurve<Q> {
    name: &'static str,
    colour: Colour,
    filled: bool,
    quantity: Q,
}

impl<Q> SymbolCurve<Q> {
    /// The curve of a quantity, with filled or open symbols.
    pub(crate) fn new(name: &'static str, colour: Colour, filled: bool, quantity: Q) -> Self {
        Self { name, colour, filled, quantity }
    }
}

/// A quantity that is drawn in a view, in one shade for each Hurst exponent.
#[derive(Clone, Copy)]
pub(super) struct ShadedCurve<Q> {
    view: &'static str,
    name: &'static str,
    shades: &'static [Colour],
    quantity: Q,
}

impl<Q> ShadedCurve<Q> {
    /// The curves of a quantity in a view.
    pub(crate) fn new(view: &'static str, name: &'static str, shades: &'static [Colour], quantity: Q) -> Self {
        Self { view, name, shades, quantity }
    }
}

/// Refuses a list that is empty or does not ascend.
pub(super) fn check_ascending<T: PartialOrd + Debug>(what: &'static str, values: &[T]) -> Result<(), StudyError> {
    match !values.is_empty() && values.is_sorted_by(|a, b| a < b) {
        true => Ok(()),
        false => Err(StudyError::List { what, values: format!("{values:?}") }),
    }
}
