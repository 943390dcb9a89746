//! Keys of a setup that have no effect, and sections that are given as lists.

use super::Key;
use super::idle::IdleCause;
use super::text::SetupTable;
use crate::error::{ExpectedValue, FoundValue, SetupError, TextFault, TextPlace};
use toml::Value;

impl SetupTable {
    /// Refuses keys that have no effect beside the others.
    ///
    /// # Errors
    /// [`SetupError::Text`].
    pub fn check_idle(&self) -> Result<(), SetupError> {
        for key in Key::all().filter(|key| self.find(key.path).is_some()) {
            if let Some(idle) = key.idle.iter().find(|idle| self.has(&idle.cause)) {
                return Err(SetupError::text(key.path, idle.reason));
            }
        }
        Ok(())
    }

    /// Refuses lists in the place of sections, such as `path = [0, 1]`, whose values could be taken for those of any keys.
    ///
    /// # Errors
    /// [`SetupError::Text`].
    pub(super) fn check_sections(&self) -> Result<(), SetupError> {
        // what is wrong with a load is said where loads are read
        let above = |key: &Key| key.path.rsplit_once('.').map(|(above, _)| above).filter(|above| *above != "load");
        match Key::all().filter_map(above).find(|path| self.find(path).is_some_and(Value::is_array)) {
            Some(path) => Err(list_of_section(path)),
            None => Ok(()),
        }
    }

    /// Whether the setup has what leaves a key without an effect.
    fn has(&self, cause: &IdleCause) -> bool {
        match cause {
            IdleCause::Given(keys) => keys.iter().any(|key| self.find(key).is_some()),
            IdleCause::Missing(keys) => keys.iter().any(|key| self.find(key).is_none()),
            IdleCause::PartMissing(part) => !self.has_part(part),
        }
    }

    /// Whether a part is among those to record.
    fn has_part(&self, part: &str) -> bool {
        let is_it = |value: &Value| value.as_str() == Some(part);
        let parts = self.find("record.what");
        parts.is_some_and(|parts| is_it(parts) || parts.as_array().is_some_and(|parts| parts.iter().any(is_it)))
    }
}

/// Whether a list at a path of keys stands in the place of a section, and not for several sections of a study.
pub(super) fn is_list_of_section(path: &str, values: &[Value]) -> bool {
    let is_section = Key::all().any(|key| key.path.rsplit_once('.').is_some_and(|(above, _)| above == path));
    is_section && !values.iter().all(|value| value.is_table() || value.is_str())
}

/// The error of a list in the place of a section.
pub(super) fn list_of_section(path: &str) -> SetupError {
    let keys = Key::all().filter_map(|key| key.path.strip_prefix(path)?.strip_prefix('.'));
    let keys: Vec<String> = keys.filter(|key| !key.contains('.')).map(|key| format!("`{key}`")).collect();
    let expected = ExpectedValue::Section(format!("keys {}", keys.join(", ")));
    SetupError::Text {
        place: TextPlace::keys(path),
        fault: TextFault::WrongType { found: FoundValue::List, expected }.into(),
    }
}
