//! What the curves of a recording are over.

use super::draw::{LOAD, STEP};

/// What the curves of a recording are over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Played {
    /// The steps of solves.
    Steps,
    /// The loads of a list.
    Loads,
    /// The states of a history.
    States,
}

impl Played {
    /// Its timeline.
    pub(crate) fn timeline(self) -> &'static str {
        if self == Self::Loads { LOAD } else { STEP }
    }

    /// It in words.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Steps => "the steps of a solve",
            Self::Loads => "a list of loads",
            Self::States => "the states of a history",
        }
    }

    /// What the place along the curves of a comparison means, and what else may be chosen.
    pub(crate) fn about(self) -> &'static str {
        match self {
            Self::Steps => {
                "The curves use the selected timeline: choose `transforms` or `seconds` instead of `step` to compare the work."
            }
            Self::Loads => "The curves are over the loads. Behind other tabs they are over the numbers of the loads.",
            Self::States => {
                "The curves use the selected timeline: the numbers of the states, or, where they have times, `time`. Compare runs along the \
                 same path."
            }
        }
    }
}
