//! Ctrl-C, and the request of the system to end.

use super::*;
use asperity::contact::ArchiveReader;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::path::{Path, PathBuf};
use std::process::{Child, Command as Process, Stdio};
use std::time::{Duration, Instant};

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

/// The file in which an output of some name grows, with an ending, or the folder, which has none.
fn growing(folder: &Folder, name: &str, ending: &str) -> Option<PathBuf> {
    let entries = std::fs::read_dir(folder.join("")).unwrap().map(|entry| entry.unwrap().path());
    let begin = format!("{name}.part-");
    let is_it = |path: &PathBuf| {
        let found = path.file_name().unwrap().to_str().unwrap();
        found.strip_prefix(&begin).is_some_and(|rest| rest.split_once('.').map_or("", |(_, end)| end) == ending)
    };
    entries.into_iter().find(is_it)
}

fn size(path: &Path) -> u64 {
    std::fs::metadata(path).map_or(0, |file| file.len())
}

#[cfg(all(unix, feature = "record"))]
#[test]
fn loads_that_are_solved_are_written_when_the_rest_is_interrupted() {
    let folder = Folder::new();
    // the recording grows with every load, by some 150 kB from 260 kB on
    let has_grown = || growing(&folder, "curve", "rrd").is_some_and(|it| size(&it) > 700_000);
    let line = "--hurst 0.8 --rolloff 0.25 --short-cutoff 0.004 --rms-gradient 0.1 --points 4096 --size 1 --modulus 1";
    let run = format!(
        "solve {line} --solver gfmd --reduced-pressure 1e-3..1:1000 --record curve.rrd --out curve.csv --save-setup done.toml"
    );
    let (said, code) = signalled(&folder, &run, "-INT", has_grown);
    assert_eq!(code, Some(130), "{said}");
    let table = std::fs::read_to_string(folder.join("curve.csv")).unwrap();
    let solved = table.lines().count() - 1;
    assert!((1..1000).contains(&solved) && table.matches(",converged,").count() == solved, "{table}");
    assert!(said.contains(&format!("interrupted: {solved} of 1000 loads solved and written")), "{said}");
    assert_is_recording(&folder, "curve.rrd");
    assert!(["rrd", "csv", ""].iter().all(|ending| growing(&folder, "curve", ending).is_none()));
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
    let line =
        "--hurst 0.8 --rolloff 0.25 --short-cutoff 0.002 --rms-gradient 0.1 --points 16384 --size 1 --solver gfmd";
    let run = format!("solve {line} --reduced-pressure 0.05 --tolerance 1e-14 --record run.rrd");
    let has_grown = || growing(&folder, "run", "rrd").is_some_and(|it| size(&it) > 1_000_000);
    signalled(&folder, &run, "-KILL", has_grown);
    let left = growing(&folder, "run", "rrd").unwrap();
    let name = left.file_name().unwrap().to_str().unwrap();
    assert!(!folder.join("run.rrd").exists());
    let cut = folder.run(&format!("solve --setup-of {name} --dry-run"));
    assert_eq!(cut.status.code(), Some(0), "{}", text(&cut.stderr));
    let warning = format!("warning: {name} is incomplete: it was cut off");
    assert!(text(&cut.stderr).contains(&warning), "{}", text(&cut.stderr));
    std::fs::remove_file(left).unwrap();
    let whole = folder.run(&format!("solve {CYLINDER} --reduced-pressure 0.01 --record run.rrd"));
    assert_eq!(whole.status.code(), Some(0));
    assert!(!text(&folder.run("solve --setup-of run.rrd --dry-run").stderr).contains("cut off"));
    // a recording that is begun anew leaves the whole one alone until it is whole itself, and says where it was
    let before = std::fs::read(folder.join("run.rrd")).unwrap();
    let (said, code) = signalled(&folder, &run, "-TERM", has_grown);
    let left = growing(&folder, "run", "rrd").unwrap();
    assert!(said.contains(left.file_name().unwrap().to_str().unwrap()) && code == Some(130), "{code:?}: {said}");
    assert!(std::fs::read(folder.join("run.rrd")).unwrap() == before);
}

