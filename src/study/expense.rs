//! What a realisation takes, said before it is solved.

use super::realisation::Realisation;
use crate::contact::Load;
use crate::error::SetupError;
use crate::setup::{Cost, Method};

/// Seconds of a transform of a line on one core, over nodes and their binary logarithm, with all that is done between two of
/// them: of multilevel solves of rough lines of 2^12 to 2^20 nodes and surfaces of 2^16 to 2^22 on a machine of 2023.
const SECONDS: f64 = 1.3e-9;

/// What a realisation takes: seconds of one core and bytes of memory. The seconds are a model, which is the same on all machines; a
/// single one is off by a factor of two or so either way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expense {
    /// Seconds of one core.
    pub seconds: f64,
    /// Bytes at the peak.
    pub bytes: f64,
}

impl Expense {
    /// The expense of a realisation.
    ///
    /// # Errors
    /// The errors of [`Realisation::check`].
    pub fn of(realisation: &Realisation) -> Result<Self, SetupError> {
        realisation.check()?;
        let loads = &realisation.loads;
        let heaviest = loads.iter().copied().max_by(|a, b| a.value().total_cmp(&b.value()));
        let setup = realisation.under(heaviest.unwrap_or(realisation.setup.load));
        let cost = setup.cost(false, 0)?;
        let nodes = cost.grid.len() as f64;
        let side = nodes.powf(if cost.grid.is_line() { 1.0 } else { 0.5 });
        let transforms = |_: &Load| match setup.solver {
            Method::Multilevel {} => 100.0,
            // conjugate gradients and motions take longer the finer the grid is, as the square root of the nodes along a side
            Method::PolonskyKeer {} => 3.0 * 6.0 * side.sqrt(),
            Method::Gfmd(_) => 2.0 * 30.0 * side.sqrt(),
        };
        let seconds = SECONDS * nodes * nodes.log2() * loads.iter().map(transforms).sum::<f64>();
        // the pressure of the load before included
        Ok(Self { seconds, bytes: cost.bytes + Cost::of_fields(&cost.grid, 1.0).bytes })
    }
}
