//! What the tip of an instrument and a second measurement tell of heights whose truth is known.

use asperity::contact::{ContactModulus, Load, Multilevel, Problem, Solver, Stop};
use asperity::formats::Scan;
use asperity::surface::{RepeatNoise, Spectrum, TipReach};
use asperity::{Grid, Surface};
use ndarray::Array2;
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// Nodes along each axis; the spacing is 1.
const N: usize = 96;

fn scan(height: Array2<f64>) -> Scan {
    Scan { height, spacing: [1.0; 2] }
}

fn rough(short_cutoff: f64, seed: u64) -> Array2<f64> {
    let grid = Grid::surface([N, N], [N as f64; 2]).unwrap();
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: N as f64 / 4.0, short_cutoff, rms_gradient: 0.1 };
    Surface::rough(grid, &spectrum, seed).unwrap().heights_as_given()
}

/// What a ball of some radius measures: its lowest place above each node, over all nodes below it. Written for itself, node by node.
fn image(truth: &Array2<f64>, radius: f64) -> Array2<f64> {
    let (ny, nx) = truth.dim();
    let far = radius.ceil() as usize;
    Array2::from_shape_fn((ny, nx), |(y, x)| {
        let mut apex = f64::NEG_INFINITY;
        for row in y.saturating_sub(far)..(y + far + 1).min(ny) {
            for column in x.saturating_sub(far)..(x + far + 1).min(nx) {
                let [dy, dx] = [row as f64 - y as f64, column as f64 - x as f64];
                let under = radius * radius - dy * dy - dx * dx;
                if under >= 0.0 {
                    apex = apex.max(truth[(row, column)] + under.sqrt() - radius);
                }
            }
        }
        apex
    })
}

/// A ball of radius r on a plane has the image of a ball of radius r + R, and below a tip of radius R it is the ball of radius r again. The tip reaches
/// neither the ball nor the plane between the places where it touches both: at `d = sqrt((r + R)^2 - R^2)` from the middle it touches the plane,
/// and at `d r / (r + R)` the ball.
#[test]
fn a_ball_below_a_tip_is_found_again_as_far_as_the_tip_reaches() {
    for (r, tip) in [(20.0, 30.0), (30.0, 15.0), (12.0, 60.0)] {
        let n = 161;
        let distance = |(y, x): (usize, usize)| (y as f64 - 80.0).hypot(x as f64 - 80.0);
        let image = |node| (((r + tip) * (r + tip) - distance(node).powi(2)).max(0.0).sqrt() - tip).max(0.0);
        let found = TipReach::new(&scan(Array2::from_shape_fn((n, n), image)), tip).unwrap();
        let on_plane: f64 = ((r + tip) * (r + tip) - tip * tip).sqrt();
        let on_ball = on_plane * r / (r + tip);
        let (mut ring, mut inside) = (0, 0);
        for (node, is_certain) in found.is_certain.indexed_iter() {
            let d = distance(node);
            if d > on_ball + 3.0 && d < on_plane - 3.0 {
                ring += 1;
                assert!(!is_certain, "a tip of {tip} does not reach {d} from the middle of a ball of {r}");
            } else if d < on_ball - 3.0 {
                inside += 1;
                let ball = (r * r - d * d).sqrt();
                assert!((found.height.height[node] - ball).abs() < 0.03 * r, "{r}, {tip}, {d}");
                assert!(is_certain, "a tip of {tip} reaches {d} from the middle of a ball of {r}");
            } else if d > on_plane + 3.0 && d < 78.0 {
                assert!(*is_certain && found.height.height[node] == 0.0, "{r}, {tip}, {d}");
            }
        }
        assert!(ring > 100 && inside > 20);
        // the highest nodes are those around the ball, of which the tip reaches the cap
        let share = std::f64::consts::PI * 25f64.powi(2) / (n * n) as f64;
        let told = (1.0 - (on_ball / 25.0).powi(2)).max(0.0);
        let found = found.unreached_share_of_highest(share);
        assert!((found - told).abs() < 0.12, "{r}, {tip}: {found} for {told}");
    }
}

/// Heights below a tip are nowhere below the truth, and are the truth where the tip has touched alone.
#[test]
fn certain_heights_are_those_of_the_truth() {
    let mut shares = Vec::new();
    for seed in 0..4 {
        for radius in [3.0, 10.0, 40.0] {
            let truth = rough(6.0, 900 + seed);
            let image = scan(image(&truth, radius));
            let found = TipReach::new(&image, radius).unwrap();
            let rms = truth.std(0.0);
            let mut off = Vec::new();
            for ((node, below), is_certain) in found.height.height.indexed_iter().zip(&found.is_certain) {
                assert!(*below >= truth[node] - 1e-9 && *below <= image.height[node] + 1e-12);
                if *is_certain {
                    off.push(below - truth[node]);
                }
            }
            off.sort_unstable_by(f64::total_cmp);
            let most = off[(0.95 * off.len() as f64) as usize];
            assert!(most < 0.15 * rms, "a tip of {radius}: {most:.2e} of {rms:.2e}");
            // a tip does not measure heights that are sharper than itself
            assert!(found.sharper_share(&image) < 0.01, "{radius}: {}", found.sharper_share(&image));
            let sharper = TipReach::new(&image, 6.0 * radius).unwrap().sharper_share(&image);
            assert!(radius > 3.0 || sharper > 0.05, "{radius}: {sharper}");
            shares.push(found.unreached_share());
            println!(
                "{seed} {radius} {:.3} {:.3} {:.3}",
                found.unreached_share(),
                most / rms,
                found.area_error(&image)
            );
        }
    }
    for of_seed in shares.chunks(3) {
        assert!(of_seed[0] < of_seed[1] && of_seed[1] < of_seed[2], "larger tips reach less: {shares:?}");
    }
}

