//! Surfaces: heights, indenters, random roughness and statistics.

mod bumps;
mod heights;
mod indenter;
mod refine;
mod rough;
mod roughness;
mod seam;
mod spectrum;
