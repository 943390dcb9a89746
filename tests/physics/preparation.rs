//! What is done to measured heights, against heights of which it is known what must be left.

use asperity::error::PreparationError;
use asperity::formats::Scan;
use asperity::sentence::Sentence;
use asperity::surface::{Crop, Detrend, Fill, Form, Mirror, Preparation};
use ndarray::Array2;
use std::f64::consts::{LN_2, PI, TAU};

/// Heights of a function of `y` and `x` in metres.
fn scan(shape: [usize; 2], spacing: [f64; 2], height: impl Fn(f64, f64) -> f64) -> Scan {
    let height = Array2::from_shape_fn(shape, |(y, x)| height(y as f64 * spacing[0], x as f64 * spacing[1]));
    Scan { height, spacing }
}

/// The same with a tenth of the heights missing.
fn with_voids(mut scan: Scan) -> Scan {
    scan.height.iter_mut().enumerate().filter(|(i, _)| i * i % 11 == 3).for_each(|(_, h)| *h = f64::NAN);
    assert!(scan.voids() > 0);
    scan
}

fn largest(scan: &Scan) -> f64 {
    scan.height.iter().filter(|h| !h.is_nan()).fold(0.0, |most, h| f64::max(most, h.abs()))
}

#[test]
fn trends_of_their_order_are_taken_off_whole() {
    let bent = |y: f64, x: f64| 3.0 + 0.5 * y - 2.0 * x + 0.3 * x * y + 0.7 * y * y - 0.2 * x * x;
    let tilted = |y: f64, x: f64| 3.0 + 0.5 * y - 2.0 * x;
    for shape in [[9, 12], [31, 7], [1, 40]] {
        let make = |f: &dyn Fn(f64, f64) -> f64| scan(shape, [0.1, 0.2], f);
        for make in [&make as &dyn Fn(&dyn Fn(f64, f64) -> f64) -> Scan, &|f| with_voids(make(f))] {
            assert!(largest(&Detrend::Plane.apply(make(&tilted))) < 1e-12);
            assert!(largest(&Detrend::Plane.apply(make(&bent))) > 1e-3);
            assert!(largest(&Detrend::Curvature.apply(make(&bent))) < 1e-12);
        }
    }
    let voids = with_voids(scan([9, 12], [0.1, 0.2], tilted));
    assert_eq!(Detrend::Curvature.apply(voids.clone()).voids(), voids.voids());
}

#[test]
fn spheres_cylinders_and_circles_are_found_wherever_they_lie() {
    let ball = |y: f64, x: f64| 5.0 + (4.0 - (y - 0.2f64).powi(2) - (x + 0.1f64).powi(2)).sqrt();
    let (sin, cos) = 0.7f64.sin_cos();
    let rod = |y: f64, x: f64| 1.0 + (4.0 - (x * cos + y * sin - 0.3).powi(2)).sqrt() + 0.2 * (y * cos - x * sin);
    let circle = |_: f64, x: f64| (4.0 - (x - 0.3f64).powi(2)).sqrt();
    let fit = |form: Form, scan: Scan| form.apply(scan).unwrap();
    for (form, shape, height) in [
        (Form::Sphere, [20, 30], &ball as &dyn Fn(f64, f64) -> f64),
        (Form::Cylinder, [20, 30], &rod),
        (Form::Sphere, [1, 30], &circle),
        (Form::Cylinder, [1, 30], &circle),
    ] {
        let convex = scan(shape, [0.05, 0.04], height);
        let hollow = scan(shape, [0.05, 0.04], |y, x| -height(y, x));
        for (scan, radius) in [(convex.clone(), 2.0), (hollow, -2.0), (with_voids(convex), 2.0)] {
            let (rest, found) = fit(form, scan);
            assert!((found / radius - 1.0).abs() < 1e-6, "{form:?} {shape:?}: {found}");
            assert!(largest(&rest) < 1e-8, "{form:?} {shape:?}: {}", largest(&rest));
        }
    }
    assert!(Form::Sphere.apply(scan([8, 8], [1.0, 1.0], |_, _| 2.0)).is_none());
}

