//! The curves of an earlier solve, in grey beside those of a later one.

use super::palette::{self, colour};
use super::traces::{CERTIFICATE, KAPPA_R, RELATIVE_AREA, Series};
use crate::contact::{Contact, Observer, Step};
use rerun::{RecordingStream, RecordingStreamResult, SeriesLines};
use std::ops::ControlFlow;

/// Its entities under `ghost`, named as those under `trace`, and the names of their curves.
const SERIES: [(&str, &str); 3] = [KAPPA_R, RELATIVE_AREA, CERTIFICATE];

/// The curves of `kappa_r`, relative area and certificate of a solve, and of a line its final pressure, kept for later
/// recordings: see [`super::Options`].
///
/// It observes the solve; [`Ghost::close`] adds what is known only at its end.
#[derive(Debug, Clone)]
pub struct Ghost {
    name: String,
    series: [Series; 3],
    /// Final pressure along a line.
    pressure: Option<Vec<f64>>,
}

impl Ghost {
    /// No steps yet. The `name` tells its curves from others.
    pub fn new(name: &str) -> Self {
        Self { name: name.into(), series: Default::default(), pressure: None }
    }

    /// Adds the certificate of the final state and, of a line, its pressure.
    pub fn close(&mut self, contact: &Contact) {
        self.series[2].add(contact.work, Some(contact.certificate.eta.log10()));
        let is_line = contact.pressure.nrows() == 1;
        self.pressure = is_line.then(|| contact.pressure.iter().copied().collect());
    }

    /// The final pressure along a line.
    pub(super) fn pressure(&self) -> Option<&[f64]> {
        self.pressure.as_deref()
    }

    /// Records all of it under `root`, each value at its own step.
    pub(super) fn log(&self, to: &RecordingStream, root: &str) -> RecordingStreamResult<()> {
        for ((entity, name), series) in SERIES.into_iter().zip(&self.series) {
            let entity = entity_under(root, entity);
            let style = SeriesLines::new().with_names([format!("{}: {name}", self.name)]);
            to.log_static(entity.as_str(), &style.with_colors([colour(palette::GHOST)]).with_widths([1.8]))?;
            series.log(to, &entity.into())?;
        }
        Ok(())
    }
}

/// The entity of the ghost that belongs to that of the same name under `trace`.
pub fn entity_under(root: &str, name: &str) -> String {
    format!("{root}/ghost/{name}")
}

impl Observer for Ghost {
    fn step(&mut self, step: &Step<'_>) -> ControlFlow<()> {
        let measures = step.measures();
        let certificate = step.certificate().map(f64::log10);
        let values = [Some(measures.kappa_r), Some(measures.relative_area), certificate];
        for (series, value) in self.series.iter_mut().zip(values) {
            series.add(step.work(), value);
        }
        ControlFlow::Continue(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{chunks, cylinder, rows, scene};
    use super::super::{Options, Recording};
    use super::*;
    use crate::contact::{Gfmd, PolonskyKeer, Solver, Stop};
    use crate::{Grid, Indenter, Problem};
    use std::path::Path;
    use std::sync::Arc;

    /// Records a quick solve beside `ghost`, and returns its steps.
    fn record(path: &Path, ghost: Option<Arc<Ghost>>) -> usize {
        let problem = cylinder();
        let options = Options { ghost, ..Options::default() };
        let recording = Recording::create(path, &[scene("cylinder", &problem)], options).unwrap();
        let mut recorder = recording.recorder(0);
        let contact = PolonskyKeer.solve(&problem, &Stop::default(), &mut recorder).unwrap();
        recorder.close(&contact).unwrap();
        recording.finish().unwrap();
        contact.work.iterations
    }

    /// Whether the recording draws the pressure of an earlier solve.
    fn draws_pressure(path: &Path) -> bool {
        let mut file = std::fs::File::open(path).unwrap();
        let stores = rerun::ChunkStore::from_rrd_reader(&rerun::ChunkStoreConfig::ALL_DISABLED, &mut file).unwrap();
        let mut chunks = stores.values().flat_map(|store| store.iter_physical_chunks());
        chunks.any(|chunk| chunk.entity_path().to_string() == "/cylinder/pressure/curves/ghost")
    }

    #[test]
    fn the_earlier_curves_stand_at_their_own_steps() {
        let mut ghost = Ghost::new("slow");
        let finer = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(96, 4.0).unwrap()).unwrap();
        let finer = Problem::new(finer, 1.0, 1e-2).unwrap();
        let contact = Gfmd::default().solve(&finer, &Stop::default(), &mut ghost).unwrap();
        ghost.close(&contact);
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("two.rrd");
        let (steps, earlier) = (record(&path, Some(Arc::new(ghost))), contact.work.iterations);
        assert!(earlier > steps);
        let rows = rows(&path);
        assert_eq!(rows["/cylinder/ghost/kappa_r"], earlier + 1);
        assert_eq!(rows["/cylinder/trace/kappa_r"], steps + 1);
        let last = |entity: &str| {
            let of_entity = chunks(&path).into_iter().filter(|chunk| chunk.entity_path().to_string() == entity);
            of_entity.map(|chunk| chunk.timelines()[&"step".into()].time_range().max().as_i64()).max()
        };
        assert_eq!(last("/cylinder/ghost/certificate"), Some(earlier as i64));
        assert_eq!(last("/cylinder/trace/certificate"), Some(steps as i64));
        assert!(draws_pressure(&path));
    }

    #[test]
    fn nothing_of_an_earlier_solve_is_recorded_without_one() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("one.rrd");
        record(&path, None);
        assert!(!rows(&path).keys().any(|entity| entity.contains("ghost")));
        assert!(!draws_pressure(&path));
    }
}
