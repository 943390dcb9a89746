//! Kinks where the last node of a period meets the first.

use crate::formats::Scan;
use crate::surface::Detrend;
use ndarray::Axis;

/// How many times the largest kink inside, and the rms of all of them, that of the seam is at least. A periodic surface has kinks like those inside
/// there, and on none of the clean maps of the tests is it so large; a form of 20 rms heights makes it tens of times as large.
const OVER_LARGEST: f64 = 1.5;
const OVER_RMS: f64 = 6.0;
/// The least part of the mean square height about the plane that the second order leaves: with less the heights are a smooth body, and no
/// roughness on a form. A form of 1000 rms heights leaves some 1e-6.
const LEAST_LEFT: f64 = 1e-9;
/// The part of the mean square height behind the second order from which on terms of third order are a form. Of 200
/// pieces of random maps with waves that are longer than the piece, one in a hundred has more than 0.52, and is cleared of them as well.
const CUBIC: f64 = 0.4;

/// Whether heights without voids have a kink at the seam along an axis that none has inside: then they are not periodic, although both ends
/// may be level, as those of a bow are. Large forms hide jumps, which are told in rms steps, since they make the steps; a kink they do not hide.
///
/// The kink is the difference of the slopes on both sides of a step, of the mean of all lines along the axis.
pub(super) fn has_kink(full: &Scan, axis: usize) -> bool {
    let nodes = full.shape()[axis];
    if nodes < 16 {
        return false;
    }
    let mean: Vec<f64> = full.height.axis_iter(Axis(axis)).map(|line| line.sum() / line.len() as f64).collect();
    let kink = |at: usize| {
        let h = |i: usize| mean[(at + i) % nodes];
        ((h(3) - h(2)) - (h(1) - h(0))).abs()
    };
    let inside: Vec<f64> = (0..nodes - 3).map(kink).collect();
    let seam = kink(nodes - 2);
    let largest = inside.iter().copied().fold(0.0, f64::max);
    let rms = (inside.iter().map(|it| it * it).sum::<f64>() / inside.len() as f64).sqrt();
    seam > OVER_LARGEST * largest && seam > OVER_RMS * rms && left_by_curvature(full) > LEAST_LEFT
}

/// The part of the mean square height about the plane that the second order leaves; 0 for a plane.
fn left_by_curvature(full: &Scan) -> f64 {
    let [plane, curvature] =
        [Detrend::Plane, Detrend::Curvature].map(|trend| super::square(&trend.apply(full.clone())));
    if plane > 0.0 { curvature / plane } else { 0.0 }
}

/// The order of the form of heights without voids: the third where it explains much of what the second leaves.
pub(super) fn form_of(full: &Scan) -> Detrend {
    let [second, third] = [Detrend::Curvature, Detrend::Cubic].map(|trend| super::square(&trend.apply(full.clone())));
    if third < (1.0 - CUBIC) * second { Detrend::Cubic } else { Detrend::Curvature }
}
