//! Certification of results of other codes.

use crate::arrays::{ArrayLike, field_on, view};
use crate::certificate::Certificate;
use crate::contact::Contact;
use crate::conversion::to_python;
use crate::detached::Detached;
use crate::error::{BoxedError, bail, py_error};
use crate::problem::Problem;
use asperity::contact::{ContactModulus, Solver, Stop};
use asperity::foreign::{Assessment, Claim, Frame, GivenField, Replay};
use asperity::setup::Solid;
use asperity::surface::Field;
use numpy::PyArrayDyn;
use pyo3::prelude::*;

/// The quantities that can be certified.
const QUANTITIES: [&str; 3] = ["pressure", "gap", "displacement"];

/// The certification of a result of another code: bounds of its error, and the mistakes that explain the error.
#[pyclass(frozen, module = "asperity")]
pub struct Certification {
    holds: bool,
    contact: Py<Contact>,
    certificate: Certificate,
    mistakes: Vec<String>,
    assessment: Option<Assessment>,
    /// The problem, and the quantity and values that were certified.
    problem: Py<Problem>,
    quantity: &'static str,
    values: Field,
    /// The tolerance, if it was given.
    tolerance: Option<f64>,
}

/// The values that make a certification again: it is found again from the problem, the name and values of the quantity, and the tolerance.
type CertificationParts<'py> = (Py<Problem>, String, Bound<'py, PyArrayDyn<f64>>, Option<f64>);

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
    fn new(
        of: Bound<'_, Problem>,
        quantity: &'static str,
        values: &Bound<'_, PyAny>,
        tolerance: Option<f64>,
    ) -> PyResult<Self> {
        let (py, problem) = (of.py(), of.get());
        let values = ArrayLike::new(values, quantity)?;
        let own = problem.setup.setup.stop;
        let stop = tolerance.map_or(Ok(own), |it| Stop::new(it, own.max_iterations())).map_err(py_error)?;
        let kind: GivenField = quantity.parse().expect("the three quantities have these names");
        let values = field_on(&values, problem.problem.surface().grid().shape(), quantity)?;
        let found = py.try_detached(|| Self::find(problem, &stop, kind, &values))?;
        let Finding { certificate, contact, assessment, holds, mistakes } = found;
        let (surface, setup, rank) = (problem.surface.clone(), problem.setup.setup.clone(), problem.rank);
        let contact = Py::new(py, Contact::new(contact, surface, setup, rank))?;
        let certificate = Certificate(certificate);
        Ok(Self {
            holds,
            contact,
            certificate,
            mistakes,
            assessment,
            problem: of.unbind(),
            quantity,
            values,
            tolerance,
        })
    }

    fn find(of: &Problem, stop: &Stop, kind: GivenField, values: &Field) -> Result<Finding, BoxedError> {
        let (problem, setup) = (&of.problem, &of.setup.setup);
        let frame = Frame { values: values.iter().copied().collect(), seconds: None };
        let replay = Replay::new("the result given", kind, [Ok(frame)].into_iter());
        let contact = replay.solve(problem, stop, &mut ())?;
        let is_plain = problem.solid().is_half_space() && problem.law().is_hard_wall();
        if !is_plain {
            let (certificate, holds) = (contact.certificate, stop.is_met(&contact.certificate));
            return Ok(Finding { certificate, contact, assessment: None, holds, mistakes: Vec::new() });
        }
        let modulus = ContactModulus(problem.contact_modulus());
        let claim = Claim::new(of.surface.clone(), modulus, Some(problem.load()), kind, values)?;
        let assessment = Assessment::new(&claim, &contact)?;
        let holds = assessment.holds(&contact, stop);
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

    fn __eq__(&self, other: &Self) -> bool {
        self.problem.get() == other.problem.get()
            && self.quantity == other.quantity
            && self.values == other.values
            && self.tolerance == other.tolerance
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    fn __reduce__<'py>(slf: Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, CertificationParts<'py>)> {
        let it = slf.get();
        let (problem, quantity) = (it.problem.clone_ref(slf.py()), it.quantity.to_owned());
        let values = view(&it.values, it.problem.get().rank, slf.clone().into_any());
        Ok((slf.get_type().getattr("_from_parts")?, (problem, quantity, values, it.tolerance)))
    }

    /// The certification that the values of a pickle describe.
    #[staticmethod]
    fn _from_parts(
        problem: Bound<'_, Problem>,
        quantity: &str,
        values: Bound<'_, PyAny>,
        tolerance: Option<f64>,
    ) -> PyResult<Self> {
        match QUANTITIES.iter().find(|name| **name == quantity) {
            Some(quantity) => Self::new(problem, quantity, &values, tolerance),
            None => bail(format!("there is no quantity {quantity:?}: give {}", QUANTITIES.join(", "))),
        }
    }

    fn __repr__(&self) -> String {
        let mistakes: String = self.mistakes.iter().map(|sentence| format!("; {sentence}")).collect();
        let holds = if self.holds { "within tolerance" } else { "not within tolerance" };
        format!("Certification({holds}, {}{mistakes})", self.certificate.__repr__())
    }
}

#[pymethods]
impl Problem {
    /// Certifies a result of another code: one of pressure (positive in compression), gap or displacement (lengths). It holds if it meets the
    /// `tolerance`, 1e-8 if none is given.
    #[pyo3(signature = (*, pressure=None, gap=None, displacement=None, tolerance=None))]
    fn certify(
        slf: Bound<'_, Self>,
        pressure: Option<Bound<'_, PyAny>>,
        gap: Option<Bound<'_, PyAny>>,
        displacement: Option<Bound<'_, PyAny>>,
        tolerance: Option<f64>,
    ) -> PyResult<Certification> {
        if slf.get().setup.setup.feels().eigenstrain {
            return bail(
                "a yield stress is given, but results are certified of bodies that have not yielded before: leave it out",
            );
        }
        if slf.get().setup.has_loads() {
            return bail("a result belongs to one load, but a list of loads is given: give one load");
        }
        match (pressure, gap, displacement) {
            (Some(field), None, None) => Certification::new(slf, "pressure", &field, tolerance),
            (None, Some(field), None) => Certification::new(slf, "gap", &field, tolerance),
            (None, None, Some(field)) => Certification::new(slf, "displacement", &field, tolerance),
            _ => bail("give one result to certify: a pressure, a gap or a displacement"),
        }
    }
}
