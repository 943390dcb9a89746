//! How a solver stopped.

use serde::{Deserialize, Serialize};
use std::fmt;
use strum::{EnumString, IntoStaticStr};

/// How a solver stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, EnumString, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Status {
    /// The certificate met all goals of the stop.
    Converged,
    /// The iteration cap was reached.
    IterationCap,
    /// There was no further progress: the tolerance is below the limit of rounding, or of the method.
    Stalled,
    /// The steps of another code ended.
    Ended,
    /// The observer wished to stop.
    StoppedByObserver,
    /// The observer failed.
    ObserverFailed,
    /// The contact was read from a file, whose fields do not confirm what it says.
    Unconfirmed,
}

impl Status {
    /// The name of the status in tables.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Converged => "converged",
            Self::IterationCap => "iteration cap reached",
            Self::Stalled => "no further progress",
            Self::Ended => "no more steps",
            Self::StoppedByObserver => "stopped by the observer",
            Self::ObserverFailed => "the observer failed",
            Self::Unconfirmed => "not confirmed by its file",
        })
    }
}
