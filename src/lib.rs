//! Rough contact: a rigid rough surface pressed on an elastic half-space, solved and recorded step by step.
//!
//! # Map
//! The path of the data is the layout of the crate:
//!
//! ```text
//! surface --> contact::Problem --> contact::Solver --(every contact::Step)--> contact::Observer --> record
//!                                        |
//!                                        v
//!                                 contact::Contact --> contact::Measures --> study --> plot, record
//! ```
//!
//! | module      | what it holds                                                                        |
//! |-------------|--------------------------------------------------------------------------------------|
//! | [`files`]   | output files that appear whole or not at all, CSV                                    |
//! | [`grid`]    | the periodic grid of lines and surfaces                                              |
//! | [`fourier`] | the real transform pair                                                              |
//! | [`surface`] | indenters, self-affine roughness, statistics, files                                  |
//! | [`elastic`] | the half-space: compliance and stiffness                                             |
//! | [`theory`]  | closed forms: Hertz, Westergaard, power laws, Persson, Greenwood-Williamson          |
//! | [`contact`] | the problem, its solvers and their observers, the certificate, area and `kappa_r`    |
//! | [`study`]   | sweeps over surfaces and loads in tables that a killed run resumes, averages          |
//! | `plot`      | figures as data, written as SVG and PNG (feature `figures`)                          |
//! | `record`    | an observer that writes recordings for the Rerun viewer (feature `record`)           |
//! | `lab`       | accuracy, speed and stability of the solvers, measured (feature `figures`)           |
//! | `paper`     | the tables and figures of van Dokkum et al. (2018), made again (feature `figures`)   |
//! | `explore`   | a page with controls and a live viewer (feature `explore`)                           |
//!
//! # Conventions
//! - Heights `h` of the rigid surface are positive towards the solid; pressure `p` is positive in compression; the
//!   displacement `u` of the solid's surface is positive into the solid; the gap is `g = u - h + d`.
//! - Wavenumbers are `q = 2 pi / wavelength`, everywhere. The half-space is `u_q = 2 p_q / (E* |q|)`.
//! - Fields have shape `(ny, nx)`, row by row; a line has shape `(1, n)`. Sizes and spacings come as `[y, x]`.
//! - Fourier coefficients are scaled so that the one of `q = 0` is the mean.
//! - Any consistent set of units will do. Tolerances and certificates are dimensionless.
//!
//! # Invariants
//! - Results do not depend on who watches, nor on the number of threads.
//! - A result states how good it is ([`contact::Certificate`]), what it cost ([`contact::Work`]) and how it ended
//!   ([`contact::Status`]). Not converged is an error that carries the best state found.
//! - Random surfaces come from ChaCha8 and are the same on every machine.
//!
//! # Example
//! A rough line at one per cent reduced pressure:
//!
//! ```
//! use asperity::{Grid, Problem, Stop, Surface, contact::{PolonskyKeer, Solver}, surface::Spectrum};
//!
//! let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 20e-6, short_cutoff: 1e-6, rms_gradient: 1e-3 };
//! let surface = Surface::rough(Grid::line(4096, 160e-6)?, &spectrum, 1)?;
//! let problem = Problem::at_reduced_pressure(surface, 1.0, 1e-2)?;
//! let contact = PolonskyKeer.solve(&problem, &Stop::default(), &mut ())?;
//! let measures = contact.measures(&problem);
//! assert!(contact.certificate.eta <= 1e-8);
//! assert!((measures.kappa_r - 1.75).abs() < 0.2);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod chunks;
pub mod contact;
pub mod elastic;
pub mod error;
#[cfg(feature = "explore")]
pub mod explore;
pub mod files;
pub mod fourier;
pub mod grid;
#[cfg(feature = "figures")]
pub mod lab;
#[cfg(feature = "figures")]
pub mod paper;
#[cfg(feature = "figures")]
pub mod plot;
pub mod quantity;
#[cfg(feature = "record")]
pub mod record;
pub mod setup;
pub mod study;
pub mod surface;
pub mod theory;

pub use contact::{Contact, Problem, Stop};
pub use grid::Grid;
pub use surface::{Indenter, Surface};

/// The code of the README, tested.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
