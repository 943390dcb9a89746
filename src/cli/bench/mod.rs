//! `asperity bench`: how fast the solvers are.

mod case;
mod memory;
mod row;
mod table;

use super::method::Method;
use super::progress::Progress;
use super::{Outcome, usage};
use anyhow::Result;
use asperity::contact::{Solver, Status, Stop};
use asperity::error::SolveError;
use asperity::files::{check_target, write_csv};
use case::{Case, Group};
use clap::Args;
use memory::peak_of;
use row::{Row, Solved};
use std::io::{Write, stdout};
use std::path::PathBuf;
use std::time::Instant;
use table::{write_group, write_head, write_row};

const COLUMNS: &str = "\
Each row is one case solved by one solver:
  steps       iterations; for the multilevel solver outer and inner steps on all grids
  transforms  Fourier transforms; those of coarser grids count by their share of points
  solve s     seconds in the solver
  make s      seconds of making the surface and posing the problem
  eta         certificate
  area        relative contact area
  kappa_r     corrected for counting nodes
  MiB         peak of resident memory while the surface was made and solved (Linux; else -);
              what the allocator kept of earlier rows counts; with glibc, the environment
              MALLOC_MMAP_THRESHOLD_=131072 has it keep next to nothing
  ratio       solve s over that of the case's first solver (- for a case with one solver)";

/// Solves chosen cases one after the other and reports what that took.
#[derive(Args)]
#[command(after_help = COLUMNS)]
pub struct Bench {
    /// What to solve, in this order
    #[arg(value_enum, value_name = "GROUP", default_values_t = Group::USUAL)]
    groups: Vec<Group>,
    /// The methods, the first of which the others are held against [default: those of the group]
    #[arg(long = "solver", value_enum, value_name = "NAME[,NAME]", value_delimiter = ',')]
    methods: Vec<Method>,
    /// Certificate eta to reach [default: 1e-8, large: 1e-6]
    #[arg(long, value_name = "ETA", allow_negative_numbers = true)]
    tolerance: Option<f64>,
    /// Iterations at the most
    #[arg(long, value_name = "N", default_value_t = 100_000)]
    max_iterations: usize,
    /// Seed of the rough surfaces
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Solve each case so many times; the median of the seconds is reported
    #[arg(long, value_name = "N", default_value_t = 1)]
    repeats: usize,
    /// Shrink the grids: lines to 2^14 points, surfaces to 256^2, without the waves that are too short for them
    #[arg(long)]
    quick: bool,
    /// Write the rows in full precision, again after each one
    #[arg(long, value_name = "FILE.csv")]
    out: Option<PathBuf>,
    /// Print the cases instead of solving them
    #[arg(long, conflicts_with = "out")]
    list: bool,
}

impl Bench {
    /// Runs the command.
    pub fn run(&self) -> Result<Outcome> {
        if self.list {
            return self.list();
        }
        if self.repeats == 0 {
            return usage("--repeats is 0: give a positive number of solves");
        }
        let stops = self.groups.iter().map(|group| self.stop(*group)).collect::<Result<Vec<_>>>()?;
        if let Some(path) = &self.out {
            check_target(path)?;
        }
        let mut rows = Vec::new();
        write_head(&mut stdout())?;
        for (&group, stop) in self.groups.iter().zip(&stops) {
            write_group(group, self.quick, &mut stdout())?;
            for case in group.cases(self.quick) {
                self.compare(group, &case, stop, &mut rows)?;
            }
        }
        let all_converged = rows.iter().all(|row| row.status == Status::Converged);
        Ok(if all_converged { Outcome::Done } else { Outcome::NotConverged })
    }

    fn list(&self) -> Result<Outcome> {
        for &group in &self.groups {
            write_group(group, self.quick, &mut stdout())?;
            let solvers: Vec<_> = self.methods(group).iter().map(|method| method.solver().name()).collect();
            for case in group.cases(self.quick) {
                writeln!(stdout(), "{:<14} {:>11} {}", case.name, case.size, solvers.join(", "))?;
            }
        }
        Ok(Outcome::Done)
    }

    fn methods(&self, group: Group) -> &[Method] {
        if self.methods.is_empty() { group.methods() } else { &self.methods }
    }

    fn stop(&self, group: Group) -> Result<Stop> {
        Ok(Stop::new(self.tolerance.unwrap_or(group.tolerance()), self.max_iterations)?)
    }

    /// One case by all solvers; each row is told at once.
    fn compare(&self, group: Group, case: &Case, stop: &Stop, rows: &mut Vec<Row>) -> Result<()> {
        let methods = self.methods(group);
        let mut first = None;
        for method in methods {
            let mut row = self.measure(group, case, method.solver().as_ref(), stop)?;
            if methods.len() > 1 {
                let seconds = *first.get_or_insert(row.solve_seconds);
                row = row.against(seconds);
            }
            write_row(case, &row, &mut stdout())?;
            rows.push(row);
            if let Some(path) = &self.out {
                write_csv(path, &*rows)?;
            }
        }
        Ok(())
    }

    /// One case by one solver; all that was made is freed in the end.
    fn measure(&self, group: Group, case: &Case, solver: &dyn Solver, stop: &Stop) -> Result<Row> {
        let (solved, peak_mib) = peak_of(|| self.solve(case, solver, stop));
        Ok(Row::of(group, case, &solved?, peak_mib))
    }

    fn solve(&self, case: &Case, solver: &dyn Solver, stop: &Stop) -> Result<Solved> {
        let clock = Instant::now();
        let problem = case.problem(self.seed)?;
        let make_seconds = clock.elapsed().as_secs_f64();
        let mut solve_seconds = Vec::new();
        loop {
            let mut progress = Progress::new(stop.tolerance(), &format!("{} {}", case.name, case.size));
            let contact = solver.solve(&problem, stop, &mut progress).or_else(SolveError::into_contact)?;
            solve_seconds.push(contact.work.seconds);
            if solve_seconds.len() == self.repeats {
                return Ok(Solved { problem, make_seconds, contact, solve_seconds });
            }
        }
    }
}
