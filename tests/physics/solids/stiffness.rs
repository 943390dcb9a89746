//! Solids that are given by their stiffness.

use asperity::contact::{Gfmd, Load, Multilevel, PolonskyKeer, Solver};
use asperity::elastic::{Base, ElasticSolid, HalfSpace, Layer, StiffnessTable};
use asperity::error::{GridError, ProblemError};
use asperity::setup::{Setup, SetupTable, Solid, command};
use asperity::surface::Spectrum;
use asperity::{Grid, Problem, Stop, Surface};
use std::f64::consts::TAU;
use std::sync::Arc;

/// The stiffness of a wave of any solid.
fn stiffness(solid: &dyn ElasticSolid, q: f64) -> f64 {
    0.5 * solid.contact_modulus() * q / solid.factor(q)
}

/// The table of a solid with `per_decade` rows over three decades from the wavenumber of the cell.
fn tabulated(solid: &dyn ElasticSolid, per_decade: usize) -> StiffnessTable {
    let rows = (0..=3 * per_decade).map(|i| 0.99 * TAU * 10f64.powf(i as f64 / per_decade as f64));
    StiffnessTable::new(rows.map(|q| [q, stiffness(solid, q)]), solid.uniform_compliance().map(f64::recip)).unwrap()
}

fn rough(grid: Grid) -> Arc<Surface> {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.4, short_cutoff: 0.05, rms_gradient: 0.1 };
    Arc::new(Surface::rough(grid, &spectrum, 3).unwrap())
}

fn grids() -> [Grid; 2] {
    [Grid::line(512, 1.0).unwrap(), Grid::surface([128, 128], [1.0, 1.0]).unwrap()]
}

#[test]
fn a_layer_as_a_table_has_the_contact_of_the_layer() {
    let layer = Layer { contact_modulus: 1.0, poisson: 0.4, thickness: 0.05, base: Base::Bonded };
    for grid in grids() {
        let (surface, stop) = (rough(grid), Stop::new(1e-11, 100_000).unwrap());
        for load in [Load::MeanPressure(0.01), Load::Approach(0.02)] {
            let own = Problem::new(surface.clone(), layer, load).unwrap();
            let table = Problem::new(surface.clone(), tabulated(&layer, 200), load).unwrap();
            let [own, table] =
                [own, table].map(|it| Multilevel.solve(&it, &stop, &mut ()).unwrap().converged().unwrap());
            let largest = own.pressure.iter().fold(0.0, |m: f64, p| m.max(*p));
            let apart = own.pressure.iter().zip(&table.pressure).fold(0.0, |m: f64, (p, r)| m.max((p - r).abs()));
            assert!(apart < 1e-6 * largest, "{apart:e} of {largest:e} under {load}");
        }
    }
}

#[test]
fn all_solvers_agree_on_a_table_and_direct_sums_confirm_it() {
    // a stiff plate on a soft body, which no other solid of this crate is: k = q/2 (1 + (0.05 q)^2 exp(-0.01 q))
    let k = |q: f64| 0.5 * q * (1.0 + (0.05 * q).powi(2) * (-0.01 * q).exp());
    let rows = (0..=600).map(|i| TAU * 10f64.powf(0.005 * i as f64)).map(|q| [q, k(q)]);
    let table = StiffnessTable::new(rows, None).unwrap();
    let grid = Grid::line(128, 1.0).unwrap();
    let problem = Problem::new(rough(grid), table.clone(), Load::MeanPressure(0.02)).unwrap();
    let stop = Stop::new(1e-10, 100_000).unwrap();
    let solvers: [&dyn Solver; 3] = [&Multilevel, &PolonskyKeer, &Gfmd::default()];
    let contacts = solvers.map(|it| it.solve(&problem, &stop, &mut ()).unwrap().converged().unwrap());
    let largest = contacts[0].pressure.iter().fold(0.0, |m: f64, p| m.max(*p));
    for contact in &contacts {
        let apart = contact.pressure.iter().zip(&contacts[0].pressure).fold(0.0, |m: f64, (p, r)| m.max((p - r).abs()));
        assert!(apart < 1e-6 * largest, "{}", contact.solver);
        // what must hold of the exact stiffness: no gap where there is pressure
        let pressure: Vec<f64> = contact.pressure.iter().copied().collect();
        let mut displacement = vec![0.0; 128];
        for mode in 1..=64 {
            let (q, pairs) = (TAU * mode as f64, if mode == 64 { 1.0 } else { 2.0 });
            let part = |of: fn(f64) -> f64| -> f64 {
                (0..128).map(|i| pressure[i] * of(q * i as f64 / 128.0)).sum::<f64>() * pairs / 128.0 / k(q)
            };
            let [cos, sin] = [part(f64::cos), part(f64::sin)];
            let wave = |x: f64| cos * (q * x).cos() + sin * (q * x).sin();
            displacement.iter_mut().enumerate().for_each(|(i, u)| *u += wave(i as f64 / 128.0));
        }
        let gap: Vec<f64> = displacement.iter().zip(problem.surface().heights()).map(|(u, h)| u - h).collect();
        let touching = (0..128).filter(|&i| pressure[i] > 1e-6 * largest).map(|i| gap[i]);
        let (low, high) = touching.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), g| (l.min(g), h.max(g)));
        let lowest = gap.iter().fold(f64::INFINITY, |m: f64, g| m.min(*g));
        let scale = problem.rms_height();
        assert!(high - low < 1e-5 * scale && low - lowest < 1e-5 * scale, "{low} {high} {lowest} of {scale}");
    }
}

