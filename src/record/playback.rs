//! Recordings read back from their files.

use super::file::VALUE;
use super::setups::{SETUP, is_recording};
use super::stores;
use crate::error::FileError;
use crate::setup::Setup;
use rerun::log::Chunk;
use rerun::{ChunkStore, Scalars, StoreKind, TextDocument};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Name of the entities above the traces, below the roots of the scenes.
const TRACE: &str = "/trace/";

/// A recording in memory.
pub struct Playback {
    pub path: PathBuf,
    /// What is recorded, without properties of the file.
    pub chunks: Vec<Arc<Chunk>>,
    pub blueprint: Option<ChunkStore>,
    /// Application and identity.
    pub name: String,
}

impl Playback {
    /// Reads a recording over steps.
    ///
    /// # Errors
    /// [`FileError::Read`] for a file that is missing, unreadable or damaged, [`FileError::Incomparable`] for one that is no
    /// recording or has no traces.
    pub fn read(path: &Path) -> Result<Self, FileError> {
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
        let is_over_loads = playback.chunks_of(VALUE.into()).next().is_some();
        match playback.roots().is_empty() {
            true if is_over_loads => Err(useless(
                "it shows several loads or the states of a history, but only the steps of single solves are compared: compare their tables",
            )),
            true => Err(useless("it has no curves over steps: record it again with the part `traces`")),
            false => Ok(playback),
        }
    }

    /// The name of its file, without the end.
    pub fn stem(&self) -> String {
        self.path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
    }

    /// The roots of the scenes that have traces.
    pub fn roots(&self) -> BTreeSet<String> {
        let entities = self.chunks.iter().map(|chunk| chunk.entity_path().to_string());
        entities.filter_map(|entity| Some(entity.split_once(TRACE)?.0.to_owned())).collect()
    }

    /// The chunks of the trace `name` of a scene.
    pub fn trace(&self, root: &str, name: &str) -> impl Iterator<Item = &Chunk> {
        let name = if self.has_earlier_names(root) { earlier_name(name) } else { name.to_owned() };
        self.chunks_of(format!("{root}{TRACE}{name}")).filter(|chunk| !chunk.is_static())
    }

    /// Whether a scene was recorded when a plain name meant the value of counted nodes.
    fn has_earlier_names(&self, root: &str) -> bool {
        self.chunks_of(format!("{root}{TRACE}{}", earlier_name("relative_area"))).next().is_some()
    }

    /// The last value of a trace.
    pub fn last(&self, root: &str, name: &str) -> Option<f64> {
        let component = Scalars::descriptor_scalars().component;
        let values = |chunk: &Chunk| {
            let steps = chunk.iter_component_indices("step".into(), component).map(|(step, _)| step);
            steps.zip(chunk.iter_slices::<f64>(component).map(|values| values[0])).collect::<Vec<_>>()
        };
        self.trace(root, name).flat_map(values).max_by_key(|(step, _)| *step).map(|(_, value)| value)
    }

    /// The setup of a scene, if the recording carries it.
    pub fn setup(&self, root: &str) -> Option<Setup> {
        Setup::from_toml(&self.text(format!("{root}/{SETUP}"))?).ok()
    }

    /// The text of an entity.
    pub fn text(&self, entity: String) -> Option<String> {
        let component = TextDocument::descriptor_text().component;
        let texts = self.chunks_of(entity).flat_map(|chunk| chunk.iter_slices::<String>(component).flatten().last());
        texts.last().map(|text| text.to_string())
    }

    fn chunks_of(&self, entity: String) -> impl Iterator<Item = &Chunk> {
        self.chunks.iter().map(Arc::as_ref).filter(move |chunk| chunk.entity_path().to_string() == entity)
    }
}

/// The earlier name of a trace: `relative_area_resolved` for `relative_area`, and `relative_area` for `relative_area_counted`.
fn earlier_name(name: &str) -> String {
    match (name, name.strip_suffix("_counted")) {
        ("relative_area" | "kappa" | "kappa_r", _) => format!("{name}_resolved"),
        (_, Some(plain)) => plain.to_owned(),
        _ => name.to_owned(),
    }
}
