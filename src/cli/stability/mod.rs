//! `asperity stability`: how the solvers bear stiff and extreme cases.

mod budget;
mod case;
mod cases;
mod check;
mod row;
mod table;
mod time_step;
mod trial;
mod verdict;

use super::contender::Contender;
use super::{Outcome, usage};
use anyhow::Result;
use asperity::files::{check_target, write_csv};
use case::Case;
use clap::Args;
use row::Row;
use std::io::{Write, stdout};
use std::path::PathBuf;
use std::time::Duration;
use table::{write_head, write_row};
use verdict::Verdict;

/// Seconds that a run gets if none are given.
const BUDGET: f64 = 20.0;
const QUICK_BUDGET: f64 = 0.5;

const COLUMNS: &str = "\
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
The budget of a run is kept by an observer that ends it after the step in which it runs out.

After them the largest stable time steps of molecular dynamics, found by bisection, beside theory.

Exit code 0 if nothing is WRONG, the multilevel solver does what every case demands, and the time steps are
those of theory; else 3.";

/// Solves stiff and extreme cases by every solver and checks what they return.
#[derive(Args)]
#[command(after_help = COLUMNS)]
pub struct Stability {
    /// Cases to run: all those whose name contains one of these [default: all]
    #[arg(value_name = "NAME")]
    names: Vec<String>,
    /// The methods [default: all but gfmd-uniform, which runs where stiffness matters]
    #[arg(long = "solver", value_enum, value_name = "NAME[,NAME]", value_delimiter = ',')]
    methods: Vec<Contender>,
    /// Seconds that each run may take [default: 20, quick: 0.5]
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
    /// Runs the command.
    pub fn run(&self) -> Result<Outcome> {
        let cases = self.cases()?;
        if self.list {
            return self.list(&cases);
        }
        let budget = self.budget()?;
        if let Some(path) = &self.out {
            check_target(path)?;
        }
        let mut rows = Vec::new();
        write_head(&mut stdout())?;
        for case in &cases {
            for &method in self.methods(case) {
                self.tell(trial::run(case, method, budget), &mut rows)?;
            }
        }
        let as_in_theory = !self.names.is_empty() || time_step::write_table(&mut stdout())?;
        conclude(&rows, as_in_theory)
    }

    /// The cases whose names were asked for.
    fn cases(&self) -> Result<Vec<Case>> {
        let mut cases = cases::all(self.quick);
        if let Some(unknown) = self.names.iter().find(|name| !cases.iter().any(|case| case.name.contains(*name))) {
            return usage(format!("no case has {unknown:?} in its name: see asperity stability --list"));
        }
        cases.retain(|case| self.names.is_empty() || self.names.iter().any(|name| case.name.contains(name)));
        Ok(cases)
    }

    fn methods<'a>(&'a self, case: &'a Case) -> &'a [Contender] {
        if self.methods.is_empty() { case.methods } else { &self.methods }
    }

    fn budget(&self) -> Result<Duration> {
        let seconds = self.budget.unwrap_or(if self.quick { QUICK_BUDGET } else { BUDGET });
        match Duration::try_from_secs_f64(seconds) {
            Ok(budget) if !budget.is_zero() => Ok(budget),
            _ => usage(format!("--budget is {seconds:?}: give a positive, finite number of seconds")),
        }
    }

    fn list(&self, cases: &[Case]) -> Result<Outcome> {
        for case in cases {
            let demand = |&method: &Contender| format!("{} {}", method.name(), case.demand_of(method).name());
            let demands: Vec<_> = self.methods(case).iter().map(demand).collect();
            writeln!(stdout(), "{:<28} {}", case.name, demands.join(", "))?;
        }
        Ok(Outcome::Done)
    }

    /// Prints a row and keeps it.
    fn tell(&self, row: Row, rows: &mut Vec<Row>) -> Result<()> {
        write_row(&row, &mut stdout())?;
        rows.push(row);
        if let Some(path) = &self.out {
            write_csv(path, &*rows)?;
        }
        Ok(())
    }
}

/// Says how it went.
fn conclude(rows: &[Row], as_in_theory: bool) -> Result<Outcome> {
    let count = |verdict| rows.iter().filter(|row| row.verdict == verdict).count();
    let failed = rows.iter().filter(|row| row.solver == Contender::Multilevel.name() && !row.as_demanded).count();
    let wrong = count(Verdict::Wrong);
    writeln!(
        stdout(),
        "\n{} runs: {} converged, {} refused, {} not converged, {wrong} wrong",
        rows.len(),
        count(Verdict::Converged),
        count(Verdict::Refused),
        count(Verdict::NotConverged)
    )?;
    if wrong == 0 && failed == 0 && as_in_theory {
        return Ok(Outcome::Done);
    }
    let steps = if as_in_theory { "" } else { ", and a time step is not what theory says" };
    writeln!(
        stdout(),
        "not stable: {wrong} runs are wrong, the multilevel solver misses the end of {failed} cases{steps}"
    )?;
    Ok(Outcome::NotConverged)
}
