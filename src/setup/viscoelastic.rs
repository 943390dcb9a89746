//! Solids that creep, and contacts that move over them.

use super::one_or_more;
use crate::elastic::{Prony, PronyTerm};
use crate::error::{ConflictRule, SetupError, SolidError};
use crate::quantity;
use serde::{Deserialize, Serialize};

/// How a solid creeps: a Prony series, with one Poisson ratio at all times. The elastic constants of the solid are those at once
/// after loading.
///
/// In a scene it is the section `viscoelastic`, with one of two lists of pairs, a ratio and a time each.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct Viscoelastic {
    /// Creep form: ratios `f_j` and retardation times, `J(t) E_0 = 1 + sum f_j (1 - exp(-t/tau_j))`.
    #[serde(skip_serializing_if = "Vec::is_empty", deserialize_with = "one_or_more::ratios_and_times")]
    pub creep: Vec<f64>,
    /// Relaxation form: ratios `g_j` and relaxation times, `E(t)/E_0 = 1 - sum g_j (1 - exp(-t/tau_j))`.
    #[serde(skip_serializing_if = "Vec::is_empty", deserialize_with = "one_or_more::ratios_and_times")]
    pub relaxation: Vec<f64>,
}

impl Viscoelastic {
    /// The Prony series in creep form.
    ///
    /// # Errors
    /// [`SetupError::Conflict`] for lists that are no pairs, or for both or none of them; the errors of [`Prony::new`] and of
    /// [`Prony::from_relaxation`].
    pub fn prony(&self) -> Result<Prony, SetupError> {
        let (form, list) = match (self.creep.as_slice(), self.relaxation.as_slice()) {
            ([], []) => return Err(ConflictRule::CreepWithoutTerms.into()),
            (creep, []) => ("creep", creep),
            ([], relaxation) => ("relaxation", relaxation),
            _ => return Err(ConflictRule::CreepTwice.into()),
        };
        if !list.len().is_multiple_of(2) {
            let given = [("form", form.into()), ("values", list.len().into())];
            return Err(ConflictRule::CreepPairs.with(given).into());
        }
        let terms: Vec<PronyTerm> = list.chunks_exact(2).map(|it| PronyTerm { ratio: it[0], time: it[1] }).collect();
        let prony: Result<Prony, SolidError> =
            if form == "creep" { Prony::new(terms) } else { Prony::from_relaxation(&terms) };
        Ok(prony?)
    }
}

/// Steady sliding over a solid that creeps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct SlidingMotion {
    /// Speeds, one steady state each, lengths per time.
    #[serde(serialize_with = "one_or_more::serialize", deserialize_with = "one_or_more::speeds")]
    pub speed: Vec<f64>,
}

/// Steady rolling with friction: a creepage or a tangential load, one steady state for each value.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct RollingMotion {
    /// Creepages: the relative differences of the speeds of both surfaces.
    #[serde(
        skip_serializing_if = "Vec::is_empty",
        serialize_with = "one_or_more::serialize",
        deserialize_with = "one_or_more::numbers"
    )]
    pub creepage: Vec<f64>,
    /// Tangential loads, of the same kind as the normal one and of any sign; 0 for free rolling.
    #[serde(skip_serializing_if = "Vec::is_empty", with = "one_or_more")]
    pub tangential: Vec<f64>,
    /// The length of a step of the discretised rolling; the spacing of the grid if it is left out.
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "quantity::some_length")]
    pub step: Option<f64>,
}

impl SlidingMotion {
    /// Checks the speeds.
    ///
    /// # Errors
    /// [`SetupError::Conflict`] for no speed, and for one that is not positive and finite.
    pub fn check(&self) -> Result<(), SetupError> {
        match self.speed.iter().find(|it| !(it.is_finite() && **it > 0.0)) {
            Some(speed) => Err(ConflictRule::SlidingSpeed.with([("speed", (*speed).into())]).into()),
            None if self.speed.is_empty() => Err(ConflictRule::SlidingWithoutSpeed.into()),
            None => Ok(()),
        }
    }
}

impl RollingMotion {
    /// Checks the values.
    ///
    /// # Errors
    /// [`SetupError::Conflict`] for no value, for creepages beside loads, and for values that are not finite.
    pub fn check(&self) -> Result<(), SetupError> {
        if self.creepage.is_empty() == self.tangential.is_empty() {
            return Err(ConflictRule::RollingDrives.into());
        }
        if let Some(value) = self.creepage.iter().chain(&self.tangential).find(|it| !it.is_finite()) {
            return Err(ConflictRule::RollingValue.with([("value", (*value).into())]).into());
        }
        match self.step {
            Some(step) if !(step.is_finite() && step > 0.0) => {
                Err(ConflictRule::RollingStep.with([("step", step.into())]).into())
            }
            _ => Ok(()),
        }
    }
}
