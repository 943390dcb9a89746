//! What measured heights are like, told of heights of which it is known, and the preparation that they need.

use asperity::formats::Scan;
use asperity::surface::{Detrend, Fill, Mirror, Preparation, PreparationChoice, Resample, Scales, Spectrum, Survey};
use asperity::{Grid, Surface};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

const SPACING: f64 = 0.25;

/// Self-affine heights of the Hurst exponent 0.7 down to a short cut-off of so many spacings, of the rms gradient 0.1, on a part of their
/// period, so that they jump across it.
fn rough(shape: [usize; 2], cutoff: f64, seed: u64) -> Scan {
    let twice = shape.map(|n| if n == 1 { 1 } else { 2 * n });
    let grid = match twice {
        [1, nx] => Grid::line(nx, nx as f64 * SPACING),
        [ny, nx] => Grid::surface([ny, nx], [ny, nx].map(|n| n as f64 * SPACING)),
    };
    let rolloff_wavelength = twice[1] as f64 * SPACING / 4.0;
    let spectrum = Spectrum { hurst: 0.7, rolloff_wavelength, short_cutoff: cutoff * SPACING, rms_gradient: 0.1 };
    let whole = Scan::from_surface(&Surface::rough(grid.unwrap(), &spectrum, seed).unwrap(), 1);
    let height = ndarray::Array2::from_shape_fn(shape, |(y, x)| whole.height[[y, x]]);
    Scan { height, spacing: [SPACING; 2] }
}

/// Heights with independent noise of some rms height.
fn noisy(mut scan: Scan, rms: f64, seed: u64) -> Scan {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let half = rms * 3f64.sqrt();
    scan.height.mapv_inplace(|h| h + random.random_range(-half..half));
    scan
}

#[test]
fn noise_is_told_from_roughness() {
    for (shape, seed) in [([1, 1 << 14], 1), ([1, 1 << 14], 2), ([256, 256], 3)] {
        let surface = rough(shape, 2.0, seed);
        let step = Survey::new(&surface).unwrap().axes[0].scales[0].rms_step;
        // noise of less than a step is told as less than it is
        for (share, least) in [(0.5, 0.3), (1.0, 0.75), (3.0, 0.95)] {
            for axis in Survey::new(&noisy(surface.clone(), share * step, seed)).unwrap().axes {
                let found = axis.noise / (share * step);
                assert!((least..1.1).contains(&found), "{shape:?}, {share} steps: {found} of it along {}", axis.axis);
            }
        }
        let clean = Survey::new(&surface).unwrap();
        assert!(clean.noise.share < 0.1, "{shape:?}: {} of the gradient is taken for noise", clean.noise.share);
    }
}

#[test]
fn noise_alone_is_noise_at_all_scales() {
    let flat = Scan { height: ndarray::Array2::zeros((128, 160)), spacing: [SPACING; 2] };
    let survey = Survey::new(&noisy(flat, 2.0, 7)).unwrap();
    for axis in &survey.axes {
        assert!((axis.noise / 2.0 - 1.0).abs() < 0.05 && axis.noise_share > 0.95, "{axis:?}");
        assert!(axis.shortest_wavelength >= 128.0 * SPACING / 4.0, "{axis:?}");
    }
    assert_eq!(survey.power_law, None, "nothing is above the noise");
}

#[test]
fn the_hurst_exponent_is_that_of_the_roughness() {
    for (shape, within) in [([1, 1 << 15], 0.1), ([512, 512], 0.1)] {
        // the roll-off lies at half of the length of this part
        let law = Survey::new(&rough(shape, 2.0, 11)).unwrap().power_law.unwrap();
        assert!((law.hurst - 0.7).abs() < (3.0 * law.hurst_error).min(within), "{shape:?}: {law:?}");
    }
}

/// Roughness of any Hurst exponent, roll-off and cut-off: the error that is told is a standard error, and nothing is told where it is large.
#[test]
fn the_hurst_exponent_is_right_within_its_stated_error() {
    let mut random = ChaCha8Rng::seed_from_u64(30);
    let cases = 200;
    let mut shares = Vec::new();
    for case in 0..cases {
        let is_line = case % 2 == 0;
        let n = if is_line { 1 << 14 } else { 256 };
        let grid = if is_line { Grid::line(n, 1.0) } else { Grid::surface([n, n], [1.0, 1.0]) }.unwrap();
        let hurst = random.random_range(0.1..0.9);
        let rolloff = random.random_range(1.0..8.0f64);
        let cutoff = (rolloff * random.random_range(2.0..5.0f64).exp2()).min(n as f64 / 4.0);
        let spectrum =
            Spectrum { hurst, rolloff_wavelength: 1.0 / rolloff, short_cutoff: 1.0 / cutoff, rms_gradient: 0.1 };
        let heights = Scan::from_surface(&Surface::rough(grid, &spectrum, case).unwrap(), if is_line { 1 } else { 2 });
        let Some(law) = Survey::new(&heights).unwrap().power_law else { continue };
        let share = (law.hurst - hurst).abs() / law.hurst_error;
        let what = format!("case {case}: H = {hurst:.2}, {rolloff:.1} to {cutoff:.0} waves: {law:?}");
        assert!(share < 4.5 && (0.0..=1.0).contains(&law.hurst) && law.hurst_error <= 0.17, "{what}");
        assert!(law.wavelengths[0] > 0.8 / cutoff, "waves beyond the cut-off are fitted: {what}");
        shares.push(share);
    }
    let part = |most: f64| shares.iter().filter(|share| **share <= most).count() as f64 / shares.len() as f64;
    let parts = [part(1.0), part(2.0), part(3.0)];
    println!("Hurst exponents within one, two and three stated errors: {parts:.3?} of {}", shares.len());
    assert!(shares.len() > 120 && (0.55..0.9).contains(&parts[0]) && parts[1] > 0.92 && parts[2] >= 0.98, "{parts:?}");
}

