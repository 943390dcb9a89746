//! Setups with lists: which rows they make, and the same numbers however these are solved.

use asperity::contact::Load;
use asperity::error::StudyError;
use asperity::setup::Setup;
use asperity::study::{Campaign, ColumnValues, Plan, Point, Shard, StudyRow, Table};
use std::sync::Mutex;

const STUDY: &str = "
surface = { spectrum = { hurst = [0.3, 0.8], rolloff-wavelength = 0.125, short-cutoff = 0.02, rms-gradient = 0.1 }, seed = ['1-3', 9] }
grid = { points = [[256], [512]], size = 1.0 }
solid = { young = 2.0, poisson = 0.3, layer = [0.05, 1.0] }
load = { mean-pressure = [0.001, 0.01, 0.002] }
";

const ALONE: Campaign = Campaign { shard: Shard::WHOLE, workers: 1, memory: None };

fn plan() -> Plan {
    Plan::from_toml(STUDY).unwrap()
}

/// The observables as texts, since numbers that are not known are no numbers.
fn words(points: &[Point]) -> Vec<String> {
    points.iter().map(|point| format!("{:?}", (&point.setup, &point.observables))).collect()
}

#[test]
fn rows_run_through_loads_then_seeds_then_the_other_lists() {
    let plan = plan();
    assert_eq!((plan.rows(), plan.realisations(), plan.seeds()), (96, 32, 4));
    assert_eq!(plan.row(5).unwrap(), StudyRow { number: 5, realisation: 1, load: 1 });
    assert_eq!(plan.words(0), "hurst 0.3, points 256, layer 0.05, seed 1");
    assert_eq!(plan.words(3), "hurst 0.3, points 256, layer 0.05, seed 9");
    assert_eq!(plan.words(4), "hurst 0.3, points 256, layer 1.0, seed 1");
    assert_eq!(plan.words(31), "hurst 0.8, points 512, layer 1.0, seed 9");
    let setup = plan.setup(plan.row(96).unwrap()).unwrap();
    assert_eq!((setup.load, setup.grid.points, setup.surface.seed), (Load::MeanPressure(0.002), vec![512], Some(9)));
    assert!([0, 97].iter().all(|&row| matches!(plan.row(row), Err(StudyError::NoRow { rows: 96, .. }))));
    // a plan without lists is one row
    let one = Plan::from_toml(&plan.setup(plan.row(96).unwrap()).unwrap().to_toml()).unwrap();
    assert_eq!((one.rows(), one.words(0)), (1, String::new()));
}

#[test]
fn the_number_of_rows_is_known_before_there_are_any() {
    let study = STUDY.replace("'1-3', 9", "'0-18446744073709551615'");
    let many = Plan::from_toml(&study).unwrap_err();
    assert!(matches!(many, StudyError::TooManyRows { rows, .. } if rows > 1 << 64), "{many}");
    let large = Plan::from_toml(&STUDY.replace("'1-3', 9", "'1-400000'")).unwrap();
    assert_eq!(large.rows(), 9_600_000);
    assert_eq!(large.setup(large.row(9_600_000).unwrap()).unwrap().surface.seed, Some(400_000));
}

#[test]
fn a_share_is_a_part_of_the_whole_of_about_the_same_work() {
    let plan = plan();
    for count in [1, 2, 3, 7, 32, 40] {
        let shards = (1..=count).map(|number| format!("{number}/{count}").parse().unwrap());
        let shares: Vec<Vec<usize>> = shards.map(|shard| plan.share(shard).unwrap()).collect();
        let mut all = shares.concat();
        all.sort_unstable();
        assert_eq!(all, (0..32).collect::<Vec<_>>(), "{count} shares");
        let work = |share: &Vec<usize>| share.iter().map(|i| if i / 8 % 2 == 0 { 256 } else { 512 }).sum::<usize>();
        let (least, most) = (shares.iter().map(work).min().unwrap(), shares.iter().map(work).max().unwrap());
        assert!(most - least <= 512, "{count} shares: {least} to {most}");
    }
}

