//! The description of a contact to solve: surface, solid, load, solver and recording.
//!
//! ```text
//! scene.toml, flags, a result --> Setup --> check, cost --> Problem, Solver
//!                                   ^                            |
//!                                   +----- carried by every result
//! ```
//!
//! A scene may hold a list of loads, `load.reduced-pressure = [1e-3, 1e-2]` or `"1e-3..1e-1:13"`: these are [`Setup::loads`].
//! [`SetupTable::take_axes`] removes all other lists, for [`crate::study::Plan`].
//!
//! A setup is read from TOML, or from JSON with the feature `units`. Lengths and pressures are numbers in any consistent set of
//! units or, with that feature, texts such as `"160 um"` and `"1 GPa"`, which become metres and pascals. A setup that is written
//! and read again is the same to the last bit.
//!
//! ```
//! use asperity::contact::Solver;
//! use asperity::setup::Setup;
//! let setup = Setup::from_toml(
//!     r#"
//!     surface = { indenter = { shape = "cylinder", radius = 1.0 } }
//!     grid = { points = 1024, size = 4.0 }
//!     solid = { contact-modulus = 1.0 }
//!     load = { mean-pressure = 0.008 }
//!     "#,
//! )?;
//! let contact = setup.solver.solver().solve(&setup.problem()?, &setup.stop, &mut ())?.converged()?;
//! assert!((contact.resolved().kappa_r / 1.47 - 1.0).abs() < 0.01);
//! assert_eq!(Setup::from_toml(&setup.to_toml())?, setup);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod adhesion;
mod auto;
mod axis;
mod cell;
mod chosen;
mod command;
mod conflicts;
mod cost;
mod drive;
mod drives;
mod expected_area;
mod fault;
mod file_digests;
mod files;
mod flow;
mod idle;
mod ingredient;
mod ingredients;
mod key;
mod key_checks;
mod keys;
mod line;
mod loads;
mod method;
mod one_or_more;
mod part;
mod path;
mod path_table;
mod posed;
mod process;
mod range;
mod recipe;
mod sink;
mod solid;
mod text;
mod theme;
mod units;
mod viscoelastic;
mod warnings;
mod words;
mod yielding;

pub use crate::memory::{available_bytes, check_room};
pub use adhesion::Adhesion;
pub use auto::Auto;
pub use axis::{ParameterAxis, Scalar};
pub use cell::{Boundary, Cell};
pub use command::{command, lay};
pub use cost::{Cost, Extras};
pub use drive::{Drive, StateChart};
pub use drives::{DRIVES, LOADS};
pub use flow::{AxisFlow, Flow, FlowFound, warning_of_leakage};
pub use ingredient::Ingredient;
pub use key::{Choices, Dimension, FlagValue, Key, choices};
pub use method::Method;
pub use part::{Part, Record};
pub use path::LoadPath;
pub use posed::Posed;
pub use recipe::{Joined, Recipe};
pub use sink::StateSink;
pub use solid::{Body, LayerModulus, Solid};
pub use text::SetupTable;
pub use theme::Theme;
pub use viscoelastic::{RollingMotion, SlidingMotion, Viscoelastic};
pub use words::{differences, differences_of_tables, in_words};
pub use yielding::YieldLaw;

use crate::contact::{Friction, Law, Load, MonotoneSets, Problem, Solver, Stop};
use crate::digest::fnv1a;
use crate::elastic::{self, stress::is_known};
use crate::error::{ConflictRule, FlowError, ProblemError, SetupError, SolidError, SolveError};
use crate::grid::Grid;
use crate::surface::Surface;
use crate::theory::Exact;
use serde::{Deserialize, Serialize};
use std::sync::Arc;
use strum::IntoEnumIterator;

/// A reduced pressure for problems whose load is not used.
const ANY: f64 = 0.01;

