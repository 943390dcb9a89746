//! A recording of the session, and the result of its solve or sweep.

use super::motion::Motion;
use super::patches::PatchTable;
use super::report::{RunReport, SweepReport};
use super::section::{Section, Shear};
use super::step_numbers::StepNumbers;
use super::tape::{TapeBytes, TapeCurves};
use crate::contact::{Contact, CutLayers, Feels, StateField, archive};
use crate::theory::Exact;
use serde::Serialize;
use std::sync::Arc;

/// A recording that can still be read.
#[derive(Clone)]
pub(crate) struct SessionRecording {
    /// Name of the recording.
    pub id: String,
    /// Name, without ending, of the files that it is saved as.
    pub file_stem: String,
    /// Its bytes, as they grow.
    #[cfg_attr(not(feature = "serve"), expect(dead_code, reason = "only a server sends recordings"))]
    pub live: TapeBytes,
    /// Its result, when it is complete.
    pub ended: Option<Ended>,
}

/// The result of a solve or a sweep.
#[derive(Clone)]
pub(crate) enum Ended {
    Run(Arc<SolvedRun>),
    Sweep(Arc<SweepReport>, Arc<Motion>),
}

/// The result of a solve.
pub(crate) struct SolvedRun {
    pub report: RunReport,
    /// Axes of its arrays.
    pub rank: usize,
    pub last: LastState,
    /// That of the surface beside, if there is one.
    pub beside: Option<LastState>,
    /// Curves of the recording, to stand beside those of others.
    pub curves: Arc<TapeCurves>,
    pub steps: StepNumbers,
    pub motion: Motion,
}

/// The last state of a run, or of the surface beside, as the page shows it.
pub(crate) struct LastState {
    pub contact: Contact,
    /// Further fields of the last state of a history.
    pub fields: Vec<StateField>,
    /// The layers of the cut below a solid that yields.
    pub layers: Option<CutLayers>,
    /// The exact solution, where there is one.
    pub exact: Option<Exact>,
}

/// What the page gets about a complete recording.
#[derive(Serialize)]
#[serde(untagged)]
pub(crate) enum RecordingReport {
    Run(Box<RunReport>),
    Sweep(Box<SweepReport>),
}

impl SessionRecording {
    /// A recording that has begun.
    pub(crate) fn new(id: &str, file_stem: &str, live: TapeBytes) -> Self {
        Self { id: id.into(), file_stem: file_stem.into(), live, ended: None }
    }

    /// What the page gets about it, when it is complete.
    pub(crate) fn report(&self) -> Option<RecordingReport> {
        Some(match self.ended.as_ref()? {
            Ended::Run(solved) => RecordingReport::Run(Box::new(solved.report.clone())),
            Ended::Sweep(report, _) => RecordingReport::Sweep(Box::new(SweepReport::clone(report))),
        })
    }

    /// The solve behind it, once it is complete; none of a sweep.
    pub(crate) fn solved(&self) -> Option<Arc<SolvedRun>> {
        match self.ended.as_ref()? {
            Ended::Run(solved) => Some(Arc::clone(solved)),
            Ended::Sweep(..) => None,
        }
    }

    /// The sections of the loads of a sweep, once it is complete; none of a solve.
    pub(crate) fn swept(&self) -> Option<Arc<Motion>> {
        match self.ended.as_ref()? {
            Ended::Run(_) => None,
            Ended::Sweep(_, motion) => Some(Arc::clone(motion)),
        }
    }
}

impl LastState {
    /// The section of the contact.
    pub(crate) fn section(&self) -> Section {
        let Self { contact, fields, layers, exact } = self;
        match (exact, layers) {
            (Some(exact), _) => Section::with_exact(contact, exact),
            (None, Some(layers)) => Section::with_zone(contact, layers, fields),
            (None, None) => Section::from_contact(contact, fields),
        }
    }
}

impl SolvedRun {
    /// The stress below a contact of the run. With adhesion, or where the solid yields below its surface, the pressure between the surfaces is not all
    /// that the solid feels.
    pub(crate) fn shear(&self, contact: Option<&Contact>) -> Option<Shear> {
        let feels = self.feels();
        contact.filter(|_| !feels.attraction && !feels.eigenstrain).and_then(Shear::below)
    }

    /// The patches of the contact. A patch on a solid that creeps or adheres is compared with no elastic one.
    pub(crate) fn patches(&self) -> PatchTable {
        let table = PatchTable::new(&self.last.contact);
        PatchTable { is_hertzian: table.is_hertzian && self.feels().is_pressure_alone(), ..table }
    }

    /// What the solid feels besides the pressure.
    fn feels(&self) -> Feels {
        self.report.process.as_ref().map_or(Feels::PRESSURE, |it| it.drive.feels)
    }

    /// The arrays and the setup as `.npz`; none if they cannot be written.
    pub(crate) fn archive(&self) -> Option<Vec<u8>> {
        archive(&self.last.contact, self.rank, Some(&self.report.setup)).ok()
    }
}
