//! What flows through a contact, against closed forms and against networks that are reduced cell by cell.

use crate::common::solve;
use asperity::contact::{ContactModulus, Law, Load, Multilevel, Stop};
use asperity::elastic::Layer;
use asperity::error::{FlowError, SealError};
use asperity::flow::{Conductance, FlowAxis, Leakage, Percolation, PercolationLoad};
use asperity::surface::{Field, Spectrum};
use asperity::{Contact, Grid, Indenter, Problem, Surface};
use ndarray::{Array2, array};
use rand::{RngExt, SeedableRng, rngs::ChaCha8Rng};
use std::f64::consts::{PI, TAU};

const AXES: [FlowAxis; 2] = FlowAxis::ALL;

fn random(rng: &mut ChaCha8Rng) -> f64 {
    rng.random_range(0.0..1.0)
}

/// The leakage, with bounds that are in order and as close as was asked for.
fn leakage(grid: &Grid, gap: &Field, axis: FlowAxis, tolerance: f64) -> Leakage {
    let leakage = Leakage::new(grid, gap, axis, tolerance).and_then(Leakage::converged).unwrap();
    assert!(leakage.lower <= leakage.upper * (1.0 + 1e-12), "{leakage:?}");
    leakage
}

/// Whether both bounds are `exact`, to a relative `tolerance`.
fn assert_is(leakage: Leakage, exact: f64, tolerance: f64) {
    for bound in [leakage.lower, leakage.upper] {
        assert!((bound / exact - 1.0).abs() < tolerance, "{exact} is expected: {leakage:?}");
    }
}

fn mean(field: &Field, power: i32) -> f64 {
    field.iter().map(|gap| gap.powi(power)).sum::<f64>() / field.len() as f64
}

/// `sigma` along x by eliminating one cell after the other: the neighbours of a cell get the conductances `c_i c_j / sum c`. This takes
/// no differences, so it is exact to rounding for any gaps.
fn eliminated(grid: &Grid, gap: &Field) -> f64 {
    let [ny, nx] = grid.shape();
    let [dy, dx] = grid.spacing();
    let k = |x: usize, y: usize| gap[[y, x]].max(0.0).powi(3);
    let face = |a: f64, b: f64| if a * b > 0.0 { 2.0 / (1.0 / a + 1.0 / b) } else { 0.0 };
    // column by column: neighbours are at most `ny` cells later
    let (mut later, mut sides, mut direct) = (vec![vec![0.0; ny + 1]; nx * ny], vec![[0.0; 2]; nx * ny], 0.0);
    for x in 0..nx {
        for y in 0..ny {
            let cell = x * ny + y;
            if y + 1 < ny {
                later[cell][1] += face(k(x, y), k(x, y + 1)) * dx / dy;
            } else if grid.periodic()[0] {
                later[x * ny][ny - 1] += face(k(x, y), k(x, 0)) * dx / dy;
            }
            if x + 1 < nx {
                later[cell][ny] += face(k(x, y), k(x + 1, y)) * dy / dx;
            }
            if x == 0 {
                sides[cell][0] = 2.0 * k(x, y) * dy / dx;
            }
            if x + 1 == nx {
                sides[cell][1] = 2.0 * k(x, y) * dy / dx;
            }
        }
    }
    for cell in 0..nx * ny {
        let (links, [inlet, outlet]) = (later[cell].clone(), sides[cell]);
        let sum = links.iter().sum::<f64>() + inlet + outlet;
        let linked: Vec<usize> = (1..=ny).filter(|&step| links[step] > 0.0).collect();
        for (i, &a) in linked.iter().enumerate() {
            linked[i + 1..].iter().for_each(|&b| later[cell + a][b - a] += links[a] * links[b] / sum);
            sides[cell + a][0] += inlet * links[a] / sum;
            sides[cell + a][1] += outlet * links[a] / sum;
        }
        direct += if sum > 0.0 { inlet * outlet / sum } else { 0.0 };
    }
    direct * grid.size()[1] / grid.size()[0]
}

