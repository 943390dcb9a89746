//! The cell: points and lengths along the axes of the arrays.

use super::one_or_more;
use crate::error::{ConflictRule, GridError, SetupError};
use crate::grid::Grid;
use serde::{Deserialize, Serialize};
use strum::{EnumIter, EnumMessage, IntoStaticStr};

/// The boundary of the cell along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, EnumIter, EnumMessage, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Boundary {
    /// The cell is repeated periodically.
    Periodic,
    /// The solid continues outside the cell, without pressure on it.
    Free,
}

/// Points and lengths along the axes of the arrays, in their order: one makes a line, two make a surface.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Cell {
    /// Points along the axes; empty if a height file has its own.
    #[serde(default, skip_serializing_if = "Vec::is_empty", with = "one_or_more")]
    pub points: Vec<usize>,
    /// Lengths along the axes; one value holds for all axes. Empty if a height file has its own. Lengths that are given
    /// with a height file are those of the whole file, before it is cropped or mirrored.
    #[serde(
        default,
        skip_serializing_if = "Vec::is_empty",
        serialize_with = "one_or_more::serialize",
        deserialize_with = "one_or_more::lengths"
    )]
    pub size: Vec<f64>,
    /// Refinement factor of the points, or of those of a height file, along each axis; 1 if it is left out. Heights of
    /// a file are interpolated; everything else is generated on the finer grid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub refine: Option<usize>,
    /// Boundaries along the axes; one value holds for all axes. Empty means periodic.
    #[serde(default, skip_serializing_if = "Vec::is_empty", with = "one_or_more")]
    pub boundary: Vec<Boundary>,
    /// If exactly one axis is free: the distance from a line load at which the displacement is zero, a length. The
    /// default is the length of the cell along this axis. See [`crate::elastic::ElasticSolid::datum`].
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "crate::quantity::some_length")]
    pub datum: Option<f64>,
}

impl Cell {
    /// The number that means automatic points along an axis.
    pub(super) const ANY: i64 = Grid::MIN_POINTS as i64;

    /// The cell of a line.
    pub fn line(points: usize, length: f64) -> Self {
        Self { points: vec![points], size: vec![length], refine: None, boundary: Vec::new(), datum: None }
    }

    /// The cell of a height file with points and lengths.
    pub fn file() -> Self {
        Self { points: Vec::new(), size: Vec::new(), refine: None, boundary: Vec::new(), datum: None }
    }

    /// The cell without images, free along all axes.
    pub fn free(self) -> Self {
        Self { boundary: vec![Boundary::Free], ..self }
    }

    /// The cell of a surface, points and lengths along y and x.
    pub fn surface(points: [usize; 2], size: [f64; 2]) -> Self {
        Self { points: points.into(), size: size.into(), refine: None, boundary: Vec::new(), datum: None }
    }

    /// Refinement factor along each axis.
    pub fn refine(&self) -> usize {
        self.refine.unwrap_or(1)
    }

    /// The grid.
    ///
    /// # Errors
    /// For missing points, too many of them, lengths that do not fit, and as [`Grid::line`] and [`Grid::surface`].
    pub fn grid(&self) -> Result<Grid, SetupError> {
        if self.points.is_empty() {
            return Err(ConflictRule::NoPoints.into());
        }
        if self.size.is_empty() {
            return Err(ConflictRule::NoSize.into());
        }
        self.grid_of(&self.points)
    }

    /// The grid of an array of some shape, refined; an array of one row is a line.
    pub(super) fn grid_of(&self, shape: &[usize]) -> Result<Grid, SetupError> {
        match self.refine() {
            0 => Err(ConflictRule::NoRefinement.into()),
            factor => Ok(self.unrefined(shape)?.refined(factor)?),
        }
    }

    /// The grid of an array of some shape.
    pub(super) fn unrefined(&self, shape: &[usize]) -> Result<Grid, SetupError> {
        let axes = shape.len();
        let along = |i: usize| -> Result<f64, SetupError> {
            match *self.size {
                [one] => Ok(one),
                _ if self.size.len() == axes => Ok(self.size[i]),
                _ => Err(SetupError::Sizes { sizes: self.size.len(), axes }),
            }
        };
        let grid: Result<Grid, GridError> = match *shape {
            [n] => Grid::line(n, along(0)?),
            [1, nx] => Grid::line(nx, along(1)?),
            [ny, nx] => Grid::surface([ny, nx], [along(0)?, along(1)?]),
            _ => return Err(SetupError::Axes { axes }),
        };
        let is_periodic = |i: usize| match *self.boundary {
            [] => Ok(true),
            [one] => Ok(one == Boundary::Periodic),
            _ if self.boundary.len() == axes => Ok(self.boundary[i] == Boundary::Periodic),
            _ => Err(SetupError::Boundaries { boundaries: self.boundary.len(), axes }),
        };
        let grid = grid?.with_periodic([is_periodic(0)?, is_periodic(axes - 1)?]);
        self.check_datum(&grid)?;
        Ok(grid)
    }

    /// Refuses a datum that no load of lines has, or that is so near that pressures beyond it would pull.
    fn check_datum(&self, grid: &Grid) -> Result<(), SetupError> {
        let Some(datum) = self.datum else { return Ok(()) };
        let free = (0..2).filter(|&axis| !grid.periodic()[axis]).map(|axis| grid.size()[axis]);
        let is_of_lines = grid.is_line() || grid.periodic() != [false; 2];
        match free.reduce(f64::max).filter(|_| is_of_lines) {
            None => Err(ConflictRule::DatumOfPeriodic.into()),
            Some(length) if datum.is_finite() && datum >= length => Ok(()),
            Some(length) => Err(SetupError::Datum { datum, length }),
        }
    }
}
