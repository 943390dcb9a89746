//! Hertz without images: a sphere on a patch with a free boundary, beside the same patch repeated.
//!
//! cargo run --release --example free_boundary

use asperity::contact::{ContactModulus, Load, Multilevel, Solver};
use asperity::{Grid, Indenter, Problem, Stop};
use std::f64::consts::PI;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let periodic = Grid::surface([256, 256], [1.0, 1.0])?;
    println!("{:>8} {:>10} {:>10} {:>10} {:>12}", "force", "Hertz a", "free a", "periodic a", "approach R/a^2");
    for a in [0.05, 0.1, 0.2, 0.3, 0.4f64] {
        let force = 4.0 / 3.0 * a.powi(3);
        let pressed = |grid: Grid| -> Result<_, Box<dyn std::error::Error>> {
            let sphere = Indenter::Sphere { radius: 1.0 }.surface(grid)?;
            let problem = Problem::new(sphere, ContactModulus(1.0), Load::Force(force))?;
            Ok(Multilevel.solve(&problem, &Stop::default(), &mut ())?.converged()?)
        };
        let (free, repeated) = (pressed(periodic.with_periodic([false; 2]))?, pressed(periodic)?);
        let [alone, with_images] = [&free, &repeated].map(|it| (it.resolved().relative_area / PI).sqrt());
        let approach = free.approach().map_or(f64::NAN, |approach| approach / (a * a));
        println!("{force:>8.1e} {a:>10.4} {alone:>10.4} {with_images:>10.4} {approach:>12.4}");
    }
    Ok(())
}
