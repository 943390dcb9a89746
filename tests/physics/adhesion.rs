//! Adhesion against closed forms: Johnson's sine, JKR, Maugis, Baney and Hui.

use asperity::Grid;
use asperity::adhesion::{
    AdhesiveControl, AdhesiveMethod, AdhesiveOutcome, AdhesiveProblem, AdhesiveState, Attraction, AttractionForm,
};
use asperity::contact::{ContactModulus, Load, Problem, ResultClaim, Stop};
use asperity::surface::Indenter;
use std::f64::consts::PI;

const AMPLITUDE: f64 = 1.0;
const MODULUS: f64 = 1.0 / PI;

/// Johnson's sine with `E* = 1/pi`, so that `p_full = 1`: the work of adhesion has `alpha^2 = (2/pi) w/(D p_full)`.
fn sine(points: usize, alpha: f64, range: f64) -> AdhesiveProblem {
    let surface = Indenter::Sine { amplitude: AMPLITUDE }.surface(Grid::line(points, 1.0).unwrap()).unwrap();
    let problem = Problem::new(surface, ContactModulus(MODULUS), Load::MeanPressure(0.5)).unwrap();
    let attraction = Attraction::new(AttractionForm::Exponential, 0.5 * PI * alpha * alpha, range).unwrap();
    AdhesiveProblem::new(problem, attraction).unwrap()
}

fn state(problem: &AdhesiveProblem, control: AdhesiveControl, from: Option<&AdhesiveState>) -> AdhesiveState {
    match problem.solve(control, from, AdhesiveMethod::Fast, &Stop::default(), &mut ()).unwrap() {
        AdhesiveOutcome::State(state) => state,
        AdhesiveOutcome::Separated { .. } => panic!("separated at {control:?}"),
    }
}

#[test]
fn a_sine_follows_johnson() {
    for (points, range) in [(512, 0.1), (1024, 0.05), (4096, 0.03)] {
        let problem = sine(points, 0.2, range);
        let mut last: Option<AdhesiveState> = None;
        println!("{:?}", problem.scales());
        for gap in
            [0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.15, 1.2, 1.22, 1.24, 1.25, 1.26, 1.28, 1.3, 1.35, 1.4, 1.6]
        {
            let found = state(&problem, AdhesiveControl::MeanGap(gap), last.as_ref());
            println!(
                "{gap} {:.5} area {:.4} {} {} {:?} {:?} {:.1e} {}",
                found.mean_pressure,
                found.relative_area(),
                found.steps,
                found.method,
                found.claim,
                found.least_curvature,
                found.residual,
                found.work.transforms
            );
            last = Some(found);
        }
    }
}
