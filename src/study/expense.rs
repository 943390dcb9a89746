//! The cost of a realisation, known before it is solved.

use super::realisation::Realisation;
use crate::contact::Load;
use crate::error::SetupError;
use crate::setup::{Cost, Extras, Method};

/// Seconds of a transform on one core, over nodes and their binary logarithm, with all that is done between two of them. Measured,
/// as are the numbers of transforms, on rough lines of 2^10 to 2^20 nodes and surfaces of 2^14 to 2^20.
const SECONDS: f64 = 0.8e-9;

/// Transforms that take as long as the leakage along both axes, measured on rough surfaces of 2^18 and 2^20 nodes.
const TRANSFORMS_OF_LEAKAGE: f64 = 1000.0;

/// The cost of a realisation: seconds of one core and bytes of memory. The seconds are from a model that is the same on
/// all machines, so that all machines divide a study in the same way. They may be wrong by a factor of four for GFMD
/// and for solids that yield, and of two otherwise.
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
    pub fn new(realisation: &Realisation) -> Result<Self, SetupError> {
        realisation.check()?;
        let loads = &realisation.loads;
        let heaviest = loads.iter().copied().max_by(|a, b| a.value().total_cmp(&b.value()));
        let setup = realisation.under(heaviest.unwrap_or(realisation.setup.load));
        let cost = setup.cost(&Extras::default())?;
        let nodes = cost.grid.len() as f64;
        let side = nodes.powf(if cost.grid.is_line() { 1.0 } else { 0.5 });
        let transforms = |load: &Load| match setup.solver {
            Method::Multilevel {} => 100.0,
            Method::PolonskyKeer {} => 30.0 * side.powf(0.28),
            Method::Gfmd(_) => 20.0 * side.sqrt() * lightness(load),
        };
        let states = match setup.history_drive()? {
            Some(drive) => (drive.transforms)(&setup, &cost.grid)? * setup.expected_states()? as f64,
            None => 0.0,
        };
        let transforms = |load: &Load| if states > 0.0 { states } else { transforms(load) };
        let transforms = |load: &Load| transforms(load) + if setup.flow.leakage { TRANSFORMS_OF_LEAKAGE } else { 0.0 };
        let seconds = SECONDS * nodes * nodes.log2() * loads.iter().map(transforms).sum::<f64>();
        // the pressure of the load before included
        Ok(Self { seconds, bytes: cost.bytes + Cost::from_fields(&cost.grid, 1.0).bytes })
    }
}

/// Factor by which a motion takes longer under a small load than under a large one, if the load is known.
fn lightness(load: &Load) -> f64 {
    let reduced_pressure = match load {
        Load::ReducedPressure(pressure) => pressure.clamp(1e-4, 1.0),
        _ => 1e-2,
    };
    reduced_pressure.powf(-0.4)
}
