//! Why a run took so many steps: the numbers of every step that show it, and the conclusions in words.
//!
//! ```text
//! Solver --(Step)--> Diagnosis: ContactHistory, Spectrogram, Ritz, Returns --> Cause, in words
//! ```
//!
//! A [`Diagnosis`] is an observer of any solver. Its findings depend on the steps only, not on the name of the solver.
//! Theory enters only through [`crate::contact::Solver::relaxation`].
//!
//! ```
//! use asperity::contact::{ContactModulus, Gfmd, Load, Solver};
//! use asperity::diagnosis::{Cause, Diagnosis};
//! use asperity::{Grid, Indenter, Problem, Stop};
//! let sine = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(256, 1.0)?)?;
//! let problem = Problem::new(sine, ContactModulus(1.0), Load::ReducedPressure(0.1))?;
//! // a friction that is fifty times too strong for the longest wave
//! let slow = Gfmd { damping: 50.0, ..Gfmd::default() };
//! let mut diagnosis = Diagnosis::new(&problem, None);
//! slow.solve(&problem, &Stop::default(), &mut diagnosis)?;
//! assert!(matches!(diagnosis.causes()[0], Cause::Damping { .. }));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bands;
mod cause;
mod contact_history;
mod curve;
mod diagnose;
mod history;
mod rates;
mod returns;
mod ritz;
mod spectrogram;

pub use bands::Bands;
pub use cause::Cause;
pub use contact_history::{ContactChange, ContactHistory};
pub use diagnose::{Diagnosis, Findings, Standing};
pub use history::History;
pub use rates::BandRate;
pub use ritz::Ritz;
pub use spectrogram::{Reference, Spectrogram, SpectrogramRow};
