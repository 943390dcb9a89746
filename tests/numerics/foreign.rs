//! Results of another code, Tamaas 2.9.0, certified as they are and spoiled in the ways in which results are spoiled every day.

use crate::peer::Peer;
use asperity::contact::{Certificate, ContactModulus, Each, Gfmd, Load, Problem, Solver, Stop};
use asperity::elastic::Response;
use asperity::foreign::{Assessment, Claim, Frame, GivenField, Mistake, Replay};
use asperity::surface::{Field, Spectrum};
use asperity::{Contact, Grid, Indenter, Surface};
use std::f64::consts::TAU;
use std::ops::ControlFlow;

/// The claim of a peer's result, under the load that is told or the one that it carries.
fn claim(peer: &Peer, load: Option<Load>, quantity: GivenField, values: &Field) -> Claim {
    let modulus = ContactModulus(peer.contact_modulus);
    Claim::new(peer.surface.clone(), modulus, load, quantity, values).unwrap()
}

fn pressure_claim(peer: &Peer, values: &Field) -> Claim {
    claim(peer, Some(peer.load()), GivenField::Pressure, values)
}

/// Gap and displacement that belong to a pressure.
fn lengths(peer: &Peer, pressure: &Field) -> [Field; 2] {
    let mut u = vec![0.0; pressure.len()];
    let pressure = pressure.as_slice().unwrap();
    Response::half_space(peer.surface.grid(), peer.contact_modulus).displacement(pressure, &mut u);
    let shape = peer.surface.grid().shape();
    let displacement = Field::from_shape_vec(shape, u).unwrap();
    let gap = &displacement - peer.surface.height() + peer.mean_gap;
    [gap, displacement]
}

fn contact_of(claim: &Claim) -> Contact {
    let problem = claim.problem().unwrap();
    let frames = [Ok(Frame { values: claim.values().to_vec(), seconds: None })];
    Replay::new("peer", claim.quantity(), frames.into_iter()).solve(&problem, &Stop::default(), &mut ()).unwrap()
}

#[test]
fn results_of_a_peer_hold_in_each_quantity() {
    for peer in Peer::all() {
        let [gap, displacement] = lengths(&peer, &peer.pressure);
        for (quantity, values, tolerance) in [
            (GivenField::Pressure, &peer.pressure, 1e-10),
            (GivenField::Gap, &gap, 1e-9),
            (GivenField::Displacement, &displacement, 1e-9),
        ] {
            let loads = [Some(peer.load()), Some(Load::MeanGap(peer.mean_gap)), None];
            for load in loads.into_iter().filter(|load| load.is_some() || quantity != GivenField::Displacement) {
                let claim = claim(&peer, load, quantity, values);
                let contact = contact_of(&claim);
                let eta = contact.certificate.eta;
                assert!(eta < tolerance, "{}, {quantity}, {load:?}: {eta}", peer.name);
                let area = contact.counted().relative_area;
                assert!(
                    (area / peer.relative_area - 1.0).abs() < 0.01,
                    "{}, {quantity}: {area} not {}",
                    peer.name,
                    peer.relative_area
                );
                assert!(claim.mistakes(&[]).is_empty());
                let assessment = Assessment::new(&claim, &contact).unwrap();
                assert!(assessment.holds(&contact, &Stop::default()), "{assessment:?}");
            }
        }
    }
}

/// A way to spoil a result: the claim that is left of it, and the mistake by name and by some words of its sentence.
struct Spoiled {
    claim: Claim,
    name: &'static str,
    words: String,
}

fn spoiled(claim: Claim, name: &'static str, words: impl Into<String>) -> Spoiled {
    Spoiled { claim, name, words: words.into() }
}

fn with_modulus(peer: &Peer, factor: f64, load: Option<Load>) -> Claim {
    let modulus = ContactModulus(factor * peer.contact_modulus);
    Claim::new(peer.surface.clone(), modulus, load, GivenField::Pressure, &peer.pressure).unwrap()
}

