//! The summary of a solve, for people and for scripts.

use anyhow::Result;
use asperity::contact::{Contact, OBSERVABLES, Observables, Status};
use asperity::setup::Setup;
use asperity::theory::Exact;
use serde::Serialize;
use std::io::{self, Write};

/// Observables in the rows of the summary that hold several or have a form of their own.
const TOLD: [&str; 19] = [
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
    "certificate",
    "pressure_error_bound",
    "iterations",
    "transforms",
];

/// Everything that a script may want to know about a contact, and the setup that repeats it.
#[derive(Serialize)]
pub struct Summary {
    solver: String,
    status: Status,
    points: Vec<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    seed: Option<u64>,
    contact_modulus: f64,
    prescribed: &'static str,
    #[serde(flatten)]
    observables: Observables,
    seconds: f64,
    /// The exact solution under the same mean pressure.
    #[serde(skip_serializing_if = "Option::is_none")]
    exact: Option<Exact>,
    setup: Setup,
    #[serde(skip)]
    title: String,
}

impl Summary {
    /// The summary of the contact of `setup`, whose arrays have `rank` axes outside.
    pub fn of(setup: &Setup, contact: &Contact, rank: usize) -> Self {
        let surface = contact.problem.surface();
        let grid = surface.grid();
        Self {
            solver: contact.solver.clone(),
            status: contact.status,
            points: grid.shape()[2 - rank..].to_vec(),
            seed: surface.seed(),
            contact_modulus: contact.problem.contact_modulus(),
            prescribed: contact.problem.load().name(),
            observables: Observables::of(contact),
            seconds: contact.work.seconds,
            exact: setup.exact(grid, contact.mean_pressure()),
            setup: setup.clone().with_full_path(),
            title: setup.surface.title(grid),
        }
    }

    /// Writes the object as one line of JSON.
    pub fn write_json(&self, out: &mut impl Write) -> Result<()> {
        Ok(writeln!(out, "{}", serde_json::to_string(self)?)?)
    }

    /// Writes the summary for reading.
    pub fn write_text(&self, out: &mut impl Write) -> io::Result<()> {
        let points: Vec<String> = self.points.iter().map(usize::to_string).collect();
        writeln!(out, "{}, {} points, by {}: {}", self.title, points.join(" x "), self.solver, self.status)?;
        let it = &self.observables;
        let exact = |value: Option<f64>| value.map_or(String::new(), |v| format!("   exact {v:.6}"));
        let area = exact(self.exact.as_ref().map(|exact| exact.relative_area));
        let kappa_r = exact(self.exact.as_ref().and_then(|exact| exact.kappa_r));
        let rows = [
            ("prescribed", self.prescribed.to_owned()),
            (
                "reduced pressure p*",
                format!("{:.6e} (contact {:.6e})", it.reduced_pressure, it.reduced_pressure_contact),
            ),
            ("relative area", format!("{:.6} (corrected {:.6}){area}", it.relative_area, it.relative_area_corrected)),
            ("rms gradient", format!("{:.6e} (contact {:.6e})", it.rms_gradient, it.rms_gradient_contact)),
            ("kappa", format!("{:.4} (corrected {:.4})", it.kappa, it.kappa_corrected)),
            ("kappa_r", format!("{:.4} (corrected {:.4}){kappa_r}", it.kappa_r, it.kappa_r_corrected)),
            ("mean gap", format!("{:.6e} ({:.4} rms heights)", it.mean_gap, it.mean_gap_over_rms_height)),
            ("pressure, mean and max", format!("{:.6e} {:.6e}", it.mean_pressure, it.max_pressure)),
            ("contact patches", it.patches.to_string()),
            ("certificate", format!("{:.2e} (pressure within {:.1e})", it.certificate, it.pressure_error_bound)),
            ("work", format!("{} steps, {} transforms, {:.3} s", it.iterations, it.transforms, self.seconds)),
        ];
        let exact = self.exact.as_ref().map(|exact| ("exact values", exact.name.to_owned()));
        let rows = rows.into_iter().chain(exact).map(|(name, value)| (name.to_owned(), value)).chain(self.others());
        rows.into_iter().try_for_each(|(name, value)| writeln!(out, "  {name:<25} {value}"))
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
