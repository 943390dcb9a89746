//! Pressures below a hardness: what yields, what it carries, how it unloads, and what bounds the error.

use crate::common::{relative_l2, solve};
use asperity::contact::{
    Certificate, Contact, ContactModulus, Gfmd, Law, Load, Multilevel, Observables, Plasticity, PolonskyKeer, Solver,
    archive,
};
use asperity::error::{InputError, ProblemError, SolveError};
use asperity::formats::read_heights;
use asperity::job::HistoryOutcome;
use asperity::setup::{Cell, Recipe, Setup};
use asperity::surface::{Field, Spectrum};
use asperity::{Grid, Indenter, Problem, Stop, Surface};
use serde_json::Value;
use std::sync::Arc;

const TOLERANCE: f64 = 1e-11;

fn solvers() -> [Box<dyn Solver>; 2] {
    [Box::new(PolonskyKeer), Box::new(Multilevel)]
}

fn rough(grid: Grid) -> Surface {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 1.0 / 16.0, rms_gradient: 0.1 };
    Surface::rough(grid, &spectrum, 3).unwrap()
}

fn pressed(surface: Surface, load: Load) -> Problem {
    Problem::new(surface, ContactModulus(2.0), load).unwrap()
}

fn sine() -> Surface {
    Indenter::Sine { amplitude: 0.1 }.surface(Grid::line(256, 1.0).unwrap()).unwrap()
}

/// Lines and surfaces at mean gaps and under light and heavy loads.
fn walls() -> Vec<Problem> {
    let grid = |side| Grid::surface([side; 2], [1.0; 2]).unwrap();
    let surfaces =
        [sine(), rough(Grid::line(251, 1.0).unwrap()), rough(Grid::line(1024, 1.0).unwrap()), rough(grid(48))];
    let under = |surface: &Surface| {
        let pressed = |load| pressed(surface.clone(), Load::ReducedPressure(load));
        let light = pressed(1e-3);
        let gap = |share: f64| light.clone().with_load(Load::MeanGap(share * light.rms_height())).unwrap();
        [gap(0.7), gap(0.05), pressed(0.02), pressed(0.2), light.clone()]
    };
    surfaces.iter().flat_map(under).collect()
}

fn below(wall: &Problem, hardness: f64) -> Problem {
    wall.clone().with_law(Law::Hardness(hardness)).unwrap()
}

/// Hardnesses from just above the mean pressure of an elastic contact to just below its peak.
fn hardnesses(elastic: &Contact) -> [f64; 6] {
    let (mean, peak) = (elastic.mean_pressure(), elastic.max_pressure());
    [1e-3, 0.02, 0.1, 0.3, 0.8, 0.99].map(|share| mean + share * (peak - mean))
}

/// Holds pressure and gap against the law: a gap within the error is none.
fn assert_law(contact: &Contact, hardness: f64) {
    let none = 1e-4 * contact.problem.rms_height();
    for (&p, &gap) in contact.pressure.iter().zip(&contact.gap) {
        assert!((0.0..=hardness).contains(&p), "{p} below {hardness}");
        assert!(p == hardness || gap > -none, "a gap of {gap:e} under {p} of {hardness}");
        assert!(p == 0.0 || gap < none, "a gap of {gap:e} under {p} of {hardness}");
    }
}

/// What yields has no gap, and its overlap is a quantity of its own: the datum of the gap is the difference of both.
#[test]
fn the_gap_is_a_distance_and_the_overlap_has_its_own_name() {
    for wall in walls() {
        let elastic = solve(&Multilevel, &wall, 1e-8);
        for hardness in hardnesses(&elastic).into_iter().take(3) {
            let contact = solve(&Multilevel, &below(&wall, hardness), TOLERANCE);
            let (overlap, n) = (contact.overlap(), wall.nodes() as f64);
            let datum = contact.separation() - (&contact.displacement - wall.surface().height()).sum() / n;
            for (i, (&gap, &overlap)) in contact.gap.iter().zip(&overlap).enumerate() {
                let v = contact.displacement.as_slice().unwrap()[i] - wall.height()[i];
                let yields = contact.yielding().as_slice().unwrap()[i];
                assert!(gap >= 0.0 && overlap >= 0.0 && (yields || overlap == 0.0), "{gap} {overlap}");
                assert!(
                    (gap - overlap - (v + datum)).abs() < 1e-4 * wall.rms_height(),
                    "{gap} {overlap} {}",
                    v + datum
                );
            }
            let found = Observables::new(&contact);
            assert!((found.mean_gap - contact.gap.sum() / n).abs() < 1e-12 * wall.rms_height());
            assert!((found.plastic_overlap - overlap.sum() / n).abs() < 1e-12 * wall.rms_height());
            assert!(found.plastic_overlap > 0.0 && found.plastic_overlap == contact.plasticity().overlap);
            if let Some(given) = wall.mean_gap() {
                assert!((contact.separation() / given - 1.0).abs() < 1e-4, "{} of {given}", contact.separation());
            }
        }
    }
}

