//! The processes that a setup can describe, and what each of them offers.

use crate::contact::{Quantity, StateKind};
use strum::{EnumIter, EnumMessage, IntoStaticStr};

/// The processes that a setup, or a list of loads, can describe.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, EnumMessage, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum ProcessKind {
    /// One load after the other.
    Loads,
    /// A viscoelastic solid in time.
    Creep,
    /// Partial slip under normal and tangential loads.
    Slip,
    /// Steady sliding over a viscoelastic solid.
    Sliding,
    /// Steady rolling with friction.
    Rolling,
    /// Adhesion under loads up and down.
    Adhesion,
}

/// What is shown of the states of a process.
#[derive(Debug)]
pub struct ProcessRow {
    /// The quantity along which states are drawn; none for the number of the state.
    pub axis: Option<Quantity>,
    /// Whether this axis is logarithmic.
    pub is_logarithmic: bool,
    /// The charts of its pictures.
    pub charts: [ProcessChart; 2],
    /// The columns of the table for reading.
    pub columns: &'static [Quantity],
    /// What names a state in a recording.
    pub caption: &'static [Quantity],
    /// Whether the states differ in what they claim, so that each states its own claim.
    pub has_claims: bool,
    /// The further fields without which a saved state cannot be certified again.
    pub needed: &'static [&'static str],
    /// What its contacts are states of.
    pub state: StateKind,
}

/// A chart of the states of a process: one quantity against another one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ProcessChart {
    /// The quantity on the horizontal axis; none for the number of the state.
    pub x: Option<Quantity>,
    /// The quantity on the vertical axis.
    pub y: Quantity,
}

const fn against(x: Quantity, y: Quantity) -> ProcessChart {
    ProcessChart { x: Some(x), y }
}

const LOADS: ProcessRow = ProcessRow {
    axis: Some(Quantity::ReducedPressure),
    is_logarithmic: true,
    charts: [
        against(Quantity::ReducedPressure, Quantity::RelativeArea),
        against(Quantity::ReducedPressure, Quantity::KappaR),
    ],
    columns: &[
        Quantity::ReducedPressure,
        Quantity::MeanPressure,
        Quantity::MeanGap,
        Quantity::RelativeArea,
        Quantity::RelativeAreaCounted,
        Quantity::Kappa,
        Quantity::KappaR,
        Quantity::Patches,
        Quantity::Certificate,
    ],
    caption: &[Quantity::ReducedPressure],
    has_claims: false,
    needed: &[],
    state: StateKind::Elastic,
};

const CREEP: ProcessRow = ProcessRow {
    axis: Some(Quantity::Time),
    is_logarithmic: false,
    charts: [against(Quantity::Time, Quantity::RelativeArea), against(Quantity::Time, Quantity::MeanGap)],
    columns: &[
        Quantity::Time,
        Quantity::MeanPressure,
        Quantity::RelativeArea,
        Quantity::KappaR,
        Quantity::MeanGap,
        Quantity::EffectivePressure,
        Quantity::Dissipated,
        Quantity::TimeError,
        Quantity::Certificate,
    ],
    caption: &[Quantity::Time],
    has_claims: false,
    needed: &["stored_strain"],
    state: StateKind::Creep,
};

const SLIP: ProcessRow = ProcessRow {
    axis: None,
    is_logarithmic: false,
    charts: [against(Quantity::Shift, Quantity::MeanTraction), ProcessChart { x: None, y: Quantity::StickShare }],
    columns: &[
        Quantity::MeanPressure,
        Quantity::MeanTraction,
        Quantity::Friction,
        Quantity::Shift,
        Quantity::StickShare,
        Quantity::Dissipated,
        Quantity::RelativeArea,
        Quantity::TractionCertificate,
    ],
    caption: &[Quantity::Friction],
    has_claims: false,
    needed: &["traction"],
    state: StateKind::Elastic,
};

const SLIDING: ProcessRow = ProcessRow {
    axis: Some(Quantity::Speed),
    is_logarithmic: true,
    charts: [against(Quantity::Speed, Quantity::Friction), against(Quantity::Speed, Quantity::RelativeArea)],
    columns: &[
        Quantity::Speed,
        Quantity::Friction,
        Quantity::FrictionFullContact,
        Quantity::FrictionPersson,
        Quantity::RelativeArea,
        Quantity::MeanGap,
        Quantity::MaxPressure,
        Quantity::Certificate,
    ],
    caption: &[Quantity::Speed, Quantity::Friction],
    has_claims: false,
    needed: &[],
    state: StateKind::Elastic,
};

const ROLLING: ProcessRow = ProcessRow {
    axis: None,
    is_logarithmic: false,
    charts: [against(Quantity::Creepage, Quantity::Friction), against(Quantity::Creepage, Quantity::StickShare)],
    columns: &[
        Quantity::Creepage,
        Quantity::Friction,
        Quantity::StickShare,
        Quantity::RelativeArea,
        Quantity::MaxPressure,
        Quantity::Certificate,
        Quantity::TractionCertificate,
    ],
    caption: &[Quantity::Creepage, Quantity::Friction],
    has_claims: false,
    needed: &["traction"],
    state: StateKind::Elastic,
};

const ADHESION: ProcessRow = ProcessRow {
    axis: None,
    is_logarithmic: false,
    charts: [against(Quantity::MeanGap, Quantity::MeanPressure), against(Quantity::MeanGap, Quantity::RelativeArea)],
    columns: &[
        Quantity::MeanPressure,
        Quantity::MeanGap,
        Quantity::Approach,
        Quantity::RelativeArea,
        Quantity::MeanAttraction,
        Quantity::Jump,
        Quantity::Dissipated,
        Quantity::LeastCurvature,
        Quantity::Residual,
    ],
    caption: &[Quantity::MeanPressure, Quantity::MeanGap],
    has_claims: true,
    needed: &["attraction"],
    state: StateKind::Adhesion,
};

impl ProcessKind {
    /// What is shown of its states.
    pub fn row(self) -> &'static ProcessRow {
        match self {
            Self::Loads => &LOADS,
            Self::Creep => &CREEP,
            Self::Slip => &SLIP,
            Self::Sliding => &SLIDING,
            Self::Rolling => &ROLLING,
            Self::Adhesion => &ADHESION,
        }
    }
}
