//! Pressures of ContactMechanics 1.8.3, which are kept as data.
//!
//! `rough` are heights of 48 x 48 points on a unit cell, pressed by a mean pressure of 0.02 on layers of `E* = 1`, `nu = 0.3` and the
//! thickness 0.05 or 0.5 (`PeriodicFFTElasticHalfSpace(thickness=)`, whose `young` is `E`). `dome` is pressed without images by a force of
//! 0.01 (`FreeFFTElasticHalfSpace`, whose `young` is `E*`). Both by its conjugate gradients, to a penetration of 2e-15.

use asperity::contact::{ContactModulus, Load, Multilevel, PolonskyKeer, Solver};
use asperity::elastic::{Base, ElasticSolid, Layer};
use asperity::formats::read_heights;
use asperity::surface::Field;
use asperity::{Grid, Problem, Stop, Surface};
use std::path::Path;
use std::sync::Arc;

fn data(name: &str) -> Field {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/data/contact_mechanics_{name}.npy"));
    read_heights(&path).unwrap().into_dimensionality().unwrap()
}

fn compare(heights: &str, grid: Grid, solid: impl Into<Arc<dyn ElasticSolid>>, load: Load, theirs: &str) {
    let problem = Problem::new(Surface::new(grid, data(heights)).unwrap(), solid, load).unwrap();
    let theirs = data(theirs);
    for solver in [&Multilevel as &dyn Solver, &PolonskyKeer] {
        let stop = Stop::new(1e-13, 100_000).unwrap();
        let contact = solver.solve(&problem, &stop, &mut ()).unwrap();
        let norm = |field: &Field| field.mapv(|p| p * p).sum().sqrt();
        let apart = norm(&(&contact.pressure - &theirs)) / norm(&theirs);
        assert!(apart < 1e-6, "{}: {apart} from {theirs:?}", solver.name());
    }
}

#[test]
fn layers_are_those_of_contact_mechanics() {
    let grid = Grid::surface([48, 48], [1.0, 1.0]).unwrap();
    for (thickness, theirs) in [(0.05, "layer_thin"), (0.5, "layer_thick")] {
        let layer = Layer { contact_modulus: 1.0, poisson: 0.3, thickness, base: Base::Bonded };
        compare("rough", grid, layer, Load::MeanPressure(0.02), theirs);
    }
}

#[test]
fn a_rough_patch_without_images_is_that_of_contact_mechanics() {
    let grid = Grid::surface([48, 48], [1.0, 1.0]).unwrap().with_periodic([false; 2]);
    compare("dome", grid, ContactModulus(1.0), Load::Force(0.01), "free");
}
