//! Green's function molecular dynamics: damped dynamics of the surface modes against a hard wall.
//!
//! Letters of this file: `w = u + d` the surface of the solid in the frame of the indenter, `h` the indenter, `k = E* q / 2`
//! the stiffness of a mode, `m` its mass, `s = dt^2 / m` of the stiffest mode, `f` the net force, `a` the advance that the
//! forces make in a step, `dw` the last advance of `w`, `p` the constraint forces of the wall.

mod moving;
mod pace;
mod probe;

use crate::contact::result::Ended;
use crate::contact::solver::Run;
use crate::contact::{Contact, Load, Observer, Problem, Solver, Stop};
use crate::error::{SettingError, SolveError};
use crate::surface::Field;
use moving::Moving;
use pace::Pace;
use probe::Probe;

/// Masses of the surface modes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Masses {
    /// The same mass for every mode, as in the paper: long waves are `n/2` times softer than short ones and relax last.
    Uniform,
    /// Masses proportional to the stiffness of the mode, so that all modes swing alike; but waves longer than the distance of
    /// contact segments, and the mean, are held by the contacts and get the mass of the wave that is just as long.
    Stiffness,
}

/// How the motion is damped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dynamics {
    /// A constant friction, given in units of the critical damping of the slowest mode.
    Damped,
    /// Fast inertial relaxation: velocities turn towards the force, and are dropped when the power becomes negative.
    Fire,
}

/// Green's function molecular dynamics (Campana & Mueser 2006), the method of the paper.
///
/// Integrates `m_q w_q'' = -k_q w_q - <p> delta_q0 + p_q - friction` with the hard wall `w >= h` in real space, where the wall's
/// constraint forces `p >= 0` are the contact pressure, until they balance.
///
/// Nodes at the wall that are pushed onto it are held: the wall's force balances theirs, and they take no part in the motion.
/// With uniform masses that is the projection of the step onto `w >= h`, as in the paper. With masses proportional to stiffness
/// the inertia acts among the free nodes only; the state of rest is the same.
///
/// A step costs one transform pair with uniform masses and two with masses proportional to stiffness; the certificate is
/// computed at a share of the steps that falls to one in fifty, for one pair more. Memory: 8 fields of n doubles and two
/// [`crate::elastic::HalfSpace`]s.
///
/// It works under a mean pressure only: at a mean gap it returns [`SolveError::NeedsPressure`].
///
/// # Why it is stable
/// Verlet's scheme follows a mode of frequency `omega` up to `omega dt = 2`, under any friction that acts on the mean of
/// the advances before and after (on the one before alone, it would lower the limit). With uniform masses the stiffest mode
/// sets the limit, and putting nodes back onto the wall is not expansive. With masses proportional to stiffness every free
/// wave has the same frequency, but holding nodes couples waves and raises it: for a single free node among held ones to
/// `<k> <1/k>` (about `ln(n) / 2` on a line), of which twice is allowed for; for long waves that would have to move against
/// the contacts, which is why their masses have a floor.
///
/// # Source
/// Campana & Mueser, Phys. Rev. B 74, 075420 (2006); Prodanov, Dapp & Mueser, Tribol. Lett. 53, 433 (2014); FIRE: Bitzek et
/// al., Phys. Rev. Lett. 97, 170201 (2006), and for contacts Zhou, Moseler & Mueser, Phys. Rev. B 99, 144103 (2019).
/// Deviations: held nodes and the floor of the masses, as said; the stop by [`crate::contact::Certificate`].
///
/// ```
/// use asperity::{Grid, Problem, Stop, surface::Indenter, contact::{Gfmd, Solver}};
/// let cylinder = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(256, 4.0)?)?;
/// let problem = Problem::new(cylinder, 1.0, 1e-2)?;
/// let contact = Gfmd::default().solve(&problem, &Stop::default(), &mut ())?;
/// // Hertz: a^2 = 4 R P / (pi E*)
/// let area = 2.0 * (4.0 * 0.04 / std::f64::consts::PI).sqrt() / 4.0;
/// assert!((contact.measures(&problem).relative_area_corrected - area).abs() < 1.0 / 256.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gfmd {
    masses: Masses,
    dynamics: Dynamics,
    time_step: f64,
    damping: f64,
}

impl Gfmd {
    /// The method with its settings.
    ///
    /// | argument    | meaning                                                    | range  |
    /// |-------------|------------------------------------------------------------|--------|
    /// | `masses`    | masses of the modes                                        |        |
    /// | `dynamics`  | how the motion is damped                                   |        |
    /// | `time_step` | `dt` over the stability limit of the stiffest mode         | (0, 1) |
    /// | `damping`   | friction over the critical one of the slowest mode         | (0, inf) |
    ///
    /// # Errors
    /// [`SettingError::Range`] for a time step or damping outside its range.
    pub fn new(masses: Masses, dynamics: Dynamics, time_step: f64, damping: f64) -> Result<Self, SettingError> {
        if !(time_step > 0.0 && time_step < 1.0) {
            return Err(SettingError::Range { name: "the time step", value: time_step, range: "(0, 1)" });
        }
        if !(damping > 0.0 && damping.is_finite()) {
            return Err(SettingError::Range { name: "the damping", value: damping, range: "(0, infinity)" });
        }
        Ok(Self { masses, dynamics, time_step, damping })
    }
}

impl Default for Gfmd {
    /// The paper's way: uniform masses, plain damping; half of the stable time step.
    fn default() -> Self {
        Self { masses: Masses::Uniform, dynamics: Dynamics::Damped, time_step: 0.5, damping: 1.0 }
    }
}

impl Solver for Gfmd {
    fn name(&self) -> &'static str {
        "gfmd"
    }

    fn settings(&self) -> String {
        let masses = match self.masses {
            Masses::Uniform => "uniform masses",
            Masses::Stiffness => "masses proportional to mode stiffness",
        };
        let dynamics = match self.dynamics {
            Dynamics::Damped => format!("damping {} of critical", self.damping),
            Dynamics::Fire => "FIRE".into(),
        };
        format!("{masses}, {dynamics}, time step {} of the stability limit", self.time_step)
    }

    fn solve_from(
        &self,
        start: Option<&Field>,
        problem: &Problem,
        stop: &Stop,
        observer: &mut dyn Observer,
    ) -> Result<Contact, SolveError> {
        if let Load::MeanGap(_) = problem.load() {
            return Err(SolveError::NeedsPressure { solver: self.name() });
        }
        let mut run = Run::new(stop, observer);
        let mut surface = Moving::new(start, problem, self.masses);
        let mut probe = Probe::new(problem);
        let mut pace = Pace::new(self, &surface.stiffnesses());
        let status = loop {
            surface.pull();
            let certificate = probe.certify(problem, surface.pressure(), &mut run);
            let transforms = surface.transforms() + probe.transforms();
            if let Some(status) = surface.show(&mut run, transforms, certificate) {
                break status;
            }
            surface.advance(&mut pace);
            run.advance();
        };
        let work = run.work(surface.transforms() + probe.transforms());
        let half_space = probe.into_half_space();
        drop(surface);
        let pressure = run.best.pressure.take();
        run.finish(problem, pressure, half_space, Ended { work, status, solver: self.name() })
    }
}
