//! Errors of surface parameters against the scatter of samples.

use asperity::formats::Scan;
use asperity::surface::{Mirror, SpectralMoments, Spectrum, SurfaceParameter, SurfaceParameters};
use asperity::{Grid, Surface};
use ndarray::Array2;

/// Parts of `points` nodes of a surface on a cell of unit size.
fn samples(whole: &Surface, points: [usize; 2]) -> Vec<Surface> {
    let [ny, nx] = whole.grid().shape();
    let size = [0, 1].map(|axis| points[axis] as f64 * whole.grid().spacing()[axis]);
    let cell = if ny == 1 { Grid::line(points[1], size[1]) } else { Grid::surface(points, size) };
    let cell = cell.unwrap().with_periodic([ny == 1, false]);
    let part = |y: usize, x: usize| {
        let heights = Array2::from_shape_fn(points, |(row, column)| whole.height()[[y + row, x + column]]);
        Surface::new(cell, heights).unwrap()
    };
    let rows = (0..ny / points[0]).map(|row| row * points[0]);
    let columns = || (0..nx / points[1]).map(|column| column * points[1]);
    rows.flat_map(|y| columns().map(move |x| (y, x))).map(|(y, x)| part(y, x)).collect()
}

/// The standard deviation of the values of a parameter, and the root mean square of its errors.
fn scatter_and_error(parameters: &[SurfaceParameter]) -> (f64, f64) {
    let n = parameters.len() as f64;
    let values = || parameters.iter().map(|it| it.value.unwrap());
    let mean = values().sum::<f64>() / n;
    let scatter = values().map(|value| (value - mean).powi(2)).sum::<f64>() / (n - 1.0);
    let error = parameters.iter().map(|it| it.error.unwrap().powi(2)).sum::<f64>() / n;
    (scatter.sqrt(), error.sqrt())
}

/// 64 samples scatter as their errors say: 64 values give the scatter to 9 %, and neither samples nor their parts are quite independent.
fn assert_errors_are_the_scatter(whole: &Surface, points: [usize; 2], keys: &[&str]) {
    let all: Vec<_> = samples(whole, points).iter().map(SurfaceParameters::new).collect();
    assert_eq!(all.len(), 64);
    for key in keys {
        let of =
            |it: &SurfaceParameters| it.texture.iter().chain(&it.moments).find(|it| it.key == *key).unwrap().clone();
        let (scatter, error) = scatter_and_error(&all.iter().map(of).collect::<Vec<_>>());
        println!("{key}: error over scatter {:.2}", error / scatter);
        assert!((0.7..1.4).contains(&(error / scatter)), "{key}: an error of {error:e} at a scatter of {scatter:e}");
    }
}

#[test]
fn errors_of_lines_are_the_scatter_of_samples() {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 1e-3, short_cutoff: 1e-4, rms_gradient: 0.1 };
    let whole = Surface::rough(Grid::line(1 << 17, 1.0).unwrap(), &spectrum, 5).unwrap();
    let keys = ["Pa", "Pq", "Pdq", "Pdr", "Pal", "Psk", "Pmc10", "correlation_length_x", "m0", "m2", "m4", "nayak"];
    assert_errors_are_the_scatter(&whole, [1, 1 << 11], &keys);
}

#[test]
fn errors_of_surfaces_are_the_scatter_of_samples() {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.0125, short_cutoff: 0.004, rms_gradient: 0.1 };
    let whole = Surface::rough(Grid::surface([1024, 1024], [1.0, 1.0]).unwrap(), &spectrum, 5).unwrap();
    let keys = ["Sa", "Sq", "Sdq", "Sdr", "Ssk", "correlation_length_x", "peklenik", "m0", "m2", "m4", "nayak"];
    assert_errors_are_the_scatter(&whole, [128, 128], &keys);
}

/// Nayak's parameter does not depend on the scale of the heights, so that periodic realisations of equal gradient may be compared.
#[test]
fn the_error_of_nayaks_parameter_is_its_scatter_over_seeds() {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.2, short_cutoff: 0.03, rms_gradient: 0.1 };
    for grid in [Grid::line(512, 1.0).unwrap(), Grid::surface([128, 128], [1.0, 1.0]).unwrap()] {
        let of = |seed: u64| {
            let (moments, errors) = SpectralMoments::with_errors(&Surface::rough(grid, &spectrum, seed).unwrap());
            let (value, error) = (Some(moments.nayak()), Some(errors.nayak));
            SurfaceParameter { key: "nayak".into(), name: String::new(), value, error }
        };
        let (scatter, error) = scatter_and_error(&(1..=200).map(of).collect::<Vec<_>>());
        println!("error over scatter {:.2}", error / scatter);
        assert!((0.8..1.25).contains(&(error / scatter)), "an error of {error} at a scatter of {scatter}");
    }
}

/// A patch and its mirror images are one sample: its errors are those of the patch.
#[test]
fn mirror_images_are_no_further_samples() {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.05, short_cutoff: 0.02, rms_gradient: 0.1 };
    let whole = Surface::rough(Grid::surface([256, 256], [1.0, 1.0]).unwrap(), &spectrum, 3).unwrap();
    let patch = &samples(&whole, [128, 128])[0];
    let scan = Mirror::Both.apply(&Scan::from_surface(patch, 1));
    let size = [0, 1].map(|axis| scan.shape()[axis] as f64 * scan.spacing[axis]);
    let mirrored = Surface::new(Grid::surface(scan.shape(), size).unwrap(), scan.height).unwrap();
    // the last row and column of the patch have no image
    let original = &samples(&whole, [127, 127])[0];
    let [one, both] = [original, &mirrored].map(SurfaceParameters::new);
    for key in ["Sq", "Sdq", "Ssk", "m0", "m2", "nayak"] {
        let error = |it: &SurfaceParameters| {
            it.texture.iter().chain(&it.moments).find(|it| it.key == key).unwrap().error.unwrap()
        };
        assert!((error(&both) / error(&one) - 1.0).abs() < 1e-6, "{key}: {} and {}", error(&both), error(&one));
    }
}

#[test]
fn extremes_and_small_surfaces_have_no_error() {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.5, short_cutoff: 0.25, rms_gradient: 0.1 };
    for (grid, is_large) in [(Grid::line(31, 1.0), false), (Grid::line(32, 1.0), true)] {
        let surface = Surface::rough(grid.unwrap(), &spectrum, 1).unwrap();
        let texture = SurfaceParameters::new(&surface).texture;
        let error = |key: &str| texture.iter().find(|it| it.key == key).unwrap().error;
        assert_eq!(error("Pq").is_some(), is_large);
        assert_eq!(["Pp", "Pv", "Pz"].map(error), [None; 3]);
    }
}
