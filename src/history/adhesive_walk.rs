//! The way of a contact with adhesion from one control to another: along branches of states, and over the jumps between them.

use super::adhesive_place::{AdhesionLedger, AdhesivePlace, AdhesiveStep, AdhesiveVisit, Branch, EnergyBalance, less};
use super::adhesive_search::PlaceSearch;
use crate::adhesion::AdhesiveControl;
use crate::contact::{Observer, Work};
use crate::error::AdhesionError;
use std::sync::Arc;

/// Energy that a step on a branch may miss, over that of the attraction.
const MISSED: f64 = 2e-5;

/// Energy that a step on a branch may miss over the energy that was lost so far, and over its change in the step.
const MISSED_OF_LOST: f64 = 5e-4;
const MISSED_OF_RISE: f64 = 1e-5;

/// Energy of a jump, over that of the attraction, from which the states before and after it are shown. With an attraction that jumps, node after
/// node snaps at the edges of a contact: only larger jumps are shown.
const SHOWN: f64 = 1e-3;
const SHOWN_OF_SNAPS: f64 = 1e-2;

/// The part to which the energy of a jump is known, and, where the jump is not shown, the part of the energy lost so far.
const LOCATED: f64 = 0.01;
const LOCATED_OF_LOST: f64 = 5e-4;

/// The part of a load that pulls by which the last state that holds may lie below the one that parts the surfaces.
const PULL_OFF: f64 = 1e-3;

/// The part of the width within which a jump is located below which a step is not halved, also where the energy of the jump is not known.
const LEAST: f64 = 1e-4;

/// By how much the correction of a step may differ from that with the bend of the step before, over the energy that it may miss. Otherwise the
/// correction may hide a jump.
const SWERVE: f64 = 1.0;

/// The most halvings of the way from one control to another.
const HALVINGS: i32 = 30;

/// The part of a step by which rounding moves its end.
const ROUNDING: f64 = 1e-4;

/// The most by which a step is longer than the one before.
const LONGER: f64 = 2.0;

/// The way from one control to another.
pub(super) struct BranchWalk<'a> {
    search: &'a PlaceSearch,
    begin: f64,
    end: AdhesiveControl,
    /// The width within which a jump is located.
    finest: f64,
    at: f64,
    from: AdhesivePlace,
    branch: Branch,
    ledger: AdhesionLedger,
    /// The nearest control that one step did not reach on the branch.
    beyond: Option<Beyond>,
    /// Energy of a jump, over that of the attraction, from which it is shown.
    shown: f64,
    work: Work,
}

/// The nearest control at which a step left the branch, was too long or found no state.
struct Beyond {
    to: f64,
    /// The energy that a step from the present place to this control would miss if there were no jump. It falls with the third power of the length
    /// of the step.
    missed: f64,
    /// The width within which the step is accepted as a jump.
    width: f64,
    /// The nearest place that was found beyond, and its control.
    found: Option<(f64, AdhesiveStep)>,
}

impl<'a> BranchWalk<'a> {
    /// The way from a place to a control, on which jumps are located within `finest`.
    pub(crate) fn new(search: &'a PlaceSearch, last: &AdhesiveVisit, end: AdhesiveControl, finest: f64) -> Self {
        let (at, from, branch) = (last.control.value(), last.place.clone(), last.branch.clone());
        let (ledger, work) = (last.ledger, Work::default());
        let shown = if search.attraction().steepest().is_infinite() { SHOWN_OF_SNAPS } else { SHOWN };
        Self { search, begin: at, end, finest, at, from, branch, ledger, beyond: None, shown, work }
    }

    /// Adds the places on the way: both sides of each jump with the frames between them, and the end. After an error they end with the last
    /// place that was found.
    pub(crate) fn run(
        mut self,
        observer: &mut dyn Observer,
        visits: &mut Vec<AdhesiveVisit>,
    ) -> Result<(), AdhesionError> {
        loop {
            match self.step(observer, visits) {
                Ok(true) => return Ok(()),
                Ok(false) => {}
                Err(error) => {
                    if self.at != self.begin {
                        visits.push(self.visit(self.from.clone(), self.at, None));
                    }
                    return Err(error);
                }
            }
        }
    }

    /// One step, and whether it reached the end.
    fn step(&mut self, observer: &mut dyn Observer, visits: &mut Vec<AdhesiveVisit>) -> Result<bool, AdhesionError> {
        if let Some((to, step)) = self.known_jump() {
            return self.jump(to, step, observer, visits);
        }
        let to = self.next();
        let width = (to - self.at).abs();
        let mut step = self.search.probe(self.end.with_value(to), &self.from, &self.branch, observer)?;
        if step.place.fault().is_some() {
            return self.go_around(to, step, observer, visits);
        }
        let mut balance = self.balance(&step.place);
        if self.is_smooth(&step.place, &balance) {
            self.search.test_stability(&mut step, observer)?;
            if step.place.fault().is_some() {
                return self.go_around(to, step, observer, visits);
            }
            balance = self.balance(&step.place);
        }
        if self.is_smooth(&step.place, &balance) {
            return Ok(self.go_on(to, step, &balance, visits));
        }
        let finest = self.finest_to(to, &step.place);
        if width <= finest || self.is_located(&step.place, &balance, width) {
            return self.jump(to, step, observer, visits);
        }
        self.forget_beyond();
        self.beyond = Some(Beyond { to, missed: balance.lost.abs(), width: finest, found: Some((to, step)) });
        Ok(false)
    }

