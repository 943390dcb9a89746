//! Refusals of the page.

use crate::error::{Conflict, FileError, ProblemError, SetupError, SurfaceError};
use crate::sentence::{Sentence, Value, Worded, sentence};
use serde::Serialize;
use std::collections::BTreeMap;
use strum::{EnumIter, EnumMessage, IntoStaticStr};

/// What the page refuses by itself. The name of a rule in kebab case is its id; the message is what is wrong and what to do, with places for the
/// values that were given.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, EnumMessage, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
#[allow(missing_docs, reason = "the message of a rule speaks for itself")]
#[rustfmt::skip]
pub enum RefusalRule {
    #[strum(message = "`{knob}` cannot be {value}: give a number from {least} to {most}")]
    KnobRange,
    #[strum(message = "`{knob}` cannot be {value}: give a whole number from {least} to {most}")]
    KnobRangeOfWhole,
    #[strum(message = "`points` cannot be {value} for a surface: give at most {most} along each side")]
    SurfacePoints,
    #[strum(message = "`cutoff` cannot be {value}: give more than `rolloff`, which is {rolloff}")]
    CutoffOfRolloff,
    #[strum(message = "`cutoff` cannot be {value}: give at most half of `points`, which is {points}")]
    CutoffOfPoints,
    #[strum(message = "{bumps} bumps are too many: give at most {most}")]
    Bumps,
    #[strum(message = "a flat without roughness touches everywhere: raise the roughness or choose another body")]
    SmoothFlat,
    #[strum(message = "the scene of this state is not loaded: start asperity explore with its setup file")]
    NoScene,
    #[strum(message = "the page shows one contact, or one history: give a scene with one speed of sliding, and without a path with adhesion")]
    SceneNotShown,
    #[strum(message = "a surface that is shown beside another one cannot have one beside it: leave out the inner \"beside\"")]
    BesideTwice,
    #[strum(message = "a line cannot be pressed beside a surface: choose two lines or two surfaces")]
    LineBesideSurface,
    #[strum(message = "adhesion is solved for elastic contacts at rest: set the hardness, the speed and the time to 0, or the work of adhesion")]
    AdhesionNotElastic,
    #[strum(message = "adhesion has methods of its own: choose the multilevel method, or set the work of adhesion to 0")]
    AdhesionOfMethod,
    #[strum(message = "a surface cannot slide over a solid that yields here: set the hardness or the speed to 0")]
    SlidingOfYielding,
    #[strum(message = "a surface with a free boundary cannot slide here: choose the periodic boundary, or set the speed to 0")]
    SlidingOfFreeBoundary,
    #[strum(message = "GFMD solves elastic contacts only: choose another method, or set the creep to 0")]
    CreepByGfmd,
    #[strum(message = "friction is solved for elastic contacts without adhesion: set the hardness, the creep and the work of adhesion to 0, or the tangential load")]
    FrictionNotElastic,
    #[strum(message = "GFMD solves contacts without friction only: choose another method, or set the tangential load to 0")]
    FrictionByGfmd,
    #[strum(message = "{points} points are too many where the solid yields below its surface: give at most {most}, or set the yield stress to 0")]
    YieldPoints,
    #[strum(message = "the load of a contact with {drive} cannot be swept: leave that out")]
    SweepOfHistory,
    #[strum(message = "a contact with {drive} cannot be dragged: leave that out")]
    DragOfHistory,
    #[strum(message = "there is no file of heights: drop one on the page, or open it")]
    NoHeights,
    #[strum(message = "there is no file of heights to describe: drop one on the page, or open it")]
    NoHeightsToDescribe,
    #[strum(message = "this file was replaced by another file, {name}: drop this file again")]
    HeightsReplaced,
    #[strum(message = "give a length above 0, such as 10 um")]
    NotALength,
    #[strum(message = "{ny} x {nx} points are too many here: crop the heights to at most {most} points, and note that mirroring doubles them")]
    HeightPoints,
    #[strum(message = "a viewer cannot have {width} x {height} points: give lengths from 1 to 100000")]
    ViewerSize,
    #[strum(message = "there is no recording {name} to pin: choose one of the latest {most}")]
    NoRecordingToPin,
    #[strum(message = "there is no {name} here: choose one of {known}")]
    UnknownName,
    #[strum(message = "{value} is not possible: give {wanted}")]
    WrongValue,
    #[strum(message = "{most} tabs are open, which is the limit of this server: close one of them, and this page continues")]
    ServerFull,
    #[strum(message = "this session has ended: reload the page for a new one")]
    SessionEnded,
    #[strum(message = "{run} is still running: wait for its end, or cancel it")]
    RunGoesOn,
    #[strum(message = "another file is being sent: wait until it has arrived, and send this one again")]
    OtherFileComes,
    #[strum(message = "the request is too large: send at most {most} bytes")]
    RequestTooLarge,
    #[strum(message = "the request did not arrive in time")]
    RequestTooLate,
    #[strum(message = "the request could not be answered")]
    NoAnswer,
}

impl RefusalRule {
    /// Its id, in kebab case.
    pub fn id(self) -> &'static str {
        self.into()
    }

    /// What is wrong and what to do, with the names of values in braces.
    pub fn sentence(self) -> &'static str {
        self.get_message().unwrap_or_default()
    }

    /// The refusal of values that were given, by the names of their places.
    pub fn with<T: Into<Sentence>, const N: usize>(self, given: [(&'static str, T); N]) -> Refusal {
        let places = BTreeMap::from(given.map(|(name, value)| (name, value.into())));
        let values = places.iter().map(|(name, value)| (*name, value.into())).collect();
        let sentence = Sentence::new(self.sentence(), values);
        Refusal { sentence, known: Some(KnownFault { key: self.id(), places }) }
    }
}

/// A fault that the page has a text for, by the id of the fault, with the values in the places of the text.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct KnownFault {
    /// The id of a [`RefusalRule`], of a [`ConflictRule`](crate::error::ConflictRule), or of one of the errors that the page words in its own way.
    pub key: &'static str,
    /// The values, by the names of their places.
    pub places: BTreeMap<&'static str, Sentence>,
}

