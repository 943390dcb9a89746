//! Steps of preparation that some heights do not allow.

/// A step of the preparation of measured heights that cannot be taken.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PreparationError {
    /// A part that the heights do not have.
    #[error(
        "the crop {crop:?} is no part of {} rows of {} points: give the first node and one beyond the last, of a map those of the rows \
         and then of the columns", shape[0], shape[1]
    )]
    Crop { crop: Vec<usize>, shape: [usize; 2] },
    /// Heights that are all void.
    #[error("all heights are void: give a file with heights, or another part of it")]
    AllVoid,
    /// Heights without the form of the body.
    #[error("no such body fits the heights, they may be too flat or too steep: take off their trend instead")]
    NoForm,
    /// A wavelength that no filter separates.
    #[error("a filter at the wavelength {wavelength:?} separates nothing: give at least two spacings, {shortest:?}")]
    Wavelength { wavelength: f64, shortest: f64 },
    /// A low-pass filter that leaves nothing of the heights.
    #[error(
        "a low-pass filter at the wavelength {wavelength:?} takes off all heights: give at most the longer side of the map, {longest:?}"
    )]
    LongWavelength { wavelength: f64, longest: f64 },
    /// A share of a taper that is too large or none.
    #[error("the taper is {share:?} of each side: give a share above 0 and at most 0.5")]
    Taper { share: f64 },
}