/// The spacing of a line across it is nominally 1, whatever its length.
#[test]
fn lines_of_micrometres_are_prepared_like_longer_ones() {
    let line = |height: &dyn Fn(f64) -> f64| scan([1, 200], [1.0, 1e-6], |_, x| height(x));
    let bent = line(&|x| 1e-6 + 0.1 * x + 5e3 * x * x);
    assert!(largest(&Detrend::Curvature.apply(bent.clone())) < 1e-15);
    assert!(largest(&Detrend::Plane.apply(bent)) > 1e-6);
    let arc = line(&|x| (1e-3f64.powi(2) - (x - 0.8e-4).powi(2)).sqrt());
    let (rest, radius) = Form::Sphere.apply(arc).unwrap();
    assert!((radius / 1e-3 - 1.0).abs() < 1e-6 && largest(&rest) < 1e-12, "{radius}, {}", largest(&rest));
    let filtered: Preparation = toml::from_str("low-pass = 1e-5\nhigh-pass = 1e-4").unwrap();
    assert_eq!(filtered.apply(line(&|x| (3e5 * x).sin())).unwrap().effects.len(), 2);
}

/// The transmission of ISO 16610-21, equation (4): half of the amplitude at the cut-off.
#[test]
fn gaussian_filters_transmit_waves_as_the_standard_says() {
    let cutoff = 0.8;
    for wavelength in [0.3, 0.8, 1.5, 4.0] {
        for turned in [false, true] {
            let wave = |y: f64, x: f64| (TAU * if turned { y } else { x } / wavelength).cos();
            let (shape, middle) = if turned { ([801, 3], [400, 1]) } else { ([3, 801], [1, 400]) };
            let waves = scan(shape, [0.02, 0.02], |y, x| wave(y - 8.0, x - 8.0));
            let alpha = (LN_2 / PI).sqrt();
            let expected = (-PI * (alpha * cutoff / wavelength).powi(2)).exp();
            let found = waves.low_pass(cutoff).height[middle];
            assert!((found - expected).abs() < 2e-6, "{wavelength}: {found}, not {expected}");
            assert!((waves.high_pass(cutoff).height[middle] + found - 1.0).abs() < 1e-12);
        }
    }
    let level = with_voids(scan([30, 40], [0.1, 0.1], |_, _| 7.0));
    assert!(
        level.low_pass(1.0).height.iter().all(|h| h.is_nan() || (h - 7.0).abs() < 1e-13),
        "levels stay at rims and voids"
    );
}

/// The weight function of ISO 16610-21, equation (1), which is a half at the distance `ln 2 / pi` of the cut-off.
#[test]
fn gaussian_filters_weigh_neighbours_by_their_distance() {
    let spacing = LN_2 / PI / 4.0;
    for (shape, one, other) in [([1, 700], [0, 5], [0, 9]), ([9, 90], [2, 80], [6, 80]), ([90, 9], [80, 2], [80, 6])] {
        let mut torn = scan(shape, [spacing; 2], |_, _| f64::NAN);
        torn.height[one] = 1.0;
        torn.height[other] = -2.0;
        let lonely = [shape[0] - 1 - one[0], shape[1] - 1 - one[1]];
        torn.height[lonely] = 5.0;
        let smooth = torn.low_pass(1.0);
        for (node, expected) in [(one, 0.0), (other, -1.0), (lonely, 5.0)] {
            let found = smooth.height[node];
            assert!((found - expected).abs() < 1e-12, "{shape:?} {node:?}: {found}, not {expected}");
        }
        assert_eq!(smooth.voids(), torn.voids());
    }
}

