//! Scenes: the problems of a recording.

use crate::contact::{FieldKind, Forecast, Load, Problem, State};
use crate::diagnosis::Reference;
use crate::setup::Setup;
use crate::theory::Exact;
use std::sync::Arc;

/// One contact problem of a recording.
#[derive(Clone)]
pub struct Scene<'a> {
    /// Root of the scene's entities, such as `hertz_line`; characters other than letters, digits, `_` and `-` become `_`.
    pub name: String,
    /// Title of tab and pictures.
    pub title: String,
    /// The problem whose steps will be recorded.
    pub problem: &'a Problem,
    /// The setup that repeats it, if there is one: the recording carries it.
    pub setup: Option<Setup>,
    /// The exact solution, where there is one; its pressure is drawn beside the computed one. A line is then shown around
    /// its contact only.
    pub exact: Option<Exact>,
    /// The state for errors by wavelength, such as the end of an earlier, identical run; without it there are no such
    /// errors.
    pub reference: Option<Arc<Reference>>,
    /// Fields besides pressure and gap that its states have.
    pub further: Vec<FurtherField>,
    /// The layers below its surface, where its solid yields.
    pub zone: Option<YieldZone>,
}

/// The plastic strain that the scale of a picture reaches where nothing has yielded, over the elastic strain at yield.
const LEAST_STRAIN: f64 = 0.1;

/// The layers below the surface of a solid that yields, and the range of what is drawn of them.
#[derive(Debug, Clone, PartialEq)]
pub struct YieldZone {
    /// The depths of their interfaces, lengths.
    pub interfaces: Vec<f64>,
    /// The yield stress, a pressure.
    pub yield_stress: f64,
    /// The least accumulated plastic strain that its scale reaches.
    pub least_strain: f64,
    /// The largest strain and the largest von Mises stress of the first state.
    pub first: [f64; 2],
}

impl YieldZone {
    /// The layers below the first state of a setup, with the largest values of its fields. None where the solid does not yield below its
    /// surface.
    pub fn new(setup: &Setup, first: &State) -> Option<Self> {
        let yield_stress = setup.yield_stress()?;
        let interfaces = first.layers.as_ref()?.interfaces.clone();
        let largest = |kind: FieldKind| first.field(kind).into_iter().flatten().copied().fold(0.0, f64::max);
        let first = [FieldKind::PlasticStrain, FieldKind::VonMises].map(largest);
        let least_strain = LEAST_STRAIN * yield_stress / setup.contact_modulus().ok()?;
        Some(Self { interfaces, yield_stress, least_strain, first })
    }
}

/// A field that the states of a scene have besides pressure and gap.
#[derive(Debug, Clone, PartialEq)]
pub struct FurtherField {
    /// Name of its entity.
    pub name: &'static str,
    /// Title of its picture.
    pub title: String,
    /// Symbol on its axis, with the unit that values are divided by.
    pub symbol: &'static str,
    /// The value at the number 1 of the axis.
    pub unit: f64,
    /// The range of the axis while the states come; at the end it reaches over all of them.
    pub range: [f64; 2],
}

impl FurtherField {
    /// The field with an axis that reaches from zero over all values, or around zero where they have both signs.
    pub fn new(name: &'static str, title: &str, (symbol, unit): (&'static str, f64), [low, high]: [f64; 2]) -> Self {
        Self { name, title: title.into(), symbol, unit, range: [0.0; 2] }.over([low, high])
    }

    /// The same field with an axis for values from `low` to `high`.
    pub(super) fn over(&self, [low, high]: [f64; 2]) -> Self {
        let most = low.abs().max(high.abs());
        let range = match most > 0.0 {
            false => [0.0, self.unit],
            true if low < 0.0 => [-most, most],
            true => [0.0, most],
        };
        Self { range, ..self.clone() }
    }
}

impl<'a> Scene<'a> {
    /// The scene of a problem that no setup describes.
    pub fn new(name: &str, problem: &'a Problem) -> Self {
        Self {
            name: name.into(),
            title: name.into(),
            problem,
            setup: None,
            exact: None,
            reference: None,
            further: Vec::new(),
            zone: None,
        }
    }

    /// The text of the setup that repeats it.
    pub(super) fn text(&self) -> Option<String> {
        self.setup.as_ref().map(Setup::to_saved_toml)
    }

    /// The scene `contact` of the problem of a setup.
    pub fn from_setup(setup: &Setup, problem: &'a Problem) -> Self {
        let grid = problem.surface().grid();
        Self {
            title: setup.surface.title(grid),
            setup: Some(setup.clone()),
            exact: problem.mean_pressure().and_then(|mean_pressure| setup.exact(grid, mean_pressure)),
            ..Self::new("contact", problem)
        }
    }

    /// The load that was given. With adhesion it is that of the setup: the problem has one that stands in for any, since the attraction takes a part of it.
    fn load(&self) -> Load {
        match &self.setup {
            Some(setup) if setup.feels().attraction => setup.load,
            _ => self.problem.load(),
        }
    }

    /// The mean pressure, if the load prescribes it.
    pub(super) fn mean_pressure(&self) -> Option<f64> {
        let problem = self.problem;
        match self.load() {
            Load::MeanPressure(mean_pressure) => Some(mean_pressure),
            Load::Force(force) => Some(force / problem.surface().grid().area()),
            Load::ReducedPressure(reduced) => Some(reduced * problem.rms_gradient() * problem.contact_modulus()),
            Load::MeanGap(_) | Load::Approach(_) => None,
        }
    }

    /// The reduced pressure, if the load prescribes it; a given one to the last bit.
    pub(super) fn reduced_pressure(&self) -> Option<f64> {
        let found = || Some(self.mean_pressure()? / self.problem.contact_modulus() / self.problem.rms_gradient());
        self.load().reduced_pressure().or_else(found)
    }

    /// The exact area and pressure, or an estimate of them if there is no exact solution.
    pub(super) fn forecast(&self) -> Forecast {
        let guess = Forecast::new(self.problem);
        let Some(exact) = &self.exact else { return guess };
        let max_pressure = exact.max_pressure.filter(|p| p.is_finite()).unwrap_or(guess.max_pressure);
        Forecast { relative_area: exact.relative_area, max_pressure }
    }
}
