//! The parts of the numerics, each on its own.

mod certificate;
mod command;
mod files;
mod forecast;
mod fourier;
mod grid;
mod measures;
mod patches;
mod polonsky_keer;
#[cfg(feature = "units")]
mod quantity;
mod response;
mod results;
