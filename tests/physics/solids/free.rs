//! Contacts without images.

use asperity::contact::{Certificate, ContactModulus, Gfmd, Load, Multilevel, PolonskyKeer, Solver};
use asperity::elastic::{HalfSpace, Layer, Response, direct};
use asperity::error::{GridError, ProblemError, SolveError};
use asperity::surface::{Field, Spectrum};
use asperity::{Contact, Grid, Indenter, Problem, Stop, Surface};
use std::f64::consts::PI;

fn line(points: usize, length: f64) -> Grid {
    Grid::line(points, length).unwrap().with_periodic([true, false])
}

fn square(points: usize, length: f64) -> Grid {
    Grid::surface([points; 2], [length; 2]).unwrap().with_periodic([false; 2])
}

fn solved(problem: &Problem) -> Contact {
    Multilevel.solve(problem, &Stop::new(1e-10, 100_000).unwrap(), &mut ()).unwrap().converged().unwrap()
}

fn pressed(surface: Surface, load: Load) -> Contact {
    solved(&Problem::new(surface, ContactModulus(1.0), load).unwrap())
}

fn half_width(contact: &Contact, length: f64) -> f64 {
    0.5 * contact.resolved().relative_area * length
}

#[test]
fn convolution_is_the_direct_sum_on_awkward_grids() {
    let periodic = [
        Grid::line(4, 2.0),
        Grid::line(31, 0.5),
        Grid::line(64, 10.0),
        Grid::surface([12, 16], [1.0, 3.0]),
        Grid::surface([7, 5], [2.0, 2.0]),
    ];
    for grid in periodic.map(|grid| grid.unwrap().with_periodic([false; 2])) {
        let pressure: Vec<f64> = (0..grid.len()).map(|i| ((i * i) as f64 * 0.7).sin() + 0.3).collect();
        let solid = HalfSpace::new(3.0);
        let mut fast = vec![0.0; grid.len()];
        Response::new(&grid, solid).unwrap().displacement(&pressure, &mut fast);
        for (fast, slow) in fast.iter().zip(direct::displacement(&grid, &solid, &pressure)) {
            assert!((fast - slow).abs() < 1e-13, "{grid:?}: {fast} and {slow}");
        }
    }
}

/// Love's element against many point loads, Flamant's strip against many line loads, near and far.
#[test]
fn elements_displace_as_many_loads_inside_them() {
    let many = 400;
    let inside = |i: usize| (i as f64 + 0.5) / many as f64 - 0.5;
    let influence = direct::influence(&square(24, 12.0), &HalfSpace::new(2.0));
    for [y, x] in [[0, 2], [3, 1], [5, 17]] {
        let point = |i: usize| {
            let [dy, dx] = [inside(i / many), inside(i % many)].map(|at| 0.5 * at);
            1.0 / (PI * 2.0 * (0.5 * x as f64 - dx).hypot(0.5 * y as f64 - dy))
        };
        let mean = (0..many * many).map(point).sum::<f64>() / (many * many) as f64;
        assert!((influence[y * 24 + x] / (0.25 * mean) - 1.0).abs() < 1e-5);
    }
    let influence = direct::influence(&line(64, 32.0), &HalfSpace::new(2.0).with_datum(50.0));
    for x in [1, 2, 31, 33, 63] {
        let load = |i: usize| (2.0 / (PI * 2.0)) * (50.0 / (0.5 * (x as f64 - inside(i)))).ln();
        let mean = (0..many).map(load).sum::<f64>() / many as f64;
        assert!((influence[x] / (0.5 * mean) - 1.0).abs() < 1e-5);
    }
}

