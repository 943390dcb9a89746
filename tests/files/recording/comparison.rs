//! Comparisons of recordings, read back from their files.

use super::{record, rough_line, rough_surface, rows, shown_paths, stores, trace};
use asperity::contact::{Gfmd, Load, Multilevel, PolonskyKeer, Solver};
use asperity::error::{FileError, InputError};
use asperity::record::{Options, Recording, Scene, compare};
use asperity::setup::{Cell, Method, Part, Recipe, Setup};
use asperity::surface::Spectrum;
use asperity::{Indenter, Stop};
use rerun::{SeriesLines, StoreKind};
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

/// Records the solve of a setup.
fn record_setup(path: &Path, setup: &Setup) {
    let problem = setup.problem().unwrap();
    let recording = Recording::create(path, &[Scene::from_setup(setup, &problem)], Options::default()).unwrap();
    setup.solver.solver().solve(&problem, &Stop::default(), &mut recording.recorder(0)).unwrap();
    recording.finish().unwrap();
}

fn names(path: &Path, entities: &[&str]) -> Vec<String> {
    let name = |entity: &&str| rows::<rerun::components::Name>(path, entity, SeriesLines::descriptor_names());
    entities.iter().map(|entity| name(entity)[0].1[0].to_string()).collect()
}

#[test]
fn traces_lie_over_each_other_under_names_that_tell_the_runs_apart() {
    let folder = tempfile::tempdir().unwrap();
    let [fast, slow, both] = ["fast.rrd", "slow.rrd", "both.rrd"].map(|name| folder.path().join(name));
    let sine = Recipe::indenter(Indenter::Sine { amplitude: 0.01 });
    let setup = Setup::new(sine, Cell::line(64, 1.0), Load::ReducedPressure(0.1));
    record_setup(&fast, &setup);
    record_setup(&slow, &Setup { solver: Method::Gfmd(Gfmd::default()), ..setup });
    compare(&[&fast, &slow], &both).unwrap();
    for name in ["kappa_r", "relative_area", "certificate_log10", "patches"] {
        let curves = [format!("/compare/{name}/01"), format!("/compare/{name}/02")];
        assert_eq!(names(&both, &[&curves[0], &curves[1]]), ["multilevel", "gfmd"]);
        for (path, curve) in [&fast, &slow].into_iter().zip(&curves) {
            let own = trace(path, &format!("/contact/trace/{name}"), "transforms");
            assert!(own.len() > 1 && trace(&both, curve, "transforms") == own, "{name}");
        }
    }
    assert_eq!(names(&both, &["/compare/kappa_r/exact_01"]), ["exact"]);
    let entities: BTreeSet<String> = super::entities(&both);
    assert!(!entities.contains("/compare/kappa_r/exact_02"), "it is the same for both");
    let shown = shown_paths(&both);
    for entity in
        ["/compare/kappa_r/02", "/recording_2/contact/profile/**", "/recording_1/contact/trace/kappa_r_counted"]
    {
        assert!(shown.contains(entity), "{entity} is not among {shown:?}");
    }
    assert!(entities.contains("/recording_2/contact/profile/solid"));
    let layouts = [&fast, &both].map(|path| stores(path, StoreKind::Blueprint).remove(0).id().application_id().clone());
    assert_ne!(layouts[0], layouts[1]);
}

/// A recording from before, when `relative_area` was that of counted nodes, is compared by the resolved values.
#[test]
fn curves_of_an_earlier_recording_are_found_under_their_earlier_names() {
    let folder = tempfile::tempdir().unwrap();
    let [earlier, now, both] = ["earlier.rrd", "now.rrd", "both.rrd"].map(|name| folder.path().join(name));
    let stream = rerun::RecordingStreamBuilder::new("asperity").save(&earlier).unwrap();
    for (name, value) in [("relative_area_resolved", 0.25), ("relative_area", 0.5), ("patches", 3.0)] {
        stream.set_time_sequence("transforms", 1);
        stream.log(format!("contact/trace/{name}"), &rerun::Scalars::single(value)).unwrap();
    }
    drop(stream);
    record(&now, &rough_line(), &PolonskyKeer, None, None);
    compare(&[&earlier, &now], &both).unwrap();
    for (name, value) in [("relative_area", 0.25), ("relative_area_counted", 0.5), ("patches", 3.0)] {
        assert_eq!(
            trace(&both, &format!("/compare/{name}/01"), "transforms").into_values().last(),
            Some(value),
            "{name}"
        );
        assert!(!trace(&both, &format!("/compare/{name}/02"), "transforms").is_empty(), "{name}");
    }
}

#[test]
fn runs_without_setups_are_named_by_their_files() {
    let folder = tempfile::tempdir().unwrap();
    let [one, other, both] = ["one.rrd", "other.rrd", "both.rrd"].map(|name| folder.path().join(name));
    record(&one, &rough_line(), &PolonskyKeer, None, None);
    record(&other, &rough_surface(), &Multilevel as &dyn Solver, None, None);
    compare(&[&one, &other], &both).unwrap();
    let names = names(&both, &["/compare/kappa_r/01", "/compare/kappa_r/02"]);
    assert_eq!(names, ["one", "other"]);
}

