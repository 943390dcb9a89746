//! Layers on rigid bases.

use asperity::contact::{Load, Multilevel, PolonskyKeer, Solver};
use asperity::elastic::{Base, ElasticSolid, HalfSpace, Layer, Response, direct};
use asperity::surface::Spectrum;
use asperity::{Contact, Grid, Indenter, Problem, Stop, Surface};
use std::sync::Arc;

const BASES: [Base; 2] = [Base::Bonded, Base::Sliding];

fn layer(poisson: f64, thickness: f64, base: Base) -> Layer {
    Layer { contact_modulus: 1.0, poisson, thickness, base }
}

/// The compliance of a wave by the equations of plane strain: Airy's function `f(z) cos q x` with
/// `f = A cosh + B sinh + C z cosh + D z sinh` of `q z`, four conditions at the two faces, and the displacement that follows.
fn by_elasticity(poisson: f64, thickness: f64, base: Base, q: f64) -> f64 {
    let shear = 0.5 * (1.0 - poisson); // of E* = 1: E / (2 (1 + nu))
    // the n-th derivative of the four functions at z
    let of = |n: usize, z: f64| -> [f64; 4] {
        let (s, c) = ((q * z).sinh(), (q * z).cosh());
        let power = |n: i32| q.powi(n);
        let (even, odd) = if n.is_multiple_of(2) { (c, s) } else { (s, c) };
        let (k, m) = (n as i32, n as f64);
        let before = if n == 0 { [0.0, 0.0] } else { [m * power(k - 1) * odd, m * power(k - 1) * even] };
        [power(k) * even, power(k) * odd, z * power(k) * even + before[0], z * power(k) * odd + before[1]]
    };
    let row = |z: f64, weights: &[(usize, f64)]| -> [f64; 4] {
        let mut row = [0.0; 4];
        for &(n, weight) in weights {
            row.iter_mut().zip(of(n, z)).for_each(|(sum, value)| *sum += weight * value);
        }
        row
    };
    let sinks = [(3, (1.0 - poisson) / (q * q)), (1, -(2.0 - poisson))];
    let sticks = [(2, 1.0 - poisson), (0, poisson * q * q)];
    let slides = [(1, 1.0)];
    let side = if base == Base::Bonded { row(thickness, &sticks) } else { row(thickness, &slides) };
    let mut system = [
        (row(0.0, &[(0, 1.0)]), 1.0 / (q * q)), // the pressure
        (row(0.0, &[(1, 1.0)]), 0.0),           // no friction
        (row(thickness, &sinks), 0.0),
        (side, 0.0),
    ];
    let coefficients = solved(&mut system);
    let surface = row(0.0, &sinks);
    surface.iter().zip(coefficients).map(|(a, b)| a * b).sum::<f64>() / (2.0 * shear)
}

/// Gaussian elimination with pivots.
fn solved(system: &mut [([f64; 4], f64); 4]) -> [f64; 4] {
    for k in 0..4 {
        let pivot = (k..4).max_by(|&a, &b| system[a].0[k].abs().total_cmp(&system[b].0[k].abs())).unwrap();
        system.swap(k, pivot);
        for i in k + 1..4 {
            let factor = system[i].0[k] / system[k].0[k];
            let (row, right) = system[k];
            system[i].0.iter_mut().zip(row).for_each(|(value, above)| *value -= factor * above);
            system[i].1 -= factor * right;
        }
    }
    let mut x = [0.0; 4];
    for k in (0..4).rev() {
        let known: f64 = (k + 1..4).map(|j| system[k].0[j] * x[j]).sum();
        x[k] = (system[k].1 - known) / system[k].0[k];
    }
    x
}

#[test]
fn factors_are_those_of_the_equations_of_elasticity() {
    for base in BASES {
        for poisson in [0.0, 0.3, 0.45, 0.5] {
            for x in [0.02, 0.0499, 0.0501, 0.2, 1.0, 3.0, 6.0] {
                let q = x / 0.7;
                let (expected, found) =
                    (by_elasticity(poisson, 0.7, base, q), 2.0 / q * layer(poisson, 0.7, base).factor(q));
                assert!(
                    (found / expected - 1.0).abs() < 1e-5,
                    "{base:?}, nu {poisson}, qt {x}: {found} for {expected}"
                );
            }
        }
    }
}

