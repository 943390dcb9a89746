//! Recordings on their way: where they are cut, and in which pieces others get them.

use super::{Options, chunks, rough_line, stores};
use asperity::contact::{Each, Gfmd, Solver, Step};
use asperity::record::{Pieces, Recording, Scene, Target};
use asperity::{Problem, Stop};
use rerun::StoreKind;
use std::collections::BTreeSet;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Duration;

/// Records some hundred steps into `recording` while `see` looks on.
fn solve(problem: &Problem, recording: &Recording, mut see: impl FnMut(&Step<'_>)) {
    let mut each = Each(|step: &Step<'_>| {
        see(step);
        ControlFlow::Continue(())
    });
    let stop = Stop::new(1e-30, 300).unwrap();
    let mut seen = (recording.recorder(0), &mut each);
    Gfmd::default().solve(problem, &stop, &mut seen).unwrap();
}

/// Entities and rows of the chunks that change with time, in the order of the entities.
fn cuts(path: &Path) -> Vec<(String, usize)> {
    let mut cuts: Vec<_> = chunks(path).iter().map(|it| (it.entity_path().to_string(), it.num_rows())).collect();
    cuts.sort();
    cuts
}

#[test]
fn a_file_is_cut_the_same_on_a_busy_machine() {
    let folder = tempfile::tempdir().unwrap();
    let problem = rough_line();
    let [idle, busy] = [0, 3].map(|millis| {
        let path = folder.path().join(format!("{millis}.rrd"));
        let recording = Recording::create(&path, &[Scene::new("it", &problem)], Options::default()).unwrap();
        solve(&problem, &recording, |_| std::thread::sleep(Duration::from_millis(millis)));
        recording.finish().unwrap();
        cuts(&path)
    });
    let steps = |cuts: &[(String, usize)]| {
        cuts.iter().filter(|(it, _)| it == "/it/trace/kappa_r_counted").map(|it| it.1).sum::<usize>()
    };
    assert_eq!(steps(&idle), 301);
    assert_eq!(idle, busy);
}

#[test]
fn pieces_behind_each_other_are_the_recording_at_any_moment() {
    let folder = tempfile::tempdir().unwrap();
    let problem = rough_line();
    let (path, joined) = (folder.path().join("file.rrd"), folder.path().join("joined.rrd"));
    let pieces = Pieces::default();
    let scenes = [Scene::new("it", &problem)];
    let recording =
        Recording::to(Target::Pieces(pieces.clone(), Some(path.clone())), &scenes, Options::default()).unwrap();
    let mut taken = Vec::new();
    solve(&problem, &recording, |_| {
        std::thread::sleep(Duration::from_millis(2));
        taken.extend(pieces.next_piece().unwrap());
    });
    recording.finish().unwrap();
    let early = taken.len();
    taken.extend(pieces.next_piece().unwrap());
    assert!(early > 1 && pieces.next_piece().unwrap().is_none());
    assert!(taken.iter().all(|piece| piece.starts_with(b"RRF2")));
    let of = |path: &Path| chunks(path).iter().map(rerun::log::Chunk::id).collect::<BTreeSet<_>>();
    let mut so_far = 0;
    for come in 1..=taken.len() {
        std::fs::write(&joined, taken[..come].concat()).unwrap();
        let chunks = of(&joined).len();
        assert!(chunks >= so_far);
        so_far = chunks;
    }
    assert!(of(&joined) == of(&path));
    assert_eq!(stores(&joined, StoreKind::Blueprint).len(), 1);
}
