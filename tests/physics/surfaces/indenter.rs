//! Smooth indenters on grids.

use asperity::error::SurfaceError;
use asperity::surface::Field;
use asperity::{Grid, Indenter, Surface};
use ndarray::arr1;

/// The surface of an indenter is that of the heights `height(r)` at the distance `r` from the middle node, to the last bit.
fn assert_heights(indenter: Indenter, grid: Grid, height: impl Fn(f64) -> f64) {
    let ([ny, nx], [dy, dx]) = (grid.shape(), grid.spacing());
    let offset = |i: usize, n: usize, spacing: f64| (i as f64 - (n / 2) as f64) * spacing;
    let heights = Field::from_shape_fn([ny, nx], |(i, j)| height(offset(j, nx, dx).hypot(offset(i, ny, dy))));
    let (surface, expected) = (indenter.surface(grid).unwrap(), Surface::new(grid, heights).unwrap());
    assert_eq!((surface.grid(), surface.height()), (expected.grid(), expected.height()), "{indenter:?}");
}

#[test]
fn peak_is_on_the_middle_node_of_even_and_odd_grids() {
    for n in [8, 9, 31] {
        let (line, surface) = (Grid::line(n, 3.0).unwrap(), Grid::surface([n, 6], [3.0, 2.0]).unwrap());
        assert_heights(Indenter::Wedge { slope: 2.0 }, line, |r| -2.0 * r);
        assert_heights(Indenter::Cone { slope: 1.0 }, surface, |r| -r);
    }
}

#[test]
fn power_law_of_two_is_the_parabola() {
    let grid = Grid::surface([7, 12], [1.0, 2.0]).unwrap();
    let heights = |indenter: Indenter| indenter.surface(grid).unwrap().heights_as_given();
    let power = heights(Indenter::PowerLaw { coefficient: 0.5, exponent: 2.0 });
    for (a, b) in power.iter().zip(&heights(Indenter::Sphere { radius: 1.0 })) {
        assert!((a - b).abs() < 1e-15);
    }
}

#[test]
fn waves_have_their_amplitude_at_peak_and_valley() {
    let line = Indenter::Sine { amplitude: 0.3 }.surface(Grid::line(8, 5.0).unwrap()).unwrap();
    assert_eq!((line.heights()[4], line.heights()[0]), (0.3, -0.3));
    let grid = Grid::surface([4, 8], [1.0, 1.0]).unwrap();
    let crossed = Indenter::CrossedSine { amplitude: 0.3 }.surface(grid).unwrap();
    let crossed = crossed.height();
    assert_eq!((crossed[[2, 4]], crossed[[2, 0]], crossed[[0, 0]]), (0.3, -0.3, 0.3));
}

#[test]
fn punch_is_flat_within_its_half_width() {
    let punch = Indenter::Punch { half_width: 0.25, depth: 2.0 }.surface(Grid::line(8, 1.0).unwrap()).unwrap();
    let heights = arr1(&[-2.0, -2.0, 0.0, 0.0, 0.0, 0.0, 0.0, -2.0]);
    assert_eq!(punch.height(), Surface::line(heights.view(), 1.0).unwrap().height());
}

#[test]
fn bad_indenters_are_refused() {
    let (line, surface) = (Grid::line(8, 1.0).unwrap(), Grid::surface([8, 8], [1.0, 1.0]).unwrap());
    for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = Indenter::Sphere { radius }.surface(surface);
        assert!(matches!(refused, Err(SurfaceError::NotPositive { name: "radius", .. })));
    }
    let refused = Indenter::Cone { slope: 1.0 }.surface(line);
    assert!(matches!(refused, Err(SurfaceError::WrongDimension { needs: "surface", has: "line", .. })));
    assert!(matches!(Indenter::Sine { amplitude: 1.0 }.surface(surface), Err(SurfaceError::WrongDimension { .. })));
    let refused = Indenter::Punch { half_width: 0.5, depth: 1.0 }.surface(line);
    assert!(matches!(refused, Err(SurfaceError::TooWide { .. })));
    let refused = Indenter::Cylinder { radius: 1e-320 }.surface(line);
    assert!(matches!(refused, Err(SurfaceError::NonFinite { .. })));
}
