//! Contacts of viscoelastic solids in time.

use asperity::contact::{Contact, ContactModulus, Load, Multilevel, PolonskyKeer, Solver, Stop};
use asperity::elastic::{Prony, PronyTerm};
use asperity::history::{Creep, CreepPath, CreepState, CreepSteps};
use asperity::surface::{Field, Spectrum};
use asperity::{Grid, Indenter, Problem, Surface};

fn rough(grid: Grid, hurst: f64, seed: u64) -> Surface {
    let [_, dx] = grid.spacing();
    let length = grid.size()[1];
    let short = (16.0 * dx).min(length / 16.0);
    let spectrum = Spectrum { hurst, rolloff_wavelength: length / 4.0, short_cutoff: short, rms_gradient: 0.01 };
    Surface::rough(grid, &spectrum, seed).unwrap()
}

#[test]
fn measure() {
    let (line, surface) = (Grid::line(1 << 14, 1.0).unwrap(), Grid::surface([512, 512], [1.0, 1.0]).unwrap());
    let prony = Prony::new(vec![PronyTerm { ratio: 9.0, time: 1.0 }]).unwrap();
    for grid in [line, surface] {
        for tol in [1e-8, 1e-10] {
            for ramp in [false, true] {
                let problem =
                    Problem::new(rough(grid, 0.8, 3), ContactModulus(1.0), Load::ReducedPressure(0.02)).unwrap();
                let stop = Stop::new(tol, 100000).unwrap();
                let mut creep = Creep::new(problem.clone(), prony.clone());
                let (mut state, mut warm, mut cold) = (creep.start(), vec![], vec![]);
                for i in 0..10 {
                    let load = Load::ReducedPressure(if ramp { 0.02 * (1.0 + 0.1 * i as f64) } else { 0.02 });
                    state =
                        creep.step(&state, if i == 0 { 0.0 } else { 0.05 }, load, &Multilevel, &stop, &mut ()).unwrap();
                    warm.push(state.contact.work.transforms);
                    let el = Multilevel
                        .solve(
                            &problem
                                .clone()
                                .with_load(Load::MeanPressure(state.effective_pressure().mean().unwrap()))
                                .unwrap(),
                            &stop,
                            &mut (),
                        )
                        .unwrap();
                    cold.push(el.work.transforms);
                }
                println!(
                    "{:?} tol {tol} ramp {ramp} warm {warm:?} cold {cold:?} bound {} eta {}",
                    grid.shape(),
                    state.error_bound(),
                    state.contact.certificate.eta
                );
            }
        }
    }
}
