//! Digests of texts and files, and the revision of the numerics that results carry beside them.

/// Revision of the numerics. It is raised with every change that changes results by more than their tolerances, and with
/// every mended result. Tables of studies do not mix results of two revisions, and a saved result of another revision is
/// read as unchecked.
pub const NUMERICS: u32 = 1;

/// What stands between the version of the program and the revision of its numerics.
const OF_NUMERICS: &str = "+numerics.";

/// Version of the program, with the revision of its numerics, such as `0.1.0+numerics.1`.
pub(crate) fn version() -> String {
    format!("{}{OF_NUMERICS}{NUMERICS}", env!("CARGO_PKG_VERSION"))
}

/// Whether a [`version`] has the revision of the numerics of this program.
pub(crate) fn has_own_numerics(version: &str) -> bool {
    version.split_once(OF_NUMERICS).is_some_and(|(_, revision)| revision == NUMERICS.to_string())
}

/// The hash FNV-1a of some bytes, the same on every machine.
///
/// It tells damage and mix-ups: a change of one byte always changes it, and two other texts have the same one by a chance of
/// `2^-64`. It does not guard against forgery.
pub(crate) fn fnv1a<'a>(bytes: impl IntoIterator<Item = &'a [u8]>) -> u64 {
    bytes.into_iter().fold(FNV1A_OF_NOTHING, fnv1a_after)
}

/// The hash FNV-1a of no bytes.
pub(crate) const FNV1A_OF_NOTHING: u64 = 0xcbf2_9ce4_8422_2325;

/// The hash FNV-1a of bytes whose first ones have the hash `hash`.
pub(crate) fn fnv1a_after(hash: u64, bytes: &[u8]) -> u64 {
    bytes.iter().fold(hash, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}
