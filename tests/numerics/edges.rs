//! The edges of contacts between the nodes, against exact solutions and finer grids.

use crate::common::solve;
use asperity::contact::{
    Contact, ContactModulus, Law, Load, Multilevel, NODE_EXCESS_PER_SWITCH_LINE, NODE_EXCESS_PER_SWITCH_SURFACE,
};
use asperity::surface::{Field, Spectrum};
use asperity::theory::{Periodic, Westergaard, counting_excess, crossed_full_pressure};
use asperity::{Grid, Indenter, Problem, Surface};
use ndarray::Array1;
use std::f64::consts::{FRAC_PI_4, PI, TAU};

const AMPLITUDE: f64 = 0.01;
const WAVE: Westergaard = Westergaard { amplitude: AMPLITUDE, period: 1.0, contact_modulus: 1.0 };

fn pressed(surface: Surface, pressure: f64, tolerance: f64) -> Contact {
    let problem = Problem::new(surface, ContactModulus(1.0), Load::MeanPressure(pressure)).unwrap();
    solve(&Multilevel, &problem, tolerance)
}

/// A line of `n` nodes, the crest of whose shape lies `place` spacings after one of them.
fn line(n: usize, place: f64, shape: impl Fn(f64) -> f64) -> Surface {
    let height: Array1<f64> = (0..n).map(|i| shape((i as f64 - (n / 2) as f64 - place) / n as f64)).collect();
    Surface::line(height.view(), 1.0).unwrap()
}

/// Root mean square over places of the relative errors of area and `kappa_r`: counted, corrected, resolved.
fn errors(n: usize, exact: [f64; 2], pressure: f64, shape: impl Fn(f64) -> f64) -> [[f64; 2]; 3] {
    const PLACES: usize = 6;
    let mut squares = [[0.0; 2]; 3];
    for i in 0..PLACES {
        let contact = pressed(line(n, (i as f64 + 0.31) / PLACES as f64, &shape), pressure, 1e-13);
        let (counted, resolved) = (contact.counted(), contact.resolved());
        let found = [
            [counted.relative_area, counted.kappa_r],
            [counted.relative_area_corrected, counted.kappa_r_corrected],
            [resolved.relative_area, resolved.kappa_r],
        ];
        for (squares, found) in squares.iter_mut().zip(found) {
            (0..2).for_each(|i| squares[i] += (found[i] / exact[i] - 1.0).powi(2) / PLACES as f64);
        }
    }
    squares.map(|both| both.map(f64::sqrt))
}

/// The orders of convergence of counted, corrected and resolved area and `kappa_r` between the ends of a ladder of grids, which is
/// printed.
fn orders(name: &str, ladder: &[usize], exact: [f64; 2], pressure: f64, shape: impl Fn(f64) -> f64) -> [[f64; 2]; 3] {
    println!("{name:<10} points  area: counted corrected resolved   kappa_r: counted corrected resolved");
    let rows: Vec<[[f64; 2]; 3]> = ladder.iter().map(|&n| errors(n, exact, pressure, &shape)).collect();
    for (n, [a, b, c]) in ladder.iter().zip(&rows) {
        println!("{n:>17} {:>14.1e} {:>9.1e} {:>8.1e} {:>18.1e} {:>9.1e} {:>8.1e}", a[0], b[0], c[0], a[1], b[1], c[1]);
    }
    let (first, last) = (rows[0], rows[rows.len() - 1]);
    let doublings = (ladder[ladder.len() - 1] as f64 / ladder[0] as f64).log2();
    let order = |kind: usize, of: usize| (first[kind][of] / last[kind][of]).log2() / doublings;
    [0, 1, 2].map(|kind| [0, 1].map(|of| order(kind, of)))
}

const LADDER: [usize; 5] = [1 << 6, 1 << 8, 1 << 10, 1 << 12, 1 << 14];

