//! What does not go together in a setup, or is missing in it: one table.

use crate::sentence::{Sentence, Value, Worded};
use std::fmt::{self, Display, Formatter};
use strum::{EnumIter, EnumMessage, EnumProperty, IntoEnumIterator, IntoStaticStr};

/// A rule that a setup breaks. Its name in kebab case is its id, such as `sliding-without-creep`; ids are stable.
///
/// The message is what is wrong and what to do, with places such as `{speed:?}` for values that were given. The keys are the sections and keys
/// of a setup that the rule concerns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, EnumMessage, EnumProperty, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
#[rustfmt::skip]
pub enum ConflictRule {
    #[strum(props(keys = "surface.height surface.indenter.shape surface.spectrum.hurst"), message =
        "no surface is given: give a height file, an indenter or a spectrum (a Hurst exponent with its wavelengths)")]
    NoSurface,
    #[strum(props(keys = "load.mean-pressure load.reduced-pressure load.mean-gap"), message =
        "no load is given: give a mean pressure, a reduced pressure or a mean gap")]
    NoLoad,
    #[strum(props(keys = "grid.points"), message = "the points are missing: give one number for a line, two for a surface")]
    NoPoints,
    #[strum(props(keys = "grid.size"), message = "no size is given, and the file has none: give it")]
    NoSize,

    #[strum(props(keys = "surface.seed surface.spectrum"), message =
        "a seed is given without roughness: give a Hurst exponent with its wavelengths as well, or leave the seed out")]
    SeedWithoutSpectrum,
    #[strum(props(keys = "surface.second-spectrum surface.spectrum"), message =
        "a second spectrum is given without a first one: give `surface.spectrum` as well")]
    SecondSpectrum,
    #[strum(props(keys = "surface.joined surface.second-spectrum"), message =
        "`surface.joined` needs two spectra: give `surface.second-spectrum` as well, or leave it out")]
    JoinedWithoutSecond,
    #[strum(props(keys = "surface.prepare surface.channel surface.file-unit surface.height-unit surface.height"), message =
        "options for reading or preparing heights are given without a height file: give one, or leave them out")]
    PreparationWithoutHeights,

    #[strum(props(keys = "grid.points surface.height"), message =
        "points are given, but the height file has its own: leave the points out")]
    PointsOfFile,
    #[strum(props(keys = "grid.refine"), message = "the refinement is 0: give 1 or more, or auto")]
    NoRefinement,
    #[strum(props(keys = "grid.points"), message =
        "points are auto along some axes only: give auto for all axes, or a number for each")]
    SomePoints,
    #[strum(props(keys = "grid.points grid.refine surface.spectrum"), message =
        "points = auto works for a random rough surface only: give a spectrum, or give points and refine = auto")]
    PointsOfNothing,
    #[strum(props(keys = "grid.area-tolerance grid.refine grid.points"), message =
        "an area tolerance needs refine = auto or points = auto: give one of them, or leave the tolerance out")]
    ToleranceOfGrid,
    #[strum(props(keys = "grid.datum grid.boundary"), message =
        "a datum is given, but no axis is free: make the boundary free along one axis, or leave the datum out")]
    DatumOfPeriodic,
    #[strum(props(keys = "record.every"), message = "the recording interval is 0 steps: give a positive number of steps")]
    NoInterval,

    #[strum(props(keys = "adhesion viscoelastic sliding rolling path friction law.hardness solver.method solid.yield-stress"), message =
        "{drive} and {other} cannot be combined: leave one of them out")]
    NotTogether,
    #[strum(props(keys = "viscoelastic sliding rolling path friction"), message =
        "{drive} without {needed} cannot be solved: give both, or leave both out")]
    NotAlone,

    #[strum(props(keys = "friction.tangential path.tangential rolling.tangential rolling.creepage"), message =
        "the tangential load is {tangential:?}, but friction needs a positive one: give it, or a path of tangential loads, or rolling")]
    NoTangential,
    #[strum(props(keys = "friction.tangential law.hardness"), message =
        "a tangential load and a hardness are given, but partial slip is solved for elastic contacts only: leave one of them out")]
    FrictionOfYielding,

    #[strum(props(keys = "adhesion.table adhesion.work adhesion.range adhesion.form"), message =
        "a table is given beside a work, a range or a form of adhesion: give only one of both")]
    AdhesionTwice,
    #[strum(props(keys = "adhesion.work adhesion.table"), message =
        "adhesion needs a work of adhesion: give one, or a table")]
    AdhesionWithoutWork,
    #[strum(props(keys = "adhesion.range adhesion.table"), message =
        "adhesion needs the range of the attraction: give one, or a table")]
    AdhesionWithoutRange,
    #[strum(props(keys = "solver.method adhesion.method"), message =
        "adhesion has methods of its own: leave the solver gfmd out, and give gfmd as the method of the adhesion")]
    AdhesionByGfmd,

    #[strum(props(keys = "sliding.speed"), message = "sliding needs a speed: give one or more")]
    SlidingWithoutSpeed,
    #[strum(props(keys = "sliding.speed"), message = "the speed {speed:?} is given: give a positive, finite speed")]
    SlidingSpeed,
    #[strum(props(keys = "sliding.speed grid.boundary"), message =
        "sliding needs a periodic boundary: leave the boundary out")]
    SlidingOfFree,

    #[strum(props(keys = "rolling.creepage rolling.tangential"), message =
        "rolling needs either a creepage or a tangential load: give one of them, and not both")]
    RollingDrives,
    #[strum(props(keys = "rolling.creepage rolling.tangential"), message = "a value of rolling is {value:?}: give a finite one")]
    RollingValue,
    #[strum(props(keys = "rolling.step"), message = "the step of rolling is {step:?}: give a positive, finite length")]
    RollingStep,
    #[strum(props(keys = "rolling.step grid.size"), message =
        "the step of rolling is {step:?}, longer than the line of {length:?}: give a shorter one, such as the spacing of the grid, {spacing:?}")]
    RollingStepOfLine,
    #[strum(props(keys = "rolling grid.points"), message = "rolling is solved on lines only: give a line")]
    RollingOnSurface,

    #[strum(props(keys = "path"), message =
        "the path has no points: give times, loads or tangential loads, or leave the path out")]
    PathWithoutPoints,
    #[strum(props(keys = "path"), message = "the path has {points} points: give at most {most}")]
    PathTooLong,
    #[strum(props(keys = "path.time path.load path.tangential"), message =
        "the path has {times} times, {loads} loads and {tangentials} tangential loads: give one of each for every point, or leave a list out")]
    PathLengths,
    #[strum(props(keys = "path.time path.load path.tangential"), message = "a {quantity} of the path is {value:?}: give a finite value")]
    PathNotFinite,
    #[strum(props(keys = "path.time path.load"), message = "a {quantity} of the path is {value:?}: give a finite value, 0 or more")]
    PathNegative,
    #[strum(props(keys = "path.time"), message = "the path goes back from the time {before:?} to {time:?}: give ascending times")]
    PathBack,
    #[strum(props(keys = "path.steps"), message = "the path has 0 steps between two points: give 1 or more")]
    PathWithoutSteps,
    #[strum(props(keys = "path.time-tolerance"), message = "the tolerance in time is {tolerance:?}: give a value between 0 and 1")]
    TimeTolerance,
    #[strum(props(keys = "path.tolerance"), message = "the tolerance of the path is {tolerance:?}: give a value between 0 and 1")]
    PathTolerance,
    #[strum(props(keys = "path.file path.time path.load path.tangential"), message =
        "{quantity} is given by {file} and beside it: leave one of them out")]
    PathTwice,

    #[strum(props(keys = "viscoelastic.creep viscoelastic.relaxation"), message =
        "the solid has no terms: give creep or relaxation")]
    CreepWithoutTerms,
    #[strum(props(keys = "viscoelastic.creep viscoelastic.relaxation"), message =
        "both creep and relaxation are given: give one of them")]
    CreepTwice,
    #[strum(props(keys = "viscoelastic.creep viscoelastic.relaxation"), message =
        "the list of {form} has an odd number of values, {values}: give pairs of a ratio and a time")]
    CreepPairs,

    #[strum(props(keys = "solid.yield-stress solid.hardening-modulus"), message =
        "a yield stress is given without a hardening modulus: give one; a millionth of Young's modulus hardly differs from none")]
    YieldWithoutHardening,
    #[strum(props(keys = "solid.yield-stress solid.hardening-modulus solid.kinematic-hardening solid.yield-depth solid.yield-layers"), message =
        "hardening, or a depth or layers in which the body yields, are given without a yield stress: give it, or leave them out")]
    HardeningWithoutYield,
    #[strum(props(keys = "solid.yield-stress solid.layer"), message =
        "a yield stress and a layer are given, but the stress that a plastic strain leaves is known in a half-space only: leave one of them out")]
    YieldOfLayer,
    #[strum(props(keys = "solid.yield-stress solid.young"), message =
        "a yield stress and two elastic bodies are given, but flow is solved in one body against a rigid one: give one body")]
    YieldOfTwoBodies,
    #[strum(props(keys = "solid.yield-stress solid.young solid.poisson solid.contact-modulus"), message =
        "a yield stress needs Young's modulus and Poisson's ratio, since flow depends on both: give them, and no contact modulus or stiffness")]
    YieldWithoutConstants,
    #[strum(props(keys = "solid.yield-stress grid.boundary"), message =
        "a yield stress and a free boundary are given, but the stress that a plastic strain leaves is computed by waves, and so below a periodic \
         surface only: leave the boundary out")]
    YieldOfFree,
    #[strum(props(keys = "solid.yield-stress record.what"), message =
        "the recording parts stress and fringes show the stress of an elastic body, but this one yields, and the cut below it is among the \
         fields: leave these parts out")]
    YieldAndStress,
    #[strum(props(keys = "solid.yield-stress load"), message =
        "{load} is given, but a body that yields below its surface needs a mean pressure, a reduced pressure, a force or a mean gap")]
    YieldLoad,

    #[strum(props(keys = "path.tangential friction viscoelastic path.time load"), message =
        "the path has no tangential loads, and the solid does not creep: give tangential loads with friction, or creep and times, or \
         several loads instead of a path")]
    PathWithoutTangential,
    #[strum(props(keys = "load"), message = "{load} is given, but this needs a mean pressure, a reduced pressure or a force")]
    SlipLoad,
    #[strum(props(keys = "path.load"), message =
        "a normal load of the path is 0, which friction cannot follow: give positive loads")]
    SlipUnloaded,

    #[strum(props(keys = "solver.method"), message = "gfmd cannot solve histories: choose another solver")]
    HistoryByGfmd,
    #[strum(props(keys = "path sliding rolling adhesion solid.yield-stress"), message = "the setup has no history")]
    NoHistory,
}

