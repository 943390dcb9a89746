//! The pace of the motion: time step and damping.

use super::{Dynamics, Gfmd, Masses};
use crate::contact::{Decision, chunks};

/// Constants of FIRE (Bitzek et al. 2006): steps of decreasing energy before the time step grows, its growth and
/// reduction factors, and the mixing parameter of the velocity with its decay.
const PATIENCE: usize = 5;
const GROWTH: f64 = 1.1;
const CUT: f64 = 0.5;
const TURN: f64 = 0.1;
const TURN_DECAY: f64 = 0.99;

/// With masses proportional to stiffness, the slowest motion is that of the mean on few contacts: this much softer than the
/// modes themselves, from trials on rough lines and surfaces between `p* = 1e-3` and full contact.
const SLACK: f64 = 16.0;

/// Chooses each step's share of old velocity and new force.
pub(crate) struct Pace {
    /// `dt^2 / m` at the largest stable time step allowed.
    pub step: f64,
    kind: Damping,
    decision: Decision,
}

enum Damping {
    Damped { friction: f64 },
    Fire { dt: f64, turn: f64, falling: usize },
}

impl Pace {
    /// Chooses the time step from the stiffest mode and the damping from the softest, given the `stiffness` of the
    /// modes.
    pub(crate) fn new(settings: &Gfmd, stiffness: &[f64]) -> Self {
        let positive = || stiffness.iter().copied().filter(|&k| k > 0.0);
        let stiffest = positive().fold(0.0, f64::max);
        let softest = positive().fold(f64::INFINITY, f64::min);
        let fraction = 4.0 * settings.time_step.powi(2);
        let (step, slowest) = match settings.masses {
            Masses::Uniform => (fraction / stiffest, fraction * softest / stiffest),
            Masses::Stiffness => {
                let count = stiffness.len() as f64;
                let lone = positive().sum::<f64>() / count * positive().map(|k| 1.0 / k).sum::<f64>() / count;
                let step = fraction / (2.0 * lone).max(1.0);
                (step, step / SLACK)
            }
        };
        let kind = match settings.dynamics {
            Dynamics::Damped => Damping::Damped { friction: settings.damping * slowest.sqrt() },
            Dynamics::Fire => Damping::Fire { dt: 1.0, turn: TURN, falling: 0 },
        };
        Self { step, kind, decision: Decision::Start }
    }

    /// The friction, if it stays.
    pub(crate) fn friction(&self) -> Option<f64> {
        match self.kind {
            Damping::Damped { friction } => Some(friction),
            Damping::Fire { .. } => None,
        }
    }

    /// What the last push was.
    pub(crate) fn decision(&self) -> Decision {
        self.decision
    }

    /// The shares `keep` and `add` of the next advance `keep * dw + add * a`, after an advance `dw`, under the net force `f` and
    /// the acceleration `a`.
    pub(crate) fn push(&mut self, f: &[f64], dw: &[f64], a: &[f64]) -> [f64; 2] {
        let step = self.step;
        match &mut self.kind {
            // the friction acts on the mean of the advances before and after, which leaves the stability limit where it is
            Damping::Damped { friction } => {
                self.decision = Decision::Damped;
                let share = 1.0 / (1.0 + *friction);
                [share * (1.0 - *friction), share * step]
            }
            Damping::Fire { dt, turn, falling } => {
                let power = chunks::sum(f.len(), |i| f[i] * dw[i]);
                let before = *dt;
                if power < 0.0 {
                    self.decision = Decision::Halt;
                    (*dt, *turn, *falling) = (*dt * CUT, TURN, 0);
                    return [0.0, step * dt.powi(2)];
                }
                *falling += 1;
                let share = *turn;
                if *falling > PATIENCE {
                    (*dt, *turn) = ((*dt * GROWTH).min(1.0), *turn * TURN_DECAY);
                }
                let speed = chunks::sum(dw.len(), |i| dw[i].powi(2)).sqrt();
                let pull = chunks::sum(a.len(), |i| a[i].powi(2)).sqrt();
                let turned = if pull > 0.0 { share * speed / pull } else { 0.0 };
                self.decision = if *dt > before { Decision::Accelerate } else { Decision::Coast };
                let stretch = *dt / before;
                [stretch * (1.0 - share), stretch * turned + step * dt.powi(2)]
            }
        }
    }
}
