//! The command line: one file per command, which reads flags, calls a room below and prints.
//!
//! ```text
//! words --clap--> a command, such as Solve --> SetupTable --> Setup --> Job --> Solved
//!                                                                                 |
//!                 stdout, stderr, files <-- report::deliver <-- ContactReport or StatesReport
//! ```
//!
//! - A command is a struct of flags with a method `run`. The flags of a scene are in `flags`, made from the table of keys in
//!   [`setup`](asperity::setup); those that name files are in `outputs`.
//! - `report` says what becomes of a result: files first, then text or JSON, then warnings. `contact_report` has what is said of one
//!   contact, `states_report` what is said of several states.
//! - Sentences of the library name keys of a scene, and never flags. `exit_status` and `warnings` add the flags.
//! - `units` knows whether the numbers of a scene are in metres and pascals: without units they are printed as they are.
//!
//! Nothing is computed here: each number that is printed comes from a room below, so that Python and the page have it too. `solve` is
//! the place to begin reading.

mod accuracy;
mod adhesion;
mod bench;
mod certify;
mod choice;
mod claim_report;
mod command_style;
mod compare;
mod completions;
mod contact_report;
mod demo;
mod density;
mod exit_status;
mod explore;
mod fields;
mod figure_args;
mod file_curve;
mod file_map;
mod finding;
mod flags;
mod flow;
mod given_words;
mod hatch;
mod height_picture;
mod history_picture;
mod imprint;
mod inspect;
mod interrupt;
mod iteration;
mod licences;
mod man;
mod measurement;
mod output;
mod outputs;
mod paper;
mod patch_report;
mod patches;
mod picture;
mod plot;
mod problem_summary;
mod progress;
mod recording_args;
mod report;
mod result_file;
mod seal;
mod slip;
mod solve;
mod solve_plan;
mod stability;
mod state_watch;
mod states;
mod states_report;
mod stress;
mod study;
mod study_row;
mod study_summary;
mod study_table;
mod surface;
mod surface_statistics;
mod surface_table;
mod survey;
mod survey_picture;
mod terminal;
mod texture;
mod units;
mod view;
mod warnings;
mod words;
mod wrote;

use asperity::seen::plain;
use clap::error::{ContextKind, ErrorKind};
use clap::{CommandFactory, Parser, Subcommand};
use exit_status::{ExitStatus, exit_code, remedy};
use given_words::in_given_words;
use std::ffi::OsString;
use std::io::{self, Write};
use terminal::stderr;
use words::with_negative_numbers;

/// Rough contact: press a rigid surface on an elastic half-space, and see how the solver converges.
///
/// Exit codes: 0 converged, 2 bad input, 3 not converged (outputs are written), 130 interrupted by Ctrl-C, 1 any other
/// failure.
#[derive(Parser)]
#[command(version, long_version = BUILD, max_term_width = 110)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    #[command(flatten)]
    style: command_style::CommandStyle,
}

/// What the program is built from.
const BUILD: &str = concat!(
    env!("CARGO_PKG_VERSION"),
    "\ncommit: ",
    env!("ASPERITY_COMMIT"),
    "\nfeatures: ",
    env!("ASPERITY_FEATURES")
);

