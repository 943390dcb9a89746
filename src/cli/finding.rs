//! The findings of a solve under one load: status, observables, and the exact solution where there is one.

use asperity::contact::{Contact, OBSERVABLES, Observables, Plasticity, Status};
use asperity::setup::Setup;
use asperity::theory::Exact;
use serde::Serialize;

/// Observables in the rows that hold several or have a form of their own.
const TOLD: [&str; 34] = [
    "mean_pressure",
    "reduced_pressure",
    "reduced_pressure_contact",
    "reduced_pressure_contact_counted",
    "relative_area",
    "relative_area_counted",
    "relative_area_corrected",
    "relative_area_error",
    "rms_gradient",
    "rms_gradient_contact",
    "rms_gradient_contact_counted",
    "rms_gradient_contact_corrected",
    "kappa",
    "kappa_counted",
    "kappa_corrected",
    "kappa_r",
    "kappa_r_counted",
    "kappa_r_corrected",
    "kappa_r_error",
    "mean_gap",
    "mean_gap_over_rms_height",
    "max_pressure",
    "patches",
    "nodes_per_patch",
    "unresolved_share",
    "edges_of_shape",
    "certificate",
    "certificate_gap",
    "pressure_error_bound",
    "mean_gap_error_bound",
    "stiffness",
    "mean_pressure_error",
    "iterations",
    "transforms",
];

/// A share of edges given by the shape above this one is told.
const MANY_OF_SHAPE: f64 = 0.05;

/// The numbers of a contact under its load.
#[derive(Serialize)]
pub struct Finding {
    pub status: Status,
    #[serde(flatten)]
    pub observables: Observables,
    pub seconds: f64,
    /// The approach, where the solid has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub approach: Option<f64>,
    /// What yields, where there is a hardness.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plasticity: Option<Plasticity>,
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
            approach: contact.approach(),
            plasticity: setup.law.hardness().map(|_| contact.plasticity()),
            exact: setup.exact(contact.problem.surface().grid(), contact.mean_pressure()),
        }
    }

    /// Names and values for reading.
    pub fn rows(&self) -> Vec<(String, String)> {
        let rows = self.contact().into_iter().chain(self.solution());
        let stiffness = Some(&self.observables).filter(|it| !it.stiffness.is_nan()).map(|it| {
            let load = within(", mean pressure within", it.mean_pressure_error);
            ("contact stiffness", format!("{:.6e}{load}", it.stiffness))
        });
        let exact = self.exact.as_ref().map(|exact| ("exact values", exact.name.to_owned()));
        let approach = self.approach.map(|approach| ("approach", format!("{approach:.6e}")));
        let plasticity = self.plasticity.iter().flat_map(|it| {
            [
                ("plastic area", format!("{:.6} ({} of the load)", it.area, percent(it.load_share))),
                ("plastic overlap", format!("{:.6e}, mean over the cell", it.overlap)),
            ]
        });
        let rows = rows
            .chain(approach)
            .chain(plasticity)
            .chain(stiffness)
            .chain(exact)
            .map(|(name, value)| (name.to_owned(), value));
        rows.chain(self.others()).collect()
    }

    /// Area, gradient and what follows from them, with resolved edges first, and how good the grid is for them.
    fn contact(&self) -> [(&'static str, String); 7] {
        let it = &self.observables;
        let exact = |value: Option<f64>| value.map_or(String::new(), |v| format!("   exact {v:.6}"));
        let area = exact(self.exact.as_ref().map(|exact| exact.relative_area));
        let kappa_r = exact(self.exact.as_ref().and_then(|exact| exact.kappa_r));
        let of_shape = match it.edges_of_shape > MANY_OF_SHAPE {
            true => format!(", {} of its edges given by the shape", percent(it.edges_of_shape)),
            false => String::new(),
        };
        [
            (
                "reduced pressure p*",
                format!("{:.6e}, in contact {:.6e}", it.reduced_pressure, it.reduced_pressure_contact),
            ),
            (
                "relative area",
                resolved(it.resolved_area(), it.relative_area_counted, it.relative_area_corrected) + &area,
            ),
            ("rms gradient", format!("{:.6e}, in contact {:.6e}", it.rms_gradient, it.rms_gradient_contact)),
            ("kappa", resolved(it.resolved_kappa(), it.kappa_counted, it.kappa_corrected)),
            ("kappa_r", resolved(it.resolved_kappa_r(), it.kappa_r_counted, it.kappa_r_corrected) + &kappa_r),
            (
                "grid error, estimated",
                format!("area {}, kappa_r {}", percent(it.relative_area_error), percent(it.kappa_r_error)),
            ),
            (
                "contact patches",
                format!(
                    "{} ({:.2} nodes each, {} of the contact in those too small to trust){of_shape}",
                    it.patches,
                    it.nodes_per_patch,
                    percent(it.unresolved_share)
                ),
            ),
        ]
    }

    /// Gap and pressure with their bounds, and the work.
    fn solution(&self) -> [(&'static str, String); 4] {
        let it = &self.observables;
        let gap = within(", within", it.mean_gap_error_bound);
        let left = within(", of what is left of the gap", it.certificate_gap);
        [
            ("mean gap", format!("{:.6e} ({:.4} rms heights{gap})", it.mean_gap, it.mean_gap_over_rms_height)),
            ("pressure, mean and max", format!("{:.6e} {:.6e}", it.mean_pressure, it.max_pressure)),
            ("certificate", format!("{:.2e} (pressure within {:.1e}{left})", it.certificate, it.pressure_error_bound)),
            ("work", format!("{} steps, {} transforms, {:.3} s", it.iterations, it.transforms, self.seconds)),
        ]
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

/// A quantity with resolved edges, and beside it that of counted nodes.
fn resolved(resolved: Option<f64>, counted: f64, corrected: f64) -> String {
    match resolved {
        None => format!("not resolved (counted {counted:.6})"),
        Some(resolved) => format!("{resolved:.6} (counted {counted:.6}, corrected {corrected:.6})"),
    }
}

/// Words and an error; none of what is prescribed.
fn within(words: &str, error: f64) -> String {
    if error > 0.0 { format!("{words} {error:.1e}") } else { String::new() }
}

fn percent(share: f64) -> String {
    if share.is_nan() { "unknown".into() } else { format!("{:.2} %", 100.0 * share) }
}
