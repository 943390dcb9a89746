//! The settings of Green's function molecular dynamics.

use crate::error::SettingError;
use serde::{Deserialize, Serialize};
use strum::{EnumIter, EnumMessage, IntoStaticStr};

/// Masses of the surface modes.
///
/// Under uniform masses long waves are `n/2` times softer than short ones and relax last. With masses proportional to
/// stiffness, all modes oscillate with the same period. But waves longer than the distance between contact segments,
/// and the mean, are held by the contacts. They get the mass of the wave whose length is this distance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, EnumIter, EnumMessage, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Masses {
    /// The same for all modes.
    ///
    /// So it is in the paper.
    Uniform,
    /// Proportional to the stiffness of the mode.
    Stiffness,
}

/// Damping of the motion.
///
/// FIRE turns velocities towards the force, and sets them to zero when the power becomes negative.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, EnumIter, EnumMessage, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Dynamics {
    /// Constant friction.
    ///
    /// Its unit is the critical damping of the slowest mode.
    Damped,
    /// Fast inertial relaxation engine.
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
/// A step costs one transform pair with uniform masses and two with masses proportional to stiffness; the certificate
/// needs one more pair, and is computed at a decreasing share of the steps, at last every fiftieth. Memory: 8 fields of
/// n doubles and two [`crate::elastic::Response`]s.
///
/// The method works under a mean pressure only: at a mean gap it returns [`crate::error::SolveError::NeedsPressure`].
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
/// use asperity::contact::{ContactModulus, Gfmd, Load, Solver};
/// use asperity::{Grid, Indenter, Problem, Stop};
/// let cylinder = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(256, 4.0)?)?;
/// let problem = Problem::new(cylinder, ContactModulus(1.0), Load::MeanPressure(1e-2))?;
/// let contact = Gfmd::default().solve(&problem, &Stop::default(), &mut ())?.converged()?;
/// // Hertz: a^2 = 4 R P / (pi E*)
/// let area = 2.0 * (4.0 * 0.04 / std::f64::consts::PI).sqrt() / 4.0;
/// assert!((contact.counted().relative_area_corrected - area).abs() < 1.0 / 256.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct Gfmd {
    /// Masses of the modes.
    pub masses: Masses,
    /// How the motion is damped.
    pub dynamics: Dynamics,
    /// Time step divided by the stability limit of the stiffest mode, above 0 and below 1.
    pub time_step: f64,
    /// Damping divided by the critical damping of the slowest mode, positive.
    pub damping: f64,
}

impl Gfmd {
    /// Number of fields of doubles that a solve needs at its peak, without the heights.
    pub const FIELDS: f64 = 9.0;

    /// Checks the settings.
    ///
    /// # Errors
    /// [`SettingError::Range`] for a time step or damping outside its range.
    pub fn check(&self) -> Result<(), SettingError> {
        let Self { time_step, damping, .. } = *self;
        if !(time_step > 0.0 && time_step < 1.0) {
            return Err(SettingError::Range { name: "the time step", value: time_step, range: "(0, 1)" });
        }
        if !(damping > 0.0 && damping.is_finite()) {
            return Err(SettingError::Range { name: "the damping", value: damping, range: "(0, infinity)" });
        }
        Ok(())
    }
}

impl Default for Gfmd {
    /// The settings of the paper: uniform masses and constant damping, with half of the stable time step.
    fn default() -> Self {
        Self { masses: Masses::Uniform, dynamics: Dynamics::Damped, time_step: 0.5, damping: 1.0 }
    }
}