/// The description of a contact to solve.
///
/// | section   | holds                                                        | where it is left out            |
/// |-----------|--------------------------------------------------------------|---------------------------------|
/// | `surface` | a height file, an indenter, a spectrum, or a sum of them     | must be there                   |
/// | `grid`    | points, size and boundary of the cell                        | must be there; periodic         |
/// | `solid`   | the contact modulus, or Young's moduli and Poisson's ratios; a layer; a yield stress | a half-space, pressures over its modulus |
/// | `law`     | the hardness of the softer body, a pressure                  | elastic at any pressure         |
/// | `load`    | a mean pressure or a force (of a `solid`), a reduced pressure, a mean gap, an approach | must be there |
/// | `friction` | a coefficient of friction and a tangential load            | none                            |
/// | `adhesion` | work of adhesion, range and form of the attraction          | none                            |
/// | `viscoelastic` | the terms of a solid that creeps                       | elastic at all times            |
/// | `path`    | times, loads and tangential loads of a history               | one contact, no history         |
/// | `sliding`, `rolling` | speeds; creepages or tangential loads             | a surface at rest               |
/// | `flow`    | whether the leakage is found; resistivities of the bodies for the conductance | neither |
/// | `solver`  | the method and its settings                                  | multilevel                      |
/// | `stop`    | certificate to reach, and largest number of iterations             | 1e-8, 100 000                   |
/// | `record`  | parts and theme of a recording                               | the usual parts, dark           |
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Setup {
    /// Heights.
    pub surface: Recipe,
    /// Points and size.
    pub grid: Cell,
    /// The elastic solid, a half-space or a layer. Without it, pressures are divided by the contact modulus, and a mean
    /// pressure is not allowed as a load.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub solid: Option<Solid>,
    /// The allowed pressures.
    #[serde(default, skip_serializing_if = "Law::is_hard_wall")]
    pub law: Law,
    /// The load; the first one of a list.
    pub load: Load,
    /// The loads of a list, which are applied one after the other; empty for one load. In a scene they stand in the section `load`.
    #[serde(skip)]
    pub loads: Vec<Load>,
    /// The tangential load that follows the normal one, and the friction that carries it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<Friction>,
    /// The attraction between surface and solid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub adhesion: Option<Adhesion>,
    /// The memory of a solid that creeps.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub viscoelastic: Option<Viscoelastic>,
    /// The path of a history.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub path: Option<LoadPath>,
    /// Steady sliding over a solid that creeps.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sliding: Option<SlidingMotion>,
    /// Steady rolling with friction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rolling: Option<RollingMotion>,
    /// What is found about the flow through the contact.
    #[serde(default, skip_serializing_if = "Flow::is_none")]
    pub flow: Flow,
    /// The solver with its settings.
    #[serde(default)]
    pub solver: Method,
    /// When the solver stops.
    #[serde(default)]
    pub stop: Stop,
    /// The recording, if one is made.
    #[serde(default)]
    pub record: Record,
}

impl Setup {
    /// The setup of a surface on a grid under a load, with the default solver, stop and recording. Pressures are
    /// divided by the modulus. A mean pressure also needs a solid, see [`Setup::on`].
    pub fn new(surface: Recipe, grid: Cell, load: Load) -> Self {
        let (solid, law, friction, solver, stop, record) = Default::default();
        let (adhesion, viscoelastic, path, sliding, rolling, flow) = Default::default();
        Self {
            surface,
            grid,
            solid,
            law,
            load,
            loads: Vec::new(),
            friction,
            adhesion,
            viscoelastic,
            path,
            sliding,
            rolling,
            flow,
            solver,
            stop,
            record,
        }
    }

    /// The setup on a solid.
    pub fn on(self, solid: Solid) -> Self {
        Self { solid: Some(solid), ..self }
    }

    /// The contact modulus; 1 if no solid is given.
    ///
    /// # Errors
    /// [`SetupError::NoModulus`] for a mean pressure on no solid, [`SetupError::Solid`] for elastic constants that no body has.
    pub fn contact_modulus(&self) -> Result<f64, SetupError> {
        match (&self.solid, self.load) {
            (Some(solid), _) if solid.has_modulus() => Ok(solid.contact_modulus()?),
            (_, Load::MeanPressure(value) | Load::Force(value)) => {
                Err(SetupError::NoModulus { load: self.load.name(), value })
            }
            (Some(solid), _) => Ok(solid.contact_modulus()?),
            (None, Load::ReducedPressure(_) | Load::MeanGap(_) | Load::Approach(_)) => Ok(1.0),
        }
    }

