//! Random roughness: spectra of tables, lays, scales, and heights that are not Gaussian.

use asperity::contact::{ContactModulus, Load, Multilevel, Solver};
use asperity::error::{RoughnessError, SurfaceError};
use asperity::formats::HeightFile;
use asperity::surface::{
    ExactPart, HeightDistribution, Lay, MeasuredSpectrum, PowerSpectrum, RandomRoughness, Rolloff, Roughness,
    RoughnessScale, SelfAffine, SpectralDensity, SpectrumConvention, SpectrumFile, SpectrumKind, SpectrumTable,
    TargetHeights, Texture,
};
use asperity::{Grid, Problem, Stop, Surface};
use std::f64::consts::{PI, TAU};

/// The surface of the reference values: `H = 0.8`, 8 roll-off wavelengths in the cell and 8 points per shortest one.
fn ground(peklenik: f64, angle: f64) -> RandomRoughness {
    let spectrum = SelfAffine { hurst: 0.8, rolloff: Rolloff::Plateau(1.0 / 8.0), short_cutoff: 1.0 / 64.0 };
    RandomRoughness {
        spectrum: SpectralDensity::SelfAffine(spectrum),
        lay: Lay { peklenik, angle },
        scale: RoughnessScale::RmsGradient(0.1),
        heights: None,
    }
}

fn with_heights(distribution: HeightDistribution, exact: ExactPart) -> RandomRoughness {
    RandomRoughness { heights: Some(TargetHeights { distribution, exact }), ..ground(1.0, 0.0) }
}

fn square(points: usize) -> Grid {
    Grid::surface([points; 2], [1.0, 1.0]).unwrap()
}

