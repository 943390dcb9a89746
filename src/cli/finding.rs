//! The findings of a solve under one load: status, observables, and the exact solution where there is one.

use asperity::contact::{Contact, OBSERVABLES, Observables, Status};
use asperity::setup::Setup;
use asperity::theory::Exact;
use serde::Serialize;

/// Observables in the rows that hold several or have a form of their own.
const TOLD: [&str; 29] = [
    "mean_pressure",
    "reduced_pressure",
    "reduced_pressure_contact",
    "relative_area",
    "relative_area_corrected",
    "relative_area_resolved",
    "relative_area_error",
    "rms_gradient",
    "rms_gradient_contact",
    "rms_gradient_contact_corrected",
    "rms_gradient_contact_resolved",
    "kappa",
    "kappa_corrected",
    "kappa_resolved",
    "kappa_r",
    "kappa_r_corrected",
    "kappa_r_resolved",
    "kappa_r_error",
    "mean_gap",
    "mean_gap_over_rms_height",
    "max_pressure",
    "patches",
    "nodes_per_patch",
    "unresolved_share",
    "edges_of_shape",
    "certificate",
    "pressure_error_bound",
    "iterations",
    "transforms",
];

/// The numbers of a contact under its load.
#[derive(Serialize)]
pub struct Finding {
    pub status: Status,
    #[serde(flatten)]
    pub observables: Observables,
    pub seconds: f64,
    /// The exact solution under the same mean pressure.
    #[serde(skip_serializing_if = "Option::is_none")]
    exact: Option<Exact>,
}

impl Finding {
    pub fn of(setup: &Setup, contact: &Contact) -> Self {
        Self {
            status: contact.status,
            observables: Observables::of(contact),
            seconds: contact.work.seconds,
            exact: setup.exact(contact.problem.surface().grid(), contact.mean_pressure()),
        }
    }

    /// Names and values for reading.
    pub fn rows(&self) -> Vec<(String, String)> {
        let it = &self.observables;
        let exact = |value: Option<f64>| value.map_or(String::new(), |v| format!("   exact {v:.6}"));
        let area = exact(self.exact.as_ref().map(|exact| exact.relative_area));
        let kappa_r = exact(self.exact.as_ref().and_then(|exact| exact.kappa_r));
        let counted = |resolved: f64, counted: f64, corrected: f64| match resolved.is_nan() {
            true => format!("not resolved (counted {counted:.6})"),
            false => format!("{resolved:.6} (counted {counted:.6}, corrected {corrected:.6})"),
        };
        let percent =
            |share: f64| if share.is_nan() { "unknown".to_owned() } else { format!("{:.2} %", 100.0 * share) };
        let of_shape = match it.edges_of_shape {
            0 => String::new(),
            edges => format!(", {edges} edges given by the shape"),
        };
        let rows = [
            (
                "reduced pressure p*",
                format!("{:.6e} (contact {:.6e})", it.reduced_pressure, it.reduced_pressure_contact),
            ),
            ("relative area", counted(it.relative_area_resolved, it.relative_area, it.relative_area_corrected) + &area),
            ("rms gradient", format!("{:.6e} (contact {:.6e})", it.rms_gradient, it.rms_gradient_contact_resolved)),
            ("kappa", counted(it.kappa_resolved, it.kappa, it.kappa_corrected)),
            ("kappa_r", counted(it.kappa_r_resolved, it.kappa_r, it.kappa_r_corrected) + &kappa_r),
            (
                "grid error, estimated",
                format!("area {}, kappa_r {}", percent(it.relative_area_error), percent(it.kappa_r_error)),
            ),
            ("mean gap", format!("{:.6e} ({:.4} rms heights)", it.mean_gap, it.mean_gap_over_rms_height)),
            ("pressure, mean and max", format!("{:.6e} {:.6e}", it.mean_pressure, it.max_pressure)),
            (
                "contact patches",
                format!(
                    "{} ({:.2} nodes each, {:.1} % of the contact in those too small to trust){of_shape}",
                    it.patches,
                    it.nodes_per_patch,
                    100.0 * it.unresolved_share
                ),
            ),
            ("certificate", format!("{:.2e} (pressure within {:.1e})", it.certificate, it.pressure_error_bound)),
            ("work", format!("{} steps, {} transforms, {:.3} s", it.iterations, it.transforms, self.seconds)),
        ];
        let exact = self.exact.as_ref().map(|exact| ("exact values", exact.name.to_owned()));
        let rows = rows.into_iter().chain(exact).map(|(name, value)| (name.to_owned(), value));
        rows.chain(self.others()).collect()
    }

    /// The observables that no other row holds.
    fn others(&self) -> impl Iterator<Item = (String, String)> {
        let values = serde_json::to_value(self.observables).unwrap_or_default();
        let others = OBSERVABLES.iter().filter(|observable| !TOLD.contains(&observable.name));
        others.filter_map(move |observable| {
            Some((observable.name.replace('_', " "), format!("{:.6e}", values[observable.name].as_f64()?)))
        })
    }
}
