//! What the knobs describe beside one elastic contact at rest: sliding, creep in time, and adhesion.

use super::Knobs;
use crate::explore::refusal::{Refusal, RefusalRule};
use crate::explore::scale::{MODULUS, RETARDATION_TIME};
use crate::grid::Grid;
use crate::setup::{Adhesion, LoadPath, Method, RollingMotion};

/// Steps from one tangential load of a cycle to the next, and states of rolling up to the tangential load.
const SLIP_STEPS: usize = 8;
const ROLLING_STATES: usize = 12;

impl Knobs {
    /// Whether the surface slides over a solid that creeps.
    pub(super) fn slides(&self) -> bool {
        self.creep > 0.0 && self.speed > 0.0
    }

    /// Whether the surface is at rest on a solid that has crept for some time.
    pub(super) fn creeps_in_time(&self) -> bool {
        self.creep > 0.0 && self.speed == 0.0 && self.time > 0.0
    }

    /// Whether the surfaces attract each other.
    pub(super) fn adheres(&self) -> bool {
        self.adhesion > 0.0
    }

    /// The attraction in a cell of some length.
    pub(super) fn attraction(&self, length: f64) -> Adhesion {
        let (work, range) = (self.adhesion * MODULUS * length, self.range * length);
        Adhesion { work: Some(work), range: Some(range), ..Adhesion::default() }
    }

    /// Whether a tangential load acts on the surface.
    pub(super) fn rubs(&self) -> bool {
        self.friction > 0.0 && self.sideways > 0.0
    }

    /// The tangential load, of the same kind as the normal one.
    fn tangential(&self) -> f64 {
        self.sideways * self.friction * self.load
    }

    /// Rolling under tangential loads from a small one to that of the knobs.
    pub(super) fn rolling_motion(&self) -> Option<RollingMotion> {
        let loads = || (1..=ROLLING_STATES).map(|i| self.tangential() * i as f64 / ROLLING_STATES as f64).collect();
        (self.rubs() && self.rolling).then(|| RollingMotion { tangential: loads(), ..RollingMotion::default() })
    }

    /// The path of a history: the time of the load on a solid that creeps, the load and the pull with adhesion, or a cycle of the tangential
    /// load.
    pub(super) fn path(&self) -> Option<LoadPath> {
        if self.adheres() && self.pull > 0.0 {
            return Some(LoadPath { load: vec![self.load, -self.pull], ..LoadPath::default() });
        }
        if self.rubs() && !self.rolling {
            let tangential = [1.0, -1.0, 1.0].map(|turn| turn * self.tangential()).to_vec();
            return Some(LoadPath { tangential, steps: Some(SLIP_STEPS), ..LoadPath::default() });
        }
        self.creeps_in_time().then(|| LoadPath { time: vec![self.time * RETARDATION_TIME], ..LoadPath::default() })
    }

    /// The motion, the time, the friction or the attraction in a few symbols, for titles; empty for an elastic contact without adhesion, as are the words
    /// for names of files.
    pub(in crate::explore) fn motion_in_words(&self) -> [String; 2] {
        if self.takes_scene() {
            return Default::default();
        }
        let Self { creep, speed, time, adhesion, range, pull, friction, sideways, .. } = self;
        if self.adheres() {
            let pulled = [format!(", p* → −{pull}"), format!("_pull{pull}")];
            let [words, name] = if *pull > 0.0 { pulled } else { Default::default() };
            let words = format!("{words}, w/(E*L) = {adhesion:e}, ρ/L = {range:e}");
            return [words, format!("{name}_w{adhesion:e}_r{range:e}")];
        }
        if self.rubs() {
            let name = if self.rolling { "rolling" } else { "pulled" };
            return [
                format!(", {name}, μ = {friction}, Q/(μP) = {sideways}"),
                format!("_{name}_m{friction}_q{sideways}"),
            ];
        }
        match (self.slides(), self.creeps_in_time()) {
            (true, _) => [format!(", f = {creep}, Vτ/L = {speed}"), format!("_f{creep}_v{speed}")],
            (_, true) => [format!(", f = {creep}, T/τ = {time}"), format!("_f{creep}_t{time}")],
            _ => Default::default(),
        }
    }

    /// Refuses what a contact that slides, adheres or creeps in time cannot have.
    pub(super) fn check_motion(&self, grid: &Grid) -> Result<(), Refusal> {
        let (slides, is_gfmd) = (self.slides(), matches!(self.solver, Method::Gfmd(_)));
        let others = self.hardness > 0.0 || slides || self.creeps_in_time();
        let rules = [
            (self.adheres() && others, RefusalRule::AdhesionNotElastic),
            (slides && self.hardness > 0.0, RefusalRule::SlidingOfYielding),
            (slides && !grid.is_periodic(), RefusalRule::SlidingOfFreeBoundary),
            (self.rubs() && (others || self.adheres()), RefusalRule::FrictionNotElastic),
            (self.rubs() && is_gfmd, RefusalRule::FrictionByGfmd),
            (self.adheres() && self.solver != Method::default(), RefusalRule::AdhesionOfMethod),
            ((slides || self.creeps_in_time()) && is_gfmd, RefusalRule::CreepByGfmd),
        ];
        let broken = rules.into_iter().find(|(is_broken, _)| *is_broken);
        broken.map_or(Ok(()), |(_, rule)| Err(rule.into()))
    }
}