/// Outputs grow in files that no one else has: not in a file of the user, and not in that of another process. An output that is a link is written
/// where it points.
#[cfg(all(unix, feature = "record"))]
#[test]
fn no_other_file_is_touched_while_outputs_grow() {
    let folder = Folder::new();
    let others = ["run.part.rrd", "run.part.csv", "run.part", "precious", ".asperity-"];
    others.iter().for_each(|name| std::fs::write(folder.join(name), "precious").unwrap());
    std::fs::create_dir(folder.join("aim")).unwrap();
    std::os::unix::fs::symlink("aim/run.rrd", folder.join("run.rrd")).unwrap();
    let line =
        "solve --hurst 0.8 --rolloff 0.125 --short-cutoff 0.004 --rms-gradient 0.1 --points 8192 --size 1 --creep 9,1";
    let run = format!("{line} --reduced-pressure 0.05 --path-time 1 --path-steps 9 --record run.rrd --out run");
    let together: Vec<Child> = ["csv", "npz"]
        .iter()
        .map(|end| {
            let mut command = Process::new(env!("CARGO_BIN_EXE_asperity"));
            let command = command.args(format!("{run}.{end}").split_whitespace()).current_dir(folder.join(""));
            command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap()
        })
        .collect();
    for mut child in together {
        assert!(child.wait().unwrap().success());
    }
    others.iter().for_each(|name| assert_eq!(std::fs::read(folder.join(name)).unwrap(), b"precious", "{name}"));
    assert!(folder.join("run.rrd").is_symlink());
    assert_is_recording(&folder, "aim/run.rrd");
    let names: Vec<_> =
        std::fs::read_dir(folder.join("")).unwrap().map(|it| it.unwrap().file_name().into_string().unwrap()).collect();
    assert_eq!(names.len(), others.len() + 4, "{names:?}");
    assert_eq!(std::fs::read_dir(folder.join("aim")).unwrap().count(), 1);
}

/// A hidden draft that a killed process left is removed by the next one that writes in its folder; one that a process still has is not, and neither
/// is a file of another kind of name.
#[cfg(unix)]
#[test]
fn what_killed_processes_left_hidden_is_removed() {
    let folder = Folder::new();
    for name in [".asperity-a1B2c3", ".asperity-inUse1", ".asperity-mine.npy", ".asperity-"] {
        std::fs::write(folder.join(name), "begun").unwrap();
    }
    std::fs::create_dir(folder.join(".asperity-folder")).unwrap();
    let in_use = std::fs::File::open(folder.join(".asperity-inUse1")).unwrap();
    in_use.try_lock().unwrap();
    assert!(folder.run("surface --indenter sine --amplitude 1 --points 64 --size 1 --out h.npy").status.success());
    let mut names: Vec<_> =
        std::fs::read_dir(folder.join("")).unwrap().map(|it| it.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    assert_eq!(names, [".asperity-", ".asperity-inUse1", ".asperity-mine.npy", "h.npy"]);
}

/// A new result has the permissions of the one that it takes the place of; one that is protected is left alone.
#[cfg(unix)]
#[test]
fn permissions_of_older_results_are_kept_and_heeded() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new();
    let (path, line) = (folder.join("h.npy"), "surface --indenter sine --amplitude 1 --points 64 --size 1 --out h.npy");
    let set = |mode: u32| std::fs::set_permissions(&path, std::fs::Permissions::from_mode(mode)).unwrap();
    let mode = || std::fs::metadata(&path).unwrap().permissions().mode() & 0o777;
    std::fs::write(&path, "private").unwrap();
    set(0o600);
    assert!(folder.run(line).status.success());
    assert_eq!(mode(), 0o600);
    let written = std::fs::read(&path).unwrap();
    assert!(written != b"private");
    set(0o440);
    let output = folder.run(&line.replace("amplitude 1", "amplitude 2"));
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("cannot write h.npy: it is write-protected") && said.lines().count() == 1, "{said}");
    assert!(std::fs::read(&path).unwrap() == written && mode() == 0o440);
}

