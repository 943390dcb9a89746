//! What the controls say, and the problem and solver that it stands for.

use crate::contact::{Dynamics, Gfmd, Load, Masses, Multilevel, PolonskyKeer, Problem, Solver, Stop};
use crate::error::{GridError, ProblemError, SettingError, SurfaceError};
use crate::grid::Grid;
use crate::record::{Part, Parts};
use crate::surface::{Indenter, Spectrum, Surface};
use crate::theory::Exact;
use serde::{Deserialize, Serialize};

/// Length of the cell (metres) and contact modulus (pascals): results depend only on ratios to them.
pub(super) const CELL: f64 = 160e-6;
pub(super) const MODULUS: f64 = 1e9;
/// Radius of the cylinder and the sphere: a slope of 5e-3 at the edge of the cell.
const RADIUS: f64 = 100.0 * CELL;
/// Amplitude of the waves.
const AMPLITUDE: f64 = 1e-3 * CELL;
/// The most points along a line, and along each side of a surface.
const MOST_POINTS: [usize; 2] = [1 << 18, 1 << 10];
/// The most steps of one solve.
const MOST_STEPS: usize = 100_000;
/// Loads that the slider spans.
const REDUCED_PRESSURES: std::ops::RangeInclusive<f64> = 1e-5..=1e3;

/// The state of the controls. Lengths are given in waves per cell, pressures as `p*`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Parameters {
    /// Line or surface.
    pub geometry: Geometry,
    /// What carries the roughness.
    pub shape: Shape,
    /// Exponent of the power law.
    pub exponent: f64,
    /// Rms gradient of the roughness; 0 for none.
    pub roughness: f64,
    /// Hurst exponent.
    pub hurst: f64,
    /// Waves per cell at the roll-off.
    pub rolloff: f64,
    /// Waves per cell at the short cut-off.
    pub cutoff: f64,
    /// Seed of the roughness.
    pub seed: u32,
    /// Points of the line, or along each side of the surface.
    pub points: usize,
    /// `p* = <p> / (gbar E*)`.
    pub load: f64,
    /// The solver.
    pub solver: Method,
    /// Masses of GFMD.
    pub masses: MassesOf,
    /// Dynamics of GFMD.
    pub dynamics: DynamicsOf,
    /// Time step of GFMD over its stability limit.
    pub time_step: f64,
    /// Friction of GFMD over the critical one of the slowest mode.
    pub damping: f64,
    /// Certificate to reach.
    pub tolerance: f64,
    /// Steps at the most.
    pub max_iterations: usize,
    /// What is recorded.
    pub record: Vec<PartOf>,
}

/// Line or surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Geometry {
    /// A line.
    Line,
    /// A surface.
    Surface,
}

/// What carries the roughness.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Shape {
    /// A cylinder on a line, a sphere on a surface.
    Round,
    /// A sine on a line, crossed sines on a surface.
    Sine,
    /// A power of the distance.
    PowerLaw,
    /// Nothing but the roughness.
    Flat,
}

/// A solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// [`Multilevel`].
    Multilevel,
    /// [`PolonskyKeer`].
    PolonskyKeer,
    /// [`Gfmd`].
    Gfmd,
}

/// Masses of the surface modes, see [`Masses`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MassesOf {
    /// The same for all modes.
    Uniform,
    /// Proportional to the stiffness of the mode.
    Stiffness,
}

/// How the motion is damped, see [`Dynamics`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DynamicsOf {
    /// Constant friction.
    Damped,
    /// Fast inertial relaxation.
    Fire,
}

/// A part of the recording, see [`Part`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PartOf {
    /// Numbers of every step.
    Traces,
    /// The profile of a line, the relief of a surface.
    Shape,
    /// Pressure and gap.
    Fields,
    /// The contact.
    Mask,
    /// Power spectra.
    Spectrum,
}

/// Parameters that stand for nothing, in one sentence.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct Refusal(pub String);

macro_rules! refuse {
    ($($error:ty),*) => { $(impl From<$error> for Refusal {
        fn from(error: $error) -> Self {
            Self(error.to_string())
        }
    })* };
}
refuse!(GridError, ProblemError, SettingError, SurfaceError, serde_json::Error);

/// Where the page starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Start {
    /// A smooth cylinder or sphere.
    Hertz(Geometry),
    /// Self-affine roughness.
    Rough(Geometry),
}

