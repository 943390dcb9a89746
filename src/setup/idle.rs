//! Why a key of a setup would have no effect.

/// A reason why a key would have no effect.
pub(crate) struct Idle {
    /// The part of a setup that, if it is given or missing, leaves the key without an effect.
    pub(super) cause: IdleCause,
    /// Why, and what to do.
    pub(super) reason: &'static str,
}

/// The sections, keys and parts of a recording that leave another key without an effect.
pub(super) enum IdleCause {
    /// One of these sections or keys is given.
    Given(&'static [&'static str]),
    /// One of these sections or keys is not given.
    Missing(&'static [&'static str]),
    /// This part is not recorded.
    PartMissing(&'static str),
}

// What a setup refuses by itself is not among these.

pub(super) const GIVEN_STEPS: Idle = Idle {
    cause: IdleCause::Given(&["path.steps"]),
    reason: "it has no effect on a given number of steps: leave the steps out, or the tolerance",
};

pub(super) const NO_CREEP: Idle = Idle {
    cause: IdleCause::Missing(&["viscoelastic"]),
    reason: "it has an effect only on a solid that creeps: leave it out",
};

pub(super) const NO_FRICTION_PATH: Idle = Idle {
    cause: IdleCause::Missing(&["friction", "path.tangential"]),
    reason: "it has an effect only on a path with friction and tangential loads: leave it out",
};

pub(super) const YIELDING: Idle = Idle {
    cause: IdleCause::Given(&["solid.yield-stress"]),
    reason: "it has no effect on the load steps of a body that yields below its surface: leave it out",
};

pub(super) const NO_YIELDING: Idle = Idle {
    cause: IdleCause::Missing(&["solid.yield-stress"]),
    reason: "it has an effect only on a body that yields below its surface: leave it out",
};

pub(super) const NO_HALF_SPACE: Idle = Idle {
    cause: IdleCause::Given(&["solid.layer", "solid.stiffness"]),
    reason: "it has an effect only on a half-space: leave it out",
};

pub(super) const NO_RASTER: Idle = Idle {
    cause: IdleCause::PartMissing("raster"),
    reason: "the part raster is not recorded: name it among the parts, or leave this out",
};