/// The same along an axis, by exchanging the axes.
fn reference(grid: &Grid, gap: &Field, axis: FlowAxis) -> f64 {
    if axis == FlowAxis::X {
        return eliminated(grid, gap);
    }
    let [[ny, nx], [ly, lx], [y, x]] = [grid.shape().map(|n| n as f64), grid.size(), grid.periodic().map(f64::from)];
    let turned = Grid::surface([nx as usize, ny as usize], [lx, ly]).unwrap().with_periodic([x == 1.0, y == 1.0]);
    eliminated(&turned, &gap.t().to_owned())
}

/// Gaps of a few random waves less `level` of their rms value, zero where they would be below.
fn rough_gaps(shape: [usize; 2], level: f64, least: f64, rng: &mut ChaCha8Rng) -> Field {
    let mut wave = || {
        let [kx, ky] = [(); 2].map(|()| (9.0 * random(rng) - 4.5).round());
        (kx, ky, TAU * random(rng))
    };
    let waves: Vec<_> = (0..12).map(|_| wave()).collect();
    Field::from_shape_fn(shape, |(y, x)| {
        let [y, x] = [y as f64 / shape[0] as f64, x as f64 / shape[1] as f64];
        let height: f64 = waves.iter().map(|(kx, ky, phase)| (TAU * (kx * x + ky * y) + phase).cos()).sum();
        let gap = height / 6f64.sqrt() - level;
        if gap > 0.0 { gap.powf(1.5) + least } else { 0.0 }
    })
}

#[test]
fn waves_leak_by_their_closed_forms() {
    let (e, g0, n) = (0.6f64, 3e-6, 64);
    let grid = Grid::surface([24, n], [2e-3, 1e-3]).unwrap();
    let gap = Field::from_shape_fn([24, n], |(_, x)| g0 * (1.0 + e * (TAU * x as f64 / n as f64).cos()));
    let across = g0.powi(3) * (1.0 - e * e).powf(2.5) / (1.0 + e * e / 2.0);
    assert!((across / g0.powi(3) - 0.277_694_915_25).abs() < 1e-10);
    assert_is(leakage(&grid, &gap, FlowAxis::X, 1e-10), across, 1e-9);
    assert_is(leakage(&grid, &gap, FlowAxis::Y, 1e-10), 1.54 * g0.powi(3), 1e-9);
    // the mean that is met converges fast: 16 points leave 1e-4, and 32 points 1e-8
    let sixteen = Field::from_shape_fn([4, 16], |(_, x)| g0 * (1.0 + e * (TAU * x as f64 / 16.0).cos()));
    let coarse = leakage(&Grid::surface([4, 16], [1.0, 1.0]).unwrap(), &sixteen, FlowAxis::X, 1e-10);
    assert!((coarse.sigma() / across - 1.0).abs() > 1e-6, "{coarse:?}");
}

#[test]
fn gaps_in_series_and_in_parallel_are_exact() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let stripes: Vec<f64> = (0..37).map(|_| 0.05 + random(&mut rng)).collect();
    let gap = Field::from_shape_fn([10, 37], |(_, x)| stripes[x]);
    for periodic in [[true, true], [false, false]] {
        let grid = Grid::surface([10, 37], [0.3, 2.0]).unwrap().with_periodic(periodic);
        assert_is(leakage(&grid, &gap, FlowAxis::X, 1e-11), 1.0 / mean(&gap, -3), 1e-10);
        assert_is(leakage(&grid, &gap, FlowAxis::Y, 1e-11), mean(&gap, 3), 1e-10);
    }
    let line = Grid::line(37, 2.0).unwrap();
    let gap = Field::from_shape_vec([1, 37], stripes).unwrap();
    assert_is(leakage(&line, &gap, FlowAxis::X, 1e-11), 1.0 / mean(&gap, -3), 1e-10);
    assert_is(leakage(&line, &gap, FlowAxis::Y, 1e-11), mean(&gap, 3), 1e-10);
}