/// `x^2 - y^2` and `x y` solve Laplace's equation between neighbours as well.
#[test]
fn voids_are_filled_with_harmonic_heights() {
    for spacing in [[0.1, 0.1], [0.1, 0.25]] {
        let whole = scan([24, 30], spacing, |y, x| x * x - y * y + 2.0 * x * y - x);
        let mut torn = whole.clone();
        (6..17).for_each(|y| (9..22).filter(|x| x + y > 17).for_each(|x| torn.height[[y, x]] = f64::NAN));
        let filled = Fill::Harmonic.apply(torn).unwrap();
        let off = (&filled.height - &whole.height).iter().fold(0.0, |most, d| f64::max(most, d.abs()));
        assert!(off < 1e-6, "{off}");
    }
    let wide = scan([151, 130], [0.02, 0.05], |y, x| x * x - y * y + 2.0 * x * y - x);
    let mut torn = wide.clone();
    let is_known = |y: usize, x: usize| [0, 150].contains(&y) || [0, 129].contains(&x) || (y * y + 7 * x) % 997 == 5;
    torn.height.indexed_iter_mut().filter(|((y, x), _)| !is_known(*y, *x)).for_each(|(_, h)| *h = f64::NAN);
    let filled = Fill::Harmonic.apply(torn).unwrap();
    let off = (&filled.height - &wide.height).iter().fold(0.0, |most, d| f64::max(most, d.abs()));
    assert!(off < 1e-6 * largest(&wide), "{off} of {}", largest(&wide));
    let line = scan([1, 1000], [1.0, 1e-6], |_, x| if (200e-6..900e-6).contains(&x) { f64::NAN } else { 3.0 * x });
    let straight = Fill::Harmonic.apply(line).unwrap();
    assert!(straight.height.indexed_iter().all(|((_, x), h)| (h - 3e-6 * x as f64).abs() < 1e-9));
    let rim = scan([5, 6], [1.0, 1.0], |y, x| if x < 4.0 && y > 0.0 { 3.5 } else { f64::NAN });
    assert!(Fill::Harmonic.apply(rim).unwrap().height.iter().all(|h| (h - 3.5).abs() < 1e-12));
    assert!(Fill::Harmonic.apply(scan([5, 6], [1.0, 1.0], |_, _| f64::NAN)).is_none());
}

#[test]
fn tapers_and_mirrors_leave_no_jump() {
    let slope = scan([40, 50], [1.0, 1.0], |y, x| 0.3 * y + x);
    let tapered = slope.clone().tapered(0.2);
    let mean = slope.height.mean().unwrap();
    assert!(tapered.height.row(0).iter().chain(tapered.height.column(49)).all(|h| (h - mean).abs() < 1e-12));
    assert_eq!(tapered.height[[20, 25]], slope.height[[20, 25]]);
    for (mirror, shape) in [(Mirror::X, [40, 98]), (Mirror::Y, [78, 50]), (Mirror::Both, [78, 98])] {
        let both = mirror.apply(&slope);
        assert_eq!(both.shape(), shape);
        let step = |a: [usize; 2], b: [usize; 2]| (both.height[a] - both.height[b]).abs();
        if shape[1] > 50 {
            assert_eq!((step([0, 0], [0, 97]), step([7, 60], [7, 38])), (1.0, 0.0), "one step across the period");
        }
    }
    assert_eq!(Mirror::Both.apply(&scan([1, 9], [1.0, 1.0], |_, x| x)).shape(), [1, 16]);
}

#[test]
fn steps_follow_one_another_and_tell_what_they_came_to() {
    let steps: Preparation = toml::from_str(
        "mirror = 'x'\ndetrend = 'plane'\nfill = 'harmonic'\ncrop = [2, 12, 0, 20]\nlow-pass = 4.0\ntaper = 0.1\n",
    )
    .unwrap();
    let rough = with_voids(scan([20, 30], [1.0, 1.0], |y, x| (x * y).sin() + 0.1 * x));
    let prepared = steps.apply(rough.clone()).unwrap();
    assert_eq!(prepared.scan.shape(), [10, 38]);
    assert_eq!(prepared.scan.shape(), steps.shape([20, 30]).unwrap());
    let first = |sentence: &Sentence| sentence.to_string().split(' ').take(2).collect::<Vec<_>>().join(" ");
    let told: Vec<_> = prepared.effects.iter().map(first).collect();
    assert_eq!(told[0], "cropped to");
    assert!(told[1].ends_with("voids"), "{told:?}");
    assert_eq!(told[2..], ["the trend", "low-pass filter", "tapered within", "mirrored to"]);
    assert_eq!(Preparation::default().apply(rough.clone()).unwrap().effects, []);
    let refused = |steps: Preparation| steps.apply(rough.clone()).unwrap_err();
    let none = Preparation::default;
    assert!(matches!(
        refused(Preparation { crop: Some(Crop(vec![0, 21, 0, 5])), ..none() }),
        PreparationError::Crop { .. }
    ));
    assert!(matches!(refused(Preparation { low_pass: Some(1.9), ..none() }), PreparationError::Wavelength { .. }));
    assert!(matches!(refused(Preparation { taper: Some(0.6), ..none() }), PreparationError::Taper { .. }));
}
