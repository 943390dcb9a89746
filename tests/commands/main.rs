//! The commands of the program, run as a user runs them.

mod accuracy;
mod bench;
mod certify;
mod cli;
#[path = "../common/command.rs"]
mod command;
mod doors;
mod drives;
mod golden;
mod guide;
mod histories;
mod inspect;
#[cfg(unix)]
mod interrupts;
#[allow(dead_code, reason = "the numerics compare more of a peer than certify does")]
#[path = "../common/peer.rs"]
mod peer;
mod reproduction;
mod rows;
mod stability;
mod yielding;
