//! All solvers find the same contact, on every kind of grid and load.

use crate::common::{relative_l2, solve, solvers};
use asperity::contact::{ContactModulus, Load, Problem};
use asperity::surface::Spectrum;
use asperity::{Grid, Indenter, Surface};

/// The relative L2 difference of pressures that is allowed, and the certificate that guarantees far less.
const AGREEMENT: f64 = 1e-6;
const TOLERANCE: f64 = 1e-13;

fn assert_agreement(problem: &Problem) {
    let all = solvers();
    let first = solve(all[0].as_ref(), problem, TOLERANCE);
    for solver in &all[1..] {
        let contact = solve(solver.as_ref(), problem, TOLERANCE);
        let difference = relative_l2(&contact.pressure, &first.pressure);
        assert!(difference < AGREEMENT, "{} on {:?}: {difference}", solver.settings(), problem.surface().grid());
        assert!(contact.certificate.load_error < 1e-12);
        assert!(contact.certificate.min_pressure >= 0.0);
    }
}

/// Roughness with a band of 16 between roll-off and cut-off, or as much of it as the grid resolves.
fn rough(grid: Grid, hurst: f64, reduced_pressure: f64) -> Problem {
    let rolloff_wavelength = grid.longest_wavelength() / 2.0;
    let spectrum = Spectrum {
        hurst,
        rolloff_wavelength,
        short_cutoff: (rolloff_wavelength / 16.0).max(1.1 * grid.shortest_wavelength()).min(0.9 * rolloff_wavelength),
        rms_gradient: 1e-3,
    };
    let surface = Surface::rough(grid, &spectrum, 7).unwrap();
    Problem::new(surface, ContactModulus(1.0), Load::ReducedPressure(reduced_pressure)).unwrap()
}

#[test]
fn on_smooth_lines_and_surfaces() {
    let line = Grid::line(512, 1.0).unwrap();
    let surface = Grid::surface([64, 64], [1.0, 1.0]).unwrap();
    let smooth = [
        (Indenter::Cylinder { radius: 1.0 }, line, 0.01),
        (Indenter::Wedge { slope: 0.1 }, line, 0.01),
        (Indenter::Punch { half_width: 0.2, depth: 1.0 }, line, 0.01),
        (Indenter::Sphere { radius: 1.0 }, surface, 0.01),
        (Indenter::Cone { slope: 0.1 }, surface, 0.01),
        (Indenter::CrossedSine { amplitude: 0.01 }, surface, 0.02),
    ];
    for (indenter, grid, mean_pressure) in smooth {
        assert_agreement(
            &Problem::new(indenter.surface(grid).unwrap(), ContactModulus(1.0), Load::MeanPressure(mean_pressure))
                .unwrap(),
        );
    }
}

#[test]
fn on_rough_lines_and_surfaces_at_low_and_high_load() {
    for reduced_pressure in [0.01, 0.1, 0.7] {
        for hurst in [0.2, 0.8] {
            assert_agreement(&rough(Grid::line(1024, 1.0).unwrap(), hurst, reduced_pressure));
            assert_agreement(&rough(Grid::surface([64, 64], [1.0, 1.0]).unwrap(), hurst, reduced_pressure));
        }
    }
}

#[test]
fn on_odd_prime_and_rectangular_grids() {
    let grids = [
        Grid::line(61, 1.0),
        Grid::line(255, 2.0),
        Grid::surface([31, 37], [1.0, 1.0]),
        Grid::surface([24, 50], [1.0, 3.0]),
        Grid::surface([64, 15], [1.0, 0.5]),
    ];
    for grid in grids {
        assert_agreement(&rough(grid.unwrap(), 0.5, 0.1));
    }
}

#[test]
fn on_the_smallest_grids() {
    let line = Surface::line(ndarray::arr1(&[0.0, 1.0, 0.3, 0.9]).view(), 1.0).unwrap();
    let field = ndarray::Array2::from_shape_fn((4, 4), |(i, j)| ((3 * i + 5 * j * j) as f64).sin());
    let surface = Surface::new(Grid::surface([4, 4], [1.0, 2.0]).unwrap(), field).unwrap();
    for load in [1e-6, 1e-2, 1.0, 100.0] {
        assert_agreement(&Problem::new(line.clone(), ContactModulus(1.0), Load::MeanPressure(load)).unwrap());
        assert_agreement(&Problem::new(surface.clone(), ContactModulus(1.0), Load::MeanPressure(load)).unwrap());
    }
}

#[test]
fn a_surface_without_variation_along_y_is_a_line() {
    let line = rough(Grid::line(256, 1.0).unwrap(), 0.8, 0.05);
    let height = line.surface().height().broadcast((8, 256)).unwrap().to_owned();
    let ridged = Surface::new(Grid::surface([8, 256], [0.1, 1.0]).unwrap(), height).unwrap();
    let ridged = Problem::new(ridged, ContactModulus(1.0), Load::MeanPressure(line.expected_mean_pressure())).unwrap();
    let solver = asperity::contact::PolonskyKeer;
    let (of_line, of_surface) = (solve(&solver, &line, TOLERANCE), solve(&solver, &ridged, TOLERANCE));
    for row in of_surface.pressure.rows() {
        assert!(relative_l2(row, &of_line.pressure) < AGREEMENT);
    }
    assert!((of_surface.counted().kappa_r / of_line.counted().kappa_r - 1.0).abs() < 1e-9);
}
