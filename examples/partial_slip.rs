//! A cylinder pressed and then pulled: the part that sticks shrinks until all slides, as Cattaneo and Mindlin found.
//!
//! `cargo run --release --example partial_slip`

use asperity::contact::{ContactModulus, Friction, Load, Multilevel, PartialSlip, Solver};
use asperity::{Grid, Indenter, Problem, Stop};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (mean_pressure, coefficient) = (1e-3, 0.3);
    let cylinder = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(1 << 14, 4.0)?)?;
    let problem = Problem::new(cylinder, ContactModulus(1.0), Load::MeanPressure(mean_pressure))?;
    let pressed = Multilevel.solve(&problem, &Stop::default(), &mut ())?.converged()?;
    println!("Q/(mu P)  stick/contact  exact     largest traction/(mu p0)");
    for ratio in [0.1, 0.3, 0.5, 0.7, 0.9, 0.99] {
        let friction = Friction { coefficient, tangential: ratio * coefficient * mean_pressure };
        let slip = PartialSlip::solve(pressed.clone(), friction, &Multilevel, &Stop::default(), &mut ())?;
        let stick = slip.stick().relative_area / slip.touching().relative_area;
        let largest = slip.traction().fold(0.0, |most: f64, &tau| most.max(tau));
        let share = largest / (coefficient * pressed.max_pressure());
        println!("{ratio:>8}  {stick:>13.5}  {:.5}  {share:>8.4}", (1.0 - ratio).sqrt());
    }
    // a load that friction cannot carry is an error, with the numbers in it
    let sliding = Friction { coefficient, tangential: coefficient * mean_pressure };
    match PartialSlip::solve(pressed, sliding, &Multilevel, &Stop::default(), &mut ()) {
        Ok(_) => println!("it sticks"),
        Err(error) => println!("{error}"),
    }
    Ok(())
}
