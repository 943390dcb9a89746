//! A pressed cylinder is pulled, pushed back and pulled again: friction dissipates energy in the parts that slip, below the load at which it slides.
//!
//! `cargo run --release --example slip_cycle`

use asperity::contact::{ContactModulus, Load, Multilevel};
use asperity::history::{SlipHistory, Zone};
use asperity::{Grid, Indenter, Problem, Stop};
use std::f64::consts::PI;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (modulus, force, friction, length) = (1.0, 1e-3, 0.3, 0.1);
    let grid = Grid::line(4096, length)?.with_periodic([false; 2]);
    let cylinder = Indenter::Cylinder { radius: 1.0 }.surface(grid)?;
    let problem = Problem::new(cylinder, ContactModulus(modulus), Load::Force(force))?;
    let limit = friction * force;

    println!("Q/(mu P)  sticks    exact  forward  backward  dissipated      exact  certificate");
    for ratio in [0.25, 0.5, 0.75, 0.95] {
        let mut history = SlipHistory::new(problem.clone(), friction, &Multilevel, Stop::default())?;
        let mut dissipated = 0.0;
        for (number, turn) in [1.0, -1.0, 1.0].into_iter().enumerate() {
            let state = history.step(Load::Force(force), turn * ratio * limit, &mut ())?;
            // the first pull is not part of the cycle
            dissipated += if number > 0 { length * state.dissipated } else { 0.0 };
            if number < 2 {
                continue;
            }
            let y: f64 = 1.0 - ratio;
            let exact = 2.0 * limit * limit / (PI * modulus) * (1.0 - y * y + 2.0 * y * y.ln());
            let slips = |zone: Zone| state.zones.iter().filter(|it| **it == zone).count();
            println!(
                "{ratio:>8}  {:>6.4}  {:>7.4}  {:>7}  {:>8}  {dissipated:>10.4e} {exact:>10.4e}  {:>11.1e}",
                state.stick_share(),
                y.sqrt(),
                slips(Zone::Forward),
                slips(Zone::Backward),
                state.certificate.eta,
            );
        }
    }
    Ok(())
}