/// The load of a plate: where the mean pressure is the hardness, so is every pressure. Nothing is open, and nothing is uncertain.
#[test]
fn a_load_as_large_as_the_hardness_is_solved_exactly() {
    let stop = Stop::new(1e-8, 1000).unwrap().with_pressure_tolerance(1e-6).unwrap();
    let hardness = 0.037;
    for surface in [sine(), rough(Grid::line(251, 1.0).unwrap()), rough(Grid::surface([40, 49], [1.0, 1.0]).unwrap())] {
        for missing in [-2.0 * f64::EPSILON, 0.0, f64::EPSILON, 3e-16, 1e-15, 1e-14, 1e-12, 1e-9] {
            let load = Load::MeanPressure(hardness * (1.0 - missing));
            let problem = pressed(surface.clone(), load).with_law(Law::Hardness(hardness)).unwrap();
            for solver in solvers() {
                let contact = solver.solve(&problem, &stop, &mut ()).unwrap();
                let it = contact.certificate;
                assert!(contact.is_converged(), "{missing:e} by {}: {it:?}", solver.name());
                assert!(contact.pressure.iter().all(|&p| p <= hardness));
                let apart = contact.pressure.iter().map(|p| hardness - p).sum::<f64>() / problem.nodes() as f64;
                assert!(apart <= hardness * (missing.max(0.0) + 4e-15), "{apart:e} at {missing:e}");
                assert!(it.pressure_error_bound <= 2.0 * missing.max(0.0) + 1e-14, "{missing:e}: {it:?}");
                assert!(
                    it.mean_gap_error_bound < 1e-6 && contact.mean_gap() <= 1e-6 * problem.rms_height(),
                    "{missing:e}: {it:?}"
                );
                assert!(missing > 0.0 || it.pressure_error_bound == 0.0 && contact.mean_gap() == 0.0, "{it:?}");
                assert!(contact.plasticity().overlap > 0.0);
            }
        }
    }
    let above = pressed(sine(), Load::MeanPressure(hardness * (1.0 + 1e-12))).with_law(Law::Hardness(hardness));
    assert!(matches!(above, Err(ProblemError::AboveHardness { .. })));
}

#[test]
fn a_hardness_that_is_never_reached_changes_no_bit() {
    for wall in walls() {
        for solver in solvers() {
            let elastic = solve(solver.as_ref(), &wall, 1e-9);
            let hard = solve(solver.as_ref(), &below(&wall, 1e3 * elastic.max_pressure()), 1e-9);
            assert!(elastic.pressure == hard.pressure, "{}", solver.name());
            assert!(elastic.gap == hard.gap && elastic.work.transforms == hard.work.transforms);
            assert_eq!(hard.plasticity(), Plasticity::default());
        }
    }
}

#[test]
fn both_solvers_find_the_same_contact_below_any_hardness() {
    for wall in walls() {
        let elastic = solve(&Multilevel, &wall, 1e-8);
        let mut before = f64::INFINITY;
        for hardness in hardnesses(&elastic) {
            let problem = below(&wall, hardness);
            let [first, second] = solvers().map(|solver| solve(solver.as_ref(), &problem, TOLERANCE));
            assert_law(&first, hardness);
            assert_law(&second, hardness);
            let difference = relative_l2(&first.pressure, &second.pressure);
            assert!(difference < 1e-6, "{difference} below {hardness}");
            let area = first.plasticity().area;
            assert!(area > 0.0 && area <= before, "{area} of the nodes yield below {hardness}");
            before = area;
        }
    }
}