/// Results that were spoiled by one everyday mistake each.
fn everyday(peer: &Peer) -> Vec<Spoiled> {
    let grid = *peer.surface.grid();
    let [gap, displacement] = lengths(peer, &peer.pressure);
    let [dy, dx] = grid.spacing();
    let (cell, force) = if grid.is_line() { (dx, "forces per unit width") } else { (dx * dy, "forces at the nodes") };
    let upside_down = Surface::new(grid, -peer.surface.heights_as_given()).unwrap();
    let (modulus, given) = (ContactModulus(peer.contact_modulus), Some(peer.load()));
    let mut all = vec![
        spoiled(pressure_claim(peer, &-&peer.pressure), "sign", "give -pressure"),
        spoiled(claim(peer, None, GivenField::Pressure, &-&peer.pressure), "sign", "give -pressure"),
        spoiled(claim(peer, given, GivenField::Displacement, &-&displacement), "sign", "give -displacement"),
        spoiled(claim(peer, given, GivenField::Gap, &-&gap), "sign", "give -gap"),
        spoiled(claim(peer, given, GivenField::Gap, &displacement), "quantity", "give it with --displacement"),
        spoiled(claim(peer, given, GivenField::Displacement, &gap), "quantity", "give it with --gap"),
        spoiled(pressure_claim(peer, &(&peer.pressure * cell)), "pressure-factor", force),
        spoiled(claim(peer, None, GivenField::Pressure, &(&peer.pressure * cell)), "pressure-factor", force),
        spoiled(pressure_claim(peer, &(&peer.pressure * 1e-6)), "pressure-factor", "units"),
        spoiled(with_modulus(peer, 2.0, given), "modulus", "two equal bodies"),
        spoiled(with_modulus(peer, 0.5, None), "modulus", "one elastic body"),
        spoiled(
            with_modulus(peer, 0.91, given),
            "modulus",
            "nu = 0.30, as if Young's modulus E was given instead of E*",
        ),
        spoiled(with_modulus(peer, 1.0 / 0.91, None), "modulus", "nu = 0.30, as if the pressures were computed with E"),
        spoiled(with_modulus(peer, 1.37, given), "modulus", "1.3700 times too large"),
    ];
    let quantities = [GivenField::Pressure, GivenField::Gap, GivenField::Displacement];
    for (quantity, values) in quantities.into_iter().zip([&peer.pressure, &gap, &displacement]) {
        let claim = Claim::new(upside_down.clone(), modulus, given, quantity, values).unwrap();
        all.push(spoiled(claim, "heights", "give -height"));
    }
    all
}

#[test]
fn everyday_mistakes_are_recognised_and_named() {
    for peer in Peer::all() {
        for Spoiled { claim, name, words } in everyday(&peer) {
            let mistakes = claim.mistakes(&[]);
            let is_named = mistakes.iter().any(|it| it.errors == [name] && it.sentence.contains(&words));
            assert!(is_named, "{}: {words} is not in {mistakes:?}", peer.name);
            assert!(mistakes.iter().all(|it| it.certificate < 1e-9), "{mistakes:?}");
        }
    }
}

#[test]
fn fields_in_another_order_are_recognised() {
    for peer in Peer::all() {
        let grid = *peer.surface.grid();
        let [ny, nx] = grid.shape();
        let reversed = Field::from_shape_fn([ny, nx], |(y, x)| peer.pressure[[y, nx - 1 - x]]);
        let shifted = Field::from_shape_fn([ny, nx], |(y, x)| peer.pressure[[y, (x + nx / 2) % nx]]);
        let transposed = peer.pressure.t().to_owned();
        let mut cases = vec![(reversed, "::-1]"), (shifted, "numpy.fft.fftshift(pressure")];
        if ny == nx {
            cases.push((transposed.as_standard_layout().into_owned(), "give pressure.T"));
        }
        for (values, words) in cases {
            // a symmetric surface does not tell
            if Certificate::new(
                &claim(&peer, None, GivenField::Pressure, &values).problem().unwrap(),
                values.as_slice().unwrap(),
            )
            .eta < 1e-6
            {
                continue;
            }
            for load in [Some(peer.load()), None] {
                let mistakes = claim(&peer, load, GivenField::Pressure, &values).mistakes(&[]);
                let is_told = |it: &Mistake| it.errors == ["arrangement"] && it.sentence.contains(words);
                assert!(mistakes.iter().any(is_told), "{} {words}: {mistakes:?}", peer.name);
            }
        }
    }
}

