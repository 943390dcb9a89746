//! The stress below the surface, against closed forms and equilibrium.

use asperity::Grid;
use asperity::elastic::stress::{Tensor, depths, highest_row, under_row, under_strips};
use asperity::elastic::{Response, Stress};
use std::f64::consts::TAU;

/// A Hertzian pressure of unit peak and half-width `a` about the middle of a line of `points`, one apart.
fn hertz_line(points: usize, a: f64) -> Vec<f64> {
    let middle = (points / 2) as f64;
    (0..points).map(|i| (1.0 - ((i as f64 - middle) / a).powi(2)).max(0.0).sqrt()).collect()
}

fn noise(n: usize) -> Vec<f64> {
    (0..n).map(|i| ((i % 1009 * (i % 911)) as f64 * 0.7).sin() + 1.3).collect()
}

/// The largest of a field, and where it is.
fn highest(field: &ndarray::Array2<f64>) -> (f64, [usize; 2]) {
    let of = |most: (f64, [usize; 2]), ((row, column), &value): ((usize, usize), &f64)| {
        if value > most.0 { (value, [row, column]) } else { most }
    };
    field.indexed_iter().fold((0.0, [0, 0]), of)
}

/// McEwen's closed form below the axis of a Hertzian line of unit peak: `sigma_x`, `sigma_z` (Johnson, Eqs. 4.46).
fn mcewen_axis(z: f64) -> [f64; 2] {
    let root = (1.0 + z * z).sqrt();
    [-((1.0 + 2.0 * z * z) / root - 2.0 * z), -1.0 / root]
}

#[test]
fn below_a_hertzian_line_shear_is_largest_at_0_78_a() {
    let (points, a) = (4096, 256.0);
    let depth: Vec<f64> = (1..=200).map(|i| 0.01 * a * i as f64).collect();
    let stress = under_strips(&hertz_line(points, a), 1.0, 0.3, &depth).unwrap();
    let (tau, [row, column]) = highest(&stress.tau_max());
    assert!((tau - 0.30).abs() < 0.002, "{tau} against 0.30 (Johnson, Eq. 4.47)");
    assert!((depth[row] / a - 0.78).abs() < 0.02, "at a depth of {} a", depth[row] / a);
    assert_eq!(column, points / 2);
}

#[test]
fn below_the_axis_of_a_hertzian_line_stress_is_that_of_mcewen() {
    let (points, a) = (4096, 256.0);
    let depth = depths(8.0, 8.0 * a, 40);
    let stress = under_strips(&hertz_line(points, a), 1.0, 0.3, &depth).unwrap();
    for (row, z) in depth.iter().enumerate() {
        let found = stress.at([row, points / 2]);
        let [xx, zz] = mcewen_axis(z / a);
        assert!((found.xx - xx).abs() < 5e-4 && (found.zz - zz).abs() < 5e-4, "{found:?} against {xx}, {zz} at {z}");
        assert!(found.xz.abs() < 1e-12 && (found.yy - 0.3 * (found.xx + found.zz)).abs() < 1e-15);
    }
}

#[test]
fn a_hertzian_line_in_a_large_cell_is_that_without_neighbours() {
    let (points, a) = (1 << 15, 32.0);
    let depth: Vec<f64> = (1..=60).map(|i| 0.05 * a * i as f64).collect();
    let line = Grid::line(points, points as f64).unwrap();
    let stress = under_row(&line, &hertz_line(points, a), 0, 0.3, &depth).unwrap();
    let (tau, [row, column]) = highest(&stress.tau_max());
    assert!((tau - 0.30).abs() < 0.002 && (depth[row] / a - 0.78).abs() < 0.04, "{tau} at {} a", depth[row] / a);
    assert_eq!(column, points / 2);
}

/// The sum of what strips do, with images on both sides. The mean pressure of a cell is carried without lateral strain, but that of
/// a free line strains: the difference is the same everywhere.
#[test]
fn waves_are_strips_with_all_their_images() {
    let (points, spacing, poisson) = (256, 0.5, 0.2);
    let pressure: Vec<f64> = (0..points).map(|i| (1.0 - (i as f64 - 128.0).abs() / 40.0).max(0.0)).collect();
    let mean = pressure.iter().sum::<f64>() / points as f64;
    let depth = [2.0, 5.0, 20.0];
    let grid = Grid::line(points, points as f64 * spacing).unwrap();
    let waves = under_row(&grid, &pressure, 0, poisson, &depth).unwrap();
    let images = 401;
    let strips = under_strips(&pressure.repeat(images), spacing, poisson, &depth).unwrap();
    let confined = mean * (1.0 - poisson / (1.0 - poisson));
    let middle = images / 2 * points;
    for row in 0..depth.len() {
        for column in 0..points {
            let (wave, strip) = (waves.at([row, column]), strips.at([row, middle + column]));
            let differences = [wave.zz - strip.zz, wave.xz - strip.xz, wave.xx - confined - strip.xx];
            // those from far images fall with their distance, those of the elements with their width
            assert!(differences.iter().all(|it| it.abs() < 2e-3), "{differences:?} at {row}, {column}");
        }
    }
}

