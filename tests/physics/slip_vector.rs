//! Partial slip of surfaces with tractions along both axes.

use asperity::contact::{ContactModulus, Load, Multilevel, Problem, Stop};
use asperity::history::{SlipHistory, SlipState};
use asperity::surface::{Field, Indenter, Spectrum};
use asperity::{Grid, Surface};

fn stop(tolerance: f64) -> Stop {
    Stop::new(tolerance, 100_000).unwrap()
}

/// The ratio `m` of two equal bodies of Poisson's ratio 0.42.
const M: f64 = 0.42 / 0.58;

/// The sphere on two equal bodies of the CONTACT example `cattaneo`: shear modulus 200, Poisson's ratio 0.42, radius 50, force 9.1954,
/// friction 0.4, pulled by 0.875 of the sliding load.
fn sphere(points: usize) -> (Problem, Load, f64) {
    const SIZE: f64 = 2.5333;
    let grid = Grid::surface([points; 2], [SIZE; 2]).unwrap().with_periodic([false; 2]);
    let load = Load::Force(9.1954);
    let surface = Indenter::Sphere { radius: 50.0 }.surface(grid).unwrap();
    (Problem::new(surface, ContactModulus(200.0 / 0.58), load).unwrap(), load, SIZE * SIZE)
}

#[test]
fn the_sphere_of_contact_has_its_printed_figures_to_a_thousandth() {
    let (problem, load, area) = sphere(19);
    let mut history = SlipHistory::sheared(problem, 0.4, M, &Multilevel, stop(1e-12)).unwrap();
    let state = history.step(load, 0.875 * 0.4 * 9.1954, &mut ()).unwrap();
    println!(
        "{:?} {:?} {:?} shift {:e} work {:e}",
        state.contact.status,
        state.certificate,
        state.work,
        state.shift,
        state.dissipated * area
    );
    let near = |found: f64, printed: f64| assert!((found / printed - 1.0).abs() < 1e-3, "{found} against {printed}");
    near(state.contact.max_pressure(), 4.393);
    near(state.contact.approach().unwrap(), 0.01998);
    assert_eq!(state.contact.mask().iter().filter(|it| **it).count(), 177);
    assert_eq!(state.sticks().iter().filter(|it| **it).count(), 45);
    near(state.shift, 8.155e-3);
    near(state.dissipated * area, 2.750e-3);
}

fn rough(shape: [usize; 2], hurst: f64, seed: u64) -> Surface {
    let spectrum = Spectrum { hurst, rolloff_wavelength: 0.25, short_cutoff: 4.0 / shape[0] as f64, rms_gradient: 0.1 };
    Surface::rough(Grid::surface(shape, [1.0, 1.0]).unwrap(), &spectrum, seed).unwrap()
}

#[test]
#[ignore = "a measurement"]
fn cost_of_rough_surfaces() {
    for n in [128, 256, 512] {
        let load = Load::ReducedPressure(0.05);
        let problem = Problem::new(rough([n, n], 0.8, 1), ContactModulus(1.0), load).unwrap();
        let alone = asperity::contact::Solver::solve(&Multilevel, &problem, &stop(1e-8), &mut ()).unwrap();
        println!(
            "{n} normal {:?} area {}",
            alone.work,
            alone.mask().iter().filter(|it| **it).count() as f64 / (n * n) as f64
        );
        for m in [0.0, 0.5] {
            let mut history = SlipHistory::sheared(problem.clone(), 0.3, m, &Multilevel, stop(1e-8)).unwrap();
            for share in [0.3, 0.8, -0.5] {
                let state = history.step(load, share * 0.3 * 0.05, &mut ()).unwrap();
                println!(
                    "{n} m {m} share {share} {:?} eta {:e} stick {} work {:?}",
                    state.contact.status,
                    state.certificate.eta,
                    state.stick_share(),
                    state.work
                );
            }
        }
    }
}