/// Pressures that do not vary along the periodic axis make a line; waves along it are those of a periodic cell that is so long that
/// they fade in it.
#[test]
fn one_free_axis_lies_between_a_line_and_a_periodic_surface() {
    for swap in [false, true] {
        let grid = |periodic: bool| {
            let (shape, size) = if swap { ([128, 16], [8.0, 1.0]) } else { ([16, 128], [1.0, 8.0]) };
            Grid::surface(shape, size).unwrap().with_periodic([periodic || !swap, periodic || swap])
        };
        let place = |i: usize| if swap { [i % 16, i / 16] } else { [i / 128, i % 128] };
        let respond = |grid: Grid, pressure: &[f64]| {
            let mut u = vec![0.0; grid.len()];
            Response::new(&grid, HalfSpace::new(1.0)).unwrap().displacement(pressure, &mut u);
            u
        };
        let bump = |x: usize| (-0.02 * (x as f64 - 60.0).powi(2)).exp();
        let uniform: Vec<f64> = (0..2048).map(|i| bump(place(i)[1])).collect();
        let mut along = vec![0.0; 128];
        let profile: Vec<f64> = (0..128).map(bump).collect();
        Response::new(&line(128, 8.0), HalfSpace::new(1.0)).unwrap().displacement(&profile, &mut along);
        for (i, u) in respond(grid(false), &uniform).into_iter().enumerate() {
            assert!((u / along[place(i)[1]] - 1.0).abs() < 1e-12, "{u} at {i}");
        }
        let wave: Vec<f64> = (0..2048).map(|i| (PI / 8.0 * place(i)[0] as f64).cos() * bump(place(i)[1])).collect();
        let [free, periodic] = [false, true].map(|periodic| respond(grid(periodic), &wave));
        let largest = periodic.iter().copied().fold(0.0, f64::max);
        let apart = free.iter().zip(&periodic).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < 5e-3 * largest, "{apart} of {largest}");
    }
}

/// Hertz (1882): `P = pi E* a^2 / (4 R)` and `P = 4 E* a^3 / (3 R)`, approach `a^2 / R`.
#[test]
fn hertz_contacts_have_no_images() {
    let (radius, a) = (1.0, 0.2);
    for points in [128, 512] {
        let surface = Indenter::Cylinder { radius }.surface(line(points, 1.0)).unwrap();
        let contact = pressed(surface, Load::Force(PI * a * a / (4.0 * radius)));
        assert!((half_width(&contact, 1.0) / a - 1.0).abs() < 1.0 / points as f64, "{}", half_width(&contact, 1.0));
        let highest = contact.max_pressure() / (2.0 / PI * PI * a / 4.0);
        assert!((highest - 1.0).abs() < 1.0 / points as f64, "{highest}");
        // Johnson, Eq. 5.55, from the surface at the distance D in place of a depth
        let approach = a * a / (4.0 * radius) * (2.0 * (2.0 / a).ln() + 1.0);
        assert!(
            (contact.approach().unwrap() / approach - 1.0).abs() < 1.0 / points as f64,
            "{:?} for {approach}",
            contact.approach()
        );
    }
    for points in [64, 128] {
        let surface = Indenter::Sphere { radius }.surface(square(points, 1.0)).unwrap();
        let contact = pressed(surface, Load::Force(4.0 / 3.0 * a.powi(3) / radius));
        let found = (contact.resolved().relative_area / PI).sqrt();
        assert!((found / a - 1.0).abs() < 0.5 / points as f64, "{found} on {points}");
        let approach = contact.approach().unwrap();
        assert!((approach / (a * a / radius) - 1.0).abs() < 0.5 / points as f64, "{approach}");
    }
}

/// A flat punch, `p = P / (pi sqrt(a^2 - x^2))`: the load inside of `x` is `2/pi asin(x/a)` of all; and a cone, `a = sqrt(2 P / (pi E* m))`.
#[test]
fn punch_and_cone_have_no_images() {
    let surface = Indenter::Punch { half_width: 0.2505, depth: 1.0 }.surface(line(1000, 1.0)).unwrap();
    let contact = pressed(surface, Load::Force(1e-2));
    let a = 0.2505;
    let inner: f64 = contact.pressure.iter().skip(500 - 125).take(251).sum::<f64>() / contact.pressure.sum();
    let expected = 2.0 / PI * (0.1255f64 / a).asin();
    assert!((inner / expected - 1.0).abs() < 2e-3, "{inner} for {expected}");
    let (slope, a) = (0.1, 0.2);
    let surface = Indenter::Cone { slope }.surface(square(160, 1.0)).unwrap();
    let contact = pressed(surface, Load::Force(0.5 * PI * slope * a * a));
    let found = (contact.resolved().relative_area / PI).sqrt();
    assert!((found / a - 1.0).abs() < 0.01, "{found}");
}

