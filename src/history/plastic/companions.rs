//! Histories beside that of a solid that yields, from which its errors are estimated.

use super::{Plastic, PlasticErrorSources, PlasticErrors};
use crate::contact::{ContactModulus, Load, Problem};
use crate::error::PlasticError;
use crate::grid::Grid;
use crate::surface::{Field, Surface};
use ndarray::{Axis, Slice};

/// The fewest points along a side of a grid of half as many.
const FEWEST: usize = 8;

/// Three further histories under the same loads: one in steps of half the length, one in layers of twice the thickness, and one on a grid of half as many
/// points along each axis.
pub(super) struct Companions<'s> {
    steps: Plastic<'s>,
    layers: Plastic<'s>,
    /// None where a number of points is odd, or too small.
    grid: Option<Plastic<'s>>,
}

impl<'s> Companions<'s> {
    /// The companions of a process that has not begun.
    pub fn new(plastic: &Plastic<'s>) -> Result<Self, PlasticError> {
        if plastic.state().load.is_some() {
            return Err(PlasticError::HasBegun);
        }
        let (problem, layers) = (plastic.problem(), plastic.state().layers());
        let coarse = on_half_the_points(problem)?;
        Ok(Self {
            steps: plastic.like(problem.clone(), layers.clone())?,
            layers: plastic.like(problem.clone(), layers.doubled()?)?,
            grid: coarse.map(|problem| plastic.like(problem, layers.clone())).transpose()?,
        })
    }

    /// Goes to a load: in two steps, and in one.
    pub fn press(&mut self, load: Load) -> Result<(), PlasticError> {
        self.steps.press_in(2, load, &mut ())?;
        for plastic in [Some(&mut self.layers), self.grid.as_mut()].into_iter().flatten() {
            plastic.press(load, &mut ())?;
        }
        Ok(())
    }

    /// The errors of the process under the last load, whose state is that of `plastic`.
    pub fn errors(&self, plastic: &Plastic<'_>) -> PlasticErrorSources {
        let between = |other: &Plastic<'_>| PlasticErrors::between(plastic.state(), other.state());
        PlasticErrorSources {
            // an error of first order halves with the steps
            steps: between(&self.steps).times(2.0),
            // one of second order becomes four times as large with layers of twice the thickness
            layers: between(&self.layers).times(1.0 / 3.0),
            grid: self.grid.as_ref().map(between),
        }
    }
}

/// The problem with every second node along each axis; none where that is no grid of the same cell.
fn on_half_the_points(problem: &Problem) -> Result<Option<Problem>, PlasticError> {
    let grid = problem.surface().grid();
    let [ny, nx] = grid.shape();
    let is_half = |points: usize| points.is_multiple_of(2) && points >= 2 * FEWEST;
    if !(is_half(nx) && (grid.is_line() || is_half(ny))) {
        return Ok(None);
    }
    let coarse = match grid.is_line() {
        true => Grid::line(nx / 2, grid.size()[1]),
        false => Grid::surface([ny / 2, nx / 2], grid.size()),
    };
    let coarse = coarse.map_err(crate::error::SurfaceError::from)?;
    let every_second =
        |axis: Axis, field: &mut Field| *field = field.slice_axis(axis, Slice::new(0, None, 2)).to_owned();
    let mut height = problem.surface().height().clone();
    (0..2).for_each(|axis| every_second(Axis(axis), &mut height));
    let surface = Surface::new(coarse, height)?;
    Ok(Some(Problem::new(surface, ContactModulus(problem.contact_modulus()), problem.load())?))
}
