//! The state of a contact after a step with friction.

use super::slip_totals::SlipTotals;
use crate::contact::{Contact, Feels, FieldKind, Quantity, ResultClaim, State, StateField, StateValues, Work};
use crate::surface::Field;
use ndarray::Array2;
use serde::Serialize;

/// The state of a contact under a normal and a tangential load, after a step of a [`crate::history::SlipHistory`].
///
/// | field      | shape      | unit     | meaning                                                                     |
/// |------------|------------|----------|-----------------------------------------------------------------------------|
/// | `traction` | `(ny, nx)` | pressure | `tau` along `x` on the solid, `|tau| <= mu p`, of mean `tangential`         |
/// | `traction_across` | `(ny, nx)` | pressure | `tau` along `y`, of mean `tangential_across`                 |
/// | `slip`     | `(ny, nx)` | length   | slip along `x` in this step, `s = A (tau - tau_0) - delta`; zero where the solid sticks |
/// | `slip_across` | `(ny, nx)` | length | slip along `y` in this step                                                      |
/// | `zones`    | `(ny, nx)` |          | whether a node is open, sticks, or slips, and in which direction            |
///
/// The fields along `y` are none on lines, and on surfaces where the step was along `x` alone, see [`crate::history::SlipHistory`].
#[derive(Debug, Clone)]
pub struct SlipState {
    /// The contact under the normal load. With coupling its displacement is the whole one, by pressure and traction.
    pub contact: Contact,
    /// The mean traction along `x`, a pressure.
    pub tangential: f64,
    /// The mean traction along `y`, a pressure.
    pub tangential_across: f64,
    /// The traction along `x` on the surface of the solid.
    pub traction: Field,
    /// The traction along `y` on the surface of the solid; none where the step was along `x` alone.
    pub traction_across: Option<Field>,
    /// The slip in this step: the displacement of the surface of the solid along `x` relative to the rigid surface.
    pub slip: Field,
    /// The slip along `y` in this step; none where the step was along `x` alone.
    pub slip_across: Option<Field>,
    /// The zone of each node.
    pub zones: Array2<Zone>,
    /// The shift `delta` of the rigid surface along `x` in this step, a length. On a periodic grid it is measured from the mean
    /// displacement of the solid, on a free line from the datum of line loads.
    pub shift: f64,
    /// The shift along `y` in this step, a length.
    pub shift_across: f64,
    /// The energy that friction dissipates in this step, per area of the cell: `<mu p |s|>`, with the mean of the pressures before and
    /// after the step.
    pub dissipated: f64,
    /// The elastic energy of the traction after this step, per area of the cell: `<tau A_t tau>/2`. The work of the tangential load is
    /// the increase of this energy plus the dissipated energy, under a normal load that stays and without coupling.
    pub stored: f64,
    /// The error of the traction, for the pressure as it is.
    pub certificate: SlipCertificate,
    /// The certificate `eta` of the pressure, for the traction as it is.
    pub pressure_certificate: f64,
    /// Rounds between pressure and traction; 1 without coupling.
    pub rounds: usize,
    /// What the certificates prove together.
    pub claim: ResultClaim,
    /// Work of the solvers in this step, normal and tangential.
    pub work: Work,
}

/// The zone of a node in a contact with friction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Zone {
    /// It does not touch.
    Open,
    /// It sticks: the traction is below `mu p`.
    Stick,
    /// It slips, with the traction `+mu p` on the solid: the rigid surface moves towards `+x` over the solid. Where there are tractions
    /// along both axes it slips in any direction, and the traction along `x` is not negative.
    Forward,
    /// It slips, with the traction `-mu p` on the solid; with a negative traction along `x` where there are tractions along both axes.
    Backward,
}

/// Rigorous bounds of the error of a traction `tau`, for the pressure and the traction before the step as they are.
///
/// A step minimises `f(tau) = 1/2 <tau A tau> - <tau A tau_0>` over `|tau| <= mu p` with `<tau>` given. With the slip `s`,
///
/// `f(tau) - f* <= G = <tau s> + <mu p |s|>` (where there are two components, `tau s` is their scalar product and `|s|` a length),
///
/// a sum of terms that are not negative and vanish where Coulomb's law holds, for any shift in `s`; and
/// `<(tau - tau*) A (tau - tau*)> <= G`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SlipCertificate {
    /// `eta = G / (mu <p> l)`: the gap over the work of sliding by the length `l`, the rms of the displacement by `mu p`. Zero
    /// without friction.
    pub eta: f64,
    /// The bound of `|tau - tau*| / |mu p|` in the norm `|x|^2 = <x A x>`. Zero without friction.
    pub traction_error_bound: f64,
}

