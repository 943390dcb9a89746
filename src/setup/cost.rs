//! The cost of a solve, known before it starts.

use super::{Part, Setup};
use crate::contact::Multilevel;
use crate::elastic::Compliance;
use crate::error::SetupError;
use crate::flow::Leakage;
use crate::grid::Grid;
use crate::memory::check_bytes;

/// Fields that are needed to generate random roughness: lines, surfaces.
const SYNTHESIS_FIELDS: [f64; 2] = [5.9, 3.8];
/// Fields that are needed in addition to give random roughness a distribution of heights: sorted heights, ranks and amplitudes.
const RANK_FIELDS: f64 = 3.0;
/// Fields that each contact of an archive needs in memory: for lines and for surfaces. The contour of a surface adds memory for each node in contact.
const ARCHIVE_FIELDS: [f64; 2] = [11.0, 8.0];
const CONTOUR_FIELDS: f64 = 3.5;
/// Fields that an archive needs once, however many contacts it has, such as positions and spectra: lines, surfaces.
const ARCHIVE_ONCE: [f64; 2] = [5.5, 2.0];
/// Fields of a contact that is kept.
const KEPT_FIELDS: f64 = 3.0;
/// The part of all memory that the contacts of a history take, from which on fewer states are the remedy: their tractions and their archive come on top.
const MOSTLY_STATES: f64 = 0.25;
/// Fields of a state of a history that is kept: those of its contact, and further ones such as traction and slip.
const STATE_FIELDS: f64 = KEPT_FIELDS + 2.0;
/// Fields that a diagnosis adds to a solve: lines, surfaces.
const DIAGNOSIS_FIELDS: [f64; 2] = [13.0, 8.7];
/// Values that are held for each column and depth of a stress, those of its file included; the depths; and the fields of the spectra
/// below a surface.
const STRESS_VALUES: f64 = 13.5;
const DEPTHS: f64 = 64.0;
const STRESS_FIELDS: [f64; 2] = [0.0, 2.5];
/// Fields that the search for the nodes that yield takes.
const YIELD_FIELDS: f64 = 1.7;
/// The most bytes, and fields, of the plans of transforms, of threads and of what the allocator keeps.
const OVERHEAD: f64 = 6e6;
const OVERHEAD_FIELDS: f64 = 2.0;
/// Bytes that a recording takes at least, that each point along its pictures adds, and the most of these points: lines, surfaces.
const PICTURES: [[f64; 3]; 2] = [[13e6, 6.6e3, 2048.0], [20e6, 0.085e6, 512.0]];
/// Fields that a picture of the result takes after the solve, and bytes of its pixels and of what draws them.
const DRAWN_FIELDS: [f64; 2] = [4.0, 5.2];
const PIXELS: f64 = 25e6;
/// Fields that a tangential load on a contact without a path adds: lines, surfaces.
const STUCK_FIELDS: [f64; 2] = [6.0, 8.0];

/// The memory and the grids that a solve takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cost {
    /// The finest grid.
    pub grid: Grid,
    /// Coarse grids in addition.
    pub coarse_grids: usize,
    /// Bytes at the peak, with the share of the nodes in contact that is expected.
    pub bytes: f64,
    /// States of a history, all of which are kept; 0 for one contact.
    pub states: usize,
}

/// The work in addition to the solve, if it needs memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Extras {
    /// Whether the steps are recorded.
    pub is_recorded: bool,
    /// Whether the steps are diagnosed, with or without a recording.
    pub is_diagnosed: bool,
    /// Whether the contact stiffness is found.
    pub has_stiffness: bool,
    /// Whether the stress below the contact is found.
    pub has_stress: bool,
    /// Contacts that are kept until their fields are written.
    pub archived: usize,
    /// Whether the result is drawn.
    pub is_drawn: bool,
    /// Whether the picture has pixels.
    pub has_pixels: bool,
}

/// Fields of the solver of flows along an axis, with its coarse grids; those of its results, along both axes; and with their archive.
const FLOW_FIELDS: f64 = 25.0;
const KEPT_FLOW_FIELDS: f64 = 4.0;
const ARCHIVED_FLOW_FIELDS: f64 = 12.0;

