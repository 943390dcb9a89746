//! Adhesion on the command line: loops with jumps, pull-off, their files, and what is refused.

use crate::command::{Folder, text};
use ndarray::{Array1, Array2};
use ndarray_npy::NpzReader;
use serde_json::Value;
use std::fs::{File, read_to_string};

const SINE: &str = "solve --indenter sine --amplitude 1um --points 512 --size 20um --modulus 1MPa";
const STICKY: &str = "--adhesion 10mJ/m^2 --adhesion-range 80nm";
const LOOP: &str = "--mean-gap 1um --path-load 1.6um,0.4um,1.6um --path-steps 8";

fn json(folder: &Folder, line: &str) -> Value {
    let output = folder.run(&format!("{line} --json"));
    assert!(output.status.success(), "{line}: {}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The values of a quantity in all states.
fn column(found: &Value, name: &str) -> Vec<f64> {
    found["states"].as_array().unwrap().iter().map(|state| state[name].as_f64().unwrap()).collect()
}

/// The claims of all states.
fn claims(found: &Value) -> Vec<&str> {
    found["states"].as_array().unwrap().iter().map(|state| state["claim"].as_str().unwrap()).collect()
}

#[test]
fn a_loop_jumps_in_and_out_and_is_written_to_every_file() {
    let folder = Folder::new();
    let line = format!("{SINE} {STICKY} {LOOP}");
    let found = json(&folder, &format!("{line} --out loop.npz --record loop.rrd"));
    for file in ["loop.csv", "loop.svg"] {
        assert!(folder.run(&format!("{line} --out {file}")).status.success(), "{file}");
    }
    assert_eq!(found["process"], "adhesion");
    let (adhesion, pressure) = (&found["adhesion"], column(&found, "mean_pressure"));
    let number = |name: &str| adhesion[name].as_f64().unwrap_or_else(|| panic!("{name}: {adhesion}"));
    assert_eq!([number("work"), number("range")], [0.01, 80e-9]);
    assert!((number("process_zone") / 2.037e-7 - 1.0).abs() < 1e-3 && (number("spacings") / 5.215 - 1.0).abs() < 1e-3);
    assert!(["tabor", "maugis", "pastewka_robbins"].iter().all(|name| number(name) > 0.0));
    // the lowest one may lie between two states that are shown
    let shown = pressure.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(number("lowest_pressure") <= shown && number("lowest_pressure") > 1.2 * shown, "{shown}");
    assert_eq!(adhesion["separated"], false);

    // a jump into contact on the way down, and one out of it on the way up, further away
    let jumps = adhesion["jumps"].as_array().unwrap();
    assert_eq!(jumps.len(), 2, "{jumps:?}");
    let gap = |jump: &Value| jump["mean_gap"][0].as_f64().unwrap();
    assert!(gap(&jumps[0]) < gap(&jumps[1]), "{jumps:?}");
    let energies: f64 = jumps.iter().map(|jump| jump["energy"].as_f64().unwrap()).sum();
    assert!((energies / number("lost_in_jumps") - 1.0).abs() < 1e-12 && energies > 0.0);
    assert!(number("lost_error") > 0.0 && number("lost_error") < 0.05 * energies, "{adhesion}");
    let last = jumps[1]["state"].as_u64().unwrap() as usize;
    assert!(found["states"][last - 1]["jump"].as_f64().unwrap() > 0.0);
    assert!(claims(&found).iter().all(|claim| ["stable", "marginal"].contains(claim)), "{:?}", claims(&found));
    assert!(column(&found, "residual").iter().all(|residual| *residual < 1e-7));
    // the mean pressure is that of the contact less the attraction
    let (contact, attraction) = (column(&found, "contact_pressure"), column(&found, "mean_attraction"));
    assert!((0..pressure.len()).all(|i| (contact[i] - attraction[i] - pressure[i]).abs() < 1e-6 * attraction[i]));

    let table = read_to_string(folder.join("loop.csv")).unwrap();
    assert_eq!(table.lines().count(), pressure.len() + 1);
    let names: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    assert!(
        ["mean_pressure", "mean_gap", "mean_attraction", "jump", "least_curvature"]
            .iter()
            .all(|name| names.contains(name)),
        "{names:?}"
    );
    let mut archive = NpzReader::new(File::open(folder.join("loop.npz")).unwrap()).unwrap();
    let field: Array2<f64> = archive.by_name("attraction").unwrap();
    assert_eq!(field.shape(), [pressure.len(), 512]);
    let numbers: Array1<f64> = archive.by_name("mean_pressure").unwrap();
    assert_eq!(numbers.to_vec(), pressure);
    let svg = read_to_string(folder.join("loop.svg")).unwrap();
    for axis in ["mean gap / µm", "mean pressure / kPa", "relative area"] {
        assert!(svg.contains(&format!(">{axis}</text>")), "{axis}");
    }
    assert!(folder.join("loop.rrd").metadata().unwrap().len() > 10_000);
}

/// At 1.2 um the sine touches on the way back, and did not on the way in: the load returns, but the contact does not.
#[test]
fn a_loop_that_does_not_close_loses_no_energy_per_cycle() {
    let folder = Folder::new();
    let path = |far: &str| format!("{SINE} {STICKY} --mean-gap 1um --path-load {far},0.4um,{far} --path-steps 4");
    let [open, closed] = ["1.2um", "1.6um"].map(|far| json(&folder, &path(far)));
    assert!(open["energy_per_cycle"].as_array().is_none_or(Vec::is_empty), "{}", open["energy_per_cycle"]);
    assert!(closed["energy_per_cycle"][0].as_f64().unwrap() > 0.0);
    let words = folder.run(&path("1.2um"));
    let (out, error) = (text(&words.stdout), text(&words.stderr));
    assert!(!out.contains("per cycle and area") && error.contains("does not return to its state"), "{out}{error}");
}

#[test]
fn a_pull_parts_the_surfaces_without_an_error() {
    let folder = Folder::new();
    let pulled = "--pressure 0 --path-load 0,-20kPa --path-steps 8";
    let found = json(&folder, &format!("{SINE} {STICKY} {pulled}"));
    let adhesion = &found["adhesion"];
    assert_eq!(adhesion["separated"], true);
    // Johnson's sine with a range of zero: alpha is 0.2013
    let lowest = adhesion["lowest_pressure"].as_f64().unwrap();
    assert!((lowest / -8.7e3 - 1.0).abs() < 0.05, "{lowest}");
    assert_eq!(claims(&found).last(), Some(&"separated"));
    let words = folder.run(&format!("{SINE} {STICKY} {pulled}"));
    assert!(text(&words.stdout).contains("pull-off at a mean pressure of -8."), "{}", text(&words.stdout));
    // a load that is too large from the first state on
    let apart = json(&folder, &format!("{SINE} {STICKY} --pressure=-50kPa"));
    assert_eq!((claims(&apart), &apart["adhesion"]["lowest_pressure"]), (vec!["separated"], &Value::Null));
}

#[test]
fn both_methods_find_the_same_states() {
    let folder = Folder::new();
    let path = "--mean-gap 1um --path-load 0.9um,0.5um --path-steps 4";
    let [fast, safe] =
        ["fast", "safe"].map(|method| json(&folder, &format!("{SINE} {STICKY} {path} --adhesion-method {method}")));
    assert_eq!(claims(&fast), claims(&safe));
    for name in ["mean_pressure", "relative_area", "mean_attraction"] {
        let (fast, safe) = (column(&fast, name), column(&safe, name));
        let scale = fast.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        assert!(fast.iter().zip(&safe).all(|(a, b)| (a - b).abs() < 1e-4 * scale), "{name}: {fast:?} {safe:?}");
    }
}

/// With `gfmd` a jump has frames, which the table names and the totals do not count.
#[test]
fn a_motion_shows_its_jump() {
    let folder = Folder::new();
    let path = "--mean-gap 1um --path-load 1.6um,0.8um --path-steps 8";
    let line = |method: &str| format!("{SINE} {STICKY} {path} --adhesion-method {method}");
    let [fast, motion] = ["fast", "gfmd"].map(|method| json(&folder, &format!("{} --out {method}.csv", line(method))));
    let number = |found: &Value, name: &str| found["adhesion"][name].as_f64().unwrap();
    for name in ["lowest_pressure", "lost_in_jumps"] {
        assert!((number(&motion, name) / number(&fast, name) - 1.0).abs() < 0.02, "{name}");
    }
    let frames = claims(&motion).iter().filter(|claim| **claim == "moving").count();
    assert!(frames > 5 && !claims(&fast).contains(&"moving"));
    let table = read_to_string(folder.join("gfmd.csv")).unwrap();
    assert_eq!(table.lines().filter(|row| row.split(',').nth(2) == Some("moving")).count(), frames);
    assert!(table.starts_with("state,status,claim,"));
}

#[test]
fn a_weak_attraction_has_one_solution() {
    let folder = Folder::new();
    let weak = json(&folder, &format!("{SINE} --adhesion 1mJ/m^2 --adhesion-range 200nm --mean-gap 1um"));
    assert_eq!(claims(&weak), ["solution"]);
}

#[test]
fn a_scene_repeats_the_loop_also_with_a_table() {
    let folder = Folder::new();
    // the table is the traction of a constant slope
    let table = "gap, traction\n0 nm, 125 kPa\n160 nm, 0 kPa\n";
    std::fs::write(folder.join("attraction.csv"), table).unwrap();
    let short = "--mean-gap 1um --path-load 1um,0.8um --path-steps 2";
    for attraction in
        ["--adhesion-table attraction.csv", &format!("{STICKY} --adhesion-form cubic --adhesion-method safe")]
    {
        let found = json(&folder, &format!("{SINE} {attraction} {short} --out all.npz --save-setup scene.toml"));
        assert_eq!(
            [&found["adhesion"]["work"], &found["adhesion"]["range"]].map(|it| it.as_f64().unwrap() > 0.0),
            [true; 2]
        );
        for again in ["solve scene.toml", "solve --setup-of all.npz"] {
            let again = json(&folder, again);
            assert_eq!(column(&again, "mean_pressure"), column(&found, "mean_pressure"), "{attraction}");
            assert_eq!(again["setup"], found["setup"]);
        }
    }
    let table = json(&folder, &format!("{SINE} --adhesion-table attraction.csv {short}"));
    assert!((table["adhesion"]["work"].as_f64().unwrap() / 0.01 - 1.0).abs() < 1e-12);
}

#[test]
fn an_estimate_names_the_method() {
    let folder = Folder::new();
    let estimate = folder.run(&format!("{SINE} {STICKY} {LOOP} --dry-run"));
    let estimate = text(&estimate.stdout);
    assert!(estimate.contains("Estimate for Newton steps") && estimate.contains("about 24, each"), "{estimate}");
}

#[test]
fn what_cannot_be_is_refused_in_one_sentence() {
    let folder = Folder::new();
    let table = |name: &str, rows: &str| std::fs::write(folder.join(name), rows).unwrap();
    table("rises.csv", "gap,traction\n0,1e5\n1e-7,2e5\n");
    table("late.csv", "gap,traction\n1e-8,1e5\n1e-7,0\n");
    table("unnamed.csv", "distance,traction\n0,1e5\n1e-7,0\n");
    let sticky = |rest: &str| format!("{SINE} {STICKY} {rest}");
    let sine = |rest: &str| format!("{SINE} {rest}");
    let cases = [
        (sticky("--mean-gap 1um --friction 0.3"), "adhesion and friction cannot be combined"),
        (sticky("--mean-gap 1um --creep 9,1s"), "creep and adhesion cannot be combined"),
        (sticky("--mean-gap 1um --creep 9,1s --speed 1mm/s"), "sliding and adhesion cannot be combined"),
        (sticky("--mean-gap 1um --hardness 1MPa"), "adhesion and a hardness cannot be combined"),
        (sticky("--mean-gap 1um --solver gfmd"), "--adhesion-method"),
        (sticky("--force 0 --boundary free --adhesion-method gfmd"), "damped motion needs a periodic boundary"),
        (
            sticky("--mean-gap 1um --solver polonsky-keer"),
            "adhesion and a solver other than multilevel cannot be combined",
        ),
        (sticky("--mean-gap 1um --path-time 1s"), "adhesion and times of a path cannot be combined"),
        (sticky("--mean-gap 1um --path-load 1um,2um --path-steps 0"), "1 or more"),
        (sticky("--mean-gap 1um --diagnose"), "--diagnose"),
        (sticky("--mean-gap 1um --adhesion-table rises.csv"), "only one of both"),
        (sticky("--mean-gap=-1um"), "give a positive one"),
        (sticky("--mean-gap 1um,2um"), "adhesion and several loads outside a path cannot be combined"),
        (sticky("--mean-gap 1um --boundary free"), "a mean gap has no meaning on a free boundary"),
        (sticky("--approach 10nm"), "an approach has no meaning on a periodic half-space"),
        (sine("--mean-gap 1um --adhesion 10mJ/m^2"), "needs the range"),
        (sine("--mean-gap 1um --adhesion-range 80nm"), "needs a work of adhesion"),
        (sine("--mean-gap 1um --adhesion 0 --adhesion-range 80nm"), "the work of adhesion is 0.0"),
        (sine("--mean-gap 1um --adhesion 10mJ/m^2 --adhesion-range 20nm"), "the grid is too coarse"),
        (sine("--mean-gap 1um --adhesion-table rises.csv"), "tractions must not increase"),
        (sine("--mean-gap 1um --adhesion-table late.csv"), "its first gap"),
        (sine("--mean-gap 1um --adhesion-table unnamed.csv"), "the column gap is missing"),
        (sine("--mean-gap 1um --adhesion-table missing.csv"), "missing.csv"),
        (sine("--pressure=-1kPa"), "the mean pressure is -1kPa"),
    ];
    for (line, sentence) in cases {
        let output = folder.run(&format!("{line} --out result.npz"));
        let error = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{line}: {error}");
        assert!(error.contains(sentence) && error.trim_end().lines().count() == 1, "{line}: {error}");
        assert!(!folder.join("result.npz").exists(), "{line}");
    }
}

const STUDY: &str = r#"
surface = { spectrum = { hurst = 0.8, rolloff-wavelength = "5um", short-cutoff = "1um", rms-gradient = [0.02, 0.05] }, seed = "1-2" }
grid = { points = 512, size = "20um" }
solid = { contact-modulus = "1MPa" }
load = { mean-pressure = "10kPa" }
adhesion = { work = ["1mJ/m^2", "3mJ/m^2"], range = "60nm" }
path = { load = ["10kPa", "0Pa", "-60kPa"], steps = 5 }
"#;

/// The column of a table.
fn table_column(folder: &Folder, file: &str, name: &str) -> Vec<String> {
    let text = read_to_string(folder.join(file)).unwrap();
    let mut csv = csv::Reader::from_reader(text.as_bytes());
    let place = csv.headers().unwrap().iter().position(|it| it == name).unwrap_or_else(|| panic!("no {name}"));
    csv.records().map(|row| row.unwrap()[place].to_owned()).collect()
}

const STIFF: &str = "solve --indenter sine --amplitude 1um --points 64 --size 10um --modulus 200GPa";

/// The attraction is 5e-8 of the modulus, so that rounding of the elastic stress hides it: both methods find the state.
#[test]
fn a_stiff_solid_has_a_state_that_is_found() {
    let folder = Folder::new();
    for load in ["--mean-gap 0.5um", "--pressure 1GPa"] {
        let [fast, safe] = ["fast", "safe"].map(|method| {
            json(
                &folder,
                &format!("{STIFF} --adhesion 10mJ/m^2 --adhesion-range 1um {load} --adhesion-method {method}"),
            )
        });
        assert_eq!(claims(&fast), claims(&safe), "{load}");
        assert!(!claims(&fast).contains(&"not-converged"));
        for (found, goal) in [(&fast, 1e-8), (&safe, 1e-6)] {
            assert!(column(found, "residual").iter().all(|residual| *residual <= goal), "{load}");
        }
        for name in ["mean_pressure", "mean_gap", "mean_attraction"] {
            let [fast, safe] = [column(&fast, name)[0], column(&safe, name)[0]];
            assert!((fast / safe - 1.0).abs() < 1e-6, "{load}, {name}: {fast} {safe}");
        }
    }
}

/// The iterations are those of the whole state, and a state that misses its goal is claimed as nothing else.
#[test]
fn a_state_that_is_not_converged_says_so() {
    let folder = Folder::new();
    for method in ["fast", "safe", "gfmd"] {
        let line = format!("{SINE} {STICKY} --mean-gap 0.6um --adhesion-method {method} --max-iterations 3 --json");
        let output = folder.run(&line);
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(3), "{method}: {said}");
        assert!(said.contains("not converged") && said.contains("in 3 iterations"), "{method}: {said}");
        let found: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!((claims(&found), &found["states"][0]["status"]), (vec!["not-converged"], &"iteration-cap".into()));
    }
}

/// Numbers of a contact without adhesion are in no file; the reduced pressure is that of the state.
#[test]
fn numbers_without_a_meaning_are_absent() {
    let folder = Folder::new();
    let found =
        json(&folder, &format!("{SINE} {STICKY} --mean-gap 1um --path-load 1.6um,0.6um --path-steps 2 --out a.npz"));
    let mut archive = NpzReader::new(File::open(folder.join("a.npz")).unwrap()).unwrap();
    let numbers =
        |archive: &mut NpzReader<File>, name: &str| archive.by_name::<ndarray::OwnedRepr<f64>, ndarray::Ix1>(name);
    let unit = numbers(&mut archive, "rms_gradient").unwrap()[0] * 1e6;
    let reduced = numbers(&mut archive, "reduced_pressure").unwrap();
    let expected: Vec<f64> = column(&found, "mean_pressure").iter().map(|pressure| pressure / unit).collect();
    assert!(reduced.iter().zip(&expected).all(|(a, b)| (a - b).abs() <= 1e-12 * b.abs()), "{reduced} {expected:?}");
    for name in ["kappa", "kappa_r", "kappa_r_counted", "elastic_energy", "reduced_pressure_contact", "certificate"] {
        assert!(numbers(&mut archive, name).is_err() && found["states"][0].get(name).is_none(), "{name}");
    }
    let areas =
        [numbers(&mut archive, "relative_area").unwrap(), numbers(&mut archive, "relative_area_counted").unwrap()];
    assert_eq!(areas[0], areas[1]);
}

/// On a free boundary the stability is not known, which a warning says.
#[test]
fn states_of_unknown_stability_have_a_warning() {
    let folder = Folder::new();
    let line = "solve --indenter cylinder --radius 1mm --points 128 --size 200um --boundary free --modulus 1MPa --adhesion 10mJ/m^2 \
                --adhesion-range 1um --approach 1um";
    let output = folder.run(line);
    let said = text(&output.stderr);
    assert!(
        output.status.success() && said.contains("The stability of 1 of 1 states (state 1) is not known"),
        "{said}"
    );
}

/// A study has the pull-off of a weak attraction on a long path, which a path around it has as well.
#[test]
fn a_study_finds_a_pull_off_that_is_short_on_its_path() {
    let folder = Folder::new();
    let scene = |end: &str| {
        format!(
            "surface = {{ indenter = {{ shape = \"sine\", amplitude = \"1um\" }} }}\ngrid = {{ points = 256, size = \"20um\" }}\n\
             solid = {{ contact-modulus = \"1MPa\" }}\nload = {{ mean-pressure = \"1kPa\" }}\n\
             adhesion = {{ work = [\"0.1mJ/m^2\"], range = \"100nm\" }}\npath = {{ load = [\"1kPa\", \"{end}\"], steps = 2 }}\n"
        )
    };
    let lowest = ["-1MPa", "-200Pa", "-150Pa"].map(|end| {
        std::fs::write(folder.join("study.toml"), scene(end)).unwrap();
        let output = folder.run("study study.toml --fresh");
        assert!(output.status.success(), "{}", text(&output.stderr));
        table_column(&folder, "study.csv", "lowest_pressure")[0].parse::<f64>().unwrap()
    });
    assert!(lowest.iter().all(|it| *it < 0.0 && (it / lowest[1] - 1.0).abs() < 0.01), "{lowest:?}");
}

/// A study over works of adhesion and roughnesses has the pull-off of each scene, which the scene alone has as well; its shares give the same
/// table, and rows that are there are not solved again.
#[test]
fn a_study_finds_pull_off_against_roughness() {
    let folder = Folder::new();
    std::fs::write(folder.join("study.toml"), STUDY).unwrap();
    let done = |line: &str| {
        let output = folder.run(line);
        assert!(output.status.success(), "{line}: {}", text(&output.stderr));
        text(&output.stdout).to_owned()
    };
    let told = done("study study.toml");
    assert_eq!(told.lines().filter(|line| line.contains("rms-gradient 0.0")).count(), 4, "{told}");
    let whole = std::fs::read(folder.join("study.csv")).unwrap();
    assert!(folder.join("study.png").is_file() && folder.join("study.parquet").is_file());

    let lowest: Vec<f64> =
        table_column(&folder, "study.csv", "lowest_pressure").iter().map(|word| word.parse().unwrap()).collect();
    // gradient, work, seed: more work holds more, and so does a smoother surface
    let mean = |first: usize| -0.5 * (lowest[first] + lowest[first + 1]);
    assert!(mean(2) > 2.0 * mean(0) && mean(6) > 2.0 * mean(4), "{lowest:?}");
    assert!(mean(0) > 1.2 * mean(4) && mean(2) > 1.2 * mean(6), "{lowest:?}");
    for name in ["separated", "stable"] {
        assert!(table_column(&folder, "study.csv", name).iter().all(|word| word == "true"), "{name}");
    }
    assert!(table_column(&folder, "study.csv", "status").iter().all(|word| word == "converged"));

    // the scene of a row, solved alone
    std::fs::write(folder.join("row.toml"), table_column(&folder, "study.csv", "scene").swap_remove(5)).unwrap();
    let found = json(&folder, "solve row.toml");
    assert_eq!(found["adhesion"]["lowest_pressure"].as_f64().unwrap(), lowest[5]);

    let seconds = std::fs::read(folder.join("study.seconds.csv")).unwrap();
    done("study study.toml");
    assert!(std::fs::read(folder.join("study.seconds.csv")).unwrap() == seconds, "rows were solved again");
    for share in ["1/2", "2/2"] {
        done(&format!("study study.toml --out shares.csv --shard {share}"));
    }
    done("merge study.toml shares.1-of-2.csv shares.2-of-2.csv --out shares.csv");
    assert!(std::fs::read(folder.join("shares.csv")).unwrap() == whole);
}

#[test]
fn studies_with_adhesion_that_cannot_be_solved_are_refused_before_they_begin() {
    let folder = Folder::new();
    let refused = |study: String, line: &str, expected: &str| {
        std::fs::write(folder.join("study.toml"), study).unwrap();
        let output = folder.run(line);
        let said = text(&output.stderr);
        assert!(output.status.code() == Some(2) && said.contains(expected), "{said}");
        assert!(!folder.join("study.unfinished").exists());
    };
    let several = STUDY.replace("mean-pressure = \"10kPa\"", "mean-pressure = [\"10kPa\", \"20kPa\"]");
    refused(several, "study study.toml", "give one load, and further ones as path.load");
    refused(STUDY.replace("\"3mJ/m^2\"", "\"90mJ/m^2\""), "study study.toml", "row 3 (rms-gradient 0.02");
    refused(STUDY.into(), "study study.toml --record-row 3 --record row.rrd", "record it with asperity solve");
}

/// A gap at which nothing is felt is refused before a path to it begins, and one that is only large is not.
#[test]
fn a_gap_beyond_all_contacts_is_refused() {
    let folder = Folder::new();
    let path = |gap: &str| folder.run(&format!("{SINE} {STICKY} --mean-gap 1um --path-load {gap},1um --path-steps 1"));
    let refused = path("1e140m");
    assert_eq!(refused.status.code(), Some(2));
    assert!(
        text(&refused.stderr).contains("the mean gap is 1e140: give one of at most 1e2"),
        "{}",
        text(&refused.stderr)
    );
    assert!(path("1mm").status.success());
}
