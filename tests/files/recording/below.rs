//! Pictures of the stress below the surface, read back from their files.

use super::instruments::{record, values};
use super::rough_surface;
use asperity::contact::{ContactModulus, Load, Multilevel};
use asperity::setup::Part;
use asperity::{Grid, Indenter, Problem};

/// The largest of the values and its row and column.
fn highest(values: &[f32], width: usize) -> (f32, [usize; 2]) {
    let most = (0..values.len()).fold(0, |most, i| if values[i] > values[most] { i } else { most });
    (values[most], [most / width, most % width])
}

/// A cylinder in a cell without a scene that knows its contact: the whole line is shown.
fn cylinder() -> Problem {
    let surface = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(2048, 4.0).unwrap()).unwrap();
    Problem::new(surface, ContactModulus(2.0), Load::MeanPressure(0.02)).unwrap()
}

#[test]
fn the_picture_below_a_cylinder_is_that_of_hertz() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let problem = cylinder();
    let contact = record(&path, &problem, &Multilevel, &[Part::Stress, Part::Fringes], false);
    let ([width, height], tau) = values(&path, "/it/stress/image");
    let (most, [row, column]) = highest(&tau, width);
    // the mean pressure is carried without lateral strain, which adds half of sigma_zz - sigma_xx = -<p> (1 - nu/(1 - nu))
    let expected = 0.30 * contact.max_pressure() + 0.5 * contact.mean_pressure() * (1.0 - 0.3 / 0.7);
    assert!((f64::from(most) / expected - 1.0).abs() < 0.02, "{most} against {expected}");
    let pixel = 4.0 / width as f64;
    let half_width = 2.0 * contact.resolved().relative_area;
    assert!(((row as f64 + 0.5) * pixel / half_width - 0.78).abs() < 0.1, "row {row}");
    assert!(column.abs_diff(width / 2) <= 1);
    let symmetric = |row: usize, i: usize| (tau[row * width + i] - tau[(row + 1) * width - 1 - i]).abs() < 0.05 * most;
    assert!((3..height).all(|row| (2..width / 2).all(|i| symmetric(row, i))));
    let (_, light) = values(&path, "/it/fringes/image");
    assert!(light.iter().all(|light| (-1e-6..=1.0 + 1e-6).contains(light)));
    assert!(light.iter().any(|&light| light > 0.9) && light.iter().any(|&light| light < 0.1));
}

#[test]
fn a_cut_below_a_surface_goes_through_its_highest_peak() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let problem = rough_surface();
    let contact = record(&path, &problem, &Multilevel, &[Part::Stress], false);
    let ([width, _], tau) = values(&path, "/it/stress/image");
    let height = problem.height();
    let peak = (0..height.len()).fold(0, |best, i| if height[i] > height[best] { i } else { best });
    // where the peak presses, the stress just below it is a share of its pressure
    let column = (peak % 48) * width / 48 + width / 96;
    let below = (0..12).map(|row| tau[row * width + column]).fold(0.0, f32::max);
    let pressure = contact.pressure[[peak / 48, peak % 48]] as f32;
    assert!((0.15..0.5).contains(&(below / pressure)), "{below} below {pressure}");
}
