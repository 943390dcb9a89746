//! States of histories made from their numbers, such as those of a file.

use super::{HistoryField, HistoryNumbers, HistoryState};
use crate::contact::{Contact, ResultClaim, StateKind, StateValues, Work};
use crate::surface::Field;

impl HistoryState {
    /// The state of a contact whose numbers, by their names in [`HISTORY_QUANTITIES`](super::HISTORY_QUANTITIES), and further fields are known.
    pub fn from_parts(
        contact: Contact,
        (point, claim): (Option<usize>, ResultClaim),
        number: impl Fn(&str) -> Option<f64>,
        fields: Vec<HistoryField>,
    ) -> Self {
        let has = |name: &str| fields.iter().any(|it| it.name == name);
        let kind = match (has("attraction"), has("stored_strain")) {
            (true, _) => StateKind::Adhesion,
            (false, true) => StateKind::Creep,
            (false, false) => StateKind::Elastic,
        };
        let is_adhesive = kind == StateKind::Adhesion;
        let numbers = HistoryNumbers {
            time: number("time"),
            speed: number("speed"),
            effective_modulus: number("effective_modulus"),
            creepage: number("creepage"),
            mean_traction: number("mean_traction"),
            friction: number("friction"),
            lateral_friction: number("lateral_friction"),
            friction_full_contact: number("friction_full_contact"),
            friction_persson: number("friction_persson"),
            effective_pressure: number("effective_pressure"),
            relative_area: number("relative_area"),
            kappa_r: number("kappa_r"),
            shift: number("shift"),
            stick_share: number("stick_share"),
            dissipated: number("dissipated"),
            dissipated_error: number("dissipated_error"),
            stored: number("stored"),
            work_done: number("work_done"),
            time_error: number("time_error"),
            mean_pressure_time_error: number("mean_pressure_time_error"),
            mean_gap_time_error: number("mean_gap_time_error"),
            relative_area_time_error: number("relative_area_time_error"),
            dissipated_time_error: number("dissipated_time_error"),
            work_time_error: number("work_time_error"),
            history_bound: number("history_bound"),
            traction_certificate: number("traction_certificate"),
            net_pressure: number("mean_pressure").filter(|_| is_adhesive),
            attraction: number("mean_attraction"),
            jump: number("jump"),
            residual: number("residual"),
            least_curvature: number("least_curvature"),
            curvature_error: number("curvature_error"),
        };
        let HistoryNumbers { net_pressure: mean_pressure, relative_area, kappa_r, .. } = numbers;
        // other states have these numbers by their contacts
        let contact = match kind {
            StateKind::Elastic => contact,
            _ => contact.with_values(StateValues { kind, mean_pressure, relative_area, kappa_r }),
        };
        let transforms = number("transforms").map_or(0, |it| it as u64);
        let work = Work { transforms, ..contact.work };
        Self { contact, point, claim, numbers, fields, work }
    }
}

/// The name of a field, and what makes it of its values.
type FieldMaker = (&'static str, fn(Field) -> HistoryField);

impl HistoryField {
    /// The names of all fields, such as `traction`, and what makes them of their values.
    pub const MAKERS: [FieldMaker; 6] = [
        ("traction", Self::traction),
        ("slip", Self::slip),
        ("traction_across", Self::traction_across),
        ("slip_across", Self::slip_across),
        ("attraction", Self::attraction),
        ("stored_strain", Self::remembered),
    ];
}
