//! What the knobs describe beside one elastic contact at rest: sliding, creep in time, and adhesion.

use super::{Knobs, MODULUS, RETARDATION_TIME};
use crate::explore::refusal::{Refusal, RefusalRule};
use crate::grid::Grid;
use crate::setup::{Adhesion, LoadPath, Method};

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

    /// The path of a history: the time of the load on a solid that creeps, or the load and the pull with adhesion.
    pub(super) fn path(&self) -> Option<LoadPath> {
        if self.adheres() && self.pull > 0.0 {
            return Some(LoadPath { load: vec![self.load, -self.pull], ..LoadPath::default() });
        }
        self.creeps_in_time().then(|| LoadPath { time: vec![self.time * RETARDATION_TIME], ..LoadPath::default() })
    }

    /// The motion, the time or the attraction in a few symbols, for titles; empty for an elastic contact without adhesion, as are the words
    /// for names of files.
    pub(in crate::explore) fn motion_in_words(&self) -> [String; 2] {
        if self.takes_scene() {
            return Default::default();
        }
        let Self { creep, speed, time, adhesion, range, pull, .. } = self;
        if self.adheres() {
            let pulled = [format!(", p* → −{pull}"), format!("_pull{pull}")];
            let [words, name] = if *pull > 0.0 { pulled } else { Default::default() };
            let words = format!("{words}, w/(E*L) = {adhesion:e}, ρ/L = {range:e}");
            return [words, format!("{name}_w{adhesion:e}_r{range:e}")];
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
            (self.adheres() && self.solver != Method::default(), RefusalRule::AdhesionOfMethod),
            ((slides || self.creeps_in_time()) && is_gfmd, RefusalRule::CreepByGfmd),
        ];
        let broken = rules.into_iter().find(|(is_broken, _)| *is_broken);
        broken.map_or(Ok(()), |(_, rule)| Err(rule.into()))
    }
}
