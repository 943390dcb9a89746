//! Bodies that yield below their surface on the command line: loads up and down, their files, and what is refused.

use crate::command::{Folder, text};
use crate::rows::assert_refused;
use ndarray::{Array1, Array2, Array3, Axis};
use ndarray_npy::NpzReader;
use serde_json::Value;
use std::fs::File;

const CYLINDER: &str = "solve --indenter cylinder --radius 10mm --points 128 --size 1mm --young 210GPa --poisson 0.3 --yield-stress 350MPa";
const STEEL: &str = "--hardening-modulus 2GPa";

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
fn loads_up_and_down_leave_an_imprint() {
    let folder = Folder::new();
    let line =
        format!("{CYLINDER} {STEEL} --pressure 20MPa,100MPa --unload --json --out all.npz --save-setup scene.toml");
    let found = json(&folder, &line);
    assert_eq!(found["process"], "plastic");
    assert!(found["claim"].as_str().unwrap().starts_with("the solution of each load step"));
    let pressures = column(&found, "mean_pressure");
    assert!(pressures.iter().zip([20e6, 100e6, 20e6, 0.0]).all(|(p, q)| (p - q).abs() < 1.0), "{pressures:?}");
    let [area, imprint, work, depth, strain] =
        ["relative_area", "imprint_depth", "plastic_work", "deepest_yield", "max_plastic_strain"]
            .map(|name| column(&found, name));
    // the first load is elastic; the second one dents the body, which fits the cylinder better then
    assert!(imprint[0] == 0.0 && work[0] == 0.0 && depth[0] == 0.0 && strain[0] == 0.0);
    assert!(area[2] > 1.1 * area[0], "{area:?}");
    assert!(imprint[1] > 50e-9 && (imprint[3] / imprint[1] - 1.0).abs() < 1e-3, "{imprint:?}");
    assert!(work.windows(2).all(|pair| pair[1] >= pair[0]) && work[1] > 0.0, "{work:?}");
    let over = |state: usize| found["states"][state]["contact_pressure_over_yield"].as_f64();
    // without contact there is no pressure in it
    assert!(over(1).unwrap() > 1.0 && over(3).is_none() && area[3] == 0.0);
    let stored = column(&found, "stored");
    assert!(stored[3] > 0.0 && stored[3] < stored[1]);
    // one long step in which the body flows does not tell the work of the load, but more steps do: it is taken up or stored
    assert!(found["states"][0]["work_done"].is_number() && found["states"][1]["work_done"].is_null());
    let fine = json(&folder, &format!("{CYLINDER} {STEEL} --pressure 20MPa,100MPa --unload --path-steps 8 --json"));
    let [done, taken, stored] = ["work_done", "plastic_work", "stored"].map(|name| column(&fine, name));
    for i in 0..done.len() {
        assert!((done[i] / (taken[i] + stored[i]) - 1.0).abs() <= 0.01, "state {i}: {} {}", done[i], taken[i]);
    }

    let mut archive = NpzReader::new(File::open(folder.join("all.npz")).unwrap()).unwrap();
    let interfaces: Array1<f64> = archive.by_name("cut_interfaces").unwrap();
    let cut: Array3<f64> = archive.by_name("cut_plastic_strain").unwrap();
    let stress: Array3<f64> = archive.by_name("cut_von_mises").unwrap();
    let residual: Array2<f64> = archive.by_name("imprint").unwrap();
    assert_eq!((cut.dim(), stress.dim(), residual.dim()), ((4, interfaces.len() - 1, 128), cut.dim(), (4, 128)));
    // half the cell deep, from half a spacing on
    assert!(interfaces[interfaces.len() - 1] >= 0.5e-3 && (interfaces[1] / (1e-3 / 256.0) - 1.0).abs() < 1e-9);
    let most = cut.iter().copied().fold(0.0, f64::max);
    assert_eq!(most, strain[3], "below a line the cut is all there is");
    // yield begins below the surface
    let last = cut.index_axis(Axis(0), 3);
    let row = |layer: usize| last.row(layer).iter().copied().fold(0.0, f64::max);
    assert!(row(0) < 0.5 * most, "{} {most}", row(0));

    for again in ["solve scene.toml --json", "solve --setup-of all.npz --json"] {
        assert_eq!(json(&folder, again)["states"], found["states"], "{again}");
    }
}

