//! A ball is pressed on steel and taken off again: the steel yields below the surface first, and keeps an imprint.
//!
//! `cargo run --release --example imprint`

use asperity::contact::{ContactModulus, Load, PolonskyKeer};
use asperity::elastic::DepthLayers;
use asperity::history::{Plastic, PlasticLoading, PlasticSolid, Process};
use asperity::{Grid, Indenter, Problem};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (radius, length, points) = (10e-3, 1e-3, 96);
    let steel = PlasticSolid::new(210e9, 0.3, 350e6, 2e9)?;
    let ball = Indenter::Sphere { radius }.surface(Grid::surface([points; 2], [length; 2])?)?;
    let problem = Problem::new(ball, ContactModulus(steel.contact_modulus()), Load::Force(1.0))?;
    let layers = DepthLayers::below(length / points as f64, 0.6e-3)?;

    // Hertz: yield begins where the largest pressure is 1.61 Y
    let (highest, modulus) = (1.6128 * steel.yield_stress(), steel.contact_modulus());
    let onset = std::f64::consts::PI.powi(3) * radius.powi(2) * highest.powi(3) / (6.0 * modulus.powi(2));
    println!("yield begins at {onset:.2} N\n");

    let plastic = Plastic::new(problem, steel, layers, &PolonskyKeer)?;
    let loads = [1.0, 4.0, 16.0, 64.0, 16.0, 1.0, 0.0].map(Load::Force);
    let mut loading = PlasticLoading::new(plastic, loads.into(), 2)?;
    println!(" F, N    area  <p_c>/Y  max alpha  deepest yield, um  plastic volume, um  imprint, um  relative gap");
    while let Some(state) = loading.next(&mut ()) {
        if state?.point.is_none() {
            continue;
        }
        let state = loading.plastic().state();
        assert!(state.is_converged && !state.reaches_the_bottom());
        println!(
            "{:>5} {:>7.4} {:>8.3} {:>10.5} {:>18.1} {:>19.3} {:>12.4} {:>13.1e}",
            state.load.map_or(0.0, |load| load.value()),
            state.relative_area(),
            state.mean_contact_pressure() / steel.yield_stress(),
            state.max_accumulated(),
            1e6 * state.deepest_yield().unwrap_or(0.0),
            1e6 * state.plastic_volume(),
            1e6 * state.imprint_depth(),
            state.certificate.relative_gap,
        );
    }
    let energy = loading.plastic().state().energy;
    println!(
        "\nof the work, {:.1} % made the imprint, and {:.1} % is stored by the residual stress;",
        100.0 * energy.plastic / energy.work,
        100.0 * energy.elastic / energy.work
    );
    println!(
        "the rest, {:.1} %, is the error of the finite steps",
        100.0 * (1.0 - (energy.plastic + energy.elastic) / energy.work)
    );
    Ok(())
}
