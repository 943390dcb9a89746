//! The files that a setup names.
//!
//! The files that a setup reads follow from the keys of [`Dimension::File`], in the order of [`Setup::files`]: files are found beside their scene, belong to the
//! fingerprint of a study by their content, have digests in saved setups, and are never overwritten.

use super::{Dimension, Key, Setup, SetupTable};
use crate::digest::fnv1a;
use crate::error::SetupError;
use crate::files::InputFile;
use std::path::PathBuf;

impl Setup {
    /// All files that the setup names, those in memory as well.
    ///
    /// ```
    /// use asperity::setup::Setup;
    /// let setup = Setup::from_toml(
    ///     r#"
    ///     surface = { height = "h.npy", spectrum = { table = "psd.txt" } }
    ///     load = { reduced-pressure = 0.01 }
    ///     "#,
    /// )?;
    /// let names: Vec<_> = setup.files().map(|file| file.path().display().to_string()).collect();
    /// assert_eq!(names, ["h.npy", "psd.txt"]);
    /// # Ok::<(), asperity::error::SetupError>(())
    /// ```
    pub fn files(&self) -> impl Iterator<Item = InputFile> + use<> {
        let files: Vec<InputFile> = self.clone().files_mut().map(|file| file.clone()).collect();
        files.into_iter()
    }

    /// All files that the setup names, to be named in another way.
    pub fn files_mut(&mut self) -> impl Iterator<Item = &mut InputFile> {
        let adhesion = self.adhesion.as_mut().and_then(|it| it.table.as_mut());
        let path = self.path.as_mut().and_then(|it| it.file.as_mut());
        self.surface.files_mut().chain(adhesion).chain(path)
    }

    /// The setup whose files have names that their contents alone decide.
    ///
    /// # Errors
    /// For a file that cannot be read.
    pub(super) fn with_names_by_content(mut self) -> Result<Self, SetupError> {
        if let Some(path) = &mut self.path {
            path.file = None; // its lists are in the setup
        }
        for file in self.files_mut() {
            let name = format!("{:016x}", fnv1a([file.bytes()?.as_ref()]));
            *file = PathBuf::from(name).into();
        }
        Ok(self)
    }
}

impl SetupTable {
    /// The paths of all files that the sections and keys name, those in lists as well.
    pub fn files(&self) -> Vec<PathBuf> {
        Key::of_dimension(Dimension::File).flat_map(|key| self.names_at(key.path)).map(PathBuf::from).collect()
    }

    /// The names of files at a path of keys, those in a list as well.
    pub(super) fn names_at(&self, key: &str) -> impl Iterator<Item = &str> {
        let value = self.find(key);
        let values = value.map_or(&[][..], |value| value.as_array().map_or(std::slice::from_ref(value), Vec::as_slice));
        values.iter().filter_map(toml::Value::as_str)
    }
}
