//! Certification of results of other codes.

use crate::arrays::{ArrayLike, field_on};
use crate::certificate::Certificate;
use crate::contact::Contact;
use crate::conversion::to_python;
use crate::error::{BoxedError, bail, py_error};
use crate::problem::Problem;
use asperity::contact::{ContactModulus, Solver};
use asperity::foreign::{Assessment, Claim, Frame, Quantity, Replay};
use asperity::setup::Solid;
use pyo3::prelude::*;

/// The certification of a result of another code: bounds of its error, and the mistakes that explain the error.
#[pyclass(frozen, module = "asperity")]
pub struct Certification {
    holds: bool,
    contact: Py<Contact>,
    certificate: Certificate,
    mistakes: Vec<String>,
    assessment: Option<Assessment>,
}

/// What is found out about a result.
struct Finding {
    certificate: asperity::contact::Certificate,
    contact: asperity::Contact,
    assessment: Option<Assessment>,
    holds: bool,
    mistakes: Vec<String>,
}

impl Certification {
    /// The certification of a field as the solution of a problem.
    fn new(py: Python<'_>, problem: &Problem, quantity: &'static str, values: &Bound<'_, PyAny>) -> PyResult<Self> {
        let values = ArrayLike::new(values, quantity)?;
        let kind: Quantity = quantity.parse().expect("the three quantities have these names");
        let values = field_on(&values, problem.problem.surface().grid().shape(), quantity)?;
        let found = py.detach(|| Self::find(problem, kind, &values)).map_err(py_error)?;
        let Finding { certificate, contact, assessment, holds, mistakes } = found;
        let Problem { surface, setup, rank, .. } = problem;
        let (surface, setup) = (surface.clone(), setup.setup.clone());
        let contact = Contact { contact, surface, setup, rank: *rank, diagnosis: None, slip: None };
        let certificate = Certificate(certificate);
        Ok(Self { holds, contact: Py::new(py, contact)?, certificate, mistakes, assessment })
    }

    fn find(of: &Problem, kind: Quantity, values: &asperity::surface::Field) -> Result<Finding, BoxedError> {
        let (problem, setup) = (&of.problem, &of.setup.setup);
        let frame = Frame { values: values.iter().copied().collect(), seconds: None };
        let replay = Replay::new("the result given", kind, [Ok(frame)].into_iter());
        let contact = replay.solve(problem, &setup.stop, &mut ())?;
        let is_plain = problem.solid().is_half_space() && problem.law().is_hard_wall();
        if !is_plain {
            let (certificate, holds) = (contact.certificate, setup.stop.is_met(&contact.certificate));
            return Ok(Finding { certificate, contact, assessment: None, holds, mistakes: Vec::new() });
        }
        let modulus = ContactModulus(problem.contact_modulus());
        let claim = Claim::new(of.surface.clone(), modulus, Some(problem.load()), kind, values)?;
        let assessment = Assessment::new(&claim, &contact)?;
        let holds = assessment.holds(&contact, &setup.stop);
        let poisson: Vec<f64> = setup.solid.as_ref().and_then(Solid::poisson).into_iter().collect();
        let mistakes = if holds { Vec::new() } else { claim.mistakes(&poisson) };
        let mistakes = mistakes.into_iter().map(|mistake| mistake.sentence.replace("with --", "as ")).collect();
        Ok(Finding { certificate: assessment.given, contact, assessment: Some(assessment), holds, mistakes })
    }
}

#[pymethods]
impl Certification {
    /// Whether the result is within the tolerance of the problem.
    #[getter]
    fn holds(&self) -> bool {
        self.holds
    }

    /// Error bounds of the result as it is. They are infinite if there is any tension.
    #[getter]
    fn certificate(&self) -> Certificate {
        self.certificate
    }

    /// The contact of the result, with tension set to zero and the load restored.
    #[getter]
    fn contact(&self, py: Python<'_>) -> Py<Contact> {
        self.contact.clone_ref(py)
    }

    /// Common mistakes that explain the error, each a sentence with what to do.
    #[getter]
    fn mistakes(&self) -> Vec<String> {
        self.mistakes.clone()
    }

    /// Errors and their places, as dictionaries. None for a layer or a hardness.
    #[getter]
    fn assessment<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.assessment.as_ref().map(|assessment| to_python(py, assessment)).transpose()
    }

    fn __bool__(&self) -> bool {
        self.holds
    }

    fn __repr__(&self) -> String {
        let mistakes: String = self.mistakes.iter().map(|sentence| format!("; {sentence}")).collect();
        let holds = if self.holds { "within tolerance" } else { "not within tolerance" };
        format!("Certification({holds}, {}{mistakes})", self.certificate.__repr__())
    }
}

#[pymethods]
impl Problem {
    /// Certifies a result of another code: one of pressure (positive in compression), gap or displacement (lengths).
    #[pyo3(signature = (*, pressure=None, gap=None, displacement=None))]
    fn certify(
        &self,
        py: Python<'_>,
        pressure: Option<Bound<'_, PyAny>>,
        gap: Option<Bound<'_, PyAny>>,
        displacement: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Certification> {
        if self.setup.loads.is_some() {
            return bail("a result belongs to one load, but a list of loads is given: give one load");
        }
        match (pressure, gap, displacement) {
            (Some(field), None, None) => Certification::new(py, self, "pressure", &field),
            (None, Some(field), None) => Certification::new(py, self, "gap", &field),
            (None, None, Some(field)) => Certification::new(py, self, "displacement", &field),
            _ => bail("give one result to certify: a pressure, a gap or a displacement"),
        }
    }
}
