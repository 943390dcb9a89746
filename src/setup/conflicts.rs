//! What of a setup does not go together with its drive, or is missing for it.

use super::{DRIVES, Drive, INGREDIENTS, Ingredient, LoadPath, Method, Setup};
use crate::error::{ConflictRule, SetupError};

impl Setup {
    /// The drive that the setup asks for; none for a contact without a history.
    ///
    /// # Errors
    /// [`SetupError::Conflict`] for what does not go together, and for what is missing.
    pub fn drive(&self) -> Result<Option<&'static Drive>, SetupError> {
        self.check_together()?;
        let is_given = |drive: &&&Drive| Ingredient::find(drive.given_by).is_some_and(|it| (it.is_given)(self));
        let Some(drive) = DRIVES.iter().find(is_given) else { return Ok(None) };
        self.check_ingredients(drive)?;
        Ok(Some(drive))
    }

    /// Refuses an ingredient that a drive does not take, and one that it needs and that is not given.
    fn check_ingredients(&self, drive: &Drive) -> Result<(), SetupError> {
        let takes = |path: &str| path == drive.given_by || drive.takes.contains(&path) || drive.needs.contains(&path);
        if let Some(other) = INGREDIENTS.iter().find(|it| (it.is_given)(self) && !takes(it.path)) {
            let given = [("drive", drive.in_sentences().into()), ("other", other.name.into())];
            return Err(ConflictRule::NotTogether.with(given).into());
        }
        let needed = drive.needs.iter().filter_map(|path| Ingredient::find(path));
        match needed.into_iter().find(|it| !(it.is_given)(self)) {
            Some(needed) => {
                let given = [("drive", drive.in_sentences().into()), ("needed", needed.name.into())];
                Err(ConflictRule::NotAlone.with(given).into())
            }
            None => Ok(()),
        }
    }

    /// Refuses sections that are wrong whatever the drive is, or of which it is not clear which drive they are meant for.
    fn check_together(&self) -> Result<(), SetupError> {
        let has_path = |is_so: fn(&LoadPath) -> bool| self.path.as_ref().is_some_and(is_so);
        let has_drive = self.viscoelastic.is_some() || self.adhesion.is_some() || self.yields();
        let moves = self.sliding.is_some() || self.rolling.is_some();
        Err(match () {
            () if self.yield_law().is_some() && !self.yields() => ConflictRule::HardeningWithoutYield,
            () if self.adhesion.is_some() && self.is_by_gfmd() => ConflictRule::AdhesionByGfmd,
            // without a path, a body that yields goes to its load
            () if !self.yields() && has_path(LoadPath::is_empty) => ConflictRule::PathWithoutPoints,
            () if !has_drive && !moves && has_path(|path| path.tangential.is_empty()) => {
                ConflictRule::PathWithoutTangential
            }
            () => return Ok(()),
        }
        .into())
    }

    /// Refuses a solver or a load that a drive cannot have.
    pub(super) fn check_beside(&self, drive: &Drive) -> Result<(), SetupError> {
        if self.is_by_gfmd() {
            return Err(ConflictRule::HistoryByGfmd.into());
        }
        if drive.needs_pressure && !self.load.is_pressure() {
            return Err(ConflictRule::SlipLoad.with([("load", self.load.to_string())]).into());
        }
        Ok(())
    }

    fn is_by_gfmd(&self) -> bool {
        matches!(self.solver, Method::Gfmd(_))
    }
}

#[cfg(test)]
mod tests {
    use crate::error::ConflictRule;
    use crate::setup::KEYS;
    use strum::IntoEnumIterator;

    #[test]
    fn rules_concern_sections_and_keys_of_setups() {
        for rule in ConflictRule::iter() {
            for key in rule.keys() {
                let is_in =
                    |path: &str| path == key || path.strip_prefix(key).is_some_and(|rest| rest.starts_with('.'));
                assert!(KEYS.iter().any(|key| is_in(key.path)), "{rule:?}: {key}");
            }
        }
    }
}
