//! The error of every step by wavelength, compared with a known state.

use super::bands::Bands;
use super::history::History;
use crate::contact::{Contact, Step};
use crate::fourier::{Complex, Fourier};
use crate::grid::Grid;
use std::sync::Arc;

/// Number of rows that are stored of a run.
const MOST: usize = 1024;

/// The reference state for errors, in Fourier space.
#[derive(Debug)]
pub struct Reference {
    grid: Grid,
    pressure: Vec<Complex>,
    displacement: Vec<Complex>,
}

impl Reference {
    /// The final state of a run, or any other.
    pub fn from_contact(contact: &Contact) -> Self {
        let grid = *contact.problem.surface().grid();
        let mut fourier = Fourier::new(&grid);
        let [pressure, displacement] = [&contact.pressure, &contact.displacement].map(|field| {
            let mut spectrum = vec![Complex::default(); grid.modes()];
            fourier.forward(&field.iter().copied().collect::<Vec<_>>(), &mut spectrum);
            spectrum
        });
        Self { grid, pressure, displacement }
    }
}

/// The spectra of the steps of a run, band by band, of all early steps and then of every second, fourth and so on.
///
/// Coefficients of coarser grids are compared with those of the reference at the same wave vectors. Waves that a grid
/// does not have count as fully wrong. Each row takes one transform, and two of methods that move the surface.
pub struct Spectrogram {
    bands: Bands,
    grid: Grid,
    contact_modulus: f64,
    waves: Waves,
    reference: Option<Arc<Reference>>,
    lens: Option<Lens>,
    history: History<SpectrogramRow>,
}

/// The spectra of a step, by bands; errors are missing without a reference, and all values on a grid of other nodes.
#[derive(Debug, Clone, Default)]
pub struct SpectrogramRow {
    /// Number of the step.
    pub step: usize,
    /// Grid level.
    pub level: usize,
    /// Error of the pressure over the pressure of the reference in the same band.
    pub pressure: Vec<f64>,
    /// Error of the displacement over that of the reference in the same band.
    pub displacement: Vec<f64>,
    /// Energy of the error per area: the square of its energy norm.
    pub error_energy: Vec<f64>,
    /// Elastic energy per area.
    pub energy: Vec<f64>,
}

/// What belongs to a grid: the transform and the places of its modes among those of the finest grid.
struct Lens {
    grid: Grid,
    fourier: Fourier,
    places: Vec<Option<usize>>,
    /// Whether each mode of the finest grid is missing on this one; empty on the finest.
    missing: Vec<bool>,
}

impl Spectrogram {
    /// No steps yet, of a problem on `grid` with a contact modulus.
    pub fn new(grid: &Grid, contact_modulus: f64, reference: Option<Arc<Reference>>) -> Self {
        let reference = reference.filter(|reference| reference.grid == *grid);
        let history = History::new(MOST, |_, _| ());
        let waves = Waves::new(grid, contact_modulus);
        Self { bands: Bands::new(grid), grid: *grid, contact_modulus, waves, reference, lens: None, history }
    }

    /// The bands.
    pub fn bands(&self) -> &Bands {
        &self.bands
    }

    /// Stiffness `E* q / 2` of the waves in the middle of a band.
    pub fn stiffness(&self, band: usize) -> f64 {
        0.5 * self.contact_modulus * self.bands.wavenumber(band)
    }

    /// The rows so far.
    pub fn history(&self) -> &History<SpectrogramRow> {
        &self.history
    }

    /// Adds a step; one on a grid that is no coarser version of the finest one gets a row without values.
    pub fn add(&mut self, step: &Step<'_>) {
        let grid = *step.problem().surface().grid();
        if !self.history.begins() {
            return self.history.pass();
        }
        if self.lens.as_ref().is_none_or(|lens| lens.grid != grid) {
            self.lens = Lens::new(&self.grid, &grid);
        }
        let row = self.row(step);
        self.history.add(row.unwrap_or_else(|| SpectrogramRow {
            step: step.index(),
            level: step.phase().level,
            ..SpectrogramRow::default()
        }));
    }

    fn row(&mut self, step: &Step<'_>) -> Option<SpectrogramRow> {
        let lens = self.lens.as_mut()?;
        let pressure = lens.transform(step.pressure());
        let displacement = step.moves_surface().then(|| lens.transform(step.displacement()));
        let lens = &*lens;
        let mut sums = BandSums::none(self.bands.count());
        for (mode, place) in lens.places.iter().enumerate() {
            let Some(wave) = place.and_then(|place| self.waves.at(place, &self.bands)) else { continue };
            let u = displacement.as_ref().map_or(pressure[mode] / wave.stiffness, |displacement| displacement[mode]);
            sums.energy[wave.band] += 0.5 * wave.weight * wave.stiffness * u.norm_sqr();
            if let Some(reference) = &self.reference {
                let [p_end, u_end] = [reference.pressure[wave.place], reference.displacement[wave.place]];
                sums.add(wave, [pressure[mode] - p_end, u - u_end], [p_end, u_end]);
            }
        }
        if let Some(reference) = &self.reference {
            let missing = lens.missing.iter().enumerate().filter_map(|(place, missing)| missing.then_some(place));
            for wave in missing.filter_map(|place| self.waves.at(place, &self.bands)) {
                let end = [reference.pressure[wave.place], reference.displacement[wave.place]];
                sums.add(wave, end, end);
            }
        }
        let row = SpectrogramRow { step: step.index(), level: step.phase().level, ..SpectrogramRow::default() };
        Some(if self.reference.is_some() { sums.relative(row) } else { SpectrogramRow { energy: sums.energy, ..row } })
    }
}

