//! The files that a solve writes.

use super::exit_status::usage;
use super::figure_args::FigureArgs;
use anyhow::Result;
use asperity::contact::Contact;
use asperity::files::check_named;
use asperity::job::{StateArchive, StateTable};
use asperity::plot::{FigureStyle, is_figure};
use asperity::record::LeftOut;
use asperity::setup::{Drive, Extras, Part, Setup};
use clap::Args;
use std::path::{Path, PathBuf};

/// Endings of the names of the files.
const RECORDING_ENDINGS: &[&str] = &["rrd"];
const RESULT_ENDINGS: &[&str] = &["npz", "csv", "svg", "pdf", "png"];
const SCENE_ENDINGS: &[&str] = &["toml"];
const STRESS_ENDINGS: &[&str] = &["npz"];

#[derive(Args)]
#[command(next_help_heading = "Output")]
#[command(group = clap::ArgGroup::new("recorded").args(["record", "live"]).multiple(true))]
pub(crate) struct Outputs {
    /// Record every step of the solver, or the contact under each of several loads, for the Rerun viewer. It
    /// grows in NAME.part-XXXXXX.rrd, and has its name at the end, when it replaces an existing recording
    #[arg(long, value_name = "FILE.rrd")]
    pub record: Option<PathBuf>,
    /// Show the steps live in the installed Rerun viewer
    #[arg(long)]
    pub live: bool,
    /// The number of pictures that the viewer of `--live` was too slow to get.
    #[arg(skip)]
    pub left_out: LeftOut,
    /// Write fields, distributions, spectra, numbers and setup (.npz), a table of the loads or of the nodes of a line
    /// (.csv), or a picture of the contact or the load curve (.svg, .pdf, .png)
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Write the stress in the solid at 64 depths below the contact (components, tau_max, von Mises); for a surface, in
    /// a vertical cut along x
    #[arg(long, value_name = "FILE.npz")]
    pub stress: Option<PathBuf>,
    /// Row of a surface, counted from 0, below which the stress is computed [default: the row of the largest pressure]
    #[arg(long, value_name = "ROW", requires = "stress")]
    pub stress_row: Option<usize>,
    /// Write the imprint of a body that yields below its surface: the heights that it would have without load after the last
    /// state, for asperity surface or --against; a dent is negative (.npy, .x3p, .sdf, .xyz)
    #[arg(long, value_name = "FILE")]
    pub imprint: Option<PathBuf>,
    /// Write the setup as a scene that reproduces the results to the last bit
    #[arg(long, value_name = "SCENE.toml")]
    pub save_setup: Option<PathBuf>,
    /// Also compute the contact stiffness, the increase of mean pressure per decrease of mean gap; costs about 10 %
    /// more work
    #[arg(long)]
    pub stiffness: bool,
    /// Print one JSON object instead of a summary
    #[arg(long)]
    pub json: bool,
    /// Print all numbers: also counted areas, gradients, patches and energies, and the solver and its work
    #[arg(long, conflicts_with = "json")]
    pub verbose: bool,
    /// Treat warnings as errors: warnings about the heights stop the program before the solve; with warnings about the
    /// contact, only a recording is written
    #[arg(long)]
    pub strict: bool,
    #[command(flatten)]
    pub figure: FigureArgs,
}

impl Outputs {
    /// The recording.
    pub(crate) fn recording(&self) -> Option<&Path> {
        self.record.as_deref()
    }

    /// The work besides solving, for a number of loads.
    pub(crate) fn extras(&self, loads: usize) -> Extras {
        Extras {
            is_recorded: self.recording().is_some(),
            is_diagnosed: false,
            has_stiffness: self.stiffness,
            has_stress: self.stress.is_some(),
            archived: if self.archive().is_some() { loads } else { 0 },
            is_drawn: self.picture().is_some(),
            has_pixels: self.picture().is_some_and(|path| has_ending(path, "png")),
        }
    }

