//! What of a setup does not go together with its drive, or is missing for it.

use super::{DRIVES, Drive, Ingredient, LOADS, Method, Setup};
use crate::error::{ConflictRule, SetupError};

impl Setup {
    /// The drive that the setup asks for; none for a contact without a history.
    ///
    /// # Errors
    /// [`SetupError::Conflict`] for what does not go together, and for what is missing.
    pub fn drive(&self) -> Result<Option<&'static Drive>, SetupError> {
        let drive = DRIVES.iter().copied().rfind(|drive| !drive.is_list && (drive.given.is_given)(self));
        self.check_together(drive)?;
        drive.map_or(Ok(()), |drive| self.check_ingredients(drive))?;
        if self.loads.is_empty() {
            return Ok(drive);
        }
        // a contact that slides at one speed is a single state, which may be loaded several times like any other one
        if let Some(drive) = drive.filter(|_| self.speed().is_none()) {
            return Err(not_together(drive, LOADS.given.name));
        }
        self.check_ingredients(&LOADS)?;
        Ok(Some(&LOADS))
    }

    /// Refuses an ingredient that a drive does not take, and one that it needs and that is not given.
    fn check_ingredients(&self, drive: &Drive) -> Result<(), SetupError> {
        let takes = |path: &str| path == drive.given.path || drive.takes.contains(&path) || drive.needs.contains(&path);
        if let Some(other) = Ingredient::all().find(|it| (it.is_given)(self) && !takes(it.path)) {
            return Err(not_together(drive, other.name));
        }
        let mut needed = drive.needs.iter().filter_map(|path| Ingredient::find(path));
        match needed.find(|it| !(it.is_given)(self)) {
            Some(needed) => {
                let given = [("drive", drive.given.name.into()), ("needed", needed.name.into())];
                Err(ConflictRule::NotAlone.with(given).into())
            }
            None => Ok(()),
        }
    }

    /// Refuses sections of which it is not clear which drive they are meant for.
    fn check_together(&self, drive: Option<&Drive>) -> Result<(), SetupError> {
        Err(match &self.path {
            _ if self.yield_law().is_some() && !self.yields() => ConflictRule::HardeningWithoutYield,
            _ if self.adhesion.is_some() && self.is_by_gfmd() => ConflictRule::AdhesionByGfmd,
            Some(path) if drive.is_none() && path.is_empty() => ConflictRule::PathWithoutPoints,
            Some(_) if drive.is_none() => ConflictRule::PathWithoutTangential,
            _ => return Ok(()),
        }
        .into())
    }

    /// Refuses a solver or a load that a drive cannot have.
    pub(super) fn check_beside(&self, drive: &Drive) -> Result<(), SetupError> {
        if self.is_by_gfmd() && !drive.is_list {
            return Err(ConflictRule::HistoryByGfmd.into());
        }
        if drive.needs_pressure && !self.load.is_pressure() {
            return Err(ConflictRule::SlipLoad.with([("load", self.load.to_string().into())]).into());
        }
        Ok(())
    }

    fn is_by_gfmd(&self) -> bool {
        matches!(self.solver, Method::Gfmd(_))
    }
}

/// The refusal of a drive with another ingredient.
fn not_together(drive: &Drive, other: &str) -> SetupError {
    ConflictRule::NotTogether.with([("drive", drive.given.name.into()), ("other", other.into())]).into()
}

#[cfg(test)]
mod tests {
    use crate::error::ConflictRule;
    use crate::setup::Key;
    use strum::IntoEnumIterator;

    #[test]
    fn rules_concern_sections_and_keys_of_setups() {
        for rule in ConflictRule::iter() {
            for key in rule.keys() {
                let is_in =
                    |path: &str| path == key || path.strip_prefix(key).is_some_and(|rest| rest.starts_with('.'));
                assert!(Key::all().any(|key| is_in(key.path)), "{rule:?}: {key}");
            }
        }
    }
}
