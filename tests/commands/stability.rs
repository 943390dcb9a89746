//! `asperity stability`, run for real on small cases, and the check by which it judges.

use crate::command::{Folder, text};
use crate::rows::{assert_refused, rows};
use asperity::contact::{ContactModulus, Load, PolonskyKeer, Solver};
use asperity::elastic::Response;
use asperity::lab::stability::{Check, Kernel};
use asperity::{Grid, Indenter, Problem, Stop};
use std::collections::BTreeSet;

#[test]
fn every_case_ends_as_it_must() {
    let folder = Folder::new();
    let output = folder.run("stability --quick --out x.csv");
    let out = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{out}{}", text(&output.stderr));
    assert!(!out.contains("WRONG") && out.contains(" 0 wrong"), "{out}");
    let rows = rows(&folder, "x.csv");
    assert!(rows.iter().all(|row| row["as_demanded"] == "true"), "{out}");
    assert!(rows.len() > 500, "{}", rows.len());
    let listed = folder.run("stability --quick --list");
    let listed: BTreeSet<&str> = text(&listed.stdout).lines().filter_map(|line| line.split(' ').next()).collect();
    assert!(listed.len() > 100);
    assert_eq!(rows.iter().map(|row| row["case"].as_str()).collect::<BTreeSet<_>>(), listed);
}

#[test]
fn cases_and_solvers_can_be_chosen() {
    let folder = Folder::new();
    let output = folder.run("stability spike tolerance-NaN --quick --solver polonsky-keer --out x.csv");
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stdout));
    let rows = rows(&folder, "x.csv");
    assert!(rows.iter().all(|row| row["solver"] == "polonsky-keer"));
    let verdicts: BTreeSet<&str> = rows.iter().map(|row| row["verdict"].as_str()).collect();
    assert_eq!(verdicts, ["converged", "refused"].into());
    assert!(rows.iter().all(|row| (row["verdict"] == "refused") == row["eta"].is_empty()), "{rows:?}");
}

#[test]
fn a_budget_that_runs_out_is_no_convergence() {
    let folder = Folder::new();
    let output = folder.run("stability stiff --quick --solver multilevel,gfmd-uniform --budget 1e-6 --out x.csv");
    assert_eq!(output.status.code(), Some(3));
    assert!(text(&output.stdout).contains("not stable: 0 runs are wrong"), "{}", text(&output.stdout));
    assert!(rows(&folder, "x.csv").iter().all(|row| row["verdict"] == "not-converged"));
}

/// Not only of the multilevel solver.
#[test]
fn demands_on_every_solver_count() {
    let output = Folder::new().run("stability stiff --quick --solver gfmd-uniform --budget 1e-6");
    assert_eq!(output.status.code(), Some(3));
    assert!(
        text(&output.stdout).contains("0 runs are wrong, 1 have not the required verdict"),
        "{}",
        text(&output.stdout)
    );
}

#[test]
fn what_cannot_be_is_refused_before_anything_runs() {
    let folder = Folder::new();
    assert_refused(&folder.run("stability --quick spike spyke"), &["spyke", "--list"]);
    assert_refused(&folder.run("stability --quick --solver newton"), &["newton", "gfmd-uniform"]);
    assert_refused(&folder.run("stability --quick --out missing/x.csv"), &["the folder missing does not exist"]);
    for budget in ["0", "-1", "NaN", "inf"] {
        assert_refused(&folder.run(&format!("stability --quick --budget {budget}")), &["--budget"]);
    }
}

fn problems() -> [Problem; 3] {
    let line = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(256, 4.0).unwrap()).unwrap();
    let long = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(16_384, 4.0).unwrap()).unwrap();
    let (pressed, apart) = (Load::MeanPressure(0.02), Load::MeanGap(0.4));
    [(line.clone(), pressed), (long, pressed), (line, apart)]
        .map(|(surface, load)| Problem::new(surface, ContactModulus(1.0), load).unwrap())
}