#[test]
fn bounds_enclose_the_flow_through_random_gaps() {
    let mut rng = ChaCha8Rng::seed_from_u64(11);
    let mut sealed = 0;
    for map in 0..50 {
        let shape = [[64, 64], [48, 64], [64, 40]][map % 3];
        let grid = Grid::surface(shape, [1.0, 0.7]).unwrap().with_periodic([map % 2 == 0, map % 5 != 0]);
        let gap = rough_gaps(shape, -1.2 + 0.026 * map as f64, 0.0, &mut rng);
        for axis in AXES {
            let (exact, found) = (reference(&grid, &gap, axis), leakage(&grid, &gap, axis, 1e-6));
            assert!(found.lower <= exact * (1.0 + 1e-11) && exact <= found.upper * (1.0 + 1e-11), "{exact} {found:?}");
            assert!(found.upper <= mean(&gap, 3) * (1.0 + 1e-12), "{found:?}");
            assert_eq!(exact == 0.0, found.is_sealed(), "{exact} {found:?}");
            sealed += usize::from(found.is_sealed());
            // a loose tolerance is met too, and gives bounds
            let loose = leakage(&grid, &gap, axis, 0.3);
            assert!(loose.lower <= exact * (1.0 + 1e-11) && exact <= loose.upper * (1.0 + 1e-11), "{exact} {loose:?}");
        }
    }
    assert!((5..50).contains(&sealed), "{sealed} of 100 are sealed");
}

#[test]
fn the_flow_lies_between_that_of_gaps_in_series_and_in_parallel() {
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    let grid = Grid::surface([32, 32], [1.0, 1.0]).unwrap();
    for _ in 0..20 {
        let gap = rough_gaps([32, 32], -9.0, 0.0, &mut rng);
        for axis in AXES {
            let found = leakage(&grid, &gap, axis, 1e-9);
            assert!(1.0 / mean(&gap, -3) < found.lower && found.upper < mean(&gap, 3), "{found:?}");
        }
    }
}

/// Keller, J. Math. Phys. 5, 548 (1964): in a rectangle, stream lines of the conductivity `k` are isobars of `1/k`.
#[test]
fn the_flow_across_is_that_of_the_inverse_gap() {
    let product_error = |n: usize| {
        let grid = Grid::surface([n, 2 * n], [1.0, 2.0]).unwrap().with_periodic([false, false]);
        let gap = Field::from_shape_fn([n, 2 * n], |(y, x)| {
            let [y, x] = [(y as f64 + 0.5) / n as f64, (x as f64 + 0.5) / n as f64];
            (0.4 * (3.0 * x + 1.0).sin() * (4.0 * y - x).cos()).exp()
        });
        let inverse = gap.mapv(f64::recip);
        let [along, across] =
            [(&gap, FlowAxis::X), (&inverse, FlowAxis::Y)].map(|(g, axis)| leakage(&grid, g, axis, 1e-10));
        (along.sigma() * across.sigma() - 1.0).abs()
    };
    let [coarse, fine] = [16, 64].map(product_error);
    assert!(coarse < 0.01 && fine < coarse / 10.0, "{coarse} {fine}");
}

#[test]
fn gaps_that_cannot_be_used_are_refused() {
    let grid = Grid::surface([4, 4], [1.0, 1.0]).unwrap();
    let gap = Field::ones([4, 4]);
    assert!(matches!(Leakage::new(&grid, &Field::ones([4, 5]), FlowAxis::X, 1e-6), Err(FlowError::Shape { .. })));
    for tolerance in [0.0, f64::NAN, 1.0, 1e-13] {
        assert!(matches!(Leakage::new(&grid, &gap, FlowAxis::X, tolerance), Err(FlowError::Tolerance { .. })));
    }
    let mut broken = gap.clone();
    broken[[2, 3]] = f64::NAN;
    let error = Leakage::new(&grid, &broken, FlowAxis::X, 1e-6).unwrap_err();
    assert_eq!(error.to_string(), "the gap at row 2, column 3 is NaN: all gaps must be finite");
    assert_is(Leakage::new(&grid, &gap, FlowAxis::X, 1e-6).unwrap(), 1.0, 1e-12);
    // gaps whose cubes are beyond doubles
    assert!(Leakage::new(&grid, &(&gap * 1e-120), FlowAxis::X, 1e-6).unwrap().is_sealed());
    let solved = Leakage::new(&grid, &gap, FlowAxis::X, 1e-6).unwrap();
    let strict = Leakage { lower: 1.0, upper: 2.0, tolerance: 0.1, steps: 7, ..solved };
    assert!(matches!(strict.converged(), Err(FlowError::NotConverged { steps: 7, .. })));
}