impl Setup {
    /// The cost of the solve with the additional work; that of a list of loads is the one under the largest of them.
    ///
    /// # Errors
    /// The errors of [`Setup::check`], and those of reading measured heights.
    pub fn cost(&self, extras: &Extras) -> Result<Cost, SetupError> {
        let grid = self.check()?;
        let heaviest = self.loads.iter().copied().max_by(|a, b| a.value().total_cmp(&b.value()));
        if let Some(heaviest) = heaviest {
            let cost = self.under(heaviest).cost(extras)?;
            // the pressure of the load before included
            return Ok(Cost { bytes: cost.bytes + bytes(&grid, 1.0), ..cost });
        }
        let area = self.expected_area(&grid)?;
        let solid = Compliance::fields(&grid, self.elastic()?.as_ref());
        let (of_dimension, archived) = (usize::from(!grid.is_line()), extras.archived as f64);
        let one = |is_done: bool, fields: f64| if is_done { fields } else { 0.0 };
        // the heights, the solver or the three fields of the result, and what watches
        let yielding = one(self.law.hardness().is_some(), YIELD_FIELDS);
        let solving = 1.0 + (solid + self.solver.fields(&grid, area)).max(KEPT_FIELDS) + yielding;
        let recorded = one(extras.is_recorded, self.solver.recorded_fields());
        let diagnosed = one(extras.is_diagnosed, DIAGNOSIS_FIELDS[of_dimension]);
        let flows = one(self.flow.leakage && archived > 0.0, KEPT_FLOW_FIELDS);
        let states = self.expected_states()?;
        let kept = match states {
            0 => (archived - 1.0).max(0.0) * (KEPT_FIELDS + flows),
            states => states as f64 * STATE_FIELDS,
        };
        let is_flow_recorded = extras.is_recorded && !grid.is_line() && self.recorded_parts().contains(&Part::Flow);
        let flow = FLOW_FIELDS * Leakage::together(&grid) as f64;
        let contour = if grid.is_line() { 0.0 } else { CONTOUR_FIELDS * area };
        let stress = STRESS_VALUES * DEPTHS / grid.shape()[0] as f64 + STRESS_FIELDS[of_dimension];
        let phases = [
            one(self.surface.is_random(), SYNTHESIS_FIELDS[of_dimension])
                + one(self.surface.has_target_heights(), RANK_FIELDS),
            solving + recorded + diagnosed + kept,
            one(extras.has_stress, 1.0 + KEPT_FIELDS + solid + stress),
            // the stiffness is found by the correction of the multilevel solver
            one(
                extras.has_stiffness || self.flow.has_conductance(),
                1.0 + KEPT_FIELDS + solid + Multilevel::stiffness_fields(&grid, area),
            ),
            one(self.flow.leakage, 1.0 + KEPT_FIELDS + flow + KEPT_FLOW_FIELDS + kept),
            one(extras.is_drawn, 1.0 + KEPT_FIELDS + DRAWN_FIELDS[of_dimension] + kept),
            // the solver is still there when its last state is recorded
            one(is_flow_recorded, solving + recorded + flow),
            archived * (ARCHIVE_FIELDS[of_dimension] + contour + one(self.flow.leakage, ARCHIVED_FLOW_FIELDS))
                + one(archived > 0.0, ARCHIVE_ONCE[of_dimension]),
        ];
        let process = self.drive()?.map_or(Ok(0.0), |drive| (drive.bytes)(self, &grid))?;
        let [least, each, most] = PICTURES[of_dimension];
        let pictures = least + each * most.min(grid.shape()[1] as f64);
        let overhead = OVERHEAD.min(bytes(&grid, OVERHEAD_FIELDS));
        let fields = bytes(&grid, phases.into_iter().fold(0.0, f64::max));
        let is_stuck = self.friction.is_some_and(|it| it.tangential != 0.0) && self.path.is_none();
        let stuck = one(is_stuck, bytes(&grid, STUCK_FIELDS[of_dimension]));
        let bytes =
            fields + process + stuck + overhead + one(extras.is_recorded, pictures) + one(extras.has_pixels, PIXELS);
        Ok(Cost { grid, coarse_grids: self.solver.coarse_grids(&grid), bytes, states })
    }
}

impl Cost {
    /// Bytes of a number of fields of doubles.
    pub fn from_fields(grid: &Grid, fields: f64) -> Self {
        Self { grid: *grid, coarse_grids: 0, bytes: bytes(grid, fields), states: 0 }
    }

    /// Refuses a solve that needs more memory than is free, or than the system allows.
    ///
    /// # Errors
    /// [`SetupError::Memory`].
    pub fn check(&self, what: &str) -> Result<(), SetupError> {
        let needed = self.bytes;
        let of_states = bytes(&self.grid, self.states as f64 * STATE_FIELDS);
        let states = if of_states > MOSTLY_STATES * needed { self.states } else { 0 };
        let refuse = |free| SetupError::Memory { shape: self.grid.shape(), states, what: what.into(), needed, free };
        check_bytes(needed).map_err(|missing| refuse(missing.free))
    }
}

/// The bytes of a number of fields of doubles.
pub(super) fn bytes(grid: &Grid, fields: f64) -> f64 {
    fields * size_of::<f64>() as f64 * grid.len() as f64
}