#[test]
fn two_mistakes_at_once_are_recognised() {
    let peer = Peer::all().into_iter().find(|peer| peer.name == "surface_rough_h08").unwrap();
    let [dy, dx] = peer.surface.grid().spacing();
    let transposed = peer.pressure.t().as_standard_layout().into_owned();
    let [_, displacement] = lengths(&peer, &peer.pressure);
    let upside_down = Surface::new(*peer.surface.grid(), -peer.surface.heights_as_given()).unwrap();
    let modulus = ContactModulus(peer.contact_modulus);
    let cases = [
        (pressure_claim(&peer, &(&transposed * (dx * dy))), vec!["arrangement", "pressure-factor"]),
        (pressure_claim(&peer, &-&transposed), vec!["arrangement", "sign"]),
        (
            Claim::new(upside_down, modulus, Some(peer.load()), GivenField::Displacement, &-&displacement).unwrap(),
            vec!["sign", "heights"],
        ),
        (with_modulus(&peer, 2.0, None), vec!["modulus"]),
        (claim(&peer, None, GivenField::Pressure, &(&peer.pressure * (-2.0))), vec!["sign", "modulus"]),
    ];
    for (claim, expected) in cases {
        let mistakes = claim.mistakes(&[]);
        assert!(mistakes.iter().any(|it| it.errors == expected), "{expected:?}: {mistakes:?}");
    }
}

/// Contacts to stop on the way to.
fn problems() -> Vec<Problem> {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 0.05, rms_gradient: 0.1 };
    let line = Grid::line(256, 1.0).unwrap();
    let surface = Grid::surface([32, 32], [1.0, 1.0]).unwrap();
    let coarse = Spectrum { short_cutoff: 0.12, ..spectrum };
    let surfaces = [
        Surface::rough(line, &spectrum, 3).unwrap(),
        Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(200, 4.0).unwrap()).unwrap(),
        Indenter::Sine { amplitude: 0.01 }.surface(line).unwrap(),
        Surface::rough(surface, &coarse, 4).unwrap(),
        Indenter::Sphere { radius: 1.0 }.surface(surface).unwrap(),
    ];
    let posed = |surface: Surface| {
        [0.01, 0.2].map(|load| Problem::new(surface.clone(), ContactModulus(2.0), Load::ReducedPressure(load)).unwrap())
    };
    surfaces.into_iter().flat_map(posed).collect()
}

/// States on the way to a contact: pressures, gaps and displacements.
fn states(problem: &Problem, solver: &dyn Solver) -> Vec<[Vec<f64>; 3]> {
    let mut states = Vec::new();
    let mut watch = Each(|step: &asperity::contact::Step<'_>| {
        let index = step.index();
        if step.pressure().len() == problem.nodes() && (index < 12 || index.is_power_of_two()) {
            states.push([step.pressure(), step.gap(), step.displacement()].map(<[f64]>::to_vec));
        }
        ControlFlow::Continue(())
    });
    solver.solve(problem, &Stop::new(1e-8, 3000).unwrap(), &mut watch).unwrap();
    states
}

