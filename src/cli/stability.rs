//! `asperity stability`: how the solvers bear stiff and extreme cases.

use super::choice::one_of;
use super::exit_status::{ExitStatus, usage};
use super::progress::bar;
use super::wrote::wrote;
use anyhow::Result;
use asperity::files::{check_named, write_csv};
use asperity::lab::Rival;
use asperity::lab::stability::{HEAD, Kernel, Tally, TimeSteps, Trial, judge, trials};
use clap::Args;
use clap::builder::TypedValueParser;
use std::io::{Write, stdout};
use std::path::PathBuf;
use std::time::Duration;

const HELP: &str = "\
Examples:
  asperity stability --quick
  asperity stability punch --solver multilevel --out punch.csv

Each row is one case solved by one solver:
  steps    iterations; for the multilevel solver outer and inner steps on all grids
  seconds  in the solver
  eta      certificate, recomputed from the returned pressure by code that the solvers do not use
  verdict  converged      the solver says so, and the check agrees
           refused        with a clear sentence
           not converged  and it says so: out of budget, or no further progress
           WRONG          the solver and the check disagree; a NaN, a tension, a missed load, a panic:
                          must never happen
           A case that must come to another end than this has a ! before the verdict.
A case at a mean gap is solved again under the mean pressure that was found, and must open to the same gap; one in
unusual units is solved again in usual ones. Such a twin counts as the case does.
The check shares with the solvers the problem and the definition of the half-space, u_q = 2 p_q / (E* |q|).
The budget of a run is kept by an observer that ends it after the step in which it runs out.

After them what the check displaces, beside a sum over images in which nothing is periodic, and the largest
stable time steps of molecular dynamics, found by bisection, beside theory.

Exit code 0 if nothing is WRONG, every solver does what every case demands of it, the check displaces as the
images say, and the time steps are those of theory; else 3.";

/// One of the solvers.
fn rival() -> impl TypedValueParser<Value = Rival> {
    let rivals = one_of(Rival::ALL.map(|rival| (rival.name, rival.about)));
    rivals.try_map(|name| Rival::named(&name).ok_or("it has no meaning"))
}

#[derive(Args)]
#[command(after_help = HELP)]
pub struct Stability {
    /// Cases to run: all those whose name contains one of these [default: all]
    #[arg(value_name = "NAME")]
    names: Vec<String>,
    /// The methods [default: all but gfmd-uniform, which runs where stiffness matters]
    #[arg(long = "solver", value_parser = rival(), value_name = "NAME[,NAME]", value_delimiter = ',')]
    rivals: Vec<Rival>,
    /// Seconds that each run may take [default: 60, quick: 5]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    budget: Option<f64>,
    /// Shrink the grids and the budget
    #[arg(long)]
    quick: bool,
    /// Write the rows in full precision, again after each one
    #[arg(long, value_name = "FILE.csv")]
    out: Option<PathBuf>,
    /// Print the cases instead of solving them
    #[arg(long, conflicts_with = "out")]
    list: bool,
}

impl Stability {
    pub fn run(&self) -> Result<ExitStatus> {
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

    /// The trials whose names were asked for.
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
