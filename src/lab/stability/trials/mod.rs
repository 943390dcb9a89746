//! All trials, by what is extreme about them.

mod gaps;
mod grids;
mod heights;
mod inputs;
mod loads;
mod shapes;
mod starts;
mod units;

use super::trial::Trial;
use crate::error::SetupError;
use shapes::Grids;

/// All trials, small ones if `is_quick`.
///
/// # Errors
/// None that is known: the grids are fixed.
pub fn trials(is_quick: bool) -> Result<Vec<Trial>, SetupError> {
    let grids = Grids::new(is_quick)?;
    let mut trials = loads::trials(grids);
    trials.extend(gaps::trials(grids));
    trials.extend(units::trials(grids));
    trials.extend(heights::trials(grids));
    trials.extend(grids::trials(is_quick));
    trials.extend(starts::trials(grids));
    trials.extend(inputs::trials(grids));
    Ok(trials)
}
