//! Heights interpolated on finer grids.

use asperity::surface::{Field, Spectrum};
use asperity::{Grid, Surface};

fn rough(grid: Grid) -> Surface {
    let spectrum = Spectrum { hurst: 0.5, rolloff_wavelength: 1.0, short_cutoff: 0.26, rms_gradient: 0.1 };
    Surface::rough(grid, &spectrum, 4).unwrap()
}

#[test]
fn what_the_grid_can_carry_is_interpolated_exactly() {
    for (shape, size) in [([16, 12], [2.0, 1.0]), ([15, 13], [1.0, 1.0]), ([16, 27], [1.0, 2.0])] {
        let coarse = rough(Grid::surface(shape, size).unwrap());
        for factor in [1, 2, 3] {
            let refined = coarse.refined(factor).unwrap();
            let fine = rough(*refined.grid());
            // the same waves, scaled to the gradient on another grid
            let scale = coarse.heights()[5] / fine.height()[[0, 5 * factor]];
            let differences = refined.height() - &(fine.height() * scale);
            let largest = differences.fold(0.0, |most: f64, it| most.max(it.abs()));
            assert!(largest < 1e-13, "{shape:?} {factor}: {largest}");
        }
    }
}

#[test]
fn nodes_keep_their_heights_even_at_the_shortest_wave() {
    for [ny, nx] in [[6, 8], [5, 8], [8, 7], [4, 4]] {
        let height = Field::from_shape_fn([ny, nx], |(y, x)| ((x * x * 7 + y * 13) % 11) as f64 + 100.0);
        let surface = Surface::new(Grid::surface([ny, nx], [1.0, 1.0]).unwrap(), height.clone()).unwrap();
        let refined = surface.refined(3).unwrap().heights_as_given();
        for ((y, x), &h) in height.indexed_iter() {
            assert!((refined[[3 * y, 3 * x]] - h).abs() < 1e-11, "{ny} x {nx} at {y}, {x}");
        }
    }
    let line = Surface::line(ndarray::arr1(&[1.0, -1.0, 1.0, -1.0]).view(), 1.0).unwrap().refined(2).unwrap();
    let halfway = line.heights()[1];
    assert!(halfway.abs() < 1e-15, "the shortest wave is a cosine: {halfway}");
}
