//! The solvers side by side in one recording.

use super::super::progress::Progress;
use crate::cli::contender::Contender;
use anyhow::Result;
use asperity::Problem;
use asperity::contact::Stop;
use asperity::error::SolveError;
use asperity::record::{Options, Recording, Scene, describe};
use std::path::Path;

/// Records one run of each solver on `problem`: its certificate along seconds and transforms, next to its fields.
pub fn record(path: &Path, name: &str, problem: &Problem, stop: &Stop) -> Result<()> {
    let scene = |contender: Contender| -> Result<Scene<'_>> {
        let solver = contender.solver()?;
        let (title, description) =
            (contender.title().into(), describe(name, problem, "L", solver.as_ref(), stop, None));
        Ok(Scene { name: contender.title().into(), title, problem, description, exact: None })
    };
    let scenes = Contender::ALL.into_iter().map(scene).collect::<Result<Vec<_>>>()?;
    let options = Options { length_unit: "L".into(), ..Options::default() };
    let recording = Recording::create(path, &scenes, options)?;
    for (i, contender) in Contender::ALL.into_iter().enumerate() {
        let mut recorder = recording.recorder(i);
        let mut progress = Progress::new(stop.tolerance(), &format!("recording {}", contender.title()));
        let solved = contender.solver()?.solve(problem, stop, &mut (&mut recorder, &mut progress));
        recorder.close(&solved.or_else(SolveError::into_contact)?)?;
    }
    Ok(recording.finish()?)
}
