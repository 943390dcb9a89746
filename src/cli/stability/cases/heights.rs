//! Heights that are offset, rough to the last node, steep, stepped, tied, or alone.

use super::{GRIDS, Grids, Size, noise, pressed, rough, rough_with, shaped};
use crate::cli::stability::case::Case;
use anyhow::Result;
use asperity::surface::Indenter;
use asperity::{Grid, Problem, Surface};

const LOAD: f64 = 0.05;

pub fn cases(size: Size) -> Vec<Case> {
    let mut cases: Vec<Case> = GRIDS.into_iter().flat_map(|(kind, grid)| on(kind, grid, size)).collect();
    cases.extend([punch_line(size), punch_surface(size), bowl_line(size), bowl_surface(size)]);
    cases.extend([9e-3, 2e-2].map(lone_spike));
    cases
}

/// Cases of lines and surfaces alike.
fn on(kind: &str, grid: Grids, size: Size) -> Vec<Case> {
    let case = |name: &str, surface: fn(Grid) -> Result<Surface>| {
        Case::new(format!("{name}-{kind}"), move || pressed(surface(grid(size)?)?, LOAD))
    };
    vec![
        case("offset-1e9", offset),
        case("hurst-0.01", |grid| rough_with(grid, 0.01, 2.0, 0.1)),
        case("hurst-1", |grid| rough_with(grid, 1.0, 2.0, 0.1)),
        case("white-noise", noise),
        case("slope-1e-9", |grid| rough_with(grid, 0.8, 8.0, 1e-9)),
        case("slope-1e3", |grid| rough_with(grid, 0.8, 8.0, 1e3)),
        case("plateaus", plateaus),
        case("two-peaks", two_peaks),
        case("comb", |grid| shaped(grid, |y, x| if (x + y).is_multiple_of(2) { 1.0 } else { 0.0 })),
        case("steps", |grid| shaped(grid, |y, x| ((x / 8) % 4 + (y / 8) % 4) as f64)),
        case("spike", |grid| shaped(grid, |y, x| if (y, x) == (0, 3) { 1.0 } else { 0.0 })),
    ]
}

/// Heights that came on an offset of a billion rms heights.
fn offset(grid: Grid) -> Result<Surface> {
    let surface = rough(grid)?;
    let rms = (surface.heights().iter().map(|h| h * h).sum::<f64>() / grid.len() as f64).sqrt();
    Ok(Surface::new(grid, surface.height() + 1e9 * rms)?)
}

/// Roughness whose heights are rounded to few values.
fn plateaus(grid: Grid) -> Result<Surface> {
    let surface = rough(grid)?;
    let highest = surface.heights().iter().fold(0.0, |highest: f64, h| highest.max(h.abs()));
    Ok(Surface::new(grid, surface.height().mapv(|h| (4.0 * h / highest).round()))?)
}

/// Two equal peaks, half a period apart, of the kind of a parabola.
fn two_peaks(grid: Grid) -> Result<Surface> {
    let [ny, nx] = grid.shape();
    let half = nx / 2;
    shaped(grid, |y, x| {
        let (x, y) = ((x % half) as f64 / half as f64 - 0.5, y as f64 / ny as f64 - 0.5);
        -x * x - if ny > 1 { y * y } else { 0.0 }
    })
}

/// A flat strip.
fn punch_line(size: Size) -> Case {
    let punch = Indenter::Punch { half_width: 0.2, depth: 0.1 };
    Case::new("punch-line", move || Ok(Problem::new(punch.surface(size.line()?)?, 1.0, 0.01)?))
}

/// A flat disc.
fn punch_surface(size: Size) -> Case {
    let punch = Indenter::Punch { half_width: 0.2, depth: 0.1 };
    Case::new("punch-surface", move || Ok(Problem::new(punch.surface(size.surface()?)?, 1.0, 0.01)?))
}

/// A cylinder upside down, which touches at the edge of the cell.
fn bowl_line(size: Size) -> Case {
    Case::new("bowl-line", move || {
        let cylinder = Indenter::Cylinder { radius: 1.0 }.surface(size.line()?)?;
        Ok(Problem::new(Surface::new(*cylinder.grid(), -cylinder.height())?, 1.0, 0.01)?)
    })
}

/// A sphere upside down.
fn bowl_surface(size: Size) -> Case {
    Case::new("bowl-surface", move || {
        let sphere = Indenter::Sphere { radius: 1.0 }.surface(size.surface()?)?;
        Ok(Problem::new(Surface::new(*sphere.grid(), -sphere.height())?, 1.0, 0.01)?)
    })
}

/// A spike over flat ground: pressed hard enough, both touch.
fn lone_spike(reduced_pressure: f64) -> Case {
    Case::new(format!("spike-51x28-{reduced_pressure:e}"), move || {
        let grid = Grid::surface([51, 28], [1.0, 1.0])?;
        pressed(shaped(grid, |y, x| if (y, x) == (25, 14) { 1.0 } else { 0.0 })?, reduced_pressure)
    })
}