#[test]
fn a_tip_has_a_positive_radius() {
    let flat = scan(Array2::zeros((8, 8)));
    assert!(TipReach::new(&flat, 0.0).unwrap_err().to_string().contains("tip radius"));
}

/// Noise that is alike at neighbours, of an rms height: the sum of normal values on a square of some nodes.
fn noise(rms: f64, width: usize, random: &mut ChaCha8Rng) -> Array2<f64> {
    let white: Array2<f64> = Array2::from_shape_fn((N + width, N + width), |_| StandardNormal.sample(random));
    Array2::from_shape_fn((N, N), |(y, x)| {
        let part = (0..width * width).map(|i| white[(y + i / width, x + i % width)]);
        rms * part.sum::<f64>() / width as f64
    })
}

fn area(height: &Array2<f64>) -> f64 {
    let surface = Surface::new(Grid::surface([N, N], [N as f64; 2]).unwrap(), height.clone()).unwrap();
    let problem = Problem::new(surface, ContactModulus(1.0), Load::MeanPressure(3e-3)).unwrap();
    Multilevel.solve(&problem, &Stop::default(), &mut ()).unwrap().counted().relative_area
}

/// Two measurements tell the rms height of noise, how it is alike at neighbours, the rms gradient without it and an error of areas that covers the true
/// one, also for noise that one map does not tell from roughness. Of noise on a square of w nodes neighbours have a correlation of `1 - 1/w`.
#[test]
fn a_second_measurement_tells_noise_that_is_alike_at_neighbours() {
    let mut random = ChaCha8Rng::seed_from_u64(17);
    let mut ratios = Vec::new();
    for seed in 0..3 {
        for width in [1, 2, 3] {
            for level in [0.02, 0.06, 0.12] {
                let truth = rough(6.0, 950 + seed);
                let drift = Array2::from_shape_fn((N, N), |(y, x)| 0.3 - 0.01 * y as f64 + 0.02 * x as f64);
                let one = scan(&truth + &noise(level, width, &mut random));
                let two = scan(&truth + &noise(level, width, &mut random) + &drift);
                let found = RepeatNoise::new(&one, &two).unwrap();
                assert!((found.rms / level - 1.0).abs() < 0.05, "{found:?}");
                let alike = 1.0 - 1.0 / width as f64;
                assert!(found.correlation.iter().all(|it| (it - alike).abs() < 0.06), "{found:?}");
                let without = scan(truth.clone()).rms_gradient();
                // the gradient of the noise is known within a part of it, and the rest is a difference
                let tolerance = 0.02 + 0.03 / (1.0 - found.share);
                assert!((found.rms_gradient[1] / without - 1.0).abs() < tolerance, "{without}: {found:?}");
                assert!(found.shift.is_none() && !found.is_of_another_place, "{found:?}");
                let (with, truth) = (area(&one.height), area(&truth));
                let off = (with / truth - 1.0).abs();
                println!("{width} {level} {off:.3} {:.3}", found.area_error);
                ratios.push((off, found.area_error));
            }
        }
    }
    let missed = ratios.iter().filter(|(off, told)| *off > told.max(0.03)).count();
    let loud = ratios.iter().filter(|(off, told)| *told > 5.0 * off.max(0.03)).count();
    assert!(missed == 0 && loud == 0, "{missed} missed, {loud} too loud: {ratios:?}");
}

/// What is no second measurement of the same place is said: another place, a shift by some nodes, another shape.
#[test]
fn another_place_is_no_repetition() {
    let (one, other) = (scan(rough(6.0, 1)), scan(rough(6.0, 2)));
    assert!(RepeatNoise::new(&one, &other).unwrap().is_of_another_place);
    let moved = Array2::from_shape_fn((N, N), |(y, x)| one.height[((y + N - 2) % N, (x + 1) % N)]);
    let found = RepeatNoise::new(&one, &scan(moved)).unwrap();
    assert_eq!(found.shift, Some([2, -1]), "{found:?}");
    let part = scan(Array2::zeros((N, N - 1)));
    assert!(RepeatNoise::new(&one, &part).is_err());
}
