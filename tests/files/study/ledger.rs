//! A study that is solved in pieces elsewhere: the same table, whatever comes back in whatever order.

use asperity::error::StudyError;
use asperity::study::{Campaign, Ledger, Plan, Point, Shard, Table};

const STUDY: &str = "
surface = { spectrum = { hurst = [0.3, 0.8], rolloff-wavelength = 0.125, short-cutoff = 0.02, rms-gradient = 0.1 }, seed = '1-5' }
grid = { points = [[256], [4096]], size = 1.0 }
load = { reduced-pressure = [0.01, 0.1] }
";

fn plan() -> Plan {
    Plan::from_toml(STUDY).unwrap()
}

/// The points of a realisation as they come from another machine: through lines of text.
fn sent(plan: &Plan, realisation: usize) -> Vec<Point> {
    Point::from_lines(Point::to_lines(&plan.solve(realisation, |_| ()).unwrap()).as_bytes())
}

#[test]
fn batches_hold_what_is_missing_once_and_the_longest_come_first() {
    let mut ledger = Ledger::new(plan(), None).unwrap();
    for known in [7, 12] {
        ledger.enter(vec![(known, sent(&plan(), known))]).unwrap();
    }
    assert_eq!(ledger.known(), 4);
    for workers in [0, 1, 4, 1000] {
        let batches = ledger.batches(workers).unwrap();
        let mut all: Vec<usize> = batches.iter().flat_map(|it| it.realisations.clone()).collect();
        all.sort_unstable();
        assert_eq!(all, (0..20).filter(|it| ![7, 12].contains(it)).collect::<Vec<_>>());
        assert!(batches.iter().all(|it| it.realisations.len() <= 5 && it.expense.bytes > 0.0));
        assert!(batches.is_sorted_by(|a, b| a.expense.seconds >= b.expense.seconds));
        // 4096 nodes before 256
        assert!((5..10).contains(&batches[0].realisations[0]) || batches[0].realisations[0] >= 15);
    }
}

#[test]
fn what_comes_in_any_order_is_the_study_of_one_machine_to_the_last_bit() {
    let (plan, folder) = (plan(), tempfile::tempdir().unwrap());
    let table = |name: &str| Table::new(folder.path().join(name));
    let alone = Campaign { shard: Shard::WHOLE, workers: 1, memory: None };
    plan.run(&alone, &table("whole.csv"), &|_| ()).unwrap();
    let mut ledger = Ledger::new(plan.clone(), Some(table("pieces.csv"))).unwrap();
    for i in [19, 13, 6] {
        ledger.enter((i..20.min(i + 7)).rev().map(|i| (i, sent(&plan, i))).collect()).unwrap();
    }
    assert!(matches!(ledger.finish(), Err(StudyError::Missing { rows: 12, first: 1, of: 40, .. })));
    // begun again, it knows what came before; as long as the first one is there, the table is its own
    let again = |i: usize| {
        let mut ledger = Ledger::new(plan.clone(), Some(table("pieces.csv")))?;
        ledger.enter(vec![(i, sent(&plan, i))])
    };
    let refused = again(0).unwrap_err().to_string();
    assert!(refused.contains("pieces.unfinished: another run fills it"), "{refused}");
    drop(ledger);
    let mut ledger = Ledger::new(plan.clone(), Some(table("pieces.csv"))).unwrap();
    let missing: Vec<usize> = ledger.batches(1).unwrap().into_iter().flat_map(|it| it.realisations).collect();
    assert_eq!((ledger.known(), missing.len()), (28, 6));
    ledger.enter(missing.into_iter().map(|i| (i, sent(&plan, i))).collect()).unwrap();
    ledger.finish().unwrap();
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    assert!(read("pieces.csv") == read("whole.csv"));
}

#[test]
fn points_of_something_else_are_refused() {
    let plan = plan();
    let mut ledger = Ledger::new(plan.clone(), None).unwrap();
    let (right, other) = (sent(&plan, 3), sent(&plan, 4));
    let newer: Vec<Point> = right.iter().map(|point| Point { version: "99.0.0".into(), ..point.clone() }).collect();
    let twice = [right.clone(), right.clone()].concat();
    for wrong in [other, newer, twice, right[..1].to_vec(), Vec::new()] {
        let entered = ledger.enter(vec![(2, sent(&plan, 2)), (3, wrong)]);
        assert!(matches!(entered, Err(StudyError::OtherPoints { .. })));
    }
    assert_eq!(ledger.known(), 0);
    assert!(matches!(ledger.enter(vec![(20, right.clone())]), Err(StudyError::NoRow { number: 41, rows: 40 })));
    ledger.enter(vec![(3, right)]).unwrap();
}
