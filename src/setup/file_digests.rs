//! Digests of the files that a saved setup names.
//!
//! A saved setup names its files as they were given, since the path of a folder tells others where and as whom a person works. Its section
//! `files` has the digest of each: with it the file is found again beside the result or in the working folder, and another file of the same
//! name is not taken for it.

use super::{Dimension, Key, Setup, SetupTable};
use crate::digest::{FNV1A_OF_NOTHING, fnv1a_after};
use crate::error::{FileError, SetupError};
use crate::files::{InputFile, open_regular, path_in_text};
use serde::{Serialize, Serializer};
use std::collections::BTreeMap;
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};

/// The section of a saved setup that holds digests by the names of files.
const SECTION: &str = "files";

/// Bytes of a file that are in memory at the same time, while its digest is computed: maps of heights may have gigabytes.
const PIECE_BYTES: usize = 1 << 16;

/// The digest of what is in a file: `fnv1a-` and sixteen hexadecimal digits. It tells files apart that were mixed up or have changed. It does not
/// protect against forgery.
fn digest_of(path: &Path) -> io::Result<String> {
    let mut file = open_regular(path)?;
    let (mut hash, mut piece) = (FNV1A_OF_NOTHING, vec![0; PIECE_BYTES]);
    loop {
        match file.read(&mut piece)? {
            0 => return Ok(format!("fnv1a-{hash:016x}")),
            count => hash = fnv1a_after(hash, &piece[..count]),
        }
    }
}

/// Whether a path is a file with this digest. A file that cannot be read is not.
fn has_digest(path: &Path, digest: &str) -> bool {
    digest_of(path).is_ok_and(|found| found == digest)
}

/// A setup as it is saved with a result.
#[derive(Serialize)]
struct SavedSetup<'a> {
    #[serde(flatten)]
    setup: &'a Setup,
    /// Digests by the names of files.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    files: BTreeMap<String, String>,
}

impl<'a> SavedSetup<'a> {
    /// The setup with the digests of its files. A file that cannot be read any more has none.
    fn new(setup: &'a Setup) -> Self {
        let mut files = BTreeMap::new();
        for file in setup.files().filter(InputFile::is_on_disk) {
            if let Ok(digest) = digest_of(file.path()) {
                files.insert(file.into(), digest);
            }
        }
        Self { setup, files }
    }
}

impl Setup {
    /// The setup as it is saved with a result: its files have the names that were given, and the section `files` has their digests.
    pub fn to_saved_table(&self) -> SetupTable {
        SetupTable::from_value(&SavedSetup::new(self)).with_loads(&self.loads)
    }

    /// The text of [`Setup::to_saved_table`], with the sections in their usual order.
    pub fn to_saved_toml(&self) -> String {
        match self.loads.as_slice() {
            [] => toml::to_string(&SavedSetup::new(self)).expect("a setup has a form in TOML"),
            _ => self.to_saved_table().to_toml(),
        }
    }

    /// Serialises the setup as it is saved, for summaries in JSON.
    ///
    /// # Errors
    /// The errors of the serializer.
    pub fn serialize_saved<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match self.loads.as_slice() {
            [] => SavedSetup::new(self).serialize(to),
            _ => self.to_saved_table().serialize(to),
        }
    }
}

impl SetupTable {
    /// The digests by the names of files.
    fn digests(&self) -> BTreeMap<String, String> {
        let section = self.find(SECTION).and_then(toml::Value::as_table).into_iter().flatten();
        section.filter_map(|(name, digest)| Some((name.clone(), digest.as_str()?.to_owned()))).collect()
    }

    /// Forgets the digests of files, where nothing is read from these.
    pub fn without_digests(mut self) -> Self {
        self.remove(SECTION);
        self
    }

    /// The sections and keys of a saved result at `path` with the names under which its files are found from here. A file without a digest keeps
    /// its name.
    ///
    /// # Errors
    /// For a path that is not UTF-8.
    pub fn with_files_of_result(self, path: &Path) -> Result<Self, FileError> {
        self.with_names(|name, digest| digest.map(|digest| found_file(path, name, digest)))
    }

