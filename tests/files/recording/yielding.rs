//! Recordings of bodies that yield below their surface: the cut below the contact, state by state, live and from a saved result.

use super::chunks;
use asperity::contact::{Quantity, archive_of_states};
use asperity::job::{HistoryOutcome, SavedResult};
use asperity::setup::Setup;
use std::collections::BTreeSet;
use std::path::Path;

fn setup(points: &str) -> Setup {
    let shape = if points.contains(',') { "crossed-sine" } else { "sine" };
    let text = format!(
        "surface.indenter = {{ shape = '{shape}', amplitude = 0.01 }}\ngrid = {{ points = {points}, size = 1 }}\n\
         solid = {{ young = 1, poisson = 0.3, yield-stress = 0.02, hardening-modulus = 0.05 }}\n\
         load.mean-pressure = 0.01\npath = {{ load = [0.01, 0.02, 0.0] }}\n"
    );
    Setup::from_toml(&text).unwrap()
}

/// The steps at which an entity of a recording changes.
fn steps(path: &Path, entity: &str) -> BTreeSet<i64> {
    let chunks = chunks(path);
    let own = chunks.iter().filter(|chunk| chunk.entity_path().to_string() == entity);
    own.flat_map(|chunk| {
        let found = chunk.timelines().iter().find(|(name, _)| name.as_str() == "step");
        found.map(|(_, column)| column.times_raw().to_vec()).unwrap_or_default()
    })
    .collect()
}

#[test]
fn each_state_shows_the_strain_and_the_stress_below_the_contact() {
    let folder = tempfile::tempdir().unwrap();
    for points in ["64", "[16, 16]"] {
        let setup = setup(points);
        let problem = setup.problem().unwrap();
        let outcome = HistoryOutcome::solve(&setup, &problem, &mut ()).unwrap();
        assert!(outcome.values(Quantity::MaxPlasticStrain)[1] > 1e-3);
        let path = folder.path().join("yields.rrd");
        outcome.record(&path, &setup, &problem).unwrap();
        for entity in ["/contact/contact/plastic_strain/image", "/contact/contact/von_mises/image"] {
            assert_eq!(steps(&path, entity), BTreeSet::from([1, 2, 3]), "{points}: {entity}");
        }

        // a saved result has the same cuts, and draws the same recording
        let rank = if points == "64" { 1 } else { 2 };
        let archive = folder.path().join("yields.npz");
        std::fs::write(&archive, archive_of_states(&outcome.states, rank, &setup.to_toml()).unwrap()).unwrap();
        let saved = SavedResult::read(&archive).unwrap();
        assert!(saved.doubts.is_empty(), "{:?}", saved.doubts);
        let again = folder.path().join("again.rrd");
        saved.record(&again).unwrap();
        assert_eq!(steps(&again, "/contact/contact/von_mises/image"), BTreeSet::from([1, 2, 3]));
    }
}
