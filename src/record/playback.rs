//! Recordings read back from their files.

use super::draw::LOAD;
use super::file::VALUE;
use super::played::Played;
use super::setups::{SETUP, is_recording};
use super::stores;
use crate::error::FileError;
use crate::setup::SetupTable;
use rerun::log::Chunk;
use rerun::{ChunkStore, Scalars, SeriesLines, StoreKind, TextDocument};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Name of the entities above the traces, below the roots of the scenes.
const TRACE: &str = "/trace/";

/// Beginning of the entities of curves over loads or states.
const CURVE: &str = "/curve/";

/// A recording in memory.
pub(crate) struct Playback {
    pub path: PathBuf,
    /// What is recorded, without properties of the file.
    pub chunks: Vec<Arc<Chunk>>,
    pub blueprint: Option<ChunkStore>,
    /// Application and identity.
    pub name: String,
}

impl Playback {
    /// Reads a recording with curves.
    ///
    /// # Errors
    /// [`FileError::Read`] for a file that is missing, unreadable or damaged, [`FileError::Incomparable`] for one that is no
    /// recording or has no curves.
    pub(crate) fn read(path: &Path) -> Result<Self, FileError> {
        let useless = |reason: &str| FileError::Incomparable { path: path.into(), reason: reason.into() };
        if !is_recording(path)? {
            return Err(useless("it is not a recording: give a file written by `asperity solve --record`"));
        }
        let stores = stores::read(path)?;
        let mut playback = Self { path: path.into(), chunks: Vec::new(), blueprint: None, name: String::new() };
        for (id, store) in stores {
            match id.kind() {
                StoreKind::Blueprint => playback.blueprint = Some(store),
                StoreKind::Recording => {
                    let is_own = |chunk: &&Arc<Chunk>| !chunk.entity_path().to_string().starts_with("/__");
                    playback.chunks.extend(store.iter_physical_chunks().filter(is_own).cloned());
                    playback.name = format!("{}/{}", id.application_id(), id.recording_id());
                }
            }
        }
        let has_curves = match playback.played() {
            Played::Steps => !playback.roots().is_empty(),
            Played::Loads | Played::States => !playback.curves().is_empty(),
        };
        if has_curves { Ok(playback) } else { Err(useless("it has no curves: record it again with the part `traces`")) }
    }

    /// What its curves are over.
    pub(crate) fn played(&self) -> Played {
        let is_over_loads = |chunk: &Chunk| chunk.timelines().keys().any(|timeline| timeline.as_str() == LOAD);
        match self.chunks_of(VALUE.into()).find(|chunk| !chunk.is_static()) {
            Some(chunk) if is_over_loads(chunk) => Played::Loads,
            Some(_) => Played::States,
            None => Played::Steps,
        }
    }

    /// The names of curves over loads or states, and their entities, in their order.
    pub(crate) fn curves(&self) -> Vec<(String, String)> {
        let component = SeriesLines::descriptor_names().component;
        let named = |chunk: &Arc<Chunk>| {
            let entity = chunk.entity_path().to_string();
            entity.strip_prefix(CURVE)?;
            let name = chunk.iter_slices::<String>(component).flatten().next()?.to_string();
            Some((name, entity))
        };
        let mut curves: Vec<(String, String)> = self.chunks.iter().filter_map(named).collect();
        curves.sort_by_key(|(_, entity)| entity[CURVE.len()..].parse().unwrap_or(usize::MAX));
        curves
    }

    /// The name of the quantity along the loads or states, with the unit of its values; and these by the numbers of the loads or states.
    pub(crate) fn axis(&self) -> Option<(String, BTreeMap<i64, f64>)> {
        let component = SeriesLines::descriptor_names().component;
        let mut names = self.chunks_of(VALUE.into()).flat_map(|chunk| chunk.iter_slices::<String>(component).flatten());
        let name = names.next()?.to_string();
        Some((name, self.values(self.chunks_of(VALUE.into()))))
    }

    /// The values of the curve over loads or states that has a name, by the numbers of the loads or states.
    pub(crate) fn curve_values(&self, name: &str) -> BTreeMap<i64, f64> {
        self.values(self.curve(name))
    }