fn mean_and_spread(values: &[f64]) -> [f64; 2] {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    [mean, (values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt()]
}

/// Correlation lengths along y over those along x of six realisations were .984(34), .340(13) and .170(7) in a prototype in NumPy, which drew
/// other numbers.
#[test]
fn correlation_lengths_have_the_ratio_of_pekleniks_number() {
    for (peklenik, expected, spread) in [(1.0, 0.984, 0.034), (3.0, 0.340, 0.013), (6.0, 0.170, 0.007)] {
        let ratio = |seed| Texture::new(&ground(peklenik, 0.0).surface(square(512), seed).unwrap()).peklenik().unwrap();
        let ratios: Vec<f64> = (1..=6).map(|seed| ratio(seed).recip()).collect();
        let [mean, found_spread] = mean_and_spread(&ratios);
        println!("gamma {peklenik}: {mean:.4} +- {found_spread:.4}");
        // the difference of two means of six has a standard error of their spread times sqrt(2/6)
        assert!((mean - expected).abs() < 3.0 * (1.0f64 / 3.0).sqrt() * spread, "{mean} against {expected}");
        assert!((mean * peklenik - 1.0).abs() < 0.06, "{mean} for {peklenik}");
    }
}

#[test]
fn a_lay_turns_with_its_angle() {
    for angle in [30.0, 75.0, -20.0] {
        let lengths = |seed| {
            let surface = ground(5.0, angle).surface(square(512), seed).unwrap();
            let correlation = asperity::surface::Autocorrelation::new(&surface).unwrap();
            [0.0, 90.0].map(|more: f64| correlation.decay((angle + more).to_radians(), 0.5).unwrap())
        };
        let ratios: Vec<f64> = (1..=4).map(lengths).map(|[along, across]| along / across).collect();
        let [mean, spread] = mean_and_spread(&ratios);
        assert!((mean / 5.0 - 1.0).abs() < 0.12, "{mean} +- {spread} at {angle} degrees");
    }
}

#[test]
fn a_lay_keeps_the_rms_height_of_the_waves() {
    let height = |peklenik| {
        let roughness = RandomRoughness { scale: RoughnessScale::RmsGradient(0.1), ..ground(peklenik, 0.0) };
        roughness.expected(&square(512)).unwrap()
    };
    let [[isotropic, _], [ground, _]] = [height(1.0), height(4.0)];
    // the mean square gradient grows by (gamma + 1/gamma)/2 at the same heights
    assert!((isotropic / ground / (0.5f64 * 4.25).sqrt() - 1.0).abs() < 1e-12);
}

#[test]
fn expected_heights_and_gradients_are_those_of_realisations() {
    for roughness in [ground(1.0, 0.0), ground(3.0, 20.0)] {
        let [height, gradient] = roughness.expected(&square(512)).unwrap();
        let found: Vec<Roughness> =
            (1..=8).map(|seed| Roughness::new(&roughness.surface(square(512), seed).unwrap())).collect();
        let mean = |of: fn(&Roughness) -> f64| found.iter().map(of).sum::<f64>() / 8.0;
        assert!((mean(|it| it.rms_height) / height - 1.0).abs() < 0.05);
        assert!((mean(|it| it.rms_gradient) / gradient - 1.0).abs() < 1e-12);
    }
}

#[test]
fn rms_heights_are_exact_where_they_are_the_scale() {
    let roughness = RandomRoughness { scale: RoughnessScale::RmsHeight(3e-7), ..ground(1.0, 0.0) };
    let found = Roughness::new(&roughness.surface(square(128), 2).unwrap());
    assert!((found.rms_height / 3e-7 - 1.0).abs() < 1e-12);
}

#[test]
fn roll_offs_are_a_plateau_a_drop_or_none() {
    let spectrum = |rolloff| SelfAffine { hurst: 0.8, rolloff, short_cutoff: 1.0 / 64.0 };
    let made =
        |rolloff| RandomRoughness { spectrum: SpectralDensity::SelfAffine(spectrum(rolloff)), ..ground(1.0, 0.0) };
    let of = |rolloff| PowerSpectrum::new(&made(rolloff).surface(square(256), 1).unwrap());
    let below = |spectrum: &PowerSpectrum| {
        let pairs = spectrum.wavenumber.iter().zip(&spectrum.density).zip(&spectrum.measure);
        pairs.filter(|((q, _), _)| **q < 7.9 * TAU).map(|((_, c), m)| c * m).sum::<f64>()
            / spectrum.integral(|_, density| density)
    };
    let [plateau, drop, none] =
        [Rolloff::Plateau(0.125), Rolloff::Drop(0.125), Rolloff::None].map(|rolloff| below(&of(rolloff)));
    assert!(drop < 1e-20, "{drop}");
    assert!(plateau > 0.2 && plateau < 0.6, "{plateau}");
    assert!(none > 0.9, "{none}");
}

/// A table of `C = q^-3.6` of surfaces between two wavenumbers, in a convention.
fn table(convention: SpectrumConvention) -> SpectrumFile {
    let waves = (0..=60).map(|i| TAU * 4.0 * 16f64.powf(f64::from(i) / 60.0));
    let rows = waves.map(|q| format!("{q:.17e}, {:.17e}\n", 1e-3 * q.powf(-3.6) * convention.factor()));
    SpectrumFile::in_memory("psd.csv", format!("q,C\n{}", rows.collect::<String>()).into_bytes())
}

fn measured(file: SpectrumFile, convention: SpectrumConvention) -> RandomRoughness {
    RandomRoughness {
        spectrum: SpectralDensity::Measured(MeasuredSpectrum {
            file,
            convention: Some(convention),
            short_cutoff: None,
        }),
        scale: RoughnessScale::AsGiven,
        ..ground(1.0, 0.0)
    }
}

#[test]
fn realisations_have_the_spectrum_of_their_table() {
    for convention in [SpectrumConvention::Surface, SpectrumConvention::SurfaceTwoPi] {
        let roughness = measured(table(convention), convention);
        let mut ratios = Vec::new();
        for seed in 1..=10 {
            let found = PowerSpectrum::new(&roughness.surface(square(256), seed).unwrap());
            let waves = found.wavenumber.iter().zip(&found.density);
            let inside = waves.filter(|(q, _)| (TAU * 8.0..TAU * 60.0).contains(*q));
            ratios.extend(inside.map(|(q, density)| density / (1e-3 * q.powf(-3.6))));
        }
        let [mean, spread] = mean_and_spread(&ratios);
        assert!((mean - 1.0).abs() < 4.0 * spread / (ratios.len() as f64).sqrt(), "{mean} +- {spread}");
        let [height, _] = roughness.expected(&square(256)).unwrap();
        let exact = (TAU * 1e-3 * ((TAU * 4.0).powf(-1.6) - (TAU * 64.0).powf(-1.6)) / 1.6).sqrt();
        assert!((height / exact - 1.0).abs() < 5e-3, "{height} against {exact}");
    }
}

/// A power law `C = q^-n` of a surface has the profiles `q^(1-n) sqrt(pi) Gamma((n-1)/2) / Gamma(n/2)`.
#[test]
fn a_power_law_of_profiles_is_one_of_surfaces() {
    let gamma = libm::tgamma;
    for exponent in [2.6, 3.6, 4.0] {
        let factor = PI.sqrt() * gamma((exponent - 1.0) / 2.0) / gamma(exponent / 2.0);
        let waves: Vec<f64> = (0..=400).map(|i| 1e6f64.powf(f64::from(i) / 400.0)).collect();
        let law = |factor: f64, power: f64| waves.iter().map(|q| factor * q.powf(power)).collect();
        let of = |factor, power, kind| SpectrumTable::new(waves.clone(), law(factor, power), kind).unwrap();
        let profile = of(1.0, -exponent, SpectrumKind::Surface).converted(SpectrumKind::Profile).unwrap();
        let surface = of(factor, 1.0 - exponent, SpectrumKind::Profile).converted(SpectrumKind::Surface).unwrap();
        for q in [1.0f64, 7.0, 300.0] {
            let exact = q.powf(-exponent);
            assert!((profile.density(q) / (factor * q * exact) - 1.0).abs() < 2e-3, "profiles, q = {q}");
            assert!((surface.density(q) / exact - 1.0).abs() < 2e-3, "surfaces, q = {q}, n = {exponent}");
        }
    }
}

#[test]
fn profiles_of_an_isotropic_surface_have_the_converted_spectrum() {
    let roughness = measured(table(SpectrumConvention::Surface), SpectrumConvention::Surface);
    let converted = table(SpectrumConvention::Surface).read(Some(SpectrumConvention::Surface), true).unwrap();
    let mut ratios = Vec::new();
    for seed in 1..=4 {
        let surface = roughness.surface(square(256), seed).unwrap();
        for row in surface.height().rows().into_iter().step_by(8) {
            let found = PowerSpectrum::new(&Surface::line(row, 1.0).unwrap());
            let waves = found.wavenumber.iter().zip(&found.density).skip(1).take(20);
            ratios.extend(waves.map(|(q, density)| density / converted.density(*q)));
        }
    }
    let [mean, _] = mean_and_spread(&ratios);
    assert!((mean - 1.0).abs() < 0.1, "{mean}");
}

#[test]
fn files_of_contact_engineering_say_what_they_are() {
    let header = "Subject type,Subject name,Creator,Instrument name,Instrument type,Instrument parameters,Function name,\
                  Data series,Wavevector (1/m),PSD (m³),standard error of PSD (m³),comment";
    let row = |series: &str, q: f64, c: f64| format!("measurement,wafer,,,,,Power spectrum,{series},{q},{c:e},,\n");
    let series = |name: &str, of: &dyn Fn(f64) -> f64| [10.0, 100.0, 1000.0].map(|q| row(name, q, of(q))).concat();
    // C of a surface with the factor (2 pi)^2 is q^-3, so that the column has q/pi times that
    let text = format!(
        "{header}\n{}{}",
        series("1D PSD along x", &|q| 5.0 * q.powi(-2)),
        series("q/π × 2D PSD", &|q| q.powi(-2) / PI)
    );
    let file = SpectrumFile::in_memory("power.csv", text.into_bytes());
    let other = SpectrumConvention::Profile;
    let refused = file.read(Some(other), false).unwrap_err().to_string();
    assert!(refused.contains("its convention is surface-two-pi, but profile is given"), "{refused}");
    let surface = file.read(None, false).unwrap();
    assert!((surface.density(100.0) * TAU.powi(2) / 1e-6 - 1.0).abs() < 1e-12);
    let line = file.read(None, true).unwrap();
    assert!((line.density(100.0) * TAU / 5e-4 - 1.0).abs() < 1e-12);
}

/// SurfaceTopography 1.27.1 found these densities for this map, averaged over rings of the width of the lowest wavenumber along y, and over
/// profiles along x. It has factors of `2 pi` in them.
#[test]
fn spectra_are_those_of_surfacetopography() {
    let wave = |(y, x): (usize, usize)| {
        let [y, x] = [TAU * y as f64 / 48.0, TAU * x as f64 / 64.0];
        (3.0 * x + 2.0 * y + 0.3).sin()
            + 0.5 * (7.0 * x - 5.0 * y).cos()
            + 0.25 * (11.0 * y + 1.0).cos()
            + 0.1 * (20.0 * x + 0.2).sin()
    };
    let grid = Grid::surface([48, 64], [1.5, 2.1]).unwrap();
    let surface = Surface::new(grid, ndarray::Array2::from_shape_fn((48, 64), wave)).unwrap();
    let near = |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-9, "{found} against {expected}");
    let found = PowerSpectrum::new(&surface);
    let waves = found.wavenumber.iter().zip(&found.density).filter(|(_, density)| **density > 1e-12);
    let factor = SpectrumConvention::SurfaceTwoPi.factor();
    let rings = [
        (13.111656921526324, 0.06562499999999999),
        (29.368553175752375, 0.0065625000000000015),
        (46.14914968117919, 0.001004464285714286),
        (58.69456793217279, 0.00012909836065573774),
    ];
    let waves: Vec<_> = waves.collect();
    assert_eq!(waves.len(), rings.len());
    for ((q, density), (their_q, their_density)) in waves.into_iter().zip(rings) {
        near(*q, their_q);
        near(density * factor, their_density);
    }
    let profile = |k: usize| {
        let rows = surface.height().rows().into_iter();
        rows.map(|row| PowerSpectrum::new(&Surface::line(row, 2.1).unwrap()).density[k - 1]).sum::<f64>() / 48.0
    };
    for (k, density) in [(3, 0.525), (7, 0.13125), (20, 0.00525)] {
        near(profile(k) * SpectrumConvention::ProfileTwoPi.factor(), density);
    }
}

