//! A contact that the user drags: solved at once from the previous contact, and not recorded. With adhesion it depends on that contact.

use super::knobs::Knobs;
use super::refusal::{Refusal, RefusalRule};
use super::report::Numbers;
use super::section::{Section, Shear};
use super::source::SurfaceSource;
use super::sticking_hand::StickingHand;
use super::top::Top;
use crate::contact::{Contact, Load, Multilevel, Problem, Solver, Stop};
use crate::history::{Loading, PathPoint, Process};
use crate::sentence::Worded;
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
    /// Whether it is looked at, and not dragged: then it is solved as well as the knobs ask for.
    #[serde(default)]
    is_still: bool,
    /// Whether a contact with adhesion goes on from the last one under the hand; else from that of the knobs.
    #[serde(default)]
    goes_on: bool,
}

/// What the hand has left: the pressures of the contact and of that beside it, and the last states with adhesion.
#[derive(Default)]
pub(crate) struct HandMemory {
    pressures: [Option<Field>; 2],
    sticking: [Option<StickingHand>; 2],
}

/// The contact at this position.
#[derive(Serialize)]
pub struct Held {
    section: Section,
    /// The contact from above, of a surface.
    top: Option<Top>,
    /// The stress below it, if it is requested and can be computed.
    shear: Option<Shear>,
    /// The surface beside, under the same mean pressure.
    beside: Option<Section>,
    /// The stress below that.
    shear_beside: Option<Shear>,
    numbers: Numbers,
    /// The load as the knob has it: the mean pressure over the rms gradient and the modulus at once.
    load: f64,
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
    pub(super) fn solve(&self, source: Option<&SurfaceSource>, memory: &mut HandMemory) -> Result<Held, Refusal> {
        let setup = self.knobs.setup_with(source)?;
        match setup.history_drive()? {
            Some(drive) if drive.feels.attraction => return self.stick(&setup, source, memory),
            Some(drive) => return Err(RefusalRule::DragOfHistory.with([("drive", drive.given.name)])),
            None => (),
        }
        let mut problem = setup.problem()?;
        if let Some(mean_gap) = self.mean_gap {
            problem = problem.with_load(Load::MeanGap(mean_gap))?;
        }
        let [first, second] = &mut memory.pressures;
        let stop = self.stop(&setup)?;
        let contact = solve(&problem, &setup, stop, first)?;
        let beside = self.knobs.beside_with(source)?.map(|beside| {
            let problem = beside.problem()?.with_load(Load::MeanPressure(contact.mean_pressure()))?;
            solve(&problem, &beside, stop, second)
        });
        let beside = beside.transpose()?;
        let shear = |contact: &Contact| self.is_deep.then(|| Shear::below(contact)).flatten();
        Ok(Held {
            section: Section::from_contact(&contact, &[]),
            top: Top::of_hand(&contact, &[]),
            shear: shear(&contact),
            shear_beside: beside.as_ref().and_then(shear),
            beside: beside.as_ref().map(|it| Section::from_contact(it, &[])),
            numbers: Numbers::from_contact(&contact),
            load: knob_load(&contact),
        })
    }

    /// When the contact is solved well enough.
    fn stop(&self, setup: &Setup) -> Result<Stop, Refusal> {
        let dragged = || Stop::new(setup.stop.tolerance().max(TOLERANCE), MOST_STEPS);
        if self.is_still { Ok(setup.stop) } else { dragged().map_err(|it| Refusal::from(it.sentence())) }
    }

    /// Solves a contact with adhesion, from the last state under the hand or that of the knobs. The stress below is not that of the pressure
    /// between the surfaces alone, and is left out.
    fn stick(&self, setup: &Setup, source: Option<&SurfaceSource>, memory: &mut HandMemory) -> Result<Held, Refusal> {
        let [first, second] = &mut memory.sticking;
        let load = self.mean_gap.map(Load::MeanGap);
        let [before, before_beside] = [&mut *first, &mut *second].map(|it| it.take().filter(|_| self.goes_on));
        let hand = StickingHand::moved(setup, before, load)?;
        let beside = self.knobs.beside_with(source)?.map(|beside| {
            let load = Load::MeanPressure(hand.mean_pressure());
            StickingHand::moved(&beside, before_beside, Some(load))
        });
        let beside = beside.transpose()?;
        let section = |it: &StickingHand| Section::from_contact(&it.state().contact, &it.state().fields);
        let held = Held {
            section: section(&hand),
            top: Top::of_hand(&hand.state().contact, &hand.state().fields),
            shear: None,
            shear_beside: None,
            beside: beside.as_ref().map(section),
            numbers: hand.numbers(),
            load: knob_load(&hand.state().contact),
        };
        (*first, *second) = (Some(hand), beside);
        Ok(held)
    }
}

/// The load of a contact as the knob has it.
fn knob_load(contact: &Contact) -> f64 {
    contact.mean_pressure() / (contact.problem.rms_gradient() * contact.problem.contact_modulus())
}

/// The fastest solver of a setup, whatever the setup says.
pub(super) fn fast_solver(setup: &Setup) -> &dyn Solver {
    if setup.sliding.is_some() { setup.solver() } else { &Multilevel }
}

/// The contact of a problem, from the pressure before if it is on the same grid.
fn solve(problem: &Problem, setup: &Setup, stop: Stop, before: &mut Option<Field>) -> Result<Contact, Refusal> {
    let shape = problem.surface().grid().shape();
    let start = before.take().filter(|field| field.dim() == shape.into());
    let mut loading = Loading::new(problem.clone(), fast_solver(setup), stop).started_from(start);
    let solved = loading.move_to(PathPoint::under(problem.load()), &mut ());
    let contact = solved.map_err(|fault| Refusal::from(fault.sentence()))?.contact;
    *before = Some(contact.pressure.clone());
    Ok(contact)
}
