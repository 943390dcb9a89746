//! Spectral moments against closed forms: waves, and power laws.

use asperity::surface::{SpectralMoments, Spectrum};
use asperity::{Grid, Surface};
use ndarray::Array2;
use std::f64::consts::TAU;

fn assert_near(found: f64, expected: f64, within: f64, what: &str) {
    assert!((found / expected - 1.0).abs() < within, "{what}: {found} against {expected}");
}

/// `Q0 Q4 / Q2^2` with `Qn = int q^n C(q) dq` or `int q^(n+1) C(q) dq`, of a power law from `q_r = 1` to `q = zeta`, and of the flat spectrum
/// below `q_r`, if there is one.
fn breadth(hurst: f64, zeta: f64, axes: f64, is_flat_below: bool) -> f64 {
    let moment = |n: f64| {
        let flat = if is_flat_below { 1.0 / (n + axes) } else { 0.0 };
        flat + (zeta.powf(n - 2.0 * hurst) - 1.0) / (n - 2.0 * hurst)
    };
    moment(0.0) * moment(4.0) / moment(2.0).powi(2)
}

/// Heights with the deterministic amplitude `sqrt(C)` in each wave of a power law of the exponent `H`, and a phase that varies from wave to
/// wave; waves at both ends of the band count half.
fn power_law_line(points: usize, [first, last]: [usize; 2], hurst: f64) -> Surface {
    let wave = |k: usize, x: f64| {
        let end = if k == first || k == last { 0.5f64.sqrt() } else { 1.0 };
        let phase = (k * k) as f64 * 0.7;
        end * (k as f64).powf(-0.5 - hurst) * (TAU * (k as f64 * x) + phase).cos()
    };
    let height = |i: usize| (first..=last).map(|k| wave(k, i as f64 / points as f64)).sum::<f64>();
    let line = ndarray::Array1::from_iter((0..points).map(height));
    Surface::line(line.view(), 1.0).unwrap()
}

#[test]
fn a_sine_has_the_moments_of_its_wave() {
    for (points, waves) in [(64, 1), (63, 31), (4096, 100)] {
        let (amplitude, length) = (3.0, 0.2);
        let line = ndarray::Array1::from_shape_fn(points, |i| {
            amplitude * (TAU * (waves * i) as f64 / points as f64 + 0.3).sin()
        });
        let moments = SpectralMoments::new(&Surface::line(line.view(), length).unwrap());
        let (q, square) = (TAU * waves as f64 / length, 0.5 * amplitude * amplitude);
        assert_near(moments.m0, square, 1e-12, "m0");
        assert_near(moments.m2, q.powi(2) * square, 1e-12, "m2");
        assert_near(moments.m4, q.powi(4) * square, 1e-10, "m4");
        assert_near(moments.nayak(), 1.0, 1e-10, "alpha of one wave");
        assert_eq!((moments.m2_along, moments.m4_along), ([0.0, moments.m2], [0.0, moments.m4]));
    }
}

#[test]
fn crossed_waves_have_the_sums_of_their_moments() {
    let (size, [a, b]) = ([0.5, 2.0], [2.0, 3.0]);
    let [qy, qx] = [TAU * 7.0 / size[0], TAU * 3.0 / size[1]];
    let wave =
        |(y, x): (usize, usize)| a * (TAU * 7.0 * y as f64 / 40.0).cos() + b * (TAU * 3.0 * x as f64 / 60.0).sin();
    let surface = Surface::new(Grid::surface([40, 60], size).unwrap(), Array2::from_shape_fn((40, 60), wave)).unwrap();
    let moments = SpectralMoments::new(&surface);
    let [y, x] = [0.5 * a * a, 0.5 * b * b];
    assert_near(moments.m0, y + x, 1e-12, "m0");
    assert_near(moments.m2_along[0], y * qy.powi(2), 1e-12, "m2 along y");
    assert_near(moments.m2_along[1], x * qx.powi(2), 1e-12, "m2 along x");
    assert_near(moments.m4_along[0], y * qy.powi(4), 1e-12, "m4 along y");
    assert_near(moments.m4_along[1], x * qx.powi(4), 1e-11, "m4 along x");
    assert_near(moments.m2, 0.5 * (y * qy.powi(2) + x * qx.powi(2)), 1e-12, "m2");
    assert_near(moments.m4, 0.375 * (y * qy.powi(4) + x * qx.powi(4)), 1e-12, "m4");
}

