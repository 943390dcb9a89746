//! Noise by a second measurement of the same place.

use super::Band;
use crate::error::SurfaceError;
use crate::formats::Scan;
use crate::surface::{Detrend, Fill, PowerSpectrum, Surface};
use ndarray::{Array2, Axis};

/// The farthest shift between both measurements that is looked for, along each axis, in nodes.
const FARTHEST: isize = 3;
/// Another place fits better where the mean square difference there is below this part of that without a shift.
const BETTER: f64 = 0.7;
/// Noise with a larger correlation between neighbours than this is alike there. That of independent noise on 64 x 64 nodes is below 0.05.
const ALIKE: f64 = 0.1;
/// The part of the mean square height from which on the difference is no noise: heights of another place differ by twice their mean square.
const OTHER_PLACE: f64 = 1.0;

/// The noise of an instrument, by two measurements of the same place that differ by nothing else.
///
/// Their difference without its plane (drift lifts and tilts the whole) is the sum of two independent noises, so that each has `1/sqrt 2` of its
/// rms, and half of its power spectrum and of its mean square gradient. Nothing is assumed on how the noise is alike at neighbouring nodes.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct RepeatNoise {
    /// The rms height of the noise, a length.
    pub rms: f64,
    /// The correlations of the noise at neighbours along y and x; 0 where it is independent, and for an axis of one node.
    pub correlation: [f64; 2],
    /// Its share of the mean square gradient at the spacing.
    pub share: f64,
    /// The rms gradient with the noise, and without it.
    pub rms_gradient: [f64; 2],
    /// The largest relative error of areas that it causes.
    pub area_error: f64,
    /// By how many nodes along y and x the second measurement fits better, if it is shifted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shift: Option<[isize; 2]>,
    /// Whether the measurements differ by as much as those of different places.
    pub is_of_another_place: bool,
    /// The power spectrum of the noise, as that of a survey.
    pub spectrum: Vec<Band>,
}

impl RepeatNoise {
    /// The noise of a measurement and its repetition. Nodes that are void in one of them are left out.
    ///
    /// # Errors
    /// [`SurfaceError::Shape`] for measurements of different shapes; [`SurfaceError::NonFinite`] where they have no node in common;
    /// [`SurfaceError::Grid`] for less nodes than a grid has.
    pub fn new(one: &Scan, two: &Scan) -> Result<Self, SurfaceError> {
        if one.shape() != two.shape() {
            return Err(SurfaceError::Shape { found: two.height.shape().to_vec(), expected: one.shape() });
        }
        let mut half = Detrend::Plane.apply(Scan { height: &one.height - &two.height, ..*one });
        half.height *= 0.5f64.sqrt();
        let noise = full(&half)?;
        let flat = full(&Detrend::Plane.apply(one.clone()))?;
        let [of_noise, of_heights] = [&half, one].map(|it| it.rms_gradient().powi(2));
        let share = if of_heights > 0.0 { (of_noise / of_heights).min(1.0) } else { 0.0 };
        // waves carry more gradient than differences between nodes do: of independent noise pi^2/6 times as much
        let waves = square_gradient(&noise)?;
        let rest = (of_heights - of_noise).max(0.0);
        let rms = super::square(&noise).sqrt();
        Ok(Self {
            rms,
            correlation: [0, 1].map(|axis| correlation(&half, axis)),
            share,
            rms_gradient: [of_heights.sqrt(), rest.sqrt()],
            area_error: if waves > 0.0 { waves / (rest + waves) } else { 0.0 },
            shift: shift(one, two),
            is_of_another_place: rms * rms > 0.5 * OTHER_PLACE * super::square(&flat),
            spectrum: Band::of_flat(&noise)?,
        })
    }

