//! Recordings for the Rerun viewer: every relaxation step of one or more solves, with the layout in which they open.
//!
//! ```text
//! Scene --> draw::Stage { drawings } --> Recording (layout and statics in the file)
//!                                           |
//! Solver --(Step)--> Recorder: numbers of every step, frames of the steps that its Schedule picks
//! ```
//!
//! A recording carries the setups of its scenes, from which [`setups`] takes them back. A recording over loads instead of
//! steps is a [`LoadRecording`], whose curves stand against the quantity of its [`LoadAxis`]; [`compare`] lays the traces of
//! several recordings over each other. `draw` holds the drawings, one for each part of a
//! recording, `layout` the places of their views in the viewer, `file` the streams into files. What is known of a scene as a whole are properties of its recording.
//!
//! Timelines: `step`, `seconds` (of the solver, observers left out) and `transforms`; scenes share them. Pictures are drawn in
//! coordinates of their canvas, with axes for pressures over `E*`, gaps over the rms height and lengths, each in the power of a
//! thousand that the axis states; the numbers behind them stand beside them. Steps of coarser grids are drawn on the axes of
//! the scene, each node at its true place.
//!
//! The viewer keeps a layout to each application: a recording is an application of its own, the same for the same
//! scenes, and its name states surface, load and solver.
//!
//! ```no_run
//! use asperity::{Grid, Indenter, Problem, Stop};
//! use asperity::contact::{ContactModulus, Load, PolonskyKeer, Solver};
//! use asperity::record::{Options, Recording, Scene};
//! use std::path::Path;
//!
//! let surface = Indenter::Cylinder { radius: 40e-6 }.surface(Grid::line(4096, 160e-6)?)?;
//! let problem = Problem::new(surface, ContactModulus(1e9), Load::MeanPressure(1e6))?;
//! let recording = Recording::create(Path::new("cylinder.rrd"), &[Scene::new("cylinder", &problem)], Options::default())?;
//! PolonskyKeer.solve(&problem, &Stop::default(), &mut recording.recorder(0))?.converged()?;
//! recording.finish()?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![doc = include_str!("../../assets/doc/record.md")]

mod description;
mod digest;
mod draw;
mod file;
mod layout;
mod lengths;
mod options;
mod parts;
mod playback;
mod played;
mod properties;
mod scene;
mod sdk;
mod setups;
mod size;
mod stores;
mod tables;
mod units;

pub use description::load_in_words;
pub use draw::{CurveKind, Ghost, LoadAxis, RecordedCurve};
pub use file::{
    LeftOut, LoadRecording, Loads, Output, Pieces, Recorder, Recording, StateCurve, StateRecording, Target, Timeline,
    compare, record_survey,
};
pub use options::Options;
pub use parts::Parts;
pub use scene::{FurtherField, Scene, YieldZone};
pub use setups::{is_cut_off, is_recording, setups};
pub use size::Size;
pub use units::{RecordUnits, value_with_unit};
