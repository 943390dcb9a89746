//! Stress and displacement by a plastic strain below the surface, against numbers of another implementation, closed forms, Betti's theorem and Green's function.

use asperity::Grid;
use asperity::elastic::{DepthLayers, DepthResponse};
use ndarray::Array3;
use std::f64::consts::{PI, TAU};

const POISSON: f64 = 0.3;

fn uneven() -> DepthLayers {
    DepthLayers::new(vec![0.0, 0.1, 0.25, 0.5]).unwrap()
}

fn response(grid: &Grid, layers: DepthLayers) -> DepthResponse {
    DepthResponse::new(grid, 1.0, POISSON, layers).unwrap()
}

/// A strain by layer, component, row and column.
fn strain(grid: &Grid, layers: usize, value: impl Fn(usize, usize, [usize; 2]) -> f64) -> Array3<f64> {
    let nx = grid.shape()[1];
    let shape = (layers, DepthResponse::components(grid), grid.len());
    Array3::from_shape_fn(shape, |(layer, component, node)| value(layer, component, [node / nx, node % nx]))
}

/// Values without any order.
fn noise(grid: &Grid, layers: usize, seed: usize) -> Array3<f64> {
    let value = |i: usize| ((i * 7919 + seed * 104_729) as f64 * 0.618_033_988_7).fract() - 0.5;
    let (components, nodes) = (DepthResponse::components(grid), grid.len());
    strain(grid, layers, |j, c, [y, x]| value((j * components + c) * nodes + y * grid.shape()[1] + x))
}

fn sunk(response: &mut DepthResponse, strain: &Array3<f64>) -> Vec<f64> {
    let mut displacement = vec![0.0; strain.dim().2];
    response.residual_displacement(strain, &mut displacement);
    displacement
}

/// `sum_j h_j <a : b>`.
fn product(layers: &DepthLayers, a: &Array3<f64>, b: &Array3<f64>) -> f64 {
    let terms = a.indexed_iter().map(|((layer, component, node), value)| {
        let weight = if component < 3 { 1.0 } else { 2.0 };
        weight * layers.thickness(layer) * value * b[[layer, component, node]]
    });
    terms.sum::<f64>() / a.dim().2 as f64
}

fn assert_close(found: impl IntoIterator<Item = f64>, expected: &[f64], tolerance: f64) {
    let found: Vec<f64> = found.into_iter().collect();
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() <= tolerance, "{found:.9} against {expected:.9}");
    }
}

/// All components of a stress below one node, layer by layer.
fn below(stress: &Array3<f64>, node: usize) -> Vec<f64> {
    let (layers, components, _) = stress.dim();
    (0..layers).flat_map(|j| (0..components).map(move |c| (j, c))).map(|(j, c)| stress[[j, c, node]]).collect()
}

#[test]
fn a_line_responds_as_in_another_implementation() {
    let grid = Grid::line(8, 1.0).unwrap();
    let value = |j: usize, c: usize, [_, i]: [usize; 2]| {
        0.1 * (c + 1) as f64 * (TAU * i as f64 / 8.0 * (1 + j % 2) as f64 + (c + j) as f64).cos()
    };
    let (mut response, strain) = (response(&grid, uneven()), strain(&grid, 3, value));
    let half = 0.500_000_1e-8;
    assert_close(
        sunk(&mut response, &strain)[..4].iter().copied(),
        &[-0.024_979_16, -0.025_203_11, 0.012_379_85, 0.037_403_45],
        half,
    );
    let expected = [
        [-0.092_536_22, -0.133_349_52, 0.008_239_36, 0.044_665_98],
        [-0.063_412_07, 0.110_183_86, 0.153_260_38, 0.056_349_30],
        [0.088_696_01, 0.304_622_27, 0.266_716_58, -0.092_575_25],
    ];
    assert_close(below(&response.residual_stress(&strain), 0), expected.as_flattened(), half);
    let pressure: Vec<f64> = (0..8).map(|i| (TAU * f64::from(i) / 8.0).cos().max(0.0)).collect();
    let expected = [
        [-0.322_143_44, -0.298_195_50, -0.671_841_55, -0.145_058_68],
        [-0.123_447_85, -0.203_272_65, -0.554_127_64, -0.186_841_46],
        [-0.086_296_87, -0.151_579_76, -0.418_969_01, -0.093_162_48],
    ];
    assert_close(below(&response.elastic_stress(&pressure), 1), expected.as_flattened(), half);
}