#[test]
fn results_that_are_not_converged_are_not_taken_for_mistaken_ones() {
    for problem in problems() {
        let mut solvers = crate::common::solvers();
        solvers.push(Box::new(Gfmd { time_step: 0.9, damping: 0.1, ..Gfmd::default() }));
        for solver in solvers {
            for [pressure, gap, displacement] in states(&problem, solver.as_ref()) {
                let load = Some(Load::MeanPressure(problem.expected_mean_pressure()));
                for (quantity, values, load) in [
                    (GivenField::Pressure, &pressure, load),
                    (GivenField::Pressure, &pressure, None),
                    (GivenField::Gap, &gap, load),
                    (GivenField::Displacement, &displacement, load),
                ] {
                    let values = Field::from_shape_vec(problem.surface().grid().shape(), values.clone()).unwrap();
                    let modulus = ContactModulus(problem.contact_modulus());
                    let claim = Claim::new(problem.surface().clone(), modulus, load, quantity, &values).unwrap();
                    let mistakes = claim.mistakes(&[]);
                    assert!(mistakes.is_empty(), "{}, {quantity}, {load:?}: {mistakes:?}", solver.settings());
                }
            }
        }
    }
}

/// The displacement of a surface whose waves are as stiff as `|qx| + |qy|`, by a sum over all waves and nodes.
fn displacement_by_sum(grid: &Grid, pressure: &Field) -> Field {
    let ([ny, nx], [ly, lx]) = (grid.shape(), grid.size());
    let signed = |k: usize, n: usize| if 2 * k > n { k as f64 - n as f64 } else { k as f64 };
    let of_node = |(y, x): (usize, usize)| {
        let mut sum = 0.0;
        for (ky, kx) in (0..ny).flat_map(|ky| (0..nx).map(move |kx| (ky, kx))).skip(1) {
            let stiffness = 0.5 * TAU * (signed(ky, ny).abs() / ly + signed(kx, nx).abs() / lx);
            let phase = TAU * ((ky * y % ny) as f64 / ny as f64 + (kx * x % nx) as f64 / nx as f64);
            sum += phase.cos() / stiffness;
        }
        sum / (ny * nx) as f64
    };
    let green = Field::from_shape_fn((ny, nx), of_node);
    Field::from_shape_fn((ny, nx), |(y, x)| {
        pressure.indexed_iter().map(|((j, i), p)| p * green[[(y + ny - j) % ny, (x + nx - i) % nx]]).sum()
    })
}

/// A pressure, and a surface that it fits on a solid with the stiffness `|qx| + |qy|`: the displacement under the pressure, and a gap around it.
#[test]
fn a_stiffness_by_the_sum_of_the_wavenumbers_is_named() {
    let grid = Grid::surface([21, 24], [1.0, 1.3]).unwrap();
    let level = |(y, x): (usize, usize)| {
        let [y, x] = [y as f64 / 21.0, x as f64 * 1.3 / 24.0];
        let bump = |cy: f64, cx: f64, r: f64| 1.0 - ((y - cy).powi(2) + (x - cx).powi(2)) / (r * r);
        bump(0.3, 0.4, 0.22).max(bump(0.7, 0.9, 0.27))
    };
    let pressure = Field::from_shape_fn((21, 24), |node| 0.01 * level(node).max(0.0).sqrt());
    let gap = Field::from_shape_fn((21, 24), |node| 0.002 * (-level(node)).max(0.0));
    let displacement = displacement_by_sum(&grid, &pressure);
    let surface = Surface::new(grid, &displacement - &gap).unwrap();
    let load = Load::MeanPressure(pressure.sum() / pressure.len() as f64);
    for (quantity, values) in
        [(GivenField::Pressure, &pressure), (GivenField::Gap, &gap), (GivenField::Displacement, &displacement)]
    {
        let claim = Claim::new(surface.clone(), ContactModulus(1.0), Some(load), quantity, values).unwrap();
        assert!(contact_of(&claim).certificate.eta > 1e-3, "{quantity}");
        let mistakes = claim.mistakes(&[]);
        let [Mistake { errors, sentence, certificate, .. }] = &mistakes[..] else { panic!("{quantity}: {mistakes:?}") };
        assert!(*errors == ["kernel"] && sentence.contains("|qx| + |qy|"), "{quantity}: {sentence}");
        assert!(certificate.abs() < 1e-10, "{quantity}: {certificate}");
    }
}
