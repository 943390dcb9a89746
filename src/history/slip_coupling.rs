//! Rounds between pressure and traction, where they displace the surface in each other's direction.

use crate::anderson::Anderson;
use crate::contact::Problem;
use crate::elastic::Coupling;
use crate::error::SlipError;

/// Largest number of rounds between pressure and traction in one step.
const ROUNDS: usize = 400;

/// A round counts as progress if the change of the heights is less than this part of the least one so far. After some rounds without
/// progress the pace is halved, and the earlier rounds are forgotten.
const PROGRESS: f64 = 0.95;
const PATIENCE: usize = 3;

/// The pace is never less: with hardly any pace, rounds would repeat themselves.
const LEAST_PACE: f64 = 0.02;

/// What pressure and traction of a contact displace in each other's direction, `beta S` with Dundurs' constant.
pub(super) struct SlipCoupling {
    beta: f64,
    coupling: Coupling,
    /// Transforms of the steps before.
    counted: u64,
}

/// The rounds of one step, by Anderson's method with the part `pace` of the change of the heights. Plain rounds may run in a circle, where
/// nodes touch and leave in turn.
pub(super) struct SlipRounds {
    number: usize,
    pace: f64,
    /// The least change so far, and the rounds that may follow without progress.
    least: f64,
    patience: usize,
    raised: Vec<f64>,
    anderson: Anderson,
}

impl SlipCoupling {
    pub(crate) fn new(beta: f64, coupling: Coupling) -> Self {
        Self { beta, coupling, counted: 0 }
    }

    /// Number of transforms since this was asked last.
    pub(crate) fn transforms(&mut self) -> u64 {
        let all = self.coupling.transforms();
        all - std::mem::replace(&mut self.counted, all)
    }

    /// Adds `sign` times `beta S p` to displacements along `x` and `y`, the second of which is empty on a line.
    pub(crate) fn add_by_pressure(&mut self, pressure: &[f64], displacement: &mut [Vec<f64>; 2], sign: f64) {
        let mut added = displacement.each_ref().map(|it| vec![0.0; it.len()]);
        self.coupling.by_pressure(pressure, added.each_mut().map(Vec::as_mut_slice));
        for (displacement, added) in displacement.iter_mut().zip(added) {
            displacement.iter_mut().zip(added).for_each(|(u, added)| *u += sign * self.beta * added);
        }
    }

    /// `beta S tau`, the displacement into the solid by a traction.
    pub(crate) fn by_traction(&mut self, traction: &[Vec<f64>; 2]) -> Vec<f64> {
        let mut raised = vec![0.0; traction[0].len()];
        self.coupling.by_traction(traction.each_ref().map(Vec::as_slice), &mut raised);
        raised.iter_mut().for_each(|u| *u *= self.beta);
        raised
    }
}

impl SlipRounds {
    /// The rounds of a step with the coefficient of friction `mu`, which begin with what the traction of the last step `raised`.
    pub(crate) fn new(mu: f64, coupling: Option<&SlipCoupling>, raised: &[f64]) -> Self {
        let (beta, raised) = coupling.map_or((0.0, Vec::new()), |it| (it.beta, raised.to_vec()));
        // where everything slips, a round multiplies each wave of the pressure by i mu beta, and this is the best pace
        let pace = 1.0 / (1.0 + (mu * beta).powi(2));
        Self { number: 1, pace, least: f64::INFINITY, patience: PATIENCE, raised, anderson: Anderson::default() }
    }

    /// The number of the round, from 1.
    pub(crate) fn number(&self) -> usize {
        self.number
    }

    /// What the traction displaces into the solid in this round; empty without coupling.
    pub(crate) fn raised(&self) -> &[f64] {
        &self.raised
    }

    /// Goes on to the next round with what the last traction displaces, and whether there is one.
    pub(crate) fn advance(&mut self, raised: &[f64]) -> bool {
        let change: Vec<f64> = self.raised.iter().zip(raised).map(|(from, to)| to - from).collect();
        let size = change.iter().map(|change| change.powi(2)).sum::<f64>().sqrt();
        if size < PROGRESS * self.least {
            (self.least, self.patience) = (size, PATIENCE);
        } else if self.patience > 1 {
            self.patience -= 1;
        } else {
            (self.pace, self.patience) = ((0.5 * self.pace).max(LEAST_PACE), PATIENCE);
            self.anderson.clear();
        }
        self.raised = self.anderson.next(std::mem::take(&mut self.raised), change, self.pace);
        self.number += 1;
        self.number <= ROUNDS
    }
}

/// The problem with heights that are less by what a traction displaces.
pub(super) fn posed(problem: &Problem, raised: &[f64]) -> Result<Problem, SlipError> {
    if raised.iter().all(|u| *u == 0.0) {
        return Ok(problem.clone());
    }
    let mut height = problem.surface().height().clone();
    height.iter_mut().zip(raised).for_each(|(h, u)| *h -= u);
    Ok(problem.with_heights(height)?)
}