#[test]
fn steps_between_loads_are_states_and_shorten_the_error() {
    let folder = Folder::new();
    let of = |steps: usize| {
        json(&folder, &format!("{CYLINDER} {STEEL} --pressure 100MPa --unload --path-steps {steps} --json"))
    };
    let [few, more, most] = [1, 4, 16].map(of);
    assert_eq!(column(&more, "mean_pressure").len(), 8);
    let imprint = |found: &Value| *column(found, "imprint_depth").last().unwrap();
    let [a, b, c] = [&few, &more, &most].map(imprint);
    assert!((b - c).abs() < 0.6 * (a - c).abs(), "{a:e} {b:e} {c:e}");
}

#[test]
fn an_imprint_is_a_file_of_heights() {
    let folder = Folder::new();
    let found = json(&folder, &format!("{CYLINDER} {STEEL} --pressure 100MPa --unload --json --imprint dent.x3p"));
    let imprint = *column(&found, "imprint_depth").last().unwrap();
    let read = json(&folder, "surface dent.x3p --json");
    assert!(read["points"][0] == 128 && (read["size"][0].as_f64().unwrap() / 1e-3 - 1.0).abs() < 1e-9, "{read}");
    let again = json(&folder, &format!("{CYLINDER} {STEEL} --pressure 100MPa --unload --json --imprint dent.npy"));
    assert_eq!(column(&again, "imprint_depth").last(), Some(&imprint));
    let height: Array1<f64> = ndarray_npy::read_npy(folder.join("dent.npy")).unwrap();
    let deepest = (0..height.len()).min_by(|&i, &j| height[i].total_cmp(&height[j])).unwrap();
    assert!(deepest.abs_diff(64) <= 2, "the dent is below the cylinder, not at {deepest}");
    let ends = height.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], h| [a.min(*h), b.max(*h)]);
    assert!(((ends[1] - ends[0]) / imprint - 1.0).abs() < 1e-12);
}

#[test]
fn what_does_not_go_with_a_yield_stress_is_refused() {
    let folder = Folder::new();
    let steel = format!("{CYLINDER} {STEEL} --pressure 20MPa");
    let bare = "solve --indenter cylinder --radius 10mm --points 128 --size 1mm --pressure 20MPa";
    for (line, words) in [
        (format!("{CYLINDER} --pressure 20MPa"), &["hardening modulus", "millionth"][..]),
        (format!("{bare} --young 210GPa --poisson 0.3 {STEEL}"), &["without a yield stress"]),
        (format!("{bare} --modulus 210GPa --yield-stress 350MPa {STEEL}"), &["Young's modulus", "Poisson's ratio"]),
        (
            format!("{bare} --young 210GPa,70GPa --poisson 0.3,0.3 --yield-stress 350MPa {STEEL}"),
            &["two elastic bodies"],
        ),
        (format!("{steel} --layer 1mm"), &["layer", "half-space"]),
        (format!("{steel} --boundary free"), &["boundary", "waves"]),
        (format!("{steel} --hardness 1GPa"), &["hardness"]),
        (format!("{steel} --adhesion 50mJ/m^2 --adhesion-range 10nm"), &["adhesion"]),
        (format!("{steel} --creep 9,1ms --path-time 1s"), &["creep"]),
        (format!("{steel} --friction 0.3 --tangential 1MPa"), &["friction", "cannot be combined"]),
        (format!("{steel} --friction 0.3 --path-tangential 1MPa"), &["tangential loads of a path and a yield stress"]),
        (format!("{steel} --path-time 1s"), &["time"]),
        (format!("{steel} --solver gfmd"), &["gfmd"]),
        (format!("{steel} --pressure-tolerance 1e-3"), &["no effect"]),
        (format!("{steel} --record-what stress --record x.rrd"), &["stress and fringes"]),
        (format!("{steel} --stress x.npz"), &["--stress"]),
        (format!("{steel} --diagnose"), &["--diagnose"]),
        (format!("{steel} --yield-depth 0"), &["depth at which the layers end"]),
        (format!("{steel} --yield-layers 0"), &["layers"]),
        (format!("{CYLINDER} {STEEL} --approach 1um"), &["approach", "mean pressure", "mean gap"]),
        (format!("{CYLINDER} {STEEL} --mean-gap 1nm"), &["at all depths"]),
        (
            format!("{CYLINDER} --yield-errors {STEEL} --pressure 20MPa").replace(" --yield-stress 350MPa", ""),
            &["without a yield stress"],
        ),
        (format!("{CYLINDER} {STEEL} --pressure 700MPa"), &["700MPa", "at all depths"]),
        (format!("{CYLINDER} {STEEL} --pressure 20MPa,700MPa"), &["700000000", "at all depths"]),
        (format!("{CYLINDER} {STEEL} --reduced-pressure 20"), &["at all depths"]),
        (format!("{CYLINDER} --hardening-modulus=0 --pressure 20MPa"), &["hardening modulus is 0"]),
        (format!("{bare} --young 210GPa --poisson 0.3 --imprint x.npz"), &["--imprint", "--yield-stress"]),
        (format!("{steel} --imprint x.npz"), &[".npy"]),
        (format!("{steel} --yield-layers 10000 --points 100000 --dry-run").replace("--points 128 ", ""), &["memory"]),
    ] {
        let output = folder.run(&line);
        let stderr = text(&output.stderr).to_owned();
        assert_eq!(output.status.code(), Some(2), "{line}: {stderr}");
        assert!(words.iter().all(|word| stderr.contains(word)), "{line}: {stderr}");
        if !line.contains("--dry-run") {
            assert_refused(&output, words);
        }
        assert_eq!(stderr.matches("error: ").count(), 1, "{line}: {stderr}");
    }
    assert!(std::fs::read_dir(folder.join("")).unwrap().next().is_none(), "something was written");
    // commands for bodies that have not yielded before
    let scene = "surface.indenter = { shape = 'cylinder', radius = 1 }\ngrid = { points = 64, size = 1 }\n\
        solid = { young = 1, poisson = 0.3, yield-stress = 0.005, hardening-modulus = 0.05 }\nload.mean-pressure = 1e-3\n";
    std::fs::write(folder.join("steel.toml"), scene).unwrap();
    ndarray_npy::write_npy(folder.join("p.npy"), &Array1::from_elem(64, 1e-3)).unwrap();
    for line in ["certify --setup steel.toml --pressure p.npy", "inspect --setup steel.toml p.npy", "seal steel.toml"] {
        assert_refused(&folder.run(line), &["yield stress", "leave it out"]);
    }
}

