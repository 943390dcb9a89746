//! Heights that are offset, rough to the last node, steep, stepped, tied, or alone.

use super::shapes::{Grids, LOAD, noise, pressed, rough, rough_with, setup, shaped};
use crate::contact::Load;
use crate::error::SetupError;
use crate::grid::Grid;
use crate::lab::stability::trial::Trial;
use crate::setup::Recipe;
use crate::surface::{Indenter, Surface};

const PUNCH: Indenter = Indenter::Punch { half_width: 0.2, depth: 0.1 };

pub fn trials(grids: Grids) -> Vec<Trial> {
    let mut trials: Vec<Trial> = grids.named().into_iter().flat_map(|(kind, grid)| on(kind, grid)).collect();
    trials.extend(grids.named().map(|(kind, grid)| {
        Trial::of(format!("punch-{kind}"), setup(Recipe::indenter(PUNCH), grid, Load::MeanPressure(0.01)))
    }));
    trials.push(bowl("bowl-line", Indenter::Cylinder { radius: 1.0 }, grids.line));
    trials.push(bowl("bowl-surface", Indenter::Sphere { radius: 1.0 }, grids.surface));
    trials.extend([9e-3, 2e-2].map(lone_spike));
    trials
}

/// Trials of lines and surfaces alike.
fn on(kind: &str, grid: Grid) -> Vec<Trial> {
    let recipe = |name: &str, recipe| Trial::of(format!("{name}-{kind}"), setup(recipe, grid, LOAD));
    let made = |name: &str, surface: fn(Grid) -> Result<Surface, SetupError>| {
        Trial::new(format!("{name}-{kind}"), move || pressed(surface(grid)?, LOAD))
    };
    vec![
        made("offset-1e9", offset),
        recipe("hurst-0.01", rough_with(grid, 0.01, 2.0, 0.1)),
        recipe("hurst-1", rough_with(grid, 1.0, 2.0, 0.1)),
        made("white-noise", |grid| Ok(noise(grid)?)),
        recipe("slope-1e-9", rough_with(grid, 0.8, 8.0, 1e-9)),
        recipe("slope-1e3", rough_with(grid, 0.8, 8.0, 1e3)),
        made("plateaus", plateaus),
        made("two-peaks", two_peaks),
        made("comb", |grid| Ok(shaped(grid, |y, x| if (x + y).is_multiple_of(2) { 1.0 } else { 0.0 })?)),
        made("steps", |grid| Ok(shaped(grid, |y, x| ((x / 8) % 4 + (y / 8) % 4) as f64)?)),
        made("spike", |grid| Ok(shaped(grid, |y, x| if (y, x) == (0, 3) { 1.0 } else { 0.0 })?)),
    ]
}

/// Heights that came on an offset of a billion rms heights.
fn offset(grid: Grid) -> Result<Surface, SetupError> {
    let surface = rough(grid).surface(grid)?;
    let rms = (surface.heights().iter().map(|h| h * h).sum::<f64>() / grid.len() as f64).sqrt();
    Ok(Surface::new(grid, surface.height() + 1e9 * rms)?)
}

/// Roughness whose heights are rounded to few values.
fn plateaus(grid: Grid) -> Result<Surface, SetupError> {
    let surface = rough(grid).surface(grid)?;
    let highest = surface.heights().iter().fold(0.0, |highest: f64, h| highest.max(h.abs()));
    Ok(Surface::new(grid, surface.height().mapv(|h| (4.0 * h / highest).round()))?)
}

/// Two equal peaks, half a period apart, each a parabola.
fn two_peaks(grid: Grid) -> Result<Surface, SetupError> {
    let [ny, nx] = grid.shape();
    let half = nx / 2;
    Ok(shaped(grid, |y, x| {
        let (x, y) = ((x % half) as f64 / half as f64 - 0.5, y as f64 / ny as f64 - 0.5);
        -x * x - if ny > 1 { y * y } else { 0.0 }
    })?)
}

/// An indenter upside down, which touches at the edge of the cell.
fn bowl(name: &str, indenter: Indenter, grid: Grid) -> Trial {
    Trial::new(name, move || {
        let surface = indenter.surface(grid)?;
        pressed(Surface::new(grid, -surface.height())?, Load::MeanPressure(0.01))
    })
}

/// A spike over flat ground: pressed hard enough, both touch.
fn lone_spike(reduced_pressure: f64) -> Trial {
    Trial::new(format!("spike-51x28-{reduced_pressure:e}"), move || {
        let grid = Grid::surface([51, 28], [1.0, 1.0])?;
        let spike = shaped(grid, |y, x| if (y, x) == (25, 14) { 1.0 } else { 0.0 })?;
        pressed(spike, Load::ReducedPressure(reduced_pressure))
    })
}
