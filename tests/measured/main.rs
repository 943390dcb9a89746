//! Files of instruments: what is read of them, and that none does harm.

mod contained;
mod mutants;
mod truth;
mod containers;
