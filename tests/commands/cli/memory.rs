//! What a dry run says of memory is what the solve takes.

use super::*;
use std::process::{Command, Stdio};
use std::time::Duration;

const ROUGH: &str = "--hurst 0.8 --rolloff 0.25 --short-cutoff 0.02 --rms-gradient 0.1 --seed 1 --modulus 1";
const PLANE: &str = "--points 1024,1024 --size 1";
const LINE: &str = "--points 1048576 --size 1";
const SMALL: &str = "--points 512,512 --size 1";
const SPHERE_CAP: &str = "--indenter sphere --radius 1 --modulus 1 --points 1024,1024 --size 1";

/// The high-water mark of the resident memory of a command in bytes, as the kernel keeps it.
fn high_water(folder: &Folder, line: &str) -> f64 {
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    let command = command.args(line.split_whitespace()).current_dir(folder.join(""));
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let status = format!("/proc/{}/status", child.id());
    let mut most = 0.0f64;
    while child.try_wait().unwrap().is_none() {
        let text = std::fs::read_to_string(&status).unwrap_or_default();
        let mark = text.lines().find_map(|line| line.strip_prefix("VmHWM:")?.trim().strip_suffix(" kB"));
        most = most.max(mark.map_or(0.0, |kilobytes| 1024.0 * kilobytes.trim().parse::<f64>().unwrap()));
        std::thread::sleep(Duration::from_millis(1));
    }
    most
}

#[cfg(target_os = "linux")]
#[test]
fn a_dry_run_knows_the_peak_of_solves_within_a_fifth() {
    let folder = Folder::new();
    // a short run can end between two readings, before it has loaded all it needs
    let small = format!("solve {CYLINDER} --modulus 1 --pressure 0.003");
    let base = (0..20).map(|_| high_water(&folder, &small)).fold(0.0, f64::max);
    println!("{:>6.1} MB taken by a small solve", base / 1e6);
    let rough = |rest: String| format!("{ROUGH} {rest}");
    let cases = [
        rough(format!("{PLANE} --reduced-pressure 0.05")),
        rough(format!("{PLANE} --reduced-pressure 0.5")),
        rough(format!("{PLANE} --mean-gap 0.005")),
        rough(format!("{PLANE} --pressure 0.005")),
        rough(format!("{PLANE} --reduced-pressure 0.05 --solver polonsky-keer --max-iterations 20")),
        rough(format!("{PLANE} --reduced-pressure 0.05 --solver gfmd --max-iterations 5")),
        rough(format!("{PLANE} --reduced-pressure 0.05 --layer 0.1 --poisson 0.3")),
        rough(format!("{PLANE} --reduced-pressure 0.05 --hardness 0.05")),
        rough(format!("{PLANE} --reduced-pressure 0.05 --stiffness")),
        rough(format!("{PLANE} --reduced-pressure 0.05 --flow")),
        rough(format!("{PLANE} --reduced-pressure 0.05 --diagnose")),
        rough(format!("{PLANE} --reduced-pressure 0.05 --out a.npz")),
        rough(format!("{PLANE} --reduced-pressure 0.01,0.02,0.05 --out a.npz")),
        rough(format!("{LINE} --reduced-pressure 0.05")),
        rough(format!("{LINE} --reduced-pressure 0.3")),
        rough(format!("{LINE} --reduced-pressure 0.9")),
        rough(format!("{LINE} --reduced-pressure 0.05 --diagnose")),
        rough(format!("{LINE} --reduced-pressure 0.05 --stiffness")),
        rough(format!("{LINE} --reduced-pressure 0.05 --out a.npz")),
        rough(format!("{SMALL} --reduced-pressure 0.05 --record a.rrd")),
        rough(format!("{SMALL} --reduced-pressure 0.05 --record a.rrd --solver gfmd --max-iterations 100")),
        rough("--points 16384 --size 1 --reduced-pressure 0.05 --record a.rrd --solver gfmd".into()),
        format!("{SPHERE_CAP} --pressure 1e-3 --boundary free"),
        format!("{SPHERE_CAP} --pressure 1e-3 --stress s.npz"),
        "--indenter cylinder --radius 1 --modulus 1 --points 16384 --size 4 --pressure 1e-3 --stress s.npz".into(),
    ];
    let mut off = Vec::new();
    for case in &cases {
        let dry = folder.run(&format!("solve {case} --dry-run"));
        let told = bytes_after(text(&dry.stdout), "memory      about ");
        let peak = || high_water(&folder, &format!("solve {case}")) - base;
        let mut taken = peak();
        // on a busy machine a reading can miss the peak, so that the largest of three counts where it seems to be low
        for _ in 0..2 {
            taken = if told > 1.2 * taken { taken.max(peak()) } else { taken };
        }
        println!("{:>6.1} MB told, {:>6.1} MB taken, ratio {:.2}: {case}", told / 1e6, taken / 1e6, told / taken);
        if !(0.8..=1.2).contains(&(told / taken)) {
            off.push(case);
        }
        // what a recording holds depends on how far its writer is behind the solver
        assert!((0.6..=1.6).contains(&(told / taken)), "{case}");
    }
    assert!(off.len() <= 3, "{off:#?}");
}

