//! What flows through a contact: a fluid through the open area, current and heat through the contact.
//!
//! ```text
//! Contact --(mask)------> Percolation: does anything flow at all?
//!         --(gap)-------> Leakage: Reynolds' equation, with bounds of the flow
//!         --(stiffness)-> Conductance: electrical and thermal
//! Problem, Solver ------> PercolationLoad: the load at which nothing flows any more
//! ```
//!
//! Two things are not the same: [`Percolation`] looks at nodes with a pressure and nothing else, and [`Leakage`] at the gap of the others as well. Both
//! agree where all nodes without a pressure have a gap above zero.
//!
//! ```
//! use asperity::contact::{ContactModulus, Load, Multilevel, Solver};
//! use asperity::flow::{FlowAxis, Leakage, Percolation};
//! use asperity::{Grid, Problem, Stop, Surface, surface::Spectrum};
//! let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 0.06, rms_gradient: 1e-2 };
//! let surface = Surface::rough(Grid::surface([64, 64], [1.0, 1.0])?, &spectrum, 1)?;
//! let problem = Problem::new(surface, ContactModulus(1.0), Load::ReducedPressure(0.05))?;
//! let contact = Multilevel.solve(&problem, &Stop::default(), &mut ())?.converged()?;
//! assert!(Percolation::from_contact(&contact).open_percolates(FlowAxis::X));
//! let leakage = Leakage::from_contact(&contact, FlowAxis::X, 1e-6)?.converged()?;
//! // a rough gap leaks less than a plain one that is as wide on average
//! assert!(leakage.lower > 0.0 && leakage.upper < contact.mean_gap().powi(3));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod axis;
mod balance;
mod conductance;
mod cycle;
mod laplacian;
mod leakage;
mod network;
mod percolation;
mod percolation_load;
mod tree;

pub use axis::FlowAxis;
pub use conductance::Conductance;
pub use leakage::Leakage;
pub use percolation::Percolation;
pub use percolation_load::{PercolationLoad, PercolationState};