#[test]
fn a_surface_responds_as_in_another_implementation() {
    let grid = Grid::surface([5, 6], [1.2, 1.0]).unwrap();
    let value = |j: usize, c: usize, [y, x]: [usize; 2]| {
        0.1 * (c + 1) as f64 * (TAU * (x as f64 / 6.0 + y as f64 / 5.0) + (c + j) as f64).cos()
    };
    let (mut response, strain) = (response(&grid, uneven()), strain(&grid, 3, value));
    let half = 0.500_000_1e-8;
    assert_close(sunk(&mut response, &strain)[..3].iter().copied(), &[-0.034_367_07, 0.102_539_34, 0.136_906_41], half);
    let expected = [
        [-0.484_012_70, -0.437_160_97, 0.056_139_30, 0.125_520_25, 0.130_550_33, -0.007_136_41],
        [-0.036_391_43, 0.155_032_58, 0.298_320_60, 0.160_055_75, 0.058_942_14, -0.171_338_37],
        [0.215_508_43, 0.237_875_83, 0.305_369_89, -0.137_497_35, -0.088_072_51, -0.156_287_21],
    ];
    assert_close(below(&response.residual_stress(&strain), 0), expected.as_flattened(), half);
}

fn some_grids() -> [Grid; 4] {
    [
        Grid::line(8, 1.0).unwrap(),
        Grid::line(9, 1.3).unwrap(),
        Grid::surface([6, 8], [1.0, 1.7]).unwrap(),
        Grid::surface([5, 7], [1.0, 1.0]).unwrap(),
    ]
}

#[test]
fn the_operators_are_adjoint_symmetric_and_bounded() {
    for grid in some_grids() {
        let (mut response, layers) = (response(&grid, uneven()), uneven());
        let (a, b) = (noise(&grid, 3, 1), noise(&grid, 3, 2));
        let pressure: Vec<f64> = noise(&grid, 3, 3).iter().copied().take(grid.len()).collect();
        // the load does the same work on the residual displacement as its stress on the strain
        let elastic = response.elastic_stress(&pressure);
        let work = product(&layers, &elastic, &a);
        let displaced = sunk(&mut response, &a);
        let surface = displaced.iter().zip(&pressure).map(|(u, p)| u * p).sum::<f64>() / grid.len() as f64;
        assert!((work - surface).abs() < 1e-14 * work.abs().max(1e-2), "{work} against {surface}");
        let (of_a, of_b) = (response.residual_stress(&a), response.residual_stress(&b));
        let [there, back] = [product(&layers, &of_a, &b), product(&layers, &of_b, &a)];
        assert!((there - back).abs() < 1e-14 * there.abs().max(1e-2), "{there} against {back}");
        // a plastic strain stores energy, at most that of a body that is held all around, C : e : e
        let trace = Array3::from_shape_fn(
            a.dim(),
            |(j, c, i)| {
                if c < 3 { (0..3).map(|c| a[[j, c, i]]).sum::<f64>() } else { 0.0 }
            },
        );
        let (shear, lame) = (0.5 / (1.0 + POISSON), POISSON / (1.0 + POISSON) / (1.0 - 2.0 * POISSON));
        let stored = -product(&layers, &of_a, &a);
        assert!(stored > 0.0 && stored < product(&layers, &(2.0 * shear * &a + lame * trace), &a));
    }
}

#[test]
fn a_uniform_layer_is_held_along_the_surface_only() {
    let grid = Grid::surface([4, 6], [1.0, 1.0]).unwrap();
    let lateral = POISSON / (1.0 - POISSON);
    let modulus = 1.0 / (1.0 - POISSON * POISSON);
    for (component, sinks, stress) in [
        (0, lateral, [-modulus, -POISSON * modulus, 0.0]),
        (1, lateral, [-POISSON * modulus, -modulus, 0.0]),
        (2, 1.0, [0.0; 3]),
    ] {
        let mut response = response(&grid, uneven());
        let strain = strain(&grid, 3, |j, c, _| if (j, c) == (1, component) { 1.0 } else { 0.0 });
        assert_close(sunk(&mut response, &strain), &[-0.15 * sinks; 24], 1e-15);
        let found = below(&response.residual_stress(&strain), 5);
        assert_close(found[6..9].iter().copied(), &stress, 1e-14);
        assert!(found[..6].iter().chain(&found[9..]).all(|value| value.abs() < 1e-15));
    }
}

