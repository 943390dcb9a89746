//! A wheel rolls on a rail of the same material: the force that a creepage makes, and the part that sticks, as Carter found.
//!
//! `cargo run --release --example rolling`

use asperity::contact::{ContactModulus, Load};
use asperity::history::{Rolling, RollingConditions, RollingDrive};
use asperity::{Grid, Indenter, Problem, Stop};
use std::f64::consts::PI;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // newton and metre: 178.9 kN for each metre of the width, two bodies of steel, a radius of 0.5 m
    let (modulus, radius, force, friction) = (113.9e9, 0.5, 178.9e3, 0.3);
    let grid = Grid::line(2048, 4e-3)?.with_periodic([false; 2]);
    let wheel = Indenter::Cylinder { radius }.surface(grid)?;
    let problem = Problem::new(wheel, ContactModulus(modulus), Load::Force(force))?;
    let half_width = (4.0 * force * radius / (PI * modulus)).sqrt();
    // everything slides beyond this creepage
    let largest = friction * half_width / radius;

    println!("  creepage  Fx/(mu Fn)    exact   sticks    exact  certificate");
    for share in [0.1, 0.2, 0.4, 0.6, 0.8, 1.2] {
        let drive = RollingDrive::Creepage(-share * largest);
        let conditions = RollingConditions { friction, step: grid.spacing()[1], beta: 0.0, drive };
        let rolling = Rolling::solve(&problem, conditions, &Stop::default(), &mut ())?;
        let sticks = rolling.sticks().iter().filter(|it| **it).count() as f64;
        let touching = rolling.contact.pressure.iter().filter(|p| **p > 0.0).count() as f64;
        // Carter: Fx = mu Fn (1 - (1 - xi/xi_max)^2), and the part 1 - xi/xi_max sticks
        let stuck = f64::max(1.0 - share, 0.0);
        println!(
            "{:>10.2e} {:>11.4} {:>8.4} {:>8.4} {stuck:>8.4} {:>12.1e}",
            rolling.creepage(),
            rolling.ratio(),
            1.0 - stuck * stuck,
            sticks / touching,
            rolling.traction_certificate,
        );
    }
    Ok(())
}
