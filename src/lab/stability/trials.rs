//! All trials, by what is extreme about them.

use super::shapes::{
    SurfaceMaker, SurfaceResult, noise, offset, plateaus, rough, rough_with, shaped, spike, two_peaks,
};
use super::solids::{free, layers};
use super::trial::{EquivalentContact, Trial};
use super::verdict::Demand;
use crate::contact::{ContactModulus, Law, Load, Multilevel, Problem, Solver, Stop};
use crate::error::SetupError;
use crate::grid::Grid;
use crate::lab::Rival;
use crate::surface::{Indenter, Surface};
use crate::theory::{Westergaard, crossed_full_pressure};

/// The load of most trials.
const LOAD: Load = Load::ReducedPressure(0.05);
/// Mean pressure over the modulus, where that is varied.
const STRAIN: f64 = 0.01;
/// Amplitude of waves.
const AMPLITUDE: f64 = 0.01;

/// The line and the surface of most trials, of length 1, with their names.
type Grids = [(&'static str, Grid); 2];

/// All trials, small ones if `is_quick`.
///
/// # Errors
/// None that is known: the grids are fixed.
pub fn trials(is_quick: bool) -> Result<Vec<Trial>, SetupError> {
    let [points, side] = if is_quick { [1 << 10, 32] } else { [1 << 12, 128] };
    let (line, surface) = (Grid::line(points, 1.0)?, Grid::surface([side; 2], [1.0; 2])?);
    let grids = [("line", line), ("surface", surface)];
    let mut trials = loads(grids);
    trials.extend(around_full_contact(line, surface));
    trials.extend(gaps(grids));
    for (kind, grid) in grids {
        trials.extend(hardnesses(kind, grid)?);
    }
    trials.extend(layers(grids));
    trials.extend(free()?);
    trials.extend(narrow(line, surface));
    trials.extend(units(points));
    trials.extend(heights(grids));
    trials.extend(sizes(is_quick));
    trials.extend(starts(grids));
    trials.extend(inputs(line));
    Ok(trials)
}

/// A surface on a grid under a load, with a modulus of 1.
fn trial(name: impl Into<String>, grid: Grid, load: Load, surface: impl Fn(Grid) -> SurfaceResult + 'static) -> Trial {
    Trial::new(name, move || pressed(surface(grid)?, load))
}

fn pressed(surface: Surface, load: Load) -> Result<Problem, SetupError> {
    Ok(Problem::new(surface, ContactModulus(1.0), load)?)
}

/// Reduced pressures from 1e-12 to 10.
fn loads(grids: Grids) -> Vec<Trial> {
    let decades = |(kind, grid)| {
        let of = move |decade| {
            trial(format!("load-{kind}-1e{decade}"), grid, Load::ReducedPressure(10f64.powi(decade)), rough)
        };
        (-12..=1).map(of)
    };
    grids.into_iter().flat_map(decades).collect()
}

/// Waves close to full contact and beyond it.
fn around_full_contact(line: Grid, surface: Grid) -> Vec<Trial> {
    let [sine, crossed] = [Indenter::Sine { amplitude: AMPLITUDE }, Indenter::CrossedSine { amplitude: AMPLITUDE }];
    let full = Westergaard { amplitude: AMPLITUDE, period: 1.0, contact_modulus: 1.0 }.full_pressure();
    let crossed_full = crossed_full_pressure(AMPLITUDE, [1.0, 1.0], 1.0);
    let waves = [("sine", sine, line, full), ("crossed-sine", crossed, surface, crossed_full)];
    let shares = |(name, wave, grid, full): (&str, Indenter, Grid, f64)| {
        [0.999, 0.9999, 1.0, 1.001].map(|share| {
            let load = Load::MeanPressure(share * full);
            trial(format!("{name}-{share}-of-full"), grid, load, move |grid| Ok(wave.surface(grid)?))
        })
    };
    waves.into_iter().flat_map(shares).collect()
}

/// Mean gaps from just below the highest peak to near zero, each with its twin under the load that makes it.
fn gaps(grids: Grids) -> Vec<Trial> {
    let of_kind = |(kind, grid): (&'static str, Grid)| {
        let far = [1.0 - 1e-9, 1.0 - 1e-6, 0.999, 0.9, 0.5];
        let far = far.map(|share| apart(format!("gap-{kind}-peak-{share}"), grid, [share, 0.0], rough));
        let near = [1e-2, 1e-3, 1e-4, 1e-6, 1e-8];
        let near = near.map(|share| apart(format!("gap-{kind}-rms-{share:e}"), grid, [0.0, share], rough));
        let garbage = [f64::NAN, 0.0, 1e100, 1e-100].into_iter().flat_map(move |garbage| {
            let ends = [("far", [1.0 - 1e-6, 0.0]), ("near", [0.0, 1e-6])];
            ends.map(|(end, gap)| Trial {
                start: Some(garbage),
                ..apart(format!("gap-{kind}-{end}-start-{garbage:e}"), grid, gap, rough)
            })
        });
        far.into_iter().chain(near).chain(garbage).chain(shapes_apart(kind, grid))
    };
    grids.into_iter().flat_map(of_kind).collect()
}

/// Hardnesses from a thousandth to a thousand times the peak of the elastic pressure, under pressures and at a mean gap. Those below
/// the mean pressure must be refused.
fn hardnesses(kind: &'static str, grid: Grid) -> Result<Vec<Trial>, SetupError> {
    let shapes: [(&str, SurfaceMaker); 4] =
        [("rough", rough), ("white-noise", noise), ("two-peaks", two_peaks), ("plateaus", plateaus)];
    let mut trials = Vec::new();
    for (name, shape) in shapes {
        let light = pressed(shape(grid)?, Load::ReducedPressure(0.01))?;
        let gap = Load::MeanGap(0.5 * light.rms_height().min(light.highest()));
        for (load, under) in [("light", light.load()), ("heavy", Load::ReducedPressure(0.3)), ("gap", gap)] {
            let wall = light.clone().with_load(under)?;
            let elastic = Multilevel.solve(&wall, &Stop::default(), &mut ())?;
            for factor in [1e-3, 1e-2, 0.1, 0.3, 0.7, 0.99, 1.5, 10.0, 1e3] {
                let hardness = factor * elastic.max_pressure();
                let is_refused = wall.mean_pressure().is_some_and(|mean| mean > hardness);
                let pose = move || Ok(pressed(shape(grid)?, under)?.with_law(Law::Hardness(hardness))?);
                let trial = Trial::new(format!("hardness-{kind}-{name}-{load}-{factor:e}"), pose);
                let demand = if is_refused { Demand::Refusal } else { Demand::Solution };
                let is_at_mean_gap = wall.mean_gap().is_some();
                trials.push(Trial { is_below_hardness: true, is_at_mean_gap, ..trial.demanding(demand) });
            }
        }
    }
    Ok(trials)
}

/// Surfaces of other shapes, just touching and all but closed.
fn shapes_apart(kind: &'static str, grid: Grid) -> impl Iterator<Item = Trial> {
    let wave = |grid: Grid| {
        let wave = if grid.is_line() {
            Indenter::Sine { amplitude: AMPLITUDE }
        } else {
            Indenter::CrossedSine { amplitude: AMPLITUDE }
        };
        Ok(wave.surface(grid)?)
    };
    let shapes: [(&str, SurfaceMaker); 5] = [
        ("wave", wave),
        ("white-noise", noise),
        ("plateaus", plateaus),
        ("two-peaks", two_peaks),
        ("spike", |grid| spike(grid, [0, 3])),
    ];
    shapes.into_iter().flat_map(move |(name, shape)| {
        let ends = [("far", [1.0 - 1e-6, 0.0]), ("near", [0.0, 1e-6])];
        ends.map(|(end, gap)| apart(format!("gap-{kind}-{end}-{name}"), grid, gap, shape))
    })
}

/// A surface at a mean gap that is a multiple of its highest peak, or of its rms height.
fn apart(name: String, grid: Grid, [of_peak, of_rms]: [f64; 2], surface: SurfaceMaker) -> Trial {
    let pose = move || {
        let problem = pressed(surface(grid)?, Load::ReducedPressure(0.1))?;
        let mean_gap = of_peak * problem.highest() + of_rms * problem.rms_height();
        Ok(problem.with_load(Load::MeanGap(mean_gap))?)
    };
    Trial { is_at_mean_gap: true, twin: Some(EquivalentContact::UnderItsLoad), ..Trial::new(name, pose) }
}

/// Indenters that are narrow in their cell, whose rms height says little about the contact, to a bound of the pressure.
fn narrow(line: Grid, surface: Grid) -> Vec<Trial> {
    let bodies = [
        ("cylinder", line, Indenter::Cylinder { radius: 1.0 }, 1e-4),
        ("wedge", line, Indenter::Wedge { slope: 0.1 }, 1e-3),
        ("sphere", surface, Indenter::Sphere { radius: 1.0 }, 1e-5),
        ("cone", surface, Indenter::Cone { slope: 0.1 }, 1e-5),
    ];
    let narrow = |(name, grid, body, pressure): (&str, Grid, Indenter, f64)| {
        let trial =
            trial(format!("narrow-{name}"), grid, Load::MeanPressure(pressure), move |grid| Ok(body.surface(grid)?));
        Trial { pressure_tolerance: Some(1e-5), ..trial }
    };
    bodies.map(narrow).into()
}

/// Units of length and pressure, with results that must be those of the unit case.
fn units(points: usize) -> Vec<Trial> {
    let trial = |[length, modulus]: [f64; 2]| {
        let pose = move || posed(points, [length; 2], modulus, STRAIN * modulus);
        let twin = EquivalentContact::InOtherUnits(Box::new(move || posed(points, [1.0; 2], 1.0, STRAIN)));
        // close enough to the solution for its dimensionless results to agree
        let trial = Trial::new(format!("length-{length:e}-modulus-{modulus:e}"), pose).to(1e-12);
        Trial { twin: Some(twin), ..trial }
    };
    let alone = [[1e-12, 1.0], [1e12, 1.0], [1.0, 1e-15], [1.0, 1e15]];
    let together = [[1e-12, 1e-15], [1e-12, 1e15], [1e12, 1e-15], [1e12, 1e15]];
    alone.into_iter().chain(together).map(trial).collect()
}

/// A rough line of some length and unit of heights, modulus and mean pressure.
fn posed(points: usize, [length, unit]: [f64; 2], modulus: f64, pressure: f64) -> Result<Problem, SetupError> {
    let heights = rough(Grid::line(points, 1.0)?)?.height() * unit;
    let surface = Surface::new(Grid::line(points, length)?, heights)?;
    Ok(Problem::new(surface, ContactModulus(modulus), Load::MeanPressure(pressure))?)
}

/// Heights that are offset, rough to the last node, steep, stepped, tied, or alone.
fn heights(grids: Grids) -> Vec<Trial> {
    let [(_, line), (_, surface)] = grids;
    let mut trials: Vec<Trial> = grids.into_iter().flat_map(|(kind, grid)| heights_on(kind, grid)).collect();
    let punch = |grid| Ok(Indenter::Punch { half_width: 0.2, depth: 0.1 }.surface(grid)?);
    trials.extend(grids.map(|(kind, grid)| trial(format!("punch-{kind}"), grid, Load::MeanPressure(0.01), punch)));
    // upside down they touch at the edge of the cell
    let bodies = [
        ("bowl-line", Indenter::Cylinder { radius: 1.0 }, line),
        ("bowl-surface", Indenter::Sphere { radius: 1.0 }, surface),
    ];
    trials.extend(bodies.map(|(name, body, grid)| {
        let bowl = move |grid| Ok(Surface::new(grid, -body.surface(grid)?.height())?);
        trial(name, grid, Load::MeanPressure(0.01), bowl)
    }));
    // a spike over flat ground: pressed hard enough, both touch
    trials.extend([9e-3, 2e-2].map(|pressure| {
        Trial::new(format!("spike-51x28-{pressure:e}"), move || {
            let grid = Grid::surface([51, 28], [1.0, 1.0])?;
            pressed(spike(grid, [25, 14])?, Load::ReducedPressure(pressure))
        })
    }));
    trials
}

/// Heights of lines and surfaces alike.
fn heights_on(kind: &str, grid: Grid) -> Vec<Trial> {
    let shape = |name: &str, shape: SurfaceMaker| trial(format!("{name}-{kind}"), grid, LOAD, shape);
    vec![
        shape("offset-1e9", offset),
        shape("hurst-0.01", |grid| rough_with(grid, 0.01, 2.0, 0.1)),
        shape("hurst-1", |grid| rough_with(grid, 1.0, 2.0, 0.1)),
        shape("white-noise", noise),
        shape("slope-1e-9", |grid| rough_with(grid, 0.8, 8.0, 1e-9)),
        shape("slope-1e3", |grid| rough_with(grid, 0.8, 8.0, 1e3)),
        shape("plateaus", plateaus),
        shape("two-peaks", two_peaks),
        shape("comb", |grid| shaped(grid, |y, x| if (x + y).is_multiple_of(2) { 1.0 } else { 0.0 })),
        shape("steps", |grid| shaped(grid, |y, x| ((x / 8) % 4 + (y / 8) % 4) as f64)),
        shape("spike", |grid| spike(grid, [0, 3])),
    ]
}

/// White noise on grids that are small, odd, prime or long, and lines fine enough to be stiff.
fn sizes(is_quick: bool) -> Vec<Trial> {
    let line = |points| Trial::new(format!("grid-{points}"), move || pressed(noise(Grid::line(points, 1.0)?)?, LOAD));
    let surface = |shape, size| {
        let ([ny, nx], [ly, lx]): ([usize; 2], [f64; 2]) = (shape, size);
        let aspect = if ly == lx { String::new() } else { format!("-size-{ly}x{lx}") };
        Trial::new(format!("grid-{ny}x{nx}{aspect}"), move || pressed(noise(Grid::surface(shape, size)?)?, LOAD))
    };
    // the stiffest wave is half the number of points as stiff as the softest
    let stiff = |power: u32| {
        let pose = move || pressed(rough(Grid::line(1 << power, 1.0)?)?, LOAD);
        // conjugate gradients take tens of thousands of steps on the finest of them
        let slow = Rival::named("polonsky-keer").filter(|_| power >= 18);
        Trial { rivals: &Rival::ALL, slow, ..Trial::new(format!("stiff-2^{power}"), pose) }
    };
    let mut trials = Vec::from([4, 5, 7, 255, 251, 1021].map(line));
    trials.extend([[4, 4], [5, 7], [15, 33], [31, 37], [4, 4096]].map(|shape| surface(shape, [1.0, 1.0])));
    trials.extend([surface([4, 4096], [1.0, 1024.0]), surface([32, 32], [1.0, 1000.0])]);
    trials.push(surface([3, 4096], [1.0, 1.0]).demanding(Demand::Refusal));
    let powers: &[u32] = if is_quick { &[14] } else { &[14, 18] };
    trials.extend(powers.iter().copied().map(stiff));
    trials
}

/// Starts from garbage, and goals below rounding.
fn starts(grids: Grids) -> Vec<Trial> {
    let garbage = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, 0.0, 1e300, 1e-300];
    let starts = garbage
        .map(|garbage| Trial { start: Some(garbage), ..trial(format!("start-{garbage:e}"), grids[0].1, LOAD, rough) });
    let limits = grids.map(|(kind, grid)| {
        trial(format!("tolerance-1e-16-{kind}"), grid, LOAD, rough).to(1e-16).demanding(Demand::Limit)
    });
    starts.into_iter().chain(limits).collect()
}

/// Values that are not numbers, not positive, or barely so.
fn inputs(line: Grid) -> Vec<Trial> {
    // a line of heights that depend on the column
    let heights = |name: &str, height: fn(usize) -> f64, demand| {
        let surface = move |grid| shaped(grid, |_, x| height(x));
        trial(name, line, Load::MeanPressure(STRAIN), surface).demanding(demand)
    };
    let refused = |name: &str, value: f64, [length, modulus, pressure]: [f64; 3]| {
        let pose = move || posed(64, [length, 1.0], modulus, pressure);
        Trial::new(format!("{name}-{value:e}"), pose).demanding(Demand::Refusal)
    };
    let not_positive = [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e-310];
    let mut trials = vec![
        heights("flat", |_| 7.0, Demand::Refusal),
        heights("height-NaN", |x| if x == 5 { f64::NAN } else { x as f64 }, Demand::Refusal),
        heights("height-inf", |x| if x == 5 { f64::INFINITY } else { x as f64 }, Demand::Refusal),
        heights("height-1e308", |x| if x % 2 == 0 { 1e308 } else { -1e308 }, Demand::Either),
        heights("height-1e-310", |x| 1e-310 * (x % 7) as f64, Demand::Either),
    ];
    trials.extend(not_positive.map(|value| refused("length", value, [value, 1.0, STRAIN])));
    trials.extend(not_positive.map(|value| refused("modulus", value, [1.0, value, STRAIN])));
    trials.extend(not_positive.map(|value| refused("pressure", value, [1.0, 1.0, value])));
    trials.extend([f64::NAN, -1.0, 0.0].map(|tolerance| {
        trial(format!("tolerance-{tolerance:e}"), line, LOAD, rough).to(tolerance).demanding(Demand::Refusal)
    }));
    trials
}