/// `<p> = H_c a` where all that touches yields, and nothing else is carried.
#[test]
fn a_soft_body_carries_the_load_by_its_area() {
    const MEAN: f64 = 1e-9;
    let grid = Grid::line(1024, 1.0).unwrap();
    for share in [1.0 / 256.0, 0.25, 0.5, 1.0] {
        let wall = pressed(rough(grid), Load::MeanPressure(MEAN));
        for solver in solvers() {
            let contact = solve(solver.as_ref(), &below(&wall, MEAN / share), TOLERANCE);
            let Plasticity { area, load_share, overlap } = contact.plasticity();
            assert!((area - share).abs() <= 1.0 / 1024.0, "{area} of {share} by {}", solver.name());
            assert!((load_share - area / share).abs() < 1e-3 && load_share <= 1.0 + 1e-12 && overlap > 0.0);
            assert!(share < 1.0 || contact.pressure.iter().all(|&p| p == MEAN));
        }
    }
}

/// Under a cylinder the pressure is a plateau at the hardness with elastic flanks, which the same load makes wider than Hertz's.
#[test]
fn a_cylinder_yields_in_the_middle_of_its_contact() {
    let cylinder = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(4096, 4.0).unwrap()).unwrap();
    let wall = pressed(cylinder, Load::MeanPressure(2e-3));
    let elastic = solve(&Multilevel, &wall, TOLERANCE);
    let hardness = 0.8 * elastic.max_pressure();
    let contact = solve(&Multilevel, &below(&wall, hardness), TOLERANCE);
    let yields: Vec<usize> = (0..4096).filter(|&i| contact.yielding()[[0, i]]).collect();
    let touch: Vec<usize> = (0..4096).filter(|&i| contact.mask()[[0, i]]).collect();
    assert!(yields.windows(2).all(|pair| pair[1] == pair[0] + 1) && yields.len() > 100);
    assert!(touch.windows(2).all(|pair| pair[1] == pair[0] + 1) && touch.len() > yields.len() + 20);
    assert!(touch.len() > elastic.counted().contact_nodes);
    // two plateau halves and flanks: more than all nodes at the hardness could not carry it, less than Hertz's half-ellipse does
    let [narrow, wide] = [yields.len(), touch.len()].map(|nodes| nodes as f64 / 4096.0 * hardness);
    assert!(narrow < 2e-3 && 2e-3 < wide);
}

#[test]
fn the_surface_that_is_left_is_elastic_and_bears_the_same_pressure() {
    for wall in walls().into_iter().filter(|wall| wall.mean_pressure().is_some()) {
        let elastic = solve(&Multilevel, &wall, 1e-8);
        for share in [0.1, 0.5] {
            let hardness =
                wall.expected_mean_pressure() + share * (elastic.max_pressure() - wall.expected_mean_pressure());
            let contact = solve(&Multilevel, &below(&wall, hardness), 1e-13);
            let load = Load::MeanPressure(wall.expected_mean_pressure());
            let back = solve(&Multilevel, &pressed(contact.unloaded_surface().unwrap(), load), 1e-13);
            let difference = relative_l2(&contact.pressure, &back.pressure);
            assert!(difference < 1e-5, "{difference} below {hardness}");
            assert!(contact.plasticity().overlap > 0.0);
        }
    }
}

#[test]
fn a_load_curve_comes_back_by_another_way() {
    let cylinder = Recipe::indenter(Indenter::Cylinder { radius: 1.0 });
    let loads = [1e-4, 5e-4, 1e-3, 2e-3].map(Load::ReducedPressure);
    let setup = Setup { law: Law::Hardness(0.01), ..Setup::new(cylinder, Cell::line(1024, 4.0), loads[0]) };
    let setup = setup.under_loads(loads.into()).unloaded();
    let outcome = HistoryOutcome::solve(&setup, &setup.problem().unwrap(), &mut ()).unwrap();
    let found = outcome.states.iter().map(|state| &state.contact);
    let found: Vec<_> = found.map(|it| (it.counted().relative_area, it.problem.law(), it.mean_pressure())).collect();
    assert_eq!(found.len(), 7);
    assert!(found[..4].iter().all(|(_, law, _)| *law == Law::Hardness(0.01)));
    for (up, down) in [(0, 6), (1, 5), (2, 4)] {
        assert!(found[down].1.is_hard_wall() && found[down].0 > 1.2 * found[up].0, "{found:?}");
        assert!((found[down].2 / found[up].2 - 1.0).abs() < 1e-12);
    }
}

