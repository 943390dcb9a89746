//! The recipe of a surface.

use super::{Cell, Dimension, Key};
use crate::error::{ConflictRule, SetupError, SurfaceError};
use crate::files::InputFile;
use crate::formats::{FileUnits, HeightFile, Layout, Scan};
use crate::grid::Grid;
use crate::quantity::some_length;
use crate::surface::{Bumps, Indenter, Preparation, PreparationChoice, Prepared, RandomRoughness, Resample, Surface};
use serde::{Deserialize, Deserializer, Serialize};
use strum::{EnumIter, EnumMessage, IntoStaticStr};

/// How a second random roughness is joined with the first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, EnumIter, EnumMessage, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Joined {
    /// The heights are added.
    #[default]
    Sum,
    /// The lower height counts at each node, such as that of a groove in a plateau.
    Lower,
}

/// The recipe of a surface: a height file, an indenter, self-affine roughness, bumps, or the sum of those that are given.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct Recipe {
    /// A file of heights of a line or a surface, see [`HeightFile`]; peaks towards the solid are positive.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height: Option<HeightFile>,
    /// A file of heights of the second body, of the same shape. Peaks towards the first body are positive. Rows and
    /// columns correspond, and both heights are added.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub against: Option<HeightFile>,
    /// The channel of files with several channels, by name or number (1, 2, ...). The default is the first channel of
    /// heights.
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "name_or_number")]
    pub channel: Option<String>,
    /// The unit of a file that states none, or not all: heights and distances that the file gives without a unit are multiplied by it. Without
    /// it they are used as they are.
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "some_length")]
    pub file_unit: Option<f64>,
    /// The unit of the heights of a file that states none, where that of the distances is another one.
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "some_length")]
    pub height_unit: Option<f64>,
    /// The preparation of the heights of files.
    #[serde(skip_serializing_if = "Preparation::is_none")]
    pub prepare: Preparation,
    /// A smooth indenter, centred in the cell.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub indenter: Option<Indenter>,
    /// Random roughness.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spectrum: Option<RandomRoughness>,
    /// A second random roughness of the same seed, independent of the first, such as the grooves of a honed plateau.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub second_spectrum: Option<RandomRoughness>,
    /// How the second one is joined with the first.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joined: Option<Joined>,
    /// The realisation of the roughness; 1 if none is given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
    /// Bumps and hollows on a line, added to the other parts.
    #[serde(skip_serializing_if = "Bumps::is_empty")]
    pub bumps: Bumps,
}

impl Recipe {
    /// The recipe of a smooth indenter.
    pub fn indenter(indenter: Indenter) -> Self {
        Self { indenter: Some(indenter), ..Self::default() }
    }

    /// The recipe of one realisation of random roughness.
    pub fn rough(spectrum: impl Into<RandomRoughness>, seed: u64) -> Self {
        Self { spectrum: Some(spectrum.into()), seed: Some(seed), ..Self::default() }
    }

    /// The indenter, where nothing else is added to it.
    pub fn smooth(&self) -> Option<Indenter> {
        self.indenter.filter(|_| !self.is_measured() && self.spectrum.is_none() && self.bumps.is_empty())
    }

    /// Whether the surface is random, and so the same at all places.
    pub fn is_random(&self) -> bool {
        self.spectrum.is_some() && !self.is_measured() && self.indenter.is_none() && self.bumps.is_empty()
    }

    /// Whether its roughness has heights that are not Gaussian.
    pub fn has_target_heights(&self) -> bool {
        self.spectra().any(|roughness| roughness.heights.is_some())
    }

    /// Whether heights of a file are part of it.
    pub fn is_measured(&self) -> bool {
        self.height.is_some() || self.against.is_some()
    }

    /// Rows and columns of its own part of heights of some shape: all, or those of which the rest is mirror images.
    pub fn own_shape(&self, shape: [usize; 2]) -> [usize; 2] {
        self.prepare.mirror.map_or(shape, |mirror| mirror.original_shape(shape))
    }

    /// The files of heights.
    pub fn files(&self) -> impl Iterator<Item = &HeightFile> {
        [&self.height, &self.against].into_iter().flatten()
    }

    /// All files that it names, in the order of their keys.
    pub(super) fn files_mut(&mut self) -> impl Iterator<Item = &mut InputFile> {
        let heights = [&mut self.height, &mut self.against].into_iter().flatten().map(HeightFile::file_mut);
        let spectra = [&mut self.spectrum, &mut self.second_spectrum].into_iter().flatten();
        heights.chain(spectra.flat_map(RandomRoughness::files_mut))
    }