#[test]
fn the_surface_carries_the_pressure_and_no_shear() {
    let grids = [
        Grid::line(64, 3.0),
        Grid::line(31, 1.0),
        Grid::surface([12, 16], [1.0, 3.0]),
        Grid::surface([7, 9], [2.0, 1.0]),
    ];
    for grid in grids.map(Result::unwrap) {
        let (pressure, [ny, nx]) = (noise(grid.len()), grid.shape());
        for row in [0, ny / 2, ny - 1] {
            let stress = under_row(&grid, &pressure, row, 0.3, &[0.0]).unwrap();
            for column in 0..nx {
                let found = stress.at([0, column]);
                assert!((found.zz + pressure[row * nx + column]).abs() < 1e-13, "{grid:?}");
                assert!(found.xz.abs() + found.yz.abs() < 1e-13, "{grid:?}");
            }
        }
    }
    let strips = under_strips(&noise(33), 0.1, 0.3, &[0.0]).unwrap();
    for (column, pressure) in noise(33).into_iter().enumerate() {
        let found = strips.at([0, column]);
        assert!((found.zz + pressure).abs() + (found.xx + pressure).abs() + found.xz.abs() < 1e-13);
    }
}

#[test]
fn every_depth_carries_the_load() {
    let depth = depths(0.01, 3.0, 12);
    let line = Grid::line(100, 3.0).unwrap();
    let pressure = noise(100);
    let mean = pressure.iter().sum::<f64>() / 100.0;
    let stress = under_row(&line, &pressure, 0, 0.3, &depth).unwrap();
    for row in stress.zz.rows() {
        assert!((row.mean().unwrap() + mean).abs() < 1e-13);
    }
    let surface = Grid::surface([6, 10], [1.0, 3.0]).unwrap();
    let pressure = noise(60);
    let mean = pressure.iter().sum::<f64>() / 60.0;
    let cuts: Vec<Stress> = (0..6).map(|row| under_row(&surface, &pressure, row, 0.3, &depth).unwrap()).collect();
    for row in 0..depth.len() {
        let carried: f64 = cuts.iter().map(|cut| cut.zz.row(row).mean().unwrap()).sum();
        assert!((carried / 6.0 + mean).abs() < 1e-13);
    }
}

/// A smooth pressure on a surface, of some oblique waves, and its grid.
fn oblique() -> (Grid, Vec<f64>) {
    let n = 96;
    let grid = Grid::surface([n, n], [TAU, TAU]).unwrap();
    let at = |x: f64, y: f64| 3.0 + (x + 2.0 * y).cos() + 0.5 * (2.0 * x - y).sin() + 0.3 * (3.0 * x).cos();
    let step = TAU / n as f64;
    (grid, (0..n * n).map(|i| at((i % n) as f64 * step, (i / n) as f64 * step)).collect())
}

#[test]
fn forces_are_in_balance_in_every_place() {
    let (grid, pressure) = oblique();
    let ([ny, nx], [dy, dx]) = (grid.shape(), grid.spacing());
    let (z, dz) = (0.4, 0.02);
    let cut = |row: usize| under_row(&grid, &pressure, row, 0.3, &[z - dz, z, z + dz]).unwrap();
    let row = 17;
    let [before, here, after] = [row + ny - 1, row, row + 1].map(|row| cut(row % ny));
    for column in 0..nx {
        let at = |stress: &Stress, depth: usize, column: usize| stress.at([depth, (column + nx) % nx]);
        let difference = |of: fn(&Tensor) -> [f64; 3], high: Tensor, low: Tensor, distance: f64| -> [f64; 3] {
            let (high, low) = (of(&high), of(&low));
            [0, 1, 2].map(|i| (high[i] - low[i]) / (2.0 * distance))
        };
        let along_x = difference(|t| [t.xx, t.xy, t.xz], at(&here, 1, column + 1), at(&here, 1, column + nx - 1), dx);
        let along_y = difference(|t| [t.xy, t.yy, t.yz], at(&after, 1, column), at(&before, 1, column), dy);
        let along_z = difference(|t| [t.xz, t.yz, t.zz], at(&here, 2, column), at(&here, 0, column), dz);
        for i in 0..3 {
            let rest = along_x[i] + along_y[i] + along_z[i];
            assert!(rest.abs() < 0.01, "{rest} is left at {column}, along {i}");
        }
    }
}