/// The four statements on a picture, where `#` touches: open along x and y, contact along x and y.
fn percolation(rows: &[&str], periodic: bool) -> [bool; 4] {
    let mask = Array2::from_shape_fn((rows.len(), rows[0].len()), |(y, x)| rows[y].as_bytes()[x] == b'#');
    let grid = Grid::surface([rows.len(), rows[0].len()], [1.0, 1.0]).unwrap().with_periodic([periodic; 2]);
    statements(&grid, &mask)
}

fn statements(grid: &Grid, mask: &Array2<bool>) -> [bool; 4] {
    let found = Percolation::new(grid, mask).unwrap();
    let [x, y] = AXES;
    [found.open_percolates(x), found.open_percolates(y), found.contact_percolates(x), found.contact_percolates(y)]
}

#[test]
fn percolation_by_hand() {
    for periodic in [true, false] {
        assert_eq!(percolation(&["....", "....", "....", "...."], periodic), [true, true, false, false]);
        assert_eq!(percolation(&["####", "####", "####", "####"], periodic), [false, false, true, true]);
        assert_eq!(percolation(&["....", "####", "....", "...."], periodic), [true, false, true, false]);
        // corners of the open area are no channel
        assert_eq!(percolation(&[".###", "#.##", "##.#", "###."], periodic), [false, false, true, true]);
    }
    // a staircase of corners seals, but where the cell is periodic the channel beside it winds: both reach from side to side
    let staircase = ["#...", ".#..", "..#.", "...#"];
    assert_eq!(percolation(&staircase, false), [false, false, true, true]);
    assert_eq!(percolation(&staircase, true), [true, true, true, true]);
    // a channel over the seam is open only where the cell is periodic across
    let seam = ["..##", "####", "####", "#..."];
    assert_eq!([true, false].map(|periodic| percolation(&seam, periodic)[0]), [true, false]);
    // it has to share a side there
    assert!(!percolation(&["..##", "####", "####", "##.."], true)[0]);
    // the two sides are not joined: a wall in the middle seals, however the cell goes on
    assert!(!percolation(&["..#.", "..#.", "..#.", "..#."], true)[0]);
}

#[test]
fn one_node_seals_a_line() {
    let line = Grid::line(8, 1.0).unwrap();
    let mask = |touching: &[usize]| Array2::from_shape_fn((1, 8), |(_, x)| touching.contains(&x));
    assert_eq!(statements(&line, &mask(&[])), [true, true, false, false]);
    assert_eq!(statements(&line, &mask(&[3])), [false, true, false, true]);
    assert_eq!(statements(&line, &mask(&[0, 1, 2, 3, 4, 5, 6, 7])), [false, false, true, true]);
    let gap = mask(&[3]).mapv(|touches| if touches { 0.0 } else { 2.0 });
    assert!(leakage(&line, &gap, FlowAxis::X, 1e-6).is_sealed());
    assert_is(leakage(&line, &gap, FlowAxis::Y, 1e-6), 7.0, 1e-12);
    assert!(matches!(Percolation::new(&line, &array![[true]]), Err(FlowError::Shape { .. })));
}

#[test]
fn open_area_and_contact_exclude_each_other() {
    let mut rng = ChaCha8Rng::seed_from_u64(8);
    let (mut seals, mut both) = (0, 0);
    for map in 0..400 {
        let shape = [[5, 7], [12, 9], [16, 16], [30, 20]][map % 4];
        let share = 0.3 + 0.3 * random(&mut rng);
        let mask = Array2::from_shape_fn(shape, |_| random(&mut rng) < share);
        let periodic = Grid::surface(shape, [1.0, 1.0]).unwrap();
        let free = periodic.with_periodic([false, false]);
        let [open_x, open_y, contact_x, contact_y] = statements(&free, &mask);
        // walls: exactly one of the two, as in the game of Hex
        assert!(open_x != contact_y && open_y != contact_x, "{mask}");
        let [open_x, open_y, contact_x, contact_y] = statements(&periodic, &mask);
        // periods: at least one of the two
        assert!((open_x || contact_y) && (open_y || contact_x), "{mask}");
        both += usize::from(open_x && contact_y);
        // nothing flows exactly where the open area does not percolate
        let gap = mask.mapv(|touches| if touches { 0.0 } else { 1.0 });
        for (axis, opens) in AXES.into_iter().zip([open_x, open_y]) {
            let found = leakage(&periodic, &gap, axis, 1e-6);
            assert!(found.is_sealed() != opens && (found.lower > 0.0) == opens, "{found:?}\n{mask}");
            seals += usize::from(!opens);
        }
    }
    assert!((100..700).contains(&seals) && both > 0, "{seals} {both}");
}

