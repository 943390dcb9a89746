//! Results that are solved again from themselves.

use asperity::contact::archive;
use asperity::formats::{read_heights, write_heights};
use asperity::setup::{Setup, SetupTable};
use ndarray::Array1;
use std::path::Path;

/// A result on disk that was solved from a setup.
fn result(setup: &Setup, path: &Path) {
    let contact = setup.solver.solver().solve(&setup.problem().unwrap(), &setup.stop, &mut ()).unwrap();
    std::fs::write(path, archive(&contact, 1, Some(&setup.to_toml())).unwrap()).unwrap();
}

#[test]
fn results_are_repeated_from_themselves() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("result.npz");
    let smooth = Setup::from_toml(
        "surface = { indenter = { shape = 'sine', amplitude = 0.1 } }
         grid = { points = 32, size = 1.0 }
         load = { reduced-pressure = 0.1 }",
    );
    let smooth = smooth.unwrap();
    result(&smooth, &path);
    assert_eq!(SetupTable::read(&path).unwrap().setup().unwrap(), smooth);

    let heights = folder.path().join("heights.npy");
    let values = Array1::from_shape_fn(32, |i| (i as f64).sin());
    write_heights(&heights, values.view().into_dyn()).unwrap();
    let mut rough = smooth;
    (rough.surface.height, rough.grid.points) = (Some(heights.clone().into()), Vec::new());
    result(&rough, &path);
    std::fs::remove_file(heights).unwrap();
    let again = SetupTable::read(&path).unwrap().setup().unwrap();
    let (height, found) = (rough_height(&values), read_heights(&path).unwrap());
    assert!(height.iter().zip(&found).all(|(a, b)| (a - b).abs() < 1e-15));
    assert_eq!((again.surface.indenter, again.surface.height.clone()), (None, Some(path.clone().into())));
    assert_eq!((again.surface.rank(&again.grid).unwrap(), again.check().unwrap().shape()), (1, [1, 32]));

    let contact = again.solver.solver().solve(&again.problem().unwrap(), &again.stop, &mut ()).unwrap();
    std::fs::write(&path, archive(&contact, 1, None).unwrap()).unwrap();
    let refused = SetupTable::read(&path).unwrap_err().to_string();
    assert!(refused.contains("result.npz: it contains no setup"), "{refused}");
}

/// The heights with the sine of the setup above.
fn rough_height(values: &Array1<f64>) -> Vec<f64> {
    let sine = |i: usize| 0.1 * (std::f64::consts::TAU * (i as f64 / 32.0 - 0.5)).cos();
    values.iter().enumerate().map(|(i, value)| value + sine(i)).collect()
}
