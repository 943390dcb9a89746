//! A contact that the user drags: solved at once from the previous contact, and not recorded.

use super::knobs::Knobs;
use super::refusal::Refusal;
use super::report::Numbers;
use super::section::{Section, Shear};
use super::source::SurfaceSource;
use crate::contact::{Contact, Load, Multilevel, Problem, Solver, Stop};
use crate::setup::Setup;
use crate::surface::Field;
use serde::{Deserialize, Serialize};

/// Tolerance and largest number of steps of a contact that the user drags.
const TOLERANCE: f64 = 1e-6;
const MOST_STEPS: usize = 2000;

/// The position to which the user drags the rigid surface.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Hold {
    /// The state of the knobs.
    knobs: Knobs,
    /// The mean gap, a length; without it the load of the knobs.
    mean_gap: Option<f64>,
    /// Whether the stress below is requested.
    is_deep: bool,
}

/// The contact at this position.
#[derive(Serialize)]
pub struct Held {
    section: Section,
    /// The stress below it, if it is requested and can be computed.
    shear: Option<Shear>,
    /// The surface beside, under the same mean pressure.
    beside: Option<Section>,
    /// The stress below that.
    shear_beside: Option<Shear>,
    numbers: Numbers,
}

impl Hold {
    /// The state of the knobs.
    pub(super) fn knobs(&self) -> &Knobs {
        &self.knobs
    }

    /// Solves, from the pressures before, of this surface and of the one beside, if they are on the same grid: the new ones then take their
    /// places.
    ///
    /// # Errors
    /// A refusal for invalid knobs, and for a gap at which nothing or everything touches.
    pub(super) fn solve(
        &self,
        source: Option<&SurfaceSource>,
        before: &mut [Option<Field>; 2],
    ) -> Result<Held, Refusal> {
        let setup = self.knobs.setup_with(source)?;
        if setup.is_history()? {
            return Err(Refusal("a contact that creeps cannot be dragged: set the time to 0".into()));
        }
        let mut problem = setup.problem()?;
        if let Some(mean_gap) = self.mean_gap {
            problem = problem.with_load(Load::MeanGap(mean_gap))?;
        }
        let [first, second] = before;
        let contact = solve(&problem, &setup, first)?;
        let beside = self.knobs.beside_with(source)?.map(|beside| {
            let problem = beside.problem()?.with_load(Load::MeanPressure(contact.mean_pressure()))?;
            solve(&problem, &beside, second)
        });
        let beside = beside.transpose()?;
        let shear = |contact: &Contact| self.is_deep.then(|| Shear::below(contact)).flatten();
        Ok(Held {
            section: Section::from_contact(&contact),
            shear: shear(&contact),
            shear_beside: beside.as_ref().and_then(shear),
            beside: beside.as_ref().map(Section::from_contact),
            numbers: Numbers::from_contact(&contact),
        })
    }
}

/// The fastest solver of a setup, whatever the setup says.
pub(super) fn fast_solver(setup: &Setup) -> &dyn Solver {
    if setup.sliding.is_some() { setup.solver() } else { &Multilevel }
}

/// The contact of a problem, from the pressure before if it is on the same grid.
fn solve(problem: &Problem, setup: &Setup, before: &mut Option<Field>) -> Result<Contact, Refusal> {
    let stop = Stop::new(setup.stop.tolerance().max(TOLERANCE), MOST_STEPS).map_err(|it| Refusal(it.to_string()))?;
    let shape = problem.surface().grid().shape();
    let start = before.take().filter(|field| field.dim() == shape.into());
    let solved = fast_solver(setup).solve_from(start.as_ref(), problem, &stop, &mut ());
    let contact = solved.map_err(|fault| Refusal(fault.to_string()))?;
    *before = Some(contact.pressure.clone());
    Ok(contact)
}
