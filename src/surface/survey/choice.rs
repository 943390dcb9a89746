//! The automatic choice of a preparation.

use super::Survey;
use crate::error::SurfaceError;
use crate::surface::{Detrend, Fill, Mirror, Preparation, Resample, Scan};

/// Jumps across the period, in rms steps, up to which lines and maps are periodic: the one step of a line may be large by chance, the rms of
/// those of a map is about 1.
const PERIODIC: [f64; 2] = [3.0, 1.5];
/// The share of the mean square gradient from which on noise is filtered out.
const NOISE: f64 = 0.25;

/// A preparation chosen for heights, with a reason for each step.
///
/// Uneven positions are resampled, and voids are filled. From heights that are not periodic, the polynomial of second
/// order is subtracted (or only the plane, if the boundary is free and the heights may be a body). They are then
/// mirrored along the axes on which they still jump. Waves that cannot be distinguished from noise are filtered out
/// where the noise makes a quarter of the mean square gradient.
#[derive(Debug, Clone, PartialEq)]
pub struct PreparationChoice {
    /// The steps.
    pub preparation: Preparation,
    /// The reasons for the steps, in one sentence each.
    pub reasons: Vec<String>,
}

impl PreparationChoice {
    /// The preparation of heights that are at even positions or not, on a cell that is periodic along y and x or free.
    ///
    /// # Errors
    /// The errors of [`Survey::new`].
    pub fn new(scan: &Scan, is_even: bool, periodic: [bool; 2]) -> Result<Self, SurfaceError> {
        let mut choice = Self { preparation: Preparation::default(), reasons: Vec::new() };
        if !is_even {
            choice.preparation.resample = Some(Resample::Linear);
            choice.because("the positions are not evenly spaced: the heights are resampled to even spacing".into());
        }
        let mut survey = Survey::new(scan)?;
        if survey.voids > 0 {
            choice.preparation.fill = Some(Fill::Harmonic);
            let all = scan.height.len();
            choice.because(format!(
                "{} of {all} heights are void: they are filled with the smoothest heights",
                survey.voids
            ));
        }
        let most = PERIODIC[usize::from(scan.shape()[0] > 1)];
        if jump(&survey, periodic) > most || periodic == [false; 2] {
            let full = Fill::Harmonic.apply(scan.clone()).unwrap_or(scan.clone());
            survey = Survey::new(&choice.detrended(full, &survey, periodic))?;
        }
        choice.mirror(&survey, periodic, most);
        choice.filter(&survey);
        Ok(choice)
    }

    fn because(&mut self, reason: String) {
        self.reasons.push(reason);
    }

    /// Takes off the trend.
    fn detrended(&mut self, scan: Scan, survey: &Survey, periodic: [bool; 2]) -> Scan {
        let share = 100.0 * survey.curvature_share;
        let (trend, reason) = if periodic == [false; 2] {
            (Detrend::Plane, "the boundary is free: only the plane is subtracted, and the curvature is kept".to_owned())
        } else {
            let reason = "the heights are not periodic: the polynomial of second order is subtracted";
            (Detrend::Curvature, format!("{reason}, {share:.1} % of the mean square height about the plane"))
        };
        self.preparation.detrend = Some(trend);
        self.because(reason);
        trend.apply(scan)
    }

    /// Mirrors along the axes on which heights jump by more than a number of rms steps.
    fn mirror(&mut self, survey: &Survey, periodic: [bool; 2], most: f64) {
        let [y, x] = [0, 1].map(|axis| periodic[axis] && survey.jumps[axis] > most);
        let (mirror, axes) = match [y, x] {
            [true, true] => (Mirror::Both, "y and x"),
            [true, false] => (Mirror::Y, "y"),
            [false, true] => (Mirror::X, "x"),
            [false, false] => return,
        };
        self.preparation.mirror = Some(mirror);
        let jump = jump(survey, periodic);
        self.because(format!(
            "the heights jump by {jump:.3} rms steps across the period: they are mirrored along {axes}"
        ));
    }

    /// Filters noise out.
    fn filter(&mut self, survey: &Survey) {
        let (share, wavelength) = (survey.noise_share(), survey.shortest_wavelength());
        if share > NOISE {
            self.preparation.low_pass = Some(wavelength);
            self.because(format!(
                "noise makes {:.0} % of the mean square gradient: waves below {wavelength:.4e}, which are below the noise, are filtered out",
                100.0 * share
            ));
        }
    }
}

/// The largest jump across a period.
fn jump(survey: &Survey, periodic: [bool; 2]) -> f64 {
    (0..2).filter(|&axis| periodic[axis]).map(|axis| survey.jumps[axis]).fold(0.0, f64::max)
}
