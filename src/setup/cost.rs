//! The cost of a solve, said before it is started.

use super::Setup;
use crate::contact::{Forecast, Load};
use crate::elastic::Compliance;
use crate::error::SetupError;
use crate::grid::Grid;

/// Fields that are held for each contact while an archive is made in memory.
const ARCHIVE_FIELDS: f64 = 9.5;
/// Fields of a contact that is kept.
const KEPT_FIELDS: f64 = 3.0;

/// The memory and the grids that a solve takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cost {
    /// The finest grid.
    pub grid: Grid,
    /// Coarse grids besides it.
    pub coarse_grids: usize,
    /// Bytes at the peak, with the share of the nodes in contact that is expected.
    pub bytes: f64,
    /// Bytes that the solve takes however few nodes touch.
    pub least_bytes: f64,
}

impl Setup {
    /// The cost of the solve; `is_recorded` says whether its steps are recorded, `archived` how many contacts are kept until their
    /// fields are written.
    ///
    /// # Errors
    /// The errors of [`Setup::check`].
    pub fn cost(&self, is_recorded: bool, archived: usize) -> Result<Cost, SetupError> {
        let grid = self.check()?;
        let contact = match self.load {
            Load::ReducedPressure(pressure) if self.surface.is_random() => Forecast::relative_area_at(pressure),
            _ => 1.0,
        };
        // the heights, the solver or the three fields of the result, and what watches
        let solid = Compliance::fields(&grid, self.elastic()?.as_ref());
        let solved = |contact: f64| 1.0 + solid + self.solver.fields(&grid, contact).max(3.0);
        let recorded = if is_recorded { self.solver.recorded_fields() } else { 0.0 };
        let kept = archived.saturating_sub(1) as f64 * KEPT_FIELDS;
        let fields = (solved(contact) + recorded + kept).max(archived as f64 * ARCHIVE_FIELDS);
        let coarse_grids = self.solver.coarse_grids(&grid);
        Ok(Cost { grid, coarse_grids, bytes: bytes(&grid, fields), least_bytes: bytes(&grid, solved(0.0) + kept) })
    }
}

impl Cost {
    /// Bytes of so many fields of doubles.
    pub fn of_fields(grid: &Grid, fields: f64) -> Self {
        let bytes = bytes(grid, fields);
        Self { grid: *grid, coarse_grids: 0, bytes, least_bytes: bytes }
    }

    /// Refuses what needs more memory than is free, or than the system grants.
    ///
    /// # Errors
    /// [`SetupError::Memory`].
    pub fn check(&self, what: &str) -> Result<(), SetupError> {
        let needed = self.least_bytes;
        let refuse = |free| SetupError::Memory { shape: self.grid.shape(), what: what.into(), needed, free };
        if let Some(free) = available_bytes().filter(|free| needed > *free) {
            return Err(refuse(Some(free)));
        }
        let mut reserved = Vec::<u8>::new();
        let granted = reserved.try_reserve_exact(needed as usize);
        std::hint::black_box(reserved);
        granted.map_err(|_| refuse(None))
    }
}

fn bytes(grid: &Grid, fields: f64) -> f64 {
    fields * size_of::<f64>() as f64 * grid.len() as f64
}

/// Bytes of memory that are free, where the system tells.
pub fn available_bytes() -> Option<f64> {
    #[cfg(all(target_os = "linux", feature = "figures"))]
    {
        use procfs::{Current, Meminfo};
        Meminfo::current().ok().and_then(|memory| memory.mem_available).map(|bytes| bytes as f64)
    }
    #[cfg(not(all(target_os = "linux", feature = "figures")))]
    None
}