#[test]
fn a_plan_tells_the_memory_of_the_layers() {
    let folder = Folder::new();
    let memory = |layers: usize, pressure: &str| {
        let line =
            format!("{CYLINDER} {STEEL} --pressure {pressure} --yield-depth 0.5mm --yield-layers {layers} --dry-run");
        let output = folder.run(&line.replace("--points 128", "--points 65536"));
        assert!(output.status.success(), "{}", text(&output.stderr));
        let told = text(&output.stdout).lines().find(|line| line.contains("memory")).unwrap().to_owned();
        let words: Vec<&str> = told.split_whitespace().collect();
        let unit = if words[3].starts_with("GB") { 1e9 } else { 1e6 };
        words[2].parse::<f64>().unwrap() * unit
    };
    let each = |pressure: &str| (memory(80, pressure) - memory(10, pressure)) / (70.0 * 65536.0);
    // five tensors of four components for each place and the waves, and more where much of it will flow
    let [elastic, flowing] = ["20MPa", "400MPa"].map(each);
    assert!((190.0..240.0).contains(&elastic), "{elastic} bytes");
    assert!(flowing > 1.5 * elastic, "{flowing} bytes");
}

/// The errors by steps, layers and grid are numbers of their own, and more steps make that by the steps smaller.
#[test]
fn errors_are_told_by_their_sources() {
    let folder = Folder::new();
    let line = |steps: usize| format!("{CYLINDER} {STEEL} --pressure 100MPa --path-steps {steps} --yield-errors");
    let [few, many] = [2, 8].map(|steps| json(&folder, &format!("{} --json", line(steps))));
    let last = |found: &Value, name: &str| found["states"].as_array().unwrap().last().unwrap()[name].as_f64().unwrap();
    for name in ["imprint_layer_error", "imprint_grid_error", "relative_area_step_error"] {
        assert!(last(&few, name) >= 0.0, "{name}");
    }
    let [coarse, fine] = [&few, &many].map(|found| last(found, "imprint_step_error"));
    assert!(fine > 0.0 && fine < 0.6 * coarse, "{fine:e} {coarse:e}");
    let plain = json(&folder, &format!("{CYLINDER} {STEEL} --pressure 100MPa --path-steps 2 --json"));
    assert_eq!(last(&plain, "imprint_depth"), last(&few, "imprint_depth"), "estimates change nothing");
    let output = folder.run(&line(2));
    let told = text(&output.stdout);
    assert!(told.contains("largest estimated error of the imprint: ") && told.contains(" by the layers, "), "{told}");
    // the grid of this cylinder is coarse, and nothing else is doubted
    let doubts = text(&output.stderr);
    assert!(doubts.lines().all(|line| line.contains("on this grid")), "{doubts}");
    let doubtful = folder.run(&format!("{CYLINDER} {STEEL} --pressure 100MPa --yield-errors --yield-layers 8"));
    let doubts = text(&doubtful.stderr);
    for doubt in ["from a single step between two loads", "times as thick as the contacts are wide"] {
        assert!(doubts.contains(doubt), "{doubts}");
    }
}

