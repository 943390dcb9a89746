//! Lessons: states that the page shows step by step, and questions before them.

use super::knobs::{Knobs, Start};
use super::point::check_points;
use super::question::{Goal, Question};
use super::refusal::{Refusal, RefusalRule};
use super::top::TopMap;
use super::words::Words;
use crate::error::FileError;
use crate::files::open_regular;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;
use std::io::Read;
use std::ops::Range;
use std::path::{Path, PathBuf};
use toml::Spanned;

/// The most lessons of a folder, and the longest one.
const MOST_LESSONS: usize = 64;
const MOST_BYTES: u64 = 1 << 18;
/// The largest number of states that users can choose in one step.
const MOST_STATES: usize = 64;

/// The lessons that the page has of its own: names and texts.
const LESSONS: [(&str, &str); 13] = [
    ("hertz-and-rough.toml", include_str!("../../assets/lessons/hertz-and-rough.toml")),
    ("kappa-r.toml", include_str!("../../assets/lessons/kappa-r.toml")),
    ("counting.toml", include_str!("../../assets/lessons/counting.toml")),
    ("coating.toml", include_str!("../../assets/lessons/coating.toml")),
    ("yield.toml", include_str!("../../assets/lessons/yield.toml")),
    ("dent.toml", include_str!("../../assets/lessons/dent.toml")),
    ("honing.toml", include_str!("../../assets/lessons/honing.toml")),
    ("crawl.toml", include_str!("../../assets/lessons/crawl.toml")),
    ("fretting.toml", include_str!("../../assets/lessons/fretting.toml")),
    ("grip.toml", include_str!("../../assets/lessons/grip.toml")),
    ("gecko.toml", include_str!("../../assets/lessons/gecko.toml")),
    ("seal.toml", include_str!("../../assets/lessons/seal.toml")),
    ("conductance.toml", include_str!("../../assets/lessons/conductance.toml")),
];

/// Knobs as they are written, with where each of them stands in its file.
type WrittenKnobs = BTreeMap<String, Spanned<Value>>;
/// Why a step is refused, and where that stands in its file if it is not about the whole step.
type Misplaced = (Option<Range<usize>>, Refusal);
/// Values that users can choose, by the names of the knobs.
type Turns = BTreeMap<String, Spanned<Vec<Value>>>;

/// A lesson.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Lesson {
    /// Its name in links: that of its file, without the ending.
    pub name: String,
    /// Its name in the list.
    pub title: Words,
    /// Its steps, one at least.
    pub steps: Vec<LessonStep>,
    /// Whether the picture shows the stress below.
    pub stress: bool,
    /// The text after the last step.
    pub end: Option<End>,
}

/// The end of a lesson.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct End {
    /// What one has seen.
    pub seen: Words,
    /// Something to do by oneself, with all controls free.
    pub challenge: Option<Challenge>,
}

/// Something to do, and when it is done.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Challenge {
    /// What is to be done.
    pub text: Words,
    /// When it is done.
    pub goal: Goal,
}

impl End {
    fn check(&self) -> Result<(), Refusal> {
        self.seen.check()?;
        self.challenge.iter().try_for_each(|it| it.text.check().and_then(|()| it.goal.check()))
    }
}

/// A step of a lesson: a state of the knobs, and its explanation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LessonStep {
    /// The explanation of the step; after a question it is shown with the answer.
    pub text: Words,
    /// The state of the knobs.
    pub knobs: Knobs,
    /// All states that users can choose: first that of the step, then all combinations of the allowed values.
    #[serde(skip)]
    states: Vec<Knobs>,
    /// The map that is shown of a surface; none to leave the one that a user has chosen.
    pub show: Option<TopMap>,
    /// Whether the load is swept.
    pub sweep: bool,
    /// The question before the step is shown.
    pub ask: Option<Question>,
    /// The state that is shown to those who do not find what a question asks them to make.
    pub solution: Option<Knobs>,
}