impl ConflictRule {
    /// Its id, in kebab case.
    pub fn id(self) -> &'static str {
        self.into()
    }

    /// What is wrong and what to do, with the names of values in braces.
    pub fn sentence(self) -> &'static str {
        self.get_message().unwrap_or_default()
    }

    /// The sections and keys of a setup that it concerns.
    pub fn keys(self) -> impl Iterator<Item = &'static str> {
        self.get_str("keys").unwrap_or_default().split(' ')
    }

    /// The conflict of values that were given, by their names.
    pub fn with<const N: usize>(self, given: [(&'static str, Value); N]) -> Conflict {
        Conflict { rule: self, given: given.into() }
    }
}

/// What does not go together in a setup, is missing in it, or is outside of its range: a rule, and the values that break it.
///
/// ```
/// use asperity::error::ConflictRule;
/// let conflict = ConflictRule::SlidingSpeed.with([("speed", (-1.0).into())]);
/// assert_eq!(conflict.to_string(), "the speed -1.0 is given: give a positive, finite speed");
/// assert_eq!((conflict.rule.id(), conflict.rule.keys().next()), ("sliding-speed", Some("sliding.speed")));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Conflict {
    pub rule: ConflictRule,
    pub given: Vec<(&'static str, Value)>,
}

impl Display for Conflict {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.sentence().fmt(f)
    }
}

impl std::error::Error for Conflict {}

impl Worded for Conflict {
    fn sentence(&self) -> Sentence {
        Sentence::new(self.rule.sentence(), self.given.clone())
    }

    fn templates() -> Vec<&'static str> {
        ConflictRule::iter().map(ConflictRule::sentence).collect()
    }
}

impl From<ConflictRule> for Conflict {
    fn from(rule: ConflictRule) -> Self {
        rule.with([])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_rule_has_a_sentence_with_what_to_do_and_keys() {
        let sentences: BTreeSet<&str> = ConflictRule::iter().map(ConflictRule::sentence).collect();
        assert_eq!(sentences.len(), ConflictRule::iter().count(), "two rules have the same sentence");
        for rule in ConflictRule::iter() {
            let says_what_to_do = rule.sentence().contains(": ") || rule.sentence().contains(", but ");
            assert!(says_what_to_do || rule == ConflictRule::NoHistory, "{rule:?}");
            assert!(rule.keys().all(|key| !key.is_empty()), "{rule:?}");
        }
    }
}