    /// The table, if it is requested.
    pub(crate) fn table(&self) -> Option<&Path> {
        self.out.as_deref().filter(|path| has_ending(path, "csv"))
    }

    /// The archive, if it is requested.
    pub(crate) fn archive(&self) -> Option<&Path> {
        self.out.as_deref().filter(|path| has_ending(path, "npz"))
    }

    /// The picture, if it is requested.
    pub(crate) fn picture(&self) -> Option<&Path> {
        self.out.as_deref().filter(|path| is_figure(path))
    }

    /// How the picture is drawn.
    ///
    /// # Errors
    /// The errors of [`FigureArgs::style`].
    pub(crate) fn style(&self) -> Result<FigureStyle> {
        self.figure.style(self.picture().is_some())
    }

    /// The files to write, in their order.
    pub(crate) fn files(&self) -> impl Iterator<Item = &Path> {
        let [out, stress, imprint, setup] = [&self.out, &self.stress, &self.imprint, &self.save_setup];
        [self.recording(), out.as_deref(), stress.as_deref(), imprint.as_deref(), setup.as_deref()]
            .into_iter()
            .flatten()
    }

    /// Computes the optional numbers of a contact that were requested.
    pub(crate) fn complete(&self, contact: &Contact) {
        if self.stiffness {
            contact.stiffness();
        }
    }

    /// Refuses outputs that the states of a run do not have.
    pub(crate) fn check_states(&self, drive: &Drive, setup: &Setup) -> Result<()> {
        let is_list = drive.is_list;
        if self.stiffness && !is_list {
            return usage("--stiffness is for one contact, but a history has many states: leave it out");
        }
        if self.stress.is_some() {
            return usage("--stress is for one contact, but a history has many states: leave it out");
        }
        if setup.record.every.is_some() {
            return usage(match is_list {
                true => {
                    "--record-every is for the steps under one load, but the contact under each load is recorded: leave it out"
                }
                false => {
                    "--record-every is for the steps of one solve, but every state of a history is recorded: leave it out"
                }
            });
        }
        let Some(part) = setup.record.what.iter().find(|part| Part::OF_A_RUN.contains(part)) else { return Ok(()) };
        let part = part.name();
        usage(match is_list {
            true => format!(
                "the recording part {part} shows the steps under one load, but several are given: give one load, or \
                 leave the part out"
            ),
            false => {
                format!("the recording part {part} shows the steps of one solve, but a history has many: leave it out")
            }
        })
    }

    /// What grows beside table and archive while the states of a run come.
    pub(crate) fn growing(&self) -> GrowingOutputs {
        GrowingOutputs {
            table: self.table().map(StateTable::beside),
            archive: self.archive().map(StateArchive::beside),
        }
    }

    /// Refuses places where nothing can be written, and names that promise another content.
    pub(crate) fn check(&self) -> Result<()> {
        self.style()?;
        let (out, stress, setup) = (self.out.as_deref(), self.stress.as_deref(), self.save_setup.as_deref());
        let named = [
            (self.recording(), RECORDING_ENDINGS),
            (out, RESULT_ENDINGS),
            (stress, STRESS_ENDINGS),
            (setup, SCENE_ENDINGS),
        ];
        let check = |(path, endings): (Option<&Path>, _)| path.map_or(Ok(()), |path| check_named(path, endings));
        Ok(named.into_iter().try_for_each(check)?)
    }
}

/// The files that grow state by state. A run that is killed leaves them.
pub(crate) struct GrowingOutputs {
    pub table: Option<StateTable>,
    pub archive: Option<StateArchive>,
}

impl GrowingOutputs {
    /// Removes them, once the files beside them are written.
    pub(crate) fn discard(self) {
        self.table.into_iter().for_each(StateTable::discard);
        self.archive.into_iter().for_each(StateArchive::discard);
    }
}

fn has_ending(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|given| given.eq_ignore_ascii_case(ending))
}