/// What is not self-affine has no Hurst exponent: a wave, an arc, steps.
#[test]
fn what_is_not_self_affine_has_no_hurst_exponent() {
    let shape = |of: fn(f64) -> f64| Scan {
        height: ndarray::Array2::from_shape_fn((1, 4096), |(_, x)| of(x as f64 / 4096.0)),
        spacing: [1.0; 2],
    };
    for (name, scan) in [
        ("a wave", shape(|x| (20.0 * std::f64::consts::TAU * x).sin())),
        ("an arc", shape(|x| -(x - 0.5) * (x - 0.5))),
        (
            "waves",
            shape(|x| (20.0 * std::f64::consts::TAU * x).sin() + 0.3 * (170.0 * std::f64::consts::TAU * x).cos()),
        ),
    ] {
        assert_eq!(Survey::new(&scan).unwrap().power_law, None, "{name}");
    }
}

#[test]
fn heights_are_smooth_below_their_short_cutoff() {
    for shape in [[1, 1 << 14], [256, 256]] {
        for axis in Survey::new(&rough(shape, 64.0, 5)).unwrap().axes {
            let smooth = axis.smooth_wavelength.unwrap() / SPACING;
            assert!((16.0..=64.0).contains(&smooth), "{shape:?} along {}: smooth below {smooth} spacings", axis.axis);
            assert!(axis.noise_share < 1e-3, "{axis:?}");
            let [one, two] = [0, 1].map(|i| axis.scales[i].rms_gradient);
            assert!((one / two - 1.0).abs() < 0.02, "the gradient is resolved: {one} and {two}");
        }
        assert!(Survey::new(&rough(shape, 2.0, 5)).unwrap().axes.iter().all(|axis| axis.smooth_wavelength.is_none()));
    }
}

#[test]
fn a_tilted_and_bent_map_says_by_how_much() {
    let place = |i: usize, n: usize| (i as f64 - 0.5 * (n as f64 - 1.0)) * SPACING;
    let [ny, nx] = [60, 90];
    let bent = |(y, x): (usize, usize)| 3.0 + 0.02 * place(y, ny) - 0.05 * place(x, nx) + 1e-3 * place(x, nx).powi(2);
    let mut scan = Scan { height: ndarray::Array2::from_shape_fn((ny, nx), bent), spacing: [SPACING; 2] };
    let check = |survey: &Survey, within: f64| {
        assert!((survey.tilt[0] - 0.02).abs() < within && (survey.tilt[1] + 0.05).abs() < within, "{:?}", survey.tilt);
        assert!((survey.curvature_share - 1.0).abs() < within, "{}", survey.curvature_share);
    };
    check(&Survey::new(&scan).unwrap(), 1e-9);
    (10..14).for_each(|y| (20..25).for_each(|x| scan.height[[y, x]] = f64::NAN));
    let survey = Survey::new(&scan).unwrap();
    assert_eq!(survey.voids, 20);
    check(&survey, 1e-3);
}

#[test]
fn a_plane_leaves_nothing_but_a_flat() {
    let tilted = |(y, x): (usize, usize)| 1e-9 * (y as f64 + 0.3 * x as f64) + 7e-9;
    let scan = Scan { height: ndarray::Array2::from_shape_fn((10, 5), tilted), spacing: [1e-9; 2] };
    let survey = Survey::new(&scan).unwrap();
    assert!((survey.curvature_share, survey.noise.share) == (0.0, 0.0), "{survey:?}");
    for trend in [Detrend::Plane, Detrend::Curvature] {
        assert!(trend.apply(scan.clone()).height.iter().all(|h| *h == 0.0), "rounding is no roughness");
    }
}

#[test]
fn all_voids_are_refused() {
    let void = Scan { height: ndarray::Array2::from_elem((16, 16), f64::NAN), spacing: [1.0; 2] };
    assert!(Survey::new(&void).unwrap_err().to_string().contains("NaN"));
    assert!(PreparationChoice::new(&void, true, [true; 2]).is_err());
}

