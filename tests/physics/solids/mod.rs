//! Solids other than the periodic half-space, against closed forms, the equations of elasticity and a peer.

mod free;
mod layer;
mod peers;
mod stiffness;