/// Mean gaps are reached, down and up, and a surface that is lifted leaves its imprint.
#[test]
fn mean_gaps_are_loads_too() {
    let folder = Folder::new();
    let found = json(&folder, &format!("{CYLINDER} {STEEL} --mean-gap 4.1um,3.7um,4.1um,5um --json --out all.npz"));
    let [gap, imprint, pressure] = ["mean_gap", "imprint_depth", "mean_pressure"].map(|name| column(&found, name));
    assert!(gap.iter().zip([4.1e-6, 3.7e-6, 4.1e-6, 5e-6]).all(|(a, b)| (a / b - 1.0).abs() < 1e-5), "{gap:?}");
    assert!(pressure[1] > pressure[0] && pressure[2] < pressure[0] && pressure[3] == 0.0, "{pressure:?}");
    assert!(imprint[1] > imprint[0] && (imprint[3] / imprint[1] - 1.0).abs() < 1e-3, "{imprint:?}");
    let unloaded = json(&folder, &format!("{CYLINDER} {STEEL} --mean-gap 4.1um,3.7um --unload --json"));
    assert_eq!(column(&unloaded, "mean_pressure"), pressure[..3], "back to the first gap");
}

/// Layers are added where the body yields down to the last one, unless their depth is given; the cuts of all states stay alike.
#[test]
fn layers_grow_unless_they_are_given() {
    let folder = Folder::new();
    let soft = CYLINDER.replace("350MPa", "100MPa");
    let grown = json(&folder, &format!("{soft} --hardening-modulus 2GPa --pressure 50MPa,120MPa --json --out all.npz"));
    let depth = column(&grown, "deepest_yield");
    assert!(depth[1] > 0.6e-3, "{depth:?}");
    let mut archive = NpzReader::new(File::open(folder.join("all.npz")).unwrap()).unwrap();
    let cut: Array3<f64> = archive.by_name("cut_plastic_strain").unwrap();
    let interfaces: Array1<f64> = archive.by_name("cut_interfaces").unwrap();
    assert_eq!(cut.dim(), (2, interfaces.len() - 1, 128));
    let output = folder.run(&format!("{soft} --hardening-modulus 2GPa --pressure 50MPa,120MPa"));
    assert!(!text(&output.stderr).contains("last layer"), "{}", text(&output.stderr));
    let given = folder.run(&format!("{soft} --hardening-modulus 2GPa --pressure 50MPa,120MPa --yield-depth 0.5mm"));
    assert!(text(&given.stderr).contains("down to the end of the last layer"), "{}", text(&given.stderr));
}