    /// The layout of the first file of heights.
    fn layout(&self) -> Result<Option<Layout>, SetupError> {
        Ok(self.files().next().map(|file| file.layout(self.channel.as_deref())).transpose()?)
    }

    /// Checks that both files of heights have the same shape and even (or resampled) positions, and that options for
    /// files are given only with a file.
    fn check_files(&self) -> Result<(), SetupError> {
        let has_unit = self.file_unit.or(self.height_unit).is_some();
        if !self.is_measured() && (self.channel.is_some() || has_unit || !self.prepare.is_none()) {
            return Err(ConflictRule::PreparationWithoutHeights.into());
        }
        let layouts = self.files().map(|file| Ok((file, file.layout(self.channel.as_deref())?)));
        let layouts = layouts.collect::<Result<Vec<_>, SetupError>>()?;
        if let Some((file, _)) = layouts.iter().find(|(_, it)| !it.is_even && self.prepare.resample.is_none()) {
            return Err(SetupError::Uneven { path: file.path().into() });
        }
        let [(_, first), (file, other)] = layouts.as_slice() else { return Ok(()) };
        let [first, other] = [first.shape, other.shape];
        if other == first {
            Ok(())
        } else {
            Err(SetupError::Against { path: file.path().into(), found: other.into(), expected: first.into() })
        }
    }

    /// The grid of the recipe on a cell: that of the height file, if there is one. Its lengths are used if the cell has
    /// none.
    ///
    /// # Errors
    /// For a file that cannot be read, points in addition to those of a file, unknown lengths, and as
    /// [`Cell::grid`].
    pub fn grid(&self, cell: &Cell) -> Result<Grid, SetupError> {
        if self.is_measured() && !cell.points.is_empty() {
            return Err(ConflictRule::PointsOfFile.into());
        }
        match self.layout()? {
            Some(layout) => {
                let [dy, dx] = self.spacing(&layout, cell)?;
                let [ny, nx] = self.prepare.shape(layout.shape)?;
                let size = [ny as f64 * dy, nx as f64 * dx];
                let axes = if layout.is_profile { 1..2 } else { 0..2 };
                Cell { size: size[axes.clone()].to_vec(), ..cell.clone() }.grid_of(&[ny, nx][axes])
            }
            None => cell.grid(),
        }
    }

    /// The spacing of a file: from the lengths of the cell, or else from the file.
    fn spacing(&self, layout: &Layout, cell: &Cell) -> Result<[f64; 2], SetupError> {
        let [ny, nx] = layout.shape;
        let unit = self.unit_of_distances(layout)?;
        if cell.size.is_empty() {
            return Ok(layout.spacing.ok_or(ConflictRule::NoSize)?.map(|spacing| spacing * unit));
        }
        let whole = Cell { refine: None, boundary: Vec::new(), datum: None, ..cell.clone() };
        let shape = if layout.is_profile { vec![nx] } else { vec![ny, nx] };
        Ok(whole.unrefined(&shape)?.spacing())
    }

    /// The unit of the distances of a file: 1 if they are in metres.
    fn unit_of_distances(&self, layout: &Layout) -> Result<f64, SetupError> {
        self.check_units(layout)?;
        let is_own = layout.units.distance.is_some();
        checked_unit(self.file_unit, "the unit of the file").map(|unit| if is_own { 1.0 } else { unit })
    }

    /// The unit of the heights of a file: 1 if they are in metres, or else their own, or that of the file.
    fn unit_of_heights(&self, layout: &Layout) -> Result<f64, SetupError> {
        self.check_units(layout)?;
        checked_unit(self.file_unit, "the unit of the file")?;
        let unit = checked_unit(self.height_unit.or(self.file_unit), "the unit of the heights")?;
        Ok(if layout.units.height.is_some() { 1.0 } else { unit })
    }

    /// Refuses units other than those that a file states; where it states some of them only, the unit of the file is that of the others.
    fn check_units(&self, layout: &Layout) -> Result<(), SetupError> {
        let file = self.file_unit.filter(|unit| layout.is_in_metres && !layout.units.has(*unit));
        let own = FileUnits { distance: None, ..layout.units };
        let height = self.height_unit.filter(|unit| own.height.is_some() && !own.has(*unit));
        match file.or(height) {
            Some(unit) => Err(SetupError::UnitOfFile { unit }),
            None => Ok(()),
        }
    }

    /// Number of axes of its arrays.
    ///
    /// # Errors
    /// For a height file that cannot be read.
    pub fn rank(&self, cell: &Cell) -> Result<usize, SetupError> {
        Ok(self.layout()?.map_or(cell.points.len(), |layout| if layout.is_profile { 1 } else { 2 }))
    }

