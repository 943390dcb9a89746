//! The command line, one file per command.

mod accuracy;
mod bench;
mod certify;
mod choice;
mod claim_report;
#[cfg(feature = "record")]
mod compare;
mod completions;
#[cfg(feature = "record")]
mod demo;
mod density;
mod exit_status;
#[cfg(feature = "explore")]
mod explore;
mod fields;
mod finding;
mod flags;
mod inspect;
mod interrupt;
mod iteration;
mod load_curve;
mod man;
mod manners;
mod nodes;
mod output;
mod outputs;
mod paper;
mod picture;
mod problem_summary;
mod progress;
#[cfg(feature = "record")]
mod recording_args;
mod slip;
mod solve;
mod solve_plan;
mod stability;
mod stress;
mod study;
#[cfg(feature = "record")]
mod study_row;
mod study_table;
mod surface;
mod survey;
mod units;
#[cfg(feature = "explore")]
mod view;
mod warnings;
mod wrote;

use clap::{CommandFactory, Parser, Subcommand};
use exit_status::{ExitStatus, exit_code, remedy};
use std::ffi::OsString;
use std::io::{self, Write, stderr};

/// Rough contact: press a rigid surface on an elastic half-space and watch it relax.
///
/// Exit codes: 0 converged, 2 bad input, 3 not converged (outputs are written all the same), 130 interrupted by Ctrl-C, 1 any other
/// failure.
#[derive(Parser)]
#[command(version, long_version = BUILD, max_term_width = 110)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    #[command(flatten)]
    manners: manners::Manners,
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
    /// Error against run time: algebraic, of the grid, and of theories
    Accuracy(accuracy::Accuracy),
    /// Time the solvers on chosen cases
    Bench(bench::Bench),
    /// Certify the pressure, gap or displacement of another code
    ///
    /// The certificate bounds the error of the result, whatever code has made it. Where it fails, everyday mistakes are recognised
    /// from the numbers: signs, forces for pressures, wrong moduli, transposed arrays. The result holds if the certificate is within --tolerance,
    /// and load and tension are off by no more than its root.
    Certify(Box<certify::Certify>),
    /// Lay the traces of several recordings over each other
    ///
    /// One recording comes out, with the curves of certificate, kappa_r, area and others of all runs, named by what tells the runs
    /// apart, and each recording as it was in a tab of its own.
    #[cfg(feature = "record")]
    Compare(compare::Compare),
    /// Write what a shell needs to complete commands and flags
    Completions(completions::Completions),
    /// Hertz beside rough contact, line and surface, solved by GFMD into one recording
    #[cfg(feature = "record")]
    Demo(demo::Demo),
    /// Turn knobs in the browser and watch the contact relax
    #[cfg(feature = "explore")]
    Explore(explore::Explore),
    /// Analyse another solver's iterations, from files of its steps
    ///
    /// Every step is certified and recorded like those of our own solvers, and compared with the solution.
    Inspect(Box<inspect::Inspect>),
    /// Write the manual
    ///
    /// All pages come one after the other on standard output, or one for each command in a new folder.
    Man(man::Man),
    /// Merge the shard tables of a study
    ///
    /// The tables must hold each row of the study once, and no others. What comes out is that of one machine to the last bit.
    Merge(study::Merge),
    /// Make the tables and figures of van Dokkum et al. (2018) again
    ///
    /// The paper: van Dokkum, Khajeh Salehani, Irani & Nicola, Tribol. Lett. 66:115 (2018). Each figure comes as a CSV of every
    /// solved point, SVG, PNG and a recording; comparison.csv holds the final table. Started again after it was killed it goes
    /// on where it was, and the CSV is the same to the last bit. With other Hurst exponents, seeds, loads and sizes the same
    /// command makes a study of your own. Lengths are those of the paper: a roll-off of 20 um, of which 8 fit a line and 4 a side
    /// of a surface.
    Paper(Box<paper::PaperCommand>),
    /// Solve a contact under a load, or under one after the other
    Solve(Box<solve::Solve>),
    /// Solve stiff and extreme cases and check the results
    Stability(stability::Stability),
    /// Solve a study: a scene with lists in it, on one machine or on many
    ///
    /// Each choice from the lists is a realisation, which is solved under all loads one after the other. Started again after it was killed, a study goes
    /// on where it was. The numbers are the same to the last bit on any number of threads and however the study is cut into shares.
    Study(Box<study::Study>),
    /// Make a surface, or describe one
    Surface(Box<surface::Describe>),
    /// Open a recording in the browser, or several over each other
    #[cfg(feature = "explore")]
    #[command(after_help = "Examples:\n  asperity view demo.rrd\n  asperity view demo.rrd --port 9000 --no-open")]
    View(view::View),
}

/// Runs the command that some words ask for, of which the first is the name of the program, and returns its exit code. Help, and words
/// that are not understood, end the process.
pub fn run(words: impl IntoIterator<Item = OsString>) -> u8 {
    match carry_out(Cli::parse_from(words)) {
        Ok(outcome) => outcome.exit_code(),
        Err(error) if is_unheard(&error) => ExitStatus::Done.exit_code(),
        Err(error) => {
            writeln!(stderr(), "error: {error}{}", remedy(&error)).ok();
            exit_code(&error)
        }
    }
}

/// Whether an error is that the reader of the output has gone, as `head` does once it has its lines.
fn is_unheard(error: &anyhow::Error) -> bool {
    error.downcast_ref::<io::Error>().is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
}

fn carry_out(Cli { command, manners }: Cli) -> anyhow::Result<ExitStatus> {
    manners.keep()?;
    match command {
        Command::Accuracy(accuracy) => accuracy.run(),
        Command::Bench(bench) => bench.run(),
        Command::Certify(certify) => certify.run(),
        #[cfg(feature = "record")]
        Command::Compare(compare) => compare.run(),
        Command::Completions(completions) => completions.run(Cli::command()),
        #[cfg(feature = "record")]
        Command::Demo(demo) => demo.run(),
        #[cfg(feature = "explore")]
        Command::Explore(explore) => explore.run(),
        Command::Inspect(inspect) => inspect.run(),
        Command::Man(man) => man.run(Cli::command()),
        Command::Merge(merge) => merge.run(),
        Command::Paper(paper) => paper.run(),
        Command::Solve(solve) => solve.run(),
        Command::Stability(stability) => stability.run(),
        Command::Study(study) => study.run(),
        Command::Surface(describe) => describe.run(),
        #[cfg(feature = "explore")]
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
