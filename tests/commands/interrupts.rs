//! Ctrl-C ends each drive within a second or so, wherever it is, and what was found before is told.

use crate::command::Folder;
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

const ROUGH: &str = "--hurst 0.8 --rolloff 0.25 --short-cutoff 0.004 --rms-gradient 0.1 --points 512,512 --size 1";
const LINE: &str = "--hurst 0.8 --rolloff 0.125 --short-cutoff 0.001 --rms-gradient 0.1 --points 16384 --size 1";
const STEEL: &str = "--young 1 --poisson 0.3 --yield-stress 0.005 --hardening-modulus 0.0001";

/// Cases at the same time: a machine has two cores or more.
const WORKERS: usize = 4;

/// Each drive on a case of many seconds, most of which are spent in one loop.
fn drives() -> Vec<(&'static str, String)> {
    let solve = |words: &str| format!("--threads 1 solve {words}");
    vec![
        ("loads", solve(&format!("{ROUGH} --modulus 1 --reduced-pressure 1e-3..1e-1:400"))),
        (
            "loads, conjugate gradients",
            solve(&format!("{ROUGH} --solver polonsky-keer --tolerance 1e-13 --reduced-pressure 1e-3,1e-2")),
        ),
        (
            "loads, damped motion",
            solve(&format!("{ROUGH} --solver gfmd --tolerance 1e-12 --reduced-pressure 1e-3,1e-2")),
        ),
        ("creep", solve(&format!("{ROUGH} --reduced-pressure 0.05 --creep 9,1 --path-time 100 --path-steps 60"))),
        (
            "slip",
            solve(
                "--indenter cylinder --radius 1 --points 65536 --size 0.5 --boundary free --modulus 1 --force 0.01 --friction 0.3 --path-tangential 0.0029,-0.0029 --path-steps 200",
            ),
        ),
        (
            "slip of a surface",
            solve(&format!(
                "{ROUGH} --young 1 --poisson 0.3 --reduced-pressure 0.05 --friction 0.3 --path-tangential 0.0149,-0.0149,0.0149 --path-steps 50 --tolerance 1e-13"
            )),
        ),
        (
            "sliding",
            solve(
                &format!("{LINE} --points 65536 --reduced-pressure 0.1 --creep 9,1 --speed 1e-3..1e3:100")
                    .replace("--points 16384 ", ""),
            ),
        ),
        (
            "rolling",
            solve(
                "--indenter cylinder --radius 1 --points 65536 --size 0.5 --boundary free --young 1,1 --poisson 0.3,0.3 --force 0.02 --friction 0.3 --tolerance 1e-12 --rolling 0.0002,0.0003,0.0004,0.0005",
            ),
        ),
        (
            "adhesion",
            solve(&format!(
                "{ROUGH} --modulus 1 --adhesion 1e-3 --adhesion-range 0.02 --mean-gap 0.02 --path-load 0.05,0.005,0.05 --path-steps 300"
            )),
        ),
        (
            "adhesion, safe",
            solve(&format!(
                "{ROUGH} --modulus 1 --adhesion 1e-3 --adhesion-range 0.02 --adhesion-method safe --mean-gap 0.02 --path-load 0.05,0.005,0.05 --path-steps 300"
            )),
        ),
        (
            "adhesion, damped motion",
            solve(&format!(
                "{ROUGH} --modulus 1 --adhesion 1e-3 --adhesion-range 0.02 --adhesion-method gfmd --mean-gap 0.02 --path-load 0.05,0.005,0.05 --path-steps 300"
            )),
        ),
        (
            "flow below the surface",
            solve(&format!(
                "--indenter sphere --radius 1 --points 64,64 --size 1 {STEEL} --pressure 1e-3,2e-3 --path-steps 50"
            )),
        ),
        (
            "flow, with errors",
            solve(&format!(
                "--indenter sphere --radius 1 --points 64,64 --size 1 {STEEL} --pressure 1e-3,2e-3 --path-steps 50 --yield-errors"
            )),
        ),
        (
            "flow at mean gaps",
            solve(&format!(
                "--indenter sphere --radius 1 --points 64,64 --size 1 {STEEL} --mean-gap 0.06,0.05 --path-steps 50"
            )),
        ),
        (
            "flow that is elastic",
            solve(
                "--indenter cylinder --radius 1 --points 256 --size 1 --young 1 --poisson 0.3 --yield-stress 10 --hardening-modulus 1 --pressure 1e-4 --path-load 1e-4,0 --path-steps 10000 --yield-layers 8",
            ),
        ),
        ("leakage", solve(&format!("{ROUGH} --modulus 1 --reduced-pressure 1e-3..1e-1:400 --flow"))),
    ]
}

/// The seconds from Ctrl-C, some time after the begin, to the end of a command, and its exit code.
fn end_of(folder: &Folder, line: &str, after: Duration) -> Result<(Duration, Option<i32>), &'static str> {
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    command.args(line.split_whitespace()).current_dir(folder.join("")).stdout(Stdio::null()).stderr(Stdio::null());
    let mut running = command.spawn().unwrap();
    thread::sleep(after);
    if running.try_wait().unwrap().is_some() {
        return Err("it ended by itself");
    }
    let asked = Instant::now();
    Command::new("kill").args(["-INT", &running.id().to_string()]).status().unwrap();
    while asked.elapsed() < Duration::from_secs(10) {
        if let Some(status) = running.try_wait().unwrap() {
            return Ok((asked.elapsed(), status.code()));
        }
        thread::sleep(Duration::from_millis(5));
    }
    running.kill().unwrap();
    running.wait().unwrap();
    Err("it did not end")
}

/// A machine that is busy may be late once.
#[test]
fn each_drive_ends_soon_after_it_is_interrupted() {
    let (folder, all, next) = (Folder::new(), drives(), AtomicUsize::new(0));
    let check = || {
        while let Some((name, line)) = all.get(next.fetch_add(1, Ordering::Relaxed)) {
            let mut told = Vec::new();
            let is_soon = [0.8, 1.3, 1.9].into_iter().any(|after| {
                let ended = end_of(&folder, line, Duration::from_secs_f64(after));
                let is_soon = matches!(ended, Ok((late, Some(130))) if late < Duration::from_millis(1500));
                told.push(ended);
                is_soon
            });
            assert!(is_soon, "{name}: {told:?}: {line}");
        }
    };
    thread::scope(|scope| (0..WORKERS).for_each(|_| drop(scope.spawn(check))));
}