#[test]
fn resolved_area_and_kappa_r_of_a_sine_are_of_second_order() {
    let half = 0.15;
    let area = 2.0 * half;
    let pressure = WAVE.full_pressure() * (PI * half).sin().powi(2);
    assert!((WAVE.relative_area(pressure) - area).abs() < 1e-12);
    let exact = [area, WAVE.kappa_r(pressure)];
    let [counted, _, resolved] = orders("sine", &LADDER, exact, pressure, |x| AMPLITUDE * (TAU * x).cos());
    assert!(resolved.iter().all(|order| *order > 1.8), "{resolved:?}");
    assert!(counted.iter().all(|order| *order < 1.3), "{counted:?}");
}

#[test]
fn resolved_area_and_kappa_r_of_cylinder_and_cubic_are_of_second_order() {
    for exponent in [2.0, 3.0] {
        let half = 0.12;
        let slope = |x: f64| 0.1 * exponent * x.powf(exponent - 1.0);
        let exact = Periodic { slope, period: 1.0, contact_modulus: 1.0 };
        let shape = |x: f64| -0.1 * x.abs().powf(exponent);
        let name = format!("|x|^{exponent}");
        let [_, _, resolved] = orders(&name, &LADDER, [2.0 * half, exact.kappa_r(half)], exact.load(half), shape);
        assert!(resolved.iter().all(|order| *order > 1.8), "{exponent}: {resolved:?}");
    }
}

#[test]
fn the_kink_of_a_wedge_leaves_first_order_and_a_punch_says_that_its_edges_are_given() {
    let half = 0.12;
    let exact = Periodic { slope: |_: f64| 0.05, period: 1.0, contact_modulus: 1.0 };
    let exact = [2.0 * half, exact.kappa_r(half)];
    let load = Periodic { slope: |_: f64| 0.05, period: 1.0, contact_modulus: 1.0 }.load(half);
    let [_, _, [area, _]] = orders("wedge", &LADDER, exact, load, |x| -0.05 * x.abs());
    assert!(area > 0.9, "{area}");
    let punch = Indenter::Punch { half_width: 0.2, depth: 0.1 }.surface(Grid::line(512, 1.0).unwrap()).unwrap();
    let contact = pressed(punch, 0.01, 1e-12);
    let resolved = contact.resolved();
    assert_eq!((resolved.edges, resolved.edges_of_shape), (2, 2));
    assert_eq!(resolved.relative_area, contact.counted().relative_area);
    assert!(resolved.kappa_r.is_nan() && resolved.rms_gradient_contact.is_nan());
}

#[test]
fn the_mean_excess_of_counting_is_that_of_theory_at_any_angle() {
    let along = counting_excess(0.0);
    assert!((along - NODE_EXCESS_PER_SWITCH_LINE).abs() < 1e-5, "{along}");
    let angles = (0..24).map(|i| (i as f64 + 0.5) / 24.0 * FRAC_PI_4);
    let mean = angles.map(counting_excess).sum::<f64>() / 24.0;
    // an edge of unit length has (4 / pi) switches a spacing, averaged over its directions
    let per_switch = mean * FRAC_PI_4;
    assert!((per_switch / NODE_EXCESS_PER_SWITCH_SURFACE - 1.0).abs() < 3e-3, "{per_switch}");
}

/// The crossed lattice wave `cos 2 pi (a x + b y)` on the unit cell: a line contact at an angle to the grid.
fn oblique([a, b]: [i32; 2], n: usize, place: f64) -> Surface {
    let wave = |(y, x): (usize, usize)| {
        let turns = (f64::from(a) * (x as f64 + place) + f64::from(b) * y as f64) / n as f64;
        AMPLITUDE * (TAU * turns).cos()
    };
    Surface::new(Grid::surface([n, n], [1.0, 1.0]).unwrap(), Field::from_shape_fn([n, n], wave)).unwrap()
}

