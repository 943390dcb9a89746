//! A process that makes the next state of a contact from the last one.

use crate::contact::{Contact, Load, Observer, ResultClaim, Work};
use crate::error::HistoryError;
use crate::surface::Field;
use serde::Serialize;

/// A point of the path of a history. Between two points, loads change linearly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathPoint {
    /// The time, for solids that creep.
    pub time: Option<f64>,
    /// The normal load. Its number may be zero: then nothing touches.
    pub load: Load,
    /// The tangential load, of the same kind as the normal one and of any sign, where there is friction.
    pub tangential: Option<f64>,
}

/// A process that makes the next state of a contact from the last one: creep, slip, sliding, rolling. It knows its path.
///
/// Tables, recordings and pictures know states, and no process.
pub trait Process {
    /// Goes along the path, and gives each state to `each` as soon as it is solved. The observer sees the steps of all solves.
    ///
    /// # Errors
    /// An error for a load that is impossible, and those of the solver and of `each`. The history ends there.
    fn run(&mut self, observer: &mut dyn Observer, each: &mut EachState<'_>) -> Result<(), HistoryError>;
}

/// What receives the states of a history.
pub type EachState<'e> = dyn FnMut(HistoryState) -> Result<(), HistoryError> + 'e;

/// A state of a history: the contact, and what the process knows besides.
#[derive(Debug, Clone)]
pub struct HistoryState {
    /// The contact under the normal load of the state.
    pub contact: Contact,
    /// The point of the path that it has reached, from 0; none between two points.
    pub point: Option<usize>,
    /// The claim of the state: what its certificate proves about energy, pressure and mean gap.
    pub claim: ResultClaim,
    /// The numbers of the process; those of [`HISTORY_QUANTITIES`](crate::history::HISTORY_QUANTITIES).
    pub numbers: HistoryNumbers,
    /// Further fields of the process, by their names.
    pub fields: Vec<HistoryField>,
    /// Work since the last state.
    pub work: Work,
}

/// A field of a state besides those of its contact.
#[derive(Debug, Clone)]
pub struct HistoryField {
    /// Its name, such as `traction`.
    pub name: &'static str,
    /// Its title in pictures.
    pub title: &'static str,
    /// Its symbol on an axis, with what it is divided by: the contact modulus, or the rms height.
    pub symbol: &'static str,
    /// Whether it is a pressure; else it is a length.
    pub is_pressure: bool,
    /// Its values, shape `(ny, nx)`.
    pub values: Field,
}

/// The numbers of a state that belong to its process. A number that the process does not have is `None`.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct HistoryNumbers {
    /// Time since the beginning.
    pub time: Option<f64>,
    /// Speed of sliding, a length per time.
    pub speed: Option<f64>,
    /// Contact modulus in `kappa_r` of a contact that slides over a viscoelastic solid, a pressure.
    pub effective_modulus: Option<f64>,
    /// Creepage of rolling.
    pub creepage: Option<f64>,
    /// Mean traction along `x` on the solid, a pressure.
    pub mean_traction: Option<f64>,
    /// Tangential force divided by normal force.
    pub friction: Option<f64>,
    /// Force perpendicular to the motion divided by the normal force, of surfaces that slide.
    pub lateral_friction: Option<f64>,
    /// The friction in full contact under the same load.
    pub friction_full_contact: Option<f64>,
    /// The friction of Persson's theory of partial contact.
    pub friction_persson: Option<f64>,
    /// Mean of the effective pressure `p + sum eps_j` of a solid that creeps.
    pub effective_pressure: Option<f64>,
    /// Relative area, with edges resolved by the effective pressure, where it differs from the pressure.
    pub relative_area: Option<f64>,
    /// `kappa_r` with the effective modulus.
    pub kappa_r: Option<f64>,
    /// Shift of the rigid surface along `x` since the beginning, a length.
    pub shift: Option<f64>,
    /// Share of the nodes in contact that stick.
    pub stick_share: Option<f64>,
    /// Dissipated energy since the beginning, per area of the cell.
    pub dissipated: Option<f64>,
    /// Estimated error of the energy that jumps have lost with adhesion on a periodic grid, per area of the cell.
    pub dissipated_error: Option<f64>,
    /// Stored elastic energy, per area of the cell: all of it for a solid that creeps, that of the traction alone with friction.
    pub stored: Option<f64>,
    /// Work of the load since the beginning, per area of the cell.
    pub work_done: Option<f64>,
    /// Estimated relative error of the contact pressure, root mean square, that the length of the steps in time causes.
    pub time_error: Option<f64>,
    /// Estimated error in time of the mean pressure, a pressure.
    pub mean_pressure_time_error: Option<f64>,
    /// Estimated error in time of the mean gap, a length.
    pub mean_gap_time_error: Option<f64>,
    /// Estimated error in time of the relative area.
    pub relative_area_time_error: Option<f64>,
    /// Estimated error in time of the dissipated energy, per area of the cell.
    pub dissipated_time_error: Option<f64>,
    /// Estimated error in time of the work of the load and of the stored energy, per area of the cell.
    pub work_time_error: Option<f64>,
    /// Bound of the relative error of the effective pressure that the solver caused in all steps so far.
    pub history_bound: Option<f64>,
    /// Certificate of the traction.
    pub traction_certificate: Option<f64>,
    /// Mean of the contact pressure less that of the attraction, with adhesion.
    pub net_pressure: Option<f64>,
    /// Mean of the attraction, a pressure.
    pub attraction: Option<f64>,
    /// Energy lost in the jump that ends with this state, per area of the cell.
    pub jump: Option<f64>,
    /// The largest violation of equilibrium at a node: see [`AdhesiveState`](crate::adhesion::AdhesiveState).
    pub residual: Option<f64>,
    /// The least curvature of the energy over that of the softest wave of the solid; positive where the state is stable.
    pub least_curvature: Option<f64>,
    /// The error of the least curvature: there is an eigenvalue that is at most so far away.
    pub curvature_error: Option<f64>,
}

