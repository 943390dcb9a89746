//! Statistics of surfaces and their power spectra.

use asperity::surface::{Field, PowerSpectrum, Roughness, Spectrum};
use asperity::{Grid, Indenter, Surface};
use std::f64::consts::TAU;

const SPECTRUM: Spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.2, short_cutoff: 0.03, rms_gradient: 0.1 };

fn noise(grid: Grid, offset: f64) -> Surface {
    let [_, nx] = grid.shape();
    let height = |(i, j): (usize, usize)| offset + (((i * nx + j) as f64).powi(2) * 0.7).sin();
    Surface::new(grid, Field::from_shape_fn(grid.shape(), height)).unwrap()
}

fn grids() -> [Grid; 4] {
    [
        Grid::line(64, 2.0).unwrap(),
        Grid::line(31, 0.1).unwrap(),
        Grid::surface([12, 16], [1.0, 3.0]).unwrap(),
        Grid::surface([9, 7], [2.0, 1.0]).unwrap(),
    ]
}

#[test]
fn a_sine_has_its_textbook_roughness() {
    let surface = Indenter::Sine { amplitude: 0.5 }.surface(Grid::line(1 << 14, 2.0).unwrap()).unwrap();
    let roughness = Roughness::new(&surface);
    let q = TAU / 2.0;
    assert!((roughness.rms_height - 0.5 / 2f64.sqrt()).abs() < 1e-13);
    assert!((roughness.rms_gradient / (0.5 * q / 2f64.sqrt()) - 1.0).abs() < 1e-7);
    assert!((roughness.rms_curvature / (0.5 * q * q / 2f64.sqrt()) - 1.0).abs() < 1e-7);
    assert!((roughness.peak - 0.5).abs() < 1e-13 && (roughness.valley - 0.5).abs() < 1e-13);
    assert!(roughness.skewness.abs() < 1e-12 && (roughness.kurtosis - 1.5).abs() < 1e-12);
}

#[test]
fn curvature_of_crossed_sines_is_the_mean_curvature() {
    let grid = Grid::surface([256, 128], [2.0, 1.0]).unwrap();
    let surface = Indenter::CrossedSine { amplitude: 1.0 }.surface(grid).unwrap();
    let expected = 0.5 * 0.5 * (TAU * TAU + TAU * TAU / 4.0);
    assert!((Roughness::new(&surface).rms_curvature / expected - 1.0).abs() < 1e-3);
}

#[test]
fn a_large_offset_changes_nothing() {
    for grid in grids() {
        let (near, far) = (Roughness::new(&noise(grid, 0.0)), Roughness::new(&noise(grid, 1e6)));
        assert!((near.rms_height / far.rms_height - 1.0).abs() < 1e-9);
        assert!((near.rms_gradient / far.rms_gradient - 1.0).abs() < 1e-9);
        assert!((near.skewness - far.skewness).abs() < 1e-9 && (near.kurtosis - far.kurtosis).abs() < 1e-8);
    }
}

#[test]
fn a_flat_has_no_roughness() {
    let grid = Grid::line(16, 1.0).unwrap();
    let flat = Roughness::new(&Surface::new(grid, Field::from_elem((1, 16), 0.1)).unwrap());
    assert_eq!((flat.rms_height, flat.rms_gradient, flat.rms_curvature), (0.0, 0.0, 0.0));
    assert_eq!((flat.peak, flat.valley, flat.skewness, flat.kurtosis), (0.0, 0.0, 0.0, 0.0));
}

#[test]
fn the_spectrum_integrates_to_the_mean_square_height() {
    let line = Surface::rough(Grid::line(1024, 1.0).unwrap(), &SPECTRUM, 1).unwrap();
    let surface = Surface::rough(Grid::surface([256, 256], [1.0, 1.0]).unwrap(), &SPECTRUM, 1).unwrap();
    for (surface, tolerance) in [(line, 1e-12), (surface, 0.05)] {
        let (spectrum, is_line) = (PowerSpectrum::new(&surface), surface.grid().is_line());
        let waves = spectrum.wavenumber.iter().zip(&spectrum.density);
        let integral: f64 = waves.map(|(q, c)| c * TAU * if is_line { 2.0 } else { TAU * q }).sum();
        let ratio = integral / Roughness::new(&surface).rms_height.powi(2);
        assert!((ratio - 1.0).abs() < tolerance, "{ratio}");
        assert!(spectrum.wavenumber.is_sorted());
    }
}
