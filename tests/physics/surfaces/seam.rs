//! Jumps of heights across the period.

use asperity::surface::{Field, Spectrum};
use asperity::{Grid, Surface};

#[test]
fn a_tilt_jumps_along_its_own_axis_only() {
    let grid = Grid::surface([20, 30], [1.0, 3.0]).unwrap();
    let surface =
        |height: fn((usize, usize)) -> f64| Surface::new(grid, Field::from_shape_fn((20, 30), height)).unwrap();
    let [y, x] = surface(|(i, _)| 0.25 * i as f64).jumps();
    assert!((y - 19.0).abs() < 1e-12 && x == 0.0, "{y}, {x}");
    let [y, x] = surface(|(_, j)| -3.0 * j as f64).jumps();
    assert!((x - 29.0).abs() < 1e-12 && y == 0.0, "{y}, {x}");
    assert_eq!(surface(|_| 1.0).jumps(), [0.0, 0.0]);
}

#[test]
fn a_periodic_surface_steps_across_the_period_as_it_does_inside() {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 0.02, rms_gradient: 0.1 };
    let grid = Grid::surface([256, 256], [1.0, 1.0]).unwrap();
    let whole = Surface::rough(grid, &spectrum, 1).unwrap();
    assert!(whole.jumps().iter().all(|jump| (0.7..1.4).contains(jump)), "{:?}", whole.jumps());
    // a part of it, as a microscope sees, has a seam along both axes
    let part = Field::from_shape_fn((100, 100), |at| whole.height()[at]);
    let part = Surface::new(Grid::surface([100, 100], [1.0, 1.0]).unwrap(), part).unwrap();
    assert!(part.jumps().iter().all(|jump| *jump > 5.0), "{:?}", part.jumps());
}
