//! Adhesion of rough surfaces: both methods, many starts, and what sticks.

use asperity::adhesion::{
    AdhesiveControl, AdhesiveMethod, AdhesiveOutcome, AdhesiveProblem, AdhesiveState, Attraction, AttractionForm,
};
use asperity::contact::{ContactModulus, Each, Load, Problem, Quantity, ResultClaim, Stop};
use asperity::error::AdhesionError;
use asperity::history::{AdhesiveProcess, PathPoint, Process};
use asperity::surface::Spectrum;
use asperity::{Grid, Surface};
use std::f64::consts::PI;
use std::ops::ControlFlow;

/// A rough surface whose attraction has a process zone of 4.5 spacings.
fn rough(grid: Grid, seed: u64, work: f64, form: AttractionForm) -> AdhesiveProblem {
    let spacing = grid.spacing()[1];
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 16.0 * spacing, rms_gradient: 0.1 };
    let surface = Surface::rough(grid, &spectrum, seed).unwrap();
    let problem = Problem::new(surface, ContactModulus(1.0), Load::MeanPressure(0.01)).unwrap();
    let attraction = Attraction::new(form, work, (PI * work * 4.5 * spacing).sqrt()).unwrap();
    AdhesiveProblem::new(problem, attraction).unwrap()
}

fn solve(
    problem: &AdhesiveProblem,
    control: AdhesiveControl,
    from: Option<&AdhesiveState>,
    method: AdhesiveMethod,
) -> AdhesiveState {
    let stop = Stop::new(1e-10, 100_000).unwrap();
    match problem.solve(control, from, method, &stop, &mut ()).unwrap() {
        AdhesiveOutcome::State(state) => state,
        AdhesiveOutcome::Separated { .. } => panic!("separated at {control:?}"),
    }
}

/// Equilibrium by the definitions, with the pressures that a state gives: the displacement of `p_c - sigma` is `g + h - d`.
fn check(problem: &AdhesiveProblem, state: &AdhesiveState) {
    let values = |field: &asperity::surface::Field| field.iter().copied().collect::<Vec<f64>>();
    let [p, sigma, g, h] =
        [&state.contact.pressure, &state.traction, &state.contact.gap, problem.problem().surface().height()]
            .map(values);
    let net: Vec<f64> = p.iter().zip(&sigma).map(|(p, sigma)| p - sigma).collect();
    let mut u = vec![0.0; net.len()];
    problem.problem().response().displacement(&net, &mut u);
    let scale = h.iter().fold(0.0f64, |most, h| most.max(h.abs()));
    let mut worst: f64 = 0.0;
    for i in 0..g.len() {
        assert!(g[i] >= 0.0 && p[i] >= 0.0 && p[i] * g[i] == 0.0);
        assert!((sigma[i] - problem.attraction().traction(g[i])).abs() <= 1e-12 * problem.attraction().strength());
        worst = worst.max((u[i] - (g[i] + h[i] - state.datum)).abs());
    }
    assert!(worst < 1e-5 * scale, "{worst:e} of {scale:e}, {} {:?} {:?}", state.method, state.control, state.claim);
}

/// Thirty rough contacts: both methods find states in equilibrium; they are the same, or both are stable.
#[test]
fn the_fast_and_the_safe_method_agree_or_both_are_stable() {
    let forms = [AttractionForm::Exponential, AttractionForm::Cubic];
    let mut different = 0;
    for case in 0..30u64 {
        let grid = if case % 3 == 2 { Grid::surface([80, 80], [1.0; 2]) } else { Grid::line(512, 1.0) }.unwrap();
        let work = [3e-6, 3e-5, 2e-4][(case % 3) as usize] * if grid.is_line() { 4.0 } else { 1.0 };
        let problem = rough(grid, case, work, forms[(case / 3 % 2) as usize]);
        let highest = problem.problem().highest();
        let control = AdhesiveControl::MeanGap(highest * [0.9, 0.6, 0.3][(case / 6 % 3) as usize]);
        let [fast, safe] =
            [AdhesiveMethod::Fast, AdhesiveMethod::Safe].map(|method| solve(&problem, control, None, method));
        for found in [&fast, &safe] {
            check(&problem, found);
            assert!(
                matches!(found.claim, ResultClaim::Stable | ResultClaim::Marginal),
                "case {case}: {:?}",
                found.claim
            );
        }
        assert!(fast.method == "newton" && safe.method == "safe" && fast.residual <= 1e-10 && safe.residual < 1e-6);
        let apart = (&fast.contact.gap - &safe.contact.gap).iter().fold(0.0f64, |most, it| most.max(it.abs()));
        different += usize::from(apart > 1e-6 * highest);
    }
    println!("{different} of 30 differ");
    assert!(different <= 6, "{different} of 30 differ");
}

