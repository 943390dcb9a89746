//! A sphere on a layer: the thinner it is, the stiffer the contact, and the smaller.
//!
//! cargo run --release --example layer

use asperity::contact::{Load, Multilevel, Solver};
use asperity::elastic::{Base, ElasticSolid, HalfSpace, Layer};
use asperity::{Grid, Indenter, Problem, Stop};
use std::sync::Arc;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let sphere = Arc::new(Indenter::Sphere { radius: 1.0 }.surface(Grid::surface([256, 256], [1.0, 1.0])?)?);
    let load = Load::Force(1e-3);
    let layer = |thickness, base| -> Arc<dyn ElasticSolid> {
        Layer { contact_modulus: 1.0, poisson: 0.4, thickness, base }.into()
    };
    let thicknesses = [0.5, 0.2, 0.1, 0.05, 0.02];
    let layers = thicknesses.into_iter().flat_map(|t| [layer(t, Base::Bonded), layer(t, Base::Sliding)]);
    println!("{:>10} {:>12} {:>12}  solid", "a", "p_max / E*", "approach");
    for solid in [HalfSpace::new(1.0).into()].into_iter().chain(layers) {
        let problem = Problem::new(sphere.clone(), solid, load)?;
        let contact = Multilevel.solve(&problem, &Stop::default(), &mut ())?.converged()?;
        let radius = (contact.resolved().relative_area / std::f64::consts::PI).sqrt();
        let approach = contact.approach().map_or("none".into(), |approach| format!("{approach:.4e}"));
        println!("{radius:>10.5} {:>12.5} {approach:>12}  {}", contact.max_pressure(), problem.solid().description());
    }
    Ok(())
}
