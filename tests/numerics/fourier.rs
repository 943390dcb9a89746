//! The transform pair against its definition.

use asperity::Grid;
use asperity::fourier::{Complex, Fourier};
use std::f64::consts::TAU;

fn noise(n: usize) -> Vec<f64> {
    (0..n).map(|i| ((i * i) as f64 * 0.7).sin()).collect()
}

/// The definition, term by term.
fn direct(field: &[f64], [ny, nx]: [usize; 2]) -> Vec<Complex> {
    let coefficient = |kx: usize, ky: usize| {
        let mut sum = Complex::default();
        for (i, &f) in field.iter().enumerate() {
            let phase = TAU * ((kx * (i % nx)) as f64 / nx as f64 + (ky * (i / nx)) as f64 / ny as f64);
            sum += Complex::from_polar(f, -phase);
        }
        sum / (nx * ny) as f64
    };
    (0..=nx / 2).flat_map(|kx| (0..ny).map(move |ky| coefficient(kx, ky))).collect()
}

#[test]
fn forward_is_the_definition_and_inverse_undoes_it_on_awkward_grids() {
    let grids = [[1, 4], [1, 5], [1, 31], [4, 4], [7, 5], [12, 16], [5, 12], [17, 9], [33, 4], [4, 37]];
    for shape in grids {
        let grid =
            if shape[0] == 1 { Grid::line(shape[1], 1.0).unwrap() } else { Grid::surface(shape, [1.0, 2.0]).unwrap() };
        let field = noise(grid.len());
        let mut fourier = Fourier::new(&grid);
        let mut spectrum = vec![Complex::default(); grid.modes()];
        fourier.forward(&field, &mut spectrum);
        for (fast, slow) in spectrum.iter().zip(direct(&field, shape)) {
            assert!((fast - slow).norm() < 1e-14, "{shape:?}: {fast} against {slow}");
        }
        let mut back = vec![0.0; grid.len()];
        fourier.inverse(&mut spectrum, &mut back);
        for (a, b) in field.iter().zip(&back) {
            assert!((a - b).abs() < 1e-14, "{shape:?}: {a} against {b}");
        }
    }
}