/// No pressure that the law allows lies deeper than the bound says, be it random, lowest first, or on the way to the solution.
#[test]
fn no_pressure_lies_deeper_than_the_bound() {
    let energy = |problem: &Problem, p: &[f64]| {
        let mut u = vec![0.0; p.len()];
        problem.response().displacement(p, &mut u);
        let gap = problem.datum().unwrap_or(0.0);
        let sum: f64 = (0..p.len()).map(|i| p[i] * (0.5 * u[i] - problem.height()[i] + gap)).sum();
        sum / p.len() as f64
    };
    let noise = |i: usize, seed: usize| {
        ((i * 7919 + seed * 104729) as f64 * 12.9898).sin().mul_add(43758.5453, 0.0).fract().abs()
    };
    for wall in walls().into_iter().filter(|wall| wall.nodes() < 1000) {
        let peak = solve(&Multilevel, &wall, 1e-8).max_pressure();
        let mean = wall.expected_mean_pressure().min(0.1 * peak);
        let hardness = mean + 0.4 * (peak - mean);
        let problem = below(&wall, hardness);
        let n = problem.nodes();
        let load = problem.mean_pressure().unwrap_or(mean) * n as f64;
        let states: Vec<Vec<f64>> = (0..20)
            .map(|seed| {
                let raw: Vec<f64> = (0..n).map(|i| noise(i, seed).powi(1 + 4 * (seed as i32 % 5))).collect();
                within(&raw, load, hardness)
            })
            .collect();
        for p in &states {
            let certificate = Certificate::new(&problem, p);
            let mean_p = p.iter().sum::<f64>() / n as f64;
            for q in &states {
                let mean_q = q.iter().sum::<f64>() / n as f64;
                let deeper = energy(&problem, p) - energy(&problem, q);
                let bound = certificate.eta * mean_p.max(mean_q) * problem.rms_height();
                assert!(deeper <= bound * (1.0 + 1e-12), "{deeper:e} of {bound:e}");
            }
        }
        // the bound is no larger than what the best linear step gains, which is found by sorting here
        let solution = solve(&Multilevel, &problem, 1e-12);
        let least = energy(&problem, solution.pressure.as_slice().unwrap());
        for p in &states {
            let above = energy(&problem, p) - least;
            let unit = problem.mean_pressure().map_or(solution.mean_pressure().max(load / n as f64), |mean| mean)
                * problem.rms_height();
            assert!(above <= Certificate::new(&problem, p).eta * unit * (1.0 + 1e-9));
            let wrong: Vec<f64> = p.iter().zip(&solution.pressure).map(|(p, q)| p - q).collect();
            let square = |x: &[f64]| {
                let mut u = vec![0.0; x.len()];
                problem.response().displacement(x, &mut u);
                x.iter().zip(u).map(|(x, u)| x * u).sum::<f64>()
            };
            let error = (square(&wrong) / square(p)).sqrt();
            assert!(
                problem.datum().is_some() || error <= Certificate::new(&problem, p).pressure_error_bound * (1.0 + 1e-6)
            );
        }
    }
}

/// Values scaled and clipped until they carry a load below a ceiling.
fn within(raw: &[f64], load: f64, ceiling: f64) -> Vec<f64> {
    let clipped = |factor: f64| raw.iter().map(|r| (factor * r).min(ceiling)).collect::<Vec<f64>>();
    let (mut low, mut high) = (0.0, 1e12 * ceiling);
    for _ in 0..400 {
        let middle = 0.5 * (low + high);
        if clipped(middle).iter().sum::<f64>() < load { low = middle } else { high = middle }
    }
    clipped(high)
}

