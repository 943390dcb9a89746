//! The exact solution for an indenter on a grid, where there is one.

use super::periodic::{Periodic, strip_load, strip_mean_penetration, strip_penetration};
use super::{EllipticHertz, Geometry, PowerLaw, Westergaard, crossed_full_pressure};
use crate::grid::Grid;
use crate::surface::{Field, Indenter, about_peak, shortest_period};
use std::f64::consts::{E, PI, TAU};

/// The exact solution for an [`Indenter`] on a grid.
///
/// | indenter                             | solution                                                       |
/// |--------------------------------------|----------------------------------------------------------------|
/// | sine                                 | [`Westergaard`], periodic, to beyond full contact              |
/// | cylinder, wedge, power law on a line | [`Periodic`]                                                   |
/// | strip punch, until its base touches  | Koiter, periodic; each pressure is the mean over a node's cell |
/// | sphere, cone, power law on a surface | [`PowerLaw`], isolated                                         |
/// | elliptic paraboloid                  | [`EllipticHertz`], isolated                                    |
/// | disc punch, until its base touches   | isolated; each the mean over a ring one spacing wide            |
/// | crossed sine in full contact         | `p = p_mean + p_full cos cos`                                  |
///
/// On a grid that is free along all axes every solution is isolated: that of a cylinder, wedge or power law on a line, of a sphere,
/// cone, disc punch or power law on a surface.
///
/// On a periodic grid isolated solutions leave out the neighbouring cells, an error of order `(a/L)^3` for points. Where the pressure of a
/// wedge or cone is infinite, in the middle, it is the mean over the node's cell of the logarithm there (for a cone
/// over the disc of the cell's area): its value at the distance `dx/(2e)` or `sqrt(dx dy/(pi e))`.
///
/// ```
/// use asperity::Grid;
/// use asperity::surface::Indenter;
/// use asperity::theory::Exact;
/// let grid = Grid::line(1024, 1.0)?;
/// let exact = Exact::new(&Indenter::Sine { amplitude: 0.01 }, &grid, 1.0, 0.001).unwrap();
/// assert!((exact.pressure.mean().unwrap() / 0.001 - 1.0).abs() < 1e-3);
/// # Ok::<(), asperity::error::GridError>(())
/// ```
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Exact {
    /// Name of the theory, with the word periodic or isolated.
    pub name: &'static str,
    /// Area in contact over the area of the cell.
    pub relative_area: f64,
    /// Radius of the circle of contact, or half the width of its strip on a line, a length; none for other contacts.
    pub contact_radius: Option<f64>,
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
    pub fn new(indenter: &Indenter, grid: &Grid, contact_modulus: f64, mean_pressure: f64) -> Option<Self> {
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
        if !self.grid.is_periodic() && !self.is_alone(indenter) {
            return None;
        }
        match *indenter {
            Indenter::Sine { amplitude } => Some(self.sine(amplitude)),
            Indenter::CrossedSine { amplitude } => self.crossed_sine(amplitude),
            Indenter::Cylinder { radius } if !self.grid.is_periodic() => {
                self.isolated_line("Hertz, isolated", 0.5 / radius, 2.0)
            }
            Indenter::Wedge { slope } if !self.grid.is_periodic() => self.isolated_line("wedge, isolated", slope, 1.0),
            Indenter::PowerLaw { coefficient, exponent } if is_line && !self.grid.is_periodic() => {
                self.isolated_line("power law, isolated", coefficient, exponent)
            }
            Indenter::Cylinder { radius } => self.periodic("cylinder, periodic", 0.5 / radius, 2.0),
            Indenter::Wedge { slope } => self.periodic("wedge, periodic", slope, 1.0),
            Indenter::Sphere { radius } => self.isolated("Hertz, isolated", 0.5 / radius, 2.0),
            Indenter::Cone { slope } => self.isolated("cone, isolated", slope, 1.0),
            Indenter::EllipticParaboloid { radius_x, radius_y } => self.ellipse([radius_x, radius_y]),
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
            kappa_r: Some(sine.kappa_r(mean)),
            max_pressure: Some(sine.pressure(mean, 0.0)),
            mean_gap: Some(sine.mean_gap(mean)),
            ..self.exact("Westergaard, periodic", sine.relative_area(mean), |[_, x]| sine.pressure(mean, x))
        }
    }

    fn crossed_sine(&self, amplitude: f64) -> Option<Exact> {
        let (modulus, mean, [ly, lx]) = (self.contact_modulus, self.mean_pressure, self.grid.size());
        let full = crossed_full_pressure(amplitude, [ly, lx], modulus);
        let rms_gradient = 0.5 * TAU * amplitude * lx.recip().hypot(ly.recip());
        let pressure = |[y, x]: [f64; 2]| mean + full * (TAU * x / lx).cos() * (TAU * y / ly).cos();
        (mean >= full).then(|| Exact {
            kappa_r: Some(rms_gradient * modulus / mean),
            max_pressure: Some(mean + full),
            mean_gap: Some(0.0),
            ..self.exact("full contact, periodic", 1.0, pressure)
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
            kappa_r: Some(contact.kappa_r(a)),
            max_pressure,
            mean_gap: Some(contact.mean_gap(a)),
            ..self.exact(name, 2.0 * a / period, |[_, x]| profile.at(if x == 0.0 { core } else { x }))
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
        let pressure = |[y, x]: [f64; 2]| contact.pressure(a, x.hypot(y).max(core));
        is_known.then(|| Exact {
            kappa_r: Some(contact.kappa_r()),
            max_pressure,
            contact_radius: Some(a),
            ..self.exact(name, PI * a * a / (lx * ly), pressure)
        })
    }

    fn ellipse(&self, radii: [f64; 2]) -> Option<Exact> {
        let [ly, lx] = self.grid.size();
        let (contact, load) = (EllipticHertz::new(radii, self.contact_modulus), self.mean_pressure * lx * ly);
        let [ax, ay] = contact.semi_axes(load);
        (ax < 0.5 * lx && ay < 0.5 * ly).then(|| Exact {
            kappa_r: Some(contact.kappa_r(load)),
            max_pressure: Some(contact.max_pressure(load)),
            ..self.exact("Hertz, isolated", PI * ax * ay / (lx * ly), |at| contact.pressure(load, at))
        })
    }

    /// Whether an indenter has a solution that stands alone on this grid, which is free.
    fn is_alone(&self, indenter: &Indenter) -> bool {
        let is_smooth = !matches!(indenter, Indenter::Sine { .. } | Indenter::CrossedSine { .. });
        let is_strip = matches!(indenter, Indenter::Punch { .. }) && self.grid.is_line();
        let is_free = self.grid.is_line() || self.grid.periodic() == [false; 2];
        is_smooth && is_free && !is_strip
    }

    fn isolated_line(&self, name: &'static str, coefficient: f64, exponent: f64) -> Option<Exact> {
        let (length, dx, contact_modulus) = (self.grid.size()[1], self.grid.spacing()[1], self.contact_modulus);
        let contact = PowerLaw { geometry: Geometry::Line, coefficient, exponent, contact_modulus };
        let a = contact.half_width(self.mean_pressure * length);
        let max_pressure = Some(contact.pressure(a, 0.0)).filter(|p| p.is_finite());
        let core = if max_pressure.is_none() { 0.5 * dx / E } else { 0.0 };
        let is_known = PowerLaw::EXPONENTS.contains(&exponent) && a < 0.5 * length;
        is_known.then(|| Exact {
            kappa_r: Some(contact.kappa_r()),
            max_pressure,
            ..self.exact(name, 2.0 * a / length, |[_, x]| contact.pressure(a, x.abs().max(core)))
        })
    }

    fn strip(&self, half_width: f64, depth: f64) -> Option<Exact> {
        let (period, dx) = (self.grid.size()[1], self.grid.spacing()[1]);
        let (mean, modulus) = (self.mean_pressure, self.contact_modulus);
        let load = |x: f64| mean * period * strip_load(half_width, period, x);
        let relative_area = 2.0 * half_width / period;
        let closed = strip_mean_penetration(mean, half_width, period, modulus);
        let pressure = |[_, x]: [f64; 2]| (load(x + 0.5 * dx) - load(x - 0.5 * dx)) / dx;
        (strip_penetration(mean, half_width, period, modulus) < depth).then(|| Exact {
            mean_gap: Some(depth * (1.0 - relative_area) - closed),
            ..self.exact("Koiter, periodic", relative_area, pressure)
        })
    }

    fn disc(&self, radius: f64, depth: f64) -> Option<Exact> {
        let ([ly, lx], [dy, dx]) = (self.grid.size(), self.grid.spacing());
        let load = self.mean_pressure * lx * ly;
        let half_ring = 0.5 * (dx * dy).sqrt();
        let enclosed = |r: f64| load * (1.0 - (1.0 - (r / radius).min(1.0).powi(2)).sqrt());
        let pressure = |[y, x]: [f64; 2]| {
            let (inner, outer) = ((x.hypot(y) - half_ring).max(0.0), x.hypot(y) + half_ring);
            (enclosed(outer) - enclosed(inner)) / (PI * (outer - inner) * (outer + inner))
        };
        let approach = load / (2.0 * self.contact_modulus * radius);
        let relative_area = PI * radius * radius / (lx * ly);
        (approach < depth).then(|| Exact {
            contact_radius: Some(radius),
            ..self.exact("disc punch, isolated", relative_area, pressure)
        })
    }

    /// A solution of `pressure` at the offset `[y, x]` from the peak, of which nothing else is known.
    fn exact(&self, name: &'static str, relative_area: f64, pressure: impl Fn([f64; 2]) -> f64 + Sync) -> Exact {
        let pressure = about_peak(self.grid, pressure);
        let contact_radius = self.grid.is_line().then(|| 0.5 * relative_area * self.grid.area());
        Exact { name, relative_area, contact_radius, kappa_r: None, max_pressure: None, mean_gap: None, pressure }
    }
}