/// Without body forces the trace of the stress is harmonic, whatever Poisson's ratio.
#[test]
fn the_trace_is_harmonic() {
    let (grid, pressure) = oblique();
    let [ny, nx] = grid.shape();
    let (z, step, poisson) = (0.5, grid.spacing()[1], 0.3);
    let cut = |row: usize| under_row(&grid, &pressure, row, poisson, &[z - step, z, z + step]).unwrap();
    let trace = |stress: &Stress, depth: usize, column: usize| {
        let found = stress.at([depth, column % nx]);
        found.xx + found.yy + found.zz
    };
    let row = 40;
    let [before, here, after] = [row - 1, row, row + 1].map(|row| cut(row % ny));
    for column in nx..2 * nx {
        let neighbours = trace(&here, 1, column - 1)
            + trace(&here, 1, column + 1)
            + trace(&before, 1, column)
            + trace(&after, 1, column)
            + trace(&here, 0, column)
            + trace(&here, 2, column);
        let laplacian = (neighbours - 6.0 * trace(&here, 1, column)) / step.powi(2);
        assert!(laplacian.abs() < 0.03, "{laplacian}");
    }
}

/// A sphere: `tau_max = 0.31 p0` at `0.48 a` below its middle for `nu = 0.3` (Johnson, section 3.4 and Eq. 4.24).
#[test]
fn below_a_hertzian_point_shear_is_largest_at_0_48_a() {
    let (n, a) = (512, 16.0);
    let grid = Grid::surface([n, n], [n as f64, n as f64]).unwrap();
    let middle = (n / 2) as f64;
    let radius = |i: usize| ((i % n) as f64 - middle).hypot((i / n) as f64 - middle);
    let pressure: Vec<f64> = (0..n * n).map(|i| (1.0 - (radius(i) / a).powi(2)).max(0.0).sqrt()).collect();
    let depth: Vec<f64> = (1..=40).map(|i| 0.04 * a * i as f64).collect();
    let row = highest_row(&grid, &pressure);
    assert_eq!(row, n / 2);
    let stress = under_row(&grid, &pressure, row, 0.3, &depth).unwrap();
    let (tau, [deep, column]) = highest(&stress.tau_max());
    assert!((tau - 0.31).abs() < 0.004, "{tau}");
    assert!((depth[deep] / a - 0.48).abs() < 0.05, "at {} a", depth[deep] / a);
    assert_eq!(column, n / 2);
    // sigma_zz = -1/(1 + z^2/a^2) on the axis, Johnson Eq. 3.46
    for (row, z) in depth.iter().enumerate() {
        assert!((stress.zz[[row, n / 2]] + 1.0 / (1.0 + (z / a).powi(2))).abs() < 0.01);
    }
}

/// Below waves that run along `x`, a surface is a line.
#[test]
fn a_surface_that_varies_along_x_is_a_line() {
    let (line, surface) = (Grid::line(40, 2.0).unwrap(), Grid::surface([6, 40], [1.0, 2.0]).unwrap());
    let (pressure, depth) = (noise(40), depths(0.02, 1.0, 9));
    let plane = under_row(&line, &pressure, 0, 0.4, &depth).unwrap();
    let cut = under_row(&surface, &pressure.repeat(6), 4, 0.4, &depth).unwrap();
    for (a, b) in [(&plane.xx, &cut.xx), (&plane.zz, &cut.zz), (&plane.xz, &cut.xz), (&plane.yy, &cut.yy)] {
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-13));
    }
    assert!(cut.xy.iter().chain(&cut.yz).all(|it| it.abs() < 1e-13));
    // plane strain
    assert!(plane.yy.iter().zip(&(&plane.xx + &plane.zz)).all(|(yy, sum)| (yy - 0.4 * sum).abs() < 1e-13));
}

