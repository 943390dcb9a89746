//! Sweeps and their tables: the same numbers however they are solved, stopped and gone on with.

mod ledger;
mod plan;

use asperity::Stop;
use asperity::contact::{Dynamics, Gfmd, Load, Masses};
use asperity::error::StudyError;
use asperity::files::read_columns;
use asperity::setup::{Cell as Size, Method, Recipe, Setup, Solid};
use asperity::study::{NUMERICS, Point, Realisation, Sweep, Table, first_changed_row};
use asperity::surface::{Indenter, Spectrum};
use std::cell::Cell;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;

fn line(hurst: f64, seed: u64, loads: &[f64]) -> Realisation {
    let spectrum = Spectrum { hurst, rolloff_wavelength: 0.125, short_cutoff: 0.004, rms_gradient: 1e-3 };
    let setup = Setup::new(Recipe::rough(spectrum, seed), Size::line(2048, 1.0), Load::ReducedPressure(1.0));
    Realisation { name: "rough line".into(), setup, loads: Realisation::reduced_pressures(loads) }
}

fn sweep(workers: usize) -> Sweep {
    let loads = [0.003, 0.004, 0.02, 0.1];
    let realisations = (1..=3).flat_map(|seed| [0.3, 0.8].map(|hurst| line(hurst, seed, &loads))).collect();
    Sweep { realisations, workers, memory: None }
}

/// The sweep with each of its setups changed.
fn changed(sweep: &Sweep, change: impl Fn(&mut Setup)) -> Sweep {
    let mut sweep = sweep.clone();
    sweep.realisations.iter_mut().for_each(|realisation| change(&mut realisation.setup));
    sweep
}

/// The bytes of the finished table of a fresh run.
fn table_of(sweep: &Sweep, path: &Path) -> Vec<u8> {
    sweep.run(&Table::new(path), &|_| ()).unwrap();
    fs::read(path).unwrap()
}

fn paths(folder: &Path, name: &str) -> [PathBuf; 2] {
    ["csv", "unfinished"].map(|ending| folder.join(format!("{name}.{ending}")))
}

#[test]
fn a_table_is_the_same_to_the_last_bit_for_any_number_of_workers() {
    let folder = tempfile::tempdir().unwrap();
    let alone = table_of(&sweep(1), &folder.path().join("alone.csv"));
    let together = table_of(&sweep(5), &folder.path().join("together.csv"));
    assert!(alone.len() > 1000 && alone == together);
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert_eq!(one_thread.install(|| table_of(&sweep(1), &folder.path().join("thread.csv"))), alone);
}

#[test]
fn contacts_are_seen_in_order_whoever_solves_them() {
    let folder = tempfile::tempdir().unwrap();
    let points = sweep(1).run(&Table::new(folder.path().join("x.csv")), &|_| ()).unwrap();
    let seen = sweep(3).map(&|point, contact| (point.observables, contact.pressure.sum())).unwrap();
    assert_eq!(seen.iter().map(Vec::len).collect::<Vec<_>>(), [4; 6]);
    for (point, (observables, load)) in points.iter().zip(seen.into_iter().flatten()) {
        // as texts, since numbers that are not known are no numbers
        assert_eq!(format!("{:?}", point.observables), format!("{observables:?}"));
        assert!((load / 2048.0 / point.observables.mean_pressure - 1.0).abs() < 1e-12);
    }
}

#[test]
fn what_a_killed_run_left_is_kept_and_the_rest_added() {
    let folder = tempfile::tempdir().unwrap();
    let [whole, _] = paths(folder.path(), "whole");
    let expected = table_of(&sweep(1), &whole);
    for cut in [0, 1, 57, 900, 1800, usize::MAX] {
        let [path, unfinished] = paths(folder.path(), &format!("cut{cut}"));
        let table = Table::new(&path);
        let points = sweep(1).run(&Table::new(&whole), &|_| ()).unwrap();
        table.append(&points[8..16]).unwrap();
        let left = fs::read(&unfinished).unwrap();
        fs::write(&unfinished, &left[..cut.min(left.len())]).unwrap();
        let solved = Mutex::new(Vec::new());
        sweep(2).run(&table, &|point: &Point| solved.lock().unwrap().push(point.seed)).unwrap();
        let solved = solved.into_inner().unwrap().len();
        assert_eq!(fs::read(&path).unwrap(), expected, "cut at {cut}");
        assert!(!unfinished.exists());
        match cut {
            0..=57 => assert_eq!(solved, 24),
            usize::MAX => assert_eq!(solved, 16),
            _ => assert!(solved == 24 || solved == 20, "cut at {cut}: {solved}"),
        }
    }
}

