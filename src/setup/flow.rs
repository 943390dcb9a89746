//! What is found about the flow through a contact.

use super::one_or_more;
use crate::contact::{Contact, Quantity};
use crate::error::FlowError;
use crate::flow::{Conductance, FlowAxis, Leakage, Percolation};
use crate::sentence::sentence;
use crate::warning::Warning;
use serde::{Deserialize, Serialize};
use std::sync::atomic::AtomicBool;

/// What is found about the flow through a contact, after it is solved: section `flow` of a scene.
///
/// ```
/// use asperity::setup::Setup;
/// let setup = Setup::from_toml(
///     r#"
///     surface = { indenter = { shape = "sphere", radius = 1.0 } }
///     grid = { points = [64, 64], size = 1.0 }
///     load = { reduced-pressure = 0.1 }
///     flow = { leakage = true, resistivity = [1.7e-8, 2.8e-8] }
///     "#,
/// )?;
/// assert_eq!(setup.flow.resistivities()?, Some([1.7e-8, 2.8e-8]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct Flow {
    /// Whether the leakage through the gap is found, along `x` and `y`.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub leakage: bool,
    /// Resistivities of the bodies, or one that both have, for the conductance of the contact. For heat, metre kelvin per watt.
    #[serde(
        skip_serializing_if = "Vec::is_empty",
        serialize_with = "one_or_more::serialize",
        deserialize_with = "one_or_more::resistivities"
    )]
    pub resistivity: Vec<f64>,
    /// Conductivities of the bodies, or one that both have, in place of the resistivities.
    #[serde(
        skip_serializing_if = "Vec::is_empty",
        serialize_with = "one_or_more::serialize",
        deserialize_with = "one_or_more::conductivities"
    )]
    pub conductivity: Vec<f64>,
}

impl Flow {
    /// Whether nothing is asked for.
    pub fn is_none(&self) -> bool {
        !self.leakage && !self.has_conductance()
    }

    /// Whether the conductance is found.
    pub fn has_conductance(&self) -> bool {
        !(self.resistivity.is_empty() && self.conductivity.is_empty())
    }

    /// The resistivities of both bodies, if the conductance is asked for.
    ///
    /// # Errors
    /// [`FlowError::Twice`] for resistivities and conductivities, [`FlowError::Bodies`] for more than two of them,
    /// [`FlowError::Resistivity`] and [`FlowError::Conductivity`] for values that do not make sense.
    pub fn resistivities(&self) -> Result<Option<[f64; 2]>, FlowError> {
        if !self.resistivity.is_empty() && !self.conductivity.is_empty() {
            return Err(FlowError::Twice);
        }
        let of_both = |values: &[f64]| match *values {
            [] => Ok(None),
            [both] => Ok(Some([both, both])),
            [first, second] => Ok(Some([first, second])),
            _ => Err(FlowError::Bodies { values: values.len() }),
        };
        if let Some([first, second]) = of_both(&self.conductivity)? {
            let is_conductivity = |value: f64| value.is_finite() && value > 0.0;
            return match is_conductivity(first) && is_conductivity(second) {
                true => Ok(Some([1.0 / first, 1.0 / second])),
                false => Err(FlowError::Conductivity { first, second }),
            };
        }
        let Some([first, second]) = of_both(&self.resistivity)? else { return Ok(None) };
        let is_resistivity = |value: f64| value.is_finite() && value >= 0.0;
        match is_resistivity(first) && is_resistivity(second) && first + second > 0.0 {
            true => Ok(Some([first, second])),
            false => Err(FlowError::Resistivity { first, second }),
        }
    }

    /// What is asked for of a contact: numbers, and the leakages with their fields. On a line, none of it is along `y`.
    ///
    /// # Errors
    /// The errors of [`Flow::resistivities`], [`Leakage::along`] and [`Conductance::new`].
    pub fn measure(&self, contact: &Contact) -> Result<FlowFound, FlowError> {
        self.measure_until(contact, &AtomicBool::new(false))
    }

    /// The same, until `ended` becomes true: what is found then is of no use.
    pub(crate) fn measure_until(&self, contact: &Contact, ended: &AtomicBool) -> Result<FlowFound, FlowError> {
        let mut found = FlowFound::default();
        if self.leakage {
            let is_line = contact.problem.surface().grid().is_line();
            let percolation = Percolation::from_contact(contact);
            let axes = &FlowAxis::ALL[..if is_line { 1 } else { 2 }];
            found.leakages = Leakage::along_until(contact, axes, Leakage::TOLERANCE, ended)?;
            for leakage in &found.leakages {
                found.numbers.extend(AxisFlow::new(&percolation, leakage).numbers());
            }
        }
        if let Some([first, second]) = self.resistivities()? {
            let Conductance { per_area, .. } = Conductance::new(contact, [first, second])?;
            found.numbers.push((Quantity::ConductancePerArea, per_area));
            found.numbers.push((Quantity::ConductanceTimesResistivity, per_area * (first + second)));
        }
        Ok(found)
    }
}