/// Stiffness and weight of each mode of a field, in the order of [`Grid::wavenumbers`].
struct Waves(Vec<[f64; 2]>);

/// A mode that belongs to a band.
#[derive(Clone, Copy)]
struct BandMode {
    place: usize,
    band: usize,
    stiffness: f64,
    weight: f64,
}

impl Waves {
    fn new(grid: &Grid, contact_modulus: f64) -> Self {
        let stiffness = grid.wavenumbers().map(|q| 0.5 * contact_modulus * q);
        Self(stiffness.zip(grid.multiplicities()).map(|(stiffness, weight)| [stiffness, weight]).collect())
    }

    /// The mode at a place, unless it is the mean.
    fn at(&self, place: usize, bands: &Bands) -> Option<BandMode> {
        let [stiffness, weight] = self.0[place];
        Some(BandMode { place, band: bands.modes()[place]?.into(), stiffness, weight })
    }
}

/// Sums over the modes of each band.
struct BandSums {
    energy: Vec<f64>,
    error_energy: Vec<f64>,
    /// Squares of the errors of pressure and displacement, and of both in the reference.
    errors: [Vec<f64>; 2],
    ends: [Vec<f64>; 2],
}

impl BandSums {
    fn none(bands: usize) -> Self {
        let zeros = || vec![0.0; bands];
        Self { energy: zeros(), error_energy: zeros(), errors: [zeros(), zeros()], ends: [zeros(), zeros()] }
    }

    /// Adds the errors of pressure and displacement of a mode, and both of the reference.
    fn add(&mut self, wave: BandMode, errors: [Complex; 2], ends: [Complex; 2]) {
        let BandMode { band, stiffness, weight, .. } = wave;
        self.error_energy[band] += weight * stiffness * errors[1].norm_sqr();
        for field in 0..2 {
            self.errors[field][band] += weight * errors[field].norm_sqr();
            self.ends[field][band] += weight * ends[field].norm_sqr();
        }
    }

    /// The row of a step with errors over what they are errors of.
    fn relative(self, row: SpectrogramRow) -> SpectrogramRow {
        let Self { energy, error_energy, errors: [dp, du], ends: [p, u] } = self;
        let relative =
            |error: Vec<f64>, of: Vec<f64>| error.iter().zip(of).map(|(error, of)| (error / of).sqrt()).collect();
        SpectrogramRow { energy, error_energy, pressure: relative(dp, p), displacement: relative(du, u), ..row }
    }
}

impl Lens {
    /// The view of the modes of `fine` on `grid`, if it is a coarser version of it.
    fn new(fine: &Grid, grid: &Grid) -> Option<Self> {
        let is_finest = fine.stride(grid)? == [1, 1];
        let ([ny, nx], [rows, _]) = (grid.shape(), fine.shape());
        let place = |kx: usize, ky: usize| {
            let is_edge = |k: usize, n: usize| n > 1 && 2 * k == n;
            if is_finest {
                return Some(kx * ny + ky);
            }
            let is_lost = is_edge(kx, nx) || is_edge(ky, ny);
            (!is_lost).then(|| kx * rows + if 2 * ky < ny { ky } else { ky + rows - ny })
        };
        let places: Vec<Option<usize>> = (0..=nx / 2).flat_map(|kx| (0..ny).map(move |ky| place(kx, ky))).collect();
        let mut missing = vec![!is_finest; if is_finest { 0 } else { fine.modes() }];
        if !is_finest {
            places.iter().flatten().for_each(|&place| missing[place] = false);
        }
        Some(Self { grid: *grid, fourier: Fourier::new(grid), places, missing })
    }

