//! The solver and its settings.

use anyhow::Result;
use asperity::Stop;
use asperity::contact::{Dynamics, Gfmd, Masses, PolonskyKeer, Solver};
use clap::{Args, ValueEnum};

/// The solver.
#[derive(Args)]
#[command(next_help_heading = "Solver")]
pub struct SolverArgs {
    /// The method
    #[arg(long, value_enum, default_value = "polonsky-keer")]
    solver: Method,
    /// Certificate eta to reach: error in energy over load times rms height
    #[arg(long, value_name = "ETA", default_value_t = 1e-8, allow_negative_numbers = true)]
    tolerance: f64,
    /// Iterations at the most
    #[arg(long, value_name = "N", default_value_t = 100_000)]
    max_iterations: usize,
    /// GFMD: masses of the surface modes
    #[arg(long, value_enum, default_value = "uniform")]
    masses: MassesArg,
    /// GFMD: damping of the motion
    #[arg(long, value_enum, default_value = "damped")]
    dynamics: DynamicsArg,
    /// GFMD: time step over the stability limit, in (0, 1)
    #[arg(long, value_name = "DT", default_value_t = 0.5, allow_negative_numbers = true)]
    time_step: f64,
    /// GFMD: friction over the critical one of the slowest mode
    #[arg(long, value_name = "C", default_value_t = 1.0, allow_negative_numbers = true)]
    damping: f64,
}

#[derive(Clone, Copy, ValueEnum)]
enum Method {
    /// Green's function molecular dynamics, the paper's method
    Gfmd,
    /// Constrained conjugate gradients
    PolonskyKeer,
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
        let masses = match self.masses {
            MassesArg::Uniform => Masses::Uniform,
            MassesArg::Stiffness => Masses::Stiffness,
        };
        let dynamics = match self.dynamics {
            DynamicsArg::Damped => Dynamics::Damped,
            DynamicsArg::Fire => Dynamics::Fire,
        };
        let gfmd = Gfmd::new(masses, dynamics, self.time_step, self.damping)?;
        Ok(match self.solver {
            Method::Gfmd => Box::new(gfmd),
            Method::PolonskyKeer => Box::new(PolonskyKeer),
        })
    }
}