#[test]
fn the_law_of_the_edge_holds_along_lattice_directions_and_nearly_between() {
    const PLACES: usize = 7;
    for direction in [[1, 0], [1, 1], [2, 1], [3, 1], [3, 2]] {
        let [a, b] = direction.map(f64::from);
        let wavenumber = a.hypot(b);
        let wave = Westergaard { period: 1.0 / wavenumber, ..WAVE };
        let pressure = 0.3 * wave.full_pressure();
        let n = 64 * (wavenumber.ceil() as usize);
        let (mut counted, mut resolved) = (0.0, 0.0);
        for i in 0..PLACES {
            let contact = pressed(oblique(direction, n, (i as f64 + 0.3) / PLACES as f64), pressure, 1e-12);
            counted += contact.counted().relative_area / PLACES as f64;
            resolved += contact.resolved().relative_area / PLACES as f64;
        }
        // as a distance of each edge, of which there are two to a wave
        let spacings = |area: f64| (area - wave.relative_area(pressure)) * n as f64 / wavenumber / 2.0;
        let excess = counting_excess(b.atan2(a));
        println!("{direction:?}: counted {:.4} of {excess:.4}, resolved {:.4}", spacings(counted), spacings(resolved));
        assert!((spacings(counted) - excess).abs() < 0.03, "{direction:?}");
        assert!(spacings(resolved).abs() < 0.005, "{direction:?}: {}", spacings(resolved));
    }
}

/// Errors of the area of surfaces on a ladder of grids, which is printed: counted, corrected, resolved. The limit is that of the
/// resolved area on the two finest grids.
fn ladder(name: &str, sides: &[usize], pressure: f64, surface: impl Fn(usize) -> Surface) -> Vec<[f64; 3]> {
    let contacts: Vec<Contact> = sides.iter().map(|&n| pressed(surface(n), pressure, 1e-12)).collect();
    let [.., fine, finest] = contacts.as_slice() else { panic!("give two grids") };
    let [fine, finest] = [fine, finest].map(|contact| contact.resolved().relative_area);
    let limit = finest + (finest - fine) / 3.0;
    println!("{name:<13} points  area: counted corrected resolved");
    let errors = |(n, contact): (&usize, &Contact)| {
        let counted = contact.counted();
        let areas = [counted.relative_area, counted.relative_area_corrected, contact.resolved().relative_area];
        let [counted, corrected, resolved] = areas.map(|area| area / limit - 1.0);
        println!("{n:>20} {counted:>14.1e} {corrected:>9.1e} {resolved:>8.1e}");
        [counted, corrected, resolved]
    };
    sides.iter().zip(&contacts).map(errors).collect()
}

#[test]
fn contours_of_spheres_and_crossed_sines_are_of_second_order() {
    const SIDES: [usize; 6] = [64, 128, 256, 512, 1024, 2048];
    let grid = |n: usize| Grid::surface([n, n], [1.0, 1.0]).unwrap();
    let sphere = |n: usize| {
        let square = |i: usize, crest: f64| (i as f64 / n as f64 - crest).powi(2);
        let height = |(y, x): (usize, usize)| -0.5 * (square(x, 0.5137) + square(y, 0.4871));
        Surface::new(grid(n), Field::from_shape_fn([n, n], height)).unwrap()
    };
    let crossed = |n: usize| {
        let wave = |i: usize| (TAU * (i as f64 / n as f64 + 0.013)).cos();
        Surface::new(grid(n), Field::from_shape_fn([n, n], |(y, x)| AMPLITUDE * wave(x) * wave(y))).unwrap()
    };
    let hertz = 4.0 / 3.0 * 0.06f64.powi(3);
    let full = crossed_full_pressure(AMPLITUDE, [1.0, 1.0], 1.0);
    let errors = ladder("sphere", &SIDES, hertz, sphere);
    let order = (errors[0][2] / errors[4][2]).abs().log2() / 4.0;
    assert!(order > 1.8, "{order}");
    assert!(errors[..5].iter().all(|[counted, _, resolved]| resolved.abs() < 0.2 * counted), "{errors:?}");
    let errors = ladder("crossed sine", &SIDES, 0.2 * full, crossed);
    assert!(errors[..5].iter().all(|[counted, _, resolved]| resolved.abs() < 0.01 * counted), "{errors:?}");
}

