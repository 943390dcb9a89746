//! What of a setup only some drives can have, or need.

use super::Setup;

/// Something that a setup may give, and that only some drives can have beside them or need.
///
/// A drive names those that it takes, and is refused with any other one: a new ingredient is refused by all drives that do not name it.
pub struct Ingredient {
    /// The section or key of the setup that gives it.
    pub path: &'static str,
    /// Its name in sentences.
    pub name: &'static str,
    /// Whether a setup gives it.
    pub(super) is_given: fn(&Setup) -> bool,
}