/// What a history, and what a picture, takes beside its solves is told as well.
#[cfg(target_os = "linux")]
#[test]
fn a_dry_run_knows_the_peak_of_histories_and_pictures_within_a_quarter() {
    let folder = Folder::new();
    let small = format!("solve {CYLINDER} --modulus 1 --pressure 0.003");
    let base = (0..20).map(|_| high_water(&folder, &small)).fold(0.0, f64::max);
    let rough = |rest: String| format!("--hurst 0.8 --rolloff 0.25 --short-cutoff 0.02 --rms-gradient 0.1 {rest}");
    let bodies = "--young 1,1 --poisson 0.5,0.5 --friction 0.3 --reduced-pressure 0.05";
    let elastic = "--modulus 1 --reduced-pressure 0.05";
    let line = "--points 131072 --size 1";
    let cases = [
        rough(format!("{SMALL} {elastic} --creep 9,1 --path-time 0,1 --path-load 1e-3,2e-3 --path-steps 2")),
        rough(format!(
            "{SMALL} {elastic} --creep 9,1,3,0.1,1,0.3 --path-time 0,1 --path-load 1e-3,2e-3 --path-steps 6"
        )),
        rough(format!("{line} {elastic} --creep 9,1,3,0.1 --path-time 0,1 --path-load 1e-3,2e-3 --path-steps 2")),
        rough(format!("{SMALL} {elastic} --creep 9,1 --speed 0.1,1")),
        rough(format!("{line} {elastic} --creep 9,1 --speed 0.1")),
        rough(format!("{SMALL} {bodies} --tangential 5e-4")),
        rough(format!("{SMALL} {bodies} --path-tangential 5e-4,-5e-4 --path-steps 2")),
        rough(format!("{line} {bodies} --path-tangential 5e-4,-5e-4 --path-steps 2")),
        rough(format!("{line} {bodies} --creepage 1e-4 --rolling-step 1e-2")),
        rough(format!("{SMALL} {elastic} --out a.svg")),
        rough(format!("{SMALL} {elastic} --out a.png")),
    ];
    for case in &cases {
        let dry = folder.run(&format!("solve {case} --dry-run"));
        let told = bytes_after(text(&dry.stdout), "memory      about ");
        // a reading can miss the peak
        let taken = (0..2).map(|_| high_water(&folder, &format!("solve {case}")) - base).fold(0.0, f64::max);
        println!("{:>6.1} MB told, {:>6.1} MB taken, ratio {:.2}: {case}", told / 1e6, taken / 1e6, told / taken);
        assert!((0.75..=1.25).contains(&(told / taken)), "{told:e} told, {taken:e} taken: {case}");
    }
}

/// What does not fit in memory is refused by the figure that is told, in a dry run too.
#[test]
fn a_dry_run_refuses_what_does_not_fit() {
    let folder = Folder::new();
    let huge = format!("solve {ROUGH} --points 1000000,10000 --size 1 --reduced-pressure 0.05");
    let [dry, wet] = ["--dry-run", ""].map(|flag| folder.run(&format!("{huge} {flag}")));
    let told = text(&dry.stdout).split("about ").nth(1).and_then(|rest| rest.split(',').next()).unwrap().to_owned();
    for output in [dry, wet] {
        let refusal = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{refusal}");
        assert!(refusal.contains(&told), "{told} in {refusal}");
    }
}

/// A limit that is given is kept to: the solve is refused before it begins, with both figures.
#[test]
fn a_solve_above_the_memory_that_is_given_is_refused() {
    let folder = Folder::new();
    let solve = format!("solve {ROUGH} {SMALL} --reduced-pressure 0.05");
    let refused = folder.run(&format!("{solve} --memory 4MB --out a.npz"));
    let said = text(&refused.stderr);
    assert_eq!(refused.status.code(), Some(2), "{said}");
    assert!(
        said.contains("--memory is 4.0 MB") && said.lines().count() == 1 && !folder.join("a.npz").exists(),
        "{said}"
    );
    assert!(folder.run(&format!("{solve} --memory 1GB")).status.success());
}