    /// The noise in sentences without their ends, with lengths in the words that are given for them.
    pub fn sentences_in(&self, words: &dyn Fn(f64) -> String) -> Vec<String> {
        let Self { rms, share, area_error, rms_gradient: [with, without], .. } = *self;
        let largest = self.correlation.into_iter().fold(0.0, f64::max);
        let kind = match largest > ALIKE {
            true => format!("alike at neighbouring nodes (correlation {largest:.2})"),
            false => "independent from node to node".to_owned(),
        };
        let mut lines = vec![format!(
            "By the repeated measurement the noise is {} rms, {kind}: {:.1} % of the mean square gradient. Without it the rms gradient is \
             {without:.4}, not {with:.4}, and areas may be off by up to {:.0} %",
            words(rms),
            100.0 * share,
            100.0 * area_error
        )];
        if let Some([y, x]) = self.shift {
            lines.push(format!(
                "The repeated measurement fits better when it is shifted by {y} rows and {x} columns, so that a part of this noise is the shift: \
                 crop both to the same place"
            ));
        }
        if self.is_of_another_place {
            lines
                .push("The measurements differ as much as those of different places: what is found is no noise".into());
        }
        lines
    }
}

/// Heights without voids.
fn full(scan: &Scan) -> Result<Scan, SurfaceError> {
    let filled = if scan.voids() > 0 { Fill::Harmonic.apply(scan.clone()) } else { Some(scan.clone()) };
    filled.ok_or(SurfaceError::NonFinite { index: [0, 0], value: f64::NAN })
}

/// The mean square gradient of the waves of flat heights, under a Hann window.
fn square_gradient(flat: &Scan) -> Result<f64, SurfaceError> {
    let surface = Surface::new(flat.grid()?, super::band::windowed(flat).height)?;
    Ok(PowerSpectrum::new(&surface).integral(|q, density| q * q * density))
}

/// The correlation between neighbours along an axis.
fn correlation(scan: &Scan, axis: usize) -> f64 {
    let (mut product, mut square) = (0.0, 0.0);
    for pair in scan.height.axis_windows(Axis(axis), 2) {
        let [one, next] = [0, 1].map(|i| pair.index_axis_move(Axis(axis), i));
        for (a, b) in one.iter().zip(next).filter(|(a, b)| !(**a * **b).is_nan()) {
            product += a * b;
            square += 0.5 * (a * a + b * b);
        }
    }
    if square > 0.0 { product / square } else { 0.0 }
}

/// The shift by which the second of two measurements fits better than where it is, if there is one.
fn shift(one: &Scan, two: &Scan) -> Option<[isize; 2]> {
    let [rows, columns] = [0, 1].map(|axis| if one.shape()[axis] > 16 { FARTHEST } else { 0 });
    let [here, there] = [one, two].map(|scan| Detrend::Plane.apply(scan.clone()).height);
    let left = |shift: [isize; 2]| difference(&here, &there, shift, [rows, columns]);
    let unshifted = left([0, 0]);
    let shifts = (-rows..=rows).flat_map(|y| (-columns..=columns).map(move |x| [y, x]));
    let (best, least) = shifts.map(|it| (it, left(it))).min_by(|a, b| a.1.total_cmp(&b.1))?;
    (best != [0, 0] && least < BETTER * unshifted).then_some(best)
}

/// The mean square difference between heights and others that are shifted by some rows and columns, of the nodes that all shifts leave.
fn difference(here: &Array2<f64>, there: &Array2<f64>, shift: [isize; 2], far: [isize; 2]) -> f64 {
    let (ny, nx) = here.dim();
    let [rows, columns] = far.map(|it| it as usize);
    let (mut sum, mut count) = (0.0, 0usize);
    for y in rows..ny - rows {
        for x in columns..nx - columns {
            let other = there[(y.wrapping_add_signed(shift[0]), x.wrapping_add_signed(shift[1]))];
            let off = here[(y, x)] - other;
            if !off.is_nan() {
                sum += off * off;
                count += 1;
            }
        }
    }
    sum / count.max(1) as f64
}