/// Changes one digit of the text, the first 1 to 8 from a place on, to the next.
fn one_digit_changed(text: &[u8], from: usize) -> Vec<u8> {
    let place = from + text[from..].iter().position(|byte| (b'1'..b'9').contains(byte)).unwrap();
    let mut changed = text.to_vec();
    changed[place] += 1;
    changed
}

#[test]
fn rows_that_were_changed_after_they_were_written_are_solved_again() {
    let folder = tempfile::tempdir().unwrap();
    let [whole, _] = paths(folder.path(), "whole");
    let expected = table_of(&sweep(2), &whole);
    let points = sweep(1).run(&Table::new(&whole), &|_| ()).unwrap();
    let head = expected.iter().position(|&byte| byte == b'\n').unwrap();
    let [path, unfinished] = paths(folder.path(), "changed");
    let table = Table::new(&path);
    for place in (0..28).map(|n| n * 211) {
        table.clear().unwrap();
        table.append(&points).unwrap();
        let left = fs::read(&unfinished).unwrap();
        fs::write(&unfinished, one_digit_changed(&left, place % (left.len() - 40))).unwrap();
        sweep(2).run(&table, &|_| ()).unwrap();
        assert_eq!(fs::read(&path).unwrap(), expected, "{place} of the unfinished table");
        fs::write(&path, one_digit_changed(&expected, head + place % (expected.len() - head - 40))).unwrap();
        let solved = Mutex::new(0);
        sweep(2).run(&table, &|_| *solved.lock().unwrap() += 1).unwrap();
        assert_eq!(
            (fs::read(&path).unwrap() == expected, solved.into_inner().unwrap()),
            (true, 4),
            "{place} of the table"
        );
    }
}

/// A table that was changed is not drawn as if it was as it was written; what is left of it without its check sums is.
#[test]
fn a_row_that_was_changed_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let [path, _] = paths(folder.path(), "drawn");
    let whole = table_of(&sweep(2), &path);
    assert_eq!(first_changed_row(&read_columns(&path).unwrap()), None);
    let second_row = whole.iter().enumerate().filter(|(_, byte)| **byte == b'\n').nth(1).unwrap().0;
    fs::write(&path, one_digit_changed(&whole, second_row + 40)).unwrap();
    let columns = read_columns(&path).unwrap();
    assert_eq!(first_changed_row(&columns), Some(3), "the row of names is the first one");
    assert_eq!(first_changed_row(&columns[..columns.len() - 1]), None);
    let plot = ["plot", "drawn.csv", "--y", "relative_area", "--out", "o.svg"];
    let output = Command::new(env!("CARGO_BIN_EXE_asperity")).args(plot).current_dir(folder.path()).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(
        said.starts_with("error: row 3 of drawn.csv is not as it was written") && !folder.path().join("o.svg").exists()
    );
}

#[test]
fn a_finished_table_is_not_solved_again_and_grows_by_what_is_new() {
    let folder = tempfile::tempdir().unwrap();
    let [path, _] = paths(folder.path(), "x");
    let first = Sweep { realisations: sweep(1).realisations[..2].to_vec(), ..sweep(1) };
    first.run(&Table::new(&path), &|_| ()).unwrap();
    let solved = Mutex::new(Cell::new(0));
    let count = |_: &Point| {
        let solved = solved.lock().unwrap();
        solved.set(solved.get() + 1);
    };
    first.run(&Table::new(&path), &count).unwrap();
    assert_eq!(solved.lock().unwrap().get(), 0);
    sweep(1).run(&Table::new(&path), &count).unwrap();
    assert_eq!(solved.lock().unwrap().get(), 16);
    let seconds = fs::read_to_string(folder.path().join("x.seconds.csv")).unwrap();
    assert_eq!(seconds.lines().count(), 25);
    assert!(seconds.lines().skip(1).all(|line| line.rsplit(',').next().unwrap().parse::<f64>().unwrap() > 0.0));
}

