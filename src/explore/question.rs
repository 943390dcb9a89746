//! Questions of lessons, which one answers by a guess or by what one does.

use super::leak::CONDUCTANCE;
use super::refusal::Refusal;
use super::words::Words;
use crate::contact::Quantity;
use serde::{Deserialize, Deserializer, Serialize};
use std::collections::BTreeMap;

/// A question of a step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Question {
    /// One of some answers.
    Choose {
        /// The question.
        question: Words,
        /// The answers.
        choices: Vec<Choice>,
        /// Which of them is right, from 1 on.
        right: usize,
    },
    /// A number that the run will show.
    Number {
        /// The question.
        question: Words,
        /// The observable that answers it, such as `kappa_r`.
        #[serde(deserialize_with = "current_name")]
        of: String,
    },
    /// A curve against the load, which a sweep will draw beside the guess.
    Draw {
        /// The question.
        question: Words,
        /// Which curve.
        curve: SweepCurve,
    },
    /// A contact to be made with the hand or the controls.
    Act {
        /// What is to be done.
        question: Words,
        /// When it is done.
        goal: Goal,
    },
}

/// A contact that is to be made: the least and the largest value of some observables, such as `relative_area`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(from = "BTreeMap<String, [f64; 2]>")]
pub struct Goal(BTreeMap<String, [f64; 2]>);

impl From<BTreeMap<String, [f64; 2]>> for Goal {
    fn from(ranges: BTreeMap<String, [f64; 2]>) -> Self {
        Self(ranges.into_iter().map(|(of, range)| (without_resolved(&of).to_owned(), range)).collect())
    }
}

/// The name of an observable as lessons give it.
fn current_name<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    Ok(without_resolved(&String::deserialize(deserializer)?).to_owned())
}

/// The name of an observable without the ending `_resolved` that it has in older lessons.
fn without_resolved(name: &str) -> &str {
    name.strip_suffix("_resolved").unwrap_or(name)
}

/// An answer to choose.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(from = "WrittenChoice")]
pub struct Choice {
    /// The answer.
    pub text: Words,
    /// Why it is wrong.
    pub because: Option<Words>,
}

/// A choice as it is written: an answer alone, or with why it is wrong.
#[derive(Deserialize)]
#[serde(
    untagged,
    deny_unknown_fields,
    expecting = "give a text, or { text = \"Twice\", because = \"why that is wrong\" }"
)]
enum WrittenChoice {
    Told { text: Words, because: Words },
    Plain(Words),
}

impl From<WrittenChoice> for Choice {
    fn from(written: WrittenChoice) -> Self {
        match written {
            WrittenChoice::Plain(text) => Self { text, because: None },
            WrittenChoice::Told { text, because } => Self { text, because: Some(because) },
        }
    }
}

impl Choice {
    fn check(&self) -> Result<(), Refusal> {
        self.text.check()?;
        self.because.iter().try_for_each(Words::check)
    }
}

impl Goal {
    /// Refuses a goal of no observable, and one that cannot be reached.
    pub(super) fn check(&self) -> Result<(), Refusal> {
        let refuse = |sentence: String| Err(Refusal::from(sentence));
        if self.0.is_empty() {
            return refuse("the goal is empty: give an observable with its least and largest value".into());
        }
        self.0.iter().try_for_each(|(of, [least, most])| {
            check_observable(of)?;
            if least <= most {
                return Ok(());
            }
            refuse(format!("the goal of {of} is from {least} to {most}: give the smaller value first"))
        })
    }
}

/// Refuses a name that no observable has.
fn check_observable(of: &str) -> Result<(), Refusal> {
    if of == CONDUCTANCE || Quantity::find(of).is_some() {
        return Ok(());
    }
    Err(format!("{of:?} is not a number of a run: give one such as \"kappa_r\"").into())
}

/// A curve of a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SweepCurve {
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
            Self::Choose { question, .. }
            | Self::Number { question, .. }
            | Self::Draw { question, .. }
            | Self::Act { question, .. } => question,
        }
    }

    /// Refuses a question that has no words or no answer.
    ///
    /// # Errors
    /// A sentence with what cannot be.
    pub(super) fn check(&self, sweeps: bool) -> Result<(), Refusal> {
        self.question().check()?;
        let refuse = |sentence: String| Err(Refusal::from(sentence));
        match self {
            Self::Choose { choices, .. } if !(2..=6).contains(&choices.len()) => {
                refuse(format!("{} choices are given: give two to six", choices.len()))
            }
            Self::Choose { choices, right, .. } if !(1..=choices.len()).contains(right) => refuse(format!(
                "choice {right} is marked as right, but there are {} choices: count from 1",
                choices.len()
            )),
            Self::Choose { choices, .. } => choices.iter().try_for_each(Choice::check),
            Self::Number { of, .. } => check_observable(of),
            Self::Act { .. } if sweeps => {
                refuse("a step with a goal cannot sweep the load: leave out sweep = true".into())
            }
            Self::Act { goal, .. } => goal.check(),
            Self::Draw { .. } if !sweeps => {
                refuse("a question about a curve needs a sweep of the load: give sweep = true".into())
            }
            Self::Draw { .. } => Ok(()),
        }
    }
}