    /// The elastic solid; a half-space with modulus 1 if none is given.
    ///
    /// # Errors
    /// The errors of [`Setup::contact_modulus`].
    pub fn elastic(&self) -> Result<Arc<dyn elastic::ElasticSolid>, SetupError> {
        let solid = Solid::ContactModulus(self.contact_modulus()?);
        Ok(self.solid.clone().unwrap_or(solid).elastic(self.grid.datum)?)
    }

    /// Poisson's ratio of the elastic body, or of the first of two; none if only the contact modulus is known.
    pub fn poisson(&self) -> Option<f64> {
        self.solid.as_ref().and_then(Solid::poisson)
    }

    /// Checks everything that does not need the surface, and returns the grid. Only the header of a height file is
    /// read.
    ///
    /// # Errors
    /// For a grid, surface, solid, load, friction, setting or recording that cannot be, and for a mean pressure without a solid.
    pub fn check(&self) -> Result<Grid, SetupError> {
        let grid = self.surface.grid(&self.grid)?;
        self.surface.check(&grid)?;
        self.check_on(&grid)?;
        Ok(grid)
    }

    /// Checks everything except the surface, on a grid.
    ///
    /// # Errors
    /// The errors of [`Setup::check`] that do not concern the surface.
    pub fn check_on(&self, grid: &Grid) -> Result<(), SetupError> {
        self.solver.check()?;
        self.stop.check()?;
        self.record.check(grid)?;
        if self.record.what.iter().any(|part| part.is_stress()) {
            self.check_stress(grid)?;
        }
        self.elastic()?;
        self.friction.map_or(Ok(()), |friction| friction.check_coefficient())?;
        match self.drive()? {
            None => self.check_friction()?,
            Some(drive) => self.check_drive(drive, grid)?,
        }
        self.check_flow()?;
        if !self.load.is_pressure() && !self.solver.takes_mean_gap() {
            return Err(SolveError::NeedsPressure { solver: self.solver.name().into() }.into());
        }
        if !grid.is_periodic() && !self.solver.takes_free_boundary() {
            return Err(SolveError::NeedsWaves { solver: self.solver.name().into() }.into());
        }
        if !(self.law.is_hard_wall() || self.solver.takes_hardness()) {
            return Err(SolveError::NeedsHardWall { solver: self.solver.name().into() }.into());
        }
        Ok(())
    }

    /// Refuses the stress in a solid for which it cannot be computed.
    ///
    /// # Errors
    /// [`SolidError::NoStress`].
    pub fn check_stress(&self, grid: &Grid) -> Result<(), SetupError> {
        if is_known(grid, self.elastic()?.as_ref()) { Ok(()) } else { Err(SolidError::NoStress.into()) }
    }

    /// Refuses a flow that cannot be found.
    fn check_flow(&self) -> Result<(), SetupError> {
        if self.flow.is_none() {
            return Ok(());
        }
        let (conducts, solid) = (self.flow.resistivities()?.is_some(), self.elastic()?);
        Err(match () {
            () if conducts && (self.is_history()? || self.sliding.is_some()) => FlowError::NeedsRest,
            () if conducts && !solid.is_half_space() => FlowError::NeedsHalfSpace { solid: solid.description() },
            () => return Ok(()),
        }
        .into())
    }

    /// The parts that a recording shows: those that are named, or the usual ones, with the flow if the leakage is asked for.
    pub fn recorded_parts(&self) -> Vec<Part> {
        let usual = Part::iter().filter(|part| part.is_usual());
        match self.record.what.is_empty() {
            true => usual.chain(self.flow.leakage.then_some(Part::Flow)).collect(),
            false => self.record.what.clone(),
        }
    }

