//! The exact solution for an indenter on a grid, where there is one.

use super::periodic::{Periodic, strip_load, strip_mean_penetration, strip_penetration};
use super::{Geometry, PowerLaw, Westergaard, crossed_full_pressure};
use crate::grid::Grid;
use crate::surface::{Field, Indenter, offsets, shortest_period};
use rayon::prelude::*;
use std::f64::consts::{E, PI, TAU};

/// The exact solution for an [`Indenter`] on a grid.
///
/// | indenter                             | solution                                                       |
/// |--------------------------------------|----------------------------------------------------------------|
/// | sine                                 | [`Westergaard`], periodic, to beyond full contact              |
/// | cylinder, wedge, power law on a line | [`Periodic`]                                                   |
/// | strip punch, until its base touches  | Koiter, periodic; each pressure is the mean over a node's cell |
/// | sphere, cone, power law on a surface | [`PowerLaw`], isolated                                         |
/// | disc punch, until its base touches   | isolated; each the mean over a ring one spacing wide            |
/// | crossed sine in full contact         | `p = p_mean + p_full cos cos`                                  |
///
/// Isolated solutions leave out the neighbouring cells, an error of order `(a/L)^3` for points. Where the pressure of a
/// wedge or cone is infinite, in the middle, it is the mean over the node's cell of the logarithm there (for a cone
/// over the disc of the cell's area): its value at the distance `dx/(2e)` or `sqrt(dx dy/(pi e))`.
///
/// ```
/// use asperity::Grid;
/// use asperity::surface::Indenter;
/// use asperity::theory::Exact;
/// let grid = Grid::line(1024, 1.0)?;
/// let exact = Exact::of(&Indenter::Sine { amplitude: 0.01 }, &grid, 1.0, 0.001).unwrap();
/// assert!((exact.pressure.mean().unwrap() / 0.001 - 1.0).abs() < 1e-3);
/// # Ok::<(), asperity::error::GridError>(())
/// ```
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Exact {
    /// Name of the theory, with the word periodic or isolated.
    pub name: &'static str,
    /// Area in contact over the area of the cell.
    pub relative_area: f64,
    /// `kappa_r = a_rel gbar_r E* / p_mean` (Eq. 3); none for punches, which are flat in contact.
    pub kappa_r: Option<f64>,
    /// Gap averaged over the cell, a length; none for isolated solutions.
    pub mean_gap: Option<f64>,
    /// Largest pressure; none where it is infinite.
    pub max_pressure: Option<f64>,
    /// Pressure at the nodes, shape `(ny, nx)`.
    #[serde(skip)]
    pub pressure: Field,
}

impl Exact {
    /// The exact solution for `indenter` on `grid` at the contact modulus `E*` and the mean pressure `mean_pressure`.
    ///
    /// `None` where no closed form is known (a crossed sine in partial contact, a punch whose base touches, power laws
    /// outside [`PowerLaw::EXPONENTS`]), where an isolated contact would not fit the cell, and for input that
    /// [`Indenter::surface`] refuses.
    pub fn of(indenter: &Indenter, grid: &Grid, contact_modulus: f64, mean_pressure: f64) -> Option<Self> {
        indenter.check(grid).ok()?;
        let is_positive = |value: f64| value > 0.0 && value.is_finite();
        let case = Case { grid, contact_modulus, mean_pressure };
        (is_positive(contact_modulus) && is_positive(mean_pressure))
            .then(|| case.solution(indenter))
            .flatten()
            .filter(|exact| exact.relative_area > 0.0 && exact.relative_area <= 1.0)
    }
}

/// One load on one grid.
struct Case<'a> {
    grid: &'a Grid,
    contact_modulus: f64,
    mean_pressure: f64,
}

