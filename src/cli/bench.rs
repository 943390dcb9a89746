//! `asperity bench`: how fast the solvers are.

use super::choice::{choice, count};
use super::exit_status::{ExitStatus, usage};
use super::progress::bar;
use super::terminal::stdout;
use super::wrote::wrote;
use anyhow::Result;
use asperity::contact::{Status, Stop};
use asperity::files::{check_named, write_csv};
use asperity::lab::bench::{
    Contest, Group, HEAD, HISTORY_HEAD, HistoryContest, HistoryTiming, PEER_HEAD, PeerTiming, Python, Timing,
};
use asperity::plot::write_svg;
use asperity::setup::Method;
use clap::builder::PossibleValue;
use clap::{Args, ValueEnum};
use serde::Serialize;
use std::fmt::Display;
use std::io::Write;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::time::Duration;

const HELP: &str = "\
Examples:
  asperity bench lines --quick
  asperity bench large --solver multilevel --out large.csv

Each row is one case solved by one solver:
  steps       iterations; for multilevel, outer and inner steps on all grids
  transforms  Fourier transforms; a transform on a coarser grid counts in proportion to its points
  solve s     time of the solver, in seconds
  make s      time to generate the surface and set up the problem, in seconds
  eta         certificate
  meas        time to measure the contact with resolved edges, in per cent of solve s
  kappa_r     with resolved edges
  MiB         peak resident memory of surface and solve (Linux only; else -);
              includes memory that the allocator kept from earlier rows; with glibc, set the
              environment variable MALLOC_MMAP_THRESHOLD_=131072 to avoid this
  ratio       solve s divided by that of the first solver of the case (- for a single solver)

The group rivals is run alone. Each row is one case solved by one code on one thread or on all threads. All codes get the same
heights, load and tolerance; this program judges all pressures:
  seconds     of the solve alone
  eta         certificate of the pressure; (!) ends a row in which it is above the tolerance
  ratio       seconds divided by those of this program
The other codes are those that the interpreter finds: tamaas, ContactMechanics and aspher; aspher-mixed is aspher that begins in
single precision. A code that is missing is skipped. --max-iterations holds for this program only.

The group histories is run alone, too. Each row is one history of a rough surface by one code. The other code runs once and gets
the same tolerance, in its own sense: tamaas for creep under a held load, Adhesion for mean gaps down and up with an attraction,
aspher for pulls with friction under a load that grows, which gets 1e-5 for the traction:
  error       difference of the traction at the end from that of this program, root mean square, relative; for creep this
              program takes 320 steps for it, otherwise the tolerance 1e-11";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Bench {
    /// Groups of cases to solve, in the given order
    #[arg(value_enum, value_name = "GROUP", default_values_t = Group::USUAL)]
    groups: Vec<Group>,
    /// Solvers; the others are compared with the first [default: depends on the group]
    #[arg(long = "solver", value_parser = choice::<Method>(), value_name = "NAME[,NAME]", value_delimiter = ',')]
    methods: Vec<Method>,
    /// Certificate eta to reach [default: 1e-8, large: 1e-6]
    #[arg(long, value_name = "ETA")]
    tolerance: Option<f64>,
    /// Largest number of iterations
    #[arg(long, value_name = "N", default_value_t = 100_000)]
    max_iterations: usize,
    /// Seed of the rough surfaces
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Solve each case N times; the median time is reported
    #[arg(long, value_name = "N", default_value = "1", value_parser = count)]
    repeats: NonZeroUsize,
    /// Use smaller grids: lines of 2^14 points, surfaces of 256^2 (histories: 128^2), without the wavelengths that are too short for them
    #[arg(long)]
    quick: bool,
    /// Write the rows in full precision; the file is updated after each row, or in the group rivals after each case
    #[arg(long, value_name = "FILE.csv")]
    out: Option<PathBuf>,
    /// Groups rivals and histories: interpreter with the other codes
    #[arg(long, value_name = "PROGRAM", default_value = "python3")]
    python: PathBuf,
    /// Groups rivals and histories: largest time of a run of another code, in seconds, with the start of the interpreter
    #[arg(long, value_name = "S", default_value = "120", value_parser = count)]
    time_limit: NonZeroUsize,
    /// Draw certificates against seconds (group rivals) or seconds against the contact area (group contact)
    #[arg(long, value_name = "FILE.svg")]
    figure: Option<PathBuf>,
    /// Print the cases instead of solving them
    #[arg(long, conflicts_with = "out")]
    list: bool,
}

