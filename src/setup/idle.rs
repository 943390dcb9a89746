//! Keys of a setup that have no effect, and sections that are given as lists.

use super::text::SetupTable;
use super::{FLAGS, Flag};
use crate::error::{ExpectedValue, FoundValue, SetupError, TextFault, TextPlace};
use toml::Value;

/// A key without an effect in some setups.
struct IdleKey {
    path: &'static str,
    /// Whether the rest of a setup leaves it without an effect.
    is_idle: fn(&SetupTable) -> bool,
    /// Why, and what to do.
    reason: &'static str,
}

/// All keys that could be given in vain. What a setup refuses by itself is not among them.
const IDLE: &[IdleKey] = &[
    IdleKey {
        path: "path.time-tolerance",
        is_idle: |it| it.find("path.steps").is_some(),
        reason: "it has no effect on a given number of steps: leave the steps out, or the tolerance",
    },
    IdleKey {
        path: "path.time-tolerance",
        is_idle: |it| it.find("viscoelastic").is_none(),
        reason: "it has an effect only on a solid that creeps: leave it out",
    },
    IdleKey {
        path: "path.tolerance",
        is_idle: |it| it.find("path.steps").is_some(),
        reason: "it has no effect on a given number of steps: leave the steps out, or the tolerance",
    },
    IdleKey {
        path: "path.tolerance",
        is_idle: |it| it.find("friction").is_none() || it.find("path.tangential").is_none(),
        reason: "it has an effect only on a path with friction and tangential loads: leave it out",
    },
    IdleKey {
        path: "stop.pressure-tolerance",
        is_idle: |it| it.find("solid.yield-stress").is_some(),
        reason: "it has no effect on the load steps of a body that yields below its surface: leave it out",
    },
    IdleKey {
        path: "grid.datum",
        is_idle: |it| ["solid.layer", "solid.stiffness"].iter().any(|key| it.find(key).is_some()),
        reason: "it has an effect only on a half-space: leave it out",
    },
    IdleKey {
        path: "record.iterations",
        is_idle: |it| it.find("solid.yield-stress").is_none(),
        reason: "it has an effect only on a body that yields below its surface: leave it out",
    },
    IdleKey {
        path: "record.raster-at",
        is_idle: |it| !it.has_part("raster"),
        reason: "the part raster is not recorded: name it among the parts, or leave this out",
    },
];

impl SetupTable {
    /// Refuses keys that have no effect beside the others.
    ///
    /// # Errors
    /// [`SetupError::Text`].
    pub fn check_idle(&self) -> Result<(), SetupError> {
        match IDLE.iter().find(|key| self.find(key.path).is_some() && (key.is_idle)(self)) {
            Some(key) => Err(SetupError::text(key.path, key.reason)),
            None => Ok(()),
        }
    }

    /// Refuses lists in the place of sections, such as `path = [0, 1]`, whose values could be taken for those of any keys.
    ///
    /// # Errors
    /// [`SetupError::Text`].
    pub(super) fn check_sections(&self) -> Result<(), SetupError> {
        // what is wrong with a load is said where loads are read
        let above = |flag: &Flag| flag.path.rsplit_once('.').map(|(above, _)| above).filter(|above| *above != "load");
        match FLAGS.iter().filter_map(above).find(|path| self.find(path).is_some_and(Value::is_array)) {
            Some(path) => Err(list_of_section(path)),
            None => Ok(()),
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
    let is_section = FLAGS.iter().any(|flag| flag.path.rsplit_once('.').is_some_and(|(above, _)| above == path));
    is_section && !values.iter().all(|value| value.is_table() || value.is_str())
}

/// The error of a list in the place of a section.
pub(super) fn list_of_section(path: &str) -> SetupError {
    let keys = FLAGS.iter().filter_map(|flag| flag.path.strip_prefix(path)?.strip_prefix('.'));
    let keys: Vec<String> = keys.filter(|key| !key.contains('.')).map(|key| format!("`{key}`")).collect();
    let expected = ExpectedValue::Section(format!("keys {}", keys.join(", ")));
    SetupError::Text {
        place: TextPlace::keys(path),
        fault: TextFault::WrongType { found: FoundValue::List, expected }.into(),
    }
}