impl Case<'_> {
    fn solution(&self, indenter: &Indenter) -> Option<Exact> {
        let is_line = self.grid.is_line();
        match *indenter {
            Indenter::Sine { amplitude } => Some(self.sine(amplitude)),
            Indenter::CrossedSine { amplitude } => self.crossed_sine(amplitude),
            Indenter::Cylinder { radius } => self.periodic("cylinder, periodic", 0.5 / radius, 2.0),
            Indenter::Wedge { slope } => self.periodic("wedge, periodic", slope, 1.0),
            Indenter::Sphere { radius } => self.isolated("Hertz, isolated", 0.5 / radius, 2.0),
            Indenter::Cone { slope } => self.isolated("cone, isolated", slope, 1.0),
            Indenter::PowerLaw { coefficient, exponent } if is_line => {
                self.periodic("power law, periodic", coefficient, exponent)
            }
            Indenter::PowerLaw { coefficient, exponent } => {
                self.isolated("Galin-Sneddon, isolated", coefficient, exponent)
            }
            Indenter::Punch { half_width, depth } if is_line => self.strip(half_width, depth),
            Indenter::Punch { half_width, depth } if !is_line => self.disc(half_width, depth),
            _ => None,
        }
    }

    fn sine(&self, amplitude: f64) -> Exact {
        let (period, mean) = (self.grid.size()[1], self.mean_pressure);
        let sine = Westergaard { amplitude, period, contact_modulus: self.contact_modulus };
        Exact {
            name: "Westergaard, periodic",
            relative_area: sine.relative_area(mean),
            kappa_r: Some(sine.kappa_r(mean)),
            max_pressure: Some(sine.pressure(mean, 0.0)),
            mean_gap: Some(sine.mean_gap(mean)),
            pressure: self.field(|[_, x]| sine.pressure(mean, x)),
        }
    }

    fn crossed_sine(&self, amplitude: f64) -> Option<Exact> {
        let (modulus, mean, [ly, lx]) = (self.contact_modulus, self.mean_pressure, self.grid.size());
        let full = crossed_full_pressure(amplitude, [ly, lx], modulus);
        let rms_gradient = 0.5 * TAU * amplitude * lx.recip().hypot(ly.recip());
        (mean >= full).then(|| Exact {
            name: "full contact, periodic",
            relative_area: 1.0,
            kappa_r: Some(rms_gradient * modulus / mean),
            max_pressure: Some(mean + full),
            mean_gap: Some(0.0),
            pressure: self.field(|[y, x]| mean + full * (TAU * x / lx).cos() * (TAU * y / ly).cos()),
        })
    }

    fn periodic(&self, name: &'static str, coefficient: f64, exponent: f64) -> Option<Exact> {
        let (period, contact_modulus) = (self.grid.size()[1], self.contact_modulus);
        let slope = |s: f64| coefficient * exponent * s.powf(exponent - 1.0);
        let contact = Periodic { slope, period, contact_modulus };
        let is_known = PowerLaw::EXPONENTS.contains(&exponent);
        let a = is_known.then(|| contact.half_width(self.mean_pressure * period)).flatten()?;
        let profile = contact.pressure(a);
        let max_pressure = Some(profile.at(0.0)).filter(|p| p.is_finite());
        let core = if max_pressure.is_none() { 0.5 * self.grid.spacing()[1] / E } else { 0.0 };
        Some(Exact {
            name,
            relative_area: 2.0 * a / period,
            kappa_r: Some(contact.kappa_r(a)),
            max_pressure,
            mean_gap: Some(contact.mean_gap(a)),
            pressure: self.field(|[_, x]| profile.at(if x == 0.0 { core } else { x })),
        })
    }

    fn isolated(&self, name: &'static str, coefficient: f64, exponent: f64) -> Option<Exact> {
        let ([ly, lx], [dy, dx]) = (self.grid.size(), self.grid.spacing());
        let contact_modulus = self.contact_modulus;
        let contact = PowerLaw { geometry: Geometry::Point, coefficient, exponent, contact_modulus };
        let a = contact.half_width(self.mean_pressure * lx * ly);
        let max_pressure = Some(contact.pressure(a, 0.0)).filter(|p| p.is_finite());
        let core = if max_pressure.is_none() { (dx * dy / (PI * E)).sqrt() } else { 0.0 };
        let is_known = PowerLaw::EXPONENTS.contains(&exponent) && a < 0.5 * shortest_period(self.grid);
        is_known.then(|| Exact {
            name,
            relative_area: PI * a * a / (lx * ly),
            kappa_r: Some(contact.kappa_r()),
            max_pressure,
            mean_gap: None,
            pressure: self.field(|[y, x]| contact.pressure(a, x.hypot(y).max(core))),
        })
    }

    fn strip(&self, half_width: f64, depth: f64) -> Option<Exact> {
        let (period, dx) = (self.grid.size()[1], self.grid.spacing()[1]);
        let (mean, modulus) = (self.mean_pressure, self.contact_modulus);
        let load = |x: f64| mean * period * strip_load(half_width, period, x);
        let relative_area = 2.0 * half_width / period;
        let closed = strip_mean_penetration(mean, half_width, period, modulus);
        (strip_penetration(mean, half_width, period, modulus) < depth).then(|| Exact {
            name: "Koiter, periodic",
            relative_area,
            kappa_r: None,
            max_pressure: None,
            mean_gap: Some(depth * (1.0 - relative_area) - closed),
            pressure: self.field(|[_, x]| (load(x + 0.5 * dx) - load(x - 0.5 * dx)) / dx),
        })
    }

    fn disc(&self, radius: f64, depth: f64) -> Option<Exact> {
        let ([ly, lx], [dy, dx]) = (self.grid.size(), self.grid.spacing());
        let load = self.mean_pressure * lx * ly;
        let half_ring = 0.5 * (dx * dy).sqrt();
        let enclosed = |r: f64| load * (1.0 - (1.0 - (r / radius).min(1.0).powi(2)).sqrt());
        let mean =
            |inner: f64, outer: f64| (enclosed(outer) - enclosed(inner)) / (PI * (outer - inner) * (outer + inner));
        let approach = load / (2.0 * self.contact_modulus * radius);
        (approach < depth).then(|| Exact {
            name: "disc punch, isolated",
            relative_area: PI * radius * radius / (lx * ly),
            kappa_r: None,
            max_pressure: None,
            mean_gap: None,
            pressure: self.field(|[y, x]| {
                let r = x.hypot(y);
                mean((r - half_ring).max(0.0), r + half_ring)
            }),
        })
    }

    /// `value` at the offset of each node from the peak.
    fn field(&self, value: impl Fn([f64; 2]) -> f64 + Send + Sync) -> Field {
        let offsets: Vec<_> = offsets(self.grid).collect();
        let values = offsets.into_par_iter().map(value).collect();
        let [ny, nx] = self.grid.shape();
        Field::from_shape_vec((ny, nx), values).expect("one value per node")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fourier::{Complex, Fourier};
    use crate::theory::hertz;

    const MODULUS: f64 = 2.0;

    /// The gap under the sampled pressure, up to a constant: `u - h` with `u_q = 2 p_q/(E* q)`.
    fn gap(indenter: &Indenter, grid: Grid, exact: &Exact) -> Vec<f64> {
        let surface = indenter.surface(grid).unwrap();
        let mut spectrum = vec![Complex::default(); grid.modes()];
        let mut fourier = Fourier::new(&grid);
        fourier.forward(exact.pressure.as_slice().unwrap(), &mut spectrum);
        for (coefficient, q) in spectrum.iter_mut().zip(grid.wavenumbers()) {
            *coefficient *= if q > 0.0 { 2.0 / (MODULUS * q) } else { 0.0 };
        }
        let mut displacement = vec![0.0; grid.len()];
        fourier.inverse(&mut spectrum, &mut displacement);
        displacement.iter().zip(surface.heights()).map(|(u, h)| u - h).collect()
    }

    /// The largest gap in contact, the smallest outside, and the mean, all over the range of the heights.
    fn gaps(indenter: &Indenter, grid: Grid, exact: &Exact) -> [f64; 3] {
        let gap = gap(indenter, grid, exact);
        let surface = indenter.surface(grid).unwrap();
        let bounds = |f: &[f64]| f.iter().fold([f64::MAX, f64::MIN], |[a, b], &v| [a.min(v), b.max(v)]);
        let [low, high] = bounds(surface.heights());
        let nodes = gap.iter().zip(&exact.pressure).zip(surface.heights());
        let touching = nodes.filter(|&((_, &p), &h)| p > 0.0 && h > low);
        let [first, last] = bounds(&touching.map(|((g, _), _)| *g).collect::<Vec<_>>());
        let datum = 0.5 * (first + last);
        let mean = gap.iter().sum::<f64>() / gap.len() as f64;
        [0.5 * (last - first), bounds(&gap)[0] - datum, mean - datum].map(|g| g / (high - low))
    }

    #[test]
    fn line_solutions_close_the_gap_in_contact_and_nowhere_open_it_below_zero() {
        let cases = [
            (Indenter::Sine { amplitude: 0.3 }, 0.4),
            (Indenter::Sine { amplitude: 0.3 }, 5.0),
            (Indenter::Cylinder { radius: 0.25 }, 0.2),
            (Indenter::Cylinder { radius: 0.25 }, 1.5),
            (Indenter::Wedge { slope: 0.3 }, 0.2),
            (Indenter::PowerLaw { coefficient: 1.0, exponent: 1.5 }, 0.3),
            (Indenter::PowerLaw { coefficient: 3.0, exponent: 4.0 }, 0.5),
            (Indenter::Punch { half_width: 100.5 / 4096.0, depth: 1.0 }, 0.1),
        ];
        for (indenter, mean_pressure) in cases {
            let grid = Grid::line(4096, 1.0).unwrap();
            let exact = Exact::of(&indenter, &grid, MODULUS, mean_pressure).unwrap();
            let [in_contact, smallest, mean] = gaps(&indenter, grid, &exact);
            assert!(in_contact < 1e-3, "{indenter:?}: {in_contact}");
            assert!(smallest > -1e-3, "{indenter:?}: {smallest}");
            let heights = indenter.surface(grid).unwrap();
            let range = heights.heights().iter().fold(0.0_f64, |m, h| m.max(heights.heights()[2048] - h));
            let expected = exact.mean_gap.unwrap() / range;
            assert!((mean - expected).abs() < 1e-3, "{indenter:?}: {mean} against {expected}");
            assert!((exact.pressure.mean().unwrap() / mean_pressure - 1.0).abs() < 2e-3, "{indenter:?}");
        }
    }

    #[test]
    fn isolated_solutions_close_the_gap_in_contact() {
        let cases = [
            (Indenter::Sphere { radius: 1.0 }, 0.002),
            (Indenter::Cone { slope: 0.2 }, 0.004),
            (Indenter::PowerLaw { coefficient: 1.0, exponent: 3.0 }, 0.0005),
            (Indenter::Punch { half_width: 0.1, depth: 1.0 }, 0.01),
        ];
        for (indenter, mean_pressure) in cases {
            let grid = Grid::surface([512, 512], [1.0, 1.0]).unwrap();
            let exact = Exact::of(&indenter, &grid, MODULUS, mean_pressure).unwrap();
            let [in_contact, smallest, _] = gaps(&indenter, grid, &exact);
            assert!(in_contact < 3e-3, "{indenter:?}: {in_contact}");
            assert!(smallest > -3e-3, "{indenter:?}: {smallest}");
            assert!((exact.pressure.mean().unwrap() / mean_pressure - 1.0).abs() < 2e-2, "{indenter:?}");
        }
    }

    #[test]
    fn the_sphere_is_hertz() {
        let grid = Grid::surface([64, 64], [1.0, 1.0]).unwrap();
        let exact = Exact::of(&Indenter::Sphere { radius: 1.0 }, &grid, 1.0, 0.001).unwrap();
        let contact = hertz::sphere(1.0, 1.0);
        let a = contact.half_width(0.001);
        assert!((exact.relative_area - PI * a * a).abs() < 1e-15);
        assert_eq!(exact.max_pressure, Some(exact.pressure[[32, 32]]));
        assert!((exact.kappa_r.unwrap() - hertz::KAPPA_R_POINT).abs() < 1e-14);
    }

    #[test]
    fn full_contact_of_the_crossed_sine() {
        let (grid, indenter) = (Grid::surface([16, 24], [1.0, 2.0]).unwrap(), Indenter::CrossedSine { amplitude: 0.1 });
        let full = crossed_full_pressure(0.1, [1.0, 2.0], MODULUS);
        assert_eq!(Exact::of(&indenter, &grid, MODULUS, 0.99 * full), None);
        let exact = Exact::of(&indenter, &grid, MODULUS, 1.5 * full).unwrap();
        assert!(gaps(&indenter, grid, &exact)[0] < 1e-14);
        assert!((exact.pressure[[8, 12]] - exact.max_pressure.unwrap()).abs() < 1e-14);
    }

    #[test]
    fn there_is_none_where_nothing_is_known() {
        let (line, surface) = (Grid::line(64, 1.0).unwrap(), Grid::surface([16, 16], [1.0, 1.0]).unwrap());
        let none = |indenter, grid, p| assert_eq!(Exact::of(&indenter, &grid, 1.0, p), None, "{indenter:?} at {p}");
        none(Indenter::Sphere { radius: 1.0 }, surface, 10.0);
        none(Indenter::Sphere { radius: 1.0 }, line, 0.1);
        none(Indenter::Cylinder { radius: -1.0 }, line, 0.1);
        none(Indenter::Cylinder { radius: 1.0 }, line, 1e6);
        none(Indenter::PowerLaw { coefficient: 1.0, exponent: 0.5 }, line, 0.1);
        none(Indenter::PowerLaw { coefficient: 1.0, exponent: 1e300 }, surface, 0.1);
        none(Indenter::Punch { half_width: 0.2, depth: 0.1 }, line, 1.0);
        none(Indenter::Punch { half_width: 0.2, depth: 0.1 }, surface, 1.0);
        for pressure in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            none(Indenter::Sine { amplitude: 1.0 }, line, pressure);
        }
    }
}
