//! The findings of a solve under one load: status, observables, and the exact solution where there is one.

use asperity::contact::{Contact, OBSERVABLES, Observables, Status};
use asperity::setup::Setup;
use asperity::theory::Exact;
use serde::Serialize;

/// Observables in the rows that hold several or have a form of their own.
const TOLD: [&str; 24] = [
    "mean_pressure",
    "reduced_pressure",
    "reduced_pressure_contact",
    "relative_area",
    "relative_area_corrected",
    "rms_gradient",
    "rms_gradient_contact",
    "kappa",
    "kappa_corrected",
    "kappa_r",
    "kappa_r_corrected",
    "mean_gap",
    "mean_gap_over_rms_height",
    "max_pressure",
    "patches",
    "nodes_per_patch",
    "certificate",
    "certificate_gap",
    "pressure_error_bound",
    "mean_gap_error_bound",
    "stiffness",
    "mean_pressure_error",
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
        // what is prescribed has no error of its own
        let within = |what, error| if error > 0.0 { format!("{what} {error:.1e}") } else { String::new() };
        let gap = within(", within", it.mean_gap_error_bound);
        let left = within(", of what is left of the gap", it.certificate_gap);
        let load = within(", mean pressure within", it.mean_pressure_error);
        let stiffness = (!it.stiffness.is_nan()).then(|| ("contact stiffness", format!("{:.6e}{load}", it.stiffness)));
        let rows = [
            (
                "reduced pressure p*",
                format!("{:.6e} (contact {:.6e})", it.reduced_pressure, it.reduced_pressure_contact),
            ),
            ("relative area", format!("{:.6} (corrected {:.6}){area}", it.relative_area, it.relative_area_corrected)),
            ("rms gradient", format!("{:.6e} (contact {:.6e})", it.rms_gradient, it.rms_gradient_contact)),
            ("kappa", format!("{:.4} (corrected {:.4})", it.kappa, it.kappa_corrected)),
            ("kappa_r", format!("{:.4} (corrected {:.4}){kappa_r}", it.kappa_r, it.kappa_r_corrected)),
            ("mean gap", format!("{:.6e} ({:.4} rms heights{gap})", it.mean_gap, it.mean_gap_over_rms_height)),
            ("pressure, mean and max", format!("{:.6e} {:.6e}", it.mean_pressure, it.max_pressure)),
            ("contact patches", format!("{} ({:.2} nodes each)", it.patches, it.nodes_per_patch)),
            ("certificate", format!("{:.2e} (pressure within {:.1e}{left})", it.certificate, it.pressure_error_bound)),
            ("work", format!("{} steps, {} transforms, {:.3} s", it.iterations, it.transforms, self.seconds)),
        ];
        let exact = self.exact.as_ref().map(|exact| ("exact values", exact.name.to_owned()));
        let rows = rows.into_iter().chain(stiffness).chain(exact).map(|(name, value)| (name.to_owned(), value));
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
