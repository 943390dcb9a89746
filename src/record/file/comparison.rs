//! Recordings made of several others.

use super::load_comparison::LoadComparison;
use super::recording::{Name, write_whole};
use crate::contact::Quantity;
use crate::error::FileError;
use crate::record::draw::{COMPARED, drawn, log_run_style, title, traced};
use crate::record::layout::{Compared, copy, send_comparison, send_load_comparison};
use crate::record::playback::Playback;
use crate::record::played::Played;
use crate::setup::differences_of_tables;
use rerun::{RecordingStream, RecordingStreamResult, TextDocument};
use std::collections::BTreeSet;
use std::path::Path;

/// Entity of the text about the runs.
const TEXT: &str = "/compare/runs";
/// Observables that converge to a value above zero.
const SETTLING: [Quantity; 3] = [Quantity::RelativeArea, Quantity::Kappa, Quantity::KappaR];
/// Letters of the longest name that leaves room for curves beside the legend.
const LONGEST_NAME: usize = 40;
/// Room above the curves that settle at some value, over the largest of these values.
const ROOM: f64 = 1.8;

/// Writes one recording that shows the curves of several recordings together, and each recording in its own tab.
///
/// Each scene of each recording is a run. It is named by the settings that differ, or by its file if these are too
/// many. The traces are under `/compare/OBSERVABLE/NUMBER`, the recordings under `/recording_NUMBER`, numbers from 1
/// on. Curves over the loads of a list or the states of a history are compared by their names; all recordings are over
/// steps, or over loads, or over states.
///
/// # Errors
/// [`FileError::Read`] for a file that is missing, unreadable or damaged, [`FileError::Incomparable`] for one that is no
/// recording, has no curves, or is over something else than the first one; [`FileError::Target`] if no file can be made at
/// `out`, [`FileError::Write`] if writing fails.
pub fn compare<P: AsRef<Path>>(recordings: &[P], out: &Path) -> Result<(), FileError> {
    let recordings = recordings.iter().map(|path| Playback::read(path.as_ref())).collect::<Result<Vec<_>, _>>()?;
    check_alike(&recordings)?;
    let runs = runs(&recordings);
    let names: Vec<&str> = runs.iter().map(|run| run.name.as_str()).collect();
    let identities: Vec<String> = recordings.iter().map(|playback| playback.name.clone()).collect();
    let name = Name::made_of(format!("Comparison: {}", names.join("; ")), &identities);
    write_whole(out, &name, |stream| log(stream, &recordings, &runs))
}

/// Refuses recordings that are over different things.
fn check_alike(recordings: &[Playback]) -> Result<(), FileError> {
    let Some((first, others)) = recordings.split_first() else { return Ok(()) };
    match others.iter().find(|it| it.played() != first.played()) {
        None => Ok(()),
        Some(other) => Err(FileError::Incomparable {
            path: other.path.clone(),
            reason: format!(
                "it is over {}, and {} is over {}: give recordings of one kind",
                other.played().words(),
                first.path.display(),
                first.played().words()
            ),
        }),
    }
}

/// A scene of a recording.
struct ComparedRun<'a> {
    playback: &'a Playback,
    root: String,
    name: String,
    /// The values of its setup that differ from the others.
    differences: String,
}

/// All runs. They are named by the settings that differ, or by their files if these names would be too long.
fn runs(recordings: &[Playback]) -> Vec<ComparedRun<'_>> {
    let scenes: Vec<_> =
        recordings.iter().flat_map(|playback| playback.roots().into_iter().map(move |root| (playback, root))).collect();
    let setups: Option<Vec<_>> = scenes.iter().map(|(playback, root)| playback.setup(root)).collect();
    let differing = setups.map_or_else(|| vec![String::new(); scenes.len()], |setups| differences_of_tables(&setups));
    let is_short = differing.iter().all(|words| (1..=LONGEST_NAME).contains(&words.len()));
    let is_enough = is_short && differing.iter().collect::<BTreeSet<_>>().len() == differing.len();
    let mut runs = Vec::new();
    for ((playback, root), differences) in scenes.into_iter().zip(differing) {
        let name = if is_enough { differences.clone() } else { place(recordings, playback, &root) };
        runs.push(ComparedRun { playback, root, name, differences });
    }
    runs
}

/// The file of a run and, where it holds several, its scene.
fn place(recordings: &[Playback], playback: &Playback, root: &str) -> String {
    let stems: BTreeSet<String> = recordings.iter().map(Playback::stem).collect();
    let file = if stems.len() == recordings.len() { playback.stem() } else { playback.path.display().to_string() };
    if playback.roots().len() > 1 { format!("{file}{root}") } else { file }
}

impl ComparedRun<'_> {
    /// Records one of its traces as `entity`.
    fn copy_trace(&self, to: &RecordingStream, name: &str, entity: &str) {
        let chunks = self.playback.trace(&self.root, name);
        to.send_chunks(chunks.map(|chunk| chunk.clone_with_new_entity_path(entity.into())));
    }

    /// A row about it, in Markdown.
    fn row(&self) -> String {
        let text = self.playback.text(format!("{}/description", self.root)).unwrap_or_default();
        let result = text.lines().find_map(|line| line.strip_prefix("**Result**: ")).unwrap_or("-");
        let Self { name, playback, differences, .. } = self;
        format!("| {name} | {} | {result} | {differences} |\n", playback.path.display())
    }
}