fn solution(problem: &Problem) -> Vec<f64> {
    let contact = PolonskyKeer.solve(problem, &Stop::default(), &mut ()).unwrap();
    contact.pressure.into_iter().collect()
}

#[test]
fn a_solution_passes_the_check() {
    for problem in problems() {
        let check = Check::new(&problem, &solution(&problem));
        assert_eq!((check.fault(), check.doubt(1e-8, None)), (None, None));
    }
}

#[test]
fn a_spoiled_pressure_does_not() {
    for problem in problems() {
        let solution = solution(&problem);
        let spoiled = |spoil: &dyn Fn(usize, f64) -> f64| {
            let pressure: Vec<f64> = solution.iter().enumerate().map(|(i, &p)| spoil(i, p)).collect();
            Check::new(&problem, &pressure)
        };
        let moved = spoiled(&|i, _| solution[(i + 1) % solution.len()]);
        assert!(moved.fault().is_none() && moved.doubt(1e-8, None).unwrap().contains("eta"));
        assert!(spoiled(&|_, p| 1.001 * p).doubt(1e-8, None).is_some());
        let uniform = spoiled(&|_, _| solution.iter().sum::<f64>() / solution.len() as f64);
        assert!(uniform.fault().is_none() && uniform.doubt(1e-3, None).is_some());
        assert!(spoiled(&|i, p| if i == 0 { -1e-9 } else { p }).fault().unwrap().contains("tension"));
        assert!(spoiled(&|i, p| if i == 0 { f64::NAN } else { p }).fault().unwrap().contains("finite"));
        assert!(spoiled(&|_, _| 0.0).fault().unwrap().contains("finite"));
        if problem.mean_pressure().is_some() {
            assert!(spoiled(&|_, p| 1.001 * p).fault().unwrap().contains("load"));
        }
    }
}

/// Any load closes the gap all but entirely, and opens it all but entirely: `eta` alone accepts it.
#[test]
fn a_hundredfold_load_does_not_pass_the_check_at_either_end_of_the_gap() {
    let surface = Indenter::Sine { amplitude: 1.0 }.surface(Grid::line(256, 1.0).unwrap()).unwrap();
    let mut full = vec![0.0; 256];
    Response::half_space(surface.grid(), 1.0).pressure(surface.heights(), &mut full);
    let [closed, touching] =
        [1e-9, 1.0 - 1e-9].map(|gap| Problem::new(surface.clone(), ContactModulus(1.0), Load::MeanGap(gap)).unwrap());
    let load = 100.0 * solution(&closed).iter().sum::<f64>() / 256.0;
    let pressed: Vec<f64> = full.iter().map(|p| p + load).collect();
    let touched: Vec<f64> = solution(&touching).iter().map(|p| 100.0 * p).collect();
    for (problem, garbage) in [(closed, pressed), (touching, touched)] {
        let check = Check::new(&problem, &garbage);
        assert!(check.fault().is_none() && check.eta < 1e-6, "{}", check.eta);
        assert!(check.doubt(1e-6, None).unwrap().contains("divided by the remaining gap"));
        let exact = Check::new(&problem, &solution(&problem));
        assert_eq!((exact.fault(), exact.doubt(1e-8, None)), (None, None));
    }
}

#[test]
fn the_check_displaces_as_images_of_the_cell_say() {
    let kernel = Kernel::measure().unwrap();
    assert!(kernel.agrees(), "{kernel}");
    // the check of grids that are too large for a direct sum
    for grid in [Grid::line(6561, 2.0).unwrap(), Grid::surface([71, 90], [2.0, 3.0]).unwrap()] {
        let surface = Indenter::Sine { amplitude: 1.0 };
        let surface =
            if grid.is_line() { surface } else { Indenter::CrossedSine { amplitude: 1.0 } }.surface(grid).unwrap();
        let problem = Problem::new(surface, ContactModulus(3.0), Load::ReducedPressure(0.1)).unwrap();
        let check = Check::new(&problem, &solution(&problem));
        assert_eq!((check.fault(), check.doubt(1e-8, None)), (None, None));
    }
}