#[test]
fn runs_that_differ_in_much_are_named_by_their_files_and_the_text_says_in_what() {
    let folder = tempfile::tempdir().unwrap();
    let [smooth, rough, both] = ["smooth.rrd", "rough.rrd", "both.rrd"].map(|name| folder.path().join(name));
    let setup = |recipe| Setup::new(recipe, Cell::line(256, 1.0), Load::ReducedPressure(0.1));
    record_setup(&smooth, &setup(Recipe::indenter(Indenter::Sine { amplitude: 0.01 })));
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 0.1, rms_gradient: 0.01 };
    record_setup(&rough, &setup(Recipe::rough(spectrum, 5)));
    compare(&[&smooth, &rough], &both).unwrap();
    assert_eq!(names(&both, &["/compare/kappa_r/01", "/compare/kappa_r/02"]), ["smooth", "rough"]);
    let texts = rows::<rerun::components::Text>(&both, "/compare/runs", rerun::TextDocument::descriptor_text());
    let text = texts[0].1[0].as_str();
    let differs = "| hurst 0.8, rolloff 0.25, short-cutoff 0.1, rms-gradient 0.01, seed 5 |";
    assert!(text.contains(differs) && text.contains("| sine |"), "{text}");
}

#[test]
fn what_cannot_be_compared_is_refused_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let [good, silent, both] = ["good.rrd", "silent.rrd", "both.rrd"].map(|name| folder.path().join(name));
    record(&good, &rough_line(), &PolonskyKeer, None, None);
    let what = [Part::Mask].into_iter().collect();
    super::record_with(&silent, &rough_line(), &PolonskyKeer, None, Options { what, ..Options::default() });
    let text = folder.path().join("text.rrd");
    std::fs::write(&text, "no recording").unwrap();
    for useless in [&silent, &text] {
        let failure = compare(&[&good, useless], &both).unwrap_err();
        assert!(matches!(&failure, FileError::Incomparable { path, .. } if path == useless), "{failure}");
        assert!(failure.is_input() && !both.exists());
    }
    assert!(matches!(compare(&[good, folder.path().join("none.rrd")], &both), Err(FileError::Read { .. })));
}

/// Lists of loads and histories are compared by the names of their curves, and not with each other.
#[test]
fn curves_over_loads_and_states_lie_over_each_other() {
    let folder = tempfile::tempdir().unwrap();
    let run = |line: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
        let output = command.current_dir(folder.path()).args(line.split(' ')).output().unwrap();
        (output.status.code(), String::from_utf8([output.stdout, output.stderr].concat()).unwrap())
    };
    let surface = "--size 1 --points 128 --hurst 0.8 --rolloff 0.5 --short-cutoff 0.1 --rms-gradient 0.1";
    let creep = "--reduced-pressure 0.1 --creep 1,1 --path-time 0,1 --path-steps 3";
    for (name, rest) in [
        ("a", "--reduced-pressure 0.05,0.1,0.2 --seed 1".to_owned()),
        ("b", "--reduced-pressure 0.05,0.1,0.2 --seed 2".to_owned()),
        ("c", format!("{creep} --seed 1")),
        ("d", format!("{creep} --seed 2")),
    ] {
        let (code, said) = run(&format!("solve {surface} {rest} --record {name}.rrd"));
        assert_eq!(code, Some(0), "{said}");
    }
    for (first, second, timeline) in [("a", "b", "load"), ("c", "d", "step")] {
        let (code, said) = run(&format!("compare {first}.rrd {second}.rrd --out {first}{second}.rrd"));
        assert_eq!(code, Some(0), "{said}");
        let both = folder.path().join(format!("{first}{second}.rrd"));
        for (name, entity) in [(first, "/compare/curve_1/01"), (second, "/compare/curve_1/02")] {
            let own = trace(&folder.path().join(format!("{name}.rrd")), "/curve/0", timeline);
            assert!(own.len() >= 3 && trace(&both, entity, timeline) == own, "{name}: {own:?}");
        }
        assert_ne!(trace(&both, "/compare/curve_1/01", timeline), trace(&both, "/compare/curve_1/02", timeline));
        assert_eq!(names(&both, &["/compare/curve_1/01", "/compare/curve_1/02"])[1], "seed 2");
        assert!(shown_paths(&both).contains("/compare/curve_1/02"));
    }
    let (code, said) = run("compare a.rrd c.rrd");
    assert_eq!(code, Some(2));
    assert!(
        said.contains(
            "c.rrd cannot be compared: it is over the states of a history, and a.rrd is over a list of loads"
        ),
        "{said}"
    );
}

#[test]
fn the_command_compares_two_or_more_and_says_what_it_wrote() {
    let folder = tempfile::tempdir().unwrap();
    record(&folder.path().join("a.rrd"), &rough_line(), &PolonskyKeer, None, None);
    record(&folder.path().join("b.rrd"), &rough_line(), &Gfmd::default(), None, None);
    let run = |line: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
        let output = command.current_dir(folder.path()).args(line.split(' ')).output().unwrap();
        (output.status.code(), String::from_utf8([output.stdout, output.stderr].concat()).unwrap())
    };
    assert_eq!(run("compare a.rrd b.rrd --out c.rrd"), (Some(0), "wrote c.rrd: asperity view c.rrd\n".into()));
    for (line, words) in [
        ("compare a.rrd", "a.rrd is the only recording: give at least two"),
        ("compare a.rrd missing.rrd", "cannot read missing.rrd"),
        (
            "compare a.rrd b.rrd --out ./b.rrd",
            "cannot write ./b.rrd: it is also an input file and would be lost: give another name",
        ),
        ("view --no-open a.rrd missing.rrd", "cannot read missing.rrd"),
    ] {
        let (code, said) = run(line);
        assert!(code == Some(2) && said.contains(words) && said.lines().count() == 1, "{line}: {said}");
    }
}