#[test]
fn tables_that_are_none_are_refused() {
    let read = |text: &str| {
        let file = SpectrumFile::in_memory("psd.txt", text.as_bytes().to_vec());
        file.read(None, false).unwrap_err().to_string()
    };
    for (text, said) in [
        ("1 2\n", "give two of each or more"),
        ("1 2\n1 3\n", "the wavenumber 1.0 follows 1.0"),
        ("1 2\n3 -1\n", "the density -1.0 is negative"),
        ("0 2\n3 1\n", "the wavenumber 0.0 is not positive"),
        ("1 0\n3 0\n", "all densities are zero"),
        ("1 2\n3\n", "row 2 has a wavenumber and no density"),
        ("1 2\nhello world\n3 1\n", "row 2"),
        ("1.5;2e-3;1e-9\n30;1.5e-4;0\n", "row 1 has a third word, `1e-9`"),
        ("# convention: profil\n1 2\n3 1\n", "the convention `profil` is not known"),
    ] {
        assert!(read(text).contains(said), "{}", read(text));
    }
}

#[test]
fn numbers_have_decimal_points_or_commas() {
    let plain = SpectrumFile::in_memory("a", *b"1.5 2e-3\n30 1.5e-4\n").read(None, false).unwrap();
    for text in [
        "1,5\t2,0e-3\r\n30,0\t1,5e-4\r\n",
        "q;C\n1.5;2e-3\n30,0;1,5e-4\n",
        "1.5, 2e-3\n30, 1.5e-4\n",
        "1.5,2e-3\n30,1.5e-4",
    ] {
        let file = SpectrumFile::in_memory("b", text.as_bytes().to_vec());
        assert_eq!(file.read(None, false).unwrap(), plain, "{text}");
    }
}

