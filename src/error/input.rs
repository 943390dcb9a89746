//! Whether an error is caused by the input, or by the machine or the method.

use super::{
    AdhesionError, ClaimError, Conflict, CreepError, FileError, FlowError, GridError, HistoryError, MotionError,
    PlasticError, PreparationError, ProblemError, RoughnessError, SealError, SettingError, SetupError, SlipError,
    SolidError, SolveError, StepsError, StudyError, SurfaceError,
};
use crate::sentence::{Sentence, Worded};
use std::error::Error;
use std::iter::successors;

/// An error of the library, which knows whether other input can help.
pub trait InputError: Worded + 'static {
    /// Whether other input can help; it cannot where the machine or the method failed.
    fn is_input(&self) -> bool {
        true
    }
}

/// An error of one type of the library, if it is of that type.
type Recogniser = for<'a> fn(&'a (dyn Error + 'static)) -> Option<&'a dyn InputError>;

/// All errors of the library.
const ERRORS: [Recogniser; 22] = [
    known::<AdhesionError>,
    known::<ClaimError>,
    known::<Conflict>,
    known::<CreepError>,
    known::<FileError>,
    known::<FlowError>,
    known::<GridError>,
    known::<HistoryError>,
    known::<MotionError>,
    known::<PlasticError>,
    known::<PreparationError>,
    known::<ProblemError>,
    known::<RoughnessError>,
    known::<SealError>,
    known::<SettingError>,
    known::<SetupError>,
    known::<SlipError>,
    known::<SolidError>,
    known::<SolveError>,
    known::<StepsError>,
    known::<StudyError>,
    known::<SurfaceError>,
];

fn known<'a, E: InputError>(error: &'a (dyn Error + 'static)) -> Option<&'a dyn InputError> {
    error.downcast_ref::<E>().map(|error| error as &dyn InputError)
}

/// An error as one of the library, if it is of its types.
fn of_library<'a>(error: &'a (dyn Error + 'static)) -> Option<&'a dyn InputError> {
    ERRORS.iter().find_map(|known| known(error))
}

/// Whether an error is caused by wrong input: the first error of the library among it and its sources says so.
///
/// ```
/// use asperity::error::{ConflictRule, SetupError, is_input};
/// assert!(is_input(&SetupError::from(ConflictRule::NoSurface)));
/// assert!(!is_input(&std::io::Error::other("the disk is full")));
/// ```
pub fn is_input(error: &(dyn Error + 'static)) -> bool {
    let mut chain = successors(Some(error), |&error| error.source());
    chain.find_map(of_library).is_some_and(InputError::is_input)
}

/// What an error says, with its values where it is one of the library.
///
/// ```
/// use asperity::Grid;
/// use asperity::error::sentence_of;
/// let error = Grid::line(128, 0.0).unwrap_err();
/// assert_eq!(sentence_of(&error).template(), "the length along {axis} is {length}: give a positive, finite length");
/// ```
pub fn sentence_of(error: &(dyn Error + 'static)) -> Sentence {
    of_library(error).map_or_else(|| error.to_string().into(), Worded::sentence)
}

impl InputError for ClaimError {}
impl InputError for Conflict {}
impl InputError for GridError {}
impl InputError for PreparationError {}
impl InputError for ProblemError {}
impl InputError for SettingError {}
impl InputError for SolidError {}
impl InputError for SurfaceError {}

impl InputError for FileError {
    fn is_input(&self) -> bool {
        match self {
            Self::Write { .. } => false,
            Self::Read { .. }
            | Self::Format { .. }
            | Self::Incomparable { .. }
            | Self::Target { .. }
            | Self::NoViewer { .. } => true,
        }
    }
}

impl InputError for RoughnessError {
    fn is_input(&self) -> bool {
        match self {
            Self::Surface(error) => error.is_input(),
            Self::File(error) => error.is_input(),
        }
    }
}

impl InputError for SolveError {
    fn is_input(&self) -> bool {
        match self {
            Self::NotConverged { .. } => false,
            Self::Observer(failure) => is_input(&***failure),
            Self::NeedsPressure { .. }
            | Self::NeedsWaves { .. }
            | Self::NeedsHardWall { .. }
            | Self::NeedsRest { .. } => true,
        }
    }
}

impl InputError for SlipError {
    fn is_input(&self) -> bool {
        match self {
            Self::Grid(error) => error.is_input(),
            Self::Surface(error) => error.is_input(),
            Self::Problem(error) => error.is_input(),
            Self::Solve(error) => error.is_input(),
            Self::NotPositive { .. }
            | Self::Coefficient { .. }
            | Self::Sliding { .. }
            | Self::Yielding
            | Self::NeedsPressure { .. }
            | Self::Beta { .. } => true,
        }
    }
}

impl InputError for CreepError {
    fn is_input(&self) -> bool {
        match self {
            Self::Problem(error) => error.is_input(),
            Self::Solve(error) => error.is_input(),
            Self::Surface(error) => error.is_input(),
            Self::Step { .. } | Self::NoPoints | Self::Order { .. } | Self::Kinds { .. } | Self::NotPositive { .. } => {
                true
            }
        }
    }
}

impl InputError for HistoryError {
    fn is_input(&self) -> bool {
        match self {
            Self::Problem(error) => error.is_input(),
            Self::Surface(error) => error.is_input(),
            Self::Solve(error) => error.is_input(),
            Self::Slip(error) => error.is_input(),
            Self::Creep(error) => error.is_input(),
            Self::Motion(error) => error.is_input(),
            Self::Adhesion(error) => error.is_input(),
            Self::Plastic(error) => error.is_input(),
            Self::Flow(error) => error.is_input(),
            Self::Unload { .. } | Self::Pathless => true,
            Self::Stopped => false,
        }
    }
}

impl InputError for AdhesionError {
    fn is_input(&self) -> bool {
        match self {
            Self::Problem(error) => error.is_input(),
            Self::Surface(error) => error.is_input(),
            Self::Solve(error) => error.is_input(),
            Self::NotFound { .. } | Self::Stopped => false,
            Self::NotPositive { .. }
            | Self::NotFinite { .. }
            | Self::Table { .. }
            | Self::NotElastic { .. }
            | Self::Coarse { .. }
            | Self::Far { .. }
            | Self::MeanGap { .. }
            | Self::Control { .. }
            | Self::FreeMotion => true,
        }
    }
}

impl InputError for MotionError {
    fn is_input(&self) -> bool {
        match self {
            Self::Problem(error) => error.is_input(),
            Self::Surface(error) => error.is_input(),
            Self::Solve(error) => error.is_input(),
            Self::NotPositive { .. }
            | Self::NotFinite { .. }
            | Self::Beta { .. }
            | Self::Slides { .. }
            | Self::NeedsHalfSpace { .. }
            | Self::NeedsHardWall
            | Self::NeedsRest
            | Self::NeedsSliding
            | Self::LongStep { .. } => true,
        }
    }
}

impl InputError for PlasticError {
    fn is_input(&self) -> bool {
        match self {
            Self::Problem(error) => error.is_input(),
            Self::Surface(error) => error.is_input(),
            Self::Solve(error) => error.is_input(),
            Self::Stopped => false,
            Self::NotPositive { .. }
            | Self::NoHardening { .. }
            | Self::Kinematic { .. }
            | Self::Poisson { .. }
            | Self::LayerOrder { .. }
            | Self::LayerCount { .. }
            | Self::Grading { .. }
            | Self::NeedsPeriodic
            | Self::OtherSolid { .. }
            | Self::Hardness
            | Self::NeedsPressure { .. }
            | Self::Load { .. }
            | Self::YieldsEverywhere { .. }
            | Self::HasBegun
            | Self::Range { .. }
            | Self::Memory { .. } => true,
        }
    }
}

impl InputError for FlowError {
    fn is_input(&self) -> bool {
        match self {
            Self::NotConverged { .. } => false,
            Self::Shape { .. }
            | Self::Gap { .. }
            | Self::TooLarge { .. }
            | Self::Tolerance { .. }
            | Self::Resistivity { .. }
            | Self::Conductivity { .. }
            | Self::Bodies { .. }
            | Self::Twice
            | Self::NeedsHalfSpace { .. }
            | Self::NeedsRest => true,
        }
    }
}

impl InputError for SealError {
    fn is_input(&self) -> bool {
        match self {
            Self::Problem(error) => error.is_input(),
            Self::Solve(error) => error.is_input(),
            Self::Width { .. } | Self::Line | Self::Always { .. } | Self::Never { .. } => true,
        }
    }
}

impl InputError for StepsError {
    fn is_input(&self) -> bool {
        match self {
            Self::File(error) => error.is_input(),
            Self::Step { source, .. } => source.is_input(),
            Self::Nothing | Self::Seconds { .. } | Self::SecondsOfFile { .. } => true,
        }
    }
}

impl InputError for SetupError {
    fn is_input(&self) -> bool {
        match self {
            Self::Grid(error) => error.is_input(),
            Self::Surface(error) => error.is_input(),
            Self::Preparation(error) => error.is_input(),
            Self::Solid(error) => error.is_input(),
            Self::Problem(error) => error.is_input(),
            Self::Slip(error) => error.is_input(),
            Self::History(error) => error.is_input(),
            Self::Creep(error) => error.is_input(),
            Self::Conflict(error) => error.is_input(),
            Self::Attraction(error) => error.is_input(),
            Self::Flow(error) => error.is_input(),
            Self::Setting(error) => error.is_input(),
            Self::Solve(error) => error.is_input(),
            Self::File(error) => error.is_input(),
            Self::Table { .. }
            | Self::MixedUnits { .. }
            | Self::ForceWithoutUnit { .. }
            | Self::ForceUnit { .. }
            | Self::NoModulus { .. }
            | Self::UnitWithoutModulus { .. }
            | Self::ElectricalAndThermal { .. }
            | Self::Against { .. }
            | Self::Boundaries { .. }
            | Self::Datum { .. }
            | Self::UnitOfFile { .. }
            | Self::Uneven { .. }
            | Self::Voids { .. }
            | Self::Seed { .. }
            | Self::Sizes { .. }
            | Self::Axes { .. }
            | Self::NoSuchPart { .. }
            | Self::NoSuchNode { .. }
            | Self::Text { .. }
            | Self::Memory { .. } => true,
        }
    }
}

impl InputError for StudyError {
    fn is_input(&self) -> bool {
        match self {
            Self::Setup(error) | Self::Row { source: error, .. } => error.is_input(),
            Self::Solve(error) => error.is_input(),
            Self::File(error) => error.is_input(),
            Self::List { .. }
            | Self::TooManyRows { .. }
            | Self::Friction
            | Self::OneContact
            | Self::NoHistory
            | Self::HistoryLoads
            | Self::NoRow { .. }
            | Self::Memory { .. }
            | Self::OtherPoints { .. }
            | Self::Missing { .. }
            | Self::Damaged { .. }
            | Self::Overlap { .. }
            | Self::OtherStudy { .. }
            | Self::OtherShare { .. } => true,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::PathBuf;

    /// An error that is not among those that are judged would end a command like a failure of the machine.
    #[test]
    fn all_errors_of_the_library_are_judged() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/error");
        let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        let files: Vec<PathBuf> = files.chain([format!("{folder}.rs").into()]).collect();
        let known = include_str!("input.rs");
        let mut count = 0;
        for text in files.iter().map(|path| fs::read_to_string(path).unwrap()) {
            let names = text.split("\n    pub enum ").skip(1).filter_map(|rest| rest.split([' ', '<']).next());
            for name in names.filter(|name| name.ends_with("Error")) {
                assert!(known.contains(&format!("    known::<{name}>,\n")), "{name} is not judged");
                count += 1;
            }
        }
        assert!(count > 15, "only {count} errors were found");
    }
}
