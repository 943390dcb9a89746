//! Files that are read and written: heights, setups, studies, figures and recordings.

#[cfg(feature = "cli")]
#[path = "../common/command.rs"]
mod command;
#[cfg(feature = "figures")]
mod figures;
mod height_files;
#[cfg(feature = "cli")]
mod hostile_input;
#[cfg(all(feature = "cli", feature = "record"))]
mod kinds;
#[cfg(feature = "instruments")]
mod measured;
mod named_files;
#[path = "../common/real_files.rs"]
mod real_files;
#[cfg(all(feature = "cli", feature = "record"))]
mod recording;
#[cfg(feature = "instruments")]
mod saved;
mod setup;
mod setup_keys;
mod study;
#[cfg(all(unix, feature = "cli", feature = "record"))]
mod viewers;
