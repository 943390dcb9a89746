//! Spectra of roughness and their limits.

use asperity::Grid;
use asperity::error::SurfaceError;
use asperity::surface::Spectrum;
use std::f64::consts::TAU;

const SPECTRUM: Spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.5, short_cutoff: 0.05, rms_gradient: 0.1 };

#[test]
fn density_is_flat_then_falls_then_ends() {
    let rolloff = 2.0 * TAU;
    assert_eq!(SPECTRUM.density(0.0, true), 0.0);
    assert_eq!(SPECTRUM.density(1e-3, true), 1.0);
    assert!((SPECTRUM.density(2.0 * rolloff, true) - 2f64.powf(-2.6)).abs() < 1e-15);
    assert!((SPECTRUM.density(2.0 * rolloff, false) - 2f64.powf(-3.6)).abs() < 1e-15);
    assert!(SPECTRUM.density(9.99 * rolloff, true) > 0.0);
    assert_eq!(SPECTRUM.density(10.0 * rolloff, true), 0.0);
}

#[test]
fn bad_spectra_are_refused() {
    let grid = Grid::line(64, 1.0).unwrap();
    let refusal = |spectrum: Spectrum| spectrum.validate(&grid).unwrap_err();
    assert_eq!(SPECTRUM.validate(&grid), Ok(()));
    assert_eq!(refusal(Spectrum { hurst: 1.5, ..SPECTRUM }), SurfaceError::Hurst { value: 1.5 });
    let not_positive = refusal(Spectrum { rms_gradient: f64::NAN, ..SPECTRUM });
    assert!(matches!(not_positive, SurfaceError::NotPositive { name: "rms_gradient", .. }));
    let order = refusal(Spectrum { short_cutoff: 0.6, ..SPECTRUM });
    assert_eq!(order, SurfaceError::CutoffOrder { rolloff: 0.5, short_cutoff: 0.6 });
    let long = refusal(Spectrum { rolloff_wavelength: 2.0, ..SPECTRUM });
    assert_eq!(long, SurfaceError::RolloffTooLong { rolloff: 2.0, period: 1.0 });
    let fine = refusal(Spectrum { short_cutoff: 0.03, ..SPECTRUM });
    assert_eq!(fine, SurfaceError::CutoffTooFine { short_cutoff: 0.03, shortest: 1.0 / 32.0 });
}

#[test]
fn a_cutoff_at_two_spacings_passes_whatever_the_rounding() {
    for n in [60, 64, 77, 4095] {
        let grid = Grid::line(n, 0.3).unwrap();
        for nudge in [-1e-15, 0.0, 1e-15] {
            let spectrum =
                Spectrum { rolloff_wavelength: 0.3, short_cutoff: 0.6 / n as f64 * (1.0 + nudge), ..SPECTRUM };
            assert_eq!(spectrum.validate(&grid), Ok(()));
            assert_eq!(spectrum.density(TAU / grid.shortest_wavelength(), true), 0.0);
        }
    }
}