impl Start {
    /// The state of the controls.
    pub fn parameters(self) -> Parameters {
        let (geometry, shape, roughness) = match self {
            Self::Hertz(geometry) => (geometry, Shape::Round, 0.0),
            Self::Rough(geometry) => (geometry, Shape::Flat, 1e-3),
        };
        let (points, cutoff) = match geometry {
            Geometry::Line => (1 << 12, 128.0),
            Geometry::Surface => (1 << 8, 32.0),
        };
        Parameters {
            geometry,
            shape,
            exponent: 4.0,
            roughness,
            hurst: 0.8,
            rolloff: 4.0,
            cutoff,
            seed: 1,
            points,
            load: 0.05,
            solver: Method::Multilevel,
            masses: MassesOf::Uniform,
            dynamics: DynamicsOf::Damped,
            time_step: 0.5,
            damping: 1.0,
            tolerance: 1e-8,
            max_iterations: 20_000,
            record: vec![PartOf::Traces, PartOf::Shape, PartOf::Fields, PartOf::Mask],
        }
    }
}

impl Parameters {
    /// The parameters that `json` holds.
    ///
    /// # Errors
    /// A sentence on what is wrong with it.
    pub fn read(json: &[u8]) -> Result<Self, Refusal> {
        Ok(serde_json::from_slice(json)?)
    }

    /// Checks everything that can be checked without making the surface.
    ///
    /// # Errors
    /// A sentence with the value that cannot be and what to do.
    pub fn check(&self) -> Result<(), Refusal> {
        let grid = self.grid()?;
        if self.shape == Shape::Flat && self.roughness == 0.0 {
            let sentence = "a flat without roughness touches everywhere: raise the roughness or choose another shape";
            return Err(Refusal(sentence.into()));
        }
        if !(self.roughness >= 0.0 && self.roughness.is_finite()) {
            return Err(Refusal(format!("the roughness is {:?}: give 0 or more", self.roughness)));
        }
        if let Some(indenter) = self.indenter() {
            indenter.check(&grid)?;
        }
        if self.is_rough() {
            self.spectrum().validate(&grid)?;
        }
        if !REDUCED_PRESSURES.contains(&self.load) {
            let (low, high) = REDUCED_PRESSURES.into_inner();
            return Err(Refusal(format!("the load p* is {:?}: give {low:e} to {high:e}", self.load)));
        }
        self.solver()?;
        self.stop()?;
        Ok(())
    }

    /// The grid, not larger than can be solved while someone waits.
    fn grid(&self) -> Result<Grid, Refusal> {
        let [line, side] = MOST_POINTS;
        let most = if self.geometry == Geometry::Line { line } else { side };
        if self.points > most {
            return Err(Refusal(format!("{} points are too many here: give at most {most}", self.points)));
        }
        Ok(match self.geometry {
            Geometry::Line => Grid::line(self.points, CELL)?,
            Geometry::Surface => Grid::surface([self.points; 2], [CELL; 2])?,
        })
    }

    pub(super) fn is_rough(&self) -> bool {
        self.roughness > 0.0
    }

    pub(super) fn spectrum(&self) -> Spectrum {
        Spectrum {
            hurst: self.hurst,
            rolloff_wavelength: CELL / self.rolloff,
            short_cutoff: CELL / self.cutoff,
            rms_gradient: self.roughness,
        }
    }

    /// The smooth shape, if there is one.
    pub(super) fn indenter(&self) -> Option<Indenter> {
        let (is_line, half) = (self.geometry == Geometry::Line, 0.5 * CELL);
        match self.shape {
            Shape::Round if is_line => Some(Indenter::Cylinder { radius: RADIUS }),
            Shape::Round => Some(Indenter::Sphere { radius: RADIUS }),
            Shape::Sine if is_line => Some(Indenter::Sine { amplitude: AMPLITUDE }),
            Shape::Sine => Some(Indenter::CrossedSine { amplitude: AMPLITUDE }),
            Shape::PowerLaw => {
                let coefficient = half * half / (2.0 * RADIUS) / half.powf(self.exponent);
                Some(Indenter::PowerLaw { coefficient, exponent: self.exponent })
            }
            Shape::Flat => None,
        }
    }

