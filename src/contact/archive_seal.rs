//! The seal of an archive: a digest that says whether it is as it was written.
//!
//! A result is believed as it was saved if it is as it was written, by a program with the same numerics: to solve it again
//! would take as long as the solve. The digest guards against damage and mix-ups, not against forgery.

use crate::digest::{fnv1a, fnv1a_after, has_own_numerics, version};
use crate::error::FileError;
use crate::formats::{MemberSum, read_member_sums, read_text};
use std::path::Path;

/// The array that holds the seal: the digest and the version of the program with the revision of its numerics, in words.
pub(super) const SEAL: &str = "digest";

/// What the seal of an archive says about its results.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ArchiveSeal {
    /// The archive is as this revision of the numerics wrote it.
    Whole,
    /// The archive has no seal: an earlier version or another program wrote it.
    Missing,
    /// The archive is not as it was written: arrays were changed, exchanged, added or removed.
    Broken,
    /// The archive is as another revision of the numerics wrote it, whose version is given.
    OfOther(String),
}

impl ArchiveSeal {
    /// The seal of the archive in a file, all of whose arrays are read.
    ///
    /// # Errors
    /// [`FileError::Format`] for an archive that is cut short or has an array that fails its check sum.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        let sums = read_member_sums(path)?;
        if !sums.iter().any(|sum| sum.name == SEAL) {
            return Ok(Self::Missing);
        }
        let text = read_text(path, SEAL)?.unwrap_or_default();
        let Some((_, version)) = text.split_once(' ') else { return Ok(Self::Broken) };
        let mut digest = ArchiveDigest::new(version);
        sums.iter().filter(|sum| sum.name != SEAL).for_each(|sum| digest.add(sum));
        Ok(match digest.seal(version) == text {
            false => Self::Broken,
            true if has_own_numerics(version) => Self::Whole,
            true => Self::OfOther(version.into()),
        })
    }

    /// What is wrong with the archive `name`, in a sentence; none if it is whole.
    pub fn doubt(&self, name: &str) -> Option<String> {
        let reason = match self {
            Self::Whole => return None,
            Self::Missing => "has no digest, as an earlier version or another program wrote it".into(),
            Self::Broken => "is not as it was written: its arrays or its setup were changed".into(),
            Self::OfOther(version) => format!("was written by version {version}, whose numerics are not those here"),
        };
        Some(format!(
            "The result in {name} is unchecked: the file {reason}. Solve it again, or check a contact with `asperity certify`."
        ))
    }
}

/// The digest of the members of an archive, in their order.
pub(super) struct ArchiveDigest(u64);

impl ArchiveDigest {
    /// The digest of an archive without members, by a version of the program.
    fn new(version: &str) -> Self {
        Self(fnv1a([version.as_bytes()]))
    }

    /// The digest of an archive that this program begins.
    pub(crate) fn own() -> Self {
        Self::new(&version())
    }

    /// Adds a member: its name, its length and its check sum, which stand for its bytes.
    pub(crate) fn add(&mut self, MemberSum { name, bytes, crc }: &MemberSum) {
        let own = fnv1a([name.as_bytes(), &bytes.to_le_bytes(), &crc.to_le_bytes()]);
        self.0 = fnv1a_after(self.0, &own.to_le_bytes());
    }

    /// The text of the seal of a version.
    fn seal(&self, version: &str) -> String {
        format!("fnv1a-{:016x} {version}", self.0)
    }

    /// The text of the seal of this program.
    pub(crate) fn own_seal(&self) -> String {
        self.seal(&version())
    }
}
