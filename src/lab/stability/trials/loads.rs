//! Loads from a single node in contact to beyond full contact.

use super::shapes::{Grids, rough, setup};
use crate::contact::Load;
use crate::lab::stability::trial::Trial;
use crate::setup::Recipe;
use crate::surface::Indenter;
use crate::theory::{Westergaard, crossed_full_pressure};

const AMPLITUDE: f64 = 0.01;
/// Shares of the pressure of full contact.
const SHARES: [f64; 4] = [0.999, 0.9999, 1.0, 1.001];

pub fn trials(grids: Grids) -> Vec<Trial> {
    // reduced pressures from 1e-12 to 10 on a rough line and a rough surface
    let decades = grids.named().into_iter().flat_map(|(kind, grid)| {
        (-12..=1).map(move |decade| {
            let load = Load::ReducedPressure(10f64.powi(decade));
            Trial::of(format!("load-{kind}-1e{decade}"), setup(rough(grid), grid, load))
        })
    });
    let [sine, crossed] = [Indenter::Sine { amplitude: AMPLITUDE }, Indenter::CrossedSine { amplitude: AMPLITUDE }];
    let full = Westergaard { amplitude: AMPLITUDE, period: 1.0, contact_modulus: 1.0 }.full_pressure();
    let crossed_full = crossed_full_pressure(AMPLITUDE, [1.0, 1.0], 1.0);
    let waves = [("sine", sine, grids.line, full), ("crossed-sine", crossed, grids.surface, crossed_full)];
    let around_full = waves.into_iter().flat_map(|(name, indenter, grid, full)| {
        SHARES.map(|share| {
            let setup = setup(Recipe::indenter(indenter), grid, Load::MeanPressure(share * full));
            Trial::of(format!("{name}-{share}-of-full"), setup)
        })
    });
    decades.chain(around_full).collect()
}
