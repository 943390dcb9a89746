//! The fast solver: on surfaces that break whole-set updates, on every grid, over the whole range of loads, and its work.

#[allow(dead_code, reason = "not every test file uses every helper")]
mod common;

use asperity::contact::{Contact, Multilevel, PolonskyKeer, Problem};
use asperity::surface::Spectrum;
use asperity::{Grid, Indenter, Surface};
use common::{relative_l2, solve};
use ndarray::{Array1, Array2};
use std::f64::consts::PI;

fn line(height: impl FnMut(usize) -> f64, points: usize) -> Surface {
    Surface::line(Array1::from_shape_fn(points, height).view(), 1.0).unwrap()
}

/// Uncorrelated heights in (-1, 1): a hash of the node.
fn noise(node: usize) -> f64 {
    let hash = (node as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let hash = (hash ^ (hash >> 31)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    (hash >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

fn rough(grid: Grid, hurst: f64, reduced_pressure: f64) -> Problem {
    let (waves, band) = if grid.is_line() { (8.0, 512.0) } else { (4.0, 64.0) };
    let spectrum = Spectrum {
        hurst,
        rolloff_wavelength: 1.0 / waves,
        short_cutoff: (1.0 / (waves * band)).max(4.0 * grid.shortest_wavelength()),
        rms_gradient: 1e-3,
    };
    let surface = Surface::rough(grid, &spectrum, 1).unwrap();
    Problem::at_reduced_pressure(surface, 1.0, reduced_pressure).unwrap()
}

fn assert_exact(name: &str, problem: &Problem) -> Contact {
    let fast = solve(&Multilevel, problem, 1e-12);
    let slow = solve(&PolonskyKeer, problem, 1e-12);
    let difference = relative_l2(&fast.pressure, &slow.pressure);
    assert!(difference < 1e-6, "{name}: {difference}");
    fast
}

#[test]
fn sines_parabolas_combs_spikes_and_noise_do_not_trap_it() {
    let sine = |points: usize| Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(points, 1.0).unwrap()).unwrap();
    for area in [0.01, 0.1, 0.5, 0.9, 0.99] {
        for points in [512, 61, 255] {
            let load = 0.01 * PI * (0.5 * PI * area).sin().powi(2);
            assert_exact(&format!("sine of {area}"), &Problem::new(sine(points), 1.0, load).unwrap());
        }
    }
    let parabola = Indenter::Cylinder { radius: 0.25 }.surface(Grid::line(1024, 1.0).unwrap()).unwrap();
    let comb = line(|i| if i / 16 % 2 == 0 { 0.0 } else { -0.01 }, 1024);
    let spike = line(|i| if i == 513 { 1.0 } else { 0.0 }, 1024);
    let plateaus = line(|i| (i / 100) as f64 % 3.0, 1000);
    let white = line(noise, 1024);
    for (name, surface) in
        [("parabola", parabola), ("comb", comb), ("spike", spike), ("plateaus", plateaus), ("noise", white)]
    {
        for load in [1e-3, 0.05, 0.2, 1.0] {
            assert_exact(&format!("{name} at {load}"), &Problem::new(surface.clone(), 1.0, load).unwrap());
        }
    }
}

#[test]
fn white_noise_on_a_surface_from_one_per_cent_to_full_contact() {
    let field = Array2::from_shape_fn((48, 64), |(i, j)| noise(64 * i + j));
    let surface = Surface::new(Grid::surface([48, 64], [1.0, 1.0]).unwrap(), field).unwrap();
    let areas = [0.01, 1.0, 20.0, 100.0].map(|load| {
        let problem = Problem::new(surface.clone(), 1.0, load).unwrap();
        assert_exact("noise", &problem).measures(&problem).relative_area
    });
    assert!(areas[0] < 0.03 && areas[3] == 1.0 && areas.is_sorted(), "{areas:?}");
}

#[test]
fn grids_that_cannot_be_halved_need_no_coarser_ones() {
    let grids = [
        Grid::line(4097, 1.0),
        Grid::line(3 * 512, 1.0),
        Grid::surface([61, 128], [1.0, 1.0]),
        Grid::surface([96, 160], [1.0, 2.0]),
    ];
    for grid in grids {
        for reduced_pressure in [0.01, 0.1] {
            assert_exact("rough", &rough(grid.clone().unwrap(), 0.5, reduced_pressure));
        }
    }
}

#[test]
fn the_area_rises_with_the_load_from_first_touch_to_beyond_full_contact() {
    let mut before = 0.0;
    for reduced_pressure in [1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.3, 1.0, 2.0, 4.0] {
        let problem = rough(Grid::line(1 << 12, 1.0).unwrap(), 0.8, reduced_pressure);
        let area = solve(&Multilevel, &problem, 1e-9).measures(&problem).relative_area;
        assert!(area >= before, "{area} after {before} at {reduced_pressure}");
        before = area;
    }
    assert_eq!(before, 1.0);
}

/// Transforms of the finest grid to a certificate of 1e-8; the table is printed with `-- --nocapture`.
#[test]
fn its_work_stays_low() {
    let smooth = |indenter: Indenter, grid: Grid, load: f64| Problem::new(indenter.surface(grid).unwrap(), 1.0, load);
    let long = Grid::line(1 << 16, 1.0).unwrap();
    let wide = Grid::surface([256, 256], [1.0, 1.0]).unwrap();
    let cases = [
        ("cylinder, 2^16", smooth(Indenter::Cylinder { radius: 0.25 }, long, 0.01).unwrap(), 140),
        ("sine, 2^16", smooth(Indenter::Sine { amplitude: 0.01 }, long, 0.01).unwrap(), 140),
        ("sphere, 256^2", smooth(Indenter::Sphere { radius: 0.25 }, wide, 0.01).unwrap(), 140),
        ("rough line 2^16, H = 0.8, p* = 0.01", rough(long, 0.8, 0.01), 1300),
        ("rough line 2^16, H = 0.2, p* = 0.01", rough(long, 0.2, 0.01), 1300),
        ("rough surface 256^2, H = 0.8, p* = 0.1", rough(wide, 0.8, 0.1), 400),
        ("rough surface 256^2, H = 0.2, p* = 0.01", rough(wide, 0.2, 0.01), 400),
    ];
    for (name, problem, most) in cases {
        let work = solve(&Multilevel, &problem, 1e-8).work;
        println!("{name:<40} {:>3} updates {:>5} transforms", work.iterations, work.transforms);
        assert!(work.transforms <= most, "{name}: {work:?}");
    }
}
