//! Noise of the instrument.

use super::{Band, Scales};
use crate::error::SurfaceError;
use crate::formats::Scan;
use crate::sentence::{Sentence, sentence};
use crate::surface::{Detrend, Fill};
use std::f64::consts::{PI, TAU};

/// The share of the gradient by bends from which on there is noise, and its level is looked for in the spectrum.
const LEAST: f64 = 0.05;
/// Waves of which the spectrum shows the level of noise, over the shortest waves along the axes.
const SHORT: [f64; 2] = [0.6, 1.4];
/// The largest density of these waves over the smallest one, if they are noise.
const FLAT: f64 = 1.25;
/// The rms of the level may be larger by this factor.
const SURE: f64 = 1.03;
/// There are steep edges where the share of the noise between them is so many times that of all the heights.
const EDGES: f64 = 3.0;
/// The fewest independent waves of a band that tells the level.
const FEWEST: f64 = 16.0;

/// Noise of an instrument: independent from node to node, and the same along all axes. What differs along one axis only is roughness with a
/// lay, or an artefact, but no noise.
///
/// The bends along each axis tell how much noise there is at least, see [`Scales`], and how much there is at most: bends of a smooth surface
/// grow 16 times from one spacing to two, and those of another one less; and noise is everywhere, so that the median of the bends has it.
/// Where the spectrum is flat at the shortest waves, its level tells how much it is: a density of `sigma^2 dx / 2 pi` on a line, and
/// `sigma^2 dx dy / 4 pi^2` on a surface.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize)]
pub struct Noise {
    /// Its rms height `sigma`, a length.
    pub rms: f64,
    /// Its share of the mean square gradient at the spacing, of all axes together.
    pub share: f64,
    /// The largest share that it may have.
    pub most_share: f64,
    /// The largest rms height that it may have.
    #[serde(skip)]
    most_rms: f64,
    /// Its share of the mean square gradient between steep edges.
    #[serde(skip)]
    share_of_flat: f64,
    /// The shortest wavelength above it along all axes, see [`Scales::shortest_wavelength`].
    pub shortest_wavelength: f64,
}

impl Noise {
    /// Errors of areas above this one are told.
    pub const TOLD: f64 = 0.1;

    /// The noise of heights, which have no artefacts and may be void.
    ///
    /// # Errors
    /// For less nodes than a grid has.
    pub fn from_scan(scan: &Scan) -> Result<Self, SurfaceError> {
        let flat = Detrend::Plane.apply(scan.clone());
        let axes: Vec<Scales> = (0..2).filter_map(|axis| Scales::new(&flat, axis)).collect();
        let least = Self::least(&axes);
        if least.share < LEAST {
            return Ok(least);
        }
        let full = if scan.voids() > 0 { Fill::Harmonic.apply(flat.clone()).unwrap_or(flat) } else { flat };
        Ok(Self::new(&axes, &Band::of_flat(&full)?, &full))
    }

    /// The noise of heights with some scales along their axes, and a spectrum.
    pub(super) fn new(axes: &[Scales], bands: &[Band], scan: &Scan) -> Self {
        let least = Self::least(axes);
        match level(bands, scan).filter(|_| least.share >= LEAST) {
            Some(rms) => {
                let rms = rms.clamp(least.rms, least.most_rms.max(least.rms));
                Self::from_rms(axes, rms, SURE * rms)
            }
            None => least,
        }
    }

    /// The noise that there is at least, by the bends along the axes.
    fn least(axes: &[Scales]) -> Self {
        let most = axes.iter().map(Scales::most_noise).reduce(f64::min).unwrap_or(0.0);
        let least = axes.iter().map(|it| it.noise).reduce(f64::max).unwrap_or(0.0);
        Self::from_rms(axes, least.min(most), most)
    }

    fn from_rms(axes: &[Scales], rms: f64, most: f64) -> Self {
        let sum = |of: &dyn Fn(&Scales) -> f64| axes.iter().map(of).sum::<f64>();
        let gradient = sum(&|it| it.scales[0].rms_gradient.powi(2));
        let share = |rms: f64| {
            let noise = sum(&|it| 2.0 * (rms / it.scales[0].distance).powi(2));
            if gradient > 0.0 { (noise / gradient).min(1.0) } else { 0.0 }
        };
        let usual = sum(&|it| (it.usual_step / it.scales[0].distance).powi(2));
        let noise = sum(&|it| 2.0 * (rms / it.scales[0].distance).powi(2));
        Self {
            rms,
            share_of_flat: if usual > 0.0 { (noise / usual).min(1.0) } else { 0.0 },
            share: share(rms),
            most_share: share(most),
            most_rms: most,
            shortest_wavelength: axes.iter().map(|it| it.shortest_wavelength_above(rms)).fold(0.0, f64::max),
        }
    }

    /// The rms gradient without the noise, and the least that it may be, over that with it.
    pub fn gradients_without(&self) -> [f64; 2] {
        [self.share, self.most_share].map(|share| (1.0 - share).sqrt())
    }

    /// The largest relative error of areas that it causes, with twice the share that there is at least if there may be so much, or with its share
    /// between steep edges, where the heights touch. The gradient of the heights as waves has `pi^2/6` as much noise in it as that of
    /// differences between nodes.
    pub fn area_error(&self) -> f64 {
        let error = |share: f64, most: f64| {
            let noise = PI * PI / 6.0 * most;
            noise / (1.0 - share + noise)
        };
        let between_edges = error(self.share_of_flat, self.share_of_flat);
        error(self.share, self.most_share.min(2.0 * self.share)).max(between_edges)
    }

    /// The share of the mean square gradient that the noise makes, in words: that between steep edges, where these make most of the gradient.
    pub fn part_of_gradient(&self) -> Sentence {
        match self.share_of_flat > EDGES * self.share {
            true => sentence!(
                "{share:.0} % of the mean square gradient between steep edges",
                share = 100.0 * self.share_of_flat
            ),
            false => sentence!("{share:.0} % of the mean square gradient", share = 100.0 * self.share),
        }
    }
}

/// The rms of white heights by the level of a spectrum, if it is flat at the shortest waves.
fn level(bands: &[Band], scan: &Scan) -> Option<f64> {
    let shortest = scan.axes().map(|axis| PI / scan.spacing[axis]).reduce(f64::min)?;
    let is_short = |band: &&Band| {
        let share = band.wavenumber / shortest;
        share > SHORT[0] && share < SHORT[1] && band.waves >= FEWEST
    };
    let densities: Vec<f64> = bands.iter().filter(is_short).map(|band| band.density).collect();
    let [low, high] = [densities.iter().copied().reduce(f64::min)?, densities.iter().copied().reduce(f64::max)?];
    let cell: f64 = scan.axes().map(|axis| scan.spacing[axis] / TAU).product();
    let mean = densities.iter().sum::<f64>() / densities.len() as f64;
    (densities.len() > 1 && high < FLAT * low).then(|| (mean / cell).sqrt())
}
