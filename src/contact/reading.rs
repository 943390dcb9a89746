//! Reading of a contact, of a state or of a step: its quantities, each computed when it is asked for.

use super::readings::positive;
use super::state_values::NO_VALUES;
use crate::contact::{
    Certificate, Contact, Counted, Load, Observables, Patches, Problem, Quantity, QuantityRow, Readings, Resolution,
    Resolved, StateValues, Step, Validity, Work, hysteretic_friction,
};
use ndarray::ArrayView1;
use std::cell::LazyCell;

/// A contact, a state of a process, or a step of a solver, of which quantities are read. Values that need a pass over the nodes are computed on
/// first use, and once.
pub struct Reading<'a> {
    problem: &'a Problem,
    work: Work,
    values: &'a StateValues,
    /// The certificate; NaN where it is not known.
    certificate: Certificate,
    /// The contact stiffness; NaN if it was not requested.
    stiffness: f64,
    counted: Lazy<'a, Counted>,
    resolved: Lazy<'a, Resolved>,
    patches: Lazy<'a, Patches>,
    /// Area and gradient of the contact on the next coarser grid, if they are known.
    coarser: Option<&'a Resolved>,
    mean_gap: Lazy<'a, f64>,
    /// The elastic energy; NaN where it is not known.
    elastic_energy: Lazy<'a, f64>,
    /// The approach; NaN if it is not known, or not defined.
    approach: Lazy<'a, f64>,
    plastic_area: Lazy<'a, f64>,
    plastic_load_share: Lazy<'a, f64>,
    plastic_overlap: Lazy<'a, f64>,
    mean_pressure: Lazy<'a, f64>,
    max_pressure: Lazy<'a, f64>,
    /// The hysteretic friction; NaN at rest.
    friction: Lazy<'a, f64>,
}

type Lazy<'a, T> = LazyCell<T, Box<dyn FnOnce() -> T + 'a>>;

fn lazy<'a, T>(make: impl FnOnce() -> T + 'a) -> Lazy<'a, T> {
    LazyCell::new(Box::new(make))
}

impl Reading<'_> {
    /// The reading with other work, such as that of all states of a history so far.
    pub fn with_work(self, work: Work) -> Self {
        Self { work, ..self }
    }

    /// A number of the state, if it has it: that of its process, or the one that is computed of the contact where that has a meaning.
    pub fn get(&self, quantity: Quantity) -> Option<f64> {
        let QuantityRow { read, validity, .. } = quantity.row();
        let own = self.values.get(quantity);
        let value = own.or_else(|| read.filter(|_| validity.holds(self.values.feels)).map(|read| read(self)));
        value.filter(|value| !value.is_nan())
    }

    /// The same; NaN where the state does not have it.
    pub fn value(&self, quantity: Quantity) -> f64 {
        self.get(quantity).unwrap_or(f64::NAN)
    }
}

impl Readings for Reading<'_> {
    fn resolution(&self) -> Resolution {
        let grid = self.problem.surface().grid();
        Resolution::new(grid, &self.counted, &self.resolved, &self.patches, self.coarser)
    }

    /// The modulus by which pressures are reduced, from those that are.
    fn effective_modulus(&self) -> f64 {
        *self.mean_pressure / (self.counted.reduced_pressure * self.problem.rms_gradient())
    }

    /// The reduced pressure: that of the state, or the prescribed one, to the last bit, or else the computed one, as that of a contact that
    /// moves, whose modulus depends on the motion.
    fn reduced_pressure(&self) -> f64 {
        let of_mean = |pressure: f64| pressure / (self.problem.rms_gradient() * self.problem.contact_modulus());
        if let Some(pressure) = self.values.get(Quantity::MeanPressure) {
            return of_mean(pressure);
        }
        match (self.values.feels.is_pressure_alone(), self.problem.load()) {
            (true, Load::ReducedPressure(prescribed)) if !self.problem.is_moving() => prescribed,
            (true, _) => self.counted.reduced_pressure,
            // where nothing touches, the problem of a state has the load of an earlier one
            (false, _) => of_mean(*self.mean_pressure),
        }
    }

    /// `kappa_r` of the contact. Of a solid that creeps, the effective modulus is not known here.
    fn kappa_r(&self) -> f64 {
        if self.values.feels.memory { f64::NAN } else { positive(self.resolved.kappa_r) }
    }

    /// The stiffness times the error of the gap, divided by the mean pressure.
    fn mean_pressure_error(&self) -> f64 {
        if self.problem.datum().is_none() {
            return 0.0;
        }
        self.stiffness * self.certificate.eta * self.problem.rms_height() / *self.mean_pressure
    }

    fn mean_pressure(&self) -> f64 {
        *self.mean_pressure
    }

    fn max_pressure(&self) -> f64 {
        *self.max_pressure
    }

    fn mean_gap(&self) -> f64 {
        *self.mean_gap
    }

    fn approach(&self) -> f64 {
        *self.approach
    }

    fn elastic_energy(&self) -> f64 {
        *self.elastic_energy
    }

    fn plastic_area(&self) -> f64 {
        *self.plastic_area
    }

    fn plastic_load_share(&self) -> f64 {
        *self.plastic_load_share
    }

    fn plastic_overlap(&self) -> f64 {
        *self.plastic_overlap
    }

    fn friction(&self) -> f64 {
        *self.friction
    }

    fn stiffness(&self) -> f64 {
        self.stiffness
    }

    fn contact_modulus(&self) -> f64 {
        self.problem.contact_modulus()
    }

    fn rms_height(&self) -> f64 {
        self.problem.rms_height()
    }

    fn rms_gradient(&self) -> f64 {
        self.problem.rms_gradient()
    }

    fn patches(&self) -> usize {
        self.patches.count()
    }

    fn iterations(&self) -> usize {
        self.work.iterations
    }

    fn transforms(&self) -> u64 {
        self.work.transforms
    }

    fn counted(&self) -> &Counted {
        &self.counted
    }

    fn resolved(&self) -> &Resolved {
        &self.resolved
    }

    fn certificate(&self) -> &Certificate {
        &self.certificate
    }
}