impl Bench {
    pub(crate) fn run(&self) -> Result<ExitStatus> {
        if self.list {
            return self.list();
        }
        let stops = self.groups.iter().map(|group| self.stop(*group)).collect::<Result<Vec<_>>>()?;
        if let Some(path) = &self.out {
            check_named(path, &["csv"])?;
        }
        if self.groups.contains(&Group::Histories) {
            return self.histories();
        }
        if self.groups.contains(&Group::Rivals) {
            return self.rivals();
        }
        if let Some(path) = &self.figure {
            if self.groups != [Group::Contact] {
                return usage(
                    "--figure is drawn of the groups rivals and contact: name one of them alone, or leave the option out",
                );
            }
            check_named(path, &["svg"])?;
        }
        let mut timings = Vec::new();
        writeln!(stdout(), "{HEAD}")?;
        for (&group, &stop) in self.groups.iter().zip(&stops) {
            writeln!(stdout(), "\n{}", self.title(group))?;
            for contest in Contest::all(group, self.quick, self.seed) {
                for timing in Timing::all(&contest, self.methods(group), stop, self.repeats, bar) {
                    timings.push(timing?);
                    writeln!(stdout(), "{}", timings[timings.len() - 1])?;
                    if let Some(path) = &self.out {
                        write_csv(path, &timings)?;
                    }
                    if let Some(path) = &self.figure {
                        write_svg(path, &Timing::figure(&timings))?;
                    }
                }
            }
        }
        [&self.out, &self.figure].into_iter().flatten().for_each(|path| wrote(path));
        let all_converged = timings.iter().all(|timing| timing.status == Status::Converged);
        Ok(if all_converged { ExitStatus::Done } else { ExitStatus::NotConverged })
    }

    /// This code beside others.
    fn rivals(&self) -> Result<ExitStatus> {
        if self.groups.len() > 1 || !self.methods.is_empty() {
            return usage("the group rivals has other columns and its own codes: name it alone, and without --solver");
        }
        if let Some(path) = &self.figure {
            check_named(path, &["svg"])?;
        }
        let (python, stop) = (self.interpreter(), self.stop(Group::Rivals)?);
        let mut rows = Vec::new();
        writeln!(stdout(), "{PEER_HEAD}\n\n{}", self.title(Group::Rivals))?;
        for contest in Contest::all(Group::Rivals, self.quick, self.seed) {
            self.show(&mut rows, |show| Ok(PeerTiming::all(&contest, &stop, self.repeats, &python, bar, show)?))?;
            if let Some(path) = &self.figure {
                write_svg(path, &PeerTiming::figure(&rows))?;
            }
        }
        [&self.out, &self.figure].into_iter().flatten().for_each(|path| wrote(path));
        let all_converged = !rows.iter().any(PeerTiming::is_own_failure);
        Ok(if all_converged { ExitStatus::Done } else { ExitStatus::NotConverged })
    }

    /// Prints the rows that `solve` tells as they come, keeps them, and writes all rows so far.
    fn show<Row: Display + Serialize>(
        &self,
        rows: &mut Vec<Row>,
        solve: impl FnOnce(&mut dyn FnMut(Row)) -> Result<()>,
    ) -> Result<()> {
        let mut written = Ok(());
        solve(&mut |row| {
            if written.is_ok() {
                written = writeln!(stdout(), "{row}");
            }
            rows.push(row);
        })?;
        written?;
        Ok(self.out.iter().try_for_each(|path| write_csv(path, &*rows))?)
    }

    /// The interpreter with the other codes.
    fn interpreter(&self) -> Python {
        Python { program: self.python.clone(), limit: Duration::from_secs(self.time_limit.get() as u64) }
    }

    /// Histories by this code beside another one.
    fn histories(&self) -> Result<ExitStatus> {
        if self.groups.len() > 1 || !self.methods.is_empty() || self.figure.is_some() {
            return usage(
                "the group histories has other columns and its own codes: name it alone, and without --solver and --figure",
            );
        }
        let (python, stop) = (self.interpreter(), self.stop(Group::Histories)?);
        let mut rows = Vec::new();
        writeln!(stdout(), "{HISTORY_HEAD}\n\n{}", self.title(Group::Histories))?;
        for contest in HistoryContest::all(self.quick, self.seed)? {
            self.show(&mut rows, |show| Ok(HistoryTiming::all(&contest, &stop, self.repeats, &python, show)?))?;
        }
        self.out.iter().for_each(|path| wrote(path));
        Ok(ExitStatus::Done)
    }

    fn list(&self) -> Result<ExitStatus> {
        for &group in &self.groups {
            writeln!(stdout(), "\n{}", self.title(group))?;
            if group == Group::Histories {
                for contest in HistoryContest::all(self.quick, self.seed)? {
                    writeln!(stdout(), "{}", contest.name())?;
                }
            }
            let solvers: Vec<_> = self.methods(group).iter().map(Method::name).collect();
            for contest in Contest::all(group, self.quick, self.seed) {
                writeln!(stdout(), "{:<14} {:>11} {}", contest.name, contest.points(), solvers.join(", "))?;
            }
        }
        Ok(ExitStatus::Done)
    }

    /// The name of a group and a short description.
    fn title(&self, group: Group) -> String {
        let shrunk = if self.quick { ", shrunk" } else { "" };
        let help = |value: &PossibleValue| value.get_help().cloned().unwrap_or_default();
        let words = |value: PossibleValue| format!("{}{shrunk}: {}", value.get_name(), help(&value));
        group.to_possible_value().map(words).unwrap_or_default()
    }

    fn methods(&self, group: Group) -> &[Method] {
        if self.methods.is_empty() { group.methods() } else { &self.methods }
    }

    fn stop(&self, group: Group) -> Result<Stop> {
        Ok(Stop::new(self.tolerance.unwrap_or(group.tolerance()), self.max_iterations)?)
    }
}
