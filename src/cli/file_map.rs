//! Maps of fields in several results.

use super::exit_status::usage;
use super::picture::{NamedMap, gaps, imprints, pressures, with_images};
use super::result_file;
use super::units::Units;
use anyhow::Result;
use asperity::Grid;
use asperity::contact::ArchiveReader;
use asperity::plot::Panel;
use asperity::setup::SetupTable;
use clap::ValueEnum;
use std::path::{Path, PathBuf};

/// A field that is drawn as a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum MapField {
    Pressure,
    Gap,
    /// What a body that yields below its surface keeps after its last load
    Imprint,
}

/// The results of some files, each of a surface.
pub(crate) struct FileMaps {
    results: Vec<(String, ArchiveReader)>,
    units: Units,
}

impl FileMaps {
    /// The results in some files.
    ///
    /// # Errors
    /// For a file that is no result of one load on a surface, or of some states for an imprint, and for one with units beside one without.
    pub(crate) fn read(files: &[PathBuf], field: MapField) -> Result<Self> {
        let results: Vec<(String, ArchiveReader)> =
            files.iter().map(|path| named(path, field)).collect::<Result<_>>()?;
        let units: Vec<Units> = results.iter().map(|(_, it)| units_of(it)).collect::<Result<_>>()?;
        match units.iter().position(|it| *it != units[0]) {
            Some(other) => usage(format!(
                "{} and {} do not have the same units: give results in metres and pascals, or results without units",
                files[0].display(),
                files[other].display()
            )),
            None => Ok(Self { results, units: units[0] }),
        }
    }

    /// The panels of a field, one for each result, in the same colours.
    ///
    /// # Errors
    /// For a result without the field.
    pub(crate) fn panels(&self, field: MapField) -> Result<Vec<Panel>> {
        let name = match field {
            MapField::Pressure => "pressure",
            MapField::Gap => "gap",
            MapField::Imprint => "imprint",
        };
        let map = |(title, result): &(String, ArchiveReader)| {
            // of some states, the imprint is that of the last one
            let mut field = result.fields(name)?.pop().expect("a result has at least one state");
            if name == "imprint" {
                let highest = field.iter().copied().fold(f64::INFINITY, f64::min);
                field -= highest;
            }
            let size = result.shared("size")?;
            let &[ly, lx] = size.as_slice() else {
                return usage(format!("{} does not have the two lengths of a surface", result.path().display()));
            };
            let (rows, columns) = field.dim();
            Ok(NamedMap { title: title.clone(), grid: Grid::surface([rows, columns], [ly, lx])?, field })
        };
        let maps: Vec<NamedMap> = self.results.iter().map(map).collect::<Result<_>>()?;
        Ok(match field {
            MapField::Pressure => pressures(&maps, self.units),
            MapField::Gap => gaps(&maps, self.units),
            MapField::Imprint => imprints(&maps, self.units),
        })
    }
}

/// The result of one load on a surface in a file, or of some states for an imprint, with the name of the file.
fn named(path: &Path, field: MapField) -> Result<(String, ArchiveReader)> {
    let is_archive = path.is_dir() || path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("npz"));
    let result = if is_archive { Some(result_file::open(path)?) } else { None };
    match result.filter(|it| it.rank() == 2 && (!it.is_list() || field == MapField::Imprint)) {
        Some(result) => {
            let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            let (recipe, _) = SetupTable::from_toml(result.setup())?.surface()?;
            Ok((with_images(name, &recipe), result))
        }
        None => usage(format!(
            "{} has no maps: give results (.npz) of one load on a surface, or leave out --map",
            path.display()
        )),
    }
}

/// The units of a result, which its setup tells.
fn units_of(result: &ArchiveReader) -> Result<Units> {
    let table = SetupTable::from_toml(result.setup())?;
    Ok(Units::new(&table))
}
