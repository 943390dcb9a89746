//! The traction along both axes of one step with friction.

use super::discs::{Discs, Pair, add, length};
use super::slip_memory::SlipMemory;
use super::slip_pull::{AT_BOUND, PULL_TOLERANCE_SHARE, WINDOW_GROWTH, drive_of, finer, reach_of};
use super::slip_round::{SlipTask, values};
use super::slip_traction::{Traction, sliding_length};
use super::slip_vector::VectorStep;
use crate::chunks;
use crate::clock::Instant;
use crate::contact::{Observer, Status, Stop, Work};
use crate::elastic::ShearResponse;

/// The traction along both axes with the mean `target` under the pressure of a contact.
///
/// The discs are no larger than a weak pull needs, so that rounding and tolerance are relative to the tractions that it causes: a
/// traction that reaches none of the narrow discs but those of `mu p` is the solution in these as well.
pub(super) fn pull_towards(
    response: &mut ShearResponse,
    memory: &SlipMemory,
    task: &SlipTask<'_>,
    (mu, step_stop): (f64, Stop),
    observer: &mut dyn Observer,
) -> Traction {
    let &SlipTask { contact, pressed, target, moved, start, .. } = task;
    let start_of_work = Instant::now();
    let p = values(&contact.pressure);
    let places: Vec<usize> = chunks::positive(p, 0..p.len()).collect();
    let at = |fields: &[Vec<f64>; 2]| places.iter().map(|&i| [fields[0][i], fields[1][i]]).collect::<Vec<Pair>>();
    let (start, lag, displaced, traction) = (at(start), at(moved), at(&memory.displaced), at(&memory.traction));
    let before: Vec<Pair> = lag.iter().zip(&displaced).map(|(lag, before)| add(*lag, 1.0, *before)).collect();
    let limits: Vec<f64> = places.iter().map(|&i| mu * p[i]).collect();
    let total = target.map(|target| target * p.len() as f64);
    let drive = match drive_of(&limits, &traction, total) {
        // displacements by the pressure ask for tractions that the load does not tell of
        _ if task.is_coupled => 1.0,
        0.0 if lag.iter().any(|lag| length(*lag) > 0.0) => 1.0,
        drive => drive,
    };
    let zeros = || [vec![0.0; p.len()], vec![0.0; p.len()]];
    if drive == 0.0 || places.is_empty() {
        // nothing touches, or the traction before the step carries the load and nothing moves
        let touches = !places.is_empty();
        let [values, displacement] =
            [&memory.traction, &memory.displaced].map(|it| if touches { it.clone() } else { zeros() });
        return Traction { values, displacement, ..Traction::none([0, 0]) };
    }
    let near = 1.0 - length(total) / limits.iter().sum::<f64>();
    let highest = limits.iter().copied().fold(0.0, f64::max);
    let earlier = traction.iter().fold(0.0, |most: f64, tau| most.max(length(*tau)));
    let mut reach = (reach_of(drive, places.len()) * highest).max(WINDOW_GROWTH * earlier);
    let transforms = response.transforms();
    let mut iterations = 0;
    let found = loop {
        let radii: Vec<f64> = limits.iter().map(|limit| limit.min(reach)).collect();
        let narrowed = (reach / highest).min(1.0);
        let part = PULL_TOLERANCE_SHARE * (near * drive / narrowed).min(1.0).powi(2);
        let stop = finer(step_stop, part);
        let discs = Discs { radii: radii.clone(), total };
        let size = narrowed * sliding_length(mu, pressed);
        let found =
            VectorStep::new(response, places.clone(), discs, before.clone(), size).solve(&start, &stop, observer);
        iterations += found.iterations;
        let is_at_rim = |i: usize| radii[i] < limits[i] && length(found.tau[i]) >= radii[i] * (1.0 - AT_BOUND);
        if found.status != Status::Converged || !(0..radii.len()).any(is_at_rim) {
            break found;
        }
        reach *= WINDOW_GROWTH;
    };
    let (mut traction, mut displacement) = (zeros(), zeros());
    for (axis, field) in traction.iter_mut().enumerate() {
        places.iter().zip(&found.tau).for_each(|(&i, tau)| field[i] = tau[axis]);
    }
    response.displacement(traction.each_ref().map(Vec::as_slice), displacement.each_mut().map(Vec::as_mut_slice));
    let transforms = response.transforms() - transforms;
    let work = Work { iterations, transforms, seconds: start_of_work.elapsed().as_secs_f64() };
    Traction { values: traction, displacement, shift: found.shift, status: found.status, work }
}
