//! A sticky sine is pressed and pulled at given mean gaps: it jumps into contact and out of it. The shorter the range of the attraction, the
//! closer are its loop and its jumps to the theory of Johnson, Kendall and Roberts, whose range is zero.
//!
//! `cargo run --release --example jkr`

use asperity::adhesion::{AdhesiveMethod, AdhesiveProblem, Attraction, AttractionForm};
use asperity::contact::{ContactModulus, Load, Quantity, State};
use asperity::history::{AdhesionTotals, AdhesiveProcess, PathPoint, Process};
use asperity::{Grid, Indenter, Problem, Stop};
use std::f64::consts::PI;

/// Johnson's alpha: alpha^2 = (2/pi) w/(D p_full), with the amplitude D and the pressure p_full that flattens the sine.
const ALPHA: f64 = 0.2;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (modulus, amplitude, length) = (1e6, 1e-6, 20e-6);
    let full = PI * modulus * amplitude / length;
    let work = PI / 2.0 * ALPHA * ALPHA * amplitude * full;
    let goals = [1.6, 0.4, 1.6].map(|gap| Load::MeanGap(gap * amplitude));
    let path = goals.map(|load| PathPoint { time: None, load, tangential: None });

    println!(
        "gaps over the amplitude, pressures over the one that flattens the sine; rho is the range over the amplitude"
    );
    println!(
        " rho    jump in at gap, to pressure   lowest pressure    pull-off at gap, from pressure   claims of both"
    );
    let mut pulled = Vec::new();
    for (nodes, range) in [(512, 0.1), (1024, 0.05), (4096, 0.03)] {
        let sine = Indenter::Sine { amplitude }.surface(Grid::line(nodes, length)?)?;
        // the load of a problem is not used with adhesion
        let problem = Problem::new(sine, ContactModulus(modulus), Load::MeanPressure(full))?;
        let attraction = Attraction::new(AttractionForm::Exponential, work, range * amplitude)?;
        let problem = AdhesiveProblem::new(problem, attraction)?;
        let mut states: Vec<State> = Vec::new();
        AdhesiveProcess::new(problem, path.to_vec(), 24, AdhesiveMethod::Fast, Stop::default()).run(
            &mut (),
            &mut |state| {
                states.push(state);
                Ok(())
            },
        )?;
        let totals = AdhesionTotals::new(&states).ok_or("the states have adhesion")?;
        let [into, out] = totals.jumps.as_slice() else { return Err("there are two jumps".into()) };
        let claims = [into, out].map(|jump| <&str>::from(states[jump.state - 2].claim));
        println!(
            "{range:<5} {:>13.4} {:>15.5} {:>16.5} {:>18.4} {:>15.5}   {}",
            into.mean_gap[0] / amplitude,
            into.mean_pressure[1] / full,
            totals.lowest_pressure.unwrap_or(f64::NAN) / full,
            out.mean_gap[0] / amplitude,
            out.mean_pressure[0] / full,
            claims.join(", "),
        );
        // the way back, at the points of the path between the jumps
        pulled = states.into_iter().skip_while(|state| state.point != Some(1)).step_by(2).take(9).collect();
    }
    let branch: Vec<(f64, f64)> = (1..60_000).map(|i| johnson(f64::from(i) / 2e5 * PI)).collect();
    let lowest = branch.iter().fold(f64::INFINITY, |least, (_, p)| least.min(*p));
    let end = branch.iter().copied().reduce(|a, b| if b.0 > a.0 { b } else { a }).ok_or("the branch has points")?;
    let stable = || branch.iter().skip_while(|it| **it != end);
    let at = |gap: f64| stable().find(|it| it.0 <= gap).map_or(f64::NAN, |it| it.1);
    println!("exact {:>13.4} {:>15.5} {lowest:>16.5} {:>18.4} {:>15.5}", 1.0, at(1.0), end.0, end.1);

    println!("\nthe way back for rho 0.03:  gap   pressure      exact");
    for state in pulled {
        let (gap, pressure) = (state.contact.mean_gap() / amplitude, state.value(Quantity::MeanPressure));
        println!("{gap:>31.2} {:>10.5} {:>10.5}", pressure / full, at(gap));
    }
    Ok(())
}

/// Mean gap over amplitude, and pressure over that of full contact, of a contact of half-width `psi L/pi` (Johnson 1995).
fn johnson(psi: f64) -> (f64, f64) {
    let pressure = psi.sin().powi(2) - ALPHA * psi.tan().sqrt();
    (psi.cos().powi(2) + 2.0 * pressure * psi.sin().ln(), pressure)
}