impl HistoryField {
    /// The traction along `x` on the solid.
    pub fn traction(values: Field) -> Self {
        let (title, symbol) = ("Traction along x on the solid", "τ / E*");
        Self { name: "traction", title, symbol, is_pressure: true, values }
    }

    /// The slip of the surface of the solid along `x` relative to the rigid surface, from the state before to this one.
    pub fn slip(values: Field) -> Self {
        let (title, symbol) = ("Slip of the solid along x in this step", "slip / h_rms");
        Self { name: "slip", title, symbol, is_pressure: false, values }
    }

    /// The traction along `y` on the solid.
    pub fn traction_across(values: Field) -> Self {
        let (title, symbol) = ("Traction along y on the solid", "τ_y / E*");
        Self { name: "traction_across", title, symbol, is_pressure: true, values }
    }

    /// The slip of the surface of the solid along `y` relative to the rigid surface, from the state before to this one.
    pub fn slip_across(values: Field) -> Self {
        let (title, symbol) = ("Slip of the solid along y in this step", "slip_y / h_rms");
        Self { name: "slip_across", title, symbol, is_pressure: false, values }
    }

    /// The traction by which the surfaces attract each other.
    pub fn attraction(values: Field) -> Self {
        let (title, symbol) = ("Attraction between the surfaces", "σ / E*");
        Self { name: "attraction", title, symbol, is_pressure: true, values }
    }

    /// What a solid that creeps remembers, as the pressure that would cause the same displacement of the glassy solid.
    pub fn remembered(values: Field) -> Self {
        let (title, symbol) = ("Stored strain, as a pressure", "Σ ε / E*");
        Self { name: "stored_strain", title, symbol, is_pressure: true, values }
    }
}
