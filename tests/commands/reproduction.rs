//! `asperity paper`, run for real on small grids.

use crate::command::{Folder, text};
use crate::rows::{Row, assert_refused, rows};
use asperity::paper::{Effort, Evidence, Fit, Item, Paper, Verdict, Weights};
use asperity::theory::persson::CorrectedArea;
use std::fs;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Three Hurst exponents, many profiles: seconds of work.
const LINES: &str = "paper fig2 --line-points 16384 --line-cutoff 0.03125 --line-seeds 1-24 --loads 0.02,0.1";

fn number(row: &Row, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column} is {:?} in {row:?}", row[column]))
}

/// Options that leave recordings out, where there are any.
fn bare(line: &str) -> String {
    if cfg!(feature = "record") { format!("{line} --no-record") } else { line.into() }
}

#[test]
fn every_number_of_the_paper_is_compared() {
    let folder = Folder::new();
    let output = folder.run(&bare("paper --quick --out p"));
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let printed: Vec<Row> =
        csv::Reader::from_reader(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/paper.csv")).as_bytes())
            .deserialize()
            .map(Result::unwrap)
            .collect();
    let compared = rows(&folder, "p/comparison.csv");
    for row in &printed {
        assert!(!row["place"].is_empty() && !row["printed"].is_empty(), "{row:?}");
        let is_it = |found: &&Row| found["quantity"].starts_with(&row["quantity"]) && found["place"] == row["place"];
        let found = compared.iter().find(is_it).unwrap_or_else(|| panic!("{row:?} is compared with nothing"));
        assert!(
            !found["here"].is_empty() && !found["here"].contains("NaN") && !found["verdict"].is_empty(),
            "{found:?}"
        );
    }
    let stdout = text(&output.stdout);
    assert!(stdout.starts_with("--quick: coarse grids, short spectra and few loads."), "{stdout}");
    assert!(compared.iter().all(|row| stdout.contains(&row["quantity"])), "{stdout}");
    for part in ["fig1", "fig2", "fig3", "fig4", "fig5", "gw", "beyond", "hurst", "persson", "nayak"] {
        for ending in ["csv", "svg", "png"] {
            assert!(fs::metadata(folder.join(&format!("p/{part}.{ending}"))).unwrap().len() > 500, "{part}.{ending}");
        }
    }
    for part in ["table1", "fig1", "fig2", "fig4", "beyond", "hurst", "nayak"] {
        let points = rows(&folder, &format!("p/{part}.csv"));
        assert!(points.iter().all(|row| row["status"] == "converged" && number(row, "certificate") <= 1e-8), "{part}");
    }
    assert!(!stdout.contains("not converged"), "{stdout}");
}

#[test]
fn smooth_indenters_give_the_printed_numbers() {
    let folder = Folder::new();
    let items = [Item::Table1, Item::Fig1, Item::Gw, Item::Beyond];
    let comparison = Paper::new(folder.join("p"), Effort::Quick).run(&items, &|_| ()).unwrap();
    for named in ["cylinder", "sphere", "heights", "|x|^n", "sine"] {
        let mut verdicts = comparison.verdicts.iter().filter(|verdict| verdict.quantity.contains(named)).peekable();
        let is_close = |verdict: &Verdict| verdict.is_good() || verdict.sigma.is_some_and(|sigma| sigma.abs() < 1.0);
        assert!(verdicts.peek().is_some() && verdicts.all(is_close), "{named}: {comparison:?}");
    }
}

#[test]
fn a_run_of_some_parts_keeps_the_verdicts_on_the_others() {
    let folder = Folder::new();
    let run = |part: &str| {
        let output = folder.run(&bare(&format!("paper {part} --quick --out p")));
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        (text(&output.stdout).contains("exponential heights"), rows(&folder, "p/comparison.csv"))
    };
    let (_, alone) = run("gw");
    let (is_told, both) = run("beyond fig1");
    assert!(!is_told && both.len() > alone.len());
    assert!(alone.iter().all(|row| both.contains(row)), "{both:?}");
    let mut parts: Vec<&str> = both.iter().map(|row| row["part"].as_str()).collect();
    parts.dedup();
    assert_eq!(parts, ["fig1", "gw", "beyond"]);
    assert_eq!(run("gw"), (true, both));
}

#[test]
fn like_is_held_against_like_and_what_follows_is_not_counted() {
    let folder = Folder::new();
    let comparison = Paper::new(folder.join("p"), Effort::Quick).run(&[Item::Fig2, Item::Fig5], &|_| ()).unwrap();
    for verdict in &comparison.verdicts {
        let is_other = verdict.quantity.ends_with("resolved");
        assert_eq!(is_other, verdict.evidence == Evidence::Beside, "{verdict:?}");
        assert_eq!(verdict.item == Item::Fig5 && !is_other, verdict.evidence == Evidence::Follows, "{verdict:?}");
    }
    // ten profiles of the paper scatter, too: its error is more than that of a rounded digit
    let of_lines = comparison.verdicts.iter().find(|verdict| verdict.quantity == "rough lines: κ_r, counted").unwrap();
    assert!(of_lines.paper_error.unwrap() > 1.2 * 0.005 / 3f64.sqrt(), "{of_lines:?}");
    let mut text = Vec::new();
    comparison.write_text(&mut text).unwrap();
    let text = String::from_utf8(text).unwrap();
    let own = comparison.verdicts.iter().filter(|verdict| verdict.evidence == Evidence::Own).count();
    assert!(text.contains(&format!("of {own} agree or hold")), "{text}");
}

#[test]
fn three_grids_foretell_the_next_finer_one() {
    let folder = Folder::new();
    let paper = |points: &[usize], folder: &str| {
        let mut paper = Paper::new(folder, Effort::Quick);
        paper.surfaces.points = points.to_vec();
        paper.surfaces.seeds = vec![vec![1, 2, 3, 4]];
        paper.surfaces.hurst = vec![0.8];
        paper.surfaces.loads = vec![0.1];
        // the grid that the paper's points per wave belong to, of a spectrum so short that it can be solved on
        paper.surfaces.cutoff = 0.25;
        paper.run(&[Item::Fig4], &|_| ()).unwrap();
    };
    let found = |name: &str, column: &str, of: &dyn Fn(&Row) -> bool| {
        rows(&folder, name).iter().find(|row| of(row)).map(|row| number(row, column)).unwrap()
    };
    let [coarse, fine] = ["coarse", "fine"].map(|name| folder.join(name));
    paper(&[64, 128, 256], coarse.to_str().unwrap());
    paper(&[1024], fine.to_str().unwrap());
    let foretold =
        found("coarse/fig4.limits.csv", "kappa_r", &|row| row["nx"] == "1024" && row["measure"] == "counted");
    let direct = found("fine/fig4.means.csv", "kappa_r_counted", &|row| row["nx"] == "1024");
    let finest = found("coarse/fig4.means.csv", "kappa_r_counted", &|row| row["nx"] == "256");
    assert!((foretold - direct).abs() < 0.2 * (finest - direct).abs(), "{foretold} {direct} {finest}");
}

#[test]
fn kappa_of_lines_falls_with_load_and_hurst_exponent_and_kappa_r_hardly_moves() {
    let folder = Folder::new();
    let output = folder.run(&bare(&format!("{LINES} --out p")));
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let means = rows(&folder, "p/fig2.means.csv");
    assert_eq!(means.len(), 6);
    for pair in means.windows(2).filter(|pair| pair[0]["hurst"] == pair[1]["hurst"]) {
        assert!(number(&pair[0], "kappa") > 1.02 * number(&pair[1], "kappa"), "{pair:?}");
    }
    for i in 0..4 {
        assert!(number(&means[i], "kappa") > 1.02 * number(&means[i + 2], "kappa"), "{:?}", means[i]);
    }
    for mean in &means {
        assert_eq!(mean["realisations"], "24");
        assert!((number(mean, "kappa_r") / 1.71 - 1.0).abs() < 0.03, "{mean:?}");
    }
}

#[test]
fn kappa_falls_with_the_breadth_of_the_spectrum_and_kappa_r_does_not() {
    let folder = Folder::new();
    let output = folder.run(&bare("paper nayak --quick --out p"));
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let trends = rows(&folder, "p/nayak.trends.csv");
    let found = |name: &str, quantity: &str, hurst: &str| {
        let is_it = |row: &&Row| {
            [&row["name"], &row["quantity"], &row["hurst"]] == [name, quantity, hurst]
                && row["change"] == "per decade"
                && row["reduced_pressure"] == "0.1"
        };
        let row = trends.iter().find(is_it).unwrap();
        [number(row, "percent"), number(row, "error").hypot(number(row, "grid_error"))]
    };
    for name in ["line", "surface"] {
        let [fall, error] = found(name, "kappa", "0.3");
        assert!(fall < -3.0 && fall < -2.0 * error, "{name}: {fall} {error}");
        let [fall_r, _] = found(name, "kappa_r", "0.3");
        assert!(fall_r.abs() < 0.5 * fall.abs(), "{name}: {fall_r} {fall}");
    }
    // a second run solves nothing
    let again = folder.run(&bare("paper nayak --quick --out p"));
    assert!(!text(&again.stdout).contains("points solved"), "{}", text(&again.stdout));
    let limits = rows(&folder, "p/nayak.limits.csv");
    for row in &limits {
        assert!((number(row, "nayak") / number(row, "nayak_of_spectrum") - 1.0).abs() < 0.15, "{row:?}");
    }
}

#[test]
fn a_killed_run_goes_on_where_it_was_and_ends_in_the_same_bytes() {
    let folder = Folder::new();
    let line = bare(&format!("{LINES} --out killed"));
    let mut child = Command::new(env!("CARGO_BIN_EXE_asperity"))
        .args(line.split_whitespace())
        .current_dir(folder.join(""))
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let unfinished = folder.join("killed/fig2.unfinished");
    let begun = Instant::now();
    while fs::metadata(&unfinished).map_or(0, |metadata| metadata.len()) == 0 {
        assert!(begun.elapsed() < Duration::from_secs(60) && child.try_wait().unwrap().is_none(), "nothing to kill");
        sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(!folder.join("killed/fig2.csv").exists());
    let kept = fs::read_to_string(&unfinished).unwrap().lines().count();
    let output = folder.run(&line);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let told = format!("fig2: {} of 144 points solved", 144 - kept / 2 * 2);
    assert!(text(&output.stdout).contains(&told), "{told}: {}", text(&output.stdout));
    folder.run(&bare(&format!("{LINES} --workers 1 --out undisturbed")));
    let [killed, undisturbed] =
        ["killed", "undisturbed"].map(|run| fs::read(folder.join(&format!("{run}/fig2.csv"))).unwrap());
    assert!(killed == undisturbed && !unfinished.exists());
}

#[test]
fn what_cannot_be_is_refused_before_anything_is_solved() {
    let folder = Folder::new();
    fs::write(folder.join("file"), "").unwrap();
    let cases: [(&str, &[&str]); 10] = [
        ("--out file", &["cannot write file: it is a file"]),
        ("--out missing/p", &["missing"]),
        ("--hurst 2", &["Hurst exponent is 2"]),
        ("--loads 0.1,-1", &["reduced pressure is -1"]),
        ("--line-seeds 5-3", &["5-3 is not a range of seeds"]),
        ("--line-seeds a", &["\"a\" is not a seed"]),
        ("--line-points 64", &["too short for the grid"]),
        ("--line-cutoff 0", &["short_cutoff is 0"]),
        ("--workers 0", &["--workers", "positive"]),
        ("--tolerance 0", &["tolerance is 0"]),
    ];
    for (options, words) in cases {
        assert_refused(&folder.run(&format!("paper gw fig2 --quick {options}")), words);
    }
    assert_refused(&folder.run("paper fig4 --quick --surface-points 512,256"), &["[512, 256]", "ascending"]);
    assert_refused(&folder.run("paper fig4 --surface-points 4194304"), &["4194304 x 4194304 points", "memory"]);
    let mut no_seeds = Paper::new(folder.join("paper"), Effort::Quick);
    no_seeds.lines.seeds = Vec::new();
    let refused = no_seeds.run(&[Item::Fig2], &|_| ()).unwrap_err().to_string();
    assert!(refused.contains("seeds"), "{refused}");
    assert!(!folder.join("paper").exists());
    fs::create_dir(folder.join("other")).unwrap();
    fs::write(folder.join("other/comparison.csv"), "a,b\n1,2\n").unwrap();
    assert_refused(
        &folder.run("paper gw --quick --out other"),
        &["comparison.csv", "it is not a comparison with the paper"],
    );
    assert_eq!(fs::read_to_string(folder.join("other/comparison.csv")).unwrap(), "a,b\n1,2\n");
}

#[test]
fn the_points_of_another_study_stay() {
    let folder = Folder::new();
    let study = |options: &str| folder.run(&bare(&format!("paper fig2 --quick --out p {options}")));
    assert_eq!(study("--line-seeds 1").status.code(), Some(0));
    let there = fs::read(folder.join("p/fig2.csv")).unwrap();
    assert_refused(&study("--hurst 0.3"), &["fig2.csv holds 12 rows of another study"]);
    assert_eq!(fs::read(folder.join("p/fig2.csv")).unwrap(), there);
    let output = study("--line-seeds 1-2");
    assert!(text(&output.stdout).contains("fig2: 12 of 24 points solved"), "{}", text(&output.stdout));
    assert_eq!(study("--hurst 0.3 --fresh").status.code(), Some(0));
    assert!(rows(&folder, "p/fig2.csv").iter().all(|row| row["hurst"] == "0.3"));
}

#[test]
fn a_scattered_curve_is_fitted_within_its_scatter() {
    let lines = CorrectedArea { b1: 0.55, b2: 2.3 };
    let loads = (0..40).map(|i| 10f64.powf(-2.5 + 0.05 * f64::from(i)));
    let scatter = |i: usize| if i.is_multiple_of(2) { 1.01 } else { 0.99 };
    let points: Vec<_> = loads.enumerate().map(|(i, p)| (p, lines.relative_area(p) * scatter(i))).collect();
    for weights in Weights::ALL {
        let fit = Fit::new(&points, weights).unwrap();
        assert!((fit.area.b1 - 0.55).abs() < 0.01 && (fit.area.b2 - 2.3).abs() < 0.3, "{fit:?}");
        assert!((fit.residual - 0.01).abs() < 2e-3, "{fit:?}");
    }
}

#[test]
fn relative_weights_follow_light_loads_and_equal_ones_heavy_loads() {
    // kappa falls by half, which no fit of the form follows all the way
    let points: Vec<_> =
        (0..13).map(|i| 10f64.powf(-3.0 + f64::from(i) / 6.0)).map(|p| (p, p * 3.5 * p.powf(-0.1))).collect();
    let [equal, relative] = Weights::ALL.map(|weights| Fit::new(&points, weights).unwrap());
    let off = |fit: &Fit, (p, a): (f64, f64)| (fit.area.relative_area(p) / a - 1.0).abs();
    assert!(off(&relative, points[0]) < off(&equal, points[0]) && off(&equal, points[12]) < off(&relative, points[12]));
    assert!(relative.residual < equal.residual);
}

#[test]
fn one_load_does_not_tell_two_numbers() {
    assert_eq!(Fit::new(&[(0.1, 0.2), (0.1, 0.21)], Weights::Equal), None);
    assert_eq!(Fit::new(&[], Weights::Equal), None);
    assert!((Fit::proportional(&[(1e-6, 2.2e-6)]).unwrap().area.kappa(0.0) - 2.2).abs() < 1e-6);
}

/// The values of a curve over the timeline `load`.
#[cfg(feature = "record")]
fn loads(path: &std::path::Path, named: &str) -> Vec<i64> {
    let mut file = fs::File::open(path).unwrap();
    let stores = rerun::ChunkStore::from_rrd_reader(&rerun::ChunkStoreConfig::ALL_DISABLED, &mut file).unwrap();
    let recordings = stores.iter().filter(|(id, _)| id.kind() == rerun::StoreKind::Recording);
    let chunks = recordings.flat_map(|(_, store)| store.iter_physical_chunks()).filter(|chunk| !chunk.is_static());
    let of = chunks.filter(|chunk| chunk.entity_path().to_string().contains(named));
    let times = of.flat_map(|chunk| chunk.timelines()[&"load".into()].times_raw().to_vec());
    times.collect::<std::collections::BTreeSet<i64>>().into_iter().collect()
}

#[cfg(feature = "record")]
#[test]
fn recordings_hold_the_contacts_of_one_profile_under_all_loads() {
    let folder = Folder::new();
    let output = folder.run("paper fig2 fig3 gw --quick --hurst 0.5 --out p");
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    for named in ["/curve", "/profile/solid", "/pressure"] {
        assert_eq!(loads(&folder.join("p/fig2.rrd"), named), [1, 2, 3, 4], "{named}");
    }
    assert_eq!(loads(&folder.join("p/fig3.rrd"), "/curve"), [1, 2, 3, 4]);
    assert!(loads(&folder.join("p/fig3.rrd"), "/profile").is_empty());
    assert_eq!(loads(&folder.join("p/gw.rrd"), "/curve").len(), 11);
}
