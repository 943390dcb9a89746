//! Questions of lessons, to which one guesses the answer.

use super::refusal::Refusal;
use super::words::Words;
use crate::contact::OBSERVABLES;
use serde::{Deserialize, Serialize};

/// A question to which one answers by a guess.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Question {
    /// One of some answers.
    Choose {
        /// The question.
        question: Words,
        /// The answers.
        choices: Vec<Words>,
        /// Which of them is right, from 1 on.
        right: usize,
    },
    /// A number that the run will tell.
    Number {
        /// The question.
        question: Words,
        /// The observable that answers it, such as `kappa_r_resolved`.
        of: String,
    },
    /// A curve against the load, which a sweep will draw beside the guess.
    Draw {
        /// The question.
        question: Words,
        /// Which curve.
        curve: Curve,
    },
}

/// A curve of a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Curve {
    /// The relative area.
    Area,
    /// The area-load factor.
    Kappa,
    /// The area-load factor with the rms gradient of the actual contact.
    KappaR,
}

impl Question {
    /// What is asked.
    fn question(&self) -> &Words {
        match self {
            Self::Choose { question, .. } | Self::Number { question, .. } | Self::Draw { question, .. } => question,
        }
    }

    /// Refuses a question that has no words or no answer.
    ///
    /// # Errors
    /// A sentence with what cannot be.
    pub(super) fn check(&self, sweeps: bool) -> Result<(), Refusal> {
        self.question().check()?;
        let refuse = |sentence: String| Err(Refusal(sentence));
        match self {
            Self::Choose { choices, .. } if !(2..=6).contains(&choices.len()) => {
                refuse(format!("{} choices are given: give two to six", choices.len()))
            }
            Self::Choose { choices, right, .. } if !(1..=choices.len()).contains(right) => {
                refuse(format!("choice {right} is to be right, but there are {}: count them from 1 on", choices.len()))
            }
            Self::Choose { choices, .. } => choices.iter().try_for_each(Words::check),
            Self::Number { of, .. } if !OBSERVABLES.iter().any(|it| it.name == of) => {
                refuse(format!("{of:?} is no number of a run: give one such as \"kappa_r_resolved\""))
            }
            Self::Draw { .. } if !sweeps => {
                refuse("a curve is asked for, but the load is not swept: give sweep = true".into())
            }
            Self::Number { .. } | Self::Draw { .. } => Ok(()),
        }
    }
}