#[derive(Subcommand)]
enum Command {
    /// Measure errors against run time: of the solver, of the grid, and of theories
    Accuracy(accuracy::Accuracy),
    /// Measure the speed of the solvers
    Bench(bench::Bench),
    /// Certify the pressure, gap or displacement of another code
    ///
    /// The certificate is a bound of the error of the result, for any code. If the result fails, the program looks for
    /// common mistakes: signs, forces instead of pressures, wrong moduli, transposed arrays. A result passes if its
    /// certificate is below --tolerance, and if tension and the error of the load are below the square root of
    /// --tolerance.
    Certify(Box<certify::Certify>),
    /// Compare recordings: draw their curves together
    ///
    /// The result is one recording. Its first tab shows the curves of all runs together: certificate, kappa_r, area and
    /// others. The curves are named by the settings in which the runs differ. Each recording is also in its own tab.
    Compare(compare::Compare),
    /// Write shell completions
    Completions(completions::Completions),
    /// Record smooth (Hertz) and rough contacts side by side, line and surface, solved by GFMD
    Demo(demo::Demo),
    /// Open the interactive page: change parameters and see the contact
    Explore(explore::Explore),
    /// Analyse another solver's iterations, from files of its steps
    ///
    /// Every step gets a certificate, and is recorded and compared with the solution, like the steps of asperity's own
    /// solvers.
    Inspect(Box<inspect::Inspect>),
    /// Print the licences of all libraries and fonts in the program
    Licences(licences::Licences),
    /// Write the manual pages
    ///
    /// All pages are written to standard output, or to a new folder with one page per command.
    Man(man::Man),
    /// Merge the shard tables of a study
    ///
    /// The tables must contain each row of the study exactly once. The result is identical to that of a single machine.
    Merge(study::Merge),
    /// Reproduce the tables and figures of van Dokkum et al. (2018)
    ///
    /// The paper: van Dokkum, Khajeh Salehani, Irani & Nicola, Tribol. Lett. 66:115 (2018). Each figure is written as a
    /// CSV of all solved points, as SVG, as PNG and as a recording; comparison.csv is the final table. If the command
    /// is interrupted, run it again: it continues, and the CSV files are identical. Other Hurst exponents, seeds, loads
    /// and sizes give a study of your own. Lengths are those of the paper: a roll-off wavelength of 20 um; a line has 8
    /// of them, a surface 4 per side.
    Paper(Box<paper::PaperCommand>),
    /// Show the contact patches: sizes, loads, and which merged when
    ///
    /// A patch is a set of nodes in contact that are connected along rows or columns. Under several loads, or in a history,
    /// it keeps its number as long as it lives, and births, deaths, mergers and splits are told. A result (.npz) is read, a
    /// scene is solved. Of heights that were mirrored, patches are counted without their images.
    Patches(Box<patches::PatchesCommand>),
    /// Draw numbers of several results and tables in one picture
    ///
    /// Each file is a curve: the states of a result (.npz), or the rows of a table of loads, of states or of a study (.csv).
    Plot(Box<plot::PlotCommand>),
    /// Find the load at which a surface seals
    ///
    /// A contact seals if no open path leads from one side of the cell to the other. The load is found by bisection,
    /// along both axes or along one; the load of a scene is not used.
    Seal(Box<seal::Seal>),
    /// Solve a contact under one load, or under several loads one after the other
    Solve(Box<solve::Solve>),
    /// Solve stiff and extreme cases and check the results
    Stability(stability::Stability),
    /// Solve a study (a scene with lists of values), on one machine or on several
    ///
    /// Each combination of values is a realisation, which is solved under all loads one after the other. If a study is
    /// interrupted, run it again: it continues. The numbers are identical on any number of threads, and for any
    /// division into shares.
    Study(Box<study::Study>),
    /// Generate a surface, or describe one
    Surface(Box<surface::Describe>),
    /// Open a recording in the browser, or compare several
    #[command(after_help = "Examples:\n  asperity view demo.rrd\n  asperity view demo.rrd --port 9000 --no-open")]
    View(view::View),
}

/// Runs a command line, whose first word is the name of the program, and returns the exit code.
pub fn run(words: impl IntoIterator<Item = OsString>) -> u8 {
    let words = with_negative_numbers(words);
    let cli = match Cli::try_parse_from(&words) {
        Ok(cli) => cli,
        Err(error) => return misunderstood(&error, &words),
    };
    match carry_out(cli) {
        Ok(outcome) => outcome.exit_code(),
        Err(error) if is_unheard(&error) => ExitStatus::Done.exit_code(),
        Err(error) => {
            let sentence = in_given_words(error.as_ref(), &words);
            writeln!(stderr(), "error: {sentence}{}", remedy(&error)).ok();
            exit_code(&error)
        }
    }
}