/// The paper's line with fewer waves, on `n` points of the finest grid of `finest`.
fn rough_line(hurst: f64, seed: u64, finest: usize) -> Surface {
    let spectrum = Spectrum { hurst, rolloff_wavelength: 0.125, short_cutoff: 0.125 / 64.0, rms_gradient: 1e-3 };
    Surface::rough(Grid::line(finest, 1.0).unwrap(), &spectrum, seed).unwrap()
}

fn every(surface: &Surface, stride: usize) -> Surface {
    let height: Array1<f64> = surface.heights().iter().step_by(stride).copied().collect();
    Surface::line(height.view(), 1.0).unwrap()
}

#[test]
fn resolved_values_of_rough_lines_are_of_second_order_and_their_told_error_holds() {
    const FINEST: usize = 1 << 17;
    println!("   H seed   p*     points  kappa_r: counted corrected resolved     told");
    let mut told = Vec::new();
    for (hurst, seed) in [(0.2, 1), (0.5, 2), (0.8, 3)] {
        let surface = rough_line(hurst, seed, FINEST);
        for load in [0.01, 0.3] {
            let solve = |stride: usize| pressed(every(&surface, stride), load * 1e-3, 1e-9);
            let [fine, finest] = [2, 1].map(|stride| solve(stride).resolved().kappa_r);
            let limit = finest + (finest - fine) / 3.0;
            let mut errors = Vec::new();
            for stride in [64, 32, 16, 8, 4] {
                let contact = solve(stride);
                let found =
                    [contact.counted().kappa_r, contact.counted().kappa_r_corrected, contact.resolved().kappa_r];
                let [counted, corrected, resolved] = found.map(|found| found / limit - 1.0);
                let error = contact.resolution().kappa_r_error;
                println!(
                    "{hurst:>4} {seed:>4} {load:>5} {:>9} {counted:>17.1e} {corrected:>9.1e} {resolved:>8.1e} {error:>8.1e}",
                    FINEST / stride
                );
                assert!(counted.abs() > 2.0 * resolved.abs(), "{hurst} {load} {stride}");
                told.push(error / resolved.abs());
                errors.push(resolved.abs());
            }
            let order = (errors[2] / errors[4]).log2() / 2.0;
            assert!(order > 1.6, "{hurst} {load}: {order}");
        }
    }
    assert_eq!(told.len(), 30);
    let least = told.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(least > 1.0 / 3.0, "an error was told to be {least} of the true one");
}

#[test]
fn segments_end_at_their_edges_and_go_across_the_period() {
    let half = 0.15;
    let pressure = WAVE.full_pressure() * (PI * half).sin().powi(2);
    let crest_at = |place: f64| {
        let height: Array1<f64> = (0..200).map(|i| AMPLITUDE * (TAU * (i as f64 / 200.0 - place)).cos()).collect();
        pressed(Surface::line(height.view(), 1.0).unwrap(), pressure, 1e-13).edges().segments()
    };
    for place in [0.5012, 0.9537, 0.0013] {
        let segments = crest_at(place);
        let [[start, end]] = segments[..] else { panic!("{segments:?}") };
        let wrapped = if place < half { place + 1.0 } else { place };
        assert!(
            (start - (wrapped - half)).abs() < 1e-4 && (end - (wrapped + half)).abs() < 1e-4,
            "{place}: {segments:?}"
        );
    }
}

