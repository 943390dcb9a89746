//! Causes of a slow run, in words.

use super::curve::Plateau;
use super::returns::Cycle;
use serde::Serialize;
use std::fmt;

/// A cause of a slow run, with the numbers that show it. Its text is one or two sentences, with a remedy.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "cause", rename_all = "snake_case", rename_all_fields = "snake_case")]
pub enum Cause {
    /// The tolerance is below the certificate that rounding allows.
    Rounding {
        /// The tolerance.
        tolerance: f64,
        /// The best certificate.
        eta: f64,
        /// The most that rounding of the displacement can add to a certificate.
        rounding: f64,
        /// The step after which nothing improved.
        from: usize,
    },
    /// The contact set cycles.
    Cycle {
        /// Changes of the set until it is the same again.
        period: usize,
        /// The number of times that the cycle was repeated.
        rounds: usize,
        /// The step at which it began.
        from: usize,
        /// Nodes that entered or left in every round.
        nodes: usize,
    },
    /// A damping far from the best one for the longest wave.
    Damping {
        /// The damping divided by the critical damping of the longest wave.
        damping: f64,
        /// Theoretical decrease of the error of the longest wave, in digits per step.
        rate: f64,
        /// Its best possible decrease, in digits per step.
        best: f64,
    },
    /// One mass for waves of very different stiffness.
    Masses {
        /// Ratio of stiffness to mass of the shortest wave, divided by that of the longest.
        condition: f64,
        /// Theoretical decrease of the error of the longest wave at the best damping, in digits per step.
        best: f64,
    },
    /// Waves that converged more slowly than the others.
    SlowBand {
        /// Their longest and shortest wavelength.
        wavelengths: [f64; 2],
        /// Share of the steps in which they had the largest part of the energy of the error.
        share: f64,
        /// Decrease of their error in the later half of the run, in digits per step.
        rate: f64,
        /// Theoretical decrease of such a wave without contact, in digits per step, if known.
        theory: Option<f64>,
    },
    /// An operator with a large condition number, on which conjugate gradients are slow.
    Condition {
        /// Grid level.
        level: usize,
        /// The largest ratio of Ritz values, a lower bound of the condition number.
        condition: f64,
    },
    /// Nodes that changed their state often.
    Flips {
        /// Nodes that entered or left more often than `times`.
        nodes: usize,
        /// The number of times.
        times: u32,
        /// The node that did so most often, its position along y and x, and how often.
        position: [f64; 2],
        /// How often that node did.
        most: u32,
    },
    /// The certificate did not improve for many steps.
    Plateau {
        /// First and last step.
        steps: [usize; 2],
        /// The best certificate in it.
        eta: f64,
        /// The event that ended it, in words.
        end: &'static str,
    },
}

impl Cause {
    pub(super) fn from_cycle(Cycle { period, rounds, from }: Cycle, nodes: usize) -> Self {
        Self::Cycle { period, rounds, from, nodes }
    }

    pub(super) fn from_plateau(plateau: Plateau) -> Self {
        let end = match plateau.next {
            None => "the end of the run",
            Some(next) if next.has_changed => "a change of the contact set",
            Some(next) => next.decision.map_or("a step like the others", |decision| match decision.name() {
                "conjugate" => "a step of conjugate gradients on the same contact set",
                "descend" => "a gradient step",
                "guarded" => "a guarded step",
                "whole-set" | "single-precision" | "split-compliance" => "an update of the whole contact set",
                "halt" => "a restart of FIRE",
                _ => "a step like the others",
            }),
        };
        Self::Plateau { steps: plateau.steps, eta: plateau.eta, end }
    }
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Rounding { tolerance, eta, rounding, from } => write!(
                f,
                "The tolerance {tolerance:.1e} is below the rounding error: the certificate did not improve after \
                 step {from}. It is {eta:.1e}, of which rounding of the displacement can cause {rounding:.1e}. \
                 Choose a larger tolerance."
            ),
            Self::Cycle { period, rounds, from, nodes } => write!(
                f,
                "The contact set cycles: from step {from} on, the same set recurred {rounds} times, after every \
                 {period} changes, in which {nodes} nodes enter and leave. Solve more accurately on each set, or \
                 accept only changes that lower the energy."
            ),
            Self::Damping { damping, rate, best } => write!(
                f,
                "The damping is not well chosen: it is {damping:.2} times the critical damping of the longest wave, \
                 which {}. In theory, its error decreases by {rate:.1e} digits per step; with damping 1 by \
                 {best:.1e}.",
                if damping > 1.0 { "creeps" } else { "swings" }
            ),
            Self::Masses { condition, best } => write!(
                f,
                "Uniform masses: the time step must suit the shortest wave, which is {condition:.0} times stiffer \
                 than the longest. Even with the best damping, the error decreases by only {best:.1e} digits per \
                 step. Use masses proportional to stiffness, FIRE, or another solver."
            ),
            Self::SlowBand { wavelengths: [long, short], share, rate, theory } => {
                write!(
                    f,
                    "Wavelengths from {short:.3e} to {long:.3e} converged slowest: they had the largest error in \
                     {:.0} % of the steps, and their error decreased by {rate:.1e} digits per step",
                    100.0 * share
                )?;
                theory.map_or(Ok(()), |theory| write!(f, " (in theory, without contact: {theory:.1e})"))?;
                f.write_str(".")
            }
            Self::Condition { level, condition } => write!(
                f,
                "Conjugate gradients had a condition number of at least {condition:.1e} on grid level {level}: about \
                 {:.0} steps for each digit of the certificate.",
                condition.sqrt() * std::f64::consts::LN_10 / 4.0
            ),
            Self::Flips { nodes, times, position: [y, x], most } => {
                let place = if y > 0.0 { format!("y = {y:.4e}, x = {x:.4e}") } else { format!("x = {x:.4e}") };
                write!(
                    f,
                    "{nodes} nodes entered or left the contact more than {times} times each; the one at {place} did \
                     so {most} times."
                )
            }
            Self::Plateau { steps: [from, to], eta, end } => {
                write!(
                    f,
                    "The certificate fell by less than a factor of 2 from step {from} to step {to}, where it was {eta:.1e}, until {end}."
                )
            }
        }
    }
}
