//! What of a setup only some drives can have, or need.

use super::{Method, Setup};

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

/// All ingredients. What is not among them, such as the surface or a layer, goes with all drives, or is checked by those that cannot have it.
pub const INGREDIENTS: &[Ingredient] = &[
    ingredient("solid.yield-stress", "a yield stress", Setup::yields),
    ingredient("viscoelastic", "creep", |it| it.viscoelastic.is_some()),
    ingredient("friction.coefficient", "friction", |it| it.friction.is_some()),
    ingredient("friction.tangential", "a single tangential load", |it| {
        it.friction.is_some_and(|friction| friction.tangential != 0.0)
    }),
    ingredient("adhesion", "adhesion", |it| it.adhesion.is_some()),
    ingredient("sliding", "sliding", |it| it.sliding.is_some()),
    ingredient("rolling", "rolling", |it| it.rolling.is_some()),
    ingredient("law.hardness", "a hardness", |it| !it.law.is_hard_wall()),
    ingredient("path.time", "times of a path", |it| it.path.as_ref().is_some_and(|path| !path.time.is_empty())),
    ingredient("path.tangential", "tangential loads of a path", |it| {
        it.path.as_ref().is_some_and(|path| !path.tangential.is_empty())
    }),
    ingredient("path", "a path", |it| it.path.is_some()),
    ingredient("solver.method", "a solver other than multilevel", |it| it.solver != Method::default()),
];

const fn ingredient(path: &'static str, name: &'static str, is_given: fn(&Setup) -> bool) -> Ingredient {
    Ingredient { path, name, is_given }
}

impl Ingredient {
    /// The ingredient that a section or key gives, if it gives one.
    pub fn find(path: &str) -> Option<&'static Self> {
        INGREDIENTS.iter().find(|it| it.path == path)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setup::{DRIVES, KEYS};

    #[test]
    fn ingredients_are_keys_or_sections_and_drives_name_no_others() {
        for ingredient in INGREDIENTS {
            let is_in = |key: &str| {
                key.strip_prefix(ingredient.path).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
            };
            assert!(KEYS.iter().any(|key| is_in(key.path)), "{}", ingredient.path);
        }
        for drive in DRIVES {
            let named = [drive.given_by].into_iter().chain(drive.takes.iter().chain(drive.needs).copied());
            named.for_each(|path| assert!(Ingredient::find(path).is_some(), "{}: {path}", drive.name));
        }
    }
}
