//! Histories on the command line: creep, sliding, slip cycles and rolling, their files, and what is refused.

use crate::command::{Folder, text};
use serde_json::Value;

const ROUGH: &str = "solve --hurst 0.8 --rolloff 0.125 --short-cutoff 0.02 --rms-gradient 0.1 --points 512 --size 1 --reduced-pressure 0.05";
const CYLINDER: &str = "solve --indenter cylinder --radius 1 --points 256 --size 0.5 --boundary free --modulus 1 --force 0.01 --friction 0.3";

fn json(folder: &Folder, line: &str) -> Value {
    let output = folder.run(line);
    assert!(output.status.success(), "{line}: {}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The values of a quantity in all states.
fn column(found: &Value, name: &str) -> Vec<f64> {
    found["states"].as_array().unwrap().iter().map(|state| state[name].as_f64().unwrap()).collect()
}

#[test]
fn a_held_load_creeps_towards_the_relaxed_contact() {
    let folder = Folder::new();
    let found = json(&folder, &format!("{ROUGH} --creep 9,1 --path-time 30 --json"));
    assert_eq!(found["process"], "creep");
    let (area, effective) = (column(&found, "relative_area"), column(&found, "effective_pressure"));
    // at the end it grows by less than the certificate lets it change
    assert!(area.windows(2).all(|pair| pair[1] > pair[0] * (1.0 - 1e-8)) && area.len() > 8, "{area:?}");
    assert!((effective.last().unwrap() / effective[0] - 10.0).abs() < 1e-6, "{effective:?}");
    // the relaxed contact is the elastic one under ten times the load
    let elastic = json(&folder, &format!("{} 0.5 --json", ROUGH.trim_end_matches(" 0.05")));
    let relaxed = elastic["relative_area"].as_f64().unwrap();
    assert!((area.last().unwrap() / relaxed - 1.0).abs() < 1e-3, "{area:?} against {relaxed}");
}

/// Triangles of a pressure that is uniform but for waves of 1e-6, on a layer: the losses are those of the closed form
/// `u = c (P + eps)`, `tau eps' + eps = f P`. Each stands beside its error.
#[test]
fn a_cycle_states_its_loss_with_the_error_of_it() {
    let folder = Folder::new();
    let layer =
        "solve --indenter sine --amplitude 1e-6 --points 64 --size 1 --young 1 --poisson 0.3 --layer 0.2 --base bonded";
    let path = "--path-time 0,1.5,3,4.5,6 --path-load 0.002,0.01,0.002,0.01,0.002";
    let line = format!("{layer} --pressure 0.01 --creep 4,1 {path}");
    let found = json(&folder, &format!("{line} --json --out states.csv"));
    let [time, lost, error] = ["time", "dissipated", "dissipated_time_error"].map(|name| column(&found, name));
    for (at, exact) in [(3.0, 1.63689e-5), (6.0, 2.41561e-5)] {
        let i = time.iter().position(|time| *time == at).expect("a state at each point");
        let off = (lost[i] - exact).abs();
        assert!(off < 1e-2 * exact && off < 1.5 * error[i] + 1e-10, "{at}: {} for {exact}, {}", lost[i], error[i]);
    }
    let text_of = folder.run(&line);
    assert!(text(&text_of.stdout).contains("energy lost   error of loss   error in time"), "{}", text(&text_of.stdout));
    assert!(std::fs::read_to_string(folder.join("states.csv")).unwrap().contains("dissipated_time_error"));
}

/// What the tolerance limits is warned of wherever it is missed, and nothing else is.
#[test]
fn the_warning_names_each_error_in_time_above_the_tolerance() {
    let folder = Folder::new();
    let (rough, mut named) = (ROUGH.replace("--points 512", "--points 128"), [0; 3]);
    for (path, tolerance) in [
        ("--path-time 0,1,2 --path-load 0,0.05,0.01", 1e-2),
        ("--path-time 0,0.1,20,20.1,40 --path-load 0,0.05,0.05,0.001,0.001", 1e-3),
        ("--path-time 0,1,2,3 --path-load 0,0.02,0,0.05", 1e-4),
    ] {
        let line = format!("{rough} --creep 3,1,1,0.1 {path} --time-tolerance {tolerance} --json");
        let found = json(&folder, &line);
        let warnings = found["warnings"].to_string();
        let of = |name: &str| -> Vec<f64> {
            let states = found["states"].as_array().unwrap();
            states.iter().map(|state| state[name].as_f64().unwrap_or(0.0)).collect()
        };
        let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        let (pressure, gap, lost, time) = (of("mean_pressure"), of("mean_gap"), of("dissipated"), of("time"));
        let rms_height = gap[0] / of("mean_gap_over_rms_height")[0];
        let ends: Vec<f64> = path.split(' ').nth(1).unwrap().split(',').map(|it| it.parse().unwrap()).collect();
        let at_point = |i: usize| {
            let end = ends.iter().find(|end| **end >= time[i]).unwrap();
            lost[time.iter().rposition(|time| time == end).unwrap()]
        };
        for (i, (name, is_missed)) in [
            (
                "contact pressure",
                (0..time.len()).any(|i| of("time_error")[i] > tolerance && pressure[i] > 0.01 * largest(&pressure)),
            ),
            (
                "mean gap",
                (0..time.len()).any(|i| of("mean_gap_time_error")[i] > tolerance * gap[i].max(0.01 * rms_height)),
            ),
            (
                "lost energy",
                (0..time.len()).any(|i| of("dissipated_time_error")[i] > tolerance * at_point(i) && at_point(i) > 0.0),
            ),
        ]
        .into_iter()
        .enumerate()
        {
            assert_eq!(warnings.contains(&format!("of the {name} in ")), is_missed, "{path}: {name} {warnings}");
            named[i] += usize::from(is_missed);
        }
    }
    assert!(named[0] > 0 && named.iter().sum::<usize>() < 9, "{named:?}");
}

#[test]
fn a_relaxation_series_is_the_creep_series_of_the_same_solid() {
    let folder = Folder::new();
    // a standard linear solid: f = g/(1 - g), tau = tau_R/(1 - g)
    let of = |memory: &str| {
        column(&json(&folder, &format!("{ROUGH} {memory} --path-time 2 --path-steps 5 --json")), "mean_gap")
    };
    let [creep, relaxation] = ["--creep 9,1", "--relaxation 0.9,0.1"].map(of);
    assert_eq!(creep.len(), relaxation.len());
    assert!(creep.iter().zip(&relaxation).all(|(a, b)| (a / b - 1.0).abs() < 1e-6), "{creep:?} {relaxation:?}");
}

#[test]
fn a_path_can_come_from_a_file_and_is_carried_by_every_result() {
    let folder = Folder::new();
    std::fs::write(folder.join("path.csv"), "# press and release\ntime, load\n0, 0.02\n1, 0.05\n2, 0\n3, 0\n").unwrap();
    let line = format!("{ROUGH} --creep 9,1 --path path.csv --path-steps 3 --json");
    let found = json(&folder, &format!("{line} --out all.npz --save-setup scene.toml"));
    let pressure = column(&found, "mean_pressure");
    assert_eq!((pressure.len(), pressure[pressure.len() - 1], pressure[6]), (10, 0.0, 0.0), "{pressure:?}");
    std::fs::remove_file(folder.join("path.csv")).unwrap();
    for again in ["solve scene.toml --json", "solve --setup-of all.npz --json"] {
        let again = json(&folder, again);
        assert_eq!(again["states"].as_array().unwrap().len(), 10);
        assert_eq!(column(&again, "mean_gap"), column(&found, "mean_gap"));
    }
}

#[test]
fn a_friction_curve_has_its_maximum_between_slow_and_fast() {
    let folder = Folder::new();
    let line = format!("{ROUGH} --creep 9,1 --speed 1e-4..1e2:7");
    let found = json(&folder, &format!("{line} --json --record curve.rrd --out curve.svg"));
    let friction = column(&found, "friction");
    let most = friction.iter().copied().fold(0.0, f64::max);
    assert!(friction.len() == 7 && friction[0] < 0.5 * most && friction[6] < 0.01 * most, "{friction:?}");
    assert!(found["claim"].as_str().unwrap().starts_with("bounded"));
    assert!(folder.join("curve.rrd").metadata().unwrap().len() > 10_000);
    assert!(std::fs::read_to_string(folder.join("curve.svg")).unwrap().contains("<svg"));
    // one speed is an ordinary contact, whose steps can be recorded
    let one = json(&folder, &format!("{ROUGH} --creep 9,1 --speed 0.01 --json --record one.rrd"));
    assert_eq!([&one, &found].map(|it| it["solver"]["method"].as_str().unwrap()), ["monotone"; 2]);
    assert!((one["friction"].as_f64().unwrap() / friction[2] - 1.0).abs() < 1e-4);
    let text_of = folder.run(&format!("{ROUGH} --creep 9,1 --speed 0.01"));
    assert!(text(&text_of.stdout).contains("friction"), "{}", text(&text_of.stdout));
    assert!(text(&text_of.stdout).contains("monotone"), "{}", text(&text_of.stdout));
}

/// One speed and several say that the surface meets the trails of its images, and by how much.
#[test]
fn a_trail_that_is_longer_than_the_cell_is_told() {
    let folder = Folder::new();
    let of = |speeds: &str| format!("{ROUGH} --creep 9,1 --speed {speeds}");
    let short = folder.run(&of("0.5"));
    assert!(short.status.success() && !text(&short.stderr).contains("trail"), "{}", text(&short.stderr));
    let one = folder.run(&of("2"));
    let told = text(&one.stderr);
    assert!(one.status.success() && told.contains("is 2.000e0 long, and the cell 1.000e0 along x"), "{told}");
    assert!(told.contains("Use a cell that is longer along x than the trail, or a lower speed (--size"), "{told}");
    let several = json(&folder, &format!("{} --json", of("0.5,2,4")));
    let warnings = several["warnings"].to_string();
    assert!(warnings.contains("At 2 of 3 speeds the trail") && warnings.contains("up to 4.000e0"), "{warnings}");
    for speeds in ["2", "0.5,2,4"] {
        let refused = folder.run(&format!("{} --strict", of(speeds)));
        assert_eq!(refused.status.code(), Some(2), "{}", text(&refused.stderr));
    }
}

/// A slow slide is the relaxed contact in the output, too.
#[test]
fn a_slow_slide_has_the_numbers_of_the_relaxed_contact() {
    let folder = Folder::new();
    let slow = json(&folder, &format!("{ROUGH} --creep 9,1 --speed 1e-12 --json"));
    let several = json(&folder, &format!("{ROUGH} --creep 9,1 --speed 1e-12,2e-12 --json"));
    let relaxed = json(&folder, &format!("{} 0.5 --json", ROUGH.trim_end_matches(" 0.05")));
    for name in ["relative_area", "kappa", "kappa_r", "reduced_pressure", "reduced_pressure_contact"] {
        let [slow, relaxed] = [&slow, &relaxed].map(|it| it[name].as_f64().unwrap());
        assert!((slow / relaxed - 1.0).abs() < 1e-4, "{name}: {slow} for {relaxed}");
    }
    for name in ["relative_area", "kappa_r", "effective_modulus"] {
        let one = slow[name].as_f64().unwrap();
        assert!(column(&several, name).iter().all(|it| (it / one - 1.0).abs() < 1e-4), "{name}: {one}");
    }
}

#[test]
fn a_slip_cycle_writes_its_loop() {
    let folder = Folder::new();
    let cycle = "--path-tangential 0.0025,-0.0025,0.0025 --path-steps 4";
    let found = json(&folder, &format!("{CYLINDER} {cycle} --json --out loop.csv --record loop.rrd"));
    let (shift, traction) = (column(&found, "shift"), column(&found, "mean_traction"));
    assert_eq!(shift.len(), 12);
    // the loop closes, and what it encloses is what friction dissipates
    assert!((shift[3] / shift[11] - 1.0).abs() < 1e-6);
    let lost = found["energy_per_cycle"][0].as_f64().unwrap();
    let pairs = (4..12).map(|i| 0.5 * (traction[i] + traction[i - 1]) * (shift[i] - shift[i - 1]));
    let enclosed: f64 = pairs.sum();
    assert!(lost > 0.0 && (enclosed / lost - 1.0).abs() < 0.2, "{enclosed} against {lost}");
    let table = std::fs::read_to_string(folder.join("loop.csv")).unwrap();
    assert!(table.lines().count() == 13 && table.starts_with("state,status,"));
    let words = folder.run(&format!("{CYLINDER} {cycle}"));
    assert!(text(&words.stdout).contains("energy lost per cycle"), "{}", text(&words.stdout));
}

#[test]
fn a_path_ends_where_everything_slides_and_keeps_its_states() {
    let folder = Folder::new();
    // friction carries less than 0.003
    for (path, states) in [("0.0015,0.003,0", 1), ("0.0015,-0.01 --path-steps 8", 11), ("0.005 --path-steps 4", 2)] {
        let output = folder.run(&format!("{CYLINDER} --path-tangential {path} --json --out states.npz"));
        let error = text(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{path}: {error}");
        let found: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(found["states"].as_array().unwrap().len(), states, "{path}");
        assert!(error.contains("makes everything slide") && error.contains("The history ended after"), "{error}");
        assert!(found["warnings"][0].as_str().unwrap().contains("makes everything slide"));
        assert!(found["ended"].as_str().unwrap().contains("makes everything slide"));
        let mut npz = ndarray_npy::NpzReader::new(std::fs::File::open(folder.join("states.npz")).unwrap()).unwrap();
        let traction: ndarray::Array2<f64> = npz.by_name("traction").unwrap();
        assert_eq!(traction.nrows(), states);
        std::fs::remove_file(folder.join("states.npz")).unwrap();
    }
}

/// The heights of the archive are those given, and displacement less height is the gap, up to the datum.
#[test]
fn archives_of_different_bodies_have_the_whole_displacement() {
    let folder = Folder::new();
    let bodies = CYLINDER.replace("--modulus 1", "--young 1 --poisson 0.2");
    for motion in ["--path-load 0.005,0.01 --path-tangential 0.0005,0.002", "--rolling 0,0.001"] {
        folder.run(&format!("{CYLINDER} {motion} --out equal.npz"));
        let output = folder.run(&format!("{bodies} {motion} --out states.npz"));
        assert!(output.status.success(), "{}", text(&output.stderr));
        let open = |name: &str| ndarray_npy::NpzReader::new(std::fs::File::open(folder.join(name)).unwrap()).unwrap();
        let (mut npz, mut equal) = (open("states.npz"), open("equal.npz"));
        let height: ndarray::Array1<f64> = npz.by_name("height").unwrap();
        assert_eq!(height, equal.by_name::<ndarray::OwnedRepr<f64>, ndarray::Ix1>("height").unwrap());
        let [displacement, gap]: [ndarray::Array2<f64>; 2] = ["displacement", "gap"].map(|it| npz.by_name(it).unwrap());
        assert_eq!(gap.nrows(), 2);
        for (u, gap) in displacement.rows().into_iter().zip(gap.rows()) {
            let datum = &u - &height - gap;
            let [low, high] = [f64::min, f64::max].map(|of| datum.iter().copied().fold(datum[0], of));
            let deepest = gap.iter().copied().fold(0.0, f64::max);
            assert!(
                high - low < 1e-12 * deepest && gap.iter().all(|gap| *gap > -1e-6 * deepest),
                "{motion}: {low} {high}"
            );
        }
    }
}

#[test]
fn rolling_that_does_not_converge_comes_back_as_it_is() {
    let folder = Folder::new();
    for motion in ["--rolling 0.001", "--path-tangential 0.001"] {
        let output = folder.run(&format!("{CYLINDER} {motion} --max-iterations 1 --json --out rolling.npz"));
        assert_eq!(output.status.code(), Some(3), "{motion}: {}", text(&output.stderr));
        let found: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_ne!(found["states"][0]["status"], "converged");
        assert!(text(&output.stderr).contains("1 of 1 states did not reach"), "{}", text(&output.stderr));
        std::fs::remove_file(folder.join("rolling.npz")).unwrap();
    }
}

#[test]
fn rolling_goes_from_force_to_creepage_and_back() {
    let folder = Folder::new();
    let there = json(&folder, &format!("{CYLINDER} --rolling 0,0.001,0.002 --json"));
    let creepages: Vec<String> = column(&there, "creepage").iter().map(f64::to_string).collect();
    let back = json(&folder, &format!("{CYLINDER} --creepage={} --json", creepages.join(",")));
    let friction = column(&back, "friction");
    assert!(friction[0].abs() < 1e-6 && (friction[1] - 0.1).abs() < 1e-5 && (friction[2] - 0.2).abs() < 1e-5);
}

#[test]
fn times_and_speeds_have_units() {
    let folder = Folder::new();
    let line = "solve --indenter cylinder --radius 50mm --points 512 --size 40mm --modulus 1905MPa --pressure 1MPa";
    let seconds = json(&folder, &format!("{line} --creep 1,0.009 --path-time 0.02 --path-steps 2 --json"));
    let millis = json(&folder, &format!("{line} --creep 1,9ms --path-time 20ms --path-steps 2 --json"));
    assert_eq!(column(&seconds, "mean_gap"), column(&millis, "mean_gap"));
    let fast = json(&folder, &format!("{line} --creep 1,9ms --speed 1m/s --json"));
    let same = json(&folder, &format!("{line} --creep 1,0.009 --speed 1000mm/s --json"));
    assert_eq!(fast["friction"], same["friction"]);
}

#[test]
fn what_cannot_be_is_refused_in_one_sentence() {
    let folder = Folder::new();
    std::fs::write(folder.join("wrong.csv"), "time,force\n0,1\n").unwrap();
    std::fs::write(folder.join("empty.csv"), "time,load\n").unwrap();
    let rough = |rest: &str| format!("{ROUGH} {rest}");
    let cylinder = |rest: &str| format!("{CYLINDER} {rest}");
    let coefficient = |value: &str, rest: &str| {
        format!("{} {rest}", CYLINDER.replace("--friction 0.3", &format!("--friction={value}")))
    };
    let cases = [
        (rough("--creep 9,1"), "creep without times of a path cannot be solved"),
        (rough("--creep 9 --path-time 1"), "give pairs of a ratio and a time"),
        (rough("--creep=-9,1 --path-time 1"), "-9"),
        (rough("--relaxation 0.6,1,0.6,2 --path-time 1"), "1.2"),
        (rough("--creep 9,1 --relaxation 0.5,1 --path-time 1"), "give one of them"),
        (rough("--speed 1"), "sliding without creep cannot be solved"),
        (rough("--creep 9,1 --speed=-1,1"), "-1"),
        (rough("--creep 9,1 --speed 0"), "positive"),
        (rough("--creep 9,1 --speed 1 --path-time 1"), "sliding and times of a path cannot be combined"),
        (rough("--creep 9,1 --path-time 2,1"), "ascending"),
        (rough("--creep 9,1 --path-time 0,1 --path-load 1,2,3"), "2 times, 3 loads"),
        (rough("--creep 9,1 --path-time 1 --path-steps 0"), "1 or more"),
        (rough("--creep 9,1 --path-time 1 --time-tolerance 2"), "between 0 and 1"),
        (cylinder("--path-tangential 1e-3 --path-tolerance 2"), "between 0 and 1"),
        (rough("--creep 9,1 --path missing.csv"), "missing.csv"),
        (rough("--creep 9,1 --path wrong.csv"), "`force` is not known"),
        (rough("--creep 9,1 --path empty.csv"), "is empty"),
        (rough("--creep 9,1 --speed 1 --hardness 0.1"), "sliding and a hardness cannot be combined"),
        (rough("--creep 9,1 --path-time 1 --solver gfmd"), "gfmd"),
        (rough("--creep 9,1 --path-time 1 --diagnose"), "--diagnose"),
        (rough("--path-load 0.1,0.2"), "no tangential loads"),
        (cylinder("--path-tangential 0.01"), "slide"),
        (cylinder("--rolling 0.01"), "slide"),
        (
            cylinder("--rolling 1e-3 --solver polonsky-keer"),
            "rolling and a solver other than multilevel cannot be combined",
        ),
        (cylinder("--rolling 1e-3 --rolling-step 1"), "the step of rolling is 1.0, longer than the line of 0.5"),
        (cylinder("--rolling 1e-3 --rolling-step 0.4"), "the step of rolling is 0.4, longer than the contact of 0.2"),
        (coefficient("-1", "--path-tangential=-1e-3,1e-3"), "the coefficient of friction is -1: give a number above 0"),
        (coefficient("0", "--path-tangential 0,0"), "the coefficient of friction is 0: give a number above 0"),
        (coefficient("nan", "--tangential 1e-3"), "the coefficient of friction is NaN: give a number above 0"),
        (coefficient("inf", "--creepage=-1e-4"), "the coefficient of friction is inf: give a finite number above 0"),
        (cylinder("--rolling 0 --creepage 1e-3"), "give one of them"),
        (cylinder("--rolling 0 --creep 9,1"), "rolling and creep cannot be combined"),
        (
            cylinder("--path-tangential 1e-3 --path-time 1"),
            "tangential loads of a path and times of a path cannot be combined",
        ),
        (cylinder("--tangential 1e-3 --hardness 1"), "elastic contacts only"),
    ];
    for (line, sentence) in cases {
        let output = folder.run(&format!("{line} --out result.npz"));
        let error = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{line}: {error}");
        assert!(error.contains(sentence) && error.trim_end().lines().count() == 1, "{line}: {error}");
        assert!(!folder.join("result.npz").exists(), "{line}");
    }
}

/// What a cycle of a cylinder loses by Mindlin's theory, `(2 mu^2 F^2/(pi E*)) (1 - y^2 + 2 y ln y)` per length with `y = 1 - Q/(mu F)`, here
/// 1/2: from a pull to the same pull, and from no pull on the way up to no pull on the way up.
#[test]
fn half_a_cycle_is_no_cycle() {
    let folder = Folder::new();
    let cycles = |path: &str| {
        let found = json(&folder, &format!("{CYLINDER} --path-tangential {path} --json --out states.npz"));
        let losses = found["energy_per_cycle"].as_array().map_or_else(Vec::new, Vec::clone);
        std::fs::remove_file(folder.join("states.npz")).unwrap();
        losses.iter().map(|lost| lost.as_f64().unwrap()).collect::<Vec<_>>()
    };
    let (mu, force, y) = (0.3_f64, 0.01_f64, 0.5_f64);
    let exact = 2.0 * (mu * force).powi(2) / std::f64::consts::PI * (1.0 - y * y + 2.0 * y * y.ln()) / 0.5;
    for (path, count) in [
        ("0.0015,-0.0015,0.0015", 1),
        ("0,0.0015,0,-0.0015,0,0.0015,0,-0.0015,0", 1),
        ("0,0.0015,0,-0.0015,0,0.0015,0,-0.0015,0,0.0015,0,-0.0015,0,0.0015", 3),
        ("0,0.0015,0", 0),
        ("0.0015,0,0.001,0", 1),
    ] {
        let found = cycles(path);
        assert_eq!(found.len(), count, "{path}: {found:?}");
        if !path.contains("0.001,") {
            assert!(found.iter().all(|lost| (lost / exact - 1.0).abs() < 0.03), "{path}: {found:?} for {exact}");
        }
    }
}

/// A state that carries nothing has no reduced pressure but 0 and no `kappa_r`, however the loads before it were given.
#[test]
fn a_state_without_a_load_has_none_of_an_earlier_one() {
    let folder = Folder::new();
    let line = "solve --indenter sine --amplitude 0.01 --points 64 --size 1 --modulus 1 --creep 4,1 --path-time 0,1,2,3 --path-steps 1";
    for (kind, path) in
        [("pressure", "0.002,0,0,0.002"), ("force", "0.002,0,0,0.002"), ("reduced-pressure", "0.02,0,0,0.02")]
    {
        let found = json(&folder, &format!("{line} --{kind} 0.02 --path-load {path} --json --out {kind}.npz"));
        let states = found["states"].as_array().unwrap();
        assert!(states.iter().all(|state| state["reduced_pressure"].is_number() && state["mean_pressure"].is_number()));
        let apart: Vec<&Value> = states.iter().filter(|state| state["mean_pressure"] == 0.0).collect();
        assert_eq!(apart.len(), 2, "{found}");
        for state in apart {
            assert_eq!(state["reduced_pressure"], 0.0, "{kind}: {state}");
            for name in ["kappa_r", "nodes_per_patch", "unresolved_share", "rms_gradient_contact_counted"] {
                assert!(state.get(name).is_none(), "{kind}: {name} {state}");
            }
        }
        let patches = folder.run(&format!("patches --setup-of {kind}.npz --json"));
        let patches: Value =
            serde_json::from_slice(&patches.stdout).unwrap_or_else(|_| panic!("{}", text(&patches.stderr)));
        assert_eq!(patches["states"][1]["reduced_pressure"], 0.0, "{patches}");
    }
}

/// An approach below 0 lifts a sphere off a solid that creeps, which recovers.
#[test]
fn a_sphere_is_lifted_off_a_solid_that_creeps() {
    let folder = Folder::new();
    let line = "solve --indenter sphere --radius 1 --points 32,32 --size 1,1 --boundary free --modulus 1 --creep 4,1 --path-time 0,1,1,30";
    let found = json(&folder, &format!("{line} --approach 0.02 --path-load 0.02,0.02,-0.01,-0.01 --json"));
    let (pressure, approach) = (column(&found, "mean_pressure"), column(&found, "approach"));
    assert!(pressure[0] > 0.0 && pressure[pressure.len() - 1] == 0.0, "{pressure:?}");
    assert!((approach[approach.len() - 1] + 0.01).abs() < 1e-12, "{approach:?}");
    // all that was done is lost, since nothing is left in the solid
    let (lost, work, stored) = (column(&found, "dissipated"), column(&found, "work_done"), column(&found, "stored"));
    let last = lost.len() - 1;
    assert!((lost[last] / work[last] - 1.0).abs() < 0.02 && stored[last] < 1e-3 * work[last], "{lost:?} {work:?}");
    let held = json(&folder, &format!("{line} --approach=-0.01 --path-load 0.02,0.02,-0.01,-0.01 --json"));
    assert_eq!(column(&held, "mean_pressure"), pressure);
}

/// What an elastic solve says of its grid is said of every state of every drive, and `--strict` refuses it.
#[test]
fn a_grid_that_is_too_coarse_warns_in_every_drive() {
    let folder = Folder::new();
    const COARSE: &str = "--indenter sphere --radius 1 --points 32,32 --size 4,4";
    const LINE: &str = "--indenter cylinder --radius 1 --points 64 --size 4";
    for (drive, surface, motion) in [
        ("elastic", COARSE, "--modulus 1 --force 0.02"),
        ("loads", COARSE, "--modulus 1 --force 0.01,0.02"),
        ("creep", COARSE, "--modulus 1 --force 0.01 --creep 1,1 --path-time 0,1 --path-steps 2"),
        ("slip", COARSE, "--modulus 1 --force 0.02 --friction 0.3 --path-tangential 0.001,0.002"),
        ("sliding", COARSE, "--modulus 1 --force 0.02 --creep 1,0.01 --speed 0.1,1"),
        ("rolling", LINE, "--modulus 1 --force 0.002 --friction 0.3 --rolling 0.0002"),
        (
            "adhesion",
            COARSE,
            "--modulus 1 --adhesion 1e-3 --adhesion-range 0.05 --pressure 1e-4 --path-load 1e-4,2e-4 --path-steps 1",
        ),
        ("yield", COARSE, "--young 1 --poisson 0.3 --yield-stress 0.05 --hardening-modulus 0.01 --force 0.02"),
    ] {
        let line = format!("solve {surface} {motion}");
        let output = folder.run(&format!("{line} --json"));
        let told = text(&output.stderr);
        assert!(output.status.success() && told.contains("on this grid"), "{drive}: {told}");
        let found: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert!(found["warnings"].to_string().contains("on this grid"), "{drive}");
        let strict = folder.run(&format!("{line} --strict"));
        assert_eq!(strict.status.code(), Some(2), "{drive}: {}", text(&strict.stderr));
    }
}

/// What an archive keeps of a contact on a layer holds when it is read again, whatever drives it.
#[test]
fn saved_contacts_on_layers_hold() {
    let folder = Folder::new();
    let line =
        "solve --indenter sine --amplitude 0.01 --points 64 --size 1 --young 1 --poisson 0.3 --layer 0.2 --base bonded";
    for motion in ["--adhesion 7e-5 --adhesion-range 0.004", "--creep 4,1 --path-time 2", "--creep 4,1 --speed 0.1"] {
        for load in ["--pressure 0.002", "--approach 0.004", "--mean-gap 0.008"] {
            let solved = folder.run(&format!("{line} {motion} {load} --out states.npz"));
            assert!(solved.status.success(), "{motion} {load}: {}", text(&solved.stderr));
            let read = folder.run("patches --setup-of states.npz");
            assert!(read.status.success(), "{motion} {load}: {}", text(&read.stderr));
            std::fs::remove_file(folder.join("states.npz")).unwrap();
        }
    }
}