#[test]
fn however_a_study_is_cut_the_bits_are_the_same() {
    let (plan, folder) = (plan(), tempfile::tempdir().unwrap());
    let table = |name: &str| Table::new(folder.path().join(name));
    let watched = Mutex::new(0);
    let whole = plan.run(&ALONE, &table("whole.csv"), &|_| *watched.lock().unwrap() += 1).unwrap();
    assert_eq!((whole.len(), watched.into_inner().unwrap()), (96, 96));
    // one after the other, as a worker on another machine does it
    let alone: Vec<Point> = (0..32).flat_map(|i| plan.solve(i, |_| ()).unwrap()).collect();
    assert_eq!(words(&alone), words(&whole));
    let shards: Vec<Table> = (1..=3).map(|number| table(&format!("{number}.csv"))).collect();
    for (i, shard) in shards.iter().enumerate() {
        let campaign = Campaign { shard: format!("{}/3", i + 1).parse().unwrap(), workers: 1 + i, memory: Some(300e3) };
        plan.run(&campaign, shard, &|_| ()).unwrap();
    }
    let merged = plan.merge(&shards).unwrap();
    assert_eq!(words(&merged), words(&whole));
    let all: Vec<usize> = (0..32).collect();
    plan.finish(&table("merged.csv"), &all, &merged).unwrap();
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    assert!(read("merged.csv") == read("whole.csv"));
    // a study that is there is not solved again, also from what was merged
    plan.run(&ALONE, &table("merged.csv"), &|point| panic!("solved {point:?}")).unwrap();
    assert!(read("merged.csv") == read("whole.csv"));
    assert!(matches!(plan.merge(&shards[1..]), Err(StudyError::Missing { of: 96, .. })));
    let twice = [shards[0].clone(), shards[1].clone(), shards[2].clone(), shards[0].clone()];
    assert!(matches!(plan.merge(&twice), Err(StudyError::Overlap { .. })));
    // a table with its rows twice
    let body = read("1.csv");
    let (head, rows) = body.split_once('\n').unwrap();
    std::fs::write(folder.path().join("1.csv"), format!("{head}\n{rows}{rows}")).unwrap();
    assert!(matches!(plan.merge(&shards), Err(StudyError::Overlap { path, other, .. }) if path == other));
    // the same setup under other loads is another study: what a load leaves depends on those before
    let other = Plan::from_toml(&STUDY.replace("[0.001, 0.01, 0.002]", "[0.001, 0.01, 0.003]")).unwrap();
    assert!(matches!(other.merge(&shards[1..]), Err(StudyError::OtherShare { .. })));
}

#[test]
fn too_much_memory_is_refused() {
    let (plan, folder) = (plan(), tempfile::tempdir().unwrap());
    let tight = Campaign { memory: Some(1e3), ..ALONE };
    let refused = plan.run(&tight, &Table::new(folder.path().join("x.csv")), &|_| ()).unwrap_err();
    assert!(matches!(refused, StudyError::Memory { memory, .. } if memory == 1e3), "{refused}");
}

#[test]
fn a_tangential_load_is_refused() {
    let refused = Plan::from_toml(&format!("{STUDY}\n[friction]\ncoefficient = 0.5\ntangential = 1e-4\n")).unwrap_err();
    assert!(matches!(refused, StudyError::Friction), "{refused}");
}

