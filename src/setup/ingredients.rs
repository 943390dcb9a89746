//! The ingredients of a setup: its drives, and what these can have beside them.

use super::{DRIVES, Ingredient, Method, Setup};

/// Those that are no drives. What is not among the ingredients, such as the surface or a layer, goes with all drives, or is checked by those that cannot have
/// it.
const BESIDE_DRIVES: &[Ingredient] = &[
    ingredient("friction.coefficient", "friction", |it| it.friction.is_some()),
    ingredient("friction.tangential", "a single tangential load", |it| {
        it.friction.is_some_and(|friction| friction.tangential != 0.0)
    }),
    ingredient("law.hardness", "a hardness", |it| !it.law.is_hard_wall()),
    ingredient("path.time", "times of a path", |it| it.path.as_ref().is_some_and(|path| !path.time.is_empty())),
    ingredient("path", "a path", |it| it.path.is_some()),
    ingredient("solver.method", "a solver other than multilevel", |it| it.solver != Method::default()),
];

const fn ingredient(path: &'static str, name: &'static str, is_given: fn(&Setup) -> bool) -> Ingredient {
    Ingredient { path, name, is_given }
}

impl Ingredient {
    /// All ingredients: the drives, and what they can have beside them.
    pub(super) fn all() -> impl Iterator<Item = &'static Self> {
        DRIVES.iter().map(|drive| &drive.given).chain(BESIDE_DRIVES)
    }

    /// The ingredient that a section or key gives, if it gives one.
    pub(super) fn find(path: &str) -> Option<&'static Self> {
        Self::all().find(|it| it.path == path)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setup::Key;

    #[test]
    fn ingredients_are_keys_or_sections_and_drives_name_no_others() {
        for ingredient in Ingredient::all() {
            let path = ingredient.path;
            let is_in = |key: &str| key.strip_prefix(path).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'));
            assert!(Key::all().any(|key| is_in(key.path)), "{path}");
        }
        for drive in DRIVES {
            let mut named = drive.takes.iter().chain(drive.needs);
            assert!(named.all(|path| Ingredient::find(path).is_some()), "{}", drive.name);
        }
    }
}
