//! Preparations that are to be chosen.

use super::Cost;
use super::text::SetupTable;
use crate::error::SetupError;
use crate::sentence::Sentence;
use crate::surface::PreparationChoice;

/// The word for steps that are to be chosen automatically, and its keys.
const AUTO: &str = "auto";
const PREPARE: &str = "surface.prepare";
const STEPS: &str = "surface.prepare.steps";
/// Fields that heights take while it is found out what they are like.
const SURVEY_FIELDS: f64 = 9.0;

impl SetupTable {
    /// Writes the steps that a height file needs instead of `surface.prepare.steps = "auto"`, or of `surface.prepare =
    /// "auto"` for short, so that the setup holds them one by one, and returns the reasons for them. Steps that are
    /// given beside it are kept as they are.
    ///
    /// # Errors
    /// For other words in its place, for no height file, and for one that cannot be read.
    pub fn choose_preparation(&mut self) -> Result<Vec<Sentence>, SetupError> {
        if let Some(word) = self.find(PREPARE).filter(|it| !it.is_table()).cloned() {
            self.lay(STEPS, word);
        }
        match self.find(STEPS) {
            None => return Ok(Vec::new()),
            Some(steps) if steps.as_str() == Some(AUTO) => self.remove(STEPS),
            Some(other) => {
                let reason = format!("{other} is not a preparation: give \"{AUTO}\", or the individual steps");
                return Err(SetupError::text(STEPS, reason));
            }
        }
        let mut on_its_grid = self.clone();
        on_its_grid.take_auto()?;
        let (recipe, cell) = on_its_grid.surface()?;
        Cost::from_fields(&recipe.grid(&cell)?, SURVEY_FIELDS).check("a survey")?;
        let PreparationChoice { preparation, reasons } = recipe.choice(&cell)?;
        let steps = toml::Table::try_from(preparation).expect("steps have a form in TOML");
        for (step, value) in steps {
            let path = format!("surface.prepare.{step}");
            // a crop that is chosen is a part of the one that is given
            if step == "crop" || self.find(&path).is_none() {
                self.lay(&path, value);
            }
        }
        Ok(reasons)
    }
}
