//! Arrays of heights that are prepared.

use crate::arrays::{ArrayLike, check_finite, field};
use crate::conversion::{Sections, section_mut, table_from_sections};
use crate::detached::Detached;
use crate::error::{bail, error_of_keywords, py_error};
use crate::fork;
use asperity::formats::Scan;
use asperity::setup::{Cost, Recipe};
use asperity::surface::{Preparation, PreparationChoice};
use pyo3::prelude::*;
use serde_json::{Value, json};

/// The name of the height file in the setup of a surface that was given as an array.
pub const ARRAY: &str = "array.npy";

/// Fields in memory while a surface is made.
pub const FIELDS: f64 = 4.0;

/// An array of heights, prepared, as a surface on a cell.
pub struct PreparedArray {
    pub surface: asperity::Surface,
    /// The sections of a setup.
    pub sections: Sections,
    pub rank: usize,
    /// The steps of the preparation in words.
    pub preparation: Vec<String>,
}

impl PreparedArray {
    /// The surface of an array on a cell, prepared as the key `prepare` of the cell asks for.
    pub fn new(height: &ArrayLike<'_>, mut cell: Sections) -> PyResult<Self> {
        let rank = height.as_array().ndim();
        let (outer, given) = (2 - rank.clamp(1, 2), field(height)?);
        let prepare = cell.remove("prepare");
        if prepare.is_none() {
            check_finite(&given, "height")?;
        }
        let py = height.py();
        let mut sections = sections_of_array(cell);
        if let Some(prepare) = prepare {
            section_mut(&mut sections, "surface").insert("prepare".into(), prepare);
        }
        let is_chosen = take_auto(&mut sections)?;
        let (recipe, raw) = on_points(py, &sections, &given.shape()[outer..], None)?;
        let unrefined = asperity::setup::Cell { refine: None, ..raw.clone() };
        let grid = unrefined.grid().map_err(py_error)?;
        let scan = Scan { height: given, spacing: grid.spacing() };
        let mut reasons = Vec::new();
        if is_chosen {
            let chosen = height.py().detached(|| choice(&recipe, &scan, grid.periodic()))??;
            reasons = chosen.reasons;
            let steps = serde_json::to_value(chosen.preparation).map_err(py_error)?;
            let prepare = section_mut(section_mut(&mut sections, "surface"), "prepare");
            for (step, value) in steps.as_object().cloned().unwrap_or_default() {
                prepare.entry(step).or_insert(value);
            }
        }
        let (recipe, _) = on_points(py, &sections, &scan.shape()[outer..], None)?;
        let prepared = height.py().try_detached(|| recipe.prepare.apply(scan))?;
        let (voids, shape, spacing) = (prepared.scan.voids(), prepared.scan.shape(), prepared.scan.spacing);
        if voids > 0 && !recipe.prepare.is_none() {
            let all = shape[0] * shape[1];
            return bail(format!(
                "{voids} of {all} heights are void: fill them (prepare={{'fill': 'harmonic'}}, or prepare='auto')"
            ));
        }
        let size = (!recipe.prepare.is_none()).then(|| [0, 1].map(|axis| shape[axis] as f64 * spacing[axis]));
        let (_, mut cell) = on_points(py, &sections, &shape[outer..], size.as_ref().map(|size| &size[outer..]))?;
        let fine = cell.grid().map_err(py_error)?;
        Cost::from_fields(&fine, FIELDS).check("a surface").map_err(py_error)?;
        let factor = cell.refine.take().unwrap_or(1);
        let coarse = cell.grid().map_err(py_error)?;
        fork::check_not_forked()?;
        let filled = prepared.filled;
        let made =
            || asperity::Surface::new(coarse, prepared.scan.height)?.with_filled(filled.as_ref()).refined(factor);
        let surface = height.py().try_detached(made)?;
        let preparation = reasons.into_iter().chain(prepared.effects).map(|it| it.to_string()).collect();
        Ok(Self { surface, sections, rank, preparation })
    }
}

/// The sections of a surface that is an array on a grid.
pub fn sections_of_array(grid: Sections) -> Sections {
    let mut sections = Sections::new();
    section_mut(&mut sections, "surface").insert("height".into(), ARRAY.into());
    sections.insert("grid".into(), Value::Object(grid));
    sections
}

/// Whether the steps are to be chosen; the word is taken out of the sections.
fn take_auto(sections: &mut Sections) -> PyResult<bool> {
    let surface = section_mut(sections, "surface");
    let word = match surface.get("prepare") {
        Some(Value::String(word)) => {
            let word = word.clone();
            surface.insert("prepare".into(), json!({}));
            word
        }
        Some(Value::Object(_)) => match section_mut(surface, "prepare").remove("steps") {
            Some(Value::String(word)) => word,
            Some(other) => other.to_string(),
            None => return Ok(false),
        },
        _ => return Ok(false),
    };
    if word == "auto" {
        Ok(true)
    } else {
        bail(format!("prepare is {word:?}: give \"auto\", or a dictionary of steps"))
    }
}

/// The recipe and the cell of some sections for an array with some points, of the size that is given or of another one.
fn on_points(
    py: Python<'_>,
    sections: &Sections,
    points: &[usize],
    size: Option<&[f64]>,
) -> PyResult<(Recipe, asperity::setup::Cell)> {
    let mut sized = sections.clone();
    let grid = section_mut(&mut sized, "grid");
    grid.insert("points".into(), json!(points));
    if let Some(size) = size {
        grid.insert("size".into(), json!(size));
    }
    table_from_sections(&sized)?.surface().map_err(|error| error_of_keywords(py, "Surface", &["grid"], error))
}

/// The steps that heights need after they are cropped.
fn choice(recipe: &Recipe, scan: &Scan, periodic: [bool; 2]) -> PyResult<PreparationChoice> {
    let crop = Preparation { crop: recipe.prepare.crop.clone(), ..Preparation::default() };
    let cropped = crop.apply(scan.clone()).map_err(py_error)?;
    PreparationChoice::new(&cropped.scan, true, periodic).map_err(py_error)
}
