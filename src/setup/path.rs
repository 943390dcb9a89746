//! The path of a history: loads in their order, and times.

use super::one_or_more;
use crate::contact::Load;
use crate::error::{ConflictRule, SetupError};
use crate::files::InputFile;
use crate::history::PathPoint;
use serde::{Deserialize, Serialize};

/// Largest number of points of a path.
const MOST_POINTS: usize = 100_000;

/// Columns of a file with a path, and the keys of a setup that they become.
pub(super) const COLUMNS: [&str; 3] = ["time", "load", "tangential"];

/// The path of a history, as lists of the same length, one entry for each point. Between two points, loads change linearly.
///
/// In a scene it is the section `path`; a file of comma-separated values whose first row names the columns `time`, `load` and
/// `tangential`, of which some may be missing, takes the place of the lists as `path.file`.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct LoadPath {
    /// The file that the lists were read from. It is read once, so a setup that is written has the lists in its place.
    #[serde(skip_serializing)]
    pub file: Option<InputFile>,
    /// Times, 0 or later and in ascending order; two equal ones are a sudden change of the load. Needed for a solid that creeps. The
    /// load of the first point is applied at time 0.
    #[serde(
        skip_serializing_if = "Vec::is_empty",
        serialize_with = "one_or_more::serialize",
        deserialize_with = "one_or_more::times"
    )]
    pub time: Vec<f64>,
    /// Normal loads, of the same kind as the load of the setup; that one at all points if the list is left out.
    #[serde(skip_serializing_if = "Vec::is_empty", with = "one_or_more")]
    pub load: Vec<f64>,
    /// Tangential loads, of the same kind as the normal ones and of any sign; needed with friction.
    #[serde(skip_serializing_if = "Vec::is_empty", with = "one_or_more")]
    pub tangential: Vec<f64>,
    /// Number of equal steps between two points. Without it, a path with friction and a path in time have as many as their tolerance needs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps: Option<usize>,
    /// The tolerance of relative errors in time, of pressure, mean gap and lost energy; 1e-2 if it is left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time_tolerance: Option<f64>,
    /// The tolerance of relative errors of shift and lost energy by the steps of a path with friction; 1e-2 if it is left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
}

/// Two paths are equal if their points and steps are, wherever these were read from.
impl PartialEq for LoadPath {
    fn eq(&self, other: &Self) -> bool {
        let Self { file: _, time, load, tangential, steps, time_tolerance, tolerance } = self;
        (time, load, tangential) == (&other.time, &other.load, &other.tangential)
            && (steps, time_tolerance, tolerance) == (&other.steps, &other.time_tolerance, &other.tolerance)
    }
}

impl LoadPath {
    /// Number of points.
    pub fn len(&self) -> usize {
        [&self.time, &self.load, &self.tangential].into_iter().map(Vec::len).max().unwrap_or(0)
    }

    /// Whether there is no point.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Checks that the lists have one length, that times ascend from 0, and that all numbers are finite. Loads are 0 or more, unless the
    /// surfaces may be pulled apart or lifted off.
    ///
    /// # Errors
    /// [`SetupError::Conflict`].
    pub fn check(&self, may_part: bool) -> Result<(), SetupError> {
        let lists = [&self.time, &self.load, &self.tangential];
        let [times, loads, tangentials] = lists.map(Vec::len);
        let most = self.len();
        if most == 0 {
            return Err(ConflictRule::PathWithoutPoints.into());
        }
        if most > MOST_POINTS {
            let given = [("points", most.into()), ("most", MOST_POINTS.into())];
            return Err(ConflictRule::PathTooLong.with(given).into());
        }
        if [times, loads, tangentials].iter().any(|length| *length != 0 && *length != most) {
            let given = [("times", times), ("loads", loads), ("tangentials", tangentials)];
            return Err(ConflictRule::PathLengths.with(given.map(|(name, length)| (name, length.into()))).into());
        }
        for (name, list) in COLUMNS.into_iter().zip(lists) {
            let is_signed = name == "tangential" || name == "load" && may_part;
            let (least, rule) = match is_signed {
                true => (f64::NEG_INFINITY, ConflictRule::PathNotFinite),
                false => (0.0, ConflictRule::PathNegative),
            };
            if let Some(value) = list.iter().find(|value| !value.is_finite() || **value < least) {
                return Err(rule.with([("quantity", name.into()), ("value", (*value).into())]).into());
            }
        }
        if let Some(pair) = self.time.windows(2).find(|pair| pair[1] < pair[0]) {
            let given = [("before", pair[0].into()), ("time", pair[1].into())];
            return Err(ConflictRule::PathBack.with(given).into());
        }
        if self.steps == Some(0) {
            return Err(ConflictRule::PathWithoutSteps.into());
        }
        let tolerances =
            [(self.time_tolerance, ConflictRule::TimeTolerance), (self.tolerance, ConflictRule::PathTolerance)];
        for (tolerance, rule) in tolerances {
            if let Some(it) = tolerance.filter(|it| !(*it > 0.0 && *it < 1.0)) {
                return Err(rule.with([("tolerance", it.into())]).into());
            }
        }
        Ok(())
    }

    /// The points of the path, under loads of the kind of `load`.
    pub fn points(&self, load: Load) -> Vec<PathPoint> {
        let at = |list: &[f64], i: usize| list.get(i).copied();
        let point = |i: usize| PathPoint {
            time: at(&self.time, i),
            load: at(&self.load, i).map_or(load, |value| load.with_value(value)),
            tangential: at(&self.tangential, i),
        };
        (0..self.len()).map(point).collect()
    }
}
