//! Spectral moments and parameters of texture, as they are printed.

use super::output::{TextRow, row};
use super::units::{Units, significant};
use asperity::surface::{Surface, SurfaceParameter, SurfaceParameters};
use serde::Serialize;
use std::collections::BTreeMap;

/// The parameters of a surface.
#[derive(Serialize)]
pub(crate) struct TextureReport {
    /// The boundary under which they hold: free along the axes on which the heights jump.
    texture_boundary: &'static str,
    /// Values, and standard errors under keys that end in `_error`. Those that are not defined are null.
    #[serde(flatten)]
    by_key: BTreeMap<String, Option<f64>>,
    #[serde(skip)]
    parameters: Vec<SurfaceParameter>,
}

impl TextureReport {
    /// The parameters of a surface; with errors if it is a sample of a larger one.
    pub(crate) fn new(surface: &Surface, is_sample: bool) -> Self {
        let SurfaceParameters { boundary, texture, moments } = SurfaceParameters::new(surface);
        let error = |it: SurfaceParameter| SurfaceParameter { error: it.error.filter(|_| is_sample), ..it };
        let parameters: Vec<_> = texture.into_iter().chain(moments).map(error).collect();
        let values = parameters.iter().map(|it| (it.key.to_lowercase(), it.value));
        let errors = parameters.iter().map(|it| (format!("{}_error", it.key.to_lowercase()), it.error));
        let by_key = values.chain(errors.filter(|_| is_sample)).collect();
        Self { texture_boundary: boundary, by_key, parameters }
    }

    /// Values by their keys, in the order of rows.
    pub(crate) fn values(&self) -> impl Iterator<Item = (String, Option<f64>)> + '_ {
        self.parameters.iter().map(|it| (it.key.to_lowercase(), it.value))
    }

    /// Rows for reading.
    pub(crate) fn rows(&self, units: Units) -> Vec<TextRow> {
        let mut rows = vec![row("texture taken as", self.texture_boundary)];
        for parameter in &self.parameters {
            rows.push(row(&parameter.name, in_words(parameter, units)));
        }
        rows
    }
}

/// The value of a parameter with its error, if it has one.
fn in_words(parameter: &SurfaceParameter, units: Units) -> String {
    // the length of a texture is found inside of the cell or not at all
    let Some(value) = parameter.value else { return "not within half of the cell".to_owned() };
    let is_length = parameter.is_length();
    let words = if is_length { units.length(value) } else { significant(value) };
    match parameter.error {
        Some(error) if is_length => format!("{words} ± {}", units.length(error)),
        Some(error) => format!("{words} ± {error:.1e}"),
        None => words,
    }
}