#[test]
fn what_is_chosen_is_what_heights_need() {
    let choose = |scan: &Scan, periodic| PreparationChoice::new(scan, true, periodic).unwrap();
    let none = Preparation::default();
    let grid = Grid::surface([128, 128], [32.0, 32.0]).unwrap();
    let spectrum = Spectrum { hurst: 0.7, rolloff_wavelength: 8.0, short_cutoff: 1.0, rms_gradient: 0.1 };
    let periodic = Scan::from_surface(&Surface::rough(grid, &spectrum, 1).unwrap(), 1);
    assert_eq!(choose(&periodic, [true; 2]).preparation, none, "periodic heights are left as they are");

    let part = rough([128, 128], 8.0, 3);
    let mirrored = Preparation { detrend: Some(Detrend::Curvature), mirror: Some(Mirror::Both), ..none.clone() };
    assert_eq!(choose(&part, [true; 2]).preparation, mirrored);
    assert_eq!(choose(&part, [true; 2]).reasons.len(), 2);
    assert_eq!(choose(&part, [true, false]).preparation.mirror, Some(Mirror::Y));
    let flat = Preparation { detrend: Some(Detrend::Plane), ..none.clone() };
    assert_eq!(choose(&part, [false; 2]).preparation, flat);

    let mut holed = part.clone();
    holed.height[[5, 5]] = f64::NAN;
    assert_eq!(choose(&holed, [true; 2]).preparation, Preparation { fill: Some(Fill::Harmonic), ..mirrored.clone() });

    let step = Survey::new(&part).unwrap().axes[0].scales[0].rms_step;
    let measured = noisy(part.clone(), step, 1);
    let low_pass = choose(&measured, [true; 2]).preparation.low_pass.unwrap();
    let (filtered, clean) = (measured.low_pass(low_pass).rms_gradient(), part.rms_gradient());
    assert!((filtered / clean - 1.0).abs() < 0.1, "{filtered} after a filter at {low_pass}, but {clean} without noise");

    let uneven = PreparationChoice::new(&rough([1, 4096], 8.0, 1), false, [true; 2]).unwrap().preparation;
    assert_eq!(uneven.resample, Some(Resample::Linear));
}

/// A filter of the noise of noise would leave nothing: heights in which there is no surface are kept, and this is told.
#[test]
fn noise_alone_is_not_filtered_away() {
    for (shape, seed) in [([1, 1000], 1), ([1, 4096], 2), ([96, 128], 3)] {
        let scan = noisy(Scan { height: ndarray::Array2::zeros(shape), spacing: [0.5; 2] }, 0.02, seed);
        let choice = PreparationChoice::new(&scan, true, [true; 2]).unwrap();
        assert_eq!(choice.preparation.low_pass, None, "{:?}", choice.reasons);
        assert!(
            choice.reasons.iter().any(|it| it.to_string().contains("no surface can be told from it")),
            "{:?}",
            choice.reasons
        );
    }
}

/// What the steps that were chosen make of heights needs none of them any more, but for the noise that a filter leaves at its wavelength.
#[test]
fn prepared_heights_are_periodic_and_told_from_noise() {
    for (scan, seed) in [(rough([1, 8192], 2.0, 9), 1), (rough([160, 200], 2.0, 9), 2)] {
        let step = Survey::new(&scan).unwrap().axes[0].scales[0].rms_step;
        let mut measured = noisy(scan, 2.0 * step, seed);
        measured.height.indexed_iter_mut().for_each(|((y, x), h)| *h += 0.3 * x as f64 - 0.1 * y as f64);
        let choice = PreparationChoice::new(&measured, true, [true; 2]).unwrap();
        let before = Survey::new(&measured).unwrap();
        let after = Survey::new(&choice.preparation.apply(measured).unwrap().scan).unwrap();
        assert!(before.jumps[1] > 50.0 && after.jumps.iter().all(|jump| *jump < 3.0), "{:?}", after.jumps);
        assert!(before.noise.share > 0.5 && after.noise.share < 0.05, "{}", after.noise.share);
    }
}

#[test]
fn scales_of_a_refined_surface_are_those_of_its_nodes() {
    let grid = Grid::surface([32, 48], [8.0, 12.0]).unwrap();
    let spectrum = Spectrum { hurst: 0.5, rolloff_wavelength: 4.0, short_cutoff: 0.8, rms_gradient: 0.1 };
    let surface = Surface::rough(grid, &spectrum, 4).unwrap();
    let [coarse, fine] =
        [(&surface, 1), (&surface.refined(4).unwrap(), 4)].map(|(it, every)| Scales::from_surface(it, every));
    assert_eq!(coarse.len(), 2);
    for (coarse, fine) in coarse.iter().zip(&fine) {
        for (one, other) in coarse.scales.iter().zip(&fine.scales) {
            assert!(
                (one.rms_step / other.rms_step - 1.0).abs() < 1e-9 && one.distance == other.distance,
                "{one:?}, {other:?}"
            );
        }
    }
}