#[test]
fn iterations_are_states_on_the_way_if_they_are_asked_for() {
    let folder = Folder::new();
    let line = format!("{CYLINDER} {STEEL} --pressure 20MPa,100MPa --unload --json");
    let (plain, with) = (json(&folder, &line), json(&folder, &format!("{line} --record-iterations --record all.rrd")));
    assert_eq!(with["claim"], plain["claim"]);
    let (few, many) = (plain["states"].as_array().unwrap(), with["states"].as_array().unwrap());
    assert!(few.len() == 4 && many.len() > 10, "{}", many.len());
    // the ends of the steps are the same to the bit
    let numbers = |state: &Value| {
        let mut numbers = state.as_object().unwrap().clone();
        numbers.remove("state");
        numbers
    };
    let all: Vec<_> = many.iter().map(numbers).collect();
    assert!(few.iter().map(numbers).all(|state| all.contains(&state)));
    // the bound of the distance from the end of a step falls on the way
    let bounds = column(&with, "step_certificate");
    let steps: Vec<&[f64]> = bounds.split_inclusive(|bound| *bound <= 1e-8).collect();
    assert_eq!(steps.len(), 4);
    assert!(steps[1].len() > 5 && steps[1][0] > 1e3 * steps[1][steps[1].len() - 2], "{bounds:?}");
    let refused = folder.run("solve --hurst 0.8 --rolloff 0.125 --short-cutoff 0.02 --rms-gradient 0.1 --points 512 --size 1 --reduced-pressure 0.05 --record-iterations --record x.rrd");
    assert_refused(&refused, &["iterations", "it has an effect only"]);
}

#[test]
fn doubts_about_what_yields_are_told() {
    let folder = Folder::new();
    let warned = |more: &str| {
        let output = folder.run(&format!("{CYLINDER} --pressure 100MPa {more}"));
        assert!(output.status.success(), "{}", text(&output.stderr));
        text(&output.stderr).to_owned()
    };
    let shallow = warned(&format!("{STEEL} --yield-depth 0.1mm"));
    assert!(shallow.contains("--yield-depth") && shallow.contains("last layer"), "{shallow}");
    let deep = warned(STEEL);
    assert!(!deep.contains("last layer") && !deep.contains("ripple"), "{deep}");
    let sharp = "solve --indenter cylinder --radius 0.2mm --points 128 --size 1mm --young 210GPa --poisson 0.3 --yield-stress 350MPa";
    let output =
        folder.run(&format!("{sharp} --hardening-modulus 200MPa --path-steps 8 --path-load 150MPa --pressure 150MPa"));
    let told = text(&output.stderr);
    assert!(told.contains("from node to node") && told.contains("Report sums"), "{told}");
}

/// Above 0.05 E*, the largest pressure is more than metals bear; a yield stress is the law for that, and nothing is told.
#[test]
fn pressures_of_a_solid_that_yields_are_not_doubted() {
    let folder = Folder::new();
    let solid = |stress: &str| {
        format!(
            "surface = {{ indenter = {{ shape = 'sphere', radius = '1 mm' }} }}\ngrid = {{ points = [16, 16], size = '400 um' }}\n\
             load = {{ mean-pressure = ['1 GPa', '2 GPa'] }}\nsolid = {{ young = '210 GPa', poisson = 0.3{stress} }}\n"
        )
    };
    let yields = ", yield-stress = '8 GPa', hardening-modulus = '1 GPa', yield-layers = 4";
    for (stress, is_doubted) in [(yields, false), ("", true)] {
        std::fs::write(folder.join("study.toml"), solid(stress)).unwrap();
        let output = folder.run("study study.toml --fresh");
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        assert_eq!(text(&output.stderr).contains("Metals yield"), is_doubted, "{}", text(&output.stderr));
    }
}

/// In one thick layer the mean stress is so low that nothing flows at any pressure. That is no contact that is fully plastic.
#[test]
fn layers_that_are_too_thick_are_told() {
    let folder = Folder::new();
    let cylinder = "solve --indenter cylinder --radius 1 --points 64 --size 1 --young 1 --poisson .3 --yield-stress .005 \
                    --hardening-modulus .05 --pressure .0015";
    let told = |more: &str| text(&folder.run(&format!("{cylinder} {more}")).stderr).to_owned();
    for layers in [1, 2, 8, 16] {
        let words = told(&format!("--yield-layers {layers}"));
        assert!(
            words.contains("times as thick as the contacts are wide") && !words.contains("fully plastic"),
            "{words}"
        );
    }
    for enough in ["--yield-layers 64", "--yield-depth .5", ""] {
        assert!(!told(enough).contains("times as thick"), "{enough}: {}", told(enough));
    }
}

