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
                    n.net_pressure,
                    state.contact.mean_gap(),
                    n.relative_area.unwrap(),
                    n.jump,
                    n.dissipated.unwrap(),
                    n.work_done.unwrap(),
                    n.stored.unwrap(),
                    state.claim,
                    state.work.transforms,
                    state.point
                );
                Ok(())
            })
            .unwrap();
    }
}

#[test]
fn explore_sphere() {
    use asperity::history::{AdhesiveProcess, PathPoint, Process};
    let (radius, work, modulus) = (1.0, 0.05, 10.0);
    let point = |load| PathPoint { time: None, load, tangential: None };
    for (points, lambda) in [(64, 0.5), (128, 0.5), (256, 0.5), (96, 1.0), (192, 1.0), (384, 1.0)] {
        let size = 6.0;
        let stiff = 4.0 / 3.0 * modulus;
        let sigma: f64 = lambda / 2.0 * (PI * work * stiff * stiff / radius).cbrt();
        let unit = (PI * work * radius * radius / stiff).cbrt();
        let grid = Grid::surface([points, points], [size * unit, size * unit]).unwrap().with_periodic([false; 2]);
        let surface = Indenter::Sphere { radius }.surface(grid).unwrap();
        let problem = Problem::new(surface, ContactModulus(modulus), Load::Force(1.0)).unwrap();
        let force = PI * work * radius;
        for form in [AttractionForm::Dugdale, AttractionForm::Exponential] {
            let attraction = Attraction::new(form.clone(), work, work / sigma).unwrap();
            let problem = AdhesiveProblem::new(problem.clone(), attraction).unwrap();
            let path =
                vec![point(Load::Force(0.0)), point(Load::Force(-1.4 * force)), point(Load::Force(-2.0 * force))];
            let mut process = AdhesiveProcess::new(problem.clone(), path, 10, AdhesiveMethod::Fast, Stop::default());
            let mut first = None;
            let mut last = 0.0;
            let start = std::time::Instant::now();
            let (mut t, mut count) = (0, 0);
            process
                .run(&mut (), &mut |state| {
                    let a = (state.numbers.relative_area.unwrap() / PI).sqrt() * size;
                    first.get_or_insert(a);
                    t += state.work.transforms;
                    count += 1;
                    if state.claim != ResultClaim::Separated {
                        last = state.numbers.net_pressure.unwrap() * size * size * unit * unit / force;
                    }
                    Ok(())
                })
                .unwrap();
            println!(
                "{points} {lambda} {form:?} a0 {first:?} pull-off {last:.5} T {t} states {count} {:?} spac {}",
                start.elapsed(),
                problem.scales().spacings
            );
        }
    }
}
