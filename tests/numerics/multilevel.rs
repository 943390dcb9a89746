//! The fast solver: on surfaces that break whole-set updates, on every grid, over the whole range of loads, and its work.

use crate::common::{relative_l2, solve, solvers};
use asperity::contact::{
    Contact, ContactModulus, Decision, Each, Law, Load, Multilevel, PolonskyKeer, Problem, Solver, Status, Step, Stop,
};
use asperity::elastic::{Base, Layer};
use asperity::surface::Spectrum;
use asperity::{Grid, Indenter, Surface};
use ndarray::{Array1, Array2};
use std::f64::consts::PI;
use std::ops::ControlFlow;

fn line(height: impl FnMut(usize) -> f64, points: usize) -> Surface {
    Surface::line(Array1::from_shape_fn(points, height).view(), 1.0).unwrap()
}

/// Uncorrelated heights in (-1, 1): a hash of the node.
fn noise(node: usize) -> f64 {
    let hash = (node as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let hash = (hash ^ (hash >> 31)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    (hash >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

fn rough(grid: Grid, hurst: f64, reduced_pressure: f64) -> Problem {
    let (waves, band) = if grid.is_line() { (8.0, 512.0) } else { (4.0, 64.0) };
    let spectrum = Spectrum {
        hurst,
        rolloff_wavelength: 1.0 / waves,
        short_cutoff: (1.0 / (waves * band)).max(4.0 * grid.shortest_wavelength()),
        rms_gradient: 1e-3,
    };
    let surface = Surface::rough(grid, &spectrum, 1).unwrap();
    Problem::new(surface, ContactModulus(1.0), Load::ReducedPressure(reduced_pressure)).unwrap()
}

fn assert_exact(name: &str, problem: &Problem) -> Contact {
    let fast = solve(&Multilevel, problem, 1e-12);
    let slow = solve(&PolonskyKeer, problem, 1e-12);
    let difference = relative_l2(&fast.pressure, &slow.pressure);
    assert!(difference < 1e-6, "{name}: {difference}");
    fast
}

#[test]
fn sines_parabolas_combs_spikes_and_noise_do_not_trap_it() {
    let sine = |points: usize| Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(points, 1.0).unwrap()).unwrap();
    for area in [0.01, 0.1, 0.5, 0.9, 0.99] {
        for points in [512, 61, 255] {
            let load = 0.01 * PI * (0.5 * PI * area).sin().powi(2);
            assert_exact(
                &format!("sine of {area}"),
                &Problem::new(sine(points), ContactModulus(1.0), Load::MeanPressure(load)).unwrap(),
            );
        }
    }
    let parabola = Indenter::Cylinder { radius: 0.25 }.surface(Grid::line(1024, 1.0).unwrap()).unwrap();
    let comb = line(|i| if i / 16 % 2 == 0 { 0.0 } else { -0.01 }, 1024);
    let spike = line(|i| if i == 513 { 1.0 } else { 0.0 }, 1024);
    let plateaus = line(|i| (i / 100) as f64 % 3.0, 1000);
    let white = line(noise, 1024);
    for (name, surface) in
        [("parabola", parabola), ("comb", comb), ("spike", spike), ("plateaus", plateaus), ("noise", white)]
    {
        for load in [1e-3, 0.05, 0.2, 1.0] {
            assert_exact(
                &format!("{name} at {load}"),
                &Problem::new(surface.clone(), ContactModulus(1.0), Load::MeanPressure(load)).unwrap(),
            );
        }
    }
}

#[test]
fn white_noise_on_a_surface_from_one_per_cent_to_full_contact() {
    let field = Array2::from_shape_fn((48, 64), |(i, j)| noise(64 * i + j));
    let surface = Surface::new(Grid::surface([48, 64], [1.0, 1.0]).unwrap(), field).unwrap();
    let areas = [0.01, 1.0, 20.0, 100.0].map(|load| {
        let problem = Problem::new(surface.clone(), ContactModulus(1.0), Load::MeanPressure(load)).unwrap();
        assert_exact("noise", &problem).counted().relative_area
    });
    assert!(areas[0] < 0.03 && areas[3] == 1.0 && areas.is_sorted(), "{areas:?}");
}

#[test]
fn grids_that_cannot_be_halved_need_no_coarser_ones() {
    let grids = [
        Grid::line(4097, 1.0),
        Grid::line(3 * 512, 1.0),
        Grid::surface([61, 128], [1.0, 1.0]),
        Grid::surface([96, 160], [1.0, 2.0]),
    ];
    for grid in grids {
        for reduced_pressure in [0.01, 0.1] {
            assert_exact("rough", &rough(grid.clone().unwrap(), 0.5, reduced_pressure));
        }
    }
}

#[test]
fn the_area_rises_with_the_load_from_first_touch_to_beyond_full_contact() {
    let mut before = 0.0;
    for reduced_pressure in [1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.3, 1.0, 2.0, 4.0] {
        let problem = rough(Grid::line(1 << 12, 1.0).unwrap(), 0.8, reduced_pressure);
        let area = solve(&Multilevel, &problem, 1e-9).counted().relative_area;
        assert!(area >= before, "{area} after {before} at {reduced_pressure}");
        before = area;
    }
    assert_eq!(before, 1.0);
}

/// From a light touch to beyond full contact and back, each load from the contact of the last: the area rises and falls, and the
/// way back finds the contacts of the way up.
#[test]
fn a_load_ramp_is_followed_up_and_down() {
    for grid in [Grid::line(1 << 12, 1.0).unwrap(), Grid::surface([128, 96], [1.0, 1.0]).unwrap()] {
        let mut problem = rough(grid, 0.8, 1e-4);
        let unit = problem.rms_gradient() * problem.contact_modulus();
        let loads: Vec<f64> = (0..=16).map(|i| 1e-4 * 2f64.powi(i) * unit).collect();
        let mut contacts: Vec<Contact> = Vec::new();
        for &load in loads.iter().chain(loads.iter().rev().skip(1)) {
            problem = problem.with_load(Load::MeanPressure(load)).unwrap();
            let start = contacts.last().map(|contact| &contact.pressure);
            contacts.push(
                Multilevel
                    .solve_from(start, &problem, &Stop::new(1e-10, 1000).unwrap(), &mut ())
                    .unwrap()
                    .converged()
                    .unwrap(),
            );
        }
        let areas: Vec<f64> = contacts.iter().map(|contact| contact.counted().relative_area).collect();
        assert!(areas[..17].is_sorted() && areas[16..].iter().rev().is_sorted() && areas[16] == 1.0, "{areas:?}");
        for (up, down) in contacts.iter().zip(contacts.iter().rev()) {
            assert!(relative_l2(&up.pressure, &down.pressure) < 1e-4);
        }
    }
}

/// A start changes the way, not the result, whatever it holds.
#[test]
fn any_start_leads_to_the_same_contact() {
    let problem = rough(Grid::line(1 << 10, 1.0).unwrap(), 0.5, 0.05);
    let nodes = problem.surface().grid().shape();
    let starts = [
        Array2::from_shape_fn(nodes, |(_, i)| noise(i)),
        Array2::from_elem(nodes, f64::NAN),
        Array2::from_shape_fn(nodes, |(_, i)| if i == 7 { 1e300 } else { f64::NEG_INFINITY }),
        Array2::zeros(nodes),
    ];
    for solver in solvers() {
        let expected = solve(solver.as_ref(), &problem, 1e-10);
        for start in &starts {
            let found = solver
                .solve_from(Some(start), &problem, &Stop::new(1e-10, 100_000).unwrap(), &mut ())
                .unwrap()
                .converged()
                .unwrap();
            assert!(relative_l2(&found.pressure, &expected.pressure) < 1e-4, "{}", solver.name());
        }
    }
    for solver in [&PolonskyKeer as &dyn Solver, &Multilevel] {
        let solution = solve(solver, &problem, 1e-10).pressure;
        let again = solver
            .solve_from(Some(&solution), &problem, &Stop::new(1e-9, 10).unwrap(), &mut ())
            .unwrap()
            .converged()
            .unwrap();
        assert_eq!(again.work.iterations, 0, "{}: a solution is a good start", solver.name());
    }
}

/// Every step is shown: coarse grids first, on each the outer steps with their certificate and the inner ones between them.
#[test]
fn all_levels_and_inner_steps_are_shown() {
    let problem = rough(Grid::surface([128, 128], [1.0, 1.0]).unwrap(), 0.8, 0.05);
    let mut seen = Vec::new();
    let mut watch = Each(|step: &Step<'_>| {
        let nodes = step.problem().surface().grid().len();
        assert_eq!(nodes, (128 * 128) >> (2 * step.phase().level));
        assert!(step.pressure().len() == nodes && step.gap().len() == nodes);
        let pressure = step.pressure().iter().sum::<f64>() / nodes as f64;
        assert!((pressure / step.problem().expected_mean_pressure() - 1.0).abs() < 1e-12);
        assert_eq!(step.certificate().is_none(), step.phase().inner > 0);
        assert_eq!(step.index(), seen.len());
        seen.push((step.phase(), step.transforms()));
        ControlFlow::Continue(())
    });
    let shown = Multilevel.solve(&problem, &Stop::default(), &mut watch).unwrap().converged().unwrap();
    assert_eq!((seen[0].0.level, seen[0].0.outer), (2, 0));
    assert!(seen.windows(2).all(|pair| pair[0].0.level >= pair[1].0.level && pair[0].1 <= pair[1].1));
    assert!((0..=2).all(|level| seen.iter().any(|(phase, _)| phase.level == level && phase.inner > 0)));
    let unseen = Multilevel.solve(&problem, &Stop::default(), &mut ()).unwrap().converged().unwrap();
    assert_eq!((shown.work.transforms, &shown.pressure), (unseen.work.transforms, &unseen.pressure));
}

/// An observer may end the run at any step; what it gets is feasible.
#[test]
fn it_stops_on_any_level_when_told_to() {
    let problem = rough(Grid::line(1 << 9, 1.0).unwrap(), 0.8, 0.05);
    let steps = solve(&Multilevel, &problem, 1e-8).work.iterations;
    for last in 0..steps {
        let mut watch = Each(
            |step: &Step<'_>| {
                if step.index() == last { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            },
        );
        let contact = Multilevel.solve(&problem, &Stop::default(), &mut watch).unwrap();
        assert_eq!((contact.status, contact.work.iterations), (Status::StoppedByObserver, last));
        assert!(contact.certificate.load_error < 1e-12 && contact.certificate.min_pressure >= 0.0);
    }
}

/// Transforms of the finest grid to a certificate of 1e-8; the table is printed with `-- --nocapture`.
#[test]
fn its_work_stays_low() {
    let smooth = |indenter: Indenter, grid: Grid, load: f64| {
        Problem::new(indenter.surface(grid).unwrap(), ContactModulus(1.0), Load::MeanPressure(load))
    };
    let long = Grid::line(1 << 16, 1.0).unwrap();
    let wide = Grid::surface([256, 256], [1.0, 1.0]).unwrap();
    let cases = [
        ("cylinder, 2^16", smooth(Indenter::Cylinder { radius: 0.25 }, long, 0.01).unwrap(), 60),
        ("sine, 2^16", smooth(Indenter::Sine { amplitude: 0.01 }, long, 0.01).unwrap(), 80),
        ("sphere, 256^2", smooth(Indenter::Sphere { radius: 0.25 }, wide, 0.01).unwrap(), 100),
        ("rough line 2^16, H = 0.8, p* = 0.01", rough(long, 0.8, 0.01), 180),
        ("rough line 2^16, H = 0.2, p* = 0.01", rough(long, 0.2, 0.01), 220),
        ("rough surface 256^2, H = 0.8, p* = 0.1", rough(wide, 0.8, 0.1), 140),
        ("rough surface 256^2, H = 0.2, p* = 0.01", rough(wide, 0.2, 0.01), 140),
    ];
    for (name, problem, most) in cases {
        let work = solve(&Multilevel, &problem, 1e-8).work;
        println!("{name:<40} {:>3} steps {:>5} transforms", work.iterations, work.transforms);
        assert!(work.transforms <= most, "{name}: {work:?}");
    }
}

/// Rough contacts of thin bonded layers, compressible and not, under a pressure and to an approach.
fn films(grid: Grid) -> Vec<Problem> {
    let mut problems = Vec::new();
    for (thickness, poisson) in [(0.002, 0.5), (0.002, 0.45), (0.01, 0.49), (0.025, 0.5)] {
        for hurst in [0.2, 0.8] {
            let surface = rough(grid, hurst, 0.1).surface().clone();
            let layer = Layer { contact_modulus: 1.0, poisson, thickness, base: Base::Bonded };
            let problem = Problem::new(surface, layer, Load::ReducedPressure(0.1)).unwrap();
            let approach = Load::Approach(0.3 * problem.highest());
            problems.extend([problem.clone(), problem.with_load(approach).unwrap()]);
        }
    }
    problems
}

#[test]
fn thin_layers_take_little_work() {
    let [line, surface] = [Grid::line(1 << 12, 1.0), Grid::surface([128, 128], [1.0, 1.0])].map(Result::unwrap);
    for problem in [line, surface].into_iter().flat_map(films) {
        let transforms = solve(&Multilevel, &problem, 1e-8).work.transforms;
        println!("{} {:?}: {transforms}", problem.compliance().solid().description(), problem.load());
        assert!(transforms <= 180, "{transforms}");
    }
}

/// Inner iterations show their candidates, among which all contact is; outer steps and lines have none.
#[test]
fn candidates_contain_the_contact() {
    let surface = rough(Grid::surface([64, 64], [1.0, 1.0]).unwrap(), 0.8, 0.05);
    let line = rough(Grid::line(1 << 12, 1.0).unwrap(), 0.8, 0.05);
    let mut shown = [0, 0];
    for (problem, shown) in [&surface, &line].into_iter().zip(&mut shown) {
        let mut watch = Each(|step: &Step<'_>| {
            let Some(candidates) = step.candidates() else { return ControlFlow::Continue(()) };
            let inside = candidates.iter().filter(|it| **it == 1.0).count();
            assert!(step.phase().inner > 0 && (inside < candidates.len() || step.phase().level > 0));
            assert_eq!(inside, candidates.iter().filter(|it| **it != 0.0).count());
            assert!(step.pressure().iter().zip(candidates).all(|(p, it)| *p == 0.0 || *it == 1.0));
            *shown += 1;
            ControlFlow::Continue(())
        });
        Multilevel.solve(problem, &Stop::default(), &mut watch).unwrap().converged().unwrap();
    }
    assert!(shown[0] > 10 && shown[1] == 0, "{shown:?}");
}

/// Nodes at the edges of patches that yield do not exchange for ever.
#[test]
fn a_hardness_takes_little_work() {
    let line = Grid::line(1 << 14, 1.0).unwrap();
    for hurst in [0.2, 0.5, 0.8] {
        for reduced_pressure in [0.01, 0.1] {
            let elastic = rough(line, hurst, reduced_pressure);
            for ratio in [1.25, 2.0, 4.0] {
                let law = Law::Hardness(ratio * elastic.mean_pressure().unwrap());
                let transforms = solve(&Multilevel, &elastic.clone().with_law(law).unwrap(), 1e-8).work.transforms;
                println!("H {hurst}, p* {reduced_pressure}, H_c {ratio} times the mean pressure: {transforms}");
                assert!(transforms <= 300, "{transforms}");
            }
        }
    }
}

/// Small contacts of a half-space without and with images, on which the compliance is split, and larger ones.
fn sets_of_every_size() -> Vec<Problem> {
    let grid = |is_periodic| Grid::surface([256, 256], [1.0, 1.0]).unwrap().with_periodic([is_periodic; 2]);
    [true, false].into_iter().flat_map(|it| [2e-3, 0.1].map(|load| rough(grid(it), 0.8, load))).collect()
}

/// The conjugate gradients of the other solver are in double precision and know no candidates.
#[test]
fn cheap_displacements_lead_to_the_same_contact() {
    for problem in sets_of_every_size() {
        let [first, second] = [solve(&Multilevel, &problem, 1e-12), solve(&PolonskyKeer, &problem, 1e-12)];
        let difference = relative_l2(&first.pressure, &second.pressure);
        assert!(difference < 1e-5, "{difference} with {:?}", problem.load());
        assert_eq!(first.mask(), second.mask(), "{:?}", problem.load());
    }
}

/// A transform of the whole grid is what a small contact needs few of.
#[test]
fn small_contacts_need_few_transforms_of_the_whole_grid() {
    for small in sets_of_every_size().iter().step_by(2) {
        let transforms = solve(&Multilevel, small, 1e-8).work.transforms;
        assert!(transforms <= 40, "{transforms}");
    }
}

#[test]
fn contacts_are_the_same_on_any_number_of_threads() {
    let film = films(Grid::surface([128, 128], [1.0, 1.0]).unwrap()).swap_remove(0);
    for problem in sets_of_every_size().into_iter().chain([film]) {
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| solve(&Multilevel, &problem, 1e-8))
        };
        let one = on(1);
        for threads in [2, 3, 8] {
            let many = on(threads);
            assert!(many.pressure == one.pressure && many.gap == one.gap, "{threads} threads, {:?}", problem.load());
            assert_eq!(many.work.transforms, one.work.transforms);
        }
    }
}

