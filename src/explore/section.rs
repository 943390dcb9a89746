//! The section through a contact, which the page draws without the viewer.

use super::columns::columns;
use super::zone::PlasticZone;
use crate::contact::{Contact, CutLayers, FieldKind, Problem, State, StateField, Step};
use crate::elastic::stress::highest_row;
use crate::theory::Exact;
use ndarray::ArrayView1;
use serde::Serialize;
use std::collections::BTreeMap;
use std::ops::Range;

/// The most columns of a section, of one of a step, and of the picture of the stress below.
const COLUMNS: usize = 1024;
const STEP_COLUMNS: usize = 256;
const STRESS_COLUMNS: usize = 512;
/// Rows of the picture of the stress, and its depth over the length of the section.
const STRESS_ROWS: usize = 48;
const DEPTH: f64 = 0.1;
/// Further fields of a state that are drawn beside the pressure.
const FIELDS: [FieldKind; 2] = [FieldKind::Traction, FieldKind::Attraction];
/// Poisson's ratio of the solid, on which the largest shear stress hardly depends.
const POISSON: f64 = 0.3;

/// A contact along a line, or along a row of a surface: that of the largest pressure, or where nothing presses that of the highest peak. A column
/// shows the node at which the rigid surface is highest in it, which touches first and is the same node at all loads. Lengths are in metres, pressures
/// over the contact modulus.
///
/// Heights are measured upwards from the surface of the unloaded solid. A displacement `u` points into the solid, so
/// the solid's surface stands at `-u` and the rigid surface at `gap - u`, the negative of its heights, up to a
/// constant: its shape is the same at all loads, but where it yields, and is drawn as it is flattened.
#[derive(Clone, Serialize)]
pub struct Section {
    /// Length of the section.
    pub length: f64,
    /// Where the row is, from the first one on; none of a line.
    pub y: Option<f64>,
    /// The rigid surface where it stands, peaks down.
    pub rigid: Vec<f32>,
    /// The solid's surface, lowest where it is pressed in most.
    pub solid: Vec<f32>,
    /// The pressure.
    pub pressure: Vec<f32>,
    /// The largest pressure of all nodes of the row.
    pub highest_pressure: f64,
    /// Further fields over the contact modulus, by their names: the traction under a tangential load, the attraction with adhesion.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub fields: BTreeMap<&'static str, Vec<f32>>,
    /// The plastic zone below the section, of a solid that yields below its surface.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub zone: Option<PlasticZone>,
    /// The exact pressure, where it is known; 0 where it is infinite.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exact: Option<Vec<f32>>,
    /// Whether it is pressed by its mean gap: not where the boundary is free.
    pub is_pressed_by_gap: bool,
    /// Whether the rigid surface slides over the solid, towards larger places.
    pub slides: bool,
    /// Mean gap as it is prescribed: where the surface yields, less the plastic overlap.
    pub mean_gap: f64,
    /// The highest peak above the mean of the rigid surface: a larger mean gap than that is no contact.
    pub highest: f64,
}

/// The largest shear stress in a solid below a section, in plane strain or below the row of a surface.
#[derive(Clone, Serialize)]
pub(crate) struct Shear {
    /// How deep its last row is.
    pub depth: f64,
    /// Columns of a row.
    pub columns: usize,
    /// The highest value over the contact modulus.
    pub highest: f64,
    /// All values in 255ths of the highest one, row by row from the surface on.
    pub values: Vec<u8>,
}

impl Section {
    /// The section of a contact, with the further fields of its state.
    pub fn from_contact(contact: &Contact, fields: &[StateField]) -> Self {
        Self::in_columns(contact, row_of(contact), fields, COLUMNS)
    }

    /// The section of a contact with the exact pressure beside its own.
    pub fn with_exact(contact: &Contact, exact: &Exact) -> Self {
        let row = contact.highest_row();
        let (problem, pressure) = (&contact.problem, exact.pressure.row(row));
        let over_modulus = |node: usize| {
            let p = pressure[node] / problem.contact_modulus();
            if p.is_finite() { p as f32 } else { 0.0 }
        };
        let exact = peaks(problem, row, COLUMNS).into_iter().map(over_modulus).collect();
        Self { exact: Some(exact), ..Self::from_contact(contact, &[]) }
    }

    /// The section of a contact with a solid that yields below its surface, along the row of its cut.
    pub fn with_zone(contact: &Contact, cut: &CutLayers, fields: &[StateField]) -> Self {
        let zone = PlasticZone::new(contact, cut, fields);
        Self { zone, ..Self::in_columns(contact, cut.row, &[], COLUMNS) }
    }

    /// The section of a state of a history.
    pub fn from_state(state: &State) -> Self {
        if let Some(cut) = &state.layers {
            let zone = PlasticZone::new(&state.contact, cut, &state.fields);
            return Self { zone, ..Self::in_columns(&state.contact, cut.row, &[], STEP_COLUMNS) };
        }
        Self::in_columns(&state.contact, row_of(&state.contact), &state.fields, STEP_COLUMNS)
    }