/// What is written at the end grows as well, in a hidden file, which a request to end removes.
#[cfg(unix)]
#[test]
fn a_command_that_is_ended_leaves_no_hidden_draft() {
    let folder = Folder::new();
    let names = || std::fs::read_dir(folder.join("")).unwrap().map(|it| it.unwrap().file_name().into_string().unwrap());
    // a contact that is solved at once, and takes a quarter of a second to be written
    let line = "solve --indenter sine --amplitude 0.01 --points 4194304 --size 1 --modulus 1 --reduced-pressure 0.1 --out h.npz";
    let is_writing = || names().any(|name| name.starts_with(".asperity-") && size(&folder.join(&name)) > 0);
    let (said, code) = signalled(&folder, line, "-TERM", is_writing);
    assert_eq!((code, names().collect::<Vec<_>>()), (Some(130), Vec::new()), "{said}");
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
}

/// The number of states in the recording that grows, which has them within 0.2 s after they were found. Its last piece may be cut off.
fn recorded(path: &Path) -> usize {
    let Ok(mut file) = std::fs::File::open(path) else { return 0 };
    let stores = rerun::ChunkStore::from_rrd_reader(&rerun::ChunkStoreConfig::ALL_DISABLED, &mut file);
    let Ok(stores) = stores else { return 0 };
    let chunks = stores.values().flat_map(|store| store.iter_physical_chunks());
    chunks.filter(|chunk| chunk.entity_path().to_string() == "/load/value").map(|chunk| chunk.num_rows()).sum()
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
    let folder_of_states = || growing(&folder, "all", "");
    let killed = format!("{} --out all.npz --record all.rrd", run(300));
    let recording = || growing(&folder, "all", "rrd").map_or(0, |it| recorded(&it));
    let parts_of = |states: &Path| std::fs::read_dir(states).unwrap().count();
    let is_time = || folder_of_states().is_some_and(|it| parts_of(&it) > 40) && recording() > 30;
    signalled(&folder, &killed, "-KILL", is_time);
    assert!(!folder.join("all.npz").exists() && !folder.join("all.rrd").exists());
    let left = folder_of_states().unwrap();
    let parts = parts_of(&left);
    // what was reached is read like an archive, and certified again
    let saved = asperity::job::SavedResult::read(&left).unwrap();
    assert!(saved.doubts.is_empty(), "{:?}", saved.doubts);
    let asperity::job::SavedFound::States(history) = saved.found else { panic!("it is a history") };
    let states = history.states.len();
    assert!((parts - 1..=parts).contains(&states) && states > 30 && states < 300, "{states} of {parts}");
    let times = history.values(asperity::contact::Quantity::Time);
    assert!(times.windows(2).all(|pair| pair[0] < pair[1]) && times[states - 1] < 3.0, "{times:?}");
    // the recording has those of them that were found until 0.2 s before, and none that a reader of the folder would miss
    let shown = recording();
    assert!((31..=parts).contains(&shown), "{shown} of {parts}");
    // a new run does not touch them, and leaves nothing beside its outputs
    let before = std::fs::read_dir(folder.join("")).unwrap().count();
    for end in ["csv", "npz"] {
        assert_eq!(folder.run(&format!("{} --out all.{end}", run(3))).status.code(), Some(0));
        assert!(folder.join(&format!("all.{end}")).exists());
    }
    assert_eq!(std::fs::read_dir(folder.join("")).unwrap().count(), before + 2);
    assert_eq!(parts_of(&left), parts);
    let setup = folder.run(&format!("solve --setup-of {} --dry-run", left.display()));
    assert!(text(&setup.stdout).contains("about 300"), "{}{}", text(&setup.stdout), text(&setup.stderr));
    // and so has a table
    let table = || growing(&folder, "all", "csv");
    signalled(&folder, &format!("{} --out all.csv", run(300)), "-KILL", || table().is_some_and(|it| rows(&it) > 30));
    assert!(std::fs::read_to_string(table().unwrap()).unwrap().starts_with("state,status,claim,time,"));
}