fn rough(points: usize, hurst: f64, seed: u64, pressure: f64) -> Problem {
    let grid = Grid::surface([points; 2], [1.0, 1.0]).unwrap();
    let spectrum = Spectrum { hurst, rolloff_wavelength: 0.125, short_cutoff: 8.0 / points as f64, rms_gradient: 1e-2 };
    Problem::new(Surface::rough(grid, &spectrum, seed).unwrap(), ContactModulus(1.0), Load::ReducedPressure(pressure))
        .unwrap()
}

#[test]
fn a_rough_contact_leaks_less_the_more_it_is_pressed_until_it_seals() {
    let mut last = f64::INFINITY;
    for pressure in [0.03, 0.08, 0.14, 0.4] {
        let contact = solve(&Multilevel, &rough(128, 0.8, 1, pressure), 1e-8);
        let grid = *contact.problem.surface().grid();
        let mut gap = contact.gap.clone();
        gap.zip_mut_with(&contact.pressure, |gap, &p| *gap = if p > 0.0 { 0.0 } else { *gap });
        for axis in AXES {
            let found = Leakage::from_contact(&contact, axis, 1e-6).and_then(Leakage::converged).unwrap();
            let exact = reference(&grid, &gap, axis);
            assert!(found.lower <= exact * (1.0 + 1e-11) && exact <= found.upper * (1.0 + 1e-11), "{exact} {found:?}");
            assert_eq!(found.is_sealed(), !Percolation::from_contact(&contact).open_percolates(axis));
        }
        let sigma = Leakage::from_contact(&contact, FlowAxis::X, 1e-6).unwrap().sigma();
        assert!(sigma < 0.5 * last, "{sigma} at {pressure}");
        last = sigma;
    }
    assert_eq!(last, 0.0);
}

/// Close to sealing, the last constrictions are far narrower than all other channels: conductances differ by many orders of magnitude. Groups of
/// cells whose balance is a difference of large conductances take more than 500 steps for this one.
#[test]
fn the_last_constrictions_are_found_in_a_few_steps() {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 0.01, rms_gradient: 1e-3 };
    let surface = Surface::rough(Grid::surface([512; 2], [1.0, 1.0]).unwrap(), &spectrum, 4).unwrap();
    let problem = Problem::new(surface, ContactModulus(1.0), Load::ReducedPressure(0.22)).unwrap();
    let contact = solve(&Multilevel, &problem, 1e-8);
    let [x, y] = AXES.map(|axis| Leakage::from_contact(&contact, axis, 1e-6).and_then(Leakage::converged).unwrap());
    assert!(x.is_sealed() && !y.is_sealed() && y.steps < 100, "{} steps", y.steps);
    assert!(y.lower <= y.upper && y.upper < 1e-2 * contact.mean_gap().powi(3), "{} {}", y.lower, y.upper);
}

/// One gap in a wall carries all of the fluid: there the flux is the mean times the width over that of the gap.
#[test]
fn the_flux_is_the_largest_in_the_constriction() {
    let shape = [12, 20];
    let grid = Grid::surface(shape, [0.6, 2.0]).unwrap().with_periodic([false, true]);
    let gap = Field::from_shape_fn(shape, |(y, x)| if x == 7 && y != 4 { 0.0 } else { 1.0 });
    let found = leakage(&grid, &gap, FlowAxis::X, 1e-10);
    let most = found.flux.indexed_iter().max_by(|a, b| a.1.total_cmp(b.1)).unwrap();
    assert!(most.0 == (4, 7) && (most.1 / 12.0 - 1.0).abs() < 1e-4, "{most:?}");
    assert!((0..12).all(|y| y == 4 || found.flux[[y, 7]] == 0.0 && found.pressure[[y, 7]].is_nan()));
    // far from the wall the flow is uniform, and the pressure falls from 1 to 0
    assert!(found.flux.column(19).iter().all(|flux| (flux - 1.0).abs() < 5e-3), "{}", found.flux.column(19));
    assert!(found.pressure.column(0).iter().all(|&p| p > 0.9) && found.pressure.column(19).iter().all(|&p| p < 0.1));
    // turned by a right angle, it is the same
    let turned = Grid::surface([20, 12], [2.0, 0.6]).unwrap().with_periodic([true, false]);
    let along_y = leakage(&turned, &gap.t().to_owned(), FlowAxis::Y, 1e-10);
    let apart = |(a, b): (&f64, &f64)| (a - b).abs();
    assert!(along_y.flux.t().iter().zip(&found.flux).map(apart).fold(0.0, f64::max) < 1e-4);
    // and in a plain gap on cells of any form it is 1 everywhere
    let plain = leakage(&grid, &Field::ones(shape), FlowAxis::Y, 1e-10);
    assert!(plain.flux.iter().all(|flux| (flux - 1.0).abs() < 1e-9), "{}", plain.flux);
    let shut = leakage(&grid, &Field::zeros(shape), FlowAxis::X, 1e-6);
    assert!(shut.flux.iter().all(|&flux| flux == 0.0) && shut.pressure.iter().all(|pressure| pressure.is_nan()));
}

