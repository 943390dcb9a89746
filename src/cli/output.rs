//! What a solve prints and writes.

use anyhow::Result;
use asperity::contact::{Contact, Problem, Status, archive};
use asperity::error::FileError;
use asperity::files::write_beside;
use asperity::theory::Exact;
use serde::Serialize;
use std::io::{self, Write};
use std::path::Path;

/// One object with everything that a script may want to know about a contact.
#[derive(Serialize)]
pub struct Summary {
    solver: &'static str,
    status: Status,
    points: Vec<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    seed: Option<u64>,
    contact_modulus: f64,
    prescribed: &'static str,
    mean_pressure: f64,
    reduced_pressure: f64,
    relative_area: f64,
    relative_area_corrected: f64,
    rms_height: f64,
    rms_gradient: f64,
    rms_gradient_contact: f64,
    kappa: f64,
    kappa_r: f64,
    kappa_r_corrected: f64,
    mean_gap: f64,
    max_pressure: f64,
    patches: usize,
    certificate: f64,
    pressure_error_bound: f64,
    penetration: f64,
    load_error: f64,
    iterations: usize,
    transforms: u64,
    seconds: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    exact: Option<ExactSummary>,
}

/// The exact solution beside it, under the same mean pressure.
#[derive(Serialize)]
struct ExactSummary {
    name: &'static str,
    relative_area: f64,
    kappa_r: Option<f64>,
    mean_gap: Option<f64>,
    max_pressure: Option<f64>,
}

impl ExactSummary {
    fn of(exact: &Exact) -> Self {
        let Exact { name, relative_area, kappa_r, mean_gap, max_pressure, .. } = *exact;
        Self { name, relative_area, kappa_r, mean_gap, max_pressure }
    }
}

impl Summary {
    /// Measures `contact`, whose arrays have `rank` axes outside.
    pub fn of(problem: &Problem, contact: &Contact, rank: usize, exact: Option<&Exact>) -> Self {
        let measures = contact.measures(problem);
        let [ny, nx] = problem.surface().grid().shape();
        Self {
            solver: contact.solver,
            status: contact.status,
            points: if rank == 1 { vec![nx] } else { vec![ny, nx] },
            seed: contact.seed,
            contact_modulus: problem.contact_modulus(),
            prescribed: problem.load().name(),
            mean_pressure: contact.pressure.mean().unwrap_or(0.0),
            reduced_pressure: measures.reduced_pressure,
            relative_area: measures.relative_area,
            relative_area_corrected: measures.relative_area_corrected,
            rms_height: problem.rms_height(),
            rms_gradient: measures.rms_gradient,
            rms_gradient_contact: measures.rms_gradient_contact,
            kappa: measures.kappa,
            kappa_r: measures.kappa_r,
            kappa_r_corrected: measures.kappa_r_corrected,
            mean_gap: contact.mean_gap(),
            max_pressure: contact.max_pressure(),
            patches: contact.patches().count(),
            certificate: contact.certificate.eta,
            pressure_error_bound: contact.certificate.pressure_error_bound,
            penetration: contact.certificate.penetration(),
            load_error: contact.certificate.load_error,
            iterations: contact.work.iterations,
            transforms: contact.work.transforms,
            seconds: contact.work.seconds,
            exact: exact.map(ExactSummary::of),
        }
    }

    /// Writes the object as one line of JSON.
    pub fn write_json(&self, out: &mut impl Write) -> Result<()> {
        Ok(writeln!(out, "{}", serde_json::to_string(self)?)?)
    }

    /// Writes it for reading, under the title of the surface.
    pub fn write_text(&self, title: &str, out: &mut impl Write) -> io::Result<()> {
        let points: Vec<String> = self.points.iter().map(usize::to_string).collect();
        writeln!(out, "{title}, {} points, by {}: {}", points.join(" x "), self.solver, self.status)?;
        let exact = |value: Option<f64>| value.map_or(String::new(), |v| format!("   exact {v:.6}"));
        let area = exact(self.exact.as_ref().map(|e| e.relative_area));
        let kappa_r = exact(self.exact.as_ref().and_then(|e| e.kappa_r));
        writeln!(out, "  prescribed              {}", self.prescribed)?;
        writeln!(out, "  reduced pressure p*     {:.6e}", self.reduced_pressure)?;
        writeln!(
            out,
            "  relative area           {:.6} (corrected {:.6}){area}",
            self.relative_area, self.relative_area_corrected
        )?;
        writeln!(
            out,
            "  rms gradient            {:.6e} (contact {:.6e})",
            self.rms_gradient, self.rms_gradient_contact
        )?;
        writeln!(out, "  kappa                   {:.4}", self.kappa)?;
        writeln!(
            out,
            "  kappa_r                 {:.4} (corrected {:.4}){kappa_r}",
            self.kappa_r, self.kappa_r_corrected
        )?;
        writeln!(
            out,
            "  mean gap                {:.6e} ({:.4} rms heights)",
            self.mean_gap,
            self.mean_gap / self.rms_height
        )?;
        writeln!(out, "  pressure, mean and max  {:.6e} {:.6e}", self.mean_pressure, self.max_pressure)?;
        writeln!(out, "  contact patches         {}", self.patches)?;
        writeln!(
            out,
            "  certificate             {:.2e} (pressure within {:.1e})",
            self.certificate, self.pressure_error_bound
        )?;
        writeln!(
            out,
            "  work                    {} steps, {} transforms, {:.3} s",
            self.iterations, self.transforms, self.seconds
        )?;
        match &self.exact {
            Some(exact) => writeln!(out, "  exact values            {}", exact.name),
            None => Ok(()),
        }
    }
}

/// Writes the [`archive`] of a contact.
pub fn write_fields(path: &Path, problem: &Problem, contact: &Contact, rank: usize) -> Result<(), FileError> {
    write_beside(path, |file| file.write_all(&archive(problem, contact, rank).map_err(io::Error::other)?))
}