    /// The section of a load of a sweep along a row, which is the same one at all loads.
    pub fn from_load(contact: &Contact, row: usize) -> Self {
        Self::in_columns(contact, row, &[], STEP_COLUMNS)
    }

    /// The section of a contact along a row in at most `most` columns, with those of its further fields that are drawn.
    fn in_columns(contact: &Contact, row: usize, fields: &[StateField], most: usize) -> Self {
        let problem = &contact.problem;
        let own = [&contact.pressure, &contact.gap, &contact.displacement].map(|field| field.row(row));
        let nodes = peaks(problem, row, most);
        let over_modulus = |field: &StateField| {
            let values = field.values.row(row);
            nodes.iter().map(|&node| (values[node] / problem.contact_modulus()) as f32).collect()
        };
        let drawn = fields.iter().filter(|field| FIELDS.contains(&field.kind));
        let fields = drawn.map(|field| (field.name(), over_modulus(field))).collect();
        Self { fields, ..Self::along(problem, row, own, contact.separation(), most) }
    }

    /// The section of a step, whose displacement is taken less its mean where the cell is periodic, as that of a contact.
    pub fn from_step(step: &Step<'_>) -> Self {
        let grid = step.problem().surface().grid();
        let (pressure, displacement) = (step.pressure(), step.displacement());
        let row = highest_row(grid, pressure);
        let [pressure, gap, displacement] = [pressure, step.gap(), displacement].map(|field| {
            let width = grid.shape()[1];
            ArrayView1::from(&field[row * width..(row + 1) * width])
        });
        let mean = step.displacement().iter().sum::<f64>() / grid.len() as f64;
        let centred = displacement.map(|u| if grid.is_periodic() { u - mean } else { *u });
        Self::along(step.problem(), row, [pressure, gap, centred.view()], step.separation(), STEP_COLUMNS)
    }

    /// The section along a row with its pressure, gap and displacement, in at most `most` columns.
    fn along(problem: &Problem, row: usize, fields: [ArrayView1<'_, f64>; 3], mean_gap: f64, most: usize) -> Self {
        let grid = problem.surface().grid();
        let [pressure, gap, displacement] = fields;
        let nodes = peaks(problem, row, most);
        let modulus = problem.contact_modulus();
        let of = |value: &dyn Fn(usize) -> f64| nodes.iter().map(|&node| value(node) as f32).collect();
        Self {
            length: grid.size()[1],
            y: (!grid.is_line()).then(|| row as f64 * grid.spacing()[0]),
            rigid: of(&|node| gap[node] - displacement[node]),
            solid: of(&|node| -displacement[node]),
            pressure: of(&|node| pressure[node] / modulus),
            highest_pressure: pressure.fold(0.0, |most: f64, &p| most.max(p)) / modulus,
            fields: BTreeMap::new(),
            zone: None,
            exact: None,
            is_pressed_by_gap: grid.is_periodic(),
            slides: problem.is_moving(),
            mean_gap,
            highest: problem.highest(),
        }
    }
}

/// The row that the section of a contact is along: where nothing presses, that of the highest peak.
fn row_of(contact: &Contact) -> usize {
    let problem = &contact.problem;
    if contact.max_pressure() > 0.0 {
        contact.highest_row()
    } else {
        highest_row(problem.surface().grid(), problem.height())
    }
}

/// The node of each column of a row that is highest.
fn peaks(problem: &Problem, row: usize, most: usize) -> Vec<usize> {
    let width = problem.surface().grid().shape()[1];
    let height = &problem.height()[row * width..];
    let peak = |nodes: Range<usize>| nodes.max_by(|&a, &b| height[a].total_cmp(&height[b])).unwrap_or_default();
    columns(width, most).map(peak).collect()
}

impl Shear {
    /// The stress below the section of a contact; none where it is not known, in a layer and below a surface with a free boundary.
    pub(crate) fn below(contact: &Contact) -> Option<Self> {
        let row = contact.highest_row();
        let grid = contact.problem.surface().grid();
        let depth = DEPTH * grid.size()[1];
        let depths: Vec<f64> = (0..STRESS_ROWS).map(|i| depth * i as f64 / (STRESS_ROWS - 1) as f64).collect();
        let stress = contact.stress(row, POISSON, &depths).ok()?.tau_max();
        let ranges: Vec<Range<usize>> = columns(grid.shape()[1], STRESS_COLUMNS).collect();
        let modulus = contact.problem.contact_modulus();
        let highest = stress.iter().copied().fold(0.0, f64::max);
        let most = |row: ArrayView1<'_, f64>, nodes: &Range<usize>| {
            let value = nodes.clone().map(|node| row[node]).fold(0.0, f64::max);
            (255.0 * value / highest).round() as u8
        };
        let values = stress.rows().into_iter().flat_map(|row| ranges.iter().map(move |nodes| most(row, nodes)));
        Some(Self { depth, columns: ranges.len(), highest: highest / modulus, values: values.collect() })
    }
}
