//! Grids that are refined, by hand or until the numbers settle.

use super::*;

const HILLS: &str = "--height hills.npy --size 1 --modulus 1 --pressure 2e-5";

/// A folder with measured heights: a rough line on a grid that is too coarse for it.
fn folder() -> Folder {
    let folder = Folder::new();
    let rough = "--points 512 --size 1 --hurst 0.5 --rolloff 0.25 --short-cutoff 0.01 --rms-gradient 0.001";
    assert!(folder.run(&format!("surface {rough} --out hills.npy")).status.success());
    folder
}

#[test]
fn a_grid_that_is_too_coarse_is_told_and_refined_until_the_numbers_settle() {
    let folder = folder();
    let output = folder.run(&format!("solve {HILLS} --json"));
    let (coarse, said) = (json(&output), text(&output.stderr).to_owned());
    assert!(number(&coarse, "kappa_r_error") > 0.1, "{coarse}");
    assert!(said.contains("warning: kappa_r may be off by") && said.contains("--refine auto"), "{said}");
    let settled = folder.run(&format!("solve {HILLS} --refine auto --json --save-setup found.toml"));
    let (settled, said) = (json(&settled), text(&settled.stderr).to_owned());
    assert!(!said.contains("warning"), "{said}");
    for error in ["relative_area_error", "kappa_r_error"] {
        assert!(number(&settled, error) <= 0.01, "{error} of {settled}");
    }
    let factor = settled["setup"]["grid"]["refine"].as_u64().unwrap();
    assert!(factor > 1);
    // the grid that was found, given by hand, and the setup that was saved
    for flags in [format!("{HILLS} --refine {factor}"), "found.toml".to_owned()] {
        let again = json(&folder.run(&format!("solve {flags} --json")));
        assert_eq!(again["kappa_r"], settled["kappa_r"], "{flags}");
    }
    // the told error of the coarse grid holds, and so does that of the settled one against one yet finer
    let finer = json(&folder.run(&format!("solve {HILLS} --refine {} --json", 4 * factor)));
    for told in [&coarse, &settled] {
        let [found, limit] = [told, &finer].map(|it| number(it, "kappa_r"));
        assert!((found / limit - 1.0).abs() < 3.0 * number(told, "kappa_r_error"), "{found} {limit}");
    }
}

#[test]
fn results_on_a_refined_grid_are_solved_again_from_themselves() {
    let folder = folder();
    let (first, _) = solve(&folder, &format!("{HILLS} --refine 4"));
    std::fs::copy(folder.join("contact.npz"), folder.join("first.npz")).unwrap();
    let (again, _) = solve(&folder, "--setup-of first.npz");
    assert_eq!((&first["kappa_r"], &first["nx"]), (&again["kappa_r"], &again["nx"]));
}

#[test]
fn points_of_roughness_are_found() {
    let folder = Folder::new();
    let rough = "--size 1 --hurst 0.8 --rolloff 0.5 --short-cutoff 0.1 --rms-gradient 0.01 --reduced-pressure 0.05";
    for (points, tolerance) in [("auto", 3e-3), ("auto,auto", 3e-2)] {
        let run = format!("solve --points {points} {rough} --area-tolerance {tolerance}");
        let plan = folder.run(&format!("{run} --dry-run"));
        assert!(text(&plan.stdout).contains("Finer grids follow until area and kappa_r are accurate enough"));
        let settled = json(&folder.run(&format!("{run} --json")));
        assert!(number(&settled, "kappa_r_error") <= tolerance, "{points}: {settled}");
        assert!(
            settled["setup"]["grid"]["points"][0].as_u64().or(settled["setup"]["grid"]["points"].as_u64()).unwrap()
                >= 64
        );
    }
}

#[test]
fn grids_that_cannot_be_found_are_refused() {
    let folder = folder();
    let rough = "--hurst 0.8 --rolloff 0.5 --short-cutoff 0.1 --rms-gradient 0.01 --size 1 --reduced-pressure 0.05";
    for (run, words) in [
        (format!("{HILLS} --refine 0"), "the refinement is 0"),
        (format!("{HILLS} --area-tolerance 0.1"), "an area tolerance needs refine = auto or points = auto"),
        (format!("{HILLS} --refine auto --area-tolerance -1"), "the tolerance of the area is -1"),
        (format!("{HILLS},3e-5 --refine auto"), "--refine auto needs one load, but several are given"),
        (format!("--points auto,64 {rough}"), "points are auto along some axes only"),
        (
            "--points auto --indenter cylinder --radius 1 --size 4 --reduced-pressure 0.1".into(),
            "points = auto works for a random rough surface",
        ),
        (format!("{HILLS} --refine 99999999999999"), "points"),
    ] {
        let output = folder.run(&format!("solve {run} --out new.npz"));
        assert_eq!(output.status.code(), Some(2), "{run}: {}", text(&output.stderr));
        assert!(text(&output.stderr).contains(words), "{run}: {}", text(&output.stderr));
        assert!(!folder.join("new.npz").exists());
    }
}

#[test]
fn a_contact_that_does_not_settle_says_so() {
    let folder = Folder::new();
    let punch = "solve --indenter punch --half-width 0.2 --depth 0.1 --points 64 --size 1 --reduced-pressure 0.001 --refine auto --json";
    let output = folder.run(punch);
    assert!(
        text(&output.stderr).contains("warning: Area and kappa_r are not accurate enough"),
        "{}",
        text(&output.stderr)
    );
    assert!(json(&output)["kappa_r"].is_null());
}