/// The refusal of an invalid request: one sentence, and the same as data where the page has a text for it.
#[derive(Debug, Clone, PartialEq, Serialize, thiserror::Error)]
#[error("{sentence}")]
pub struct Refusal {
    /// What is wrong and what to do.
    pub sentence: Sentence,
    /// The same as data.
    #[serde(flatten)]
    pub known: Option<KnownFault>,
}

/// Ids of errors of setups that are no conflicts, for which the page has texts.
pub const KNOWN_ERRORS: [&str; 3] = ["uneven", "voids", "unit-of-file"];

impl Refusal {
    /// Its JSON: `{"sentence": ..., "key": ..., "places": ...}`, the last two where the page has a text for it.
    pub fn to_json(&self) -> Vec<u8> {
        serde_json::to_vec(self).expect("texts have a form in JSON")
    }
}

impl KnownFault {
    /// The fault of an error of a setup, if the page has a text for it.
    pub fn from_setup(error: &SetupError) -> Option<Self> {
        let [uneven, voids_of, unit_of_file] = KNOWN_ERRORS;
        Some(match error {
            SetupError::Conflict(Conflict { rule, given }) => {
                let text = |(name, value): &(&'static str, Value)| (*name, value.to_string().into());
                Self { key: rule.id(), places: given.iter().map(text).collect() }
            }
            SetupError::Uneven { path } => {
                Self { key: uneven, places: [("file", path.display().to_string().into())].into() }
            }
            SetupError::Voids { path, voids, points } => {
                let counts = [("voids", voids.to_string()), ("points", points.to_string())];
                let places = counts.into_iter().chain([("file", path.display().to_string())]);
                Self { key: voids_of, places: places.map(|(name, value)| (name, value.into())).collect() }
            }
            SetupError::UnitOfFile { unit } => {
                Self { key: unit_of_file, places: [("unit", format!("{unit:?}").into())].into() }
            }
            _ => return None,
        })
    }
}

impl From<Sentence> for Refusal {
    fn from(sentence: Sentence) -> Self {
        Self { sentence, known: None }
    }
}

impl From<String> for Refusal {
    fn from(sentence: String) -> Self {
        Sentence::from(sentence).into()
    }
}

impl From<&str> for Refusal {
    fn from(sentence: &str) -> Self {
        Sentence::from(sentence).into()
    }
}

impl From<RefusalRule> for Refusal {
    fn from(rule: RefusalRule) -> Self {
        rule.with::<Sentence, 0>([])
    }
}

impl From<SetupError> for Refusal {
    fn from(error: SetupError) -> Self {
        Self { sentence: error.sentence(), known: KnownFault::from_setup(&error) }
    }
}

impl From<FileError> for Refusal {
    fn from(error: FileError) -> Self {
        error.sentence().into()
    }
}

impl From<ProblemError> for Refusal {
    fn from(error: ProblemError) -> Self {
        error.sentence().into()
    }
}

impl From<SurfaceError> for Refusal {
    fn from(error: SurfaceError) -> Self {
        error.sentence().into()
    }
}

/// The fault of a JSON text, in words of the page: names of Rust types are replaced by the values that they accept.
impl From<serde_json::Error> for Refusal {
    fn from(error: serde_json::Error) -> Self {
        let said = error.to_string();
        let said = said.rsplit_once(" at line ").map_or(said.as_str(), |(said, _)| said);
        if let Some((name, known)) =
            said.strip_prefix("unknown field ").and_then(|it| it.split_once(", expected one of "))
        {
            return RefusalRule::UnknownName.with([("name", name), ("known", known)]);
        }
        let is_value = said.starts_with("invalid value: ") || said.starts_with("invalid type: ");
        let Some((found, wanted)) = said.split_once(", expected ").filter(|_| is_value) else { return said.into() };
        let value = found.split_once(": ").map_or(found, |(_, value)| value).replace('`', "");
        let kind = ["integer ", "floating point ", "string "].into_iter().find(|kind| value.starts_with(kind));
        let value = kind.map_or(value.as_str(), |kind| &value[kind.len()..]);
        let wanted = if wanted.starts_with("struct ") { "a map" } else { wanted };
        let wanted = WANTED.iter().find(|(rust, _)| *rust == wanted).map_or(wanted, |(_, words)| words);
        RefusalRule::WrongValue.with([("value", value.into()), ("wanted", wanted_in_words(wanted))])
    }
}

/// What is wanted: words of ours, or those of a quantity with an example of its unit.
fn wanted_in_words(wanted: &str) -> Sentence {
    match wanted.split_once(": a number, or one with a unit such as ") {
        Some((kind, example)) => {
            sentence!("{kind}: a number, or one with a unit such as {example}", kind, example)
        }
        None => wanted.into(),
    }
}

/// Types in Rust, and what they take.
const WANTED: [(&str, &str); 5] = [
    ("u32", "a whole number from 0 to 4294967295"),
    ("usize", "a whole number, not negative"),
    ("f64", "a number"),
    ("a sequence", "a list"),
    ("a map", "a table"),
];
