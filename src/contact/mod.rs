//! Contact problems, their solvers, and the measures of their solutions.
//!
//! ```text
//! Problem --> Solver::solve --(Step)--> Observer
//!                  |
//!                  v
//!               Contact { pressure, displacement, gap, Certificate, Work, Status } --> Counted, Resolved, Patches
//! ```

mod archive;
mod archive_reader;
mod archive_seal;
mod below;
mod best;
mod bound;
mod ceiling;
mod certificate;
mod certificate_numbers;
mod claim;
mod counted;
mod decision;
mod density;
mod distribution;
mod edges;
mod feasible;
mod feels;
mod field_kind;
mod forecast;
mod gfmd;
mod law;
mod links;
mod load;
mod monotone;
mod moving;
mod multilevel;
mod observables;
mod observe;
mod outcome;
mod patch_history;
mod patch_tracker;
mod patch_tree;
mod patches;
mod plasticity;
mod polonsky_keer;
mod problem;
mod quantity;
mod quantity_row;
mod reading;
mod readings;
mod reposed;
mod resolution;
mod rounding;
mod run;
mod saved;
mod saved_fields;
mod slack;
mod slip;
mod snapshot;
mod solver;
mod state;
mod state_field;
mod state_row;
mod state_values;
mod status;
mod step;
mod stop;
mod sums;
mod validity;
mod warnings;

use crate::chunks;
use sums::CertificateSums;

pub use crate::error::Failure;
pub use archive::{archive, archive_of_part, archive_of_slip, archive_of_state, archive_of_states, archive_of_stress};
pub use archive_reader::{ArchiveReader, first_archive};
pub use archive_seal::ArchiveSeal;
pub use ceiling::Ceiling;
pub use certificate::Certificate;
pub use claim::ResultClaim;
pub use counted::{Counted, NODE_EXCESS_PER_SWITCH_SURFACE};
pub use decision::Decision;
pub use density::{contact_reach, error_density};
pub use distribution::Distribution;
pub use edges::{Edge, Edges, NODE_EXCESS_PER_SWITCH_LINE, Resolved};
pub use feels::Feels;
pub use field_kind::{FieldKind, FieldRow, On};
pub use forecast::Forecast;
pub(crate) use gfmd::Pace;
pub use gfmd::{Dynamics, Gfmd, Masses, Relaxation};
pub use law::Law;
pub use load::Load;
pub use monotone::MonotoneSets;
pub(crate) use monotone::{BoxInequality, LoadOrDatum, SetIteration};
pub(crate) use moving::{directions, hysteretic_friction, spectrum};
pub use multilevel::Multilevel;
pub(crate) use multilevel::hierarchy::coarser;
pub use observe::Each;
pub(crate) use observe::goes_on;
pub use outcome::{Contact, Work};
pub use patch_history::{NumberedPatch, PatchHistory, PatchSizes, PatchState, TrackedPatch};
pub use patch_tracker::{PatchEvent, PatchEventKind, PatchTracker};
pub use patch_tree::{PatchLife, PatchTree};
pub use patches::{Patch, Patches};
pub use plasticity::Plasticity;
pub use polonsky_keer::PolonskyKeer;
pub use problem::{ContactModulus, Problem};
pub use quantity::{Observables, Quantity};
pub use quantity_row::{PageTable, QuantityKind, QuantityRow, Unit};
pub use reading::Reading;
pub use readings::Readings;
pub use resolution::Resolution;
pub use run::Run;
pub use saved::SavedContact;
pub use saved_fields::{read_cut_layers, read_state_fields};
pub use slip::{Friction, PartialSlip};
pub use snapshot::Snapshot;
pub use solver::{Observer, Solver, Wish};
pub use state::State;
pub use state_field::{CutLayers, StateField};
pub use state_row::StateRow;
pub use state_values::StateValues;
pub use status::Status;
pub use step::{Energy, Phase, Step, Values};
pub use stop::Stop;
pub use validity::Validity;
pub(crate) use warnings::LARGEST_ERROR;
pub use warnings::{
    Strain, warning_of_friction, warning_of_rim, warning_of_trail, warnings_of, warnings_of_contact,
    warnings_of_states, warnings_of_strains,
};