/// Between a surface without traction and a deep solid, layer means of `zz` and of the shear fade towards the surface as the square and the
/// first power of the depth of their layer.
#[test]
fn the_surface_carries_no_traction() {
    let grid = Grid::surface([6, 8], [1.0, 1.0]).unwrap();
    let deep = |thin: f64| {
        let layers = DepthLayers::new(vec![0.0, thin, 0.1, 0.2, 0.4]).unwrap();
        let mut response = response(&grid, layers);
        let given = noise(&grid, 4, 5);
        // the thin layer itself has no strain
        let strain = strain(&grid, 4, |j, c, [y, x]| if j == 0 { 0.0 } else { given[[j, c, 8 * y + x]] });
        let stress = response.residual_stress(&strain);
        [2, 4, 5].map(|c| (0..grid.len()).map(|i| stress[[0, c, i]].abs()).fold(0.0, f64::max))
    };
    let [thick, thin] = [deep(1e-4), deep(1e-5)];
    assert!(thin[0] < 1.2e-2 * thick[0], "{thin:?} {thick:?}");
    assert!(thin[1] < 0.12 * thick[1] && thin[2] < 0.12 * thick[2], "{thin:?} {thick:?}");
}

#[test]
fn a_surface_on_which_nothing_varies_along_y_is_a_line() {
    for (nx, ny) in [(8, 4), (9, 5)] {
        let (line, surface) = (Grid::line(nx, 1.0).unwrap(), Grid::surface([ny, nx], [0.7, 1.0]).unwrap());
        let given = noise(&line, 3, 7);
        // xx, yy, zz and xz among the components of a surface
        let of_line = [Some(0), Some(1), Some(2), None, Some(3), None];
        let spread = strain(&surface, 3, |j, c, [_, x]| of_line[c].map_or(0.0, |c| given[[j, c, x]]));
        let (mut a, mut b) = (response(&line, uneven()), response(&surface, uneven()));
        let (flat, wide) = (a.residual_stress(&given), b.residual_stress(&spread));
        for ((j, c, i), found) in wide.indexed_iter() {
            let expected = of_line[c].map_or(0.0, |c| flat[[j, c, i % nx]]);
            assert!((found - expected).abs() < 1e-14, "{found} against {expected}");
        }
        let (flat, wide) = (sunk(&mut a, &given), sunk(&mut b, &spread));
        assert_close(wide[nx..2 * nx].iter().copied(), &flat, 1e-15);
    }
}

/// A mirrored strain causes the mirrored stress, also where waves are at the Nyquist wavenumber.
#[test]
fn mirror_images_respond_as_mirror_images() {
    for grid in [Grid::surface([6, 8], [1.0, 1.3]).unwrap(), Grid::surface([5, 8], [1.0, 1.0]).unwrap()] {
        let [ny, nx] = grid.shape();
        let given = noise(&grid, 3, 11);
        for (along_x, odd) in [(true, [3, 4]), (false, [3, 5])] {
            let mirrored = |field: &Array3<f64>| {
                strain(&grid, 3, |j, c, [y, x]| {
                    let [y, x] = if along_x { [y, (nx - x) % nx] } else { [(ny - y) % ny, x] };
                    let sign = if odd.contains(&c) { -1.0 } else { 1.0 };
                    sign * field[[j, c, y * nx + x]]
                })
            };
            let mut response = response(&grid, uneven());
            let direct = mirrored(&response.residual_stress(&given));
            let found = response.residual_stress(&mirrored(&given));
            assert!(direct.iter().zip(&found).all(|(a, b)| (a - b).abs() < 1e-14));
        }
    }
}

/// `B(z, z')` of `(d^2/dz^2 - q^2)^2 B = delta`, with neither value nor slope at the surface, and its derivative along `z'`.
fn green(q: f64, z: f64, at: f64) -> [f64; 2] {
    let (r, sum) = (z - at, z + at);
    let direct = (1.0 + q * r.abs()) * (-q * r.abs()).exp();
    let image = (1.0 + q * sum + 2.0 * q * q * z * at) * (-q * sum).exp();
    let slope_direct = q * q * r * (-q * r.abs()).exp();
    let slope_image = (-q * q * sum + 2.0 * q * q * z - 2.0 * q * q * q * z * at) * (-q * sum).exp();
    let scale = 1.0 / (4.0 * q * q * q);
    [scale * (direct - image), scale * (slope_direct - slope_image)]
}

