//! All parameters of a surface with their names and errors.

use super::{RATIOS, Texture, TextureParameter};
use crate::grid::Grid;
use crate::surface::{Field, MomentErrors, SpectralMoments, Surface};

/// The parts along each axis of a line, and of a surface.
const PARTS: [[usize; 2]; 2] = [[1, 4], [2, 2]];
/// The smallest number of nodes along an axis of a part.
const SMALLEST: usize = 8;
/// Relative difference of heights that are the same.
const ROUNDING: f64 = 1e-12;

/// A parameter of a surface with its standard error.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceParameter {
    /// The symbol of the standards such as "Sa", or a word such as "peklenik".
    pub key: String,
    /// The name for reading.
    pub name: String,
    /// The value; none where it is not defined.
    pub value: Option<f64>,
    /// The standard error; none where it is not known.
    pub error: Option<f64>,
}

/// The letters behind S or P of the parameters that are lengths.
const LENGTHS: [&str; 12] = ["a", "q", "p", "v", "z", "al", "k", "pk", "vk", "5z", "mp", "vv"];

impl SurfaceParameter {
    /// Whether it is a length.
    pub fn is_length(&self) -> bool {
        let symbol = self.key.get(1..).unwrap_or_default();
        let is_material = || RATIOS.iter().any(|(_, name)| *name == symbol);
        self.key.starts_with("correlation_length") || LENGTHS.contains(&symbol) || is_material()
    }
}

/// The parameters of texture and the spectral moments of a surface, with standard errors.
///
/// An axis on which the heights jump across the period is taken as free, see [`Surface::with_jumps_free`].
///
/// *Errors.* The surface is taken as a sample of a larger one that is everywhere alike. The error tells how much a parameter
/// differs between such samples. It means nothing for an indenter. For [`Texture`] the surface is cut into four parts, halves along each axis or
/// quarters of a line. The error is the standard deviation of the parameter over the parts, divided by `sqrt 4`. From four values it
/// is known to about 40 %. It is none if the parameter is not defined in each part, if a part has fewer than 8 nodes along an axis,
/// and for extreme heights (Sp, Sv, Sz), which grow with the size of the sample. The errors of moments are those
/// of [`SpectralMoments::with_errors`]. Of a surface that is its own mirror image, as after a preparation, only the original half is a sample.
///
/// ```
/// use asperity::surface::{Spectrum, SurfaceParameters};
/// use asperity::{Grid, Surface};
/// let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.05, short_cutoff: 0.01, rms_gradient: 0.1 };
/// let surface = Surface::rough(Grid::line(2048, 1.0)?, &spectrum, 1)?;
/// let parameters = SurfaceParameters::new(&surface);
/// let pq = parameters.texture.iter().find(|it| it.key == "Pq").unwrap();
/// assert!(pq.error.unwrap() < 0.2 * pq.value.unwrap());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceParameters {
    /// The boundary under which they hold.
    pub boundary: &'static str,
    /// Parameters of the standards, then correlation lengths and Peklenik's number.
    pub texture: Vec<SurfaceParameter>,
    /// Spectral moments and Nayak's parameter.
    pub moments: Vec<SurfaceParameter>,
}

impl SurfaceParameters {
    /// The parameters of `surface`.
    pub fn new(surface: &Surface) -> Self {
        let surface = surface.with_jumps_free();
        let sample = unmirrored(&surface);
        let mut texture = of_texture(&Texture::new(&surface));
        let parts: Vec<_> = parts(&sample).iter().map(|part| of_texture(&Texture::new(part))).collect();
        for (i, parameter) in texture.iter_mut().enumerate().filter(|(_, it)| !is_extreme(&it.key)) {
            parameter.error =
                parts.iter().map(|part| part[i].value).collect::<Option<Vec<_>>>().and_then(standard_error);
        }
        let moments =
            of_moments(&SpectralMoments::new(&surface), &SpectralMoments::with_errors(&sample).1, surface.grid());
        Self { boundary: surface.grid().boundary(), texture, moments }
    }
}

/// Whether a parameter is the height of a few nodes, or an angle, for which parts tell no error.
fn is_extreme(key: &str) -> bool {
    (key.len() == 2 && key.ends_with(['p', 'v', 'z'])) || ["S5z", "Std"].contains(&key)
}

/// The standard error of the mean of some values.
fn standard_error(values: Vec<f64>) -> Option<f64> {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let square = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>();
    (values.len() > 1).then(|| (square / (n - 1.0) / n).sqrt())
}

