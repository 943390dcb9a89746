//! Files of instruments: what is read of them, and that none does harm.

mod binaries;
mod contained;
mod containers;
mod exports;
mod made;
mod mutants;
mod texts;
mod truth;