/// Simpson's rule.
fn integral(from: f64, to: f64, value: impl Fn(f64) -> f64) -> f64 {
    let (count, h) = (200, (to - from) / 200.0);
    let weight = |i: usize| if i == 0 || i == count { 1.0 } else { 2.0 * (1 + i % 2) as f64 };
    (0..=count).map(|i| weight(i) * value(from + i as f64 * h)).sum::<f64>() * h / 3.0
}

/// One wave of strain by integrals of Green's function: `phi = -E* int [a B'' - q^2 c B + 2 i q e_nz B'] dz'`, with two integrals by parts.
#[test]
fn one_wave_is_an_integral_of_greens_function() {
    let (grid, layers) = (Grid::line(16, 1.0).unwrap(), uneven());
    let (harmonic, modulus) = (3.0, 1.0 / (1.0 - POISSON * POISSON));
    let q = TAU * harmonic;
    let amplitudes = [[0.3, -0.2, 0.5, 0.4], [-0.7, 0.1, 0.2, -0.3], [0.25, 0.6, -0.4, 0.8]];
    // xz is a quarter of a wave ahead, so that phi has the phase of the cosine
    let wave = |j: usize, c: usize, [_, i]: [usize; 2]| {
        let angle = TAU * harmonic * i as f64 / 16.0;
        amplitudes[j][c] * if c == 3 { angle.sin() } else { angle.cos() }
    };
    let phi = |z: f64| {
        let parts = (0..3).map(|j| {
            let [xx, yy, zz, xz] = amplitudes[j];
            let (a, c) = (xx + POISSON * yy, zz + POISSON * yy);
            let [top, bottom] = [layers.interfaces()[j], layers.interfaces()[j + 1]];
            let [above, below] = [green(q, z, top), green(q, z, bottom)];
            let split = z.clamp(top, bottom);
            let whole = [(top, split), (split, bottom)].map(|(a, b)| integral(a, b, |at| green(q, z, at)[0]));
            // sin is -i times a wave
            a * (below[1] - above[1]) - q * q * c * (whole[0] + whole[1]) + 2.0 * q * xz * (below[0] - above[0])
        });
        -modulus * parts.sum::<f64>()
    };
    let stress = response(&grid, uneven()).residual_stress(&strain(&grid, 3, wave));
    for j in 0..3 {
        let [top, bottom] = [layers.interfaces()[j], layers.interfaces()[j + 1]];
        let h = bottom - top;
        // the slope from one side, since that from the other side begins with the strain of another layer
        let slope = |z: f64, step: f64| {
            let weights = [-25.0, 48.0, -36.0, 16.0, -3.0];
            (0..5).map(|i| weights[i] * phi(z + i as f64 * step)).sum::<f64>() / (12.0 * step)
        };
        let zz = -q * q * integral(top, bottom, phi) / h;
        assert!((stress[[j, 2, 0]] - zz).abs() < 1e-8, "zz {} against {zz}", stress[[j, 2, 0]]);
        // -i q phi' of a cosine is q phi' of a sine
        let xz = q * (phi(bottom) - phi(top)) / h;
        let found = (0..16).map(|i| stress[[j, 3, i]] * (q * i as f64 / 16.0).sin()).sum::<f64>() / 8.0;
        assert!((found - xz).abs() < 1e-8, "xz {found} against {xz}");
        let nn = (slope(bottom, -5e-3 * h) - slope(top, 5e-3 * h)) / h;
        assert!((stress[[j, 0, 0]] - nn).abs() < 1e-6, "nn {} against {nn}", stress[[j, 0, 0]]);
    }
}