    fn transform(&mut self, field: &[f64]) -> Vec<Complex> {
        let mut spectrum = vec![Complex::default(); self.grid.modes()];
        self.fourier.forward(field, &mut spectrum);
        spectrum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{ContactModulus, Load, Multilevel, Problem, Solver, Stop, Work};
    use crate::{Indenter, Surface};
    use std::f64::consts::TAU;

    fn cosine(problem: &Problem, wave: f64, amplitude: f64) -> Vec<f64> {
        let grid = problem.surface().grid();
        let [ly, lx] = grid.size();
        grid.y()
            .flat_map(|y| grid.x().map(move |x| (y, x)))
            .map(|(y, x)| amplitude * (TAU * wave * (x / lx + if ly == 1.0 { 0.0 } else { y / ly })).cos())
            .collect()
    }

    /// An error of one wave is seen in its band alone, with its size, on the grid itself and through coarser ones.
    #[test]
    fn an_error_of_one_wave_lies_in_its_band() {
        let surface: Surface = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(256, 1.0).unwrap()).unwrap();
        let problem = Problem::new(surface, ContactModulus(2.0), Load::ReducedPressure(0.05)).unwrap();
        let end = Multilevel.solve(&problem, &Stop::default(), &mut ()).unwrap();
        let grid = *problem.surface().grid();
        let mut spectrogram = Spectrogram::new(&grid, 2.0, Some(Arc::new(Reference::from_contact(&end))));
        let wrong = cosine(&problem, 6.0, 1e-3);
        let p: Vec<f64> = end.pressure.iter().zip(&wrong).map(|(p, w)| p + w).collect();
        let u: Vec<f64> = end.displacement.iter().zip(&wrong).map(|(u, w)| u + w / (TAU * 6.0)).collect();
        spectrogram.add(&Step::new(&problem, Work::default(), &p, &u));
        let row = &spectrogram.history().columns()[0];
        let bands = spectrogram.bands();
        let worst = (0..bands.count()).max_by(|&a, &b| row.error_energy[a].total_cmp(&row.error_energy[b])).unwrap();
        let [long, short] = bands.wavelengths(worst);
        assert!(short < 1.0 / 6.0 && 1.0 / 6.0 <= long, "{worst}");
        assert!((0..bands.count()).all(|band| (row.pressure[band] > 1e-6) == (band == worst)), "{:?}", row.pressure);
        // energy of a wave of pressure: <w u> = 1e-6 / 2 / (6 TAU)
        let expected = 0.5e-6 / (TAU * 6.0);
        assert!((row.error_energy[worst] / expected - 1.0).abs() < 1e-9);
    }

    /// Energies of all bands add up to `<p u> / 2`, on lines and surfaces of odd and even points.
    #[test]
    fn bands_share_the_elastic_energy() {
        for grid in [Grid::line(255, 2.0), Grid::surface([12, 16], [1.0, 3.0]), Grid::surface([15, 8], [2.0, 1.0])] {
            let grid = grid.unwrap();
            let surface = if grid.is_line() {
                Indenter::Sine { amplitude: 0.01 }
            } else {
                Indenter::CrossedSine { amplitude: 0.01 }
            };
            let problem =
                Problem::new(surface.surface(grid).unwrap(), ContactModulus(2.0), Load::ReducedPressure(0.1)).unwrap();
            let end = Multilevel.solve(&problem, &Stop::default(), &mut ()).unwrap();
            let mut spectrogram = Spectrogram::new(&grid, 2.0, None);
            let [p, u] = [&end.pressure, &end.displacement].map(|field| field.iter().copied().collect::<Vec<_>>());
            spectrogram.add(&Step::new(&problem, Work::default(), &p, &u));
            let found: f64 = spectrogram.history().columns()[0].energy.iter().sum();
            let expected = 0.5 * p.iter().zip(&u).map(|(p, u)| p * u).sum::<f64>() / p.len() as f64;
            assert!((found / expected - 1.0).abs() < 1e-12, "{found} for {expected}");
        }
    }

    /// On a coarser grid the waves that it carries are held against the same waves, and the others have all of their error.
    #[test]
    fn coarser_grids_miss_short_waves_only() {
        let problem = |points| {
            let surface = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(points, 1.0).unwrap()).unwrap();
            Problem::new(surface, ContactModulus(1.0), Load::ReducedPressure(0.5)).unwrap()
        };
        let [fine, coarse] = [problem(256), problem(64)];
        let end = Multilevel.solve(&fine, &Stop::default(), &mut ()).unwrap();
        let mut spectrogram =
            Spectrogram::new(fine.surface().grid(), 1.0, Some(Arc::new(Reference::from_contact(&end))));
        let [p, u] =
            [&end.pressure, &end.displacement].map(|field| field.iter().step_by(4).copied().collect::<Vec<_>>());
        spectrogram.add(&Step::new(&coarse, Work::default(), &p, &u));
        let row = &spectrogram.history().columns()[0];
        let bands = spectrogram.bands();
        for band in 0..bands.count() {
            let [long, short] = bands.wavelengths(band);
            // subsampling folds a little of the waves 64 - k onto the waves k
            if short > 1.0 / 4.0 {
                assert!(row.pressure[band] < 0.02, "{long}: {}", row.pressure[band]);
            } else if long < 1.0 / 32.0 {
                assert!((row.pressure[band] - 1.0).abs() < 1e-9, "{long}: {}", row.pressure[band]);
            }
        }
    }
}
