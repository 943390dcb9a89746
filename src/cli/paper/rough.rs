//! Self-affine lines and surfaces, and the panels of their figures.

use super::means::{Points, Quantity};
use anyhow::Result;
use asperity::Grid;
use asperity::plot::{Axis, Colour, Corner, Mark, Panel, Point, Series, Symbol};
use asperity::study::{Realisation, Shape};
use asperity::surface::Spectrum;

/// Roll-off wavelength `lambda_r`, in metres.
const ROLLOFF: f64 = 20e-6;
const RMS_GRADIENT: f64 = 1e-3;
/// Roll-off wavelengths in a line and along a side of a surface, `1/eps_t`.
const LINE: f64 = 8.0;
const SIDE: f64 = 4.0;
/// Points per shortest wavelength in the paper, `1/eps_c`.
const POINTS_PER_WAVE: f64 = 64.0;

const SYMBOLS: [Symbol; 4] = [Symbol::Circle, Symbol::Square, Symbol::Triangle, Symbol::Diamond];

/// Rough surfaces of several Hurst exponents and seeds on one or more grids.
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
    /// Its lines, grid by grid, exponent by exponent, seed by seed.
    pub fn lines(&self) -> Result<Vec<Realisation>> {
        self.realisations("rough line", |points| Ok(Grid::line(points, LINE * ROLLOFF)?))
    }

    /// Its surfaces.
    pub fn surfaces(&self) -> Result<Vec<Realisation>> {
        let side = SIDE * ROLLOFF;
        self.realisations("rough surface", |points| Ok(Grid::surface([points; 2], [side; 2])?))
    }

    fn realisations(&self, name: &str, grid: impl Fn(usize) -> Result<Grid>) -> Result<Vec<Realisation>> {
        let mut all = Vec::new();
        for &points in &self.points {
            let grid = grid(points)?;
            for &hurst in &self.hurst {
                let short_cutoff = self.cutoff * ROLLOFF;
                let rolloff_wavelength = ROLLOFF;
                let spectrum = Spectrum { hurst, rolloff_wavelength, short_cutoff, rms_gradient: RMS_GRADIENT };
                all.extend(self.seeds.iter().map(|&seed| Realisation {
                    name: name.into(),
                    grid,
                    shape: Shape::Rough { spectrum, seed },
                    loads: self.loads.clone(),
                }));
            }
        }
        Ok(all)
    }

    /// Points along a side with which a surface has the paper's 64 points per shortest wavelength.
    pub fn paper_side(&self) -> usize {
        (POINTS_PER_WAVE * SIDE / self.cutoff).round() as usize
    }

    /// Points per shortest wavelength of a surface with `side` points along a side.
    pub fn points_per_wave(&self, side: usize) -> f64 {
        side as f64 * self.cutoff / SIDE
    }

    /// Lightest and heaviest load.
    pub fn ends(&self) -> [f64; 2] {
        [self.loads[0], self.loads[self.loads.len() - 1]]
    }

    /// The range of loads on an axis, with some room.
    fn range(&self) -> [f64; 2] {
        let [low, high] = self.ends();
        [low / 1.3, high * 1.6]
    }

    /// Relative area against `p*` and `p_r*`.
    pub fn area_panel(&self, points: &Points) -> Panel {
        let [low, high] = self.range();
        let x = Axis::log("p* (red), p_r* (blue)", [low, high]);
        let y = Axis::log("a_rel", [1.5 * low, 3.5 * high]);
        let mut panel = Panel::new("(a) relative contact area", x, y, Corner::BottomRight);
        let curves: [(&str, Colour, Quantity); 2] = [
            ("a_rel against p*", Colour::VERMILION, |row| row.reduced_pressure),
            ("a_rel against p_r*", Colour::BLUE, |row| row.reduced_pressure_contact),
        ];
        for (name, colour, x) in curves {
            self.add(&mut panel, points, name, (colour, true), [x, |row| row.relative_area]);
        }
        self.add_legend(&mut panel);
        panel
    }

    /// `kappa` against `p*` and `kappa_r` against `p_r*`, raw and corrected.
    pub fn kappa_panel(&self, points: &Points, range: [f64; 2]) -> Panel {
        let [low, high] = self.range();
        let x = Axis::log("p* (red), p_r* (blue)", [low, high]);
        let mut panel = Panel::new("(b) proportionality factors", x, Axis::linear("κ, κ_r", range), Corner::TopRight);
        let p_r: Quantity = |row| row.reduced_pressure_contact;
        let curves: [(&str, Colour, bool, [Quantity; 2]); 3] = [
            ("κ", Colour::VERMILION, true, [|row| row.reduced_pressure, |row| row.kappa]),
            ("κ_r", Colour::BLUE, true, [p_r, |row| row.kappa_r]),
            ("κ_r corrected", Colour::SKY, false, [p_r, |row| row.kappa_r_corrected]),
        ];
        for (name, colour, filled, quantities) in curves {
            self.add(&mut panel, points, name, (colour, filled), quantities);
        }
        self.add_legend(&mut panel);
        panel
    }

    /// A curve of symbols for each Hurst exponent, on the finest grid; the colour tells the quantity.
    fn add(&self, panel: &mut Panel, points: &Points, name: &str, (colour, filled): (Colour, bool), of: [Quantity; 2]) {
        let finest = points.grids().last().copied().unwrap_or(0);
        panel.series.push(Series::new(name, colour, Mark::Line, Vec::new()));
        for (hurst, symbol) in self.exponents() {
            let curve = points.curve(hurst, &self.loads, finest, of);
            panel.series.push(Series::new("", colour, Mark::Joined { symbol, filled }, curve));
        }
    }

    /// Its Hurst exponents, each with its symbol.
    pub fn exponents(&self) -> impl Iterator<Item = (f64, Symbol)> {
        self.hurst.iter().copied().zip(SYMBOLS.into_iter().cycle())
    }

    /// Says in the legend what the symbols mean.
    pub fn add_legend(&self, panel: &mut Panel) {
        for (hurst, symbol) in self.exponents() {
            let mark = Mark::Symbol { symbol, filled: false };
            panel.series.push(Series::new(format!("H = {hurst}"), Colour::BLACK, mark, Vec::new()));
        }
    }
}

/// A function of the load, along a logarithmic axis.
pub fn along(axis: &Axis, of: impl Fn(f64) -> f64) -> Vec<Point> {
    let [low, high] = axis.range.map(f64::log10);
    let load = |i: i32| 10f64.powf(low + (high - low) * f64::from(i) / 100.0);
    (0..=100).map(load).map(|p| Point::at(p, of(p))).collect()
}