#[test]
fn a_convention_does_not_contradict_that_of_the_file() {
    let file = SpectrumFile::in_memory("psd.csv", *b"# convention: surface\n1 2\n3 1\n");
    let refused = file.read(Some(SpectrumConvention::Profile), false).unwrap_err().to_string();
    assert!(refused.contains("its convention is surface, but profile is given"), "{refused}");
    assert!(file.read(Some(SpectrumConvention::Surface), false).is_ok());
}

/// The mean square of realisations of the spectrum of a surface is that of the surface, also where its longest waves have most of it.
#[test]
fn realisations_of_the_spectrum_of_a_surface_are_as_high_as_it() {
    for rolloff in [Rolloff::Plateau(0.125), Rolloff::None] {
        let spectrum = SelfAffine { hurst: 0.8, rolloff, short_cutoff: 1.0 / 32.0 };
        let made = RandomRoughness {
            spectrum: SpectralDensity::SelfAffine(spectrum),
            scale: RoughnessScale::RmsHeight(1e-3),
            ..ground(1.0, 0.0)
        };
        let folder = tempfile::tempdir().unwrap();
        for grid in [square(128), Grid::line(1024, 1.0).unwrap()] {
            let path = folder.path().join("psd.csv");
            SpectrumTable::from_surface(&made.surface(grid, 5).unwrap())
                .unwrap()
                .write(&path, if grid.is_line() { SpectrumConvention::Profile } else { SpectrumConvention::Surface })
                .unwrap();
            let again = RandomRoughness {
                spectrum: SpectralDensity::Measured(MeasuredSpectrum {
                    file: path.into(),
                    convention: None,
                    short_cutoff: None,
                }),
                scale: RoughnessScale::AsGiven,
                ..ground(1.0, 0.0)
            };
            let square = |seed| Roughness::new(&again.surface(grid, seed).unwrap()).rms_height.powi(2) / 1e-6;
            let squares: Vec<f64> = (1..=40).map(square).collect();
            let [mean, spread] = mean_and_spread(&squares);
            println!("{rolloff:?}, {:?}: {mean:.3} +- {:.3}", grid.shape(), spread / 40f64.sqrt());
            assert!((mean - 1.0).abs() < 3.5 * spread / 40f64.sqrt() + 0.02, "{mean} +- {spread}");
        }
    }
}

