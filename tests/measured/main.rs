//! Files of instruments: what is read of them, and that none does harm.

mod truth;
