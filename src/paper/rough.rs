//! Self-affine lines and surfaces, the panels of their figures, and their curves over the loads.

use super::means::{Points, Quantity};
use super::reproduction::{Ramp, RampCurve, captions};
use crate::contact::Load;
use crate::error::StudyError;
use crate::plot::{Axis, Colour, Corner, Mark, Panel, Series, Symbol};
use crate::setup::{Cell, Recipe, Setup};
use crate::study::Realisation;
use crate::surface::Spectrum;
use std::fmt::Debug;

/// Roll-off wavelength `lambda_r`, in metres.
const ROLLOFF: f64 = 20e-6;
const RMS_GRADIENT: f64 = 1e-3;
/// Roll-off wavelengths in a line and along a side of a surface, `1/eps_t`.
const LINE: f64 = 8.0;
const SIDE: f64 = 4.0;
/// Points per shortest wavelength in the paper, `1/eps_c`.
const POINTS_PER_WAVE: f64 = 64.0;

const SYMBOLS: [Symbol; 4] = [Symbol::Circle, Symbol::Square, Symbol::Triangle, Symbol::Diamond];
/// Colours of the Hurst exponents in recordings, three shades of a kind.
pub const WARM: [Colour; 4] = [Colour::VERMILION, Colour::ORANGE, Colour::PURPLE, Colour::GREY];
/// Colours beside [`WARM`].
pub const COLD: [Colour; 4] = [Colour::BLUE, Colour::SKY, Colour::GREEN, Colour::GREY];

/// Rough lines or surfaces of several Hurst exponents and seeds on one or more grids. All lists ascend.
#[derive(Debug, Clone, PartialEq)]
pub struct Rough {
    /// Points along each side, coarsest first.
    pub points: Vec<usize>,
    /// Hurst exponents.
    pub hurst: Vec<f64>,
    /// Seeds.
    pub seeds: Vec<u64>,
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
        for &points in &self.points {
            for &hurst in &self.hurst {
                let spectrum =
                    Spectrum { hurst, rolloff_wavelength: ROLLOFF, short_cutoff, rms_gradient: RMS_GRADIENT };
                all.extend(self.seeds.iter().map(|&seed| Realisation {
                    name: name.into(),
                    setup: Setup::new(Recipe::rough(spectrum, seed), cell(points), Load::ReducedPressure(heaviest)),
                    loads: self.loads.clone(),
                }));
            }
        }
        all
    }

    /// Checks that there is something to solve, in the right order.
    pub(super) fn check(&self) -> Result<(), StudyError> {
        check_ascending("points along a side", &self.points)?;
        check_ascending("Hurst exponents", &self.hurst)?;
        check_ascending("seeds", &self.seeds)?;
        check_ascending("reduced pressures", &self.loads)
    }

    /// Points along a side with which a surface has the paper's 64 points per shortest wavelength.
    pub(super) fn paper_side(&self) -> usize {
        (POINTS_PER_WAVE * SIDE / self.cutoff).round() as usize
    }

    /// Points per shortest wavelength of a surface with `side` points along a side.
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
        let mut panel = Panel::new("(a) relative contact area", x, y, Corner::BottomRight);
        let curves: [(&str, Colour, Quantity); 2] = [
            ("a_rel against p*", Colour::VERMILION, |it| it.reduced_pressure),
            ("a_rel against p_r*", Colour::BLUE, |it| it.reduced_pressure_contact),
        ];
        for (name, colour, x) in curves {
            self.add(&mut panel, points, name, (colour, true), [x, |it| it.relative_area]);
        }
        self.add_legend(&mut panel);
        panel
    }

    /// `kappa` against `p*` and `kappa_r` against `p_r*`, raw and corrected.
    pub(super) fn kappa_panel(&self, points: &Points, range: [f64; 2]) -> Panel {
        let [low, high] = self.range();
        let x = Axis::log("p* (red), p_r* (blue)", [low, high]);
        let mut panel = Panel::new("(b) proportionality factors", x, Axis::linear("κ, κ_r", range), Corner::TopRight);
        let p_r: Quantity = |row| row.reduced_pressure_contact;
        let curves: [(&str, Colour, bool, [Quantity; 2]); 3] = [
            ("κ", Colour::VERMILION, true, [|it| it.reduced_pressure, |it| it.kappa]),
            ("κ_r", Colour::BLUE, true, [p_r, |it| it.kappa_r]),
            ("κ_r corrected", Colour::SKY, false, [p_r, |it| it.kappa_r_corrected]),
        ];
        for (name, colour, filled, quantities) in curves {
            self.add(&mut panel, points, name, (colour, filled), quantities);
        }
        self.add_legend(&mut panel);
        panel
    }

    /// A curve of symbols for each Hurst exponent, on the finest grid; the colour tells the quantity.
    fn add(&self, panel: &mut Panel, points: &Points, name: &str, (colour, filled): (Colour, bool), of: [Quantity; 2]) {
        panel.series.push(Series::new(name, colour, Mark::Line, Vec::new()));
        for (hurst, symbol) in self.exponents() {
            let curve = points.curve(hurst, &self.loads, of);
            panel.series.push(Series::new("", colour, Mark::Joined { symbol, filled }, curve));
        }
    }

    /// The Hurst exponents, each with its symbol.
    pub(super) fn exponents(&self) -> impl Iterator<Item = (f64, Symbol)> {
        self.hurst.iter().copied().zip(SYMBOLS.into_iter().cycle())
    }

    /// Says in the legend what the symbols mean.
    pub(super) fn add_legend(&self, panel: &mut Panel) {
        for (hurst, symbol) in self.exponents() {
            let mark = Mark::Symbol { symbol, filled: false };
            panel.series.push(Series::new(format!("H = {hurst}"), Colour::BLACK, mark, Vec::new()));
        }
    }
    /// Means over the realisations against the loads, without contacts.
    pub(super) fn ramp(&self, points: &Points) -> Ramp {
        let kinds: [(&str, &str, &[Colour], Quantity); 4] = [
            ("κ and κ_r", "κ", &WARM, |it| it.kappa),
            ("κ and κ_r", "κ_r", &COLD, |it| it.kappa_r),
            ("κ_r corrected", "κ_r corrected", &COLD, |it| it.kappa_r_corrected),
            ("relative contact area", "log10 a_rel", &WARM, |it| it.relative_area.log10()),
        ];
        let mut curves = Vec::new();
        for (view, name, colours, quantity) in kinds {
            for (&hurst, &colour) in self.hurst.iter().zip(colours.iter().cycle()) {
                let mean = |&load: &f64| points.at(hurst, load, points.finest(), quantity).mean;
                let values = self.loads.iter().map(mean).collect();
                curves.push(RampCurve { view, name: format!("{name}, H = {hurst}"), colour, values });
            }
        }
        Ramp {
            captions: captions("p*", &self.loads),
            cursor: self.loads.clone(),
            curves,
            contacts: Vec::new(),
            length_unit: "m",
        }
    }

    /// The first of `realisations` of each Hurst exponent, on the coarsest grid.
    pub(super) fn firsts(&self, realisations: Vec<Realisation>) -> Vec<Realisation> {
        let coarsest = self.hurst.len() * self.seeds.len();
        realisations.into_iter().take(coarsest).step_by(self.seeds.len().max(1)).collect()
    }
}

fn check_ascending<T: PartialOrd + Debug>(what: &'static str, values: &[T]) -> Result<(), StudyError> {
    match !values.is_empty() && values.is_sorted_by(|a, b| a < b) {
        true => Ok(()),
        false => Err(StudyError::List { what, values: format!("{values:?}") }),
    }
}