#[test]
fn a_contour_goes_around_a_contact_between_the_nodes() {
    let n = 64;
    let square = |i: usize, crest: f64| (i as f64 - crest).powi(2) / (n * n) as f64;
    let height = Field::from_shape_fn([n, n], |(y, x)| -0.5 * (square(x, 30.3) + square(y, 33.7)));
    let surface = Surface::new(Grid::surface([n, n], [1.0, 1.0]).unwrap(), height).unwrap();
    let contact = pressed(surface, 4.0 / 3.0 * 0.15f64.powi(3), 1e-12);
    let contour = contact.edges().contour();
    let ends: Vec<[f64; 2]> = contour.iter().flatten().copied().collect();
    for [y, x] in &ends {
        let radius = (x - 30.3).hypot(y - 33.7) / n as f64;
        assert!((radius / 0.15 - 1.0).abs() < 0.03, "{radius}");
    }
    // closed: as many lines end at each place as begin there
    for end in &ends {
        assert_eq!(ends.iter().filter(|other| *other == end).count() % 2, 0, "{end:?}");
    }
    let area: f64 = contour.iter().map(|[[ay, ax], [by, bx]]| 0.5 * (ax * by - bx * ay)).sum();
    assert!((area.abs() / (n * n) as f64 / contact.resolved().relative_area - 1.0).abs() < 0.01, "{area}");
}

#[test]
fn a_node_in_contact_has_an_area_that_is_not_negative() {
    for n in [16, 17] {
        let grid = Grid::surface([n, n], [1.0, 1.0]).unwrap();
        let spikes = |(y, x): (usize, usize)| if y % 5 == 2 && x % 5 == 3 { 1.0 + 0.01 * x as f64 } else { 0.0 };
        let surface = Surface::new(grid, Field::from_shape_fn([n, n], spikes)).unwrap();
        for pressure in [1e-9, 1e-3, 0.1] {
            let resolved = pressed(surface.clone(), pressure, 1e-10).resolved();
            assert!(resolved.relative_area >= 0.0 && resolved.relative_area < 0.2, "{resolved:?}");
        }
    }
}

/// Errors of the area and of `kappa_r`, told and true, of a rough line whose heights are rounded to few values, at `refine` times its
/// points, against the same heights unrounded on a fine grid.
fn rounded(values: f64, points: usize, refine: usize) -> [[f64; 2]; 2] {
    const FINEST: usize = 1 << 16;
    let fine = rough_line(0.8, 2, FINEST);
    let [low, high] = [f64::min, f64::max].map(|pick| fine.heights().iter().copied().reduce(pick).unwrap());
    let step = (high - low) / values;
    let sampled = every(&fine, FINEST / points);
    let height = Array1::from_iter(sampled.heights().iter().map(|h| step * (h / step).round()));
    let surface = Surface::line(height.view(), 1.0).unwrap().refined(refine).unwrap();
    let (contact, exact) = (pressed(surface, 2e-5, 1e-9), pressed(fine, 2e-5, 1e-9).resolved());
    let (found, resolution) = (contact.resolved(), contact.resolution());
    let errors = [(found.relative_area, exact.relative_area), (found.kappa_r, exact.kappa_r)];
    [
        [resolution.relative_area_error, resolution.kappa_r_error],
        errors.map(|(found, exact)| (found / exact - 1.0).abs()),
    ]
}

#[test]
fn the_error_of_rounded_heights_is_told_and_refinement_does_not_hide_it() {
    for values in [16.0, 64.0, 256.0] {
        for points in [1024, 4096] {
            for refine in [1, 2, 4] {
                let [told, wrong] = rounded(values, points, refine);
                println!("{values:>5} {points:>5} {refine} told {told:.3?} true {wrong:.3?}");
                for (told, wrong) in told.into_iter().zip(wrong) {
                    assert!(
                        told.is_nan() || wrong.is_nan() || told > wrong / 3.0,
                        "{values} {points} {refine}: told {told} of {wrong}"
                    );
                }
            }
        }
    }
}

#[test]
fn smooth_and_rough_heights_have_no_plateaus() {
    let grid = Grid::surface([64, 64], [1.0, 1.0]).unwrap();
    // a crest between two nodes, and a ridge along y
    let ridge = Field::from_shape_fn([64, 64], |(_, x)| -(x as f64 - 31.5).powi(2));
    let spectrum = Spectrum { hurst: 0.5, rolloff_wavelength: 0.5, short_cutoff: 0.1, rms_gradient: 0.1 };
    for surface in [Surface::new(grid, ridge).unwrap(), Surface::rough(grid, &spectrum, 1).unwrap()] {
        for refine in [1, 2] {
            let contact = pressed(surface.refined(refine).unwrap(), 1e-3, 1e-9);
            assert_eq!(contact.resolution().level_share, 0.0);
        }
    }
}

