//! Why keys of a setup have no effect, and sections that are given as lists.

use super::text::SetupTable;
use super::{KEYS, Key};
use crate::error::{ExpectedValue, FoundValue, SetupError, TextFault, TextPlace};
use toml::Value;

/// A reason why a key would have no effect.
pub struct Idle {
    /// Whether the rest of a setup leaves the key without an effect.
    is_so: fn(&SetupTable) -> bool,
    /// Why, and what to do.
    reason: &'static str,
}

// What a setup refuses by itself is not among these.

pub(super) const GIVEN_STEPS: Idle = Idle {
    is_so: |it| it.find("path.steps").is_some(),
    reason: "it has no effect on a given number of steps: leave the steps out, or the tolerance",
};

pub(super) const NO_CREEP: Idle = Idle {
    is_so: |it| it.find("viscoelastic").is_none(),
    reason: "it has an effect only on a solid that creeps: leave it out",
};

pub(super) const NO_FRICTION_PATH: Idle = Idle {
    is_so: |it| it.find("friction").is_none() || it.find("path.tangential").is_none(),
    reason: "it has an effect only on a path with friction and tangential loads: leave it out",
};

pub(super) const YIELDING: Idle = Idle {
    is_so: |it| it.find("solid.yield-stress").is_some(),
    reason: "it has no effect on the load steps of a body that yields below its surface: leave it out",
};

pub(super) const NO_YIELDING: Idle = Idle {
    is_so: |it| it.find("solid.yield-stress").is_none(),
    reason: "it has an effect only on a body that yields below its surface: leave it out",
};

pub(super) const NO_HALF_SPACE: Idle = Idle {
    is_so: |it| ["solid.layer", "solid.stiffness"].iter().any(|key| it.find(key).is_some()),
    reason: "it has an effect only on a half-space: leave it out",
};

pub(super) const NO_RASTER: Idle = Idle {
    is_so: |it| !it.has_part("raster"),
    reason: "the part raster is not recorded: name it among the parts, or leave this out",
};

impl SetupTable {
    /// Refuses keys that have no effect beside the others.
    ///
    /// # Errors
    /// [`SetupError::Text`].
    pub fn check_idle(&self) -> Result<(), SetupError> {
        for key in KEYS.iter().filter(|key| self.find(key.path).is_some()) {
            if let Some(idle) = key.idle.iter().find(|idle| (idle.is_so)(self)) {
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
        match KEYS.iter().filter_map(above).find(|path| self.find(path).is_some_and(Value::is_array)) {
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
    let is_section = KEYS.iter().any(|key| key.path.rsplit_once('.').is_some_and(|(above, _)| above == path));
    is_section && !values.iter().all(|value| value.is_table() || value.is_str())
}

/// The error of a list in the place of a section.
pub(super) fn list_of_section(path: &str) -> SetupError {
    let keys = KEYS.iter().filter_map(|key| key.path.strip_prefix(path)?.strip_prefix('.'));
    let keys: Vec<String> = keys.filter(|key| !key.contains('.')).map(|key| format!("`{key}`")).collect();
    let expected = ExpectedValue::Section(format!("keys {}", keys.join(", ")));
    SetupError::Text {
        place: TextPlace::keys(path),
        fault: TextFault::WrongType { found: FoundValue::List, expected }.into(),
    }
}
