//! A contact under several loads, one after the other.

use crate::contact::{Contact, Load, Observer, Problem};
use crate::error::{SetupError, StudyError};
use crate::history::{Loading, Process};
use crate::setup::{Cost, Extras, Setup, SetupTable};
use crate::surface::Surface;
use std::sync::Arc;

/// A contact under several loads, one after the other; each solve starts from the previous contact.
///
/// With a hardness, plastic deformation remains, see [`Loading`].
///
/// ```
/// use asperity::contact::Load;
/// use asperity::setup::{Cell, Recipe, Setup};
/// use asperity::{Indenter, study::LoadCurve};
///
/// let cylinder = Recipe::indenter(Indenter::Cylinder { radius: 1.0 });
/// let loads = [0.001, 0.002, 0.004].map(Load::ReducedPressure);
/// let setup = Setup::new(cylinder, Cell::line(1024, 4.0), loads[0]);
/// let curve = LoadCurve { setup, loads: loads.into() }.and_back();
/// let mut areas = Vec::new();
/// curve.press(&curve.problem()?, |_| (), |_, contact| {
///     areas.push(contact.counted().relative_area);
///     Ok::<(), asperity::error::StudyError>(())
/// })?;
/// assert!(areas[0] < areas[1] && areas[1] < areas[2]);
/// // without friction and adhesion there is no hysteresis
/// assert_eq!(areas[..2], [areas[4], areas[3]]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct LoadCurve {
    /// The contact; its own load is not used.
    pub setup: Setup,
    /// Loads in the order in which they are applied.
    pub loads: Vec<Load>,
}

impl LoadCurve {
    /// The curve that returns through the same loads after the last one.
    pub fn and_back(mut self) -> Self {
        let back: Vec<Load> = self.loads.iter().rev().skip(1).copied().collect();
        self.loads.extend(back);
        self
    }

    /// The setup with its list of loads.
    pub fn to_table(&self) -> SetupTable {
        let mut table = self.setup.to_saved_table();
        table.lay_loads(&self.loads);
        table
    }

    /// The text of the setup that repeats the run; without loads that of the setup alone.
    pub fn to_toml(&self) -> String {
        match self.loads.as_slice() {
            [] => self.setup.to_saved_toml(),
            _ => self.to_table().to_toml(),
        }
    }

    /// The cost of all solves, see [`Setup::cost`].
    ///
    /// # Errors
    /// The errors of [`Setup::cost`].
    pub fn cost(&self, extras: &Extras) -> Result<Cost, SetupError> {
        let largest = self.loads.iter().copied().max_by(|a, b| a.value().total_cmp(&b.value()));
        let setup = Setup { load: largest.unwrap_or(self.setup.load), ..self.setup.clone() };
        let cost = setup.cost(extras)?;
        // the pressure of the load before included
        Ok(Cost { bytes: cost.bytes + Cost::from_fields(&cost.grid, 1.0).bytes, ..cost })
    }

    /// The problem under the largest load. All loads are checked.
    ///
    /// # Errors
    /// The errors of [`Setup::problem`], under any of the loads.
    pub fn problem(&self) -> Result<Problem, SetupError> {
        self.problem_of(self.setup.surface()?)
    }

    /// The same problem of heights that are given, instead of those that the setup describes.
    ///
    /// # Errors
    /// The errors of [`Setup::problem_of`], under any of the loads.
    pub fn problem_of(&self, surface: impl Into<Arc<Surface>>) -> Result<Problem, SetupError> {
        let any = self.setup.problem_of(surface)?;
        let under = |load: &Load| any.clone().with_load(*load);
        let all = self.loads.iter().map(under).collect::<Result<Vec<_>, _>>()?;
        let heaviest = all.into_iter().max_by(|a, b| a.expected_mean_pressure().total_cmp(&b.expected_mean_pressure()));
        Ok(heaviest.unwrap_or(any))
    }

    /// Solves `problem` under all loads, one after the other. `watch` makes the observer of each load, and `each` is
    /// called with each contact; both get the number of the load, from 0.
    ///
    /// # Errors
    /// For impossible loads, such as a mean gap after the surface has yielded, and those of `each`. Contacts
    /// that did not converge are shown, too.
    pub fn press<O: Observer, E: From<StudyError>>(
        &self,
        problem: &Problem,
        mut watch: impl FnMut(usize) -> O,
        mut each: impl FnMut(usize, &Contact) -> Result<(), E>,
    ) -> Result<(), E> {
        let mut loading = self.loading(problem);
        for number in 0..self.loads.len() {
            let Some(state) = loading.next(&mut watch(number)) else { break };
            each(number, &state.map_err(StudyError::from)?.contact)?;
        }
        Ok(())
    }

    /// The process of the loads on a problem.
    pub fn loading(&self, problem: &Problem) -> Loading<'_> {
        Loading::new(problem.clone(), self.setup.solver(), self.setup.stop).along(self.loads.clone())
    }
}
