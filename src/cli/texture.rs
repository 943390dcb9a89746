//! Spectral moments and parameters of texture, as they are printed.

use asperity::surface::{SpectralMoments, Surface, Texture, TextureParameter};
use serde::Serialize;
use std::collections::BTreeMap;

/// The parameters of a surface.
#[derive(Serialize)]
pub struct TextureReport {
    /// The boundary under which they hold: free along the axes on which the heights jump.
    texture_boundary: &'static str,
    /// Those that are not defined are null.
    #[serde(flatten)]
    by_key: BTreeMap<String, Option<f64>>,
    #[serde(skip)]
    rows: Vec<(String, Option<f64>)>,
}

/// A key, a name for reading, and a value.
type Entry = (String, String, Option<f64>);

impl TextureReport {
    /// The parameters of a surface, as a part of a larger one along the axes on which it jumps.
    pub fn new(surface: &Surface) -> Self {
        let surface = surface.with_jumps_free();
        let (moments, texture) = (SpectralMoments::new(&surface), Texture::new(&surface));
        let is_line = surface.grid().is_line();
        let all = || of_standards(&texture).chain(of_lengths(&texture, is_line)).chain(of_spectrum(&moments, is_line));
        Self {
            texture_boundary: surface.grid().boundary(),
            by_key: all().map(|(key, _, value)| (key, value)).collect(),
            rows: all().map(|(_, name, value)| (name, value)).collect(),
        }
    }

    /// Rows for reading, with a word for numbers.
    pub fn rows(&self, number: fn(f64) -> String) -> Vec<(String, String)> {
        let taken = ("texture taken as".to_owned(), self.texture_boundary.to_owned());
        let word = |value: &Option<f64>| value.map_or("not within half of the cell".to_owned(), number);
        [taken].into_iter().chain(self.rows.iter().map(|(name, value)| (name.clone(), word(value)))).collect()
    }
}

/// The parameters of the standards.
fn of_standards(texture: &Texture) -> impl Iterator<Item = Entry> {
    let entry = |it: TextureParameter| (it.symbol.to_lowercase(), format!("{}, {}", it.symbol, it.meaning), it.value);
    texture.parameters().into_iter().map(entry)
}

fn of_lengths(texture: &Texture, is_line: bool) -> impl Iterator<Item = Entry> {
    let [y, x] = texture.correlation_length;
    let along_y = [
        ("correlation_length_y", "correlation along y", y),
        ("peklenik", "Peklenik number, x by y", texture.peklenik()),
    ];
    let of_surface = along_y.into_iter().filter(move |_| !is_line);
    [("correlation_length_x", "correlation along x", x)].into_iter().chain(of_surface).map(owned)
}

fn of_spectrum(moments: &SpectralMoments, is_line: bool) -> impl Iterator<Item = Entry> {
    let SpectralMoments { m0, m2, m4, m2_along, m4_along } = *moments;
    let along = [
        ("m2_y", "m2 along y", m2_along[0]),
        ("m2_x", "m2 along x", m2_along[1]),
        ("m4_y", "m4 along y", m4_along[0]),
        ("m4_x", "m4 along x", m4_along[1]),
    ];
    let all = [
        ("m0", "m0 of the spectrum", m0),
        ("m2", "m2 of the spectrum", m2),
        ("m4", "m4 of the spectrum", m4),
        ("nayak", "Nayak's parameter", moments.nayak()),
    ];
    let of_surface = along.into_iter().filter(move |_| !is_line);
    all.into_iter().chain(of_surface).map(|(key, name, value)| owned((key, name, Some(value))))
}

fn owned((key, name, value): (&str, &str, Option<f64>)) -> Entry {
    (key.to_owned(), name.to_owned(), value)
}
