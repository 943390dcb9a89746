//! The largest stable time step of molecular dynamics, measured beside theory.
//!
//! The solver refuses steps beyond its limit, so the motion is integrated here by a few lines of Verlet's scheme: undamped,
//! on a small line, with the wall holding all nodes of a set. A step is too large if the motion grows. Then the solver
//! itself runs close to its limit.

use super::judge::judge;
use super::report::TrialReport;
use super::trial::Trial;
use super::verdict::TrialVerdict;
use crate::contact::{Dynamics, Gfmd, Load, Masses};
use crate::elastic::Response;
use crate::error::GridError;
use crate::grid::Grid;
use crate::lab::Rival;
use crate::lab::table::or_dash;
use crate::setup::{Cell, Method, Recipe, Setup};
use crate::surface::Spectrum;
use std::fmt;
use std::time::Duration;

/// Points of the integrated line.
const POINTS: usize = 64;
/// Time step of the solver, close to its limit of 1.
const TIME_STEP: f64 = 0.99;

/// A motion whose limit is measured.
struct TestMotion {
    name: &'static str,
    masses: Masses,
    is_free: fn(usize) -> bool,
}

const MOTIONS: [TestMotion; 3] = [
    TestMotion { name: "uniform masses, no wall", masses: Masses::Uniform, is_free: |_| true },
    TestMotion { name: "masses by stiffness, no wall", masses: Masses::Stiffness, is_free: |_| true },
    TestMotion { name: "masses by stiffness, one free node", masses: Masses::Stiffness, is_free: |i| i == 0 },
];

/// Names and settings of solves close to the limit.
const VARIANTS: [(&str, Gfmd); 4] = [
    ("uniform masses, damped", close_to_limit(Masses::Uniform, Dynamics::Damped)),
    ("uniform masses, FIRE", close_to_limit(Masses::Uniform, Dynamics::Fire)),
    ("masses by stiffness, damped", close_to_limit(Masses::Stiffness, Dynamics::Damped)),
    ("masses by stiffness, FIRE", close_to_limit(Masses::Stiffness, Dynamics::Fire)),
];

const fn close_to_limit(masses: Masses, dynamics: Dynamics) -> Gfmd {
    Gfmd { masses, dynamics, time_step: TIME_STEP, damping: 1.0 }
}

/// The largest stable time steps, over `2 sqrt(m / k)`, and solves close to them; displays as a table.
pub struct TimeSteps {
    /// Name, measured limit and limit in theory of each motion.
    limits: [(&'static str, f64, f64); 3],
    /// Reports of solves close to the limit.
    reports: [TrialReport; 4],
}

impl TimeSteps {
    /// Measures all limits, and runs the solver close to its own.
    ///
    /// # Errors
    /// None that is known: the grid is fixed.
    pub fn measure() -> Result<Self, GridError> {
        let grid = Grid::line(POINTS, 1.0)?;
        let limits = MOTIONS.map(|motion| (motion.name, motion.largest_stable(&grid), motion.theory(&grid)));
        Ok(Self { limits, reports: VARIANTS.map(|(name, gfmd)| report_on(name, gfmd)) })
    }

    /// Whether all is as theory says.
    pub fn agrees(&self) -> bool {
        let agrees = |&(_, measured, theory): &(_, f64, f64)| (measured / theory - 1.0).abs() < 1e-4;
        self.limits.iter().all(agrees) && self.reports.iter().all(|report| report.verdict == TrialVerdict::Converged)
    }
}

impl fmt::Display for TimeSteps {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "largest stable time step over 2 sqrt(m/k) {:>9} {:>9}", "measured", "theory")?;
        for (name, measured, theory) in &self.limits {
            writeln!(f, "{name:<41} {measured:>9.4} {theory:>9.4}")?;
        }
        writeln!(f, "\ngfmd at {TIME_STEP} of its limit {:>20} {:>9}", "steps", "eta")?;
        for TrialReport { solver, iterations, eta, verdict, .. } in &self.reports {
            let steps = or_dash(*iterations, |steps| steps.to_string());
            writeln!(f, "{solver:<27} {steps:>20} {:>9} {verdict}", or_dash(*eta, |eta| format!("{eta:.1e}")))?;
        }
        Ok(())
    }
}

/// The report of a solve close to the limit.
fn report_on(name: &'static str, gfmd: Gfmd) -> TrialReport {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 1.0 / 32.0, rms_gradient: 0.1 };
    let setup = Setup::new(Recipe::rough(spectrum, 1), Cell::line(256, 1.0), Load::ReducedPressure(0.1));
    let rival = Rival { name, title: name, about: "close to the limit of its time step", method: Method::Gfmd(gfmd) };
    judge(&Trial::new("time-step", move || setup.problem()), &rival, Duration::MAX, |_| Box::new(()))
}

impl TestMotion {
    /// The largest stable step, by bisection between a step of 0 and twice the limit of free waves.
    fn largest_stable(&self, grid: &Grid) -> f64 {
        let [mut stable, mut unstable] = [0.0, 2.0];
        for _ in 0..20 {
            let middle = 0.5 * (stable + unstable);
            *(if self.grows(grid, middle) { &mut unstable } else { &mut stable }) = middle;
        }
        stable
    }

    /// The largest stable step in theory. Free waves allow 1. The frequency of a lone free node is `sqrt(<k> <1/m>)`.
    fn theory(&self, grid: &Grid) -> f64 {
        if (0..POINTS).all(self.is_free) {
            return 1.0;
        }
        let softest = Response::half_space(grid, 1.0).softest_stiffness();
        let (mut stiffness, mut mobility) = (0.0, 0.0);
        for (q, count) in grid.wavenumbers().zip(grid.multiplicities()) {
            let k = 0.5 * q;
            stiffness += count * k / POINTS as f64;
            mobility += count / k.max(softest) / POINTS as f64;
        }
        1.0 / (stiffness * mobility).sqrt()
    }

    /// Whether an undamped motion grows with the time step `step`, in units of the limit of free waves.
    fn grows(&self, grid: &Grid, step: f64) -> bool {
        let mut response = Response::half_space(grid, 1.0);
        // the mean has the mass of the longest wave
        let (softest, stiffest) = (response.softest_stiffness(), response.stiffnesses().fold(0.0, f64::max));
        let (mut f, mut a) = (vec![0.0; POINTS], vec![0.0; POINTS]);
        let noise = |i: usize| if (self.is_free)(i) { ((i * i) as f64 * 0.7).sin() + 0.1 } else { 0.0 };
        let mut w: Vec<f64> = (0..POINTS).map(noise).collect();
        let mut dw = vec![0.0; POINTS];
        // in this number of steps, an unstable motion grows by a factor of a million
        for _ in 0..4000 {
            response.pressure(&w, &mut f);
            (0..POINTS).for_each(|i| f[i] = if (self.is_free)(i) { -f[i] } else { 0.0 });
            match self.masses {
                Masses::Uniform => (0..POINTS).for_each(|i| a[i] = f[i] / stiffest),
                Masses::Stiffness => {
                    response.displacement(&f, &mut a);
                    let mean = f.iter().sum::<f64>() / POINTS as f64 / softest;
                    a.iter_mut().for_each(|a| *a += mean);
                }
            }
            for i in (0..POINTS).filter(|&i| (self.is_free)(i)) {
                dw[i] += 4.0 * step * step * a[i];
                w[i] += dw[i];
            }
            if dw.iter().any(|dw| dw.abs() > 1e6) {
                return true;
            }
        }
        false
    }
}
