//! `asperity stability`: the solvers on stiff and extreme cases.

use super::choice::one_of;
use super::exit_status::{ExitStatus, usage};
use super::progress::bar;
use super::terminal::stdout;
use super::wrote::wrote;
use anyhow::Result;
use asperity::files::{check_named, write_csv};
use asperity::lab::Rival;
use asperity::lab::stability::{HEAD, Kernel, Tally, TimeSteps, Trial, judge, trials};
use clap::Args;
use clap::builder::TypedValueParser;
use std::io::Write;
use std::path::PathBuf;
use std::time::Duration;

const HELP: &str = "\
Examples:
  asperity stability --quick
  asperity stability punch --solver multilevel --out punch.csv

Each row is one case solved by one solver:
  steps    iterations; for multilevel, outer and inner steps on all grids
  seconds  time of the solver
  eta      certificate, recomputed from the returned pressure with code that the solvers do not use
  verdict  converged      reported by the solver and confirmed by the check
           refused        the solver does not accept the case, and reports why
           not converged  reported as such: no time left, or no further progress
           WRONG          the solver and the check disagree; a NaN, tension, a wrong load or a panic:
                          this must never happen
           A ! before the verdict marks a case whose verdict is not the required one.
A case with a given mean gap is solved again with the mean pressure found, and must give the same gap; a case in
unusual units is solved again in usual ones. The second solve counts like the first.
The check shares only the problem and the half-space, u_q = 2 p_q / (E* |q|), with the solvers.
An observer stops a run after the step in which its time is used up.

At the end, the displacement of the check is compared with a sum over images that uses no periodicity, and the
largest stable time steps of molecular dynamics, found by bisection, with theory.

The exit code is 0 if nothing is WRONG, all verdicts are the required ones, and the two comparisons agree; otherwise
it is 3.";

/// One of the solvers.
fn rival() -> impl TypedValueParser<Value = Rival> {
    let rivals = one_of(Rival::ALL.map(|rival| (rival.name, rival.about)));
    rivals.try_map(|name| Rival::named(&name).ok_or("it has no meaning"))
}

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Stability {
    /// Cases to run: all those whose name contains one of these [default: all]
    #[arg(value_name = "NAME")]
    names: Vec<String>,
    /// Solvers [default: all except gfmd-uniform, which runs only in cases where its stiffness matters]
    #[arg(long = "solver", value_parser = rival(), value_name = "NAME[,NAME]", value_delimiter = ',')]
    rivals: Vec<Rival>,
    /// Time limit of each run in seconds [default: 60, quick: 5]
    #[arg(long, value_name = "SECONDS")]
    budget: Option<f64>,
    /// Use smaller grids and a shorter time limit
    #[arg(long)]
    quick: bool,
    /// Write the rows in full precision; the file is updated after each row
    #[arg(long, value_name = "FILE.csv")]
    out: Option<PathBuf>,
    /// Print the cases instead of solving them
    #[arg(long, conflicts_with = "out")]
    list: bool,
}

impl Stability {
    pub(crate) fn run(&self) -> Result<ExitStatus> {
        let trials = self.trials()?;
        if self.list {
            return self.list(&trials);
        }
        let budget = self.budget()?;
        if let Some(path) = &self.out {
            check_named(path, &["csv"])?;
        }
        let mut reports = Vec::new();
        writeln!(stdout(), "{HEAD}")?;
        for trial in &trials {
            for rival in self.rivals(trial) {
                reports.push(judge(trial, rival, budget, bar));
                writeln!(stdout(), "{}", reports[reports.len() - 1])?;
                if let Some(path) = &self.out {
                    write_csv(path, &reports)?;
                }
            }
        }
        let kernel = self.names.is_empty().then(Kernel::measure).transpose()?;
        kernel.iter().try_for_each(|kernel| write!(stdout(), "\n{kernel}"))?;
        let time_steps = self.names.is_empty().then(TimeSteps::measure).transpose()?;
        time_steps.iter().try_for_each(|time_steps| write!(stdout(), "\n{time_steps}"))?;
        let tally = Tally::new(&reports, kernel.as_ref(), time_steps.as_ref());
        writeln!(stdout(), "\n{tally}")?;
        self.out.iter().for_each(|path| wrote(path));
        Ok(if tally.is_stable() { ExitStatus::Done } else { ExitStatus::NotConverged })
    }

    /// The trials with the requested names.
    fn trials(&self) -> Result<Vec<Trial>> {
        let mut trials = trials(self.quick)?;
        if let Some(unknown) = self.names.iter().find(|name| !trials.iter().any(|trial| trial.name.contains(*name))) {
            return usage(format!("no case has {unknown:?} in its name: see asperity stability --list"));
        }
        trials.retain(|trial| self.names.is_empty() || self.names.iter().any(|name| trial.name.contains(name)));
        Ok(trials)
    }

    fn rivals<'a>(&'a self, trial: &'a Trial) -> &'a [Rival] {
        if self.rivals.is_empty() { trial.rivals } else { &self.rivals }
    }

    fn budget(&self) -> Result<Duration> {
        let seconds = self.budget.unwrap_or(if self.quick { 5.0 } else { 60.0 });
        match Duration::try_from_secs_f64(seconds) {
            Ok(budget) if !budget.is_zero() => Ok(budget),
            _ => usage(format!("--budget is {seconds:?}: give a positive, finite number of seconds")),
        }
    }

    fn list(&self, trials: &[Trial]) -> Result<ExitStatus> {
        for trial in trials {
            let demand = |rival: &Rival| format!("{} {}", rival.name, trial.demand_of(rival));
            let demands: Vec<_> = self.rivals(trial).iter().map(demand).collect();
            writeln!(stdout(), "{:<28} {}", trial.name, demands.join(", "))?;
        }
        Ok(ExitStatus::Done)
    }
}
