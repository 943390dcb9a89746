//! Rough contact: a rigid rough surface is pressed on an elastic solid. The contact is solved, certified and recorded step by step.
//!
//! New users start with the [`guide`]. This page is for readers of the code: it shows the path of the data, the modules, the conventions and the
//! invariants.
//!
//! # In one example
//! A [`setup::Setup`] describes a contact, and a [`job::Job`] solves it:
//!
//! ```
//! use asperity::contact::Load;
//! use asperity::job::Job;
//! use asperity::setup::{Cell, Recipe, Setup};
//! use asperity::surface::Spectrum;
//!
//! let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 20e-6, short_cutoff: 1e-6, rms_gradient: 1e-3 };
//! let setup = Setup::new(Recipe::rough(spectrum, 1), Cell::line(4096, 160e-6), Load::ReducedPressure(1e-2));
//! let outcome = Job::new(setup).run(&mut ())?;
//! let contact = &outcome.solved[0].contact;
//! assert!(contact.is_converged() && contact.certificate.eta <= 1e-8);
//! // van Dokkum et al. (2018) find 1.75 for rough lines
//! assert!((contact.resolved().kappa_r - 1.75).abs() < 0.2);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Bird's-eye view
//! The data flows one way, and the modules follow it:
//!
//! ```text
//! setup -> surface, solid, law, drive -> problem -> process -> state, state, ... -> sinks: recording, table, archive, picture, page, Python
//!   ^                                        |                       |
//!   |                                        solver -> observers     quantities -> study -> lab, paper
//!   +-------------------------- carried by every result ---------------------------------------------------+
//! ```
//!
//! - A [`contact::Problem`] is a problem of one contact: heights, a solid, a law of contact and a load. It is convex, but for contacts that slide or roll
//!   steadily, whose problem is monotone, and for those with adhesion.
//! - A [`contact::Solver`] solves it and shows each [`contact::Step`] to a [`contact::Observer`]. It does not know who observes.
//! - A [`Contact`] has pressure, displacement, gap, and the [`contact::Certificate`] that bounds its error.
//! - A [`history::Process`] makes one [`contact::State`] after the other, each from the last one: loads, creep, slip, sliding, rolling, adhesion, plastic flow. It goes along
//!   its path (`next`), or where it is moved (`move_to`).
//! - A [`contact::Quantity`] is a number that can be read of a state. There is one table of them; a number without a meaning is absent.
//! - A [`setup::StateSink`] receives states as they come. A run that is killed leaves those that it reached.
//! - A [`setup::Setup`] describes all of it in a form that can be written to a file and read back without loss.
//! - A [`job::Job`] runs a setup. The command line, the page, studies and Python call jobs, so that all of them do the same.
//!
//! # Modules
//! A module uses modules of its own layer and of lower layers, and there are no circles. The test binary `layers` checks this.
//!
//! | layer | module | content | feature |
//! |---|---|---|---|
//! | 0 | [`clock`] | the clock of solves, also in a browser | |
//! | 0 | [`error`] | what can go wrong, one enum for each concern | |
//! | 0 | [`sentence`] | sentences that keep their values: errors and warnings say them, and each front end in its own way | |
//! | 0 | [`warning`] | reasons to doubt a result, with what to do about them | |
//! | 0 | [`files`] | input files; output files that appear completely or not at all; CSV | |
//! | 0 | [`seen`] | text that can be shown on a terminal | |
//! | 0 | [`quantity`] | lengths and pressures with units | (`units`) |
//! | 1 | [`grid`] | grids of lines and surfaces, periodic or free along each axis | |
//! | 1 | [`fourier`] | pairs of real Fourier transforms | |
//! | 2 | [`formats`] | files of heights and fields, those of instruments among them: read and written | (`instruments`) |
//! | 2 | [`surface`] | indenters, random roughness, statistics; measured heights: described, prepared | |
//! | 2 | [`elastic`] | solids: half-space, layer, free boundaries; the stress in the solid, also by a plastic strain | |
//! | 2 | [`theory`] | closed forms: Hertz, Westergaard, power laws, Persson, Greenwood and Williamson, Bush, Gibson and Thomas | |
//! | 3 | [`contact`] | the problem, its certificate, solvers, observers, measures, and patches from state to state | |
//! | 4 | [`adhesion`] | contacts with an attraction between the surfaces: their states, and whether these are stable | |
//! | 4 | [`diagnosis`] | why a run was slow: nodes that change often, errors by wavelength, Ritz values | |
//! | 4 | [`flow`] | what flows through a contact: whether it seals, its leakage, its electrical and thermal conductance | |
//! | 4 | [`foreign`] | results and iterations of other programs: certified, compared, common mistakes recognised | |
//! | 4 | [`history`] | contacts one after the other: creep in time, partial slip, steady sliding and rolling, adhesion, plastic flow below the surface | |
//! | 4 | [`setup`] | the description of a contact, and its cost | (`units`) |
//! | 5 | [`study`] | many contacts in one table that an interrupted run continues | (`parquet`) |
//! | 5 | `plot` | figures as data, written as SVG and PNG | `figures` |
//! | 6 | `record` | an observer that writes recordings for the Rerun viewer | `record` |
//! | 7 | [`job`] | one run of a setup: cost, solve, record, diagnose, warn; saved results, certified again | |
//! | 8 | `lab` | experiments on the solvers: accuracy, stability, speed | `figures` |
//! | 8 | `paper` | the tables and figures of van Dokkum et al. (2018) | `figures` |
//! | 8 | `explore` | what the page in the browser does: knobs, lessons, and sessions that solve; it runs without a server too | `explore` |
//! | 9 | `serve` | the page on this machine with the viewer inside, and the page as a folder of files | `serve` |
//! | 10 | `cli` | the command line | `cli` |
//!
//! A feature in brackets extends a module. Without features the crate has the numerics and few dependencies. The Python package is a crate of its own
//! in the folder `python`, above all of these.
//!
//! # Where to start reading
//! - The convex problem and its bound: [`contact::Problem`], [`contact::Certificate`].
//! - The simplest complete solver: `examples/minimal_polonsky_keer.rs`. A solver outside the crate can do all that those of the crate do.
//! - What can be read of a state: [`contact::Quantity`]. A new quantity is one row of its table.
//! - How states follow each other: [`history::Process`]; the simplest one is [`history::Loading`].
//! - The drives, each declared in one file: [`setup::DRIVES`]. A new one is a file of its own and one line of this list.
//! - The keys of a scene with their flags, units and files: [`setup::Key::all`]. A new key is one row.
//!
//! # Conventions
//! - *Signs.* Heights `h` of the rigid surface are positive towards the solid. Pressure `p` is positive in compression. The displacement `u` of the surface of the solid is
//!   positive into the solid. The gap is `g = u - h + d` with a constant `d`.
//! - *Wavenumbers* are `q = 2 pi / wavelength`. A half-space responds by `u_q = 2 p_q / (E* |q|)`.
//! - *Fourier coefficients* are scaled so that the coefficient of `q = 0` is the mean.
//! - *Fields* have the shape `(ny, nx)`, row by row. A line has the shape `(1, n)`. Sizes and spacings are given as `[y, x]`.
//! - *Units.* Any consistent set of units works. Tolerances and certificates are dimensionless, and results do not change when lengths or moduli
//!   are scaled.
//!
//! # Invariants
//! - Results do not depend on the observers, and are the same to the last bit on any number of threads.
//! - A result states how good it is ([`contact::Certificate`]), what it cost ([`contact::Work`]) and how it ended ([`contact::Status`]). A contact
//!   is always returned, with the best pressure that was found. [`Contact::converged`] turns one that has not converged into an error.
//! - What is certified is computed in `f64`. Preconditioners and recordings may use `f32`.
//! - Random surfaces are made with ChaCha8 and are the same on every machine.
//! - There is no unsafe code, and no input can cause a panic.

