//! What a solve will take, said before it is started.

use super::memory;
use super::method::Method;
use asperity::Grid;
#[cfg(feature = "record")]
use asperity::Stop;
use asperity::contact::Multilevel;
#[cfg(feature = "record")]
use asperity::record::{Options, Size};
use libm::erf;
use std::io::{self, Write};

/// `kappa = a_rel / p*` of rough surfaces at small loads, as van Dokkum et al. (2018) find it; Persson's error function takes
/// it on to full contact.
const KAPPA: f64 = 2.2;

/// Steps of the multilevel solver on the finest grid, rather more than are usual.
#[cfg(feature = "record")]
const FINEST_STEPS: usize = 40;

/// What is known of a solve before its surface is made.
pub struct Plan {
    grid: Grid,
    method: Method,
    /// Share of the nodes in contact.
    contact: f64,
    outputs: Outputs,
}

/// What is written, as far as it takes memory.
pub struct Outputs {
    /// Whether the steps are recorded.
    pub recording: bool,
    /// Whether the fields are written.
    pub fields: bool,
}

impl Plan {
    /// A solve on `grid`; the reduced pressure is that of a rough surface, and without one all may touch.
    pub fn new(grid: Grid, method: Method, reduced_pressure: Option<f64>, outputs: Outputs) -> Self {
        let share = |pressure: f64| erf(0.5 * std::f64::consts::PI.sqrt() * KAPPA * pressure.max(0.0));
        Self { grid, method, contact: reduced_pressure.map_or(1.0, share), outputs }
    }

    /// Refuses a solve that cannot fit in memory, whatever touches.
    pub fn check(&self) -> anyhow::Result<()> {
        let name = self.method.solver().name();
        memory::check(&self.grid, name, memory::fields(self.method, &self.grid, 0.0))
    }

    /// Fields at the peak, as measured where there is a recording or an archive: a recording of the multilevel solver makes
    /// fields that others have at hand, and an archive is made in memory.
    fn fields(&self) -> f64 {
        let recorded = match self.method {
            _ if !self.outputs.recording => 0.0,
            Method::Multilevel => 4.0,
            Method::PolonskyKeer | Method::Gfmd => 2.0,
        };
        let solved = memory::fields(self.method, &self.grid, self.contact) + recorded;
        if self.outputs.fields { solved.max(9.5) } else { solved }
    }

    /// Coarse grids that the solver goes through.
    pub fn coarse_grids(&self) -> usize {
        match self.method {
            Method::Multilevel => Multilevel::coarse_grids(&self.grid),
            Method::PolonskyKeer | Method::Gfmd => 0,
        }
    }

    /// The grid.
    #[cfg(feature = "record")]
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Writes it for reading.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let points = points(self.grid.shape());
        writeln!(out, "Nothing is solved: this is what {} would take.", self.method.solver().name())?;
        writeln!(out, "  points      {points}")?;
        let halvings = self.coarse_grids();
        let coarsest = self.grid.shape().map(|n| (n >> halvings).max(1));
        match halvings {
            0 => writeln!(out, "  grids       1")?,
            _ => writeln!(out, "  grids       {}, from {} to {points}", halvings + 1, self::points(coarsest))?,
        }
        let needed = memory::bytes(self.fields(), &self.grid);
        let free =
            memory::available().map_or(String::new(), |free| format!(" of {} that are free", memory::words(free)));
        writeln!(out, "  memory      about {}{free}", memory::words(needed))?;
        match self.method {
            Method::Multilevel => writeln!(out, "  transforms  about 100, on any grid"),
            Method::PolonskyKeer => writeln!(out, "  transforms  two to four a step; finer grids take more steps"),
            Method::Gfmd => writeln!(out, "  transforms  two to four a step and some for certificates"),
        }
    }

    /// Writes how large the recording would become.
    #[cfg(feature = "record")]
    pub fn write_recording(&self, options: &Options, stop: &Stop, out: &mut impl Write) -> io::Result<()> {
        let size = Size::of(options.what, &self.grid);
        let numbers = memory::words(1e3 * size.step);
        let frame = memory::words(size.frame);
        let pictures = match options.every {
            Some(every) => format!("about {frame} for each frame, one in {every} steps"),
            None => {
                let steps = match self.method {
                    Method::Multilevel => FINEST_STEPS.min(stop.max_iterations()),
                    Method::PolonskyKeer | Method::Gfmd => stop.max_iterations(),
                };
                let frames = size.frames(steps, self.coarse_grids());
                let most = memory::words(size.still + frames as f64 * size.frame);
                format!("at most about {most}: {frames} frames of {frame}")
            }
        };
        match (size.frame > 0.0, size.step > 0.0) {
            (true, true) => writeln!(out, "  recording   {pictures}, and {numbers} for 1000 steps"),
            (true, false) => writeln!(out, "  recording   {pictures}"),
            _ => writeln!(out, "  recording   about {} and {numbers} for 1000 steps", memory::words(size.still)),
        }
    }
}

fn points([ny, nx]: [usize; 2]) -> String {
    if ny == 1 { nx.to_string() } else { format!("{ny} x {nx}") }
}
