//! A soft body under a rough one: what yields stays, so that the way back is another one.
//!
//! cargo run --release --example hardness

use asperity::contact::{Law, Load};
use asperity::error::SetupError;
use asperity::job::HistoryOutcome;
use asperity::setup::{Cell, Recipe, Setup};
use asperity::surface::Spectrum;

fn main() -> Result<(), SetupError> {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 1.0 / 64.0, rms_gradient: 0.1 };
    let loads = [1e-3, 1e-2, 3e-2, 0.1, 0.2].map(Load::ReducedPressure);
    let wall = Setup::new(Recipe::rough(spectrum, 1), Cell::line(4096, 1.0), loads[0]);
    // the softer body yields at 5 % of the contact modulus
    let setup = Setup { law: Law::Hardness(0.05), ..wall };
    let setup = setup.under_loads(loads.into()).unloaded();

    println!("{:>12} {:>10} {:>10} {:>12} {:>12}", "<p> / E*", "area", "yields", "of the load", "overlap");
    let outcome = HistoryOutcome::solve(&setup, &setup.problem()?, &mut ())?;
    for contact in outcome.states.iter().map(|state| &state.contact) {
        // on the way back the body is elastic, and what has yielded fits
        let plastic = contact.plasticity();
        println!(
            "{:>12.3e} {:>10.5} {:>10.5} {:>12.3} {:>12.3e}",
            contact.mean_pressure(),
            contact.resolved().relative_area,
            plastic.area,
            plastic.load_share,
            plastic.overlap
        );
    }
    Ok(())
}