// `pub` is for people outside the crate; what rooms share is `pub(crate)`.
#![warn(unreachable_pub)]

// The command line names the crate as its users do.
#[cfg(feature = "cli")]
extern crate self as asperity;

pub mod adhesion;
mod anderson;
mod chunks;
#[cfg(feature = "cli")]
pub mod cli;
pub mod clock;
pub mod contact;
pub mod diagnosis;
mod digest;
pub mod elastic;
pub mod error;
#[cfg(feature = "explore")]
pub mod explore;
pub mod files;
pub mod flow;
pub mod foreign;
mod forest;
pub mod formats;
pub mod fourier;
pub mod grid;
pub mod guide;
pub mod history;
pub mod job;
#[cfg(feature = "figures")]
pub mod lab;
mod memory;
#[cfg(feature = "figures")]
pub mod paper;
#[cfg(feature = "figures")]
pub mod plot;
pub mod quantity;
#[cfg(feature = "record")]
pub mod record;
pub mod seen;
pub mod sentence;
#[cfg(feature = "serve")]
pub mod serve;
pub mod setup;
pub mod study;
pub mod surface;
pub mod theory;
pub mod warning;

pub use contact::{Contact, Problem, Stop};
pub use grid::Grid;
pub use surface::{Indenter, Surface};

/// The Rust code of the README, which is tested with the documentation.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