impl<'a> From<&'a Contact> for Reading<'a> {
    fn from(contact: &'a Contact) -> Self {
        Self {
            problem: &contact.problem,
            work: contact.work,
            values: contact.values(),
            certificate: contact.certificate,
            stiffness: contact.known_stiffness().unwrap_or(f64::NAN),
            counted: lazy(|| contact.counted()),
            resolved: lazy(|| contact.resolved()),
            patches: lazy(|| contact.patches()),
            coarser: contact.coarser.as_ref(),
            mean_gap: lazy(|| contact.mean_gap()),
            elastic_energy: lazy(|| contact.elastic_energy()),
            approach: lazy(|| contact.approach().unwrap_or(f64::NAN)),
            plastic_area: lazy(|| contact.plasticity().area),
            plastic_load_share: lazy(|| contact.plasticity().load_share),
            plastic_overlap: lazy(|| contact.plasticity().overlap),
            mean_pressure: lazy(|| contact.mean_pressure()),
            max_pressure: lazy(|| contact.max_pressure()),
            friction: lazy(|| contact.friction()),
        }
    }
}

impl<'a> From<&'a Step<'_>> for Reading<'a> {
    fn from(step: &'a Step<'_>) -> Self {
        let pressure = || ArrayView1::from(step.pressure());
        Self {
            problem: step.problem(),
            work: step.work(),
            values: &NO_VALUES,
            stiffness: f64::NAN,
            certificate: step.certificate().copied().unwrap_or(Certificate::UNKNOWN),
            counted: lazy(|| *step.counted()),
            resolved: lazy(|| *step.resolved()),
            patches: lazy(|| step.patches().clone()),
            coarser: None,
            mean_gap: lazy(|| step.mean_gap()),
            elastic_energy: lazy(|| f64::NAN),
            approach: lazy(|| f64::NAN),
            plastic_area: lazy(move || {
                let yielding = pressure().iter().filter(|p| step.problem().law().yields(**p)).count();
                yielding as f64 / pressure().len() as f64
            }),
            plastic_load_share: lazy(move || {
                let yielding = pressure().iter().filter(|p| step.problem().law().yields(**p)).sum::<f64>();
                if yielding > 0.0 { yielding / pressure().sum() } else { 0.0 }
            }),
            plastic_overlap: lazy(|| step.mean_gap() - step.separation()),
            mean_pressure: lazy(move || pressure().mean().unwrap_or(0.0)),
            max_pressure: lazy(move || pressure().fold(0.0, |max: f64, &p| max.max(p))),
            friction: lazy(|| hysteretic_friction(step.problem(), step.pressure(), step.displacement())[1]),
        }
    }
}

impl Quantity {
    /// The quantity that estimates the error of this one by the grid, over its value, if there is one. Of the errors of a row it is the one that can be
    /// computed of any contact: all others belong to the way to a state.
    pub fn relative_error(self) -> Option<Self> {
        self.row().errors.iter().filter_map(|name| Self::find(name)).find(|error| !error.row().is_known_by_process)
    }

    /// Whether it says something of a contact that others do not: no overlap where nothing yields, and no modulus of a motion at rest. A number that only
    /// a process knows is there if the contact is a state of it.
    pub fn tells_of(self, contact: &Contact) -> bool {
        let problem = &contact.problem;
        let QuantityRow { validity, read, .. } = self.row();
        let is_there = match validity {
            _ if read.is_none() => false,
            Validity::Yielding => !problem.law().is_hard_wall() || problem.flattened_by() > 0.0,
            Validity::Sliding => problem.is_moving(),
            Validity::Always | Validity::NoAdhesion | Validity::Elastic => true,
        };
        contact.values().get(self).is_some() || (is_there && validity.holds(contact.values().feels))
    }
}

impl Observables {
    /// Reads all of them of a contact, or of a step.
    pub fn new<'a>(state: impl Into<Reading<'a>>) -> Self {
        let reading = state.into();
        Self::by(|quantity| reading.value(quantity))
    }
}