    /// Checks that the surface can be generated on a grid, without generating it.
    ///
    /// # Errors
    /// For no surface at all, a preparation without a height file, and an indenter, a spectrum or bumps that cannot be on this grid.
    pub fn check(&self, grid: &Grid) -> Result<(), SetupError> {
        if !self.is_measured() && self.indenter.is_none() && self.spectrum.is_none() && self.bumps.is_empty() {
            return Err(ConflictRule::NoSurface.into());
        }
        self.check_files()?;
        if self.seed.is_some() && self.spectrum.is_none() {
            return Err(ConflictRule::SeedWithoutSpectrum.into());
        }
        if self.second_spectrum.is_some() && self.spectrum.is_none() {
            return Err(ConflictRule::SecondSpectrum.into());
        }
        if self.joined.is_some() && self.second_spectrum.is_none() {
            return Err(ConflictRule::JoinedWithoutSecond.into());
        }
        if self.seed() > i64::MAX as u64 {
            return Err(SetupError::Seed { seed: self.seed() });
        }
        self.indenter.map_or(Ok(()), |indenter| indenter.check(grid))?;
        self.spectra().try_for_each(|roughness| roughness.check(grid))?;
        self.some_bumps().map_or(Ok(()), |bumps| bumps.check(grid))?;
        Ok(())
    }

    /// The prepared heights of a file, on their own grid or a finer one, and the effect of each step.
    ///
    /// # Errors
    /// For a file that cannot be read, positions that are not evenly spaced, and steps that its heights do not allow.
    pub fn prepared(&self, file: &HeightFile, grid: &Grid) -> Result<Prepared, SetupError> {
        let mut measured = file.measurement(self.channel.as_deref())?;
        let unit = self.unit_of_heights(&measured.layout())?;
        if let Some(x) = &measured.positions {
            let resample = self.prepare.resample.ok_or_else(|| SetupError::Uneven { path: file.path().into() })?;
            let (even, _) = resample.apply(x, &measured.height.row(0).to_vec());
            measured.height.row_mut(0).assign(&ndarray::ArrayView1::from(&even));
        }
        let [ny, nx] = self.prepare.shape(measured.height.dim().into())?;
        let factor = [grid.shape()[0] / ny, grid.shape()[1] / nx].map(|it| it.max(1) as f64);
        let spacing = [0, 1].map(|axis| grid.spacing()[axis] * factor[axis]);
        Ok(self.prepare.apply(Scan { height: measured.height * unit, spacing })?)
    }

    /// The preparation that the heights of a file need on a cell, after the cropping of the recipe.
    ///
    /// # Errors
    /// For no file, and the errors of [`Recipe::grid`] and [`Recipe::prepared`].
    pub fn choice(&self, cell: &Cell) -> Result<PreparationChoice, SetupError> {
        let file = self.files().next().ok_or(ConflictRule::PreparationWithoutHeights)?;
        let is_even = file.layout(self.channel.as_deref())?.is_even;
        let resample = (!is_even).then_some(Resample::Linear);
        let prepare = Preparation { resample, crop: self.prepare.crop.clone(), ..Preparation::default() };
        let raw = Self { prepare, ..self.clone() };
        let grid = raw.grid(&Cell { refine: None, ..cell.clone() })?;
        let mut choice = PreparationChoice::new(&raw.prepared(file, &grid)?.scan, is_even, grid.periodic())?;
        // rows and columns are counted in the file, not in the part of it that is given
        choice.preparation.crop = match (choice.preparation.crop, &self.prepare.crop) {
            (Some(chosen), Some(given)) => Some(chosen.after(given)),
            (chosen, _) => chosen,
        };
        Ok(choice)
    }

    /// The surface on a grid: the sum of all parts that are given.
    ///
    /// # Errors
    /// The errors of [`Recipe::check`], for a height file that cannot be read, and for voids in it.
    pub fn surface(&self, grid: Grid) -> Result<Surface, SetupError> {
        self.check(&grid)?;
        let measured = self.files().map(|file| self.measured(file, grid)).collect::<Result<Vec<_>, _>>()?;
        let smooth = self.indenter.map(|indenter| indenter.surface(grid)).transpose()?;
        let rough = self.rough_part(grid)?;
        let bumps = self.some_bumps().map(|bumps| bumps.surface(grid)).transpose()?;
        let sum = measured.into_iter().chain(smooth).chain(rough).chain(bumps).reduce(|sum, part| sum.plus(&part));
        sum.ok_or(ConflictRule::NoSurface.into())
    }

    /// Both random roughnesses.
    fn spectra(&self) -> impl Iterator<Item = &RandomRoughness> {
        [&self.spectrum, &self.second_spectrum].into_iter().flatten()
    }