/// A lesson as it is written. The knobs of a step override those of the lesson, and these override the initial ones of
/// the page. The same holds for the values that users can choose.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct WrittenLesson {
    title: Words,
    #[serde(default)]
    knobs: WrittenKnobs,
    #[serde(default)]
    turn: Turns,
    show: Option<TopMap>,
    #[serde(default)]
    stress: bool,
    end: Option<Spanned<End>>,
    step: Vec<Spanned<DraftStep>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct DraftStep {
    text: Words,
    #[serde(default)]
    knobs: WrittenKnobs,
    #[serde(default)]
    turn: Turns,
    show: Option<Spanned<TopMap>>,
    #[serde(default)]
    sweep: bool,
    ask: Option<Spanned<Question>>,
    #[serde(default)]
    solution: WrittenKnobs,
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
    /// For a folder that cannot be read or has no lesson, and for an invalid lesson, with the line of the
    /// error.
    pub fn folder(folder: &Path) -> Result<Vec<Self>, Refusal> {
        let unreadable = |source| FileError::Read { path: folder.into(), source };
        let entries: Result<Vec<PathBuf>, _> =
            std::fs::read_dir(folder).map_err(unreadable)?.map(|entry| entry.map(|it| it.path())).collect();
        let mut files = entries.map_err(unreadable)?;
        files.retain(|path| path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml")));
        files.sort();
        match files.len() {
            0 => Err(Refusal::from(format!(
                "no lessons are in {}: give a folder with files that end in .toml",
                folder.display()
            ))),
            1..=MOST_LESSONS => files.iter().map(|path| Self::from_file(path)).collect(),
            count => {
                Err(Refusal::from(format!("{count} lessons are in {}: give at most {MOST_LESSONS}", folder.display())))
            }
        }
    }

    fn from_file(path: &Path) -> Result<Self, Refusal> {
        let unreadable = |source| FileError::Read { path: path.into(), source };
        let file = open_regular(path).map_err(unreadable)?;
        let length = file.metadata().map_err(unreadable)?.len();
        if length > MOST_BYTES {
            let name = path.display();
            return Err(Refusal::from(format!(
                "{name} has {length} bytes, more than a lesson may have: give at most {MOST_BYTES}"
            )));
        }
        let mut text = String::new();
        file.take(MOST_BYTES).read_to_string(&mut text).map_err(unreadable)?;
        Self::read(&path.display().to_string(), &text)
    }

    /// The lesson that a text holds, of the file `name`.
    fn read(name: &str, text: &str) -> Result<Self, Refusal> {
        let at = |span: Option<Range<usize>>, reason: &str| {
            let line = span.map_or(1, |span| 1 + text[..span.start.min(text.len())].matches('\n').count());
            Refusal::from(format!("{name}, line {line}: {}", reason.lines().collect::<Vec<_>>().join(" ")))
        };
        let draft: WrittenLesson = toml::from_str(text).map_err(|error| at(error.span(), error.message()))?;
        draft.title.check().map_err(|refusal| at(None, &format!("title: {refusal}")))?;
        if draft.step.is_empty() {
            return Err(at(None, "the lesson has no steps: give at least one, as [[step]]"));
        }
        check_points(text).map_err(|(place, refusal)| at(Some(place), &refusal.sentence.to_string()))?;
        let step = |step: Spanned<DraftStep>| {
            let span = step.span();
            LessonStep::new(&draft.knobs, &draft.turn, draft.show, step.into_inner())
                .map_err(|(place, refusal)| at(Some(place.unwrap_or(span)), &refusal.sentence.to_string()))
        };
        let steps = draft.step.into_iter().map(step).collect::<Result<_, _>>()?;
        let end = draft.end.map(|end| (end.span(), end.into_inner()));
        if let Some((span, end)) = &end {
            end.check().map_err(|refusal| at(Some(span.clone()), &format!("end: {refusal}")))?;
        }
        let stem = Path::new(name).file_stem().map_or_else(|| name.into(), |stem| stem.to_string_lossy());
        Ok(Self {
            name: stem.into_owned(),
            title: draft.title,
            steps,
            stress: draft.stress,
            end: end.map(|(_, end)| end),
        })
    }
}

impl LessonStep {
    fn new(
        common: &WrittenKnobs,
        turns: &Turns,
        common_map: Option<TopMap>,
        draft: DraftStep,
    ) -> Result<Self, Misplaced> {
        let DraftStep { text, knobs: own, turn, show, sweep, ask, solution } = draft;
        let written = || common.iter().chain(&own);
        let knobs = laid_over(&written().collect::<Vec<_>>())?;
        text.check().map_err(|refusal| (None, refusal))?;
        if let Some(ask) = &ask {
            ask.as_ref().check(sweep).map_err(|refusal| (Some(ask.span()), refusal))?;
        }
        if let Some(show) = show.as_ref().filter(|_| knobs.is_line()) {
            let reason = "a line has no map: leave out `show`, or give domain = \"surface\"";
            return Err((Some(show.span()), reason.into()));
        }
        let show = show.map(Spanned::into_inner).or(common_map).filter(|_| !knobs.is_line());
        let ask = ask.map(Spanned::into_inner);
        let solution = match solution.values().next() {
            None => None,
            Some(first) if !matches!(ask, Some(Question::Act { .. })) => {
                let reason = "a solution is for a question of the kind \"act\": leave it out";
                return Err((Some(first.span()), reason.into()));
            }
            Some(_) => Some(laid_over(&written().chain(&solution).collect::<Vec<_>>())?),
        };
        let turn: Turns = turns.clone().into_iter().chain(turn).collect();
        let states = distinct(turned(&knobs, &turn)?.into_iter().chain(solution.clone()).collect());
        Ok(Self { text, knobs, states, show, sweep, ask, solution })
    }

    /// All states of the knobs that a class may turn to from this step, its own first.
    pub fn states(&self) -> &[Knobs] {
        &self.states
    }
}

/// The knobs that the page starts with, with others laid over them.
///
/// # Errors
/// A refusal with the place of the knob that causes it: the first knob with which the refusal appears.
fn laid_over(written: &[(&String, &Spanned<Value>)]) -> Result<Knobs, Misplaced> {
    let refused = match knobs_of(written) {
        Ok(knobs) => return Ok(knobs),
        Err(refused) => refused,
    };
    let says = |count: &usize| knobs_of(&written[..*count]).is_err_and(|it| it == refused);
    let Some(count) = (1..=written.len()).find(says) else { return Err((None, refused)) };
    let (key, value) = written[count - 1];
    Err((Some(value.span()), named(key, value.as_ref(), refused)))
}

/// A refusal that names the knob as it is written.
fn named(key: &str, value: &Value, refusal: Refusal) -> Refusal {
    let reason = refusal.sentence.to_string();
    let is_named = reason.contains(&format!("`{key}`")) || reason.contains(&format!("`{key}."));
    let written = value.to_string();
    let of_value = refusal.known.as_ref().filter(|it| it.key == RefusalRule::WrongValue.id());
    match of_value.map(|it| &it.places).filter(|places| places["value"].to_string() == written) {
        Some(places) => format!("`{key}` cannot be {value}: give {}", places["wanted"]).into(),
        None if is_named => refusal,
        None => format!("`{key} = {value}`: {reason}").into(),
    }
}

fn knobs_of(written: &[(&String, &Spanned<Value>)]) -> Result<Knobs, Refusal> {
    let parts = written.iter().map(|(key, value)| (String::clone(key), Value::clone(value.as_ref())));
    let knobs = Start::RoughLine.knobs().with(parts)?;
    knobs.setup()?;
    Ok(knobs)
}

/// The states that knobs have when each of some is turned to each of its values, from the knobs as they are on.
///
/// # Errors
/// A sentence with the place of the values among which one cannot be.
fn turned(knobs: &Knobs, turn: &Turns) -> Result<Vec<Knobs>, Misplaced> {
    let mut states = vec![knobs.clone()];
    for (key, values) in turn {
        let misplaced = |refusal: Refusal| (Some(values.span()), Refusal::from(format!("turn: {refusal}")));
        let mut further = Vec::new();
        for value in values.as_ref() {
            for state in &states {
                further.push(with(state, key, value).map_err(|refused| misplaced(named(key, value, refused)))?);
            }
        }
        states.extend(further);
        states = distinct(states);
        if states.len() > MOST_STATES {
            let reason = format!("the values give more than {MOST_STATES} states: give fewer values");
            return Err(misplaced(reason.into()));
        }
    }
    Ok(states)
}

/// Knobs with one of them turned.
fn with(knobs: &Knobs, key: &str, value: &Value) -> Result<Knobs, Refusal> {
    let turned = knobs.with([(key.into(), value.clone())])?;
    turned.setup()?;
    Ok(turned)
}

/// States without those that are the same as one before.
fn distinct(states: Vec<Knobs>) -> Vec<Knobs> {
    states.into_iter().fold(Vec::new(), |mut kept, state| {
        if !kept.contains(&state) {
            kept.push(state);
        }
        kept
    })
}
