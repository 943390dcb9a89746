//! Lessons: what the page shows step by step, and what it asks before.

use super::knobs::{Knobs, Start};
use super::refusal::Refusal;
use crate::contact::OBSERVABLES;
use crate::error::FileError;
use serde::{Deserialize, Serialize};
use std::ops::Range;
use std::path::{Path, PathBuf};
use toml::Spanned;

/// The most lessons of a folder, and the longest one.
const MOST_LESSONS: usize = 64;
const MOST_BYTES: u64 = 1 << 18;

/// The lessons that the page has of its own: names and texts.
const LESSONS: [(&str, &str); 3] = [
    ("hertz-and-rough.toml", include_str!("../../assets/lessons/hertz-and-rough.toml")),
    ("below.toml", include_str!("../../assets/lessons/below.toml")),
    ("crawl.toml", include_str!("../../assets/lessons/crawl.toml")),
];

/// A lesson.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Lesson {
    /// Its name in the list.
    pub title: String,
    /// Its steps, one at least.
    pub steps: Vec<LessonStep>,
}

/// A step of a lesson: a state of the knobs, and what there is to see.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LessonStep {
    /// What there is to see, told with the answer where something is asked.
    pub text: String,
    /// The state of the knobs.
    pub knobs: Knobs,
    /// Whether the load is swept.
    pub sweep: bool,
    /// What is asked before anything is shown.
    pub ask: Option<Question>,
}

/// A question to which one answers by a guess.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Question {
    /// One of some answers.
    Choose {
        /// The question.
        question: String,
        /// The answers.
        choices: Vec<String>,
        /// Which of them is right, from 1 on.
        right: usize,
    },
    /// A number that the run will tell.
    Number {
        /// The question.
        question: String,
        /// The observable that answers it, such as `kappa_r_resolved`.
        of: String,
    },
    /// A curve against the load, which a sweep will draw beside the guess.
    Draw {
        /// The question.
        question: String,
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

/// A lesson as it is written: the knobs of a step are laid over those of the lesson, and these over those that the page starts with.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Draft {
    title: String,
    #[serde(default)]
    knobs: toml::Table,
    step: Vec<Spanned<DraftStep>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct DraftStep {
    text: String,
    #[serde(default)]
    knobs: toml::Table,
    #[serde(default)]
    sweep: bool,
    ask: Option<Question>,
}

impl Lesson {
    /// The lessons that the page has of its own.
    pub fn all() -> Vec<Self> {
        let lesson = |(name, text): &(&str, &str)| Self::read(name, text).expect("the lessons of the page are right");
        LESSONS.iter().map(lesson).collect()
    }

    /// The lessons of a folder, one in each file that ends in `.toml`, by their names.
    ///
    /// # Errors
    /// For a folder that cannot be read or has no lesson, and for a lesson that is none, with its line.
    pub fn folder(folder: &Path) -> Result<Vec<Self>, Refusal> {
        let unreadable = |source| FileError::Read { path: folder.into(), source };
        let entries: Result<Vec<PathBuf>, _> =
            std::fs::read_dir(folder).map_err(unreadable)?.map(|entry| entry.map(|it| it.path())).collect();
        let mut files = entries.map_err(unreadable)?;
        files.retain(|path| path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml")));
        files.sort();
        match files.len() {
            0 => Err(Refusal(format!(
                "no lessons are in {}: give a folder with files that end in .toml",
                folder.display()
            ))),
            1..=MOST_LESSONS => files.iter().map(|path| Self::of_file(path)).collect(),
            count => Err(Refusal(format!("{count} lessons are in {}: give at most {MOST_LESSONS}", folder.display()))),
        }
    }

    fn of_file(path: &Path) -> Result<Self, Refusal> {
        let unreadable = |source| FileError::Read { path: path.into(), source };
        let length = std::fs::metadata(path).map_err(unreadable)?.len();
        if length > MOST_BYTES {
            let name = path.display();
            return Err(Refusal(format!(
                "{name} has {length} bytes, more than a lesson may have: give at most {MOST_BYTES}"
            )));
        }
        Self::read(&path.display().to_string(), &std::fs::read_to_string(path).map_err(unreadable)?)
    }

    /// The lesson that a text holds, of the file `name`.
    fn read(name: &str, text: &str) -> Result<Self, Refusal> {
        let at = |span: Option<Range<usize>>, reason: &str| {
            let line = span.map_or(1, |span| 1 + text[..span.start.min(text.len())].matches('\n').count());
            Refusal(format!("{name}, line {line}: {}", reason.lines().collect::<Vec<_>>().join(" ")))
        };
        let draft: Draft = toml::from_str(text).map_err(|error| at(error.span(), error.message()))?;
        if draft.step.is_empty() {
            return Err(at(None, "the lesson has no steps: give one at least, as [[step]]"));
        }
        let step = |step: Spanned<DraftStep>| {
            let span = step.span();
            LessonStep::of(&draft.knobs, step.into_inner()).map_err(|Refusal(reason)| at(Some(span), &reason))
        };
        let steps = draft.step.into_iter().map(step).collect::<Result<_, _>>()?;
        Ok(Self { title: draft.title, steps })
    }
}

impl LessonStep {
    fn of(common: &toml::Table, draft: DraftStep) -> Result<Self, Refusal> {
        let DraftStep { text, knobs, sweep, ask } = draft;
        let wrong = |error: serde_json::Error| Refusal(format!("knobs: {error}"));
        let mut values = serde_json::to_value(Start::RoughLine.knobs()).map_err(wrong)?;
        for (key, value) in common.iter().chain(&knobs) {
            values[key] = serde_json::to_value(value).map_err(wrong)?;
        }
        let knobs: Knobs = serde_json::from_value(values).map_err(wrong)?;
        knobs.setup()?;
        ask.iter().try_for_each(|ask| ask.check(sweep))?;
        Ok(Self { text, knobs, sweep, ask })
    }
}

impl Question {
    /// Refuses a question that has no answer.
    fn check(&self, sweeps: bool) -> Result<(), Refusal> {
        let refuse = |sentence: String| Err(Refusal(sentence));
        match self {
            Self::Choose { choices, .. } if !(2..=6).contains(&choices.len()) => {
                refuse(format!("{} choices are given: give two to six", choices.len()))
            }
            Self::Choose { choices, right, .. } if !(1..=choices.len()).contains(right) => {
                refuse(format!("choice {right} is to be right, but there are {}: count them from 1 on", choices.len()))
            }
            Self::Number { of, .. } if !OBSERVABLES.iter().any(|it| it.name == of) => {
                refuse(format!("{of:?} is no number of a run: give one such as \"kappa_r_resolved\""))
            }
            Self::Draw { .. } if !sweeps => {
                refuse("a curve is asked for, but the load is not swept: give sweep = true".into())
            }
            _ => Ok(()),
        }
    }
}