/// Oblique waves tell the square of the sum of both curvatures from the sum of their squares.
#[test]
fn an_oblique_wave_has_the_curvature_of_its_wave_vector() {
    let wave = |(y, x): (usize, usize)| (TAU * (2.0 * y as f64 / 32.0 - 3.0 * x as f64 / 48.0)).sin();
    let surface =
        Surface::new(Grid::surface([32, 48], [1.0, 1.0]).unwrap(), Array2::from_shape_fn((32, 48), wave)).unwrap();
    let (moments, square) = (SpectralMoments::new(&surface), TAU.powi(2) * 13.0);
    assert_near(moments.m4, 0.375 * 0.5 * square.powi(2), 1e-12, "m4");
    assert_near(moments.nayak(), 1.5, 1e-12, "alpha of waves of one length");
}

/// The closed form of Nayak's parameter of a power law, for lines `M` and for surfaces `3 M / 2`, is that of the integrals, and
/// heights of that spectrum have it.
#[test]
fn power_laws_have_nayaks_parameter_of_their_integrals() {
    let (hurst, zeta) = (0.8f64, 16.0f64);
    let ends = (zeta.powf(-2.0 * hurst) - 1.0) * (zeta.powf(4.0 - 2.0 * hurst) - 1.0);
    let closed = (1.0 - hurst).powi(2) / (hurst * (hurst - 2.0)) * ends / (zeta.powf(2.0 - 2.0 * hurst) - 1.0).powi(2);
    assert_near(closed, 7.7328, 1e-5, "M");
    assert_near(closed, breadth(hurst, zeta, 1.0, false), 1e-12, "M by its integrals");
    let line = SpectralMoments::new(&power_law_line(4096, [64, 1024], hurst)).nayak();
    println!("line: {line} against {closed}");
    assert_near(line, closed, 3e-4, "a line of many waves");
    let surface = SpectralMoments::new(&power_law_surface(32, hurst)).nayak();
    println!("surface: {surface} against {}", 1.5 * closed);
    assert_near(surface, 1.5 * closed, 5e-3, "a surface of many waves");
}

/// Heights with the amplitude `sqrt(C)` in each wave of a power law from `first` waves on to 16 times as many, as the
/// sum of a table of phases; made by the transform, which is tested elsewhere.
fn power_law_surface(first: usize, hurst: f64) -> Surface {
    let n = 34 * first;
    let grid = Grid::surface([n, n], [1.0, 1.0]).unwrap();
    let mut spectrum = vec![asperity::fourier::Complex::default(); grid.modes()];
    for (i, ([qy, qx], mode)) in grid.wave_vectors().zip(&mut spectrum).enumerate() {
        let k = qy.hypot(qx) / TAU;
        // waves along y alone stand for themselves and their mirror images, which are left out here
        if qx > 0.0 && k >= first as f64 && k < 16.0 * first as f64 {
            *mode = asperity::fourier::Complex::from_polar(k.powf(-1.0 - hurst), (i % 1009 * (i % 911)) as f64);
        }
    }
    let mut height = Array2::zeros((n, n));
    asperity::fourier::Fourier::new(&grid).inverse(&mut spectrum, height.as_slice_mut().unwrap());
    Surface::new(grid, height).unwrap()
}