/// A wave that runs along the diagonal is a line turned by 45 degrees: its principal stresses are those of the line.
#[test]
fn oblique_waves_are_turned_lines() {
    let n = 32;
    let surface = Grid::surface([n, n], [TAU, TAU]).unwrap();
    let q = 2f64.sqrt();
    let wave: Vec<f64> = (0..n * n).map(|i| (TAU * ((i % n + i / n) % n) as f64 / n as f64).cos()).collect();
    let (z, poisson) = (0.8, 0.25);
    let cut = under_row(&surface, &wave, 0, poisson, &[z]).unwrap();
    let (k, e) = (q * z, (-q * z).exp());
    let plane = |phase: f64| {
        let (along, across) = (-(1.0 - k) * e * phase.cos(), -2.0 * poisson * e * phase.cos());
        Tensor {
            xx: along,
            yy: across,
            zz: -(1.0 + k) * e * phase.cos(),
            xz: -k * e * phase.sin(),
            ..Tensor::default()
        }
    };
    for column in 0..n {
        let (found, expected) = (cut.at([0, column]), plane(TAU * column as f64 / n as f64));
        assert!((found.max_shear() - expected.max_shear()).abs() < 1e-13);
        assert!((found.von_mises() - expected.von_mises()).abs() < 1e-13);
        assert!((found.xy - 0.5 * (expected.xx - expected.yy)).abs() < 1e-13);
    }
}

#[test]
fn shear_and_von_mises_of_known_tensors() {
    let uniaxial = Tensor { yy: -3.0, ..Tensor::default() };
    assert!((uniaxial.max_shear() - 1.5).abs() < 1e-14 && (uniaxial.von_mises() - 3.0).abs() < 1e-14);
    let hydrostatic = Tensor { xx: 2.0, yy: 2.0, zz: 2.0, ..Tensor::default() };
    assert_eq!((hydrostatic.max_shear(), hydrostatic.von_mises()), (0.0, 0.0));
    // principal stresses 1, 2 and 4 in axes that are turned about z and then about x
    let (c, s) = (0.3f64.cos(), 0.3f64.sin());
    let (xx, yy, xy, zz) = (c * c + 2.0 * s * s, s * s + 2.0 * c * c, c * s * (1.0 - 2.0), 4.0);
    let turned = Tensor {
        xx,
        yy: c * c * yy + s * s * zz,
        zz: s * s * yy + c * c * zz,
        yz: c * s * (yy - zz),
        xz: s * xy,
        xy: c * xy,
    };
    assert!((turned.max_shear() - 1.5).abs() < 1e-14, "{}", turned.max_shear());
    assert!((turned.von_mises() - 7f64.sqrt()).abs() < 1e-14);
}

/// The work of the pressure on the displacement of the surface is stored below it, so that both come from one solid.
#[test]
fn energy_below_the_surface_is_that_put_in_at_the_surface() {
    let (grid, poisson, contact_modulus) = (Grid::line(32, TAU).unwrap(), 0.3, 2.0);
    let pressure: Vec<f64> = grid.x().map(|x| x.cos() + 0.5 * (3.0 * x).sin()).collect();
    let mut displacement = vec![0.0; 32];
    Response::half_space(&grid, contact_modulus).displacement(&pressure, &mut displacement);
    let put_in = 0.5 * pressure.iter().zip(&displacement).map(|(p, u)| p * u).sum::<f64>() * grid.spacing()[1];
    let dz = 0.005;
    let depth: Vec<f64> = (0..4000).map(|i| (i as f64 + 0.5) * dz).collect();
    let stress = under_row(&grid, &pressure, 0, poisson, &depth).unwrap();
    let young = contact_modulus * (1.0 - poisson * poisson);
    let density = |t: Tensor| {
        let normal = t.xx.powi(2) + t.yy.powi(2) + t.zz.powi(2);
        let crossed = t.xx * t.yy + t.yy * t.zz + t.zz * t.xx;
        (0.5 * normal - poisson * crossed + (1.0 + poisson) * t.xz.powi(2)) / young
    };
    let places = (0..depth.len()).flat_map(|row| (0..32).map(move |column| [row, column]));
    let stored: f64 = places.map(|place| density(stress.at(place))).sum::<f64>() * dz * grid.spacing()[1];
    assert!((stored / put_in - 1.0).abs() < 1e-4, "{stored} against {put_in}");
}

#[test]
fn ratios_that_no_solid_has_are_refused() {
    let grid = Grid::line(8, 1.0).unwrap();
    for poisson in [0.51, -1.0, f64::NAN, f64::INFINITY] {
        assert!(under_row(&grid, &[1.0; 8], 0, poisson, &[0.1]).is_err());
        assert!(under_strips(&[1.0; 8], 0.1, poisson, &[0.1]).is_err());
    }
    assert!(under_row(&grid, &[1.0; 8], 0, 0.5, &[0.1]).is_ok());
}

#[test]
fn stresses_are_the_same_on_any_number_of_threads() {
    let grid = Grid::surface([33, 40], [1.0, 1.0]).unwrap();
    let (pressure, depth) = (noise(grid.len()), depths(0.01, 1.0, 40));
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| under_row(&grid, &pressure, 3, 0.3, &depth).unwrap())
    };
    assert_eq!(on(1), on(4));
}