/// A state that is claimed as the solution is the only one: starts from far away lead to it.
#[test]
fn a_claimed_solution_is_found_from_everywhere() {
    let surface = Surface::rough(
        Grid::line(512, 1.0).unwrap(),
        &Spectrum { hurst: 0.8, rolloff_wavelength: 0.5, short_cutoff: 0.05, rms_gradient: 0.1 },
        3,
    );
    let problem = Problem::new(surface.unwrap(), ContactModulus(1.0), Load::MeanPressure(0.01)).unwrap();
    let height = problem.highest();
    // less steep than the softest wave is stiff: w/rho^2 < pi E*/L
    let weak =
        |factor: f64| Attraction::new(AttractionForm::Exponential, factor * PI * height * height, height).unwrap();
    let mut claims = Vec::new();
    for factor in [0.5, 0.9, 1.2] {
        let problem = AdhesiveProblem::new(problem.clone(), weak(factor)).unwrap();
        let goal = AdhesiveControl::MeanGap(0.5 * height);
        let found = solve(&problem, goal, None, AdhesiveMethod::Fast);
        claims.push(found.claim);
        for gap in [0.02, 0.2, 3.0, 10.0] {
            let far = solve(&problem, AdhesiveControl::MeanGap(gap * height), None, AdhesiveMethod::Fast);
            let again = solve(&problem, goal, Some(&far), AdhesiveMethod::Fast);
            let apart = (&found.contact.gap - &again.contact.gap).iter().fold(0.0f64, |most, it| most.max(it.abs()));
            assert!(found.claim != ResultClaim::Solution || apart < 1e-6 * height, "{apart:e}");
        }
        // under a load no state is the only one
        assert_ne!(
            solve(&problem, AdhesiveControl::MeanPressure(0.01), None, AdhesiveMethod::Fast).claim,
            ResultClaim::Solution
        );
    }
    assert_eq!(claims[..2], [ResultClaim::Solution; 2]);
    assert_ne!(claims[2], ResultClaim::Solution);
}

/// Pastewka and Robbins (2014): well below 1 their number foretells a surface that keeps a contact without load, well above 1 one that
/// hardly keeps any.
#[test]
fn rough_surfaces_stick_on_one_side_of_the_number_of_pastewka_and_robbins() {
    let grid = Grid::line(2048, 1.0).unwrap();
    for seed in 1..=3 {
        let pull = |work: f64| {
            let problem = rough(grid, seed, work, AttractionForm::Exponential);
            let path = [0.005, 0.0].map(|p| PathPoint { time: None, load: Load::MeanPressure(p), tangential: None });
            let mut states = Vec::new();
            let mut process =
                AdhesiveProcess::new(problem.clone(), path.into(), 10, AdhesiveMethod::Fast, Stop::default());
            let told = process.run(&mut (), &mut |state| {
                states.push(state);
                Ok(())
            });
            told.unwrap();
            // on the way back, without a load
            let unloaded = states.iter().find(|it| it.value(Quantity::MeanPressure) <= 0.0).unwrap();
            [problem.scales().pastewka_robbins, unloaded.value(Quantity::RelativeArea)]
        };
        let [not, sticky] = [1e-6, 6e-5].map(pull);
        assert!(not[0] > 2.0 && sticky[0] < 0.5);
        assert!(not[1] < 0.02 && sticky[1] > 0.5, "seed {seed}: {not:?} {sticky:?}");
    }
}

#[test]
fn what_cannot_be_posed_is_refused_and_an_observer_stops_a_search() {
    let problem = rough(Grid::line(512, 1.0).unwrap(), 1, 1e-5, AttractionForm::Exponential);
    let wall = problem.problem().clone();
    let too_short = Attraction::new(AttractionForm::Exponential, 1e-5, 1e-6).unwrap();
    assert!(matches!(AdhesiveProblem::new(wall.clone(), too_short), Err(AdhesionError::Coarse { .. })));
    let attraction = problem.attraction().clone();
    let hard = wall.clone().with_law(asperity::contact::Law::Hardness(1.0)).unwrap();
    assert!(matches!(AdhesiveProblem::new(hard, attraction), Err(AdhesionError::NotElastic { .. })));
    let refused = |control| problem.solve(control, None, AdhesiveMethod::Fast, &Stop::default(), &mut ()).unwrap_err();
    assert!(matches!(refused(AdhesiveControl::MeanGap(0.0)), AdhesionError::MeanGap { .. }));
    assert!(matches!(refused(AdhesiveControl::MeanPressure(f64::NAN)), AdhesionError::NotFinite { .. }));
    assert!(matches!(refused(AdhesiveControl::Approach(0.1)), AdhesionError::Control { .. }));
    for method in [AdhesiveMethod::Fast, AdhesiveMethod::Safe] {
        let mut seen = 0;
        let mut watch = Each(|_: &asperity::contact::Step<'_>| {
            seen += 1;
            if seen == 4 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        let control = AdhesiveControl::MeanPressure(0.01);
        let stopped = problem.solve(control, None, method, &Stop::default(), &mut watch);
        assert!(matches!(stopped, Err(AdhesionError::Stopped)) && seen == 4);
    }
}

/// Transforms of the states of a schedule of twenty, and of one state alone.
#[test]
fn cost_of_states_on_a_schedule() {
    for (grid, work, most) in
        [(Grid::line(1 << 14, 1.0).unwrap(), 4e-6, 700.0), (Grid::surface([256; 2], [1.0; 2]).unwrap(), 1e-4, 700.0)]
    {
        let problem = rough(grid, 1, work, AttractionForm::Exponential);
        let highest = problem.problem().highest();
        let mut last: Option<AdhesiveState> = None;
        let mut transforms = Vec::new();
        for step in 0..20 {
            let control = AdhesiveControl::MeanGap(highest * (1.1 - 0.045 * step as f64));
            let stop = Stop::default();
            let found = match problem.solve(control, last.as_ref(), AdhesiveMethod::Fast, &stop, &mut ()).unwrap() {
                AdhesiveOutcome::State(state) => state,
                AdhesiveOutcome::Separated { .. } => panic!("a mean gap holds the surfaces"),
            };
            transforms.push(found.work.transforms as f64);
            last = Some(found);
        }
        let mean = transforms.iter().sum::<f64>() / 20.0;
        println!("{:?}: mean {mean}, {transforms:?}", grid.shape());
        assert!(mean < most, "{mean}: {transforms:?}");
    }
}