    fn values<'a>(&self, chunks: impl Iterator<Item = &'a Chunk>) -> BTreeMap<i64, f64> {
        let timeline = self.played().timeline();
        chunks.flat_map(|chunk| scalars(chunk, timeline)).collect()
    }

    /// The chunks of the curve over loads or states that has a name.
    pub(crate) fn curve(&self, name: &str) -> impl Iterator<Item = &Chunk> {
        let found = self.curves().into_iter().find(|(its, _)| its == name).map(|(_, entity)| entity);
        found.into_iter().flat_map(|entity| self.chunks_of(entity)).filter(|chunk| !chunk.is_static())
    }

    /// The name of its file, without the end.
    pub(crate) fn stem(&self) -> String {
        self.path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
    }

    /// The roots of the scenes that have traces; of curves over loads or states that of the first setup.
    pub(crate) fn roots(&self) -> BTreeSet<String> {
        let entities = || self.chunks.iter().map(|chunk| chunk.entity_path().to_string());
        if self.played() == Played::Steps {
            return entities().filter_map(|entity| Some(entity.split_once(TRACE)?.0.to_owned())).collect();
        }
        let with_setup =
            entities().filter_map(|entity| Some(entity.strip_suffix(SETUP)?.strip_suffix('/')?.to_owned()));
        [with_setup.min().unwrap_or_default()].into()
    }

    /// The chunks of the trace `name` of a scene.
    pub(crate) fn trace(&self, root: &str, name: &str) -> impl Iterator<Item = &Chunk> {
        let name = if self.has_earlier_names(root) { earlier_name(name) } else { name.to_owned() };
        self.chunks_of(format!("{root}{TRACE}{name}")).filter(|chunk| !chunk.is_static())
    }

    /// Whether a scene was recorded when a plain name meant the value of counted nodes.
    fn has_earlier_names(&self, root: &str) -> bool {
        self.chunks_of(format!("{root}{TRACE}{}", earlier_name("relative_area"))).next().is_some()
    }

    /// The last value of a trace.
    pub(crate) fn last(&self, root: &str, name: &str) -> Option<f64> {
        let values = self.trace(root, name).flat_map(|chunk| scalars(chunk, "step"));
        values.max_by_key(|(step, _)| *step).map(|(_, value)| value)
    }

    /// The setup of a scene, if the recording carries it; that of a list of loads is a table only.
    pub(crate) fn setup(&self, root: &str) -> Option<SetupTable> {
        let text = self.text(format!("{root}/{SETUP}"))?;
        let table = SetupTable::from_toml(&text).ok()?.without_digests();
        Some(table.clone().setup().map(|setup| setup.to_table()).unwrap_or(table))
    }

    /// The text of an entity.
    pub(crate) fn text(&self, entity: String) -> Option<String> {
        let component = TextDocument::descriptor_text().component;
        let texts = self.chunks_of(entity).flat_map(|chunk| chunk.iter_slices::<String>(component).flatten().last());
        texts.last().map(|text| text.to_string())
    }

    fn chunks_of(&self, entity: String) -> impl Iterator<Item = &Chunk> {
        self.chunks.iter().map(Arc::as_ref).filter(move |chunk| chunk.entity_path().to_string() == entity)
    }
}

/// The scalars of a chunk by their places on a timeline. A damaged file may hold rows without a value; these are left out.
fn scalars(chunk: &Chunk, timeline: &'static str) -> Vec<(i64, f64)> {
    let component = Scalars::descriptor_scalars().component;
    let times = chunk.iter_component_indices(timeline.into(), component).map(|(time, _)| time.as_i64());
    let values = chunk.iter_slices::<f64>(component);
    times.zip(values).filter_map(|(time, row)| Some((time, *row.first()?))).collect()
}

/// The earlier name of a trace: `relative_area_resolved` for `relative_area`, and `relative_area` for `relative_area_counted`.
fn earlier_name(name: &str) -> String {
    match (name, name.strip_suffix("_counted")) {
        ("relative_area" | "kappa" | "kappa_r", _) => format!("{name}_resolved"),
        (_, Some(plain)) => plain.to_owned(),
        _ => name.to_owned(),
    }
}