/// Along each channel of the gap, `J = g^3 grad P` over its mean is `g^3/<g^3>`.
#[test]
fn the_flux_along_waves_follows_the_cube_of_the_gap() {
    let grid = Grid::surface([16, 24], [1.0, 3.0]).unwrap();
    let gap = Field::from_shape_fn([16, 24], |(_, x)| 1.0 + 0.6 * (TAU * x as f64 / 24.0).cos());
    let found = leakage(&grid, &gap, FlowAxis::Y, 1e-10);
    for ((_, x), flux) in found.flux.indexed_iter() {
        assert!((flux - gap[[0, x]].powi(3) / 1.54).abs() < 1e-6, "{flux} at {x}");
    }
    for ((y, _), pressure) in found.pressure.indexed_iter() {
        assert!((pressure - (1.0 - (y as f64 + 0.5) / 16.0)).abs() < 1e-6, "{pressure} at {y}");
    }
}

fn sealing(problem: &Problem, axis: FlowAxis, width: f64) -> Result<PercolationLoad, SealError> {
    PercolationLoad::new(problem, &Multilevel, &Stop::default(), axis, width, |_| ())
}

/// Troughs of a sine stay open along their length until everything touches, at `pi E* D/L`. Across them they are shut under any load.
#[test]
fn troughs_are_sealed_along_their_length_by_full_contact() {
    let grid = Grid::surface([32, 32], [1.0, 1.0]).unwrap();
    let waves = Field::from_shape_fn([32, 32], |(_, x)| 0.01 * (TAU * x as f64 / 32.0).cos());
    let surface = Surface::new(grid, waves).unwrap();
    let problem = Problem::new(surface, ContactModulus(3.0), Load::ReducedPressure(0.1)).unwrap();
    let found = sealing(&problem, FlowAxis::Y, 1e-5).unwrap();
    let exact = PI * 3.0 * 0.01;
    let [open, sealed] = [found.open, found.sealed].map(|it| it.mean_pressure);
    assert!(open < exact * (1.0 + 1e-9) && exact < sealed * (1.0 + 1e-9) && found.width() <= 1e-5, "{found:?}");
    assert_eq!(found.sealed.relative_area_counted, 1.0);
    assert!(matches!(sealing(&problem, FlowAxis::X, 0.1), Err(SealError::Always { axis: "x", .. })));
}