#[test]
fn a_periodic_cell_tends_to_the_free_one_as_it_grows() {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.5, short_cutoff: 0.1, rms_gradient: 0.05 };
    let patch = Surface::rough(Grid::surface([32; 2], [1.0; 2]).unwrap(), &spectrum, 5).unwrap();
    let dome = Indenter::Sphere { radius: 2.0 }.surface(*patch.grid()).unwrap().plus(&patch).heights_as_given();
    let load = 1e-2;
    let free = pressed(Surface::new(square(32, 1.0), dome.clone()).unwrap(), Load::Force(load));
    let lowest = dome.iter().copied().fold(f64::INFINITY, f64::min);
    let apart = [4, 8, 16].map(|times| {
        let points = 32 * times;
        // the patch, and around it heights that nothing reaches
        let height =
            Field::from_shape_fn([points; 2], |(y, x)| if y < 32 && x < 32 { dome[[y, x]] } else { lowest - 1.0 });
        let cell = Grid::surface([points; 2], [times as f64; 2]).unwrap();
        let contact = pressed(Surface::new(cell, height).unwrap(), Load::Force(load));
        Field::from_shape_fn([32; 2], |at| contact.pressure[at])
    });
    let differ = |a: &Field, b: &Field| (a - b).mapv(f64::abs).sum() / free.pressure.sum();
    let [four, eight, sixteen] = &apart;
    // images fade by the cube of the distance; what is left is the difference of elements and waves, of the order of the grid
    let [near, far, left] = [differ(four, sixteen), differ(eight, sixteen), differ(sixteen, &free.pressure)];
    assert!(far < 0.2 * near && left < 0.015, "{near} {far} {left}");
}

#[test]
fn solvers_agree_and_certificates_bound_the_error() {
    let spectrum = Spectrum { hurst: 0.5, rolloff_wavelength: 0.3, short_cutoff: 0.04, rms_gradient: 0.1 };
    for grid in [line(512, 1.0), square(64, 1.0), square(64, 1.0).with_periodic([true, false])] {
        let surface = Surface::rough(grid, &spectrum, 2).unwrap();
        for load in [Load::ReducedPressure(0.02), Load::ReducedPressure(0.5), Load::Approach(0.02)] {
            let problem = Problem::new(surface.clone(), ContactModulus(1.0), load).unwrap();
            let best = solved(&problem);
            let loose = PolonskyKeer.solve(&problem, &Stop::new(1e-5, 10_000).unwrap(), &mut ()).unwrap();
            assert!(loose.is_converged());
            let apart = (&loose.pressure - &best.pressure).into_iter().collect::<Vec<_>>();
            let mut u = vec![0.0; apart.len()];
            problem.response().displacement(&apart, &mut u);
            let error: f64 = apart.iter().zip(&u).map(|(p, u)| p * u).sum();
            let size: f64 = loose.pressure.iter().zip(&loose.displacement).map(|(p, u)| p * u).sum();
            let bound = loose.certificate.pressure_error_bound + best.certificate.pressure_error_bound;
            assert!((error / size).sqrt() <= bound, "{load:?} {grid:?}: {} for {bound}", (error / size).sqrt());
            assert!(Certificate::new(&problem, loose.pressure.as_slice().unwrap()).eta <= 1e-5);
        }
    }
}

#[test]
fn gradients_know_the_rim() {
    let ramp = |grid: Grid| Surface::new(grid, Field::from_shape_fn(grid.shape(), |(_, x)| x as f64)).unwrap();
    let grid = line(16, 16.0);
    assert!((ramp(grid).rms_gradient() - 1.0).abs() < 1e-12);
    assert!((0..16).all(|node| (ramp(grid).square_slope()(node) - 1.0).abs() < 1e-12));
    assert_eq!(ramp(grid).jumps(), [0.0, 0.0]);
    let fine = ramp(grid).refined(2).unwrap();
    assert_eq!(fine.grid().len(), 32);
    assert!((0..16).all(|node| (fine.heights_as_given()[[0, 2 * node]] - node as f64).abs() < 1e-12));
}

#[test]
fn what_has_no_meaning_without_images_is_refused() {
    let surface = || Indenter::Cylinder { radius: 1.0 }.surface(line(64, 1.0)).unwrap();
    let pose = |load| Problem::new(surface(), ContactModulus(1.0), load);
    assert!(matches!(pose(Load::MeanGap(1e-3)), Err(ProblemError::GapOfFree { .. })));
    let solved = Gfmd::default().solve(&pose(Load::MeanPressure(1e-3)).unwrap(), &Stop::default(), &mut ());
    assert!(matches!(solved, Err(SolveError::NeedsWaves { .. })));
    let layer = Layer { contact_modulus: 1.0, poisson: 0.3, thickness: 1.0, base: Default::default() };
    let refused = Problem::new(surface(), layer, Load::MeanPressure(1e-3));
    assert!(matches!(refused, Err(ProblemError::Grid(GridError::FreeSolid { .. }))));
    let periodic = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(64, 1.0).unwrap()).unwrap();
    let refused = Problem::new(periodic, ContactModulus(1.0), Load::Approach(1e-3));
    assert!(matches!(refused, Err(ProblemError::ApproachOfHalfSpace { .. })));
}
