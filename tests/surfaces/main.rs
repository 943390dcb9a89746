//! Surfaces: heights, indenters, random roughness and statistics.

mod heights;
mod indenter;
mod refine;
mod rough;
mod roughness;
mod seam;
mod spectrum;