#[test]
fn the_face_of_a_punch_is_known_and_that_of_a_measured_one_is_not() {
    let punch = Indenter::Punch { half_width: 0.2, depth: 0.1 }.surface(Grid::line(256, 1.0).unwrap()).unwrap();
    let measured = Surface::new(*punch.grid(), punch.heights_as_given()).unwrap();
    let [known, unknown] = [punch, measured].map(|surface| pressed(surface, 1e-3, 1e-9).resolution());
    assert!(known.level_share == 0.0 && known.relative_area_error < 0.05, "{known:?}");
    assert!(unknown.level_share == 1.0 && unknown.kappa_r_error.is_nan(), "{unknown:?}");
}

/// The area at a hardness of rough lines, held against grids that are 16 times as fine. The edges are jumps of the pressure there, or nearly so.
#[test]
fn areas_at_a_hardness_are_those_of_finer_grids() {
    const FINER: usize = 16;
    let mut squares = 0.0;
    let mut cases = 0.0;
    for seed in 1..=24 {
        let points = [64, 96, 128][seed as usize % 3];
        let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.5, short_cutoff: 0.1, rms_gradient: 0.1 };
        let line = Surface::rough(Grid::line(points, 1.0).unwrap(), &spectrum, seed).unwrap();
        let hardness = [0.003, 0.01, 0.03][seed as usize / 3 % 3];
        let under = |surface: Surface| {
            let load = Load::MeanPressure(hardness * [0.1, 0.3][seed as usize % 2]);
            let problem = Problem::new(surface, ContactModulus(1.0), load).unwrap();
            solve(&Multilevel, &problem.with_law(Law::Hardness(hardness)).unwrap(), 1e-12)
        };
        let (fine, contact) = (under(line.refined(FINER).unwrap()), under(line));
        let (resolved, exact) = (contact.resolved(), fine.counted().relative_area_corrected);
        let off = resolved.relative_area - exact;
        // the fine grid counts nodes, which leaves half a node an edge
        let of_fine = 0.5 * fine.counted().switches as f64 / (FINER * points) as f64;
        let told = contact.resolution().relative_area_error * resolved.relative_area;
        assert!(off.abs() < 1.5 * told + of_fine, "seed {seed}: {off:e} {told:e} {of_fine:e}");
        squares += (off * points as f64 / resolved.edges as f64).powi(2);
        cases += 1.0;
    }
    let rms = f64::sqrt(squares / cases);
    println!("off by {rms:.3} spacings an edge");
    assert!(rms < 0.03, "{rms}");
}

/// Where all of a contact is at the hardness, its area is the load over the hardness, on any grid.
#[test]
fn a_small_saturated_contact_covers_the_load_over_the_hardness() {
    for (points, share) in [(24, 0.02), (32, 0.03), (48, 0.01), (48, 0.1)] {
        let grid = Grid::surface([points; 2], [1.0; 2]).unwrap();
        let sphere = Indenter::Sphere { radius: 1.0 }.surface(grid).unwrap();
        let hardness = 1e-3;
        let problem = Problem::new(sphere, ContactModulus(1.0), Load::MeanPressure(share * hardness)).unwrap();
        let contact = solve(&Multilevel, &problem.with_law(Law::Hardness(hardness)).unwrap(), 1e-12);
        let (area, counted) = (contact.resolved().relative_area, contact.counted().relative_area);
        println!("{points} points, {} nodes: {area:.6}, counted {counted:.6}", contact.counted().contact_nodes);
        assert!((area / share - 1.0).abs() < 0.01, "{area} {counted}");
        let told = contact.resolution().relative_area_error;
        assert!(told > 1e-3 && told < 0.5, "{told}");
    }
}
