//! Results and iterations of other codes: certified, recognised where they went wrong on their way, and replayed for observers.
//!
//! ```text
//! field + surface, solid, load --> Claim --> mistakes: everyday errors, recognised from the numbers
//!                                    |
//!                                    v
//! Steps: files of fields -----> Replay, a Solver --> Contact --> Assessment: what is wrong with it, and where
//! ```
//!
//! A result may be a pressure, a gap or a displacement, see [`GivenField`].
//!
//! ```
//! use asperity::contact::{ContactModulus, Load};
//! use asperity::foreign::{Claim, GivenField};
//! use asperity::theory::Exact;
//! use asperity::{Grid, Indenter};
//!
//! let (sine, grid) = (Indenter::Sine { amplitude: 0.01 }, Grid::line(1024, 1.0)?);
//! let (surface, exact) = (sine.surface(grid)?, Exact::new(&sine, &grid, 1.0, 0.01).expect("a sine has an exact solution"));
//! // somebody's pressures, written as forces of the nodes
//! let forces = exact.pressure * grid.spacing()[1];
//! let claim = Claim::new(surface, ContactModulus(1.0), Some(Load::MeanPressure(0.01)), GivenField::Pressure, &forces)?;
//! let mistakes = claim.mistakes(&[]);
//! assert!(mistakes[0].sentence.starts_with("the pressures are forces per unit width"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod arrangement;
mod assessment;
mod claim;
mod correction;
mod distance;
mod factor;
mod fault;
mod follow;
mod given_field;
mod mistake;
mod order;
mod replay;
mod steps;
mod tension;
mod wave_stiffness;

pub use assessment::{Assessment, Disagreement, Spot};
pub use claim::Claim;
pub use distance::{Distance, Distances};
pub use follow::Follow;
pub use given_field::GivenField;
pub use mistake::Mistake;
pub use replay::{Frame, Replay};
pub use steps::{Steps, step_files};
pub use tension::Tension;