#[test]
fn waves_respond_as_the_direct_sum_on_lines_and_surfaces() {
    let grids = [
        Grid::line(31, 0.5),
        Grid::line(64, 2.0),
        Grid::surface([12, 16], [1.0, 3.0]),
        Grid::surface([7, 5], [2.0, 2.0]),
    ];
    for grid in grids.map(Result::unwrap) {
        for base in BASES {
            let solid: Arc<dyn ElasticSolid> = layer(0.4, 0.1, base).into();
            let pressure: Vec<f64> = (0..grid.len()).map(|i| ((i * i) as f64 * 0.7).sin() + 0.3).collect();
            let mean = pressure.iter().sum::<f64>() / grid.len() as f64;
            let sinking = solid.uniform_compliance().unwrap() * mean;
            let mut fast = vec![0.0; grid.len()];
            Response::new(&grid, solid.clone()).unwrap().displacement(&pressure, &mut fast);
            for (fast, slow) in fast.iter().zip(direct::displacement(&grid, solid.as_ref(), &pressure)) {
                assert!((fast - sinking - slow).abs() < 1e-14, "{grid:?}, {base:?}: {fast} and {slow}");
            }
        }
    }
}

/// A long line in pieces and a short one of the same waves.
#[test]
fn long_lines_have_their_waves_in_the_right_places() {
    let solid = || layer(0.3, 0.01, Base::Bonded);
    let wave = |points: usize, k: usize| -> Vec<f64> {
        (0..points).map(|i| (std::f64::consts::TAU * ((i * k) % points) as f64 / points as f64).cos()).collect()
    };
    for k in [1, 7, 300, 20_001] {
        let grid = Grid::line(1 << 16, 1.0).unwrap();
        let mut u = vec![0.0; grid.len()];
        Response::new(&grid, solid()).unwrap().displacement(&wave(grid.len(), k), &mut u);
        let q = std::f64::consts::TAU * k as f64;
        let expected = 2.0 / q * solid().factor(q);
        assert!((u[0] / expected - 1.0).abs() < 1e-10, "{k}: {} for {expected}", u[0]);
    }
}

fn rough(grid: Grid) -> Surface {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 0.07, rms_gradient: 0.1 };
    Surface::rough(grid, &spectrum, 3).unwrap()
}

fn solved_on(surface: &Surface, solid: impl Into<Arc<dyn ElasticSolid>>, load: Load) -> Contact {
    let problem = Problem::new(surface.clone(), solid, load).unwrap();
    let [fast, slow] = [&Multilevel as &dyn Solver, &PolonskyKeer].map(|solver| {
        solver.solve(&problem, &Stop::new(1e-10, 100_000).unwrap(), &mut ()).unwrap().converged().unwrap()
    });
    let difference = (&fast.pressure - &slow.pressure).mapv(|d| d * d).sum().sqrt();
    let size = slow.pressure.mapv(|p| p * p).sum().sqrt();
    assert!(difference < 1e-4 * size, "the solvers differ by {}", difference / size);
    fast
}

#[test]
fn a_thick_layer_is_a_half_space_and_a_thin_one_is_not() {
    for grid in [Grid::line(512, 1.0).unwrap(), Grid::surface([64, 64], [1.0, 1.0]).unwrap()] {
        let surface = rough(grid);
        let load = Load::ReducedPressure(0.05);
        let deep = solved_on(&surface, HalfSpace::new(1.0), load);
        for base in BASES {
            let apart = |thickness: f64| {
                let contact = solved_on(&surface, layer(0.3, thickness, base), load);
                (&contact.pressure - &deep.pressure).mapv(f64::abs).sum() / deep.pressure.sum()
            };
            assert!(apart(10.0) < 1e-6, "{}", apart(10.0));
            assert!(apart(0.03) > 0.1, "{}", apart(0.03));
        }
    }
}