    /// The jump to a place that was found, if it is close enough by now.
    fn known_jump(&mut self) -> Option<(f64, AdhesiveStep)> {
        let at = self.at;
        let close = self.beyond.take_if(|beyond| (beyond.to - at).abs() <= beyond.width && beyond.found.is_some())?;
        close.found
    }

    /// Forgets what was found beyond, whose work counts.
    fn forget_beyond(&mut self) {
        if let Some((_, step)) = self.beyond.take().and_then(|beyond| beyond.found) {
            self.work += step.work;
        }
    }

    /// Halves a step to a control at which no state was found. Close to a jump a search may be too slow: then the place beyond it counts. Without
    /// one, what was found last is the end of the way.
    fn go_around(
        &mut self,
        to: f64,
        failed: AdhesiveStep,
        observer: &mut dyn Observer,
        visits: &mut Vec<AdhesiveVisit>,
    ) -> Result<bool, AdhesionError> {
        self.work += failed.work;
        let found = self.beyond.take().and_then(|beyond| beyond.found);
        if (to - self.at).abs() > self.finest {
            self.beyond = Some(Beyond { to, missed: f64::INFINITY, width: LEAST * self.finest, found });
            return Ok(false);
        }
        if let Some((to, step)) = found {
            return self.jump(to, step, observer, visits);
        }
        self.give_up(to, AdhesiveStep { work: Work::default(), ..failed })
    }

    /// Ends the way at a place that is no equilibrium, which is shown as such.
    fn give_up(&mut self, to: f64, failed: AdhesiveStep) -> Result<bool, AdhesionError> {
        self.work += failed.work;
        (self.from, self.at) = (failed.place, to);
        self.from.fault().map_or(Ok(false), Err)
    }

    /// The width within which a jump to a place is located at the latest. The load that parts the surfaces is located to a part of itself.
    fn finest_to(&self, to: f64, place: &AdhesivePlace) -> f64 {
        let parts = self.from.state().is_some() && place.state().is_none();
        let least = LEAST * self.finest;
        if parts { least.max(PULL_OFF * to.abs()) } else { least }
    }

    /// The control of the next step: half the way to where the branch was left, or as far as the last steps suggest. The whole way is halved,
    /// and halved again, so that steps back end at the same controls.
    fn next(&self) -> f64 {
        if let Some(beyond) = &self.beyond {
            return 0.5 * (self.at + beyond.to);
        }
        let way = self.end.value() - self.begin;
        let longest = LONGER.sqrt() * self.branch.length.unwrap_or(f64::INFINITY) / way.abs();
        let part = (0..HALVINGS).map(|halvings| 0.5f64.powi(halvings)).find(|part| *part <= longest);
        let part = part.unwrap_or(0.5f64.powi(HALVINGS));
        let done = ((self.at - self.begin) / way / part + ROUNDING).floor();
        let to = (done + 1.0) * part;
        if to < 1.0 { self.begin + to * way } else { self.end.value() }
    }

    fn balance(&self, place: &AdhesivePlace) -> EnergyBalance {
        self.branch.balance(&self.from, place, self.search.attraction())
    }

    /// The energy that a step may miss.
    fn allowed(&self, balance: &EnergyBalance) -> f64 {
        let noise = self.search.noise() * self.search.attraction().work();
        let [held, lost] = [MISSED * balance.held, MISSED_OF_LOST * self.ledger.counted()];
        held.max(lost).max(MISSED_OF_RISE * balance.rise.abs()).max(noise)
    }

    /// Whether a step stays on its branch. A convex energy has only one.
    fn is_smooth(&self, after: &AdhesivePlace, balance: &EnergyBalance) -> bool {
        let allowed = self.allowed(balance);
        let is_straight = || {
            let open = self.open_energy(after);
            balance.swerve.abs() <= SWERVE * allowed || open.is_some_and(|open| self.is_open_enough(open))
        };
        balance.is_convex || balance.lost.abs() <= allowed && is_straight()
    }

    /// Whether a step is a jump whose place and energy are known well enough.
    fn is_located(&self, after: &AdhesivePlace, balance: &EnergyBalance, width: f64) -> bool {
        let Some(open) = self.open_energy(after) else { return false };
        let is_known = open <= LOCATED * balance.lost;
        let is_small = balance.lost < self.shown * balance.held;
        let is_jump = balance.lost > self.allowed(balance);
        is_jump && if is_small { is_known || self.is_open_enough(open) } else { is_known && width <= self.finest }
    }

