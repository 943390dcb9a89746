//! Layouts read back from recordings, for entities that have moved to another root.

use crate::record::draw::{ContainerKind, Pane, PaneView};
use rerun::external::re_sdk_types::blueprint::{archetypes as panes, components};
use rerun::log::Chunk;
use rerun::{AsComponents, ChunkStore, Component, ComponentDescriptor, SerializedComponentBatch};
use std::sync::Arc;

/// The panes of the layout in `blueprint`, if it is whole, for entities that are now under `root`.
pub(crate) fn copy(blueprint: &ChunkStore, root: &str) -> Option<Pane> {
    let copy = Copy { blueprint, root };
    let viewport =
        copy.first::<components::RootContainer>("/viewport", panes::ViewportBlueprint::descriptor_root_container());
    copy.pane(&format!("container/{}", viewport?.0))
}

/// A layout that is copied to another root.
struct Copy<'a> {
    blueprint: &'a ChunkStore,
    root: &'a str,
}

impl Copy<'_> {
    /// The pane at a path such as `view/UUID`.
    fn pane(&self, path: &str) -> Option<Pane> {
        if path.trim_start_matches('/').starts_with("view/") {
            self.view(path).map(Pane::View)
        } else {
            self.container(path)
        }
    }

    fn container(&self, path: &str) -> Option<Pane> {
        type ContainerArchetype = panes::ContainerBlueprint;
        let path = &absolute(path);
        let kind: ContainerKind = self.first(path, ContainerArchetype::descriptor_container_kind())?;
        let title = self.first::<rerun::components::Name>(path, ContainerArchetype::descriptor_display_name());
        let contents = self.all::<components::IncludedContent>(path, ContainerArchetype::descriptor_contents());
        let shares: Vec<f32> = match kind {
            ContainerKind::Horizontal => {
                let shares = self.all::<components::ColumnShare>(path, ContainerArchetype::descriptor_col_shares());
                shares.into_iter().map(|share| share.0.0).collect()
            }
            ContainerKind::Vertical => {
                let shares = self.all::<components::RowShare>(path, ContainerArchetype::descriptor_row_shares());
                shares.into_iter().map(|share| share.0.0).collect()
            }
            ContainerKind::Tabs | ContainerKind::Grid => Vec::new(),
        };
        let shares = shares.into_iter().chain(std::iter::repeat(1.0));
        let panes =
            contents.iter().zip(shares).filter_map(|(content, share)| Some((self.pane(content.0.as_str())?, share)));
        Some(Pane::container(kind, title.as_ref().map_or("", |title| title.as_str()), panes.collect()))
    }

    fn view(&self, path: &str) -> Option<PaneView> {
        type ViewArchetype = panes::ViewBlueprint;
        let path = &absolute(path);
        let class = self.first::<components::ViewClass>(path, ViewArchetype::descriptor_class_identifier())?;
        let title = self.first::<rerun::components::Name>(path, ViewArchetype::descriptor_display_name());
        let origin = self.first::<components::ViewOrigin>(path, ViewArchetype::descriptor_space_origin());
        let contents = format!("{path}/ViewContents");
        let contents = self.all::<components::QueryExpression>(&contents, panes::ViewContents::descriptor_query());
        Some(PaneView {
            class: class.0.to_string(),
            title: title.map_or_else(String::new, |title| title.to_string()),
            origin: format!("{}{}", self.root, absolute(origin.as_ref().map_or("", |origin| origin.0.as_str()))),
            contents: contents.iter().map(|query| moved(query.0.as_str(), self.root)).collect(),
            properties: self.properties(path),
            picture: None,
        })
    }

    /// The properties of a view, as they are.
    fn properties(&self, path: &str) -> Vec<(String, Box<dyn AsComponents>)> {
        let property = |chunk: &Chunk| {
            let entity = chunk.entity_path().to_string();
            let name = entity.strip_prefix(path)?.strip_prefix('/')?;
            let of_view = !name.contains('/') && name != "ViewContents";
            of_view.then(|| (name.to_owned(), Box::new(Property(batches(chunk))) as Box<dyn AsComponents>))
        };
        self.blueprint.iter_physical_chunks().filter_map(|chunk| property(chunk)).collect()
    }

    fn first<C: Component>(&self, path: &str, descriptor: ComponentDescriptor) -> Option<C> {
        self.all(path, descriptor).into_iter().next()
    }

    /// The values of a component; none if they are not there.
    fn all<C: Component>(&self, path: &str, descriptor: ComponentDescriptor) -> Vec<C> {
        let of_path = |chunk: &&Arc<Chunk>| chunk.entity_path().to_string() == path;
        let values = |chunk: &Arc<Chunk>| {
            (0..chunk.num_rows()).rev().find_map(|row| chunk.component_batch::<C>(descriptor.component, row)?.ok())
        };
        self.blueprint.iter_physical_chunks().filter(of_path).find_map(values).unwrap_or_default()
    }
}

/// Components that are passed on.
struct Property(Vec<SerializedComponentBatch>);

impl AsComponents for Property {
    fn as_serialized_batches(&self) -> Vec<SerializedComponentBatch> {
        self.0.clone()
    }
}

/// The components of the first row.
fn batches(chunk: &Chunk) -> Vec<SerializedComponentBatch> {
    let batch = |descriptor: &ComponentDescriptor| {
        let array = chunk.component_batch_raw(descriptor.component, 0)?.ok()?;
        Some(SerializedComponentBatch { descriptor: descriptor.clone(), array })
    };
    chunk.component_descriptors().filter_map(batch).collect()
}

fn absolute(path: &str) -> String {
    format!("/{}", path.trim_start_matches('/'))
}

/// A query such as `/scene/pressure/**` for entities that are now under `root`; one that starts at the origin stays.
fn moved(query: &str, root: &str) -> String {
    match query.find('/') {
        Some(start) if !query.contains('$') => format!("{}{root}{}", &query[..start], &query[start..]),
        _ => query.into(),
    }
}
