//! One file per command, and what they share.

mod accuracy;
mod bench;
#[cfg(feature = "explore")]
mod browser;
mod choice;
#[cfg(feature = "record")]
mod demo;
#[cfg(feature = "explore")]
mod explore;
mod flags;
mod output;
mod paper;
mod plan;
mod progress;
mod solve;
mod stability;
mod surface;
#[cfg(feature = "explore")]
mod view;

use asperity::error::{
    FileError, GridError, ProblemError, SettingError, SetupError, SolveError, StudyError, SurfaceError,
};
use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// Rough contact: press a rigid surface on an elastic half-space and watch it relax.
///
/// Exit codes: 0 converged, 2 bad input, 3 not converged (outputs are written all the same), 1 any other failure.
#[derive(Parser)]
#[command(version, max_term_width = 110)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Error against run time: algebraic, of the grid, and of theories
    Accuracy(accuracy::Accuracy),
    /// Time the solvers on chosen cases
    Bench(bench::Bench),
    /// Hertz beside rough contact, line and surface, solved by GFMD into one recording
    #[cfg(feature = "record")]
    Demo(demo::Demo),
    /// Turn knobs in the browser and watch the contact relax
    #[cfg(feature = "explore")]
    Explore(explore::Explore),
    /// Make the tables and figures of van Dokkum et al. (2018) again
    Paper(Box<paper::Paper>),
    /// Solve one contact
    Solve(Box<solve::Solve>),
    /// Solve stiff and extreme cases and check the results
    Stability(stability::Stability),
    /// Make a surface, or describe one
    Surface(Box<surface::Describe>),
    /// Open a recording in the browser
    #[cfg(feature = "explore")]
    View(view::View),
}

/// How a command ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Outcome {
    /// All is well.
    Done,
    /// What was asked for is written, but a solver did not converge.
    NotConverged,
}

impl From<Outcome> for ExitCode {
    fn from(outcome: Outcome) -> Self {
        match outcome {
            Outcome::Done => Self::SUCCESS,
            Outcome::NotConverged => Self::from(3),
        }
    }
}

/// Options that do not go together, in one sentence.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct Usage(pub String);

/// A [`Usage`] error.
pub fn usage<T>(sentence: impl Into<String>) -> anyhow::Result<T> {
    Err(Usage(sentence.into()).into())
}

/// Parses the command line and runs the command.
pub fn run() -> anyhow::Result<Outcome> {
    match Cli::parse().command {
        Command::Accuracy(accuracy) => accuracy.run(),
        Command::Bench(bench) => bench.run(),
        #[cfg(feature = "record")]
        Command::Demo(demo) => demo.run(),
        #[cfg(feature = "explore")]
        Command::Explore(explore) => explore.run(),
        Command::Paper(paper) => paper.run(),
        Command::Solve(solve) => solve.run(),
        Command::Stability(stability) => stability.run(),
        Command::Surface(describe) => describe.run(),
        #[cfg(feature = "explore")]
        Command::View(view) => view.run(),
    }
}

/// 2 for what the person at the keyboard can mend, 1 for the rest.
pub fn exit_code(error: &anyhow::Error) -> ExitCode {
    ExitCode::from(if is_input(error) { 2 } else { 1 })
}

/// Whether the person at the keyboard can mend it.
fn is_input(error: &anyhow::Error) -> bool {
    error.is::<Usage>()
        || error.is::<GridError>()
        || error.is::<SurfaceError>()
        || error.is::<ProblemError>()
        || error.is::<SettingError>()
        || error.downcast_ref().is_some_and(is_setup_input)
        || error.downcast_ref().is_some_and(is_solve_input)
        || error.downcast_ref().is_some_and(is_file_input)
        || match error.downcast_ref() {
            Some(StudyError::OtherStudy { .. }) => true,
            Some(StudyError::Setup(setup)) => is_setup_input(setup),
            Some(StudyError::Solve(solve)) => is_solve_input(solve),
            Some(StudyError::File(file)) => is_file_input(file),
            Some(_) => true,
            None => false,
        }
}

/// Whether another setup would do.
fn is_setup_input(error: &SetupError) -> bool {
    match error {
        SetupError::File(file) => is_file_input(file),
        SetupError::Solve(solve) => is_solve_input(solve),
        _ => true,
    }
}

/// Whether another solver would do.
fn is_solve_input(error: &SolveError) -> bool {
    matches!(error, SolveError::NeedsPressure { .. })
}

/// Whether another file would do.
fn is_file_input(error: &FileError) -> bool {
    matches!(
        error,
        FileError::Read { .. } | FileError::Format { .. } | FileError::Target { .. } | FileError::NoViewer { .. }
    )
}