/// On a half-space, the outer steps on the finest grid, each of which takes two transforms in double precision, are few at any load.
/// Each says how its sets were updated.
#[test]
fn few_steps_are_exact_and_each_says_how_it_was_made() {
    for is_periodic in [true, false] {
        let grid = Grid::surface([256, 256], [1.0, 1.0]).unwrap().with_periodic([is_periodic; 2]);
        for load in [1e-4, 2e-3, 1e-2, 0.1, 0.4] {
            let mut decisions = Vec::new();
            let mut watch = Each(|step: &Step<'_>| {
                if step.phase().level == 0 && step.phase().inner == 0 {
                    decisions.extend(step.decision());
                }
                ControlFlow::Continue(())
            });
            let problem = rough(grid, 0.8, load);
            Multilevel.solve(&problem, &Stop::default(), &mut watch).unwrap().converged().unwrap();
            println!("periodic {is_periodic}, p* = {load}: {decisions:?}");
            assert!(decisions.len() <= 4, "{decisions:?}");
            let expected: &[Decision] = match load {
                ..=2e-3 => &[Decision::SplitCompliance],
                0.1.. => &[Decision::SinglePrecision],
                _ => &[Decision::SplitCompliance, Decision::SinglePrecision],
            };
            assert!(decisions.iter().all(|decision| expected.contains(decision)), "{decisions:?}");
        }
    }
}