/// The generator's realisations have, on average, Nayak's parameter of their spectrum with its flat part.
#[test]
fn random_surfaces_have_nayaks_parameter_on_average() {
    let unit = |n: usize| Grid::surface([n, n], [1.0, 1.0]).unwrap();
    let cases = [
        (Grid::line(1 << 13, 1.0).unwrap(), 64.0, 16.0, 0.8, 1.0, 60),
        (Grid::line(1 << 13, 1.0).unwrap(), 64.0, 8.0, 0.3, 1.0, 60),
        (unit(256), 8.0, 8.0, 0.8, 2.0, 40),
    ];
    for (grid, rolloff, zeta, hurst, axes, seeds) in cases {
        let spectrum = Spectrum {
            hurst,
            rolloff_wavelength: 1.0 / rolloff,
            short_cutoff: 1.0 / (rolloff * zeta),
            rms_gradient: 0.1,
        };
        let nayak = |seed: u64| SpectralMoments::new(&Surface::rough(grid, &spectrum, seed).unwrap()).nayak();
        let all: Vec<f64> = (0..seeds).map(nayak).collect();
        let mean = all.iter().sum::<f64>() / seeds as f64;
        let scatter = (all.iter().map(|it| (it - mean).powi(2)).sum::<f64>() / (seeds as f64 - 1.0)).sqrt();
        let error = scatter / (seeds as f64).sqrt();
        let expected = breadth(hurst, zeta, axes, true) * if axes == 2.0 { 1.5 } else { 1.0 };
        println!("{:?}: {mean} ± {error} against {expected}", grid.shape());
        assert!(error < 0.03 * expected && (mean - expected).abs() < 4.0 * error, "{mean} ± {error}, not {expected}");
    }
}

/// The moments are those of the waves: a finer grid under them changes nothing, as it does for differences.
#[test]
fn moments_do_not_depend_on_the_grid() {
    let spectrum = Spectrum { hurst: 0.5, rolloff_wavelength: 0.5, short_cutoff: 0.05, rms_gradient: 0.1 };
    let on = |n: usize| {
        let surface = Surface::rough(Grid::surface([n, n], [1.0, 1.0]).unwrap(), &spectrum, 3).unwrap();
        let moments = SpectralMoments::new(&surface);
        (moments.nayak(), (2.0 * moments.m2).sqrt() / surface.rms_gradient())
    };
    let [(coarse, coarse_gradient), (fine, fine_gradient)] = [on(64), on(256)];
    assert_near(coarse, fine, 1e-11, "alpha");
    assert!(coarse_gradient > 1.02 && fine_gradient < 1.005, "differences lose: {coarse_gradient}, {fine_gradient}");
}

/// A tilted part of a rough surface has about the moments of the whole, if its rims are free; repeated, it has those of its jumps.
#[test]
fn a_part_with_free_rims_has_the_moments_of_the_whole() {
    let spectrum = Spectrum { hurst: 0.7, rolloff_wavelength: 0.05, short_cutoff: 0.01, rms_gradient: 0.1 };
    for (whole, part) in [([1, 1 << 14], [1, 1 << 13]), ([512, 512], [256, 300])] {
        let grid = if whole[0] == 1 { Grid::line(whole[1], 4.0) } else { Grid::surface(whole, [1.0, 1.0]) }.unwrap();
        let surface = Surface::rough(grid, &spectrum, 5).unwrap();
        let [dy, dx] = grid.spacing();
        let tilted = |(y, x): (usize, usize)| surface.height()[[y, x]] + 0.3 * x as f64 * dx - 0.1 * y as f64 * dy;
        let cell = if whole[0] == 1 {
            Grid::line(part[1], part[1] as f64 * dx)
        } else {
            Grid::surface(part, [part[0] as f64 * dy, part[1] as f64 * dx])
        };
        let cut = |grid: Grid| SpectralMoments::new(&Surface::new(grid, Array2::from_shape_fn(part, tilted)).unwrap());
        let (truth, cell) = (SpectralMoments::new(&surface), cell.unwrap());
        let (free, repeated) = (cut(cell.with_periodic([false; 2])), cut(cell));
        println!("{truth:?}\n{free:?}\n{repeated:?}");
        for (name, of) in [("m0", (|it| it.m0) as fn(&SpectralMoments) -> f64), ("m2", |it| it.m2), ("m4", |it| it.m4)]
        {
            assert_near(of(&free), of(&truth), 0.15, name);
        }
        assert!(repeated.m4 > 3.0 * truth.m4, "{repeated:?}");
    }
}

#[test]
fn flats_have_no_moments() {
    for periodic in [[true; 2], [false; 2]] {
        let grid = Grid::surface([8, 6], [1.0, 1.0]).unwrap().with_periodic(periodic);
        let moments = SpectralMoments::new(&Surface::new(grid, Array2::from_elem((8, 6), 3.0)).unwrap());
        assert_eq!((moments.m0, moments.m2, moments.m4, moments.nayak()), (0.0, 0.0, 0.0, 0.0));
    }
}
