//! Rough contact: a rough surface pressed on an elastic solid, solved, certified and recorded step by step.
//!
//! The solid is a half-space or a layer ([`elastic`]), the boundary periodic or free along each axis ([`Grid`]), and the law a hard wall
//! or a hardness ([`contact::Law`]). All of these are convex, so that every result has a rigorous bound of its error.
//!
//! # How far is a pressure from the solution?
//! A [`contact::Certificate`] bounds the error of any pressure, whoever made it, by one transform pair:
//!
//! ```
//! use asperity::contact::{Certificate, ContactModulus, Load};
//! use asperity::theory::Exact;
//! use asperity::{Grid, Indenter, Problem};
//!
//! let (sine, mean_pressure) = (Indenter::Sine { amplitude: 0.01 }, 0.01);
//! let grid = Grid::line(1024, 1.0)?;
//! let problem = Problem::new(sine.surface(grid)?, ContactModulus(1.0), Load::MeanPressure(mean_pressure))?;
//!
//! // somebody's pressure, row by row: here that of Westergaard, whose edges fall between the nodes
//! let exact = Exact::of(&sine, &grid, 1.0, mean_pressure).expect("a sine has an exact solution");
//! let theirs: Vec<f64> = exact.pressure.into_iter().collect();
//! assert!(Certificate::of(&problem, &theirs).eta < 1e-3);
//! // a uniform pressure carries the load as well, but it is not the solution
//! assert!(Certificate::of(&problem, &[mean_pressure; 1024]).eta > 1.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # A rough line
//! A [`setup::Setup`] describes a contact to solve, in code or as a scene in a file:
//!
//! ```
//! use asperity::contact::{Load, Solver};
//! use asperity::setup::{Cell, Recipe, Setup};
//! use asperity::surface::Spectrum;
//!
//! let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 20e-6, short_cutoff: 1e-6, rms_gradient: 1e-3 };
//! let setup = Setup::new(Recipe::rough(spectrum, 1), Cell::line(4096, 160e-6), Load::ReducedPressure(1e-2));
//! let contact = setup.solver.solver().solve(&setup.problem()?, &setup.stop, &mut ())?.converged()?;
//! assert!(contact.certificate.eta <= 1e-8);
//! assert!((contact.measures().kappa_r - 1.75).abs() < 0.2);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Map
//! The path of the data is the layout of the crate:
//!
//! ```text
//! setup --> contact::Problem --> contact::Solver --(begin, each step, end)--> contact::Observer: record, your own
//!   ^                                   |
//!   |                                   v
//!   +------ carried by results --- contact::Contact --> contact::Measures --> study --> lab, paper, explore
//! ```
//!
//! A module uses those of lower layers and of its own, and nothing goes round in a circle.
//!
//! | layer | module       | what it holds                                                                     | feature   |
//! |-------|--------------|-----------------------------------------------------------------------------------|-----------|
//! | 0     | [`error`]    | what can go wrong, one enum per concern                                           |           |
//! | 0     | [`files`]    | output files that appear whole or not at all, CSV                                 |           |
//! | 0     | [`quantity`] | lengths and pressures as people write them                                        | (`units`) |
//! | 1     | [`grid`]     | the grid of lines and surfaces, periodic or free along each axis                  |           |
//! | 1     | [`fourier`]  | the real transform pair                                                           |           |
//! | 2     | [`surface`]  | indenters, self-affine roughness, statistics, measured heights: read, surveyed, prepared, written | (`instruments`) |
//! | 2     | [`elastic`]  | solids: half-space, layer, free boundaries; the stress inside                     |           |
//! | 2     | [`theory`]   | closed forms: Hertz, Westergaard, power laws, Persson, Greenwood-Williamson       |           |
//! | 3     | [`contact`]  | the problem, its certificate, solvers, observers, measures and patches            |           |
//! | 4     | [`diagnosis`] | what held a run up: nodes that flip, errors by wavelength, Ritz values, in words |           |
//! | 4     | [`foreign`]  | results and iterations of other codes: certified, mistakes recognised, replayed   |           |
//! | 4     | [`setup`]    | the one description of a contact to solve, and what it costs                      | (`units`) |
//! | 5     | [`study`]    | load curves, sweeps over surfaces and loads in tables that a killed run resumes, setups with lists for many machines | (`parquet`) |
//! | 5     | `plot`       | figures as data, written as SVG and PNG                                           | `figures` |
//! | 6     | `record`     | an observer that writes recordings for the Rerun viewer                           | `record`  |
//! | 7     | `lab`        | accuracy, stability and speed: experiments on the solvers themselves              | `figures` |
//! | 7     | `paper`      | the tables and figures of van Dokkum et al. (2018), with verdicts                 | `figures` |
//! | 7     | `explore`    | a page with controls and a live viewer                                            | `explore` |
//! | 8     | `cli`        | the command line                                                                  | `cli`     |
//!
//! Without features the crate is the numerics, with few dependencies. `units` adds lengths and pressures with units and scenes in
//! JSON, `instruments` the formats of measuring instruments that are packed, `parquet` that of tables. The folder `python` holds a package for Python, a crate of
//! its own above all of these.
//!
//! A solver outside the crate can do all that those of the crate do: `examples/minimal_polonsky_keer.rs` builds every
//! [`contact::Step`], leaves the bookkeeping to a [`contact::Run`], and is watched, certified and recorded.
//!
//! # Conventions
//! - Heights `h` of the rigid surface are positive towards the solid; pressure `p` is positive in compression; the
//!   displacement `u` of the solid's surface is positive into the solid; the gap is `g = u - h + d`.
//! - Wavenumbers are `q = 2 pi / wavelength`, everywhere. The half-space is `u_q = 2 p_q / (E* |q|)`; a layer has a factor on it.
//! - Fields have shape `(ny, nx)`, row by row; a line has shape `(1, n)`. Sizes and spacings come as `[y, x]`.
//! - Fourier coefficients are scaled so that the one of `q = 0` is the mean.
//! - Any consistent set of units will do. Tolerances and certificates are dimensionless.
//!
//! # Invariants
//! - Results do not depend on who watches, nor on the number of threads.
//! - A result states how good it is ([`contact::Certificate`]), what it cost ([`contact::Work`]) and how it ended
//!   ([`contact::Status`]). The contact always comes back with the best pressure found; [`Contact::converged`] makes an
//!   error of one that is not converged.
//! - Random surfaces come from ChaCha8 and are the same on every machine.

// the command line names the crate as everybody does who uses it
#[cfg(feature = "cli")]
extern crate self as asperity;

mod chunks;
#[cfg(feature = "cli")]
pub mod cli;
pub mod contact;
pub mod diagnosis;
pub mod elastic;
pub mod error;
#[cfg(feature = "explore")]
pub mod explore;
pub mod files;
pub mod foreign;
pub mod fourier;
pub mod grid;
pub mod guide;
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
pub mod warning;

pub use contact::{Contact, Problem, Stop};
pub use grid::Grid;
pub use surface::{Indenter, Surface};

/// The code of the README, tested.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
