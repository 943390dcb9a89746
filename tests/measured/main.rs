//! Files of instruments: what is read of them, and that none does harm.

mod made;
mod mutants;
mod truth;
mod writers;