    /// Refuses a tangential load that friction cannot carry, and a tangential load with yielding, for which the
    /// difference of two contacts is not valid.
    fn check_friction(&self) -> Result<(), SetupError> {
        let Some(friction) = self.friction else { return Ok(()) };
        if friction.tangential == 0.0 {
            let given = [("tangential", friction.tangential.into())];
            return Err(ConflictRule::NoTangential.with(given).into());
        }
        friction.ratio(self.load)?;
        if self.law.is_hard_wall() { Ok(()) } else { Err(ConflictRule::FrictionOfYielding.into()) }
    }

    /// The surface.
    ///
    /// # Errors
    /// The errors of [`Setup::check`], and for a height file that cannot be read.
    pub fn surface(&self) -> Result<Surface, SetupError> {
        self.surface.surface(self.check()?)
    }

    /// The problem; that of a list of loads is under the largest of them.
    ///
    /// # Errors
    /// The errors of [`Setup::surface`], of [`Problem::new`] and of [`Problem::with_law`], under any of the loads.
    pub fn problem(&self) -> Result<Problem, SetupError> {
        self.problem_of(self.surface()?)
    }

    /// The problem of heights that are given, instead of those that the recipe makes.
    ///
    /// # Errors
    /// The errors of [`Setup::check`] that do not concern the surface, of [`Problem::new`] and of [`Problem::with_law`], under any of the loads.
    pub fn problem_of(&self, surface: impl Into<Arc<Surface>>) -> Result<Problem, SetupError> {
        let surface = surface.into();
        self.check_on(surface.grid())?;
        let first = self.problem_under_load(surface)?;
        let under = |load: &Load| first.clone().with_load(*load);
        let all = self.loads.iter().map(under).collect::<Result<Vec<_>, _>>()?;
        let heaviest = all.into_iter().max_by(|a, b| a.expected_mean_pressure().total_cmp(&b.expected_mean_pressure()));
        Ok(heaviest.unwrap_or(first))
    }

    /// The problem of some heights under the load.
    fn problem_under_load(&self, surface: Arc<Surface>) -> Result<Problem, SetupError> {
        // a history may begin with a load that no other contact has: a pull with adhesion, a gap or an approach at which nothing touches with creep
        let is_apart = matches!(self.load, Load::Approach(approach) if approach <= 0.0) && self.creeps();
        let load = if self.adhesion.is_some() || is_apart { Load::ReducedPressure(ANY) } else { self.load };
        let posed = match Problem::new(surface.clone(), self.elastic()?, load) {
            Err(ProblemError::NothingTouches { .. }) if self.creeps() => {
                Problem::new(surface, self.elastic()?, Load::ReducedPressure(ANY))
            }
            posed => posed,
        };
        let problem = posed?.with_law(self.law)?;
        match self.speed() {
            Some(speed) => Ok(problem.sliding(speed, &self.memory()?)?),
            None => Ok(problem),
        }
    }

    /// The solver: that of the section `solver`, or the one for contacts that slide.
    pub fn solver(&self) -> &dyn Solver {
        if self.sliding.is_some() { &MonotoneSets } else { self.solver.solver() }
    }

    /// The exact solution under a mean pressure, if the surface is an indenter with an exact solution and nothing
    /// yields.
    pub fn exact(&self, grid: &Grid, mean_pressure: f64) -> Option<Exact> {
        let is_at_rest = self.sliding.is_none() && self.is_history().is_ok_and(|is_history| !is_history);
        (self.law.is_hard_wall() && is_at_rest).then_some(())?;
        let solid = self.elastic().ok().filter(|solid| solid.is_half_space())?;
        Exact::new(&self.surface.smooth()?, grid, solid.contact_modulus(), mean_pressure)
    }

    /// Sixteen hexadecimal digits that identify all setups with the same contact under the same load. They depend on
    /// everything in the setup except the load, the friction and the recording, and on the contents of the files that it names in place of
    /// their names.
    ///
    /// # Errors
    /// For a file that cannot be read.
    pub fn fingerprint(&self) -> Result<String, SetupError> {
        let (load, record) = (Load::ReducedPressure(1.0), Record::default());
        let rest = Self { load, loads: Vec::new(), friction: None, record, ..self.clone() }.with_names_by_content()?;
        Ok(format!("{:016x}", fnv1a([rest.to_toml().as_bytes()])))
    }
}