/// The words of a table in which two names of columns have changed places.
fn swapped_names(table: &str, one: &str, other: &str) -> String {
    let (head, rows) = table.split_once('\n').unwrap();
    let swapped = |name| {
        if name == one {
            other
        } else if name == other {
            one
        } else {
            name
        }
    };
    format!("{}\n{rows}", head.split(',').map(swapped).collect::<Vec<_>>().join(","))
}

#[test]
fn numbers_under_names_that_were_swapped_are_solved_again() {
    let folder = tempfile::tempdir().unwrap();
    let [path, _] = paths(folder.path(), "named");
    let (table, expected) = (Table::new(&path), String::from_utf8(table_of(&sweep(2), &path)).unwrap());
    for (one, other) in [("kappa", "kappa_r"), ("relative_area", "mean_gap")] {
        fs::write(&path, swapped_names(&expected, one, other)).unwrap();
        assert_eq!(table.read().unwrap().len(), 0);
        sweep(2).run(&table, &|_| ()).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), expected);
    }
}

/// A table whose check sums cover the fields alone, as tables had them before.
fn with_older_check_sums(table: &str) -> String {
    let fnv = |line: &str| {
        line.bytes()
            .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
    };
    let (head, rows) = table.split_once('\n').unwrap();
    let older = |row: &str| {
        let (fields, _) = row.rsplit_once(',').unwrap();
        format!("{fields},{:016x}\n", fnv(&format!("{fields}\n")))
    };
    format!("{head}\n{}", rows.lines().map(older).collect::<String>())
}

#[test]
fn tables_with_older_check_sums_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let [path, _] = paths(folder.path(), "older");
    let (table, now) = (Table::new(&path), String::from_utf8(table_of(&sweep(2), &path)).unwrap());
    let older = with_older_check_sums(&now);
    fs::write(&path, &older).unwrap();
    let points = table.read().unwrap();
    assert_eq!(points.len(), sweep(1).points());
    fs::write(&path, one_digit_changed(older.as_bytes(), older.find('\n').unwrap())).unwrap();
    assert_eq!(table.read().unwrap().len(), points.len() - 1);
}

/// Rows of another revision of the numerics are not mixed with those of this one.
#[test]
fn points_of_another_revision_are_those_of_another_study() {
    let folder = tempfile::tempdir().unwrap();
    let [path, _] = paths(folder.path(), "revision");
    let (table, first) = (Table::new(&path), Sweep { realisations: sweep(1).realisations[..1].to_vec(), ..sweep(1) });
    let points = first.run(&table, &|_| ()).unwrap();
    assert!(points.iter().all(|it| it.version.ends_with(&format!("+numerics.{NUMERICS}"))), "{}", points[0].version);
    let before = points.into_iter().map(|point| Point { version: "0.1.0".into(), ..point }).collect::<Vec<_>>();
    table.finish(&before).unwrap();
    assert!(matches!(first.run(&table, &|_| ()), Err(StudyError::OtherStudy { points: 4, .. })));
}

#[test]
fn the_points_of_another_study_are_not_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let [path, unfinished] = paths(folder.path(), "x");
    let table = Table::new(&path);
    let first = Sweep { realisations: sweep(1).realisations[..2].to_vec(), ..sweep(1) };
    let points = first.run(&table, &|_| ()).unwrap();
    let there = fs::read(&path).unwrap();
    let others = [
        Sweep { realisations: sweep(1).realisations[1..].to_vec(), ..sweep(1) },
        changed(&first, |setup| setup.stop = Stop::new(1e-9, 100).unwrap()),
        Sweep { realisations: vec![line(0.3, 1, &[0.003, 0.004])], ..sweep(1) },
    ];
    for other in others {
        let refused = other.run(&table, &|_| ()).unwrap_err();
        assert!(matches!(refused, StudyError::OtherStudy { points: 2.., .. }), "{refused}");
        assert_eq!(fs::read(&path).unwrap(), there);
    }
    table.clear().unwrap();
    assert!(!path.exists());
    table.append(&points).unwrap();
    let other = Sweep { realisations: vec![line(0.3, 9, &[0.003])], ..sweep(1) };
    assert!(matches!(other.run(&table, &|_| ()), Err(StudyError::OtherStudy { points: 8, .. })));
    assert!(unfinished.exists());
    fs::write(&path, "a,b\n1,2\n").unwrap();
    let refused = first.run(&table, &|_| ()).unwrap_err().to_string();
    assert!(refused.contains("it is not a table of a study"), "{refused}");
    assert_eq!(fs::read(&path).unwrap(), b"a,b\n1,2\n");
}