fn moments(surface: &Surface) -> [f64; 2] {
    let roughness = Roughness::new(surface);
    [roughness.skewness, roughness.kurtosis]
}

/// Weibull's distribution of shape 1.2 has the skewness 1.521 and the kurtosis 6.23. In a prototype in NumPy the errors of the spectrum were
/// 25, 1.6 and 0.2 % after 1, 10 and 50 rounds, and the skewness with the exact spectrum was 1.521 at the end.
#[test]
fn weibull_heights_keep_the_spectrum_within_four_per_mille() {
    let weibull = HeightDistribution::Weibull { shape: 1.2 };
    let exact_heights = with_heights(weibull.clone(), ExactPart::Heights).surface(square(512), 1).unwrap();
    let [skewness, kurtosis] = moments(&exact_heights);
    assert!((skewness - 1.521).abs() < 2e-3 && (kurtosis - 6.23).abs() < 0.03, "{skewness}, {kurtosis}");
    let map = exact_heights.rank_map().unwrap();
    println!("{map:?}");
    assert!(map.spectrum_error < 4e-3 && map.height_error == 0.0, "{map:?}");
    assert!((20..=100).contains(&map.rounds), "{map:?}");

    let exact_spectrum = with_heights(weibull, ExactPart::Spectrum).surface(square(512), 1).unwrap();
    let [skewness, kurtosis] = moments(&exact_spectrum);
    assert!((skewness - 1.521).abs() < 5e-3 && (kurtosis - 6.23).abs() < 0.06, "{skewness}, {kurtosis}");
    let map = exact_spectrum.rank_map().unwrap();
    println!("{map:?}");
    assert!(map.spectrum_error == 0.0 && map.height_error > 0.0 && map.height_error < 5e-3, "{map:?}");
    // the waves are those of the Gaussian realisation of the seed, up to the factor that sets the rms gradient
    let gaussian = PowerSpectrum::new(&ground(1.0, 0.0).surface(square(512), 1).unwrap());
    let kept = PowerSpectrum::new(&exact_spectrum);
    for (before, after) in gaussian.density.iter().zip(&kept.density).take(60) {
        assert!((after / before - 1.0).abs() < 1e-9, "{after} against {before}");
    }
}

#[test]
fn every_possible_pair_of_skewness_and_kurtosis_is_met() {
    for (skewness, kurtosis) in [
        (0.0, 3.0),
        (0.0, 1.8),
        (0.0, 6.0),
        (-1.0, 4.0),
        (1.0, 2.4),
        (-2.0, 9.0),
        (0.5, 3.5),
        (-0.7, 3.2),
        (1.521, 6.23),
        (3.0, 20.0),
        (0.0, 1.2),
        (-1.5, 3.6),
    ] {
        let distribution = HeightDistribution::Moments { skewness, kurtosis };
        let surface = with_heights(distribution, ExactPart::Heights).surface(square(256), 1).unwrap();
        let [found_skewness, found_kurtosis] = moments(&surface);
        let within = 1e-3;
        assert!(
            (found_skewness - skewness).abs() < within * (1.0 + skewness.abs()),
            "{found_skewness} for {skewness}, {kurtosis}"
        );
        assert!((found_kurtosis / kurtosis - 1.0).abs() < within, "{found_kurtosis} for {skewness}, {kurtosis}");
    }
}