#[test]
fn the_datum_is_within_its_bound() {
    for wall in walls().into_iter().filter(|wall| wall.mean_pressure().is_some()) {
        let hardness = 2.0 * wall.expected_mean_pressure() + 0.3 * solve(&Multilevel, &wall, 1e-8).max_pressure();
        let problem = below(&wall, hardness);
        let exact = solve(&Multilevel, &problem, 1e-13).mean_gap();
        for tolerance in [1e-2, 1e-4, 1e-6] {
            let contact = PolonskyKeer.solve(&problem, &Stop::new(tolerance, 10_000).unwrap(), &mut ()).unwrap();
            let missed = (contact.mean_gap() - exact).abs() / problem.rms_height();
            assert!(missed <= contact.certificate.mean_gap_error_bound + 1e-7, "{missed} {:?}", contact.certificate);
        }
    }
}

/// What is no pressure below the hardness is worth nothing, and what yields too early is far from the solution.
#[test]
fn hostile_pressures_get_no_certificate() {
    let problem = below(&pressed(sine(), Load::MeanPressure(0.1)), 0.2);
    let mut p = vec![0.1; 256];
    assert!(Certificate::new(&problem, &p).eta.is_finite());
    p[7] = 0.2 * (1.0 + 1e-9);
    let certificate = Certificate::new(&problem, &p);
    assert!(certificate.eta.is_infinite() && (certificate.above_hardness / 1e-9 - 1.0).abs() < 1e-3);
    p[7] = -1e-9;
    assert!(Certificate::new(&problem, &p).eta.is_infinite());
    // all at the hardness, but on the wrong half of the nodes
    let contact = solve(&Multilevel, &problem, 1e-10);
    let upside_down: Vec<f64> = contact.pressure.iter().map(|p| 0.2 - p).collect();
    assert!(Certificate::new(&problem, &upside_down).eta > 0.5);
    // the elastic solution is none below a hardness
    let elastic = solve(&Multilevel, &pressed(sine(), Load::MeanPressure(0.1)), 1e-10);
    assert!(Certificate::new(&problem, elastic.pressure.as_slice().unwrap()).eta.is_infinite());
}

#[test]
fn what_cannot_be_is_refused_with_both_numbers() {
    let wall = pressed(sine(), Load::MeanPressure(0.1));
    let error = wall.clone().with_law(Law::Hardness(0.05)).unwrap_err();
    assert_eq!(error, ProblemError::AboveHardness { mean_pressure: 0.1, hardness: 0.05 });
    let hard = below(&wall, 0.2);
    let error = hard.clone().with_load(Load::MeanPressure(0.3)).unwrap_err();
    assert_eq!(error, ProblemError::AboveHardness { mean_pressure: 0.3, hardness: 0.2 });
    for hardness in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(wall.clone().with_law(Law::Hardness(hardness)), Err(ProblemError::NotPositive { .. })));
    }
    let error = Gfmd::default().solve(&hard, &Stop::default(), &mut ()).unwrap_err();
    assert!(matches!(error, SolveError::NeedsHardWall { .. }) && error.is_input());
}

/// Yielding nodes take no part in the stiffness: between two neighbouring loads the gap falls by the load over it.
#[test]
fn stiffness_is_that_of_the_free_nodes() {
    let wall = pressed(rough(Grid::line(1024, 1.0).unwrap()), Load::ReducedPressure(0.2));
    let elastic = solve(&Multilevel, &wall, 1e-12);
    let problem = below(&wall, 0.6 * elastic.max_pressure());
    let contact = solve(&Multilevel, &problem, 1e-13);
    let more = contact.mean_pressure() * (1.0 + 1e-4);
    let next = solve(&Multilevel, &problem.with_load(Load::MeanPressure(more)).unwrap(), 1e-13);
    let slope = (more - contact.mean_pressure()) / (contact.separation() - next.separation());
    assert!((contact.stiffness() / slope - 1.0).abs() < 0.02, "{} and {slope}", contact.stiffness());
    assert!(contact.stiffness() < elastic.stiffness());
}

