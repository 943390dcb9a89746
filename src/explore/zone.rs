//! The plastic zone below a section, which the page draws without the viewer.

use super::columns::columns;
use crate::contact::{Contact, CutLayers, FieldKind, StateField};
use crate::surface::Field;
use serde::Serialize;
use std::ops::Range;

/// Rows and most columns of the picture, and its depth over the length of the section.
const ROWS: usize = 64;
const COLUMNS: usize = 256;
const DEPTH: f64 = 0.3;

/// Plastic strain and von Mises stress below a section, in places of equal size. Each shows the largest value in it.
#[derive(Clone, Serialize)]
pub struct PlasticZone {
    /// How deep its last row ends, in metres.
    depth: f64,
    /// Columns of a row.
    columns: usize,
    /// The accumulated plastic strain.
    strain: ZoneField,
    /// The von Mises stress, over the contact modulus.
    stress: ZoneField,
}

/// A field below a section, row by row from the surface on.
#[derive(Clone, Serialize)]
struct ZoneField {
    /// The highest value.
    highest: f64,
    /// All values in 255ths of the highest one.
    values: Vec<u8>,
}

impl PlasticZone {
    /// The plastic zone in the cut below a contact, with the fields of its state; none where they have no plastic strain.
    pub fn new(contact: &Contact, cut: &CutLayers, fields: &[StateField]) -> Option<Self> {
        let grid = contact.problem.surface().grid();
        let depth = (DEPTH * grid.size()[1]).min(cut.interfaces.last().copied().unwrap_or(0.0));
        let layers: Vec<Range<usize>> = (0..ROWS).map(|row| layers(&cut.interfaces, depth, row)).collect();
        let places: Vec<Range<usize>> = columns(grid.shape()[1], COLUMNS).collect();
        let field = |kind: FieldKind, unit: f64| {
            let field = fields.iter().find(|it| it.kind == kind)?;
            Some(ZoneField::new(&field.values, unit, &layers, &places))
        };
        Some(Self {
            depth,
            columns: places.len(),
            strain: field(FieldKind::PlasticStrain, 1.0)?,
            stress: field(FieldKind::VonMises, contact.problem.contact_modulus())?,
        })
    }
}

impl ZoneField {
    /// The largest values of a field over a unit in places, which are ranges of layers and of nodes.
    fn new(field: &Field, unit: f64, layers: &[Range<usize>], places: &[Range<usize>]) -> Self {
        let most = |layers: &Range<usize>, nodes: &Range<usize>| {
            let inside = layers.clone().flat_map(|layer| nodes.clone().map(move |node| field[[layer, node]]));
            inside.fold(0.0, f64::max)
        };
        let all: Vec<f64> =
            layers.iter().flat_map(|layers| places.iter().map(move |nodes| most(layers, nodes))).collect();
        let highest = all.iter().copied().fold(0.0, f64::max);
        let share = |value: f64| if highest > 0.0 { (255.0 * value / highest).round() as u8 } else { 0 };
        Self { highest: highest / unit, values: all.into_iter().map(share).collect() }
    }
}

/// The layers that a row of the picture meets: the one at its upper edge, and all that begin in it.
fn layers(interfaces: &[f64], depth: f64, row: usize) -> Range<usize> {
    let [top, bottom] = [row, row + 1].map(|edge| depth * edge as f64 / ROWS as f64);
    let count = interfaces.len().saturating_sub(1);
    let first = interfaces.partition_point(|it| *it <= top).saturating_sub(1).min(count);
    let end = interfaces.partition_point(|it| *it < bottom).clamp(first, count);
    first..end
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_meet_all_layers() {
        let interfaces = [0.0, 0.001, 0.01, 0.5, 0.7, 1.0];
        let met: Vec<Range<usize>> = (0..ROWS).map(|row| layers(&interfaces, 1.0, row)).collect();
        assert_eq!(met[0], 0..3);
        assert_eq!([&met[31], &met[32]], [&(2..3), &(3..4)]);
        assert_eq!(met[ROWS - 1], 4..5);
        assert!(met.windows(2).all(|two| two[0].end >= two[1].start && two[0].start < two[0].end));
    }
}