/// Flags that there are not, and what to give in their place.
const NO_FLAGS: [(&str, &str); 4] = [
    ("--load", "name the kind of the load, such as --reduced-pressure 0.1 or --mean-gap 1um"),
    ("--leakage", "give --flow"),
    ("--nu", "give --poisson"),
    ("--e", "give --young"),
];

/// Prints help that is asked for, or why words are not understood, and returns the exit code.
fn misunderstood(error: &clap::Error, words: &[OsString]) -> u8 {
    let unknown = error.get(ContextKind::InvalidArg).filter(|_| error.kind() == ErrorKind::UnknownArgument);
    let unknown = unknown.map(ToString::to_string);
    if let Some((flag, instead)) = NO_FLAGS.iter().find(|(flag, _)| unknown.as_deref() == Some(*flag)) {
        writeln!(stderr(), "error: there is no flag {flag}: {instead}").ok();
        return error.exit_code() as u8;
    }
    let is_seen = |word: &OsString| word.to_str().is_some_and(|word| plain(word) == word);
    let wrong = words.iter().find(|word| word.to_str().is_none());
    match wrong.filter(|_| error.kind() == ErrorKind::InvalidUtf8) {
        Some(word) => writeln!(stderr(), "error: the argument {word:?} is not UTF-8: rename the file").ok(),
        // the parser repeats words as they are
        None if !words.iter().all(is_seen) => write!(stderr(), "{}", error.render()).ok(),
        None => error.print().ok(),
    };
    error.exit_code() as u8
}

/// Whether an error is a closed output pipe, as with `head`.
fn is_unheard(error: &anyhow::Error) -> bool {
    error.downcast_ref::<io::Error>().is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
}

fn carry_out(Cli { command, style }: Cli) -> anyhow::Result<ExitStatus> {
    style.apply()?;
    if !matches!(command, Command::Explore(_) | Command::View(_)) {
        interrupt::listen()?;
    }
    match command {
        Command::Accuracy(accuracy) => accuracy.run(),
        Command::Bench(bench) => bench.run(),
        Command::Certify(certify) => certify.run(),
        Command::Compare(compare) => compare.run(),
        Command::Completions(completions) => completions.run(Cli::command()),
        Command::Demo(demo) => demo.run(),
        Command::Explore(explore) => explore.run(),
        Command::Inspect(inspect) => inspect.run(),
        Command::Licences(licences) => licences.run(),
        Command::Man(man) => man.run(Cli::command()),
        Command::Merge(merge) => merge.run(),
        Command::Paper(paper) => paper.run(),
        Command::Patches(patches) => patches.run(),
        Command::Plot(plot) => plot.run(),
        Command::Seal(seal) => seal.run(),
        Command::Solve(solve) => solve.run(),
        Command::Stability(stability) => stability.run(),
        Command::Study(study) => study.run(),
        Command::Surface(describe) => describe.run(),
        Command::View(view) => view.run(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_has_examples_that_are_understood() {
        for command in Cli::command().get_subcommands() {
            let (name, help) =
                (command.get_name(), command.get_after_help().map(ToString::to_string).unwrap_or_default());
            let examples: Vec<&str> = help.lines().filter(|line| line.starts_with("  asperity ")).collect();
            assert!(examples.len() >= 2, "{name} has {} examples", examples.len());
            for example in examples {
                let is_of_shell = |word: &&str| [">", "|"].contains(word);
                let words: Vec<&str> = example.split_whitespace().take_while(|word| !is_of_shell(word)).collect();
                assert_eq!(words[1], name, "{example}");
                assert!(example.len() < 100, "{example}");
                Cli::try_parse_from(words).map(drop).unwrap_or_else(|error| panic!("{example}: {error}"));
            }
        }
    }
}
