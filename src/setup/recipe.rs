//! The recipe of a surface.

use super::Cell;
use crate::error::SetupError;
use crate::grid::Grid;
use crate::surface::{Detrend, Field, Indenter, Spectrum, Surface, read_heights, read_shape};
use ndarray::Axis;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// The recipe of a surface: a height file, an indenter, self-affine roughness, or the sum of those that are given.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Recipe {
    /// A file of heights of a line or a surface, see [`read_heights`]; peaks towards the solid are positive.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height: Option<PathBuf>,
    /// A file of heights of a second surface of the same shape, on which the first is pressed: peaks towards the first are positive, rows
    /// and columns lie on those of the first, and the heights are added to its.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub against: Option<PathBuf>,
    /// The trend to take off the heights of a file; none if it is left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub detrend: Option<Detrend>,
    /// A smooth indenter, centred in the cell.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub indenter: Option<Indenter>,
    /// Self-affine roughness.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spectrum: Option<Spectrum>,
    /// The realisation of the roughness; 1 if none is given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
}

impl Recipe {
    /// The recipe of a smooth indenter.
    pub fn indenter(indenter: Indenter) -> Self {
        Self { indenter: Some(indenter), ..Self::default() }
    }

    /// The recipe of one realisation of self-affine roughness.
    pub fn rough(spectrum: Spectrum, seed: u64) -> Self {
        Self { spectrum: Some(spectrum), seed: Some(seed), ..Self::default() }
    }

    /// The indenter, where nothing else is added to it.
    pub fn smooth(&self) -> Option<Indenter> {
        self.indenter.filter(|_| !self.is_measured() && self.spectrum.is_none())
    }

    /// Whether the surface is random, and so all the same everywhere.
    pub fn is_random(&self) -> bool {
        self.spectrum.is_some() && !self.is_measured() && self.indenter.is_none()
    }

    /// Whether heights of a file are part of it.
    pub fn is_measured(&self) -> bool {
        self.height.is_some() || self.against.is_some()
    }

    /// The files of heights.
    fn files(&self) -> impl Iterator<Item = &PathBuf> {
        [&self.height, &self.against].into_iter().flatten()
    }

    /// Checks that both files of heights have the same shape.
    fn check_shapes(&self) -> Result<(), SetupError> {
        let (Some(first), Some(path)) = (&self.height, &self.against) else { return Ok(()) };
        let [expected, found] = [read_shape(first)?, read_shape(path)?];
        if found == expected { Ok(()) } else { Err(SetupError::Against { path: path.clone(), found, expected }) }
    }

    /// The grid that the recipe makes of a cell: that of the height file, if there is one.
    ///
    /// # Errors
    /// For a file that cannot be read, points beside those of a file, and as [`Cell::grid`].
    pub fn grid(&self, cell: &Cell) -> Result<Grid, SetupError> {
        match self.files().next() {
            Some(_) if !cell.points.is_empty() => Err(SetupError::PointsOfFile),
            Some(path) => cell.grid_of(&read_shape(path)?),
            None => cell.grid(),
        }
    }

    /// Axes of the arrays that are written of it.
    ///
    /// # Errors
    /// For a height file that cannot be read.
    pub fn rank(&self, cell: &Cell) -> Result<usize, SetupError> {
        Ok(self.files().next().map(read_shape).transpose()?.map_or(cell.points.len(), |shape| shape.len()))
    }

    /// Checks that the surface can be made on a grid. None is made.
    ///
    /// # Errors
    /// For no surface at all, a trend without a height file, and an indenter or a spectrum that cannot be on this grid.
    pub fn check(&self, grid: &Grid) -> Result<(), SetupError> {
        if !self.is_measured() && self.indenter.is_none() && self.spectrum.is_none() {
            return Err(SetupError::NoSurface);
        }
        self.check_shapes()?;
        if self.detrend.is_some() && !self.is_measured() {
            return Err(SetupError::DetrendWithoutHeights);
        }
        if self.seed.is_some() && self.spectrum.is_none() {
            return Err(SetupError::SeedWithoutSpectrum);
        }
        if self.seed() > i64::MAX as u64 {
            return Err(SetupError::Seed { seed: self.seed() });
        }
        self.indenter.map_or(Ok(()), |indenter| indenter.check(grid))?;
        self.spectrum.map_or(Ok(()), |spectrum| spectrum.validate(grid))?;
        Ok(())
    }