#[test]
fn a_scene_has_a_hardness_and_its_archive_says_what_yields() {
    let sine = Recipe::indenter(Indenter::Sine { amplitude: 0.01 });
    let wall = Setup::new(sine, Cell::line(256, 1.0), Load::ReducedPressure(0.2));
    assert!(!wall.to_toml().contains("law"));
    let setup = Setup { law: Law::Hardness(0.02), ..wall };
    assert_eq!(Setup::from_toml(&setup.to_toml()).unwrap(), setup);
    let contact = solve(&Multilevel, &setup.problem().unwrap(), 1e-10);
    assert_eq!(contact.problem.law(), Law::Hardness(0.02));
    let bytes = archive(&contact, 1, None).unwrap();
    let mut npz = ndarray_npy::NpzReader::new(std::io::Cursor::new(bytes)).unwrap();
    let yielding: ndarray::Array1<bool> = npz.by_name("yielding").unwrap();
    let share: ndarray::Array0<f64> = npz.by_name("plastic_area").unwrap();
    assert_eq!(yielding.iter().filter(|it| **it).count() as f64 / 256.0, share.into_scalar());
    assert!(yielding.iter().any(|it| *it));
}

/// Tamaas 2.9.0, `KatoSaturated` to 1e-12 on a rough surface under a light load and on every other node of it under a heavy one; its
/// pressures are kept on a part of the nodes.
#[test]
fn tamaas_finds_the_same_pressures() {
    let entries: Vec<Value> =
        serde_json::from_str(&std::fs::read_to_string(common_data("kato.json")).unwrap()).unwrap();
    assert_eq!(entries.len(), 2);
    let heights = read_heights(common_data("surface_rough_h08.height.npy")).unwrap();
    let heights = heights.into_dimensionality::<ndarray::Ix2>().unwrap();
    for entry in entries {
        let [pressure, hardness, plastic, area] =
            ["mean_pressure", "hardness", "plastic_area", "relative_area"].map(|key| entry[key].as_f64().unwrap());
        let [of_heights, of_pressure] =
            ["heights_step", "pressure_step"].map(|key| entry[key].as_u64().unwrap() as usize);
        let height = every(&heights, of_heights);
        let grid = Grid::surface([height.nrows(), height.ncols()], [1.0; 2]).unwrap();
        let surface = Surface::new(grid, height).unwrap();
        let wall = Problem::new(surface, ContactModulus(1.0), Load::MeanPressure(pressure)).unwrap();
        let theirs = read_heights(common_data(&format!("{}.pressure.npy", entry["name"].as_str().unwrap()))).unwrap();
        for solver in solvers() {
            let contact = solve(solver.as_ref(), &below(&wall, hardness), 1e-12);
            let ours = every(&contact.pressure, of_pressure);
            let difference = relative_l2(&ours, &theirs);
            assert!(difference < 1e-5, "{difference} by {}", solver.name());
            assert!((contact.plasticity().area - plastic).abs() < 1e-4 && plastic > 0.01);
            assert!((contact.counted().relative_area - area).abs() < 1e-4);
        }
    }
}

/// Every `step`-th row and column of a field.
fn every(field: &Field, step: usize) -> Field {
    Field::from_shape_fn([field.nrows() / step, field.ncols() / step], |(y, x)| field[[step * y, step * x]])
}

fn common_data(name: &str) -> std::path::PathBuf {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name)
}

/// No pressure is above the hardness, so that `<p> / H_c` is the least area that bears the load; and the contact has a gradient.
#[test]
fn the_resolved_area_bears_the_load_at_the_hardness() {
    for wall in walls() {
        let peak = solve(&Multilevel, &wall, 1e-8).max_pressure();
        for share in [0.02, 0.1, 0.5] {
            let hardness = wall.expected_mean_pressure() + share * (peak - wall.expected_mean_pressure()).abs();
            let contact = solve(&Multilevel, &below(&wall, hardness), TOLERANCE);
            let (resolved, least) = (contact.resolved(), contact.mean_pressure() / hardness);
            assert!(resolved.relative_area >= least * (1.0 - 1e-9), "{} below {least}", resolved.relative_area);
            assert!(resolved.rms_gradient_contact.is_finite(), "{resolved:?}");
            let error = contact.resolution().relative_area_error;
            assert!(error < 1.0, "an error of {error}");
        }
    }
}

