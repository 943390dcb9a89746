//! Spectral moments and parameters of texture, as they are printed.

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
    pub(crate) fn rows(&self, units: Units) -> Vec<(String, String)> {
        let taken = ("texture taken as".to_owned(), self.texture_boundary.to_owned());
        let number = |it: &SurfaceParameter, value: f64| match it.is_length() {
            true => units.length(value),
            false => significant(value),
        };
        let word = |it: &SurfaceParameter| match (it.value, it.error) {
            (None, _) => "not within half of the cell".to_owned(),
            (Some(value), None) => number(it, value),
            (Some(value), Some(error)) if it.is_length() => format!("{} ± {}", number(it, value), units.length(error)),
            (Some(value), Some(error)) => format!("{} ± {error:.1e}", number(it, value)),
        };
        [taken].into_iter().chain(self.parameters.iter().map(|it| (it.name.clone(), word(it)))).collect()
    }
}