    /// The sections and keys with the files that lie in the folder of the file `path`. A file with a digest may lie in the working folder as well.
    ///
    /// # Errors
    /// For a folder whose path is not UTF-8.
    pub fn beside(self, path: &Path) -> Result<Self, FileError> {
        self.with_names(|name, digest| match digest {
            Some(digest) => Some(found_file(path, name, digest)),
            None => Some(path.with_file_name(name)),
        })
    }

    /// Writes the sections and keys of a saved setup as the scene `path`. Where that is below the working folder, files have the names by which they are found
    /// from there: `h.npy` is `../h.npy` for `out/scene.toml`. Otherwise names stay, since a relative path between the two folders would name folders
    /// of the user.
    ///
    /// # Errors
    /// The errors of [`write_beside`](crate::files::write_beside).
    pub fn write_scene(self, path: &Path) -> Result<(), FileError> {
        let folder = path.parent().unwrap_or(Path::new(""));
        let is_below = folder.components().all(|part| matches!(part, Component::Normal(_)));
        let up: PathBuf = folder.components().map(|_| Component::ParentDir).collect();
        let seen = |name: &str, digest: Option<&String>| digest.filter(|_| is_below).map(|_| up.join(name));
        self.with_names(seen)?.write(path)
    }

    /// The sections and keys with other names of files. The function `choose` gets the name and the digest of a file, and returns its new name, or none
    /// where the name stays.
    fn with_names(mut self, choose: impl Fn(&str, Option<&String>) -> Option<PathBuf>) -> Result<Self, FileError> {
        let old = self.digests();
        let mut new = toml::Table::new();
        for key in Key::of_dimension(Dimension::File) {
            for value in self.find_mut(key.path).map(list_mut).unwrap_or_default() {
                let toml::Value::String(name) = value else { continue };
                let digest = old.get(name);
                if let Some(path) = choose(name, digest) {
                    *name = path_in_text(&path)?;
                }
                if let Some(digest) = digest {
                    new.insert(name.clone(), digest.clone().into());
                }
            }
        }
        self.remove(SECTION);
        if !new.is_empty() {
            self.lay(SECTION, new.into());
        }
        Ok(self)
    }

    /// Whether the files that the surface is made from are there, be it with other contents. Results of earlier versions have no digests, but full
    /// paths. The name of heights that were given as an array is no file.
    pub fn has_files_of_surface(&self) -> bool {
        let digests = self.digests();
        let keys = Key::of_dimension(Dimension::File).filter(|key| key.section() == "surface");
        let mut names = keys.flat_map(|key| self.names_at(key.path));
        names.all(|name| {
            let is_known = digests.contains_key(name) || Path::new(name).is_absolute();
            is_known && Path::new(name).is_file()
        })
    }

    /// Takes the digests out, and checks that the files that are named have them. A name that was given anew has none.
    ///
    /// # Errors
    /// [`SetupError::Text`] for a file that is missing or has changed.
    pub(super) fn check_digests(&mut self) -> Result<(), SetupError> {
        let digests = self.digests();
        self.remove(SECTION);
        for key in Key::of_dimension(Dimension::File) {
            for value in self.find_mut(key.path).map(list_mut).unwrap_or_default() {
                let toml::Value::String(name) = value else { continue };
                let Some(digest) = digests.get(name) else { continue };
                let path = Path::new(name.as_str());
                if !has_digest(path, digest) {
                    let what = if path.exists() { "is another file now" } else { "is not there" };
                    let reason = format!(
                        "{name} {what}: give the file that the result was made from, beside the result or under this key"
                    );
                    return Err(SetupError::text(key.path, reason));
                }
            }
        }
        Ok(())
    }
}

/// Where a file with this digest is, which a result at `path` names: in the folder of the result, in the working folder, or under its last name beside
/// the result. Otherwise the first file of that name, or the name itself.
fn found_file(path: &Path, name: &str, digest: &str) -> PathBuf {
    let last = Path::new(name).file_name().unwrap_or_default();
    let places = [path.with_file_name(name), PathBuf::from(name), path.with_file_name(last)];
    let right = places.iter().find(|place| has_digest(place, digest));
    right.or_else(|| places.iter().find(|place| place.is_file())).cloned().unwrap_or_else(|| name.into())
}

/// The values of a list, or a single one.
fn list_mut(value: &mut toml::Value) -> &mut [toml::Value] {
    match value {
        toml::Value::Array(values) => values,
        one => std::slice::from_mut(one),
    }
}