/// Thin, bonded and compressible: `p = (delta - x^2 / 2 R) / c` with the uniform compliance `c`, so `P = 2 a^3 / (3 R c)`.
#[test]
fn a_cylinder_on_a_thin_bonded_layer_meets_winklers_foundation() {
    let (radius, thickness, load) = (10.0, 0.002, 1e-3);
    let surface = Indenter::Cylinder { radius }.surface(Grid::line(8192, 4.0).unwrap()).unwrap();
    let solid = layer(0.2, thickness, Base::Bonded);
    let compliance = solid.uniform_compliance().unwrap();
    let a = (1.5 * 4.0 * load * radius * compliance).cbrt();
    let contact = solved_on(&surface, solid, Load::MeanPressure(load));
    // corrections are of the order t / a
    let found = 0.5 * 4.0 * contact.resolved().relative_area;
    assert!(a > 20.0 * thickness && (found / a - 1.0).abs() < 0.02, "{found} for {a}");
    let approach = a * a / (2.0 * radius);
    assert!((contact.approach().unwrap() / approach - 1.0).abs() < 0.05, "{:?} for {approach}", contact.approach());
}

#[test]
fn at_the_approach_that_a_pressure_makes_the_pressure_is_the_same() {
    let surface = rough(Grid::surface([32, 48], [1.0, 1.5]).unwrap());
    for base in BASES {
        let pressed = solved_on(&surface, layer(0.3, 0.2, base), Load::ReducedPressure(0.05));
        let apart = solved_on(&surface, layer(0.3, 0.2, base), Load::Approach(pressed.approach().unwrap()));
        assert!((apart.mean_pressure() / pressed.mean_pressure() - 1.0).abs() < 1e-5);
        assert!((apart.mean_gap() / pressed.mean_gap() - 1.0).abs() < 1e-5);
        assert!((apart.approach().unwrap() / pressed.approach().unwrap() - 1.0).abs() < 1e-9);
        let gap = solved_on(&surface, layer(0.3, 0.2, base), Load::MeanGap(pressed.mean_gap()));
        assert!((gap.mean_pressure() / pressed.mean_pressure() - 1.0).abs() < 1e-5);
    }
}

/// The elastic energy is the work of the load on its way, `U = integral of <p> dd` over the approach `d`, however the load is given.
#[test]
fn the_elastic_energy_is_the_work_of_the_load() {
    let surface = rough(Grid::line(256, 1.0).unwrap());
    for base in BASES {
        let contact = |load: f64| solved_on(&surface, layer(0.3, 0.05, base), Load::ReducedPressure(load));
        let (mut work, mut before) = (0.0, [0.0, 0.0]);
        for i in 1..=48 {
            let pressed = contact(0.2 * (f64::from(i) / 48.0).powi(2));
            let now = [pressed.mean_pressure(), pressed.approach().unwrap()];
            work += 0.5 * (now[0] + before[0]) * (now[1] - before[1]);
            before = now;
        }
        let pressed = contact(0.2);
        let apart = solved_on(&surface, layer(0.3, 0.05, base), Load::Approach(pressed.approach().unwrap()));
        for energy in [pressed.elastic_energy(), apart.elastic_energy()] {
            assert!((energy / work - 1.0).abs() < 2e-3, "{base:?}: {energy} for the work {work}");
        }
    }
}

/// Differences of the compliance of long waves, two terms of whose series are known, with the third one extrapolated away.
#[test]
fn long_waves_of_a_bonded_layer_follow_their_polynomial() {
    for poisson in [0.0, 0.2, 0.25, 0.3, 0.4, 0.45, 0.49, 0.4999, 0.5] {
        let layer = Layer { contact_modulus: 3.0, ..layer(poisson, 0.2, Base::Bonded) };
        let waves = layer.long_waves().unwrap();
        let compliance = |x: f64| 2.0 * layer.factor(x / 0.2) / (3.0 * x / 0.2);
        let square = |x: f64| (compliance(x) - waves.longest) / (x / 0.2).powi(2);
        let found = (4.0 * square(0.02) - square(0.04)) / 3.0;
        let scale = 0.2_f64.powi(3) / 3.0;
        assert!((found.max(0.0) - waves.square).abs() < 1e-5 * scale, "{poisson}: {found} and {}", waves.square);
        assert!((waves.stiffness(0.1) * compliance(0.02) - 1.0).abs() < 2e-3 || poisson < 0.25, "{poisson}");
    }
    let incompressible = layer(0.5, 0.2, Base::Bonded).long_waves().unwrap();
    assert_eq!((incompressible.longest, incompressible.thickness), (0.0, 0.2));
    assert!((incompressible.square / (4.0 / 3.0 * 0.2_f64.powi(3)) - 1.0).abs() < 1e-12);
    assert!(layer(0.5, 0.2, Base::Sliding).long_waves().is_none() && HalfSpace::new(1.0).long_waves().is_none());
}
