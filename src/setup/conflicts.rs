//! What no process can have: rules on the sections of a setup, one after the other.

use super::{LoadPath, Method, ProcessKind, Setup, Solid};
use crate::contact::Load;
use crate::error::{Conflict, ConflictRule, SetupError};
use crate::grid::Grid;

/// The names and values that break a rule.
type Given = Vec<(&'static str, String)>;

/// A rule, and whether a setup breaks it.
type SectionRule = (ConflictRule, fn(&Setup) -> bool);

/// A rule, and what of a setup with a process on a grid breaks it.
type ProcessRule = (ConflictRule, fn(&Setup, ProcessKind, &Grid) -> Option<Given>);

/// Sections that do not go together, or that lack something. Of several that are broken, the first is reported.
const OF_SECTIONS: &[SectionRule] = &[
    (ConflictRule::HardeningWithoutYield, |it| it.yield_law().is_some() && !it.yields()),
    (ConflictRule::YieldWithoutHardening, |it| {
        it.yields() && it.yield_law().is_some_and(|law| law.hardening_modulus.is_none())
    }),
    (ConflictRule::YieldOfLayer, |it| it.yields_on(|solid| matches!(solid, Solid::Layer { .. }))),
    (ConflictRule::YieldOfTwoBodies, |it| it.yields_on(|solid| matches!(solid, Solid::Bodies(_, Some(_))))),
    (ConflictRule::YieldWithoutConstants, |it| it.yields_on(|solid| !matches!(solid, Solid::Bodies(..)))),
    (ConflictRule::YieldAndHardness, |it| it.yields() && !it.law.is_hard_wall()),
    (ConflictRule::YieldAndAdhesion, |it| it.yields() && it.adhesion.is_some()),
    (ConflictRule::YieldAndCreep, |it| it.yields() && it.viscoelastic.is_some()),
    (ConflictRule::YieldAndMotion, |it| it.yields() && (it.sliding.is_some() || it.rolling.is_some())),
    (ConflictRule::YieldAndFriction, |it| {
        it.yields() && (it.friction.is_some() || it.has_path(|path| !path.tangential.is_empty()))
    }),
    (ConflictRule::YieldAndStress, |it| it.yields() && it.record.what.iter().any(|part| part.is_stress())),
    (ConflictRule::YieldInTime, |it| it.yields() && it.has_path(|path| !path.time.is_empty())),
    (ConflictRule::AdhesionAndCreep, |it| it.adhesion.is_some() && it.viscoelastic.is_some()),
    (ConflictRule::AdhesionAndFriction, |it| it.adhesion.is_some() && it.friction.is_some()),
    (ConflictRule::AdhesionAndSliding, |it| it.adhesion.is_some() && it.sliding.is_some()),
    (ConflictRule::AdhesionAndRolling, |it| it.adhesion.is_some() && it.rolling.is_some()),
    (ConflictRule::AdhesionAndHardness, |it| it.adhesion.is_some() && !it.law.is_hard_wall()),
    (ConflictRule::AdhesionPathWithoutPoints, |it| it.adhesion.is_some() && it.has_path(LoadPath::is_empty)),
    (ConflictRule::AdhesionPathOfMore, |it| {
        it.adhesion.is_some() && it.has_path(|path| !path.time.is_empty() || !path.tangential.is_empty())
    }),
    (ConflictRule::SlidingAndRolling, |it| it.sliding.is_some() && it.rolling.is_some()),
    (ConflictRule::MotionAndPath, |it| (it.sliding.is_some() || it.rolling.is_some()) && it.path.is_some()),
    (ConflictRule::SlidingWithoutCreep, |it| it.sliding.is_some() && it.viscoelastic.is_none()),
    (ConflictRule::RollingAndCreep, |it| it.rolling.is_some() && it.viscoelastic.is_some()),
    (ConflictRule::RollingWithoutFriction, |it| it.rolling.is_some() && it.friction.is_none()),
    (ConflictRule::PathWithoutPoints, |it| !it.yields() && it.has_path(LoadPath::is_empty)),
    (ConflictRule::CreepWithoutPath, |it| it.viscoelastic.is_some() && it.path.is_none() && it.sliding.is_none()),
    (ConflictRule::CreepWithoutTimes, |it| it.viscoelastic.is_some() && it.has_path(|path| path.time.is_empty())),
    (ConflictRule::CreepAndFriction, |it| {
        it.viscoelastic.is_some() && it.has_path(|path| !path.tangential.is_empty() || it.friction.is_some())
    }),
    (ConflictRule::PathWithoutTangential, |it| {
        let has_other = it.viscoelastic.is_some() || it.adhesion.is_some() || it.yields();
        !has_other && it.has_path(|path| path.tangential.is_empty())
    }),
    (ConflictRule::TangentialWithoutFriction, |it| {
        it.friction.is_none() && it.has_path(|path| !path.tangential.is_empty())
    }),
    (ConflictRule::SlipInTime, |it| it.viscoelastic.is_none() && it.has_path(|path| !path.time.is_empty())),
];

/// What a process cannot have beside it. Of several rules that are broken, the first is reported.
const OF_PROCESSES: &[ProcessRule] = &[
    (ConflictRule::TangentialOfHistory, |it, _, _| {
        let tangential = it.friction.map(|friction| friction.tangential).filter(|tangential| *tangential != 0.0)?;
        Some(vec![("tangential", format!("{tangential:?}"))])
    }),
    (ConflictRule::HistoryOfYielding, |it, kind, _| broken(!it.law.is_hard_wall() && !kind.row().takes_hardness)),
    (ConflictRule::AdhesionByGfmd, |it, kind, _| broken(kind == ProcessKind::Adhesion && it.is_by_gfmd())),
    (ConflictRule::HistoryByGfmd, |it, _, _| broken(it.is_by_gfmd())),
    (ConflictRule::AdhesionBySolver, |it, kind, _| it.other_solver().filter(|_| kind == ProcessKind::Adhesion)),
    (ConflictRule::YieldOfFree, |_, kind, grid| broken(kind == ProcessKind::Plastic && !grid.is_periodic())),
    (ConflictRule::YieldLoad, |it, kind, _| {
        let is_broken = kind == ProcessKind::Plastic && matches!(it.load, Load::Approach(_));
        is_broken.then(|| vec![("load", it.load.to_string())])
    }),
    (ConflictRule::SlidingOfFree, |_, kind, grid| broken(kind == ProcessKind::Sliding && !grid.is_periodic())),
    (ConflictRule::SlidingBySolver, |it, kind, _| it.other_solver().filter(|_| kind == ProcessKind::Sliding)),
    (ConflictRule::SlipLoad, |it, kind, _| {
        (kind.row().needs_pressure && !it.load.is_pressure()).then(|| vec![("load", it.load.to_string())])
    }),
    (ConflictRule::RollingBySolver, |it, kind, _| it.other_solver().filter(|_| kind == ProcessKind::Rolling)),
    (ConflictRule::RollingOnSurface, |_, kind, grid| broken(kind == ProcessKind::Rolling && !grid.is_line())),
    (ConflictRule::RollingStepOfLine, |it, _, grid| {
        let (length, spacing) = (grid.size()[1], grid.spacing()[1]);
        let step = it.rolling.as_ref()?.step.filter(|step| *step > length)?;
        Some(vec![
            ("step", format!("{step:?}")),
            ("length", format!("{length:?}")),
            ("spacing", format!("{spacing:?}")),
        ])
    }),
    (ConflictRule::SlipUnloaded, |it, kind, _| {
        broken(kind == ProcessKind::Slip && it.path_points().iter().any(|point| point.load.value() == 0.0))
    }),
];

/// A rule without values, where it is broken.
fn broken(is_broken: bool) -> Option<Given> {
    is_broken.then(Vec::new)
}

impl Setup {
    /// Refuses sections that do not go together, or that lack something.
    pub(super) fn check_together(&self) -> Result<(), SetupError> {
        match OF_SECTIONS.iter().find(|(_, is_broken)| is_broken(self)) {
            Some((rule, _)) => Err((*rule).into()),
            None => Ok(()),
        }
    }

    /// Refuses what a process cannot have beside it on a grid.
    pub(super) fn check_beside(&self, process: ProcessKind, grid: &Grid) -> Result<(), SetupError> {
        let broken = |(rule, of): &ProcessRule| Some(Conflict { rule: *rule, given: of(self, process, grid)? });
        OF_PROCESSES.iter().find_map(broken).map_or(Ok(()), |conflict| Err(conflict.into()))
    }

    fn yields_on(&self, is_so: impl Fn(&Solid) -> bool) -> bool {
        self.yields() && self.solid.as_ref().is_some_and(|solid| is_so(solid.as_elastic()))
    }

    fn has_path(&self, is_so: impl Fn(&LoadPath) -> bool) -> bool {
        self.path.as_ref().is_some_and(is_so)
    }

    fn is_by_gfmd(&self) -> bool {
        matches!(self.solver, Method::Gfmd(_))
    }

    /// The solver, if it is not the usual one.
    fn other_solver(&self) -> Option<Given> {
        (self.solver != Method::default()).then(|| vec![("solver", self.solver.name().into())])
    }
}

#[cfg(test)]
mod tests {
    use crate::error::ConflictRule;
    use crate::setup::KEYS;
    use strum::IntoEnumIterator;

    #[test]
    fn rules_concern_sections_and_keys_of_setups() {
        for rule in ConflictRule::iter() {
            for key in rule.keys() {
                let is_in =
                    |path: &str| path == key || path.strip_prefix(key).is_some_and(|rest| rest.starts_with('.'));
                assert!(KEYS.iter().any(|key| is_in(key.path)), "{rule:?}: {key}");
            }
        }
    }
}
