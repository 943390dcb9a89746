//! Hatches over the parts of maps that were filled in and never measured.

use super::units::Units;
use asperity::Grid;
use asperity::plot::{Colour, Dot, Mark, Panel, unit};
use asperity::quantity::LENGTHS;

/// The most tiles of a hatch along an axis: on a picture of the usual size its lines are then some pixels wide.
const MOST_TILES: usize = 128;
/// The distance from one line of the hatch to the next, in diagonals of tiles: two thirds of the map below stay visible.
const LINE_DISTANCE: usize = 3;
/// The words behind the title of a map that say what the hatch means.
const MEANING: &str = "; hatched: filled in";

/// Hatches the nodes of a map that are filled, row by row, if there are some. Positions of the panel are lengths along the grid.
pub(crate) fn hatch(panel: &mut Panel, grid: &Grid, filled: Option<&[bool]>, units: Units) {
    let Some(filled) = filled.filter(|nodes| nodes.contains(&true)) else { return };
    let (shape, lengths) = (grid.shape(), grid.size());
    let (_, size) = unit(units.metres, &LENGTHS, lengths[1]);
    let tiles = shape.map(|nodes| nodes.min(MOST_TILES));
    let mut dots = Vec::new();
    for row in 0..tiles[0] {
        for column in (0..tiles[1]).filter(|column| (row + column) % LINE_DISTANCE == 0) {
            let [y, x] = [row * shape[0] / tiles[0], column * shape[1] / tiles[1]];
            if filled[y * shape[1] + x] {
                let place = |i: usize, axis: usize| (i as f64 + 0.5) / tiles[axis] as f64 * lengths[axis] / size;
                dots.push(Dot::at(place(column, 1), place(row, 0)));
            }
        }
    }
    panel.title.push_str(MEANING);
    panel.add("", Colour::VERMILION, Mark::Tile { columns: tiles[1] as u32, rows: tiles[0] as u32 }, dots);
}