/// The load found by bisection is that of a scan of contacts that are solved one by one, and no other load of the scan opens the gap again.
#[test]
fn the_load_that_seals_is_that_of_a_scan() {
    for (problem, scan) in [(rough(128, 0.8, 3, 0.1), 0.02..0.4), (crossed_waves(), 0.02..1.0)] {
        let step = (scan.end - scan.start) / 40.0;
        let loads: Vec<f64> = (0..40).map(|i| scan.start + step * f64::from(i)).collect();
        let opens = |axis: FlowAxis| -> Vec<bool> {
            let contact = |&load: &f64| {
                let problem = problem.clone().with_load(Load::ReducedPressure(load)).unwrap();
                Percolation::from_contact(&solve(&Multilevel, &problem, 1e-8)).open_percolates(axis)
            };
            loads.iter().map(contact).collect()
        };
        for axis in AXES {
            let (found, opens) = (sealing(&problem, axis, 1e-3).unwrap(), opens(axis));
            let shut = opens.iter().position(|is_open| !is_open).unwrap();
            assert!(shut > 0 && opens[shut..].iter().all(|is_open| !is_open), "{opens:?}");
            let [open, sealed] = [found.open, found.sealed].map(|it| it.reduced_pressure);
            assert!(
                loads[shut - 1] < sealed && open < loads[shut] && found.width() <= 1e-3,
                "{found:?} {}",
                loads[shut]
            );
            assert!(found.open.relative_area_counted <= found.sealed.relative_area_counted, "{found:?}");
            assert!(found.open.mean_gap > found.sealed.mean_gap, "{found:?}");
        }
    }
}

/// Waves along both axes, of which those along `y` are half as high.
fn crossed_waves() -> Problem {
    let grid = Grid::surface([40, 40], [1.0, 1.0]).unwrap();
    let wave = |i: usize| (TAU * i as f64 / 40.0).cos();
    let height = Field::from_shape_fn([40, 40], |(y, x)| 0.01 * (wave(x) + 0.5 * wave(y)));
    Problem::new(Surface::new(grid, height).unwrap(), ContactModulus(1.0), Load::ReducedPressure(0.1)).unwrap()
}

#[test]
fn surfaces_without_a_load_that_seals_are_refused() {
    let problem = rough(128, 0.8, 1, 0.1);
    for width in [0.0, 1.0, f64::NAN] {
        assert!(matches!(sealing(&problem, FlowAxis::X, width), Err(SealError::Width { .. })));
    }
    let line = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(64, 1.0).unwrap()).unwrap();
    let line = Problem::new(line, ContactModulus(1.0), Load::ReducedPressure(0.1)).unwrap();
    assert!(matches!(sealing(&line, FlowAxis::X, 0.1), Err(SealError::Line)));
}

/// A very soft body fills what is highest first: along x the gap is shut once the saddles touch, which are half of the higher waves high.
#[test]
fn a_soft_body_seals_at_the_height_of_the_saddles() {
    let hardness = 1e-6;
    let light = crossed_waves().with_load(Load::ReducedPressure(1e-9)).unwrap();
    let soft = light.with_law(Law::Hardness(hardness)).unwrap();
    let found = sealing(&soft, FlowAxis::X, 1e-3).unwrap();
    let touching = soft.height().iter().filter(|&&height| height > 0.005 - 1e-9).count() as f64 / 1600.0;
    assert!((found.sealed.relative_area_counted - touching).abs() < 5e-3, "{found:?} {touching}");
    assert!((found.sealed.mean_pressure / hardness - touching).abs() < 5e-3 && found.sealed.mean_pressure < hardness);
}

fn conductance(contact: &Contact) -> Conductance {
    Conductance::new(contact, [0.5, 1.5]).unwrap()
}

/// The sum of the resistivities of [`conductance`].
const RESISTIVITY: f64 = 2.0;