/// Nearly all of the load of a steep, soft surface lies on nodes that yield: its area is little above `<p> / H_c` on any grid, and the
/// error that is told of it is no multiple of it, however light the load.
#[test]
fn the_area_of_yielded_contacts_is_known_on_coarse_grids() {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.5, short_cutoff: 1.0 / 16.0, rms_gradient: 0.5 };
    let hardness = 0.005 * 2.0;
    for seed in 1..5 {
        let coarse = Surface::rough(Grid::surface([128; 2], [1.0; 2]).unwrap(), &spectrum, seed).unwrap();
        let fine = Arc::new(coarse.refined(4).unwrap());
        for share in [0.002, 0.01, 0.1] {
            let load = Load::MeanPressure(share * hardness);
            let [found, truth] = [Arc::new(coarse.clone()), Arc::clone(&fine)].map(|surface| {
                let wall = Problem::new(surface, ContactModulus(2.0), load).unwrap();
                solve(&Multilevel, &below(&wall, hardness), 1e-8)
            });
            let errors = found.resolution();
            let off = |of: fn(&Contact) -> f64| (of(&found) / of(&truth) - 1.0).abs();
            let area = (errors.relative_area_error, off(|it| it.resolved().relative_area));
            let kappa_r = (errors.kappa_r_error, off(|it| it.resolved().kappa_r));
            for (told, wrong) in [area, kappa_r] {
                assert!(
                    told < 0.15 && wrong < 2.0 * told,
                    "told {told} of an error of {wrong} at {share} of the hardness"
                );
            }
        }
    }
}

/// A case in which the sets of whole-set updates recur: the guard then needs few steps. It took 326 transforms when its steps
/// followed the gradient.
#[test]
fn recurring_sets_cost_few_transforms() {
    let points = 1 << 14;
    let spectrum =
        Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 64.0 / f64::from(points), rms_gradient: 0.1 };
    let surface = Surface::rough(Grid::line(points as usize, 1.0).unwrap(), &spectrum, 3).unwrap();
    let wall = Problem::new(surface, ContactModulus(1.0), Load::ReducedPressure(0.2)).unwrap();
    let contact = solve(&Multilevel, &below(&wall, 0.022), 1e-8);
    assert!(contact.work.transforms < 280, "{} transforms", contact.work.transforms);
}

/// The highest load is applied twice, on the way up and back: what is told of both is the same, and over the gradient of the start.
#[test]
fn a_load_curve_has_one_meaning_up_and_back() {
    let roughness = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 1.0 / 16.0, rms_gradient: 0.1 };
    let loads = [0.02, 0.05, 0.05, 0.02].map(Load::ReducedPressure);
    let rough = Recipe::rough(roughness, 3);
    let mut setup = Setup { law: Law::Hardness(0.02), ..Setup::new(rough, Cell::line(1024, 1.0), loads[0]) };
    setup.stop = Stop::new(1e-12, 10_000).unwrap();
    let setup = setup.under_loads(loads.into());
    let outcome = HistoryOutcome::solve(&setup, &setup.problem().unwrap(), &mut ()).unwrap();
    let found = outcome.states.iter().map(|state| &state.contact);
    let found: Vec<_> = found.map(|it| (Observables::new(it), it.plasticity().overlap)).collect();
    let [low, (high, overlap), (again, _), back] = found[..] else { panic!("four loads") };
    assert!(overlap > 0.01 * high.rms_height);
    assert!((again.mean_gap - high.mean_gap).abs() < 1e-6 * high.rms_height, "{} {}", again.mean_gap, high.mean_gap);
    for (of, prescribed) in [(low.0, 0.02), (high, 0.05), (again, 0.05), (back.0, 0.02)] {
        assert!((of.reduced_pressure / prescribed - 1.0).abs() < 1e-12, "p* {}", of.reduced_pressure);
        assert!((of.kappa * prescribed / of.relative_area - 1.0).abs() < 1e-12, "kappa {}", of.kappa);
        assert!((of.rms_gradient - low.0.rms_gradient).abs() == 0.0 && of.rms_height == low.0.rms_height);
    }
    // lifted off again, the flattened surface lies closer to where it was than on the way up
    assert!(back.0.mean_gap < low.0.mean_gap && back.0.mean_gap > high.mean_gap);
}