    /// The surface.
    ///
    /// # Errors
    /// As [`Parameters::check`].
    pub fn surface(&self) -> Result<Surface, Refusal> {
        self.check()?;
        let grid = self.grid()?;
        let smooth = self.indenter().map(|indenter| indenter.surface(grid)).transpose()?;
        let roughness = || Surface::rough(grid, &self.spectrum(), self.seed.into());
        Ok(match smooth {
            Some(smooth) if self.is_rough() => smooth.plus(&roughness()?),
            Some(smooth) => smooth,
            None => roughness()?,
        })
    }

    /// The problem at the load given.
    ///
    /// # Errors
    /// As [`Parameters::check`].
    pub fn problem(&self) -> Result<Problem, Refusal> {
        Ok(Problem::at_reduced_pressure(self.surface()?, MODULUS, self.load)?)
    }

    /// The same problem at another load.
    ///
    /// # Errors
    /// For a load that cannot be.
    pub fn at_load(problem: Problem, reduced_pressure: f64) -> Result<Problem, Refusal> {
        let mean_pressure = reduced_pressure * problem.rms_gradient() * MODULUS;
        Ok(problem.with_load(Load::MeanPressure(mean_pressure))?)
    }

    /// The exact solution, where the shape is smooth and has one.
    pub fn exact(&self, problem: &Problem) -> Option<Exact> {
        let indenter = self.indenter().filter(|_| !self.is_rough())?;
        Exact::of(&indenter, problem.surface().grid(), MODULUS, problem.expected_mean_pressure())
    }

    /// The solver.
    ///
    /// # Errors
    /// For a setting outside its range.
    pub fn solver(&self) -> Result<Box<dyn Solver>, Refusal> {
        let masses = if self.masses == MassesOf::Uniform { Masses::Uniform } else { Masses::Stiffness };
        let dynamics = if self.dynamics == DynamicsOf::Damped { Dynamics::Damped } else { Dynamics::Fire };
        Ok(match self.solver {
            Method::Multilevel => Box::new(Multilevel),
            Method::PolonskyKeer => Box::new(PolonskyKeer),
            Method::Gfmd => Box::new(Gfmd::new(masses, dynamics, self.time_step, self.damping)?),
        })
    }

    /// When to stop.
    ///
    /// # Errors
    /// For a tolerance or a number of steps outside its range.
    pub fn stop(&self) -> Result<Stop, Refusal> {
        if self.max_iterations > MOST_STEPS {
            let sentence = format!("{} steps are too many here: give at most {MOST_STEPS}", self.max_iterations);
            return Err(Refusal(sentence));
        }
        Ok(Stop::new(self.tolerance, self.max_iterations)?)
    }

    /// What is recorded.
    pub fn parts(&self) -> Parts {
        let shape = if self.geometry == Geometry::Line { Part::Profile } else { Part::Mesh };
        let part = |part: &PartOf| match part {
            PartOf::Traces => Part::Traces,
            PartOf::Shape => shape,
            PartOf::Fields => Part::Fields,
            PartOf::Mask => Part::Mask,
            PartOf::Spectrum => Part::Spectrum,
        };
        self.record.iter().map(part).collect()
    }

    /// Axes of the arrays that are saved.
    pub fn rank(&self) -> usize {
        if self.geometry == Geometry::Line { 1 } else { 2 }
    }

    /// A name for people.
    pub fn title(&self) -> String {
        format!("{}, p* = {:.3e}", self.name(), self.load)
    }

    /// What is pressed, in a few words.
    pub fn name(&self) -> String {
        let name = match (self.indenter(), self.geometry) {
            (Some(indenter), _) => indenter.name(),
            (None, Geometry::Line) => "rough line",
            (None, Geometry::Surface) => "rough surface",
        };
        let rough = if self.is_rough() && self.shape != Shape::Flat { "rough " } else { "" };
        format!("{rough}{name}")
    }

    /// What the surface is, in words.
    pub fn description(&self) -> String {
        let spectrum = self.spectrum();
        let smooth = self.indenter().map(|indenter| indenter.name().to_owned());
        let rough = self.is_rough().then(|| {
            format!(
                "self-affine roughness, H = {}, roll-off {:.3e} m, short cut-off {:.3e} m, rms gradient {:e}",
                spectrum.hurst, spectrum.rolloff_wavelength, spectrum.short_cutoff, spectrum.rms_gradient
            )
        });
        smooth.into_iter().chain(rough).collect::<Vec<_>>().join(", with ")
    }
}
