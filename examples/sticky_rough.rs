//! A rough surface is pulled off a soft solid, for several works of adhesion. A weak attraction holds as much as between rigid surfaces, which is
//! known exactly. A strong one pulls the surfaces together and holds several times as much, long before the number of Pastewka and Robbins is
//! below 1.
//!
//! `cargo run --release --example sticky_rough`

use asperity::adhesion::{AdhesiveMethod, AdhesiveProblem, Attraction, AttractionForm};
use asperity::contact::{ContactModulus, Load, Problem, Quantity, State, Stop};
use asperity::history::{AdhesionTotals, AdhesiveProcess, PathPoint, Process};
use asperity::surface::Spectrum;
use asperity::{Grid, Surface};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 20e-6, short_cutoff: 4e-6, rms_gradient: 0.1 };
    let rough = Surface::rough(Grid::surface([128, 128], [40e-6, 40e-6])?, &spectrum, 1)?;
    let (modulus, range) = (1e6, 0.2e-6);
    let problem = Problem::new(rough, ContactModulus(modulus), Load::MeanPressure(1e3))?;
    let highest = problem.surface().heights().iter().fold(f64::NEG_INFINITY, |most, h| most.max(*h));

    println!("       work  Pastewka-Robbins   area without load     pull-off   of rigid surfaces   largest possible");
    for millijoules in [0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 15.0] {
        let attraction = Attraction::new(AttractionForm::Exponential, 1e-3 * millijoules, range)?;
        // rigid surfaces hold most where they just touch
        let heights = problem.surface().heights();
        let rigid = heights.iter().map(|h| attraction.traction(highest - h)).sum::<f64>() / heights.len() as f64;
        let strength = attraction.strength();
        let problem = AdhesiveProblem::new(problem.clone(), attraction)?;
        let scales = *problem.scales();

        // pressed, released, and pulled until it parts
        let loads = [10e3, 0.0, -strength];
        let path = loads.map(|load| PathPoint { time: None, load: Load::MeanPressure(load), tangential: None });
        let mut states: Vec<State> = Vec::new();
        AdhesiveProcess::new(problem, path.to_vec(), 10, AdhesiveMethod::Fast, Stop::default()).run(
            &mut (),
            &mut |state| {
                states.push(state);
                Ok(())
            },
        )?;
        let free =
            states.iter().find(|state| state.point == Some(1)).map_or(0.0, |it| it.value(Quantity::RelativeArea));
        let totals = AdhesionTotals::new(&states).ok_or("the states have adhesion")?;
        println!(
            "{:>5} mJ/m2 {:>11.3} {:>19.4} {:>10.2} Pa {:>16.2} Pa {:>16.2} Pa",
            millijoules,
            scales.pastewka_robbins,
            free,
            -totals.lowest_pressure.unwrap_or(f64::NAN),
            rigid,
            strength,
        );
    }
    Ok(())
}
