//! Exact solutions on grids: the gap is closed in contact and open elsewhere.

use asperity::fourier::{Complex, Fourier};
use asperity::theory::{Exact, crossed_full_pressure, hertz};
use asperity::{Grid, Indenter};
use std::f64::consts::PI;

const MODULUS: f64 = 2.0;

/// The gap under the sampled pressure, up to a constant: `u - h` with `u_q = 2 p_q/(E* q)`.
fn gap(indenter: &Indenter, grid: Grid, exact: &Exact) -> Vec<f64> {
    let surface = indenter.surface(grid).unwrap();
    let mut spectrum = vec![Complex::default(); grid.modes()];
    let mut fourier = Fourier::new(&grid);
    fourier.forward(exact.pressure.as_slice().unwrap(), &mut spectrum);
    for (coefficient, q) in spectrum.iter_mut().zip(grid.wavenumbers()) {
        *coefficient *= if q > 0.0 { 2.0 / (MODULUS * q) } else { 0.0 };
    }
    let mut displacement = vec![0.0; grid.len()];
    fourier.inverse(&mut spectrum, &mut displacement);
    displacement.iter().zip(surface.heights()).map(|(u, h)| u - h).collect()
}

/// The largest gap in contact, the smallest outside, and the mean, all over the range of the heights.
fn gaps(indenter: &Indenter, grid: Grid, exact: &Exact) -> [f64; 3] {
    let gap = gap(indenter, grid, exact);
    let surface = indenter.surface(grid).unwrap();
    let bounds = |f: &[f64]| f.iter().fold([f64::MAX, f64::MIN], |[a, b], &v| [a.min(v), b.max(v)]);
    let [low, high] = bounds(surface.heights());
    let nodes = gap.iter().zip(&exact.pressure).zip(surface.heights());
    let touching = nodes.filter(|&((_, &p), &h)| p > 0.0 && h > low);
    let [first, last] = bounds(&touching.map(|((g, _), _)| *g).collect::<Vec<_>>());
    let datum = 0.5 * (first + last);
    let mean = gap.iter().sum::<f64>() / gap.len() as f64;
    [0.5 * (last - first), bounds(&gap)[0] - datum, mean - datum].map(|g| g / (high - low))
}

#[test]
fn line_solutions_close_the_gap_in_contact_and_nowhere_open_it_below_zero() {
    let cases = [
        (Indenter::Sine { amplitude: 0.3 }, 0.4),
        (Indenter::Sine { amplitude: 0.3 }, 5.0),
        (Indenter::Cylinder { radius: 0.25 }, 0.2),
        (Indenter::Cylinder { radius: 0.25 }, 1.5),
        (Indenter::Wedge { slope: 0.3 }, 0.2),
        (Indenter::PowerLaw { coefficient: 1.0, exponent: 1.5 }, 0.3),
        (Indenter::PowerLaw { coefficient: 3.0, exponent: 4.0 }, 0.5),
        (Indenter::Punch { half_width: 100.5 / 4096.0, depth: 1.0 }, 0.1),
    ];
    for (indenter, mean_pressure) in cases {
        let grid = Grid::line(4096, 1.0).unwrap();
        let exact = Exact::new(&indenter, &grid, MODULUS, mean_pressure).unwrap();
        let [in_contact, smallest, mean] = gaps(&indenter, grid, &exact);
        assert!(in_contact < 1e-3, "{indenter:?}: {in_contact}");
        assert!(smallest > -1e-3, "{indenter:?}: {smallest}");
        let heights = indenter.surface(grid).unwrap();
        let range = heights.heights().iter().fold(0.0_f64, |m, h| m.max(heights.heights()[2048] - h));
        let expected = exact.mean_gap.unwrap() / range;
        assert!((mean - expected).abs() < 1e-3, "{indenter:?}: {mean} against {expected}");
        assert!((exact.pressure.mean().unwrap() / mean_pressure - 1.0).abs() < 2e-3, "{indenter:?}");
    }
}

#[test]
fn isolated_solutions_close_the_gap_in_contact() {
    let cases = [
        (Indenter::Sphere { radius: 1.0 }, 0.002),
        (Indenter::Cone { slope: 0.2 }, 0.004),
        (Indenter::PowerLaw { coefficient: 1.0, exponent: 3.0 }, 0.0005),
        (Indenter::Punch { half_width: 0.1, depth: 1.0 }, 0.01),
    ];
    for (indenter, mean_pressure) in cases {
        let grid = Grid::surface([512, 512], [1.0, 1.0]).unwrap();
        let exact = Exact::new(&indenter, &grid, MODULUS, mean_pressure).unwrap();
        let [in_contact, smallest, _] = gaps(&indenter, grid, &exact);
        assert!(in_contact < 3e-3, "{indenter:?}: {in_contact}");
        assert!(smallest > -3e-3, "{indenter:?}: {smallest}");
        assert!((exact.pressure.mean().unwrap() / mean_pressure - 1.0).abs() < 2e-2, "{indenter:?}");
    }
}

#[test]
fn the_sphere_is_hertz() {
    let grid = Grid::surface([64, 64], [1.0, 1.0]).unwrap();
    let exact = Exact::new(&Indenter::Sphere { radius: 1.0 }, &grid, 1.0, 0.001).unwrap();
    let contact = hertz::sphere(1.0, 1.0);
    let a = contact.half_width(0.001);
    assert!((exact.relative_area - PI * a * a).abs() < 1e-15);
    assert_eq!(exact.max_pressure, Some(exact.pressure[[32, 32]]));
    assert!((exact.kappa_r.unwrap() - hertz::KAPPA_R_POINT).abs() < 1e-14);
}

#[test]
fn full_contact_of_the_crossed_sine() {
    let (grid, indenter) = (Grid::surface([16, 24], [1.0, 2.0]).unwrap(), Indenter::CrossedSine { amplitude: 0.1 });
    let full = crossed_full_pressure(0.1, [1.0, 2.0], MODULUS);
    assert_eq!(Exact::new(&indenter, &grid, MODULUS, 0.99 * full), None);
    let exact = Exact::new(&indenter, &grid, MODULUS, 1.5 * full).unwrap();
    assert!(gaps(&indenter, grid, &exact)[0] < 1e-14);
    assert!((exact.pressure[[8, 12]] - exact.max_pressure.unwrap()).abs() < 1e-14);
}

#[test]
fn there_is_none_where_nothing_is_known() {
    let (line, surface) = (Grid::line(64, 1.0).unwrap(), Grid::surface([16, 16], [1.0, 1.0]).unwrap());
    let none = |indenter, grid, p| assert_eq!(Exact::new(&indenter, &grid, 1.0, p), None, "{indenter:?} at {p}");
    none(Indenter::Sphere { radius: 1.0 }, surface, 10.0);
    none(Indenter::Sphere { radius: 1.0 }, line, 0.1);
    none(Indenter::Cylinder { radius: -1.0 }, line, 0.1);
    none(Indenter::Cylinder { radius: 1.0 }, line, 1e6);
    none(Indenter::PowerLaw { coefficient: 1.0, exponent: 0.5 }, line, 0.1);
    none(Indenter::PowerLaw { coefficient: 1.0, exponent: 1e300 }, surface, 0.1);
    none(Indenter::Punch { half_width: 0.2, depth: 0.1 }, line, 1.0);
    none(Indenter::Punch { half_width: 0.2, depth: 0.1 }, surface, 1.0);
    for pressure in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        none(Indenter::Sine { amplitude: 1.0 }, line, pressure);
    }
}
