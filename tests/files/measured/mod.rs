//! Files of instruments: what is read of them, and that none does harm.

pub mod binaries;
mod channels;
mod contained;
pub mod containers;
mod doubts;
mod exports;
mod heads;
mod images;
mod made;
mod mutants;
mod probes;
mod texts;
mod truth;