#[test]
fn files_of_others_beside_a_table_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let [path, unfinished] = paths(folder.path(), "x");
    let (seconds, table) = (folder.path().join("x.seconds.csv"), Table::new(&path));
    let points = sweep(1).run(&Table::new(folder.path().join("other.csv")), &|_| ()).unwrap();
    for (name, content) in [(&unfinished, "my notes\n1,2\n"), (&seconds, "my notes\n"), (&path, "my notes\n")] {
        fs::write(name, content).unwrap();
        for refused in [sweep(1).run(&table, &|_| ()).map(drop), table.read().map(drop).map_err(StudyError::from)] {
            assert!(refused.unwrap_err().to_string().contains("it is not a table of a study"), "{content}");
        }
        assert_eq!(fs::read_to_string(name).unwrap(), content);
        fs::remove_file(name).unwrap();
    }
    // a link is not followed, and the unfinished table of another process is left alone
    #[cfg(unix)]
    {
        fs::write(folder.path().join("precious"), "").unwrap();
        std::os::unix::fs::symlink("precious", &unfinished).unwrap();
        assert!(table.append(&points).unwrap_err().to_string().contains("it is not a table of a study"));
        assert_eq!(fs::read(folder.path().join("precious")).unwrap(), b"");
        fs::remove_file(&unfinished).unwrap();
    }
    table.append(&points[..8]).unwrap();
    let other = Table::new(&path);
    let refused = [other.append(&points[8..]), other.clear()].map(|it| it.unwrap_err().to_string());
    assert!(refused.iter().all(|it| it.contains("another run fills it")), "{refused:?}");
    assert_eq!(Table::new(&path).read().unwrap().len(), 8);
    drop((table, other));
    assert_eq!(table_of(&sweep(1), &path), fs::read(folder.path().join("other.csv")).unwrap());
    assert!(!unfinished.exists());
}

const ROUGHNESS: Spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.5, short_cutoff: 0.25, rms_gradient: 1e-2 };

/// A small surface of an indenter with roughness.
fn rough_sphere() -> Setup {
    let sphere = Recipe::indenter(Indenter::Sphere { radius: 1.0 });
    let recipe = Recipe { spectrum: Some(ROUGHNESS.into()), seed: Some(1), ..sphere };
    Setup::new(recipe, Size::surface([16, 16], [1.0, 1.0]), Load::ReducedPressure(0.1))
}

/// The points of one setup that a table holds for another.
fn points_for(other: &Setup, solved: &Setup, folder: &Path) -> usize {
    let sweep = |setup: &Setup| Sweep {
        realisations: vec![Realisation {
            name: "one name".into(),
            setup: setup.clone(),
            loads: Realisation::reduced_pressures(&[0.1, 0.2]),
        }],
        workers: 1,
        memory: None,
    };
    let table = Table::new(folder.join("x.csv"));
    sweep(solved).run(&table, &|_| ()).unwrap();
    let found = sweep(other).points_in(&table).unwrap();
    assert_eq!(sweep(other).check_table(&table).is_ok(), found == 2);
    table.clear().unwrap();
    found
}

