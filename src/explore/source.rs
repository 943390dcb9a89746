//! Surfaces from outside the knobs: the heights of a file, or the scene of a setup.

use super::refusal::Refusal;
use super::schema::MOST_POINTS;
use crate::digest::fnv1a;
use crate::formats::HeightFile;
use crate::setup::Setup;
use std::sync::Arc;

/// What a surface is taken from that the knobs do not make.
#[derive(Clone)]
pub enum SurfaceSource {
    /// Heights that were measured.
    Heights(HeightFile),
    /// Surface, cell, solid and law of a setup.
    Scene(Arc<SceneFile>),
}

/// A setup whose surface, cell, solid and law a page takes, while its load, solver and recording are turned.
pub struct SceneFile {
    /// The setup.
    pub setup: Setup,
    /// The mark by which states of the page say which scene they are for.
    pub mark: String,
}

impl SceneFile {
    /// The scene of a setup, bounded like all surfaces of the page.
    ///
    /// # Errors
    /// For a setup that cannot be solved, and for one of too many points.
    pub fn new(setup: Setup) -> Result<Self, Refusal> {
        let grid = setup.check()?;
        let (most, [ny, nx]) = (MOST_POINTS[usize::from(!grid.is_line())], grid.shape());
        if grid.len() > most {
            let points = if grid.is_line() { nx.to_string() } else { format!("{ny} x {nx}") };
            return Err(format!("{points} points are too many for the page: give a scene of at most {most}").into());
        }
        let mark = format!("{:016x}", fnv1a([setup.to_toml().as_bytes()]));
        Ok(Self { setup, mark })
    }
}