/// The layers follow the shorter spacing, whichever axis has it: a ball dents alike when the axes are exchanged.
#[test]
fn the_axes_may_be_exchanged() {
    let folder = Folder::new();
    let imprint = |points: &str| {
        let ball = format!(
            "solve --indenter sphere --radius 1 --points {points} --size 1,1 --young 1 --poisson .3 --yield-stress .005 \
             --hardening-modulus .05 --pressure .001 --json"
        );
        column(&json(&folder, &ball), "imprint_depth")[0]
    };
    let [a, b] = ["64,8", "8,64"].map(imprint);
    assert!((a / b - 1.0).abs() < 1e-4, "{a:e} {b:e}");
}

/// Steps before the first load, and states at mean gaps, are read back as what they are.
#[test]
fn saved_states_are_confirmed() {
    let folder = Folder::new();
    let cylinder = "solve --indenter cylinder --radius 1 --points 64 --size 1 --young 1 --poisson .3 --yield-stress .005 --hardening-modulus .05";
    for path in [
        "--pressure .001,.002 --path-steps 2",
        "--pressure .001,.002 --path-steps 3 --unload",
        "--mean-gap .04,.039",
        "--mean-gap .039,.038,.0395,.05 --path-steps 2",
    ] {
        assert!(folder.run(&format!("{cylinder} {path} --out r.npz")).status.success(), "{path}");
        let read = folder.run("patches r.npz");
        assert_eq!(read.status.code(), Some(0), "{path}: {}", text(&read.stderr));
        assert!(!text(&read.stderr).contains("does not hold"), "{path}: {}", text(&read.stderr));
    }
}

/// A map of the imprint after the last state, as deep as it is told.
#[test]
fn an_imprint_is_drawn_as_a_map() {
    let folder = Folder::new();
    let ball = "solve --indenter sphere --radius 10mm --points 32,32 --size 1mm --young 210GPa --poisson 0.3 --yield-stress 350MPa";
    assert!(folder.run(&format!("{ball} {STEEL} --force 16N,64N --unload --out ball.npz")).status.success());
    let drawn = folder.run("plot ball.npz --map imprint --out imprint.svg");
    assert!(drawn.status.success() && folder.join("imprint.svg").exists(), "{}", text(&drawn.stderr));
    assert_refused(&folder.run("plot ball.npz --map gap --out gap.svg"), &["no maps"]);
}

#[test]
fn words_about_layers_and_loads_are_right() {
    let folder = Folder::new();
    let steel = format!("{CYLINDER} {STEEL}");
    for (line, words) in [
        (format!("{steel} --pressure 20MPa --yield-layers 20000"), &["20000 layers"][..]),
        (format!("{steel} --pressure 20MPa,0"), &["--unload", "--path-load"]),
        (format!("{steel} --pressure 20MPa,0MPa"), &["--unload"]),
    ] {
        assert_refused(&folder.run(&line), words);
    }
}

#[test]
fn a_study_has_a_row_for_each_yield_stress() {
    let folder = Folder::new();
    let scene = "surface.indenter = { shape = 'cylinder', radius = '10 mm' }\ngrid = { points = 128, size = '1 mm' }\n\
        solid = { young = '210 GPa', poisson = 0.3, yield-stress = ['350 MPa', '700 MPa'], hardening-modulus = '2 GPa' }\n\
        load.mean-pressure = '100 MPa'\npath.load = [100e6, 0]\n";
    std::fs::write(folder.join("study.toml"), scene).unwrap();
    let output = folder.run("study study.toml --out rows.csv");
    assert!(output.status.success(), "{}", text(&output.stderr));
    let rows = crate::rows::rows(&folder, "rows.csv");
    let imprint: Vec<f64> = rows.iter().map(|row| row["imprint_depth"].parse().unwrap()).collect();
    assert!(imprint.len() == 2 && imprint[0] > 10.0 * imprint[1], "{imprint:?}");
    // bodies that end unloaded are told by what they keep
    let told = text(&output.stdout);
    assert!(told.contains("plastic work") && told.contains(&format!("{:.3e}", imprint[0])), "{told}");
    let figure = std::fs::read_to_string(folder.join("rows.svg")).unwrap();
    assert!(figure.contains("depth of the imprint") && figure.contains("plastic work"));
    // a row takes about a tenth of a second of one core; the forecast was a hundred times too small
    let plan = folder.run("study study.toml --dry-run");
    assert!(text(&plan.stdout).contains("each a history of about 2 states"), "{}", text(&plan.stdout));
}
