//! The processes that a setup can describe, and what each of them offers.

use super::Setup;
use crate::contact::{Feels, Problem, Quantity};
use crate::error::SetupError;
use crate::grid::Grid;
use crate::history::{Loading, Process};
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
    /// A solid that yields below its surface, under loads up and down.
    Plastic,
}

/// What makes a process, what it takes, and what is shown of its states.
#[derive(Debug)]
pub struct ProcessRow {
    /// Whether a setup whose sections go together describes it; at most one process of a setup is described.
    pub(super) is_given: fn(&Setup) -> bool,
    /// The number of its states along the path or the list of a setup, an estimate where steps are chosen by the error in time.
    pub(super) states: fn(&Setup) -> usize,
    /// Refuses what it cannot have on a grid.
    pub(super) check: fn(&Setup, &Grid) -> Result<(), SetupError>,
    /// The bytes that it takes besides the solves.
    pub(super) bytes: fn(&Setup, &Grid) -> Result<f64, SetupError>,
    /// What makes its states.
    pub(super) make: MakeProcess,
    /// Whether its surfaces may yield under a hardness.
    pub takes_hardness: bool,
    /// Whether its load must be a pressure, since friction follows that.
    pub needs_pressure: bool,
    /// What states that are not converged have missed.
    pub missed: &'static str,
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
    /// What the solid feels besides the pressure between the surfaces.
    pub feels: Feels,
}

/// What makes the states of a problem, which is that of a setup.
type MakeProcess = for<'a> fn(&'a Setup, Problem) -> Result<Box<dyn Process + 'a>, SetupError>;

/// Steps between two points of a path in time that are expected where the error in time chooses them.
const STEPS_OF_TIME: usize = 32;

/// Steps between two points of a path with adhesion, if no number is given.
pub(super) const STEPS_OF_ADHESION: usize = 20;

/// What is said of states whose certificate is above the tolerance.
const WITHOUT_CERTIFICATE: &str = "did not reach their certificate";

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
    is_given: |_| false,
    states: |_| 0,
    check: |_, _| Ok(()),
    bytes: |_, _| Ok(0.0),
    make: |it, problem| Ok(Box::new(Loading::new(problem, it.solver(), it.stop).along(vec![it.load]))),
    takes_hardness: true,
    needs_pressure: false,
    missed: WITHOUT_CERTIFICATE,
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
    feels: Feels::PRESSURE,
};

const CREEP: ProcessRow = ProcessRow {
    is_given: Setup::creeps,
    states: |it| it.states_of_path(STEPS_OF_TIME),
    check: |_, _| Ok(()),
    bytes: Setup::creep_bytes,
    make: |it, problem| Ok(Box::new(it.creep(problem)?)),
    takes_hardness: true,
    needs_pressure: false,
    missed: WITHOUT_CERTIFICATE,
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
        Quantity::DissipatedTimeError,
        Quantity::TimeError,
        Quantity::Certificate,
    ],
    caption: &[Quantity::Time],
    has_claims: false,
    feels: Feels::MEMORY,
};

const SLIP: ProcessRow = ProcessRow {
    is_given: |it| it.path.is_some() && it.viscoelastic.is_none() && it.adhesion.is_none() && !it.yields(),
    states: |it| it.states_of_path(1),
    check: |it, _| it.check_slip(),
    bytes: Setup::slip_bytes,
    make: |it, problem| Ok(Box::new(it.slip(problem)?)),
    takes_hardness: false,
    needs_pressure: true,
    missed: WITHOUT_CERTIFICATE,
    axis: None,
    is_logarithmic: false,
    charts: [against(Quantity::Shift, Quantity::MeanTraction), ProcessChart { x: None, y: Quantity::StickShare }],
    columns: &[
        Quantity::MeanPressure,
        Quantity::MeanTraction,
        Quantity::Friction,
        Quantity::Shift,
        Quantity::ShiftPathError,
        Quantity::StickShare,
        Quantity::Dissipated,
        Quantity::DissipatedPathError,
        Quantity::RelativeArea,
        Quantity::TractionCertificate,
    ],
    caption: &[Quantity::Friction],
    has_claims: false,
    feels: Feels::PRESSURE,
};

const SLIDING: ProcessRow = ProcessRow {
    is_given: |it| it.sliding.is_some(),
    states: |it| it.sliding.as_ref().map_or(0, |it| it.speed.len()),
    check: |_, _| Ok(()),
    bytes: Setup::sliding_bytes,
    make: |it, problem| Ok(Box::new(it.slides(problem)?)),
    takes_hardness: false,
    needs_pressure: false,
    missed: WITHOUT_CERTIFICATE,
    axis: Some(Quantity::Speed),
    is_logarithmic: true,
    charts: [against(Quantity::Speed, Quantity::Friction), against(Quantity::Speed, Quantity::RelativeArea)],
    columns: &[
        Quantity::Speed,
        Quantity::Friction,
        Quantity::FrictionError,
        Quantity::FrictionFullContact,
        Quantity::FrictionPersson,
        Quantity::RelativeArea,
        Quantity::MeanGap,
        Quantity::MaxPressure,
        Quantity::Certificate,
    ],
    caption: &[Quantity::Speed, Quantity::Friction],
    has_claims: false,
    feels: Feels::PRESSURE,
};

const ROLLING: ProcessRow = ProcessRow {
    is_given: |it| it.rolling.is_some(),
    states: |it| it.rolling.as_ref().map_or(0, |it| it.creepage.len() + it.tangential.len()),
    check: |_, _| Ok(()),
    bytes: Setup::rolling_bytes,
    make: |it, problem| Ok(Box::new(it.rolls(problem)?)),
    takes_hardness: false,
    needs_pressure: true,
    missed: WITHOUT_CERTIFICATE,
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
    feels: Feels::PRESSURE,
};

const ADHESION: ProcessRow = ProcessRow {
    is_given: |it| it.adhesion.is_some(),
    states: |it| it.states_of_path(STEPS_OF_ADHESION).max(1).saturating_add(it.expected_frames()),
    check: Setup::check_adhesion,
    bytes: Setup::adhesion_bytes,
    make: |it, problem| Ok(Box::new(it.adhesive(problem)?)),
    takes_hardness: false,
    needs_pressure: false,
    missed: "are not converged: equilibrium is missed by more than the tolerance",
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
    feels: Feels::ATTRACTION,
};

const PLASTIC: ProcessRow = ProcessRow {
    is_given: Setup::yields,
    states: Setup::states_of_yielding,
    check: Setup::check_plastic,
    bytes: Setup::plastic_bytes,
    make: |it, problem| Ok(Box::new(it.plastic(problem)?)),
    takes_hardness: false,
    needs_pressure: false,
    missed: WITHOUT_CERTIFICATE,
    axis: None,
    is_logarithmic: false,
    charts: [
        against(Quantity::MeanPressure, Quantity::RelativeArea),
        against(Quantity::MeanPressure, Quantity::ImprintDepth),
    ],
    columns: &[
        Quantity::MeanPressure,
        Quantity::RelativeArea,
        Quantity::MeanGap,
        Quantity::ContactPressureOverYield,
        Quantity::MaxPlasticStrain,
        Quantity::DeepestYield,
        Quantity::ImprintDepth,
        Quantity::PlasticWork,
        Quantity::StepCertificate,
    ],
    caption: &[Quantity::MeanPressure, Quantity::DeepestYield],
    has_claims: false,
    feels: Feels::EIGENSTRAIN,
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
            Self::Plastic => &PLASTIC,
        }
    }
}
