//! The solver and its settings.

use super::method::Method;
use super::usage;
use anyhow::Result;
use asperity::Stop;
use asperity::contact::{Dynamics, Gfmd, Masses, Solver};
use clap::{Args, ValueEnum};

/// The solver.
#[derive(Args)]
#[command(next_help_heading = "Solver")]
pub struct SolverArgs {
    /// The method
    #[arg(long, value_enum, default_value = "multilevel")]
    solver: Method,
    /// Certificate eta to reach: error in energy over load times rms height
    #[arg(long, value_name = "ETA", default_value_t = 1e-8, allow_negative_numbers = true)]
    tolerance: f64,
    /// Iterations at the most
    #[arg(long, value_name = "N", default_value_t = 100_000)]
    max_iterations: usize,
    /// GFMD: masses of the surface modes [default: uniform]
    #[arg(long, value_enum)]
    masses: Option<MassesArg>,
    /// GFMD: damping of the motion [default: damped]
    #[arg(long, value_enum)]
    dynamics: Option<DynamicsArg>,
    /// GFMD: time step over the stability limit, in (0, 1) [default: 0.5]
    #[arg(long, value_name = "DT", allow_negative_numbers = true)]
    time_step: Option<f64>,
    /// GFMD: friction over the critical one of the slowest mode [default: 1]
    #[arg(long, value_name = "C", allow_negative_numbers = true)]
    damping: Option<f64>,
}

#[derive(Clone, Copy, ValueEnum)]
enum MassesArg {
    /// The same for all modes
    Uniform,
    /// Proportional to the stiffness of the mode
    Stiffness,
}

#[derive(Clone, Copy, ValueEnum)]
enum DynamicsArg {
    /// Constant friction
    Damped,
    /// Fast inertial relaxation engine
    Fire,
}

impl SolverArgs {
    /// When to stop.
    pub fn stop(&self) -> Result<Stop> {
        Ok(Stop::new(self.tolerance, self.max_iterations)?)
    }

    /// The solver.
    pub fn solver(&self) -> Result<Box<dyn Solver>> {
        match self.solver {
            Method::Gfmd => self.gfmd(),
            _ if self.has_gfmd_settings() => {
                usage("--masses, --dynamics, --time-step and --damping go with --solver gfmd only")
            }
            method => Ok(method.solver()),
        }
    }

    /// The method.
    pub fn method(&self) -> Method {
        self.solver
    }

    /// Whether the solver works under a given mean pressure only.
    pub fn needs_pressure(&self) -> bool {
        matches!(self.solver, Method::Gfmd)
    }

    fn has_gfmd_settings(&self) -> bool {
        let Self { masses, dynamics, time_step, damping, .. } = self;
        masses.is_some() || dynamics.is_some() || time_step.is_some() || damping.is_some()
    }

    fn gfmd(&self) -> Result<Box<dyn Solver>> {
        let masses = match self.masses {
            None | Some(MassesArg::Uniform) => Masses::Uniform,
            Some(MassesArg::Stiffness) => Masses::Stiffness,
        };
        let dynamics = match self.dynamics {
            None | Some(DynamicsArg::Damped) => Dynamics::Damped,
            Some(DynamicsArg::Fire) => Dynamics::Fire,
        };
        let (time_step, damping) = (self.time_step.unwrap_or(0.5), self.damping.unwrap_or(1.0));
        Ok(Box::new(Gfmd::new(masses, dynamics, time_step, damping)?))
    }
}