#[test]
fn old_points_do_not_come_back_for_another_setup_of_the_same_name() {
    type Change = fn(&mut Setup);
    fn vary(setup: &mut Setup, change: fn(&mut Spectrum)) {
        let mut spectrum = ROUGHNESS;
        change(&mut spectrum);
        setup.surface.spectrum = Some(spectrum.into());
    }
    let folder = tempfile::tempdir().unwrap();
    let changes: [Change; 14] = [
        |it| it.surface.indenter = Some(Indenter::Sphere { radius: 1.0 + f64::EPSILON }),
        |it| it.surface.indenter = Some(Indenter::Cone { slope: 1.0 }),
        |it| it.surface.indenter = None,
        |it| vary(it, |spectrum| spectrum.hurst = 0.7),
        |it| vary(it, |spectrum| spectrum.rolloff_wavelength = 0.6),
        |it| vary(it, |spectrum| spectrum.short_cutoff = 0.3),
        |it| vary(it, |spectrum| spectrum.rms_gradient = 2e-2),
        |it| it.surface.seed = Some(2),
        |it| it.grid.size = vec![1.0, 2.0],
        |it| it.grid.size = vec![2.0, 1.0],
        |it| it.grid.points = vec![16, 32],
        |it| it.solid = Some(Solid::ContactModulus(2.0)),
        |it| it.solver = Method::PolonskyKeer {},
        |it| it.stop = Stop::new(1e-9, 100_000).unwrap(),
    ];
    let solved = rough_sphere();
    let changed = |solved: &Setup, change: &dyn Fn(&mut Setup)| {
        let mut other = solved.clone();
        change(&mut other);
        points_for(&other, solved, folder.path())
    };
    for (i, change) in changes.iter().enumerate() {
        assert_eq!(changed(&solved, change), 0, "change {i}");
    }
    assert_eq!(changed(&solved, &|it| it.stop = Stop::new(1e-8, 99_999).unwrap()), 0);
    let by_dynamics = Setup { solver: Method::Gfmd(Gfmd::default()), ..solved.clone() };
    let settings = [
        Gfmd { masses: Masses::Stiffness, ..Gfmd::default() },
        Gfmd { dynamics: Dynamics::Fire, ..Gfmd::default() },
        Gfmd { time_step: 0.4, ..Gfmd::default() },
        Gfmd { damping: 0.9, ..Gfmd::default() },
    ];
    for gfmd in settings {
        assert_eq!(changed(&by_dynamics, &|it| it.solver = Method::Gfmd(gfmd)), 0, "{gfmd:?}");
    }
    assert_eq!(changed(&solved, &|it| it.load = Load::MeanPressure(3.0)), 2);
    assert_eq!(changed(&solved, &|it| it.record.every = Some(7)), 2);
}

#[test]
fn a_height_file_is_known_by_its_heights() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, scale: f64| {
        let path = folder.path().join(name);
        let heights = ndarray::Array1::from_shape_fn(32, |i| scale * (i as f64).sin());
        asperity::formats::write_heights(&path, heights.view().into_dyn()).unwrap();
        let surface = Recipe { height: Some(path.into()), ..Recipe::default() };
        Setup::new(
            surface,
            Size { points: vec![], size: vec![1.0], refine: None, boundary: vec![], datum: None },
            Load::ReducedPressure(0.1),
        )
    };
    let [solved, moved, other] = [write("a.npy", 1.0), write("b.npy", 1.0), write("c.npy", 2.0)];
    assert_eq!(points_for(&moved, &solved, folder.path()), 2);
    assert_eq!(points_for(&other, &solved, folder.path()), 0);
}

#[test]
fn what_does_not_converge_is_kept_and_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let hasty = changed(&sweep(1), |setup| setup.stop = Stop::new(1e-12, 2).unwrap());
    let points = hasty.run(&Table::new(folder.path().join("x.csv")), &|_| ()).unwrap();
    assert_eq!(points.len(), 24);
    assert!(points.iter().all(|point| !point.is_converged() && point.observables.certificate > 1e-12));
}

#[test]
fn surfaces_and_loads_that_cannot_be_are_refused_before_anything_is_solved() {
    let folder = tempfile::tempdir().unwrap();
    let table = Table::new(folder.path().join("x.csv"));
    let fails = |realisation: Realisation| {
        let sweep = Sweep { realisations: vec![line(0.5, 1, &[0.1]), realisation], ..sweep(1) };
        sweep.run(&table, &|point| panic!("solved {point:?}")).unwrap_err().to_string()
    };
    assert!(fails(line(1.5, 1, &[0.1])).contains("Hurst exponent is 1.5"));
    assert!(fails(line(0.5, 1, &[0.1, -1.0])).contains("reduced pressure is -1.0"));
    assert!(fails(line(0.5, 1, &[f64::NAN])).contains("reduced pressure is NaN"));
    let sphere = Recipe::indenter(Indenter::Sphere { radius: 1.0 });
    let mut on_a_line = line(0.5, 1, &[0.1]);
    on_a_line.setup.surface = sphere;
    assert!(fails(on_a_line).contains("needs a surface"));
    assert!(!table.path().exists());
}
