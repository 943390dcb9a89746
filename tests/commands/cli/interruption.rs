//! Ctrl-C, and the request of the system to end.

use super::*;
use std::path::Path;
use std::process::{Child, Command as Process, Stdio};
use std::time::Duration;

/// Starts a command, sends it a signal once a condition holds, and returns what it said and its exit code.
fn signalled(folder: &Folder, line: &str, signal: &str, is_time: impl Fn() -> bool) -> (String, Option<i32>) {
    let mut command = Process::new(env!("CARGO_BIN_EXE_asperity"));
    let command = command.args(line.split_whitespace()).current_dir(folder.join(""));
    let mut child: Child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    while !is_time() {
        assert!(child.try_wait().unwrap().is_none(), "it ended before the signal");
        std::thread::sleep(Duration::from_millis(5));
    }
    assert!(Process::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    (text(&output.stderr).to_owned(), output.status.code())
}

fn size(path: &Path) -> u64 {
    std::fs::metadata(path).map_or(0, |file| file.len())
}

#[cfg(all(unix, feature = "record"))]
#[test]
fn loads_that_are_solved_are_written_when_the_rest_is_interrupted() {
    let folder = Folder::new();
    let path = folder.join("curve.rrd");
    // the recording grows with every load, by some 150 kB from 260 kB on
    let has_grown = || size(&path) > 700_000;
    let line = "--hurst 0.8 --rolloff 0.25 --short-cutoff 0.004 --rms-gradient 0.1 --points 4096 --size 1 --modulus 1";
    let run = format!(
        "solve {line} --solver gfmd --reduced-pressure 1e-3..1:1000 --record curve.rrd --out curve.csv --save-setup done.toml"
    );
    let (said, code) = signalled(&folder, &run, "-INT", has_grown);
    assert_eq!(code, Some(130), "{said}");
    let table = std::fs::read_to_string(folder.join("curve.csv")).unwrap();
    let solved = table.lines().count() - 1;
    assert!((1..1000).contains(&solved) && table.matches(",converged,").count() == solved, "{table}");
    assert!(said.contains(&format!("interrupted: {solved} of 1000 loads were solved and written")), "{said}");
    assert_is_recording(&folder, "curve.rrd");
    let setup = std::fs::read_to_string(folder.join("done.toml")).unwrap();
    assert_eq!(
        setup.split_once("reduced-pressure = ").unwrap().1.lines().next().unwrap().matches(',').count() + 1,
        solved
    );
}

#[cfg(all(unix, feature = "record"))]
#[test]
fn a_recording_that_was_cut_off_says_so() {
    let folder = Folder::new();
    let path = folder.join("run.rrd");
    let line =
        "--hurst 0.8 --rolloff 0.25 --short-cutoff 0.002 --rms-gradient 0.1 --points 16384 --size 1 --solver gfmd";
    let run = format!("solve {line} --reduced-pressure 0.05 --tolerance 1e-14 --record run.rrd");
    signalled(&folder, &run, "-KILL", || size(&path) > 1_000_000);
    let cut = folder.run("solve --setup-of run.rrd --dry-run");
    assert_eq!(cut.status.code(), Some(0), "{}", text(&cut.stderr));
    assert!(text(&cut.stderr).contains("warning: run.rrd is incomplete: it was cut off"), "{}", text(&cut.stderr));
    let whole = folder.run(&format!("solve {CYLINDER} --reduced-pressure 0.01 --record whole.rrd"));
    assert_eq!(whole.status.code(), Some(0));
    assert!(!text(&folder.run("solve --setup-of whole.rrd --dry-run").stderr).contains("cut off"));
    // a recording that is begun anew leaves the whole one alone until it is whole itself
    let before = std::fs::read(folder.join("whole.rrd")).unwrap();
    let part = folder.join("whole.part.rrd");
    signalled(&folder, &run.replace("run.rrd", "whole.rrd"), "-KILL", || size(&part) > 1_000_000);
    assert!(std::fs::read(folder.join("whole.rrd")).unwrap() == before);
}

/// Drawings of a study that is solved afresh would contradict the table that is not there yet.
/// The signal is one that a shell does not make its background jobs ignore.
#[cfg(unix)]
#[test]
fn a_fresh_study_that_is_interrupted_leaves_no_older_drawings() {
    let folder = Folder::new();
    let study = |seeds: &str| {
        format!(
            "surface = {{ spectrum = {{ hurst = 0.8, rolloff-wavelength = 0.25, short-cutoff = 0.02, rms-gradient = 0.1 }}, seed = \"{seeds}\" }}\n\
             grid = {{ points = 8192, size = 1.0 }}\nload = {{ reduced-pressure = [0.01, 0.1] }}\n"
        )
    };
    std::fs::write(folder.join("study.toml"), study("1-2")).unwrap();
    assert!(folder.run("study study.toml").status.success());
    let views = ["study.parquet", "study.svg", "study.png"].map(|name| folder.join(name));
    assert!(views.iter().all(|path| path.is_file()));
    std::fs::write(folder.join("study.toml"), study("1-2000")).unwrap();
    let (said, code) =
        signalled(&folder, "study study.toml --fresh", "-TERM", || folder.join("study.unfinished").is_file());
    assert_eq!(code, Some(130), "{said}");
    let sentence =
        "warning: Interrupted: the rows that were solved are in study.unfinished. Run the same command again to go on.";
    assert!(said.contains(sentence), "{said}");
    assert!(!folder.join("study.csv").exists() && views.iter().all(|path| !path.exists()));
}

#[cfg(all(unix, feature = "serve"))]
#[test]
fn a_course_that_is_ended_leaves_no_folder() {
    let folder = Folder::new();
    let entries = || std::fs::read_dir(folder.join("")).unwrap().count();
    for (signal, code) in [("-TERM", Some(1)), ("-INT", Some(1)), ("-KILL", None)] {
        let (said, found) = signalled(&folder, "explore --export course", signal, || entries() > 0);
        assert_eq!(found, code, "{signal}: {said}");
        assert_eq!(entries(), usize::from(signal == "-KILL"), "{signal}");
    }
    // what was killed cannot clean up, but the next export does: it makes its draft anew, without what is in the old one
    let stale = std::fs::read_dir(folder.join("")).unwrap().next().unwrap().unwrap().path().join("stale");
    std::fs::write(&stale, "").unwrap();
    let is_anew = || stale.parent().unwrap().join("run").is_dir() && !stale.exists();
    let (_, code) = signalled(&folder, "explore --export course", "-TERM", is_anew);
    assert_eq!((code, entries()), (Some(1), 0));
}

/// The number of states in the table that grows.
fn rows(path: &Path) -> usize {
    std::fs::read_to_string(path).map_or(0, |table| table.lines().count().saturating_sub(1))
}

#[cfg(unix)]
#[test]
fn a_history_that_is_killed_leaves_the_states_that_it_reached() {
    let folder = Folder::new();
    let line =
        "solve --hurst 0.8 --rolloff 0.125 --short-cutoff 0.002 --rms-gradient 0.1 --points 16384 --size 1 --creep 9,1";
    let run = |steps: usize| format!("{line} --reduced-pressure 0.05 --path-time 3 --path-steps {steps}");
    let table = folder.join("all.part.csv");
    let killed = format!("{} --out all.npz --record all.rrd", run(300));
    signalled(&folder, &killed, "-KILL", || std::fs::read_dir(folder.join("all.part")).is_ok_and(|it| it.count() > 40));
    assert!(!folder.join("all.npz").exists());
    let parts = std::fs::read_dir(folder.join("all.part")).unwrap().count();
    // what was reached is read like an archive, and certified again
    let saved = asperity::job::SavedResult::read(&folder.join("all.part")).unwrap();
    assert!(saved.doubts.is_empty(), "{:?}", saved.doubts);
    let asperity::job::SavedFound::History(history) = saved.found else { panic!("it is a history") };
    let states = history.states.len();
    assert!((parts - 1..=parts).contains(&states) && states > 30 && states < 300, "{states} of {parts}");
    let times = history.values(asperity::contact::Quantity::Time);
    assert!(times.windows(2).all(|pair| pair[0] < pair[1]) && times[states - 1] < 3.0, "{times:?}");
    // the recording has them as well
    let mut file = std::fs::File::open(folder.join("all.rrd")).unwrap();
    let stores = rerun::ChunkStore::from_rrd_reader(&rerun::ChunkStoreConfig::ALL_DISABLED, &mut file).unwrap();
    let chunks = stores.values().flat_map(|store| store.iter_physical_chunks());
    let values = chunks.filter(|chunk| chunk.entity_path().to_string() == "/load/value");
    let recorded: usize = values.map(|chunk| chunk.num_rows()).sum();
    assert!(recorded + 2 >= states, "{recorded} of {states}");
    // a new run does not destroy them
    let again = folder.run(&format!("{} --out all.npz", run(3)));
    assert!(
        again.status.code() == Some(2) && text(&again.stderr).contains("all.part exists"),
        "{}",
        text(&again.stderr)
    );
    assert_eq!(std::fs::read_dir(folder.join("all.part")).unwrap().count(), parts);
    let setup = folder.run("solve --setup-of all.part --dry-run");
    assert!(text(&setup.stdout).contains("about 300"), "{}{}", text(&setup.stdout), text(&setup.stderr));
    std::fs::remove_dir_all(folder.join("all.part")).unwrap();
    // and so has a table; a run that comes to its end leaves neither
    signalled(&folder, &format!("{} --out all.csv", run(300)), "-KILL", || rows(&table) > 30);
    assert!(std::fs::read_to_string(&table).unwrap().starts_with("state,status,claim,time,"));
    std::fs::remove_file(&table).unwrap();
    for end in ["csv", "npz"] {
        assert_eq!(folder.run(&format!("{} --out all.{end}", run(3))).status.code(), Some(0));
        assert!(folder.join(&format!("all.{end}")).exists());
    }
    assert!(!table.exists() && !folder.join("all.part").exists());
}