impl SlipState {
    /// Nodes that stick.
    pub fn sticks(&self) -> Array2<bool> {
        self.zones.mapv(|zone| zone == Zone::Stick)
    }

    /// Nodes that slip.
    pub fn slips(&self) -> Array2<bool> {
        self.zones.mapv(|zone| matches!(zone, Zone::Forward | Zone::Backward))
    }

    /// The share of the nodes in contact that stick; NaN without contact.
    pub fn stick_share(&self) -> f64 {
        let count = |of: fn(&Zone) -> bool| self.zones.iter().filter(|zone| of(zone)).count() as f64;
        count(|zone| *zone == Zone::Stick) / count(|zone| *zone != Zone::Open)
    }

    /// The share of the nodes in contact that stick beside one that slips: where sticking ends between two nodes is not known better than by one of them.
    pub(super) fn stick_edge_share(&self) -> f64 {
        let (grid, zones) = (self.contact.problem.surface().grid(), self.zones.as_slice().expect("standard layout"));
        let slips = |node: usize| matches!(zones[node], Zone::Forward | Zone::Backward);
        let beside = [[0, 1], [0, -1], [1, 0], [-1, 0]];
        let is_edge =
            |node: &usize| zones[*node] == Zone::Stick && beside.iter().any(|way| slips(grid.neighbour(*node, *way)));
        let touching = zones.iter().filter(|zone| **zone != Zone::Open).count();
        if touching > 0 { (0..grid.len()).filter(is_edge).count() as f64 / touching as f64 } else { 0.0 }
    }

    /// The mean displacement by the traction, weighted with it, a length; 0 without traction.
    pub(super) fn displacement_by_traction(&self) -> f64 {
        let along = self.traction.iter().map(|tau| tau.abs()).sum::<f64>();
        let across = self.traction_across.iter().flatten().map(|tau| tau.abs()).sum::<f64>();
        let mean = (along + across) / self.traction.len() as f64;
        if mean > 0.0 { 2.0 * self.stored / mean } else { 0.0 }
    }

    /// This state, after another one that lies between it and the beginning of the way: slip, shift, lost energy and work are those of the whole way.
    pub(super) fn after(mut self, earlier: Self) -> Self {
        self.slip += &earlier.slip;
        if let (Some(slip), Some(before)) = (&mut self.slip_across, &earlier.slip_across) {
            *slip += before;
        }
        self.shift += earlier.shift;
        self.shift_across += earlier.shift_across;
        self.dissipated += earlier.dissipated;
        self.work += earlier.work;
        self.rounds = self.rounds.max(earlier.rounds);
        // what was missed on the way is missed at its end
        if self.contact.is_converged() {
            self.contact.status = earlier.contact.status;
        }
        self
    }

    /// The state as one of any history, with what all steps since the beginning add up to.
    pub fn into_state(self, point: Option<usize>, totals: SlipTotals) -> State {
        let SlipTotals { shift, dissipated, errors } = totals;
        let values = StateValues::new(Feels::PRESSURE)
            .with(Quantity::MeanTraction, self.tangential)
            .with(Quantity::Friction, self.tangential / self.contact.mean_pressure())
            .with(Quantity::Shift, shift)
            .with(Quantity::StickShare, self.stick_share())
            .with(Quantity::Dissipated, dissipated)
            .with(Quantity::ShiftPathError, errors.map(|it| it.shift))
            .with(Quantity::StickSharePathError, errors.map(|it| it.stick_share))
            .with(Quantity::DissipatedPathError, errors.map(|it| it.dissipated))
            .with(Quantity::Stored, self.stored)
            .with(Quantity::TractionCertificate, self.certificate.eta);
        // a path along `x` alone has nothing across it
        let given = [
            (FieldKind::Traction, Some(self.traction)),
            (FieldKind::Slip, Some(self.slip)),
            (FieldKind::TractionAcross, self.traction_across),
            (FieldKind::SlipAcross, self.slip_across),
        ];
        let fields = given.into_iter().filter_map(|(kind, values)| Some(StateField::new(kind, values?))).collect();
        let contact = self.contact.with_work(self.work).with_values(values);
        State::new(contact, self.claim).at(point).with_fields(fields)
    }

    /// Whether both the normal contact and the traction met their goals.
    pub fn is_converged(&self) -> bool {
        self.contact.is_converged()
    }
}
