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

#[test]
fn explore_loop() {
    use asperity::history::{AdhesiveProcess, PathPoint, Process};
    let problem = sine(1024, 0.2, 0.05);
    let point = |load| PathPoint { time: None, load, tangential: None };
    for path in [
        vec![point(Load::MeanGap(1.6)), point(Load::MeanGap(0.4)), point(Load::MeanGap(1.6))],
        vec![point(Load::MeanPressure(0.0)), point(Load::MeanPressure(0.3)), point(Load::MeanPressure(-0.1))],
    ] {
        let mut process = AdhesiveProcess::new(problem.clone(), path, 20, AdhesiveMethod::Fast, Stop::default());
        process
            .run(&mut (), &mut |state| {
                let n = state.numbers;
                println!(
                    "p {:?} gap {:.5} area {:.4} jump {:?} lost {:.5} work {:.5} stored {:.5} {:?} T {} {:?}",
                    n.net_pressure, state.contact.mean_gap(), n.relative_area.unwrap(), n.jump, n.dissipated.unwrap(), n.work_done.unwrap(),
                    n.stored.unwrap(), state.claim, state.work.transforms, state.point
                );
                Ok(())
            })
            .unwrap();
    }
}

#[test]
fn explore_sphere() {
    let (radius, work, modulus) = (1.0, 0.05, 10.0);
    for (points, lambda, size) in [(64, 0.5, 3.0), (96, 1.0, 3.0)] {
        let stiff = 4.0 / 3.0 * modulus;
        let sigma: f64 = lambda / 2.0 * (PI * work * stiff * stiff / radius).cbrt();
        let unit = (PI * work * radius * radius / stiff).cbrt();
        let grid = Grid::surface([points, points], [size * unit * 2.0, size * unit * 2.0]).unwrap().with_periodic([false; 2]);
        let surface = Indenter::Sphere { radius }.surface(grid).unwrap();
        let area = grid.area();
        let problem = Problem::new(surface, ContactModulus(modulus), Load::Force(1.0)).unwrap();
        for form in [AttractionForm::Dugdale, AttractionForm::Exponential] {
        let attraction = Attraction::new(form, work, work / sigma).unwrap();
        let problem = AdhesiveProblem::new(problem.clone(), attraction).unwrap();
        println!("{:?}", problem.scales());
        let mut last: Option<AdhesiveState> = None;
        for f in [0.0, -0.5, -1.0, -1.3, -1.4, -1.5, -1.55, -1.6, -1.65, -1.7, -1.75, -1.8] {
            let control = AdhesiveControl::MeanPressure(f * PI * work * radius / area);
            let start = std::time::Instant::now();
            match problem.solve(control, last.as_ref(), AdhesiveMethod::Fast, &Stop::default(), &mut ()) {
                Ok(AdhesiveOutcome::State(found)) => {
                    let a = (found.relative_area() * area / PI).sqrt() / unit;
                    println!("{f} a {a:.4} {} {} {:?} {:.1e} {} {:?}", found.steps, found.method, found.claim, found.residual, found.work.transforms, start.elapsed());
                    last = Some(found);
                }
                other => { println!("{f} {:?}", other.map(|_| "separated")); break; }
            }
        }
        }
    }
}
