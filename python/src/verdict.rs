//! Verdicts on the results of other codes.

use crate::certificate::Certificate;
use crate::contact::Contact;
use crate::field::{Given, rows_on};
use crate::problem::Problem;
use crate::refusal::{Fault, refused};
use crate::value::python;
use asperity::contact::{ContactModulus, Solver};
use asperity::foreign::{Assessment, Claim, Frame, Quantity, Replay};
use asperity::setup::Solid;
use pyo3::prelude::*;

/// The verdict on somebody's result: how far it is from the solution at the most, and what went wrong.
#[pyclass(frozen, module = "asperity")]
pub struct Verdict {
    holds: bool,
    contact: Py<Contact>,
    certificate: Certificate,
    findings: Vec<String>,
    assessment: Option<Assessment>,
}

impl Verdict {
    /// The verdict on a field that is said to solve a problem.
    pub fn of(py: Python<'_>, problem: &Problem, quantity: &'static str, field: &Given<'_>) -> PyResult<Self> {
        let kind = Quantity::named(quantity).expect("the three quantities have these names");
        let grid = *problem.problem.surface().grid();
        let field = rows_on(field, grid.shape(), quantity)?;
        let judged = || -> Result<_, Fault> {
            let Problem { problem, pressed, setup, .. } = problem;
            let frame = Frame { values: field.iter().copied().collect(), seconds: None };
            let replay = Replay::new("the result given", kind, [Ok(frame)].into_iter());
            let contact = replay.solve(problem, &setup.stop, &mut ())?;
            let is_plain = problem.solid().is_half_space() && problem.law().is_hard_wall();
            if !is_plain {
                let holds = setup.stop.is_met(&contact.certificate);
                return Ok((contact.certificate, contact, None, holds, Vec::new()));
            }
            let modulus = ContactModulus(problem.contact_modulus());
            let claim = Claim::new(pressed.clone(), modulus, Some(problem.load()), kind, &field)?;
            let assessment = Assessment::of(&claim, &contact)?;
            let holds = assessment.holds(&contact, &setup.stop);
            let poisson: Vec<f64> = setup.solid.as_ref().and_then(Solid::poisson).into_iter().collect();
            let mistakes = if holds { Vec::new() } else { claim.mistakes(&poisson) };
            let findings = mistakes.into_iter().map(|mistake| mistake.sentence.replace("by --", "as ")).collect();
            Ok((assessment.given, contact, Some(assessment), holds, findings))
        };
        let (certificate, contact, assessment, holds, findings) = py.detach(judged).map_err(refused)?;
        let Problem { pressed, setup, rank, .. } = problem;
        let contact = Contact { contact, pressed: pressed.clone(), setup: setup.clone(), rank: *rank, diagnosis: None };
        Ok(Self { holds, contact: Py::new(py, contact)?, certificate: certificate.into(), findings, assessment })
    }
}

#[pymethods]
impl Verdict {
    /// Whether the result is within the tolerance of the problem.
    #[getter]
    fn holds(&self) -> bool {
        self.holds
    }

    /// Error bounds of the result as it is: infinite with any tension.
    #[getter]
    fn certificate(&self) -> Certificate {
        self.certificate
    }

    /// The contact that the result makes, with tension clipped and the load restored.
    #[getter]
    fn contact(&self, py: Python<'_>) -> Py<Contact> {
        self.contact.clone_ref(py)
    }

    /// Everyday mistakes that explain why it does not hold, each a sentence with what to do.
    #[getter]
    fn findings(&self) -> Vec<String> {
        self.findings.clone()
    }

    /// What is wrong, and where, as dictionaries; None on a layer or below a hardness.
    #[getter]
    fn assessment<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.assessment.as_ref().map(|assessment| python(py, assessment)).transpose()
    }

    fn __bool__(&self) -> bool {
        self.holds
    }

    fn __repr__(&self) -> String {
        let findings: String = self.findings.iter().map(|sentence| format!("; {sentence}")).collect();
        let holds = if self.holds { "within tolerance" } else { "not within tolerance" };
        format!("Verdict({holds}, {}{findings})", self.certificate.told())
    }
}
