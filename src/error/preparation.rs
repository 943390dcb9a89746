//! Preparation steps that are not possible for some heights.

use crate::sentence::worded;

worded! {
    /// An impossible step of the preparation of measured heights.
    #[derive(Debug, Clone, PartialEq)]
    pub enum PreparationError {
        /// A part that the heights do not have.
        #[error(
            "the crop {crop:?} does not fit {rows} rows of {points} points: give the first node and the last node + 1; for a map, \
             first for the rows and then for the columns", rows = shape[0], points = shape[1]
        )]
        Crop { crop: Vec<usize>, shape: [usize; 2] },
        /// Heights that are all void.
        #[error("all heights are void: give a file with heights, or another part of it")]
        AllVoid,
        /// Heights without the form of the body.
        #[error("the shape cannot be fitted, since the heights may be too flat or too steep: subtract a trend instead")]
        NoForm,
        /// A wavelength that is too short for a filter.
        #[error("a filter at the wavelength {wavelength:?} has no effect: give at least two spacings, {shortest:?}")]
        Wavelength { wavelength: f64, shortest: f64 },
        /// A low-pass filter that removes all heights.
        #[error(
            "a low-pass filter at the wavelength {wavelength:?} removes all heights: give at most the longer side of the \
             map, {longest:?}"
        )]
        LongWavelength { wavelength: f64, longest: f64 },
        /// A taper that is too large or not positive.
        #[error("the taper is {share:?}: give a fraction above 0 and at most 0.5")]
        Taper { share: f64 },
    }
}