    /// The surface on a grid: the sum of all parts that are given.
    ///
    /// # Errors
    /// The errors of [`Recipe::check`], and for a height file that cannot be read.
    pub fn surface(&self, grid: Grid) -> Result<Surface, SetupError> {
        self.check(&grid)?;
        let read = |path: &PathBuf| -> Result<Surface, SetupError> {
            let height = read_heights(path)?;
            let height = if height.ndim() == 1 { height.insert_axis(Axis(0)) } else { height };
            let height: Field = height.into_dimensionality().map_err(|_| SetupError::Axes { axes: 0 })?;
            let given = grid.with_shape(height.dim().into())?;
            let height = Surface::new(given, height)?;
            let height = match self.detrend {
                Some(detrend) => Surface::new(given, detrend.of(height.heights_as_given()))?,
                None => height,
            };
            let refined = height.refined((grid.shape()[1] / given.shape()[1]).max(1))?;
            if *refined.grid() == grid { Ok(refined) } else { Ok(Surface::new(grid, refined.heights_as_given())?) }
        };
        let measured = self.files().map(read).collect::<Result<Vec<_>, _>>()?;
        let smooth = self.indenter.map(|indenter| indenter.surface(grid)).transpose()?;
        let rough = self.spectrum.map(|spectrum| Surface::rough(grid, &spectrum, self.seed())).transpose()?;
        let sum = measured.into_iter().chain(smooth).chain(rough).reduce(|sum, part| sum.plus(&part));
        sum.ok_or(SetupError::NoSurface)
    }

    /// The realisation of the roughness.
    pub fn seed(&self) -> u64 {
        self.seed.unwrap_or(1)
    }

    /// A name for people, such as "Rough cylinder".
    pub fn title(&self, grid: &Grid) -> String {
        let file = self.height.as_ref().and_then(|path| path.file_stem());
        let body = match (file, self.indenter) {
            (Some(stem), _) => return stem.to_string_lossy().into_owned(),
            (None, Some(indenter)) => indenter.name(),
            (None, None) if grid.is_line() => "line",
            (None, None) => "surface",
        };
        let name = if self.spectrum.is_some() { format!("rough {body}") } else { body.to_owned() };
        let mut letters = name.chars();
        letters.next().into_iter().flat_map(char::to_uppercase).chain(letters).collect()
    }

    /// The parts of the surface, in words.
    pub fn description(&self) -> String {
        let trend = self.detrend.map_or("", |detrend| match detrend {
            Detrend::Mean => " less their mean",
            Detrend::Plane => " less their plane",
        });
        let file = self.height.as_ref().map(|path| format!("heights from {}{trend}", path.display()));
        let against = self.against.as_ref().map(|path| format!("pressed on those from {}{trend}", path.display()));
        let smooth = self.indenter.map(|indenter| {
            let values = indenter.parameters().into_iter().map(|(name, value)| format!(", {name} {value:?}"));
            format!("{}{}", indenter.name(), values.collect::<String>().replace('_', " "))
        });
        let rough = self.spectrum.map(|spectrum| {
            let Spectrum { hurst, rolloff_wavelength, short_cutoff, rms_gradient } = spectrum;
            let seed = self.seed();
            format!(
                "self-affine roughness, H = {hurst}, roll-off {rolloff_wavelength:e}, short cut-off {short_cutoff:e}, \
                 rms gradient {rms_gradient:e}, seed {seed}"
            )
        });
        let files = [file, against].into_iter().flatten().reduce(|one, other| format!("{one}, {other}"));
        [files, smooth, rough].into_iter().flatten().collect::<Vec<_>>().join(", with ")
    }
}