fn log(to: &RecordingStream, recordings: &[Playback], runs: &[ComparedRun<'_>]) -> RecordingStreamResult<()> {
    let mut layouts = Vec::new();
    for (number, playback) in (1..).zip(recordings) {
        let root = format!("/recording_{number}");
        for chunk in &playback.chunks {
            to.send_chunk(chunk.clone_with_new_entity_path(format!("{root}{}", chunk.entity_path()).into()));
        }
        let name = playback.path.file_stem().unwrap_or_default().to_string_lossy();
        layouts.extend(
            playback.blueprint.as_ref().and_then(|blueprint| copy(blueprint, &root)).map(|it| it.titled(&name)),
        );
    }
    let played = recordings.first().map_or(Played::Steps, Playback::played);
    let (curves, over_values) = match played {
        Played::Steps => (log_traces(to, runs)?, None),
        Played::Loads | Played::States => log_curves_of_states(to, runs)?,
    };
    let rows: String = runs.iter().map(ComparedRun::row).collect();
    let about = played.about();
    let text = TextDocument::from_markdown(format!(
        "| run | recording | result | differs in |\n|---|---|---|---|\n{rows}\n{about}"
    ));
    to.log_static(TEXT, &text)?;
    match over_values {
        Some(mut comparison) => {
            send_load_comparison(&mut comparison.charts, curves, TEXT.into(), layouts, played.timeline(), to)?;
            comparison.log(to)
        }
        None => send_comparison(curves, TEXT.into(), layouts, played.timeline(), to),
    }
}

/// Records the traces of all runs over their steps.
fn log_traces(to: &RecordingStream, runs: &[ComparedRun<'_>]) -> RecordingStreamResult<Vec<Compared>> {
    let mut observables: Vec<Quantity> = traced().collect();
    observables.sort_by_key(|quantity| !COMPARED.contains(quantity));
    observables.into_iter().map(|observable| log_curves(to, runs, observable)).collect()
}

/// Records the curves of all runs over the numbers of their loads or states, those of one name together; and draws them over the quantity along
/// the loads or states, if all runs have the same.
fn log_curves_of_states(
    to: &RecordingStream,
    runs: &[ComparedRun<'_>],
) -> RecordingStreamResult<(Vec<Compared>, Option<LoadComparison>)> {
    let mut names: Vec<String> = Vec::new();
    for (name, _) in runs.iter().flat_map(|run| run.playback.curves()) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let log = |(place, name): (usize, &String)| {
        let mut entities = Vec::new();
        for (number, run) in runs.iter().enumerate() {
            let entity = format!("/compare/curve_{}/{:02}", place + 1, number + 1);
            let chunks = run.playback.curve(name).map(|chunk| chunk.clone_with_new_entity_path(entity.clone().into()));
            to.send_chunks(chunks);
            log_run_style(to, &entity, &run.name, Some(number))?;
            entities.push(entity);
        }
        Ok(Compared { title: name.clone(), entities, most: None })
    };
    let curves = names.iter().enumerate().map(log).collect::<RecordingStreamResult<Vec<_>>>()?;
    let named: Vec<_> = runs.iter().map(|run| (run.playback, run.name.as_str())).collect();
    Ok((curves, LoadComparison::new(&named, &names)))
}

/// Records the curves of an observable of all runs, and those of its exact values as far as they differ.
fn log_curves(to: &RecordingStream, runs: &[ComparedRun<'_>], quantity: Quantity) -> RecordingStreamResult<Compared> {
    let (name, root) = (drawn(quantity), format!("/compare/{}", drawn(quantity)));
    let mut entities = Vec::new();
    for (number, run) in runs.iter().enumerate() {
        let entity = format!("{root}/{:02}", number + 1);
        run.copy_trace(to, &name, &entity);
        log_run_style(to, &entity, &run.name, Some(number))?;
        entities.push(entity);
    }
    let exact = format!("{name}_theory");
    let last = |name| move |run: &&ComparedRun<'_>| run.playback.last(&run.root, name);
    let mut with_exact: Vec<&ComparedRun<'_>> = runs.iter().filter(|run| last(&exact)(run).is_some()).collect();
    with_exact.dedup_by_key(|run| last(&exact)(run).map(f64::to_bits));
    for (number, run) in with_exact.iter().enumerate() {
        let entity = format!("{root}/exact_{:02}", number + 1);
        run.copy_trace(to, &exact, &entity);
        let name = if with_exact.len() > 1 { format!("exact, {}", run.name) } else { "exact".into() };
        log_run_style(to, &entity, &name, None)?;
        entities.push(entity);
    }
    let highest = runs.iter().filter_map(|run| last(&name)(&run)).fold(0.0, f64::max);
    let settles = SETTLING.contains(&quantity) && highest > 0.0;
    Ok(Compared { title: title(quantity), entities, most: settles.then_some(ROOM * highest) })
}