/// What flows through a contact, as far as it was asked for.
#[derive(Debug, Clone, Default)]
pub struct FlowFound {
    /// Percolation, leakage and conductance.
    pub numbers: Vec<(Quantity, f64)>,
    /// The leakages with their fields, along `x`, and of a surface along `y`.
    pub leakages: Vec<Leakage>,
}

impl FlowFound {
    /// A number, if it was asked for.
    pub fn get(&self, quantity: Quantity) -> Option<f64> {
        self.numbers.iter().find(|(other, _)| *other == quantity).map(|(_, value)| *value)
    }
}

/// The leakage through the gap along one axis, by Reynolds' equation, and what connects both sides.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct AxisFlow {
    /// The axis.
    pub axis: FlowAxis,
    /// Whether the open area connects both sides.
    pub open_percolates: bool,
    /// Whether the contact connects both sides.
    pub contact_percolates: bool,
    /// Bounds of the cube of the gap of parallel plates that leak as much, a length cubed.
    pub leakage: [f64; 2],
    /// The gap of these plates, a length; NaN where the bounds are further apart than the solver aims for.
    pub hydraulic_gap: f64,
}

/// The warning that the leakage of some contacts is not known, from their numbers.
pub fn warning_of_leakage<'a>(contacts: impl IntoIterator<Item = &'a [(Quantity, f64)]>) -> Option<Warning> {
    let unknown = |numbers: &[(Quantity, f64)]| {
        let get = |quantity: Quantity| numbers.iter().find(|(other, _)| *other == quantity).map(|(_, value)| *value);
        FlowAxis::ALL.into_iter().filter_map(|axis| AxisFlow::find(axis, get)).find(AxisFlow::is_unknown)
    };
    let unknown: Vec<AxisFlow> = contacts.into_iter().filter_map(unknown).collect();
    let AxisFlow { axis, leakage: [lower, upper], .. } = unknown.first()?;
    Some(Warning::new(
        sentence!(
            "The leakage along {axis} is not known: the cube of the gap of plates that leak as much lies between {lower:.1e} and {upper:.1e}",
            axis = axis.name(),
            lower,
            upper
        ),
        "Read the bounds, or use another load or grid: near the load that seals, the search for the flow may not come to an end",
    ))
}

impl AxisFlow {
    /// Whether the bounds of the leakage are further apart than the solver aims for.
    pub fn is_unknown(&self) -> bool {
        let [lower, upper] = self.leakage;
        upper - lower > Leakage::TOLERANCE * upper
    }

    fn new(percolation: &Percolation, leakage: &Leakage) -> Self {
        Self {
            axis: leakage.axis,
            open_percolates: percolation.open_percolates(leakage.axis),
            contact_percolates: percolation.contact_percolates(leakage.axis),
            leakage: [leakage.lower, leakage.upper],
            hydraulic_gap: if leakage.width() <= leakage.tolerance { leakage.sigma().cbrt() } else { f64::NAN },
        }
    }

    /// The flow along an axis of a state with these numbers; none where one of them is absent.
    pub fn find(axis: FlowAxis, number: impl Fn(Quantity) -> Option<f64>) -> Option<Self> {
        let [open, joined, lower, upper, hydraulic_gap] = Self::quantities(axis).map(number);
        Some(Self {
            axis,
            open_percolates: open? == 1.0,
            contact_percolates: joined? == 1.0,
            leakage: [lower?, upper?],
            hydraulic_gap: hydraulic_gap?,
        })
    }

    /// Its numbers by their quantities.
    fn numbers(&self) -> impl Iterator<Item = (Quantity, f64)> {
        let flag = |is_true: bool| f64::from(u8::from(is_true));
        let [lower, upper] = self.leakage;
        let values = [flag(self.open_percolates), flag(self.contact_percolates), lower, upper, self.hydraulic_gap];
        Self::quantities(self.axis).into_iter().zip(values)
    }

    /// The quantities of an axis, in the order of the fields.
    fn quantities(axis: FlowAxis) -> [Quantity; 5] {
        match axis {
            FlowAxis::X => [
                Quantity::OpenPercolatesX,
                Quantity::ContactPercolatesX,
                Quantity::LeakageLowerX,
                Quantity::LeakageUpperX,
                Quantity::HydraulicGapX,
            ],
            FlowAxis::Y => [
                Quantity::OpenPercolatesY,
                Quantity::ContactPercolatesY,
                Quantity::LeakageLowerY,
                Quantity::LeakageUpperY,
                Quantity::HydraulicGapY,
            ],
        }
    }
}
