//! Random surfaces: one seed, one realisation, of the right spectrum.

use asperity::surface::{Field, PowerSpectrum, Roughness, Spectrum};
use asperity::{Grid, Surface};

const SPECTRUM: Spectrum = Spectrum { hurst: 0.5, rolloff_wavelength: 0.7, short_cutoff: 0.2, rms_gradient: 0.02 };

fn grid([ny, nx]: [usize; 2], size: [f64; 2]) -> Grid {
    if ny == 1 { Grid::line(nx, size[1]).unwrap() } else { Grid::surface([ny, nx], size).unwrap() }
}

/// The rms gradients differ by the finite differences alone; the heights are the same up to that factor.
fn assert_same_realisation(shape: [usize; 2], [fy, fx]: [usize; 2], size: [f64; 2]) {
    let coarse = Surface::rough(grid(shape, size), &SPECTRUM, 11).unwrap();
    let fine = Surface::rough(grid([shape[0] * fy, shape[1] * fx], size), &SPECTRUM, 11).unwrap();
    let sampled = Field::from_shape_fn(shape, |(i, j)| fine.height()[[i * fy, j * fx]]);
    let factor = (&sampled * coarse.height()).sum() / (coarse.height() * coarse.height()).sum();
    assert!((factor - 1.0).abs() < 0.2, "{factor}");
    let largest = coarse.heights().iter().fold(0.0, |m: f64, h| m.max(h.abs()));
    for (a, b) in sampled.iter().zip(coarse.heights()) {
        assert!((a - factor * b).abs() < 1e-10 * largest, "{shape:?}: {a} against {b}");
    }
}

#[test]
fn a_finer_grid_carries_the_same_realisation() {
    assert_same_realisation([1, 32], [1, 2], [1.0, 2.0]);
    assert_same_realisation([1, 31], [1, 3], [1.0, 2.0]);
    assert_same_realisation([16, 32], [2, 2], [1.0, 2.0]);
    assert_same_realisation([15, 33], [3, 2], [1.0, 2.0]);
    assert_same_realisation([25, 24], [2, 3], [1.7, 1.3]);
}

#[test]
fn the_rms_gradient_is_exact_in_any_unit() {
    for unit in [1e-100, 1e-6, 1.0, 1e100] {
        let spectrum = Spectrum { rolloff_wavelength: 0.7 * unit, short_cutoff: 0.2 * unit, ..SPECTRUM };
        for shape in [[1, 64], [40, 36]] {
            let surface = Surface::rough(grid(shape, [1.0 * unit, 2.0 * unit]), &spectrum, 3).unwrap();
            let found = Roughness::new(&surface).rms_gradient;
            assert!((found / 0.02 - 1.0).abs() < 1e-13, "{shape:?} at {unit:e}: {found}");
        }
    }
}

#[test]
fn seeds_are_reproducible_and_distinct() {
    let grid = Grid::line(64, 2.0).unwrap();
    let surface = |seed| Surface::rough(grid, &SPECTRUM, seed).unwrap();
    assert_eq!(surface(1), surface(1));
    assert_ne!(surface(1), surface(2));
    assert_eq!(surface(5).seed(), Some(5));
}

#[test]
fn the_exponents_are_those_of_the_spectrum() {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.1, short_cutoff: 0.004, rms_gradient: 0.1 };
    for (shape, exponent) in [([1, 1 << 16], -2.6), ([512, 512], -3.6)] {
        let mut slope = 0.0;
        for seed in 0..8 {
            let surface = Surface::rough(grid(shape, [1.0, 1.0]), &spectrum, seed).unwrap();
            slope += fitted_exponent(&PowerSpectrum::new(&surface), 80.0, 1400.0) / 8.0;
        }
        assert!((slope - exponent).abs() < 0.15, "{shape:?}: {slope} against {exponent}");
    }
}

fn fitted_exponent(spectrum: &PowerSpectrum, low: f64, high: f64) -> f64 {
    let points = spectrum.wavenumber.iter().zip(&spectrum.density);
    let points: Vec<_> =
        points.filter(|&(&q, _)| q > low && q < high).map(|(q, c)| (q.ln(), c.max(1e-300).ln())).collect();
    let n = points.len() as f64;
    let (mx, my) = points.iter().fold((0.0, 0.0), |(x, y), p| (x + p.0 / n, y + p.1 / n));
    let (num, den) =
        points.iter().fold((0.0, 0.0), |(a, b), p| (a + (p.0 - mx) * (p.1 - my), b + (p.0 - mx) * (p.0 - mx)));
    num / den
}
