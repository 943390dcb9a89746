//! Steady sliding over viscoelastic solids.