/// A surface without its mirror images, as [`Mirror`](crate::surface::Mirror) adds them: along an axis along which a surface is its own mirror
/// image, the first half of it remains, with a free boundary there. A surface without images is returned as it is.
fn unmirrored(surface: &Surface) -> Surface {
    let grid = surface.grid();
    let is_cut = [0, 1].map(|axis| grid.shape()[axis] >= 2 * SMALLEST && is_mirrored(surface, axis));
    let points = [0, 1].map(|axis| grid.shape()[axis] / if is_cut[axis] { 2 } else { 1 });
    let periodic = [0, 1].map(|axis| grid.periodic()[axis] && !is_cut[axis]);
    let half = is_cut.contains(&true).then(|| part(surface, [0, 0], points, periodic));
    half.flatten().unwrap_or_else(|| surface.clone())
}

/// Whether a surface is its own mirror image along an axis, but for rounding.
fn is_mirrored(surface: &Surface, axis: usize) -> bool {
    let (h, points) = (surface.height(), surface.grid().shape()[axis]);
    let tolerance = ROUNDING * h.iter().fold(0.0, |most: f64, height| most.max(height.abs()));
    let across = |i: usize| (points - i) % points;
    let image = |(y, x): (usize, usize)| if axis == 0 { [across(y), x] } else { [y, across(x)] };
    h.indexed_iter().all(|(node, height)| (height - h[image(node)]).abs() <= tolerance)
}

/// The parts of a surface, each with free boundaries along the axes that are cut; none if they are too small.
fn parts(surface: &Surface) -> Vec<Surface> {
    let (shape, is_line) = (surface.grid().shape(), surface.grid().is_line());
    let cut = PARTS[if is_line { 0 } else { 1 }];
    let points = [0, 1].map(|axis| shape[axis] / cut[axis]);
    if points[1] < SMALLEST || !is_line && points[0] < SMALLEST {
        return Vec::new();
    }
    let origin = |i: usize| [i / cut[1] * points[0], i % cut[1] * points[1]];
    (0..cut[0] * cut[1]).filter_map(|i| part(surface, origin(i), points, [is_line, false])).collect()
}

/// Some points of a surface from an origin on.
fn part(surface: &Surface, [y, x]: [usize; 2], points: [usize; 2], periodic: [bool; 2]) -> Option<Surface> {
    let size = [0, 1].map(|axis| points[axis] as f64 * surface.grid().spacing()[axis]);
    let cell = if surface.grid().is_line() { Grid::line(points[1], size[1]) } else { Grid::surface(points, size) };
    let heights = Field::from_shape_fn(points, |(row, column)| surface.height()[[y + row, x + column]]);
    Surface::new(cell.ok()?.with_periodic(periodic), heights).ok()
}

fn of_texture(texture: &Texture) -> Vec<SurfaceParameter> {
    let standard = |TextureParameter { symbol, meaning, value }| {
        let name = format!("{symbol}, {meaning}");
        SurfaceParameter { key: symbol, name, value, error: None }
    };
    let [y, x] = texture.correlation_length;
    let lengths = [
        ("correlation_length_x", "correlation along x", x),
        ("correlation_length_y", "correlation along y", y),
        ("peklenik", "Peklenik number, x by y", texture.peklenik()),
    ];
    let defined = if texture.is_line { 1 } else { 3 };
    let lengths = lengths.into_iter().take(defined).map(|(key, name, value)| parameter(key, name, value, None));
    texture.parameters().into_iter().map(standard).chain(lengths).collect()
}

fn of_moments(moments: &SpectralMoments, errors: &MomentErrors, grid: &Grid) -> Vec<SurfaceParameter> {
    let SpectralMoments { m0, m2, m4, m2_along, m4_along } = *moments;
    let MomentErrors { m0: of_m0, m2: of_m2, m4: of_m4, m2_along: of_m2_along, m4_along: of_m4_along, nayak } = *errors;
    let all = [
        ("m0", "m0 of the spectrum", m0, of_m0),
        ("m2", "m2 of the spectrum", m2, of_m2),
        ("m4", "m4 of the spectrum", m4, of_m4),
        ("nayak", "Nayak's parameter", moments.nayak(), nayak),
        ("m2_y", "m2 along y", m2_along[0], of_m2_along[0]),
        ("m2_x", "m2 along x", m2_along[1], of_m2_along[1]),
        ("m4_y", "m4 along y", m4_along[0], of_m4_along[0]),
        ("m4_x", "m4 along x", m4_along[1], of_m4_along[1]),
    ];
    let defined = if grid.is_line() { 4 } else { all.len() };
    all.into_iter()
        .take(defined)
        .map(|(key, name, value, error)| parameter(key, name, Some(value), Some(error)))
        .collect()
}

fn parameter(key: &str, name: &str, value: Option<f64>, error: Option<f64>) -> SurfaceParameter {
    SurfaceParameter { key: key.to_owned(), name: name.to_owned(), value, error }
}
