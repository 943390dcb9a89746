//! Heights about their mean, and their gradient.

use asperity::surface::Field;
use asperity::{Grid, Surface};

fn line(height: impl Fn(f64) -> f64) -> Surface {
    Surface::line(ndarray::Array1::from_shape_fn(64, |i| height(i as f64)).view(), 1.0).unwrap()
}

#[test]
fn heights_are_about_their_mean_and_come_back_as_given() {
    for offset in [0.0, 0.3, -7.0, 1e9] {
        let surface = line(|i| offset + (i * i).sin());
        let mean = (0..64).map(|i| ((i * i) as f64).sin()).sum::<f64>() / 64.0;
        assert!((surface.mean_height() - (offset + mean)).abs() <= 1e-15 * offset.abs().max(1.0));
        assert!(surface.heights().iter().sum::<f64>().abs() < 1e-12, "{offset}");
        for (i, &given) in surface.heights_as_given().iter().enumerate() {
            let expected = offset + ((i * i) as f64).sin();
            assert!((given - expected).abs() <= 4.0 * f64::EPSILON * offset.abs().max(1.0), "{given} {expected}");
        }
    }
}

#[test]
fn heights_about_their_mean_are_kept_to_the_last_bit() {
    for seed in 1..20 {
        let once = line(|i| 0.3 + (seed as f64 * i * i).sin());
        let twice = Surface::new(*once.grid(), once.height().clone()).unwrap();
        assert_eq!((twice.heights(), twice.mean_height()), (once.heights(), 0.0));
    }
}

#[test]
fn square_gradients_are_equation_8() {
    let noise = |(i, j): (usize, usize)| ((4 * i + j) as f64).powi(2).sin();
    let surface = Surface::new(Grid::surface([5, 4], [1.0, 2.0]).unwrap(), Field::from_shape_fn((5, 4), noise));
    let surface = surface.unwrap();
    let (h, found) = (surface.height(), surface.square_gradient());
    for (n, ((i, j), &z)) in h.indexed_iter().enumerate() {
        let square = |neighbour: f64, spacing: f64| 0.5 * ((z - neighbour) / spacing).powi(2);
        let expected = square(h[[(i + 1) % 5, j]], 0.2)
            + square(h[[(i + 4) % 5, j]], 0.2)
            + square(h[[i, (j + 1) % 4]], 0.5)
            + square(h[[i, (j + 3) % 4]], 0.5);
        assert!((found(n) - expected).abs() < 1e-12);
    }
}