#[test]
fn strips_conduct_by_their_closed_form() {
    let (length, amplitude) = (3.0, 0.01);
    for modulus in [1.0, 7e9] {
        for sin_psi in [0.3f64, 0.6, 0.9] {
            // Westergaard: the mean pressure is p_full sin^2 psi
            let pressure = PI * modulus * amplitude / length * sin_psi.powi(2);
            let sine = Indenter::Sine { amplitude }.surface(Grid::line(4096, length).unwrap()).unwrap();
            let problem = Problem::new(sine, ContactModulus(modulus), Load::MeanPressure(pressure)).unwrap();
            let found = conductance(&solve(&Multilevel, &problem, 1e-8));
            let exact = PI / (RESISTIVITY * length * (1.0 / sin_psi).ln());
            assert!((found.per_area / exact - 1.0).abs() < 0.005, "{} for {exact}", found.per_area);
            assert!((found.total / found.per_area / length - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn a_full_contact_constricts_nothing() {
    let sine = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(256, 1.0).unwrap()).unwrap();
    let problem = Problem::new(sine, ContactModulus(1.0), Load::MeanPressure(0.05)).unwrap();
    assert_eq!(conductance(&solve(&Multilevel, &problem, 1e-8)).per_area, f64::INFINITY);
}

/// Holm: 4 a over the sum of the resistivities, for a flat disc and for the disc of a sphere.
#[test]
fn discs_conduct_by_their_radius() {
    let grid = Grid::surface([256, 256], [1.0, 1.0]).unwrap().with_periodic([false, false]);
    let punch = Indenter::Punch { half_width: 0.2, depth: 1.0 };
    for (indenter, force) in [(Indenter::Sphere { radius: 1.0 }, 4.0 / 3.0 * 0.008), (punch, 0.01)] {
        let surface = indenter.surface(grid).unwrap();
        let problem = Problem::new(surface, ContactModulus(1.0), Load::Force(force)).unwrap();
        let found = conductance(&solve(&Multilevel, &problem, 1e-8)).total;
        let exact = 4.0 * 0.2 / RESISTIVITY;
        assert!((found / exact - 1.0).abs() < 0.015, "{}: {found} for {exact}", indenter.name());
    }
}

/// A patch that touches all over on a free boundary is a constriction too: it conducts by the capacity of a square plate.
#[test]
fn a_square_in_full_contact_conducts_as_an_electrode() {
    let grid = Grid::surface([128, 128], [1.0, 1.0]).unwrap().with_periodic([false, false]);
    let flat = Surface::new(grid, Field::from_shape_fn([128, 128], |(y, x)| 1e-9 * (x + y) as f64)).unwrap();
    let problem = Problem::new(flat, ContactModulus(1.0), Load::Force(1.0)).unwrap();
    let contact = solve(&Multilevel, &problem, 1e-8);
    assert_eq!(contact.counted().relative_area, 1.0);
    // the capacity of a square plate of side 1 is 0.36679, and that of a disc 2 a / pi, which conducts as 4 a
    let exact = 4.0 * 0.366_79 * PI / 2.0 / RESISTIVITY;
    let found = conductance(&contact).total;
    assert!((found / exact - 1.0).abs() < 0.01, "{found} for {exact}");
}

#[test]
fn nodes_that_yield_conduct_as_well() {
    let wall = rough(128, 0.8, 2, 0.05);
    let elastic = solve(&Multilevel, &wall, 1e-8);
    let hard = solve(&Multilevel, &wall.clone().with_law(Law::Hardness(2.0 * elastic.max_pressure())).unwrap(), 1e-8);
    let [a, b] = [&elastic, &hard].map(|contact| conductance(contact).per_area);
    assert!((a / b - 1.0).abs() < 1e-3, "a hardness above all pressures changes {a} to {b}");
    let soft = solve(&Multilevel, &wall.with_law(Law::Hardness(0.3 * elastic.max_pressure())).unwrap(), 1e-8);
    assert!(soft.plasticity().area > 0.005, "{:?}", soft.plasticity());
    // the set is larger than that of the elastic contact, though fewer nodes are free
    assert!(conductance(&soft).per_area > a && soft.stiffness() < soft.stiffness_of_all());
}

#[test]
fn conductances_that_do_not_follow_from_the_stiffness_are_refused() {
    let problem = rough(128, 0.8, 1, 0.05);
    let contact = solve(&Multilevel, &problem, 1e-6);
    for resistivities in [[0.0, 0.0], [-1.0, 2.0], [f64::NAN, 1.0], [1.0, f64::INFINITY]] {
        let refused = Conductance::new(&contact, resistivities);
        assert!(matches!(refused, Err(FlowError::Resistivity { .. })), "{refused:?}");
    }
    let layer = Layer { contact_modulus: 1.0, poisson: 0.3, thickness: 0.1, base: Default::default() };
    let on_layer = Problem::new(problem.surface().clone(), layer, Load::ReducedPressure(0.05)).unwrap();
    let refused = Conductance::new(&solve(&Multilevel, &on_layer, 1e-6), [1.0, 1.0]);
    assert!(matches!(refused, Err(FlowError::NeedsHalfSpace { .. })), "{refused:?}");
    let moving = problem.sliding(0.1, &[(2.0, 1.0)]).unwrap();
    let refused = Conductance::new(&solve(&asperity::contact::MonotoneSets, &moving, 1e-6), [1.0, 1.0]);
    assert_eq!(refused, Err(FlowError::NeedsRest));
}