/// An error in a later row keeps the rows before it, and says where they are.
#[test]
fn a_row_that_fails_says_where_the_others_are() {
    let folder = Folder::new();
    let study = |radius: &str| {
        format!(
            "surface = {{ indenter = {{ shape = 'cylinder', radius = [{radius}] }} }}\ngrid = {{ points = 64, size = 4.0 }}\n\
             load = {{ mean-pressure = 0.01 }}\nsolid = {{ contact-modulus = 1.0 }}\n"
        )
    };
    std::fs::write(folder.join("study.toml"), study("1.0, 1e305")).unwrap();
    let output = folder.run("study study.toml --workers 1");
    assert_eq!(output.status.code(), Some(2));
    let said = text(&output.stderr);
    assert_eq!(
        folder.join("study.unfinished").is_file(),
        said.contains("rows that were solved are in study.unfinished"),
        "{said}"
    );
    assert!(
        !folder.join("study.csv").exists() && said.lines().filter(|it| it.starts_with("error: ")).count() == 1,
        "{said}"
    );
    std::fs::write(folder.join("list.toml"), "[\"a\\nb\"]\nx = [1, 2]\n").unwrap();
    let broken = folder.run("solve list.toml");
    assert_eq!((broken.status.code(), text(&broken.stderr).lines().count()), (Some(2), 1), "{}", text(&broken.stderr));
}

/// Thirty runs are killed at random moments, most of them while they solve, some while they write: what has the name of a result is the old one or the new
/// one, and whole.
#[cfg(all(unix, feature = "record"))]
#[test]
fn results_of_runs_that_are_killed_are_old_or_new() {
    let folder = Folder::new();
    let line = |pressure: f64| {
        format!(
            "solve --hurst 0.8 --rolloff 0.25 --short-cutoff 0.001 --rms-gradient 0.1 --points 16384 --size 1 \
             --reduced-pressure {pressure} --out r.npz --record r.rrd"
        )
    };
    let run = |pressure: f64| assert!(folder.run(&line(pressure)).status.success());
    let files = ["r.npz", "r.rrd"];
    let contents = || files.map(|name| std::fs::read(folder.join(name)).unwrap());
    run(0.05);
    let old = contents();
    let begun = Instant::now();
    run(0.1);
    let whole = begun.elapsed();
    let mut random = ChaCha8Rng::seed_from_u64(30);
    for number in 0..30 {
        files.iter().zip(&old).for_each(|(name, bytes)| std::fs::write(folder.join(name), bytes).unwrap());
        let mut command = Process::new(env!("CARGO_BIN_EXE_asperity"));
        let command = command.args(line(0.1).split_whitespace()).current_dir(folder.join(""));
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        std::thread::sleep(whole.mul_f64(random.random_range(0.0..1.2)));
        child.kill().unwrap();
        child.wait().unwrap();
        let found = contents();
        if found[0] != old[0] {
            let result = ArchiveReader::open(&folder.join("r.npz")).unwrap();
            assert!(result.setup().contains("reduced-pressure = 0.1"), "run {number}: {}", result.setup());
            assert_eq!(result.contacts().unwrap().len(), 1, "run {number}");
        }
        if found[1] != old[1] {
            let setups = asperity::record::setups(&folder.join("r.rrd")).unwrap().unwrap();
            assert_eq!(setups.len(), 1, "run {number}");
        }
    }
}
