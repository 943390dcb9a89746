//! Bands of wavenumbers.

use crate::grid::Grid;
use std::f64::consts::TAU;

/// Bands in each octave.
const PER_OCTAVE: f64 = 2.0;

/// The wave vectors of a grid in bands of half an octave, from the longest wave on; bands without waves are left out.
///
/// ```
/// use asperity::{Grid, diagnosis::Bands};
/// let bands = Bands::new(&Grid::line(64, 8.0)?);
/// // waves 1, 2, 3, 4 to 5, 6 to 7 and so on, up to the 32nd
/// assert_eq!((bands.count(), bands.wavelengths(0)[0], bands.wavelengths(3)[0]), (10, 8.0, 2.0));
/// assert_eq!(bands.wavelengths(9), [0.25, 0.25]);
/// # Ok::<(), asperity::error::GridError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Bands {
    longest: f64,
    shortest: f64,
    /// Half octaves from the longest wave to the band.
    places: Vec<u16>,
    /// The band of each mode, in the order of [`Grid::wavenumbers`]; none of the mean.
    modes: Vec<Option<u16>>,
}

impl Bands {
    /// The bands of a grid.
    pub fn new(grid: &Grid) -> Self {
        let longest = grid.longest_wavelength();
        // a hair more, so that rounding leaves waves at the edges in the bands that they begin
        let place =
            |q: f64| (q > 0.0).then(|| (PER_OCTAVE * (q * longest / TAU).log2() + 1e-9).floor().max(0.0) as u16);
        let modes: Vec<Option<u16>> = grid.wavenumbers().map(place).collect();
        let mut places: Vec<u16> = modes.iter().flatten().copied().collect();
        places.sort_unstable();
        places.dedup();
        let number = |place: u16| places.partition_point(|&other| other < place) as u16;
        let modes = modes.into_iter().map(|place| place.map(number)).collect();
        let shortest = TAU / grid.wavenumbers().fold(0.0, f64::max);
        Self { longest, shortest, places, modes }
    }

    /// Number of bands.
    pub fn count(&self) -> usize {
        self.places.len()
    }

    /// The longest wavelength of a band, and the one at which the next band begins, or that of the shortest wave of all.
    pub fn wavelengths(&self, band: usize) -> [f64; 2] {
        self.edges(band).map(|length| length.max(self.shortest))
    }

    /// The wavelengths at which a band and the next half octave begin.
    fn edges(&self, band: usize) -> [f64; 2] {
        let place = f64::from(self.places[band]);
        [place, place + 1.0].map(|place| self.longest * 2f64.powf(-place / PER_OCTAVE))
    }

    /// The band of each half octave from the longest wave on; where it is empty, that of longer waves.
    pub fn half_octaves(&self) -> Vec<usize> {
        let last = self.places.last().copied().unwrap_or(0);
        (0..=last).map(|place| self.places.partition_point(|&other| other <= place).saturating_sub(1)).collect()
    }

    /// Wavenumber in the middle of a band.
    pub fn wavenumber(&self, band: usize) -> f64 {
        let [longest, shortest] = self.edges(band);
        TAU / (longest * shortest).sqrt()
    }

    /// The band of each mode of a field, in the order of [`Grid::wavenumbers`]; none of the mean.
    pub(super) fn modes(&self) -> &[Option<u16>] {
        &self.modes
    }
}