#[test]
fn a_table_is_exact_at_its_rows_and_smooth_between_them() {
    let layer = Layer { contact_modulus: 3.0, poisson: 0.3, thickness: 0.05, base: Base::Sliding };
    let table = tabulated(&layer, 100);
    assert!(table.rows().iter().all(|[q, k]| table.stiffness(*q) == *k));
    // twice as many rows: an error of fourth order is sixteen times smaller
    let largest = |table: &StiffnessTable| {
        let apart = |q: f64| (table.stiffness(q) / stiffness(&layer, q) - 1.0).abs();
        (0..5000).map(|i| apart(TAU * 10f64.powf(5.6e-4 * i as f64))).fold(0.0, f64::max)
    };
    let [coarse, fine] = [largest(&table), largest(&tabulated(&layer, 200))];
    assert!(coarse < 5e-8 && (13.0..19.0).contains(&(coarse / fine)), "{coarse:e} and {fine:e}");
    // two rows are a power law
    let power = StiffnessTable::new([[1.0, 2.0], [100.0, 200.0]], None).unwrap();
    assert!((power.stiffness(7.0) / 14.0 - 1.0).abs() < 1e-14);
    assert!((power.contact_modulus() / HalfSpace::new(4.0).contact_modulus - 1.0).abs() < 1e-14);
}

#[test]
fn tables_that_cannot_be_used_are_refused() {
    let refused = |rows: &[[f64; 2]], uniform: Option<f64>| {
        StiffnessTable::new(rows.iter().copied(), uniform).unwrap_err().to_string()
    };
    assert!(refused(&[[1.0, 1.0]], None).contains("it has 1 rows: give two or more"));
    assert!(refused(&[[1.0, 1.0], [2.0, -1.0]], None).contains("at the wavenumber 2.0 is -1.0"));
    assert!(refused(&[[2.0, 1.0], [1.0, 1.0]], None).contains("the wavenumber 1.0 follows 2.0: sort them"));
    assert!(refused(&[[1.0, 1.0], [2.0, 1.0]], Some(0.0)).contains("under a uniform pressure is 0.0"));
    let narrow = StiffnessTable::new([[10.0, 1.0], [20.0, 2.0]], None).unwrap();
    for grid in grids() {
        let posed = Problem::new(rough(grid), narrow.clone(), Load::MeanPressure(0.1));
        assert!(matches!(posed, Err(ProblemError::Grid(GridError::UnknownWaves { first: 10.0, .. }))));
    }
    let free = Grid::line(64, 1.0).unwrap().with_periodic([true, false]);
    let table = tabulated(&HalfSpace::new(1.0), 10);
    let posed = Problem::new(rough(free), table, Load::MeanPressure(0.1));
    assert!(matches!(posed, Err(ProblemError::Grid(GridError::FreeSolid { .. }))));
}

#[test]
fn a_setup_holds_its_table() {
    let scene = |solid: &str| {
        let text = format!(
            "[surface.indenter]\nshape = \"cylinder\"\nradius = 1.0\n[grid]\npoints = 64\nsize = 1.0\n[solid]\n{solid}\n[load]\nmean-pressure = 0.01\n"
        );
        SetupTable::from_toml(&text).and_then(|table| table.setup())
    };
    let rows = "wavenumber = [1.0, 10.0, 1000.0]\nstiffness = [0.5, 5.1, 500.0]\nuniform-stiffness = 0.1";
    let setup: Setup = scene(rows).unwrap();
    let table = StiffnessTable::new([[1.0, 0.5], [10.0, 5.1], [1000.0, 500.0]], Some(0.1)).unwrap();
    assert_eq!(setup.solid, Some(Solid::Stiffness(table)));
    assert_eq!(SetupTable::from_toml(&setup.to_table().to_toml()).unwrap().setup().unwrap(), setup);
    assert_eq!(command(&setup), "asperity solve scene.toml");
    let refused = |solid: &str| scene(solid).unwrap_err().to_string();
    assert!(refused(&format!("{rows}\nlayer = 1.0")).contains("give only the stiffness"));
    assert!(
        refused("wavenumber = [1.0, 2.0]\nstiffness = [1.0]").contains("there are 2 wavenumbers and 1 stiffnesses")
    );
}
