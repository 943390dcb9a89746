//! The one description of a contact to solve: what is pressed, how hard, by which solver, and what is recorded of it.
//!
//! ```text
//! scene.toml, flags, a result --> Setup --> check, cost --> Problem, Solver
//!                                   ^                            |
//!                                   +----- carried by every result
//! ```
//!
//! A scene may hold a list of loads, `load.reduced-pressure = [1e-3, 1e-2]` or `"1e-3..1e-1:13"`: [`Table::take_loads`] takes it out
//! for [`crate::study::LoadCurve`], and what is left is a setup under the first one.
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
//! assert!((contact.measures().kappa_r / 1.47 - 1.0).abs() < 0.01);
//! assert_eq!(Setup::from_toml(&setup.to_toml())?, setup);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod auto;
mod cell;
mod command;
mod cost;
mod flag;
mod loads;
mod method;
mod one_or_more;
mod part;
mod recipe;
mod solid;
mod text;
mod theme;
mod words;

pub use auto::Auto;
pub use cell::Cell;
pub use command::{command, lay};
pub use cost::{Cost, available_bytes};
pub use flag::{FLAGS, Flag, Value};
pub use method::Method;
pub use part::{Part, Record};
pub use recipe::Recipe;
pub use solid::{Body, Solid};
pub use text::Table;
pub use theme::Theme;
pub use words::{differences, in_words};

use crate::contact::{ContactModulus, Law, Load, Problem, Stop};
use crate::error::{FileError, SetupError, SolveError};
use crate::grid::Grid;
use crate::surface::Surface;
use crate::theory::Exact;
use serde::{Deserialize, Serialize};

/// The description of a contact to solve.
///
/// | section   | holds                                                        | where it is left out            |
/// |-----------|--------------------------------------------------------------|---------------------------------|
/// | `surface` | a height file, an indenter, a spectrum, or a sum of them     | must be there                   |
/// | `grid`    | points and size of the cell                                  | must be there                   |
/// | `solid`   | the contact modulus, or Young's moduli and Poisson's ratios  | pressures are over the modulus  |
/// | `law`     | the hardness of the softer body, a pressure                  | elastic at any pressure         |
/// | `load`    | a mean pressure (of a `solid`), a reduced pressure, a mean gap | must be there                 |
/// | `solver`  | the method and its settings                                  | multilevel                      |
/// | `stop`    | certificate to reach, and iterations at the most             | 1e-8, 100 000                   |
/// | `record`  | parts and theme of a recording                               | the usual parts, dark           |
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Setup {
    /// Heights.
    pub surface: Recipe,
    /// Points and size.
    pub grid: Cell,
    /// The elastic half-space; without it pressures are over its contact modulus, and a mean pressure is no load.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub solid: Option<Solid>,
    /// What pressures are allowed.
    #[serde(default, skip_serializing_if = "Law::is_hard_wall")]
    pub law: Law,
    /// The load.
    pub load: Load,
    /// The solver with its settings.
    #[serde(default)]
    pub solver: Method,
    /// When the solver stops.
    #[serde(default)]
    pub stop: Stop,
    /// The recording, should one be made.
    #[serde(default)]
    pub record: Record,
}

impl Setup {
    /// The setup of a surface on a grid under a load: pressures over the modulus, the usual solver, stop and recording. Under a
    /// mean pressure it needs a solid as well, see [`Setup::on`].
    pub fn new(surface: Recipe, grid: Cell, load: Load) -> Self {
        let (solid, law, solver, stop, record) = Default::default();
        Self { surface, grid, solid, law, load, solver, stop, record }
    }

    /// The setup on a solid.
    pub fn on(self, solid: Solid) -> Self {
        Self { solid: Some(solid), ..self }
    }

    /// The contact modulus; 1 where no solid is given and pressures are over it.
    ///
    /// # Errors
    /// [`SetupError::NoModulus`] for a mean pressure on no solid, [`SetupError::Solid`] for elastic constants that no body has.
    pub fn contact_modulus(&self) -> Result<f64, SetupError> {
        match (&self.solid, self.load) {
            (Some(solid), _) => Ok(solid.contact_modulus()?),
            (None, Load::MeanPressure(value) | Load::Force(value)) => {
                Err(SetupError::NoModulus { load: self.load.name(), value })
            }
            (None, Load::ReducedPressure(_) | Load::MeanGap(_) | Load::Approach(_)) => Ok(1.0),
        }
    }

    /// Checks all that can be checked without making the surface, and returns the grid. Of a height file only the header is
    /// read.
    ///
    /// # Errors
    /// For a grid, surface, solid, load, setting or recording that cannot be, and for a mean pressure without a solid.
    pub fn check(&self) -> Result<Grid, SetupError> {
        let grid = self.surface.grid(&self.grid)?;
        self.surface.check(&grid)?;
        self.solver.check()?;
        self.stop.check()?;
        self.record.check(&grid)?;
        self.contact_modulus()?;
        if matches!(self.load, Load::MeanGap(_)) && !self.solver.takes_mean_gap() {
            return Err(SolveError::NeedsPressure { solver: self.solver.name().into() }.into());
        }
        if !(self.law.is_hard_wall() || self.solver.takes_hardness()) {
            return Err(SolveError::NeedsHardWall { solver: self.solver.name().into() }.into());
        }
        Ok(grid)
    }

    /// The surface.
    ///
    /// # Errors
    /// The errors of [`Setup::check`], and for a height file that cannot be read.
    pub fn surface(&self) -> Result<Surface, SetupError> {
        self.surface.surface(self.check()?)
    }

    /// The problem.
    ///
    /// # Errors
    /// The errors of [`Setup::surface`], of [`Problem::new`] and of [`Problem::with_law`].
    pub fn problem(&self) -> Result<Problem, SetupError> {
        let problem = Problem::new(self.surface()?, ContactModulus(self.contact_modulus()?), self.load)?;
        Ok(problem.with_law(self.law)?)
    }

    /// The exact solution under a mean pressure, where the surface is an indenter that has one and nothing
    /// yields.
    pub fn exact(&self, grid: &Grid, mean_pressure: f64) -> Option<Exact> {
        self.law.is_hard_wall().then_some(())?;
        Exact::of(&self.surface.smooth()?, grid, self.contact_modulus().ok()?, mean_pressure)
    }

    /// Sixteen hexadecimal digits that tell setups apart whose contacts differ under the same load: by all that is in them but
    /// the load and the recording, and by the bytes of a height file in place of its name.
    ///
    /// # Errors
    /// For a height file that cannot be read.
    pub fn fingerprint(&self) -> Result<String, SetupError> {
        let mut rest = Self { load: Load::ReducedPressure(1.0), record: Record::default(), ..self.clone() };
        let bytes = match rest.surface.height.take() {
            Some(path) => std::fs::read(&path).map_err(|source| FileError::Read { path, source })?,
            None => Vec::new(),
        };
        Ok(format!("{:016x}", fnv1a([rest.to_toml().as_bytes(), &bytes])))
    }
}

/// The hash FNV-1a of some bytes, the same on every machine.
pub(crate) fn fnv1a<'a>(bytes: impl IntoIterator<Item = &'a [u8]>) -> u64 {
    let next = |hash: u64, &byte: &u8| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
    bytes.into_iter().flatten().fold(0xcbf2_9ce4_8422_2325, next)
}
