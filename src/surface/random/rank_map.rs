//! Heights of a given distribution with the spectrum of a given realisation.

use crate::fourier::{Complex, Fourier};
use crate::grid::Grid;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use strum::{EnumIter, EnumMessage, IntoStaticStr};

/// The most rounds.
const MOST: usize = 100;
/// The error of the spectrum at which the rounds end.
const ENOUGH: f64 = 2e-3;
/// The rounds end where one lowers the error by less than this part of it.
const LEAST_GAIN: f64 = 2e-3;

/// What is exact where heights that are not Gaussian and a spectrum cannot both be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, EnumIter, EnumMessage, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum ExactPart {
    /// The heights have the distribution exactly, and the spectrum approximately.
    #[default]
    Heights,
    /// The realisation keeps its spectrum exactly, and the heights have the distribution approximately.
    Spectrum,
}

/// How heights of a given distribution were found for the spectrum of a realisation.
///
/// Each round gives the node of rank `i` the height of rank `i` of the distribution, and then all waves their amplitudes in the
/// realisation, with their phases unchanged. The two cannot both be met, and either is met exactly at the end.
///
/// Source: Schreiber & Schmitz, Phys. Rev. Lett. 77:635, 1996; Perez-Rafols & Almqvist, Tribol. Int. 131:591, 2019.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct RankMap {
    /// The number of rounds.
    pub rounds: usize,
    /// `sqrt(sum (|h_q| - A_q)^2 / sum A_q^2)` over all waves, with the amplitudes `A_q` of the realisation; 0 if they are kept.
    pub spectrum_error: f64,
    /// Rms difference between the sorted heights and those of the distribution, over the rms height; 0 if these are met.
    pub height_error: f64,
}

impl RankMap {
    /// Gives `height` the distribution whose sorted heights are `sorted`, of mean 0 and mean square 1.
    pub(super) fn apply(grid: &Grid, height: &mut [f64], sorted: &[f64], exact: ExactPart) -> Self {
        let mut fourier = Fourier::new(grid);
        let mut modes = vec![Complex::default(); grid.modes()];
        fourier.forward(height, &mut modes);
        modes[0] = Complex::default();
        let amplitude: Vec<f64> = modes.iter().map(|mode| mode.norm()).collect();
        let weigh = weights(grid);
        let square: f64 = amplitude.iter().enumerate().map(|(i, a)| weigh(i) * a * a).sum();
        let rms = square.sqrt();
        let (mut before, mut rounds) = (f64::INFINITY, 0);
        loop {
            rounds += 1;
            ranks(height).iter().zip(sorted).for_each(|(&node, target)| height[node as usize] = rms * target);
            fourier.forward(height, &mut modes);
            let misfit = modes.iter().zip(&amplitude).enumerate();
            let misfit: f64 = misfit.map(|(i, (mode, a))| weigh(i) * (mode.norm() - a).powi(2)).sum();
            let spectrum_error = (misfit / square).sqrt();
            let is_last = rounds >= MOST || spectrum_error < ENOUGH || spectrum_error > (1.0 - LEAST_GAIN) * before;
            if is_last && exact == ExactPart::Heights {
                return Self { rounds, spectrum_error, height_error: 0.0 };
            }
            modes.iter_mut().zip(&amplitude).for_each(|(mode, a)| {
                let norm = mode.norm();
                *mode = if norm > 0.0 { *mode * (a / norm) } else { Complex::from(*a) };
            });
            fourier.inverse(&mut modes, height);
            if is_last {
                return Self { rounds, spectrum_error: 0.0, height_error: distance(height, sorted, rms) };
            }
            before = spectrum_error;
        }
    }
}

/// The nodes by ascending height; equal heights in the order of the nodes.
fn ranks(height: &[f64]) -> Vec<u32> {
    let mut nodes: Vec<u32> = (0..height.len() as u32).collect();
    nodes.par_sort_unstable_by(|&a, &b| height[a as usize].total_cmp(&height[b as usize]).then(a.cmp(&b)));
    nodes
}

/// Rms difference between the sorted heights and `rms` times those of the distribution, over `rms`.
fn distance(height: &[f64], sorted: &[f64], rms: f64) -> f64 {
    let squares =
        ranks(height).into_iter().zip(sorted).map(|(node, target)| (height[node as usize] / rms - target).powi(2));
    (squares.sum::<f64>() / sorted.len() as f64).sqrt()
}

/// How many waves each stored coefficient stands for, see [`crate::fourier`].
fn weights(grid: &Grid) -> impl Fn(usize) -> f64 {
    let [ny, nx] = grid.shape();
    move |i| if i / ny == 0 || 2 * (i / ny) == nx { 1.0 } else { 2.0 }
}