    /// The energy that a jump somewhere in a step may lose more or less: within the width of the step it changes by the change of the conjugate
    /// quantity, from where the branch would have gone on. What a step on a branch misses is never as large. None where it is not known.
    fn open_energy(&self, after: &AdhesivePlace) -> Option<f64> {
        let width = (after.state()?.control.value() - self.at).abs();
        self.branch.change_beyond(&self.from, after).map(|change| 0.5 * width * change)
    }

    /// Whether an energy does not count beside what was lost so far.
    fn is_open_enough(&self, open: f64) -> bool {
        open <= LOCATED_OF_LOST * self.ledger.counted()
    }

    /// Accepts a step along the branch.
    fn go_on(&mut self, to: f64, step: AdhesiveStep, balance: &EnergyBalance, visits: &mut Vec<AdhesiveVisit>) -> bool {
        let allowed = self.allowed(balance);
        if let Some(beyond) = &mut self.beyond {
            beyond.missed /= 8.0;
        }
        if self.beyond.as_ref().is_some_and(|beyond| beyond.missed <= allowed) {
            self.forget_beyond();
        }
        let share = if balance.lost == 0.0 { f64::INFINITY } else { allowed / balance.lost.abs() };
        let length = self.next_length(to, share);
        if self.counts_small_losses(&step.place) {
            self.ledger.add_jump(balance);
        } else {
            self.ledger.add_smooth(balance);
        }
        self.branch = Branch { past: self.from.state().cloned(), bend: balance.bend, length };
        self.work += step.work;
        self.move_on(step.place, to);
        self.ends(visits, None)
    }

    /// The length of the next step on the branch, where one to a control missed a part of what is allowed. A longer one would miss more, by
    /// the third power of its length. Steps towards a jump, and the last one to the end, say nothing about longer ones.
    fn next_length(&self, to: f64, share: f64) -> Option<f64> {
        let known = self.branch.length;
        if to == self.at {
            return known;
        }
        let length = share.cbrt().clamp(0.5, LONGER) * (to - self.at).abs();
        match &self.beyond {
            Some(_) => known,
            None if to == self.end.value() => Some(known.map_or(length, |known| known.max(length))),
            None => Some(length),
        }
    }

    /// Whether nodes have come within reach of an attraction that jumps there, or have left it: each of them has jumped.
    fn counts_small_losses(&self, after: &AdhesivePlace) -> bool {
        let (Some(before), Some(after)) = (self.from.state(), after.state()) else { return false };
        let attraction = self.search.attraction();
        let is_within = |gap: &f64| *gap < attraction.cutoff();
        let mut pairs = before.contact.gap.iter().zip(&after.contact.gap);
        attraction.steepest().is_infinite() && pairs.any(|(before, after)| is_within(before) != is_within(after))
    }

    /// Accepts a step over a jump.
    fn jump(
        &mut self,
        to: f64,
        mut step: AdhesiveStep,
        observer: &mut dyn Observer,
        visits: &mut Vec<AdhesiveVisit>,
    ) -> Result<bool, AdhesionError> {
        self.search.test_stability(&mut step, observer)?;
        if step.place.fault().is_some() {
            return self.give_up(to, step);
        }
        let balance = Branch::default().balance(&self.from, &step.place, self.search.attraction());
        let lost = balance.lost;
        let is_shown = lost > self.shown * balance.held;
        let AdhesiveStep { place, frames, work } = step;
        self.forget_beyond();
        if is_shown && self.at != self.begin {
            let before = self.visit(self.from.clone(), self.at, None);
            visits.push(before);
        }
        let mut shown = Work::default();
        for frame in frames.into_iter().filter(|_| is_shown) {
            let since = less(frame.work, std::mem::replace(&mut shown, frame.work));
            self.work += since;
            let visit = self.visit(AdhesivePlace::State(Arc::new(frame)), to, None);
            visits.push(visit);
        }
        self.work += less(work, shown);
        self.ledger.add_jump(&balance);
        self.branch = Branch { length: self.branch.length, ..Branch::default() };
        self.move_on(place, to);
        let jump = Some(lost).filter(|lost| is_shown && lost.is_finite());
        if is_shown && to != self.end.value() {
            let visit = self.visit(self.from.clone(), to, jump);
            visits.push(visit);
        }
        Ok(self.ends(visits, jump))
    }

    /// The next place is where the way is.
    fn move_on(&mut self, place: AdhesivePlace, to: f64) {
        self.ledger = self.ledger.at(&place);
        (self.from, self.at) = (place, to);
    }

    /// Whether the end is reached, which is visited then.
    fn ends(&mut self, visits: &mut Vec<AdhesiveVisit>, jump: Option<f64>) -> bool {
        let is_end = self.at == self.end.value();
        if is_end {
            let visit = self.visit(self.from.clone(), self.at, jump);
            visits.push(visit);
        }
        is_end
    }

    /// A visit to a place, with the work since the last one.
    fn visit(&mut self, place: AdhesivePlace, at: f64, jump: Option<f64>) -> AdhesiveVisit {
        let (ledger, work, branch) = (self.ledger, std::mem::take(&mut self.work), self.branch.clone());
        AdhesiveVisit { place, control: self.end.with_value(at), ledger, jump, work, branch }
    }
}