#[test]
fn columns_hold_what_varies_and_the_setup_of_each_row() {
    let plan = plan();
    let points = plan.solve(5, |_| ()).unwrap();
    let rows: Vec<StudyRow> = plan.rows_of(&[5]).collect();
    let columns = plan.columns(&rows, &points).unwrap();
    let column = |name: &str| &columns.iter().find(|column| column.name == name).unwrap().values;
    assert_eq!(column("row"), &ColumnValues::Whole([16, 17, 18].map(Some).into()));
    assert_eq!(column("surface.seed"), &ColumnValues::Whole([2; 3].map(Some).into()));
    assert_eq!(column("grid.points"), &ColumnValues::Whole([256; 3].map(Some).into()));
    assert_eq!(column("solid.layer"), &ColumnValues::Number([1.0; 3].map(Some).into()));
    assert_eq!(column("load.mean-pressure"), &ColumnValues::Number([0.001, 0.01, 0.002].map(Some).into()));
    assert_eq!(column("kappa"), &ColumnValues::Number(points.iter().map(|it| Some(it.observables.kappa)).collect()));
    let ColumnValues::Text(scenes) = column("scene") else { panic!("scenes are texts") };
    for (scene, row) in scenes.iter().zip(&rows) {
        assert_eq!(Setup::from_toml(scene).unwrap(), plan.setup(*row).unwrap());
    }
    let names: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
    assert!(names.iter().enumerate().all(|(i, name)| !names[..i].contains(name)), "{names:?}");
}

#[test]
fn lists_of_sections_and_of_height_files_are_lists_too() {
    let folder = tempfile::tempdir().unwrap();
    for (name, height) in [("a.npy", 1.0), ("b.npy", 2.0)] {
        let heights = ndarray::Array1::from_shape_fn(64, |i| height * (i as f64 / 5.0).sin());
        asperity::formats::write_heights(folder.path().join(name), heights.view().into_dyn()).unwrap();
    }
    let path = folder.path().join("study.toml");
    let solvers = "[[solver]]\nmethod = 'multilevel'\n[[solver]]\nmethod = 'gfmd'\ndamping = 0.5\n";
    let study = "surface.height = ['a.npy', 'b.npy']\ngrid.size = 1.0\nload.reduced-pressure = 0.1\n";
    std::fs::write(&path, format!("{study}{solvers}")).unwrap();
    let plan = Plan::read(&path).unwrap();
    assert_eq!(plan.rows(), 4);
    plan.check().unwrap();
    let found: Vec<Point> = (0..4).flat_map(|i| plan.solve(i, |_| ()).unwrap()).collect();
    assert!(found.iter().all(Point::is_converged));
    let area = |i: usize| found[i].observables.relative_area;
    assert!(
        (area(0) / area(1) - 1.0).abs() < 1e-3 && found[0].observables.iterations != found[1].observables.iterations
    );
    assert!(found[0].observables.rms_height * 1.9 < found[2].observables.rms_height);
    std::fs::remove_file(folder.path().join("b.npy")).unwrap();
    assert!(plan.check().unwrap_err().to_string().contains("b.npy"));
}

#[cfg(feature = "parquet")]
#[test]
fn parquet_holds_the_columns() {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::RowAccessor;
    let (plan, folder) = (plan(), tempfile::tempdir().unwrap());
    let path = folder.path().join("study.parquet");
    let share = [3, 5];
    let points: Vec<Point> = share.iter().flat_map(|&i| plan.solve(i, |_| ()).unwrap()).collect();
    plan.write_parquet(&path, &share, &points).unwrap();
    let reader = SerializedFileReader::new(std::fs::File::open(&path).unwrap()).unwrap();
    let rows: Vec<_> = reader.get_row_iter(None).unwrap().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 6);
    let place = |name: &str| rows[0].get_column_iter().position(|(column, _)| column == name).unwrap();
    for (row, point) in rows.iter().zip(&points) {
        assert_eq!(row.get_double(place("kappa_r")).unwrap().to_bits(), point.observables.kappa_r.to_bits());
        assert_eq!(row.get_ulong(place("iterations")).unwrap() as usize, point.observables.iterations);
        assert_eq!(row.get_string(place("status")).unwrap(), "converged");
    }
    let scene = rows[4].get_string(place("scene")).unwrap();
    assert_eq!(Setup::from_toml(scene).unwrap(), plan.setup(plan.row(17).unwrap()).unwrap());
}