/// A cylinder along `y` that dilates, at a depth: `u = -2 (1 + nu) R^2 d / (x^2 + d^2)`, and its images.
#[test]
fn a_dilating_cylinder_lifts_the_surface() {
    let (radius, depth, length) = (1.0, 4.0, 40.0);
    let exact = |x: f64| {
        let image = |n: i32| depth / ((x - f64::from(n) * length).powi(2) + depth * depth);
        -2.0 * (1.0 + POISSON) * radius * radius * (-4000..=4000).map(image).sum::<f64>()
    };
    let expected = exact(0.0) - exact(0.5 * length);
    assert!((expected + 0.609_123).abs() < 1e-4);
    let found = |nx: usize| {
        let grid = Grid::line(nx, length).unwrap();
        let layers = DepthLayers::uniform(nx * 5 / 32, 2.0 * depth - 1.75).unwrap();
        let middles: Vec<f64> = (0..layers.count()).map(|j| layers.middle(j)).collect();
        let mut response = response(&grid, layers);
        let inside = |j: usize, i: usize| {
            let x = (i as f64 / nx as f64 - 0.5) * length;
            x.hypot(middles[j] - depth) < radius
        };
        let strain = strain(&grid, middles.len(), |j, c, [_, i]| if c < 3 && inside(j, i) { 1.0 } else { 0.0 });
        let volume =
            (0..middles.len()).flat_map(|j| (0..nx).map(move |i| (j, i))).filter(|&(j, i)| inside(j, i)).count();
        let volume = volume as f64 * length / nx as f64 * response.layers().thickness(0);
        let u = sunk(&mut response, &strain);
        // the staircase of the grid has another volume
        (u[nx / 2] - u[0]) * PI / volume
    };
    let [coarse, fine] = [found(256), found(1024)];
    assert!((fine / expected - 1.0).abs() < 2e-3, "{fine} against {expected}");
    assert!((fine - expected).abs() < (coarse - expected).abs(), "{coarse} {fine} against {expected}");
}

/// A sphere that dilates at a depth: `u = -(1 + nu) V d / (pi r^3)` and its images; inside, the stress of a sphere in a whole space.
#[test]
fn a_dilating_sphere_lifts_the_surface() {
    let (radius, depth, length, n) = (1.0, 3.0, 24.0, 96);
    let grid = Grid::surface([n, n], [length; 2]).unwrap();
    let layers = DepthLayers::uniform(24, 6.0).unwrap();
    let middles: Vec<f64> = (0..24).map(|j| layers.middle(j)).collect();
    let place = |i: usize| (i as f64 / n as f64 - 0.5) * length;
    let inside = |j: usize, [y, x]: [usize; 2]| place(x).hypot(place(y)).hypot(middles[j] - depth) < radius;
    let strain = strain(&grid, 24, |j, c, at| if c < 3 && inside(j, at) { 1.0 } else { 0.0 });
    let cells = strain.iter().sum::<f64>() / 3.0;
    let volume = cells * (length / n as f64).powi(2) * 0.25;
    let mut response = response(&grid, layers);
    let u = sunk(&mut response, &strain);
    let exact = |x: f64| {
        let images = (-60..=60).flat_map(|a: i32| (-60..=60).map(move |b: i32| (a, b)));
        let parts = images.map(|(a, b)| {
            let (x, y) = (x - f64::from(a) * length, f64::from(b) * length);
            depth / (x * x + y * y + depth * depth).powf(1.5)
        });
        -(1.0 + POISSON) * volume / PI * parts.sum::<f64>()
    };
    let (found, expected) = (u[(n / 2) * n + n / 2] - u[(n / 2) * n], exact(0.0) - exact(0.5 * length));
    assert!((found / expected - 1.0).abs() < 5e-3, "{found} against {expected}");
    let stress = response.residual_stress(&strain);
    let expected = -2.0 / (3.0 * (1.0 - POISSON));
    for component in 0..3 {
        // between the two layers about the centre
        let found = stress[[11, component, (n / 2) * n + n / 2]];
        assert!((found / expected - 1.0).abs() < 0.04, "{found} against {expected}");
    }
}

#[test]
fn impossible_layers_and_solids_are_refused() {
    let grid = Grid::line(8, 1.0).unwrap();
    let said = |result: Result<DepthResponse, asperity::error::PlasticError>| result.err().unwrap().to_string();
    let new = |young, poisson| DepthResponse::new(&grid, young, poisson, uneven());
    assert!(said(new(-1.0, 0.3)).contains("Young's modulus is -1.0"));
    assert!(said(new(1.0, 0.6)).contains("0.6"));
    let free = grid.with_periodic([false; 2]);
    assert!(said(DepthResponse::new(&free, 1.0, 0.3, uneven())).contains("periodic"));
    for bad in [vec![], vec![0.0], vec![0.1, 0.2], vec![0.0, 0.2, 0.2], vec![0.0, f64::NAN], vec![0.0, f64::INFINITY]] {
        assert!(DepthLayers::new(bad).is_err());
    }
    assert!(DepthLayers::graded(0.0, 1.1, 1.0).is_err() && DepthLayers::graded(0.1, 0.9, 1.0).is_err());
    assert!(DepthLayers::graded(1e-9, 1.0, 1.0).is_err() && DepthLayers::uniform(0, 1.0).is_err());
    assert!(DepthLayers::uniform(usize::MAX, 1.0).is_err());
}