    /// The random roughness: one, or two that are joined.
    fn rough_part(&self, grid: Grid) -> Result<Option<Surface>, SetupError> {
        let made = self.spectra().zip(0..).map(|(it, stream)| it.surface_in_stream(grid, self.seed(), stream));
        let made = made.collect::<Result<Vec<_>, _>>()?;
        Ok(made.into_iter().reduce(|one, other| match self.joined.unwrap_or_default() {
            Joined::Sum => one.plus(&other),
            Joined::Lower => one.lower(&other),
        }))
    }

    /// The prepared heights of a file, refined to a grid.
    fn measured(&self, file: &HeightFile, grid: Grid) -> Result<Surface, SetupError> {
        let Prepared { scan, filled, .. } = self.prepared(file, &grid)?;
        let (voids, shape) = (scan.voids(), scan.shape());
        if voids > 0 {
            return Err(SetupError::Voids { path: file.path().into(), voids, points: shape[0] * shape[1] });
        }
        let height = Surface::new(grid.with_shape(shape)?, scan.height)?.with_filled(filled.as_ref());
        let refined = height.refined((grid.shape()[1] / shape[1]).max(1))?;
        if *refined.grid() == grid { Ok(refined) } else { Ok(refined.on(grid)?) }
    }

    fn some_bumps(&self) -> Option<&Bumps> {
        (!self.bumps.is_empty()).then_some(&self.bumps)
    }

    /// The realisation of the roughness.
    pub fn seed(&self) -> u64 {
        self.seed.unwrap_or(1)
    }

    /// A title, such as "Rough cylinder".
    pub fn title(&self, grid: &Grid) -> String {
        let file = self.height.as_ref().and_then(|file| file.path().file_stem());
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
        self.described(None)
    }

    /// The parts of the surface, in words, with its lengths as `in_words` writes them.
    pub fn described(&self, in_words: Option<&dyn Fn(f64) -> String>) -> String {
        let random =
            |it: &RandomRoughness| in_words.map_or_else(|| it.description(), |in_words| it.described(in_words));
        let steps = if self.prepare.is_none() { String::new() } else { format!(" ({})", self.prepare.description()) };
        let file = self.height.as_ref().map(|file| format!("heights from {}{steps}", file.display()));
        let against = self.against.as_ref().map(|file| format!("pressed on heights from {}{steps}", file.display()));
        let smooth = self.indenter.map(|indenter| {
            let number = |name: &str, value: f64| match in_words.filter(|_| is_length_of_indenter(name)) {
                Some(in_words) => in_words(value),
                None => format!("{value:?}"),
            };
            let values = indenter.parameters().into_iter();
            let values = values.map(|(name, value)| format!(", {name} {}", number(name, value)));
            format!("{}{}", indenter.name(), values.collect::<String>().replace('_', " "))
        });
        let rough = self.spectrum.as_ref().map(|it| format!("{}, seed {}", random(it), self.seed()));
        let second = self.second_spectrum.as_ref().map(|it| match self.joined.unwrap_or_default() {
            Joined::Sum => random(it),
            Joined::Lower => format!("the lower of it and {}", random(it)),
        });
        let files = [file, against].into_iter().flatten().reduce(|one, other| format!("{one}, {other}"));
        let bumps = self.some_bumps().map(|bumps| match bumps.0.len() {
            1 => "a bump".into(),
            count => format!("{count} bumps"),
        });
        [files, smooth, rough, second, bumps].into_iter().flatten().collect::<Vec<_>>().join(", with ")
    }
}

/// A unit of a file, 1 if it is not given.
fn checked_unit(given: Option<f64>, name: &'static str) -> Result<f64, SetupError> {
    match given {
        None => Ok(1.0),
        Some(unit) if unit > 0.0 && unit.is_finite() => Ok(unit),
        Some(unit) => Err(SurfaceError::NotPositive { name, value: unit }.into()),
    }
}

/// The channel of a file.
#[derive(Deserialize)]
#[serde(untagged, expecting = "give the name of a channel, or its number (1, 2, ...)")]
enum NameOrNumber {
    Name(String),
    Number(u64),
}

/// Reads a channel that is given by name or number.
fn name_or_number<'de, D: Deserializer<'de>>(from: D) -> Result<Option<String>, D::Error> {
    Ok(Some(match NameOrNumber::deserialize(from)? {
        NameOrNumber::Name(name) => name,
        NameOrNumber::Number(number) => number.to_string(),
    }))
}

/// Whether a parameter of an indenter is a length.
fn is_length_of_indenter(name: &str) -> bool {
    let path = format!("surface.indenter.{}", name.replace('_', "-"));
    Key::find(&path).is_some_and(|key| key.dimension == Dimension::Length)
}
