//! The knobs of processes other than one elastic contact at rest: sliding, creep in time, adhesion, and yielding below the surface.

use super::Knobs;
use crate::contact::Load;
use crate::explore::refusal::{Refusal, RefusalRule};
use crate::explore::scale::{MODULUS, RETARDATION_TIME};
use crate::explore::schema::MOST_POINTS_OF_YIELDING;
use crate::grid::Grid;
use crate::setup::{Adhesion, LoadPath, Method, RollingMotion, Setup};

/// Steps from one tangential load of a cycle to the next, and states of rolling up to the tangential load.
const SLIP_STEPS: usize = 8;
const ROLLING_STATES: usize = 12;
/// Steps of the load on a solid that yields below its surface, up, and down again.
const YIELDING_STEPS: usize = 4;
/// The mean gap from which surfaces are moved together, and to which they are moved apart, over that at first touch.
const APART: f64 = 2.0;

impl Knobs {
    /// Whether the surface slides over a solid that creeps.
    pub(super) fn slides(&self) -> bool {
        self.creep > 0.0 && self.speed > 0.0
    }

    /// Whether the surface is at rest on a solid that has crept for some time.
    pub(super) fn creeps_in_time(&self) -> bool {
        self.creep > 0.0 && self.speed == 0.0 && self.time > 0.0
    }

    /// Whether the solid yields below its surface.
    pub(super) fn yields_below(&self) -> bool {
        self.yield_stress > 0.0
    }

    /// Whether the surfaces attract each other.
    pub(super) fn adheres(&self) -> bool {
        self.adhesion > 0.0
    }

    /// Whether surfaces with adhesion are moved to gaps, and the loads follow.
    pub(super) fn is_at_gaps(&self) -> bool {
        !self.takes_scene() && self.adheres() && self.depth > 0.0
    }

    /// A setup along mean gaps: from apart down to the depth of the knobs, and apart again.
    ///
    /// # Errors
    /// The errors of [`Setup::problem`].
    pub(super) fn along_gaps(&self, setup: Setup) -> Result<Setup, Refusal> {
        let touch = setup.problem()?.highest();
        let [apart, close] = [APART * touch, (1.0 - self.depth) * touch];
        let path = Some(LoadPath { load: vec![apart, close, apart], ..LoadPath::default() });
        Ok(Setup { load: Load::MeanGap(apart), path, ..setup })
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

    /// The path of a history: the time of the load on a solid that creeps, from no load to the load and on to the pull with adhesion, a cycle of the tangential
    /// load, or the load on a solid that yields below its surface, which may be taken off.
    pub(super) fn path(&self) -> Option<LoadPath> {
        if self.yields_below() {
            let load = if self.release { vec![self.load, 0.0] } else { vec![self.load] };
            return Some(LoadPath { load, steps: Some(YIELDING_STEPS), ..LoadPath::default() });
        }
        if self.adheres() && self.pull > 0.0 {
            return Some(LoadPath { load: vec![0.0, self.load, -self.pull], ..LoadPath::default() });
        }
        if self.rubs() && !self.rolling {
            let tangential = [1.0, -1.0, 1.0].map(|turn| turn * self.tangential()).to_vec();
            return Some(LoadPath { tangential, steps: Some(SLIP_STEPS), ..LoadPath::default() });
        }
        self.creeps_in_time().then(|| LoadPath { time: vec![self.time * RETARDATION_TIME], ..LoadPath::default() })
    }

    /// The load, or the depth at gaps, in a few symbols for titles, and in those for names of files.
    pub(in crate::explore) fn load_in_words(&self) -> [String; 2] {
        let Self { load, depth, .. } = self;
        if self.is_at_gaps() {
            [format!("δ/g₀ = {depth}"), format!("d{depth}")]
        } else {
            [format!("p* = {load}"), format!("p{load}")]
        }
    }

    /// The motion, the time, the friction, the attraction or the yield stress in a few symbols, for titles; empty for an elastic contact without adhesion, as are the words
    /// for names of files.
    pub(in crate::explore) fn motion_in_words(&self) -> [String; 2] {
        if self.takes_scene() {
            return Default::default();
        }
        let Self { creep, speed, time, adhesion, range, pull, friction, sideways, .. } = self;
        if self.adheres() {
            let pulled = [format!(", p* → −{pull}"), format!("_pull{pull}")];
            let [words, name] = if *pull > 0.0 && !self.is_at_gaps() { pulled } else { Default::default() };
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
        if self.yields_below() {
            let [words, name] = if self.release { [", released", "_released"] } else { [""; 2] };
            let (yield_stress, hardening) = (self.yield_stress, self.hardening);
            let words = format!("{words}, Y/E* = {yield_stress:e}, H/E* = {hardening}");
            return [words, format!("{name}_y{yield_stress:e}_h{hardening}")];
        }
        match (self.slides(), self.creeps_in_time()) {
            (true, _) => [format!(", f = {creep}, Vτ/L = {speed}"), format!("_f{creep}_v{speed}")],
            (_, true) => [format!(", f = {creep}, T/τ = {time}"), format!("_f{creep}_t{time}")],
            _ => Default::default(),
        }
    }

    /// Refuses what a contact that slides, adheres, creeps in time or yields below its surface cannot have.
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
        match broken {
            Some((_, rule)) => Err(rule.into()),
            None if self.yields_below() => check_points_of_yielding(grid),
            None => Ok(()),
        }
    }
}

/// Refuses more points than the layers below can be solved for while the user waits.
fn check_points_of_yielding(grid: &Grid) -> Result<(), Refusal> {
    let [line, surface] = MOST_POINTS_OF_YIELDING;
    let (side, [ny, nx]) = (surface.isqrt(), grid.shape());
    let (is_too_many, points, most) = match grid.is_line() {
        true => (nx > line, nx.to_string(), line.to_string()),
        false => (grid.len() > surface, format!("{ny} x {nx}"), format!("{side} x {side}")),
    };
    let refusal = || RefusalRule::YieldPoints.with([("points", points), ("most", most)]);
    if is_too_many { Err(refusal()) } else { Ok(()) }
}