#[test]
fn impossible_pairs_are_refused_with_the_bound() {
    for (skewness, kurtosis, least) in [(1.0, 2.0, 2.0), (-2.0, 4.9, 5.0), (0.0, 0.5, 1.0), (f64::NAN, 3.0, f64::NAN)] {
        let roughness = with_heights(HeightDistribution::Moments { skewness, kurtosis }, ExactPart::Heights);
        let refused = roughness.check(&square(64)).unwrap_err();
        let RoughnessError::Surface(SurfaceError::Kurtosis { least: told, .. }) = refused else { panic!("{refused}") };
        assert!(told == least || told.is_nan() && least.is_nan(), "{told} against {least}");
    }
}

#[test]
fn beta_heights_and_those_of_a_file_are_met() {
    // the moments of beta(2, 5): skewness 0.5963, kurtosis 2.88
    let beta = with_heights(HeightDistribution::Beta { shapes: [2.0, 5.0] }, ExactPart::Heights);
    let beta = beta.surface(square(256), 3).unwrap();
    let [skewness, kurtosis] = moments(&beta);
    let [a, b] = [2.0f64, 5.0];
    let exact = 2.0 * (b - a) * (a + b + 1.0).sqrt() / ((a + b + 2.0) * (a * b).sqrt());
    assert!((skewness - exact).abs() < 1e-3 && (kurtosis - 2.88).abs() < 5e-3, "{skewness}, {kurtosis}");

    let text: String = beta.heights().iter().map(|height| format!("{height:e}\n")).collect();
    let file = HeightFile::in_memory("worn.txt", text.into_bytes());
    let like = with_heights(HeightDistribution::Like(file), ExactPart::Heights).surface(square(128), 8).unwrap();
    let [skewness, kurtosis] = moments(&like);
    assert!((skewness - exact).abs() < 5e-3 && (kurtosis - 2.88).abs() < 2e-2, "{skewness}, {kurtosis}");
}

/// Only the upper tail touches: turned upside down, the same spectrum has another area and gap under the same load.
#[test]
fn turned_heights_have_the_opposite_skewness_and_another_contact() {
    let skewed = |skewness: f64| {
        let roughness = with_heights(HeightDistribution::Moments { skewness, kurtosis: 4.0 }, ExactPart::Heights);
        roughness.surface(square(256), 1).unwrap()
    };
    let up = skewed(1.0);
    let down = Surface::new(*up.grid(), -up.heights_as_given()).unwrap();
    let [[one, _], [other, _]] = [moments(&up), moments(&down)];
    assert!((one + other).abs() < 1e-12 && one > 0.98);
    let [above, below] = [&up, &down].map(PowerSpectrum::new);
    assert!(above.density.iter().zip(&below.density).all(|(a, b)| (a - b).abs() <= 1e-12 * a));
    let contact = |surface: &Surface| {
        let problem = Problem::new(surface.clone(), ContactModulus(1.0), Load::ReducedPressure(0.05)).unwrap();
        Multilevel.solve(&problem, &Stop::default(), &mut ()).unwrap().converged().unwrap()
    };
    let [peaks, plateaus] = [&up, &down].map(contact);
    let area = |it: &asperity::contact::Contact| it.resolved().relative_area;
    println!("areas {} and {}, gaps {} and {}", area(&peaks), area(&plateaus), peaks.mean_gap(), plateaus.mean_gap());
    assert!(peaks.mean_gap() > 1.5 * plateaus.mean_gap());
    assert!((area(&peaks) / area(&plateaus) - 1.0).abs() > 0.02);
}

#[test]
fn what_a_grid_cannot_carry_is_refused() {
    let refused = |roughness: &RandomRoughness, grid: &Grid| roughness.check(grid).unwrap_err().to_string();
    let line = Grid::line(512, 1.0).unwrap();
    assert!(refused(&ground(3.0, 0.0), &line).contains("a line has no lay"));
    assert!(refused(&ground(0.0, 0.0), &square(512)).contains("Peklenik's number is 0.0"));
    assert!(refused(&ground(3.0, f64::NAN), &square(512)).contains("the angle of the lay is NaN"));
    // across the lay the shortest waves are shorter by the root of Peklenik's number
    assert!(refused(&ground(9.0, 0.0), &square(256)).contains("the shortest wavelength along y"));
    let table = measured(table(SpectrumConvention::Surface), SpectrumConvention::Surface);
    assert!(refused(&table, &square(64)).contains("too short for the grid"));
}
