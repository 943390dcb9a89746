//! Physics against closed forms, the equations of elasticity, a peer and a paper.

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/real_files.rs"]
mod real_files;

mod adhesion;
mod adhesion_loops;
mod adhesion_motion;
mod adhesion_rough;
mod adhesion_stiff;
mod artefacts;
mod creep;
mod depth;
mod direct_sum;
mod flow;
mod hardness;
mod measurement;
mod moments;
mod paper;
mod plastic;
mod preparation;
mod prony;
mod random;
mod rolling;
mod sampling;
mod sliding;
mod sliding_edges;
mod sliding_stability;
mod slip;
mod slip_coupling;
mod slip_history;
mod slip_paths;
mod slip_steps;
mod slip_vector;
mod solids;
mod stress;
mod surfaces;
mod survey;
mod texture;
mod theory;
mod uniform_mode;
mod units;
mod westergaard;
