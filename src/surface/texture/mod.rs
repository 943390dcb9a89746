//! Parameters of surface texture by the standards for maps and profiles.

mod correlation;
mod developed;
mod direction;
mod hills;
mod material;
mod parameters;

pub use correlation::Autocorrelation;
pub use material::{AbbottCurve, CoreHeights};
pub use parameters::{SurfaceParameter, SurfaceParameters};

use super::{Roughness, Surface};
use crate::chunks;
use developed::{developed_ratio, rms_gradient};
use direction::texture_direction;
use hills::SignificantHills;
use std::f64::consts::FRAC_PI_2;

/// The autocorrelation at which the standards take the autocorrelation length.
const DECAYED: f64 = 0.2;
/// From this aspect ratio on a surface is alike in all directions, and its strongest one is chance.
const LEAST_ISOTROPIC: f64 = 0.5;
/// Material ratios of the peaks, Vmp, and of the valleys, Vvv, by the defaults of ISO 25178-3.
const PEAKS: f64 = 0.1;
const VALLEYS: f64 = 0.8;
/// The autocorrelation at which correlation lengths along the axes are taken.
const HALF: f64 = 0.5;
/// Material ratios at which heights are told, and the ends of their symbols.
const RATIOS: [(f64, &str); 3] = [(0.1, "mc10"), (0.5, "mc50"), (0.9, "mc90")];

/// Parameters of surface texture: ISO 25178-2 for surfaces, with the letter S, ISO 21920-2 for lines, with the letter P.
///
/// The heights `z` are about their mean, with averages over all nodes, and nothing else is done to them. The standards take them from a
/// surface without its form, and mostly filtered; so subtract the trend and filter first, where heights are measured, see
/// [`Preparation`](super::Preparation). The parameters of lines are those of the unfiltered profile (P, not R) over the whole
/// length as one section: there is no cut-off and no mean over sections.
///
/// Along a free axis, see [`Grid::periodic`](crate::Grid::periodic), there are no differences and no pairs of heights across the rim.
/// Measured heights that are not periodic need such a grid.
///
/// | field | surface | line | definition |
/// |---|---|---|---|
/// | `mean_deviation` | Sa | Pa | `<abs(z)>` |
/// | `rms_height` | Sq | Pq | `sqrt <z^2>` |
/// | `skewness` | Ssk | Psk | `<z^3> / Sq^3`; 0 for a flat |
/// | `kurtosis` | Sku | Pku | `<z^4> / Sq^4`; 0 for a flat |
/// | `peak` | Sp | Pp | largest `z` |
/// | `valley` | Sv | Pv | largest `-z` |
/// | [`Texture::height`] | Sz | Pz | `Sp + Sv`; of a line it is also Pt, as there is one section |
/// | `rms_gradient` | Sdq | Pdq | `sqrt (<(dz/dx)^2> + <(dz/dy)^2>)`, by differences of neighbours along each axis |
/// | `developed_ratio` | Sdr | Pdr | area (length of a line) of the surface over that of the cell, less 1 |
/// | `autocorrelation_length` | Sal | Pal | shortest distance at which the autocorrelation falls to 0.2 |
/// | `aspect_ratio` | Str | | Sal over the longest distance at which the autocorrelation first falls to 0.2 |
/// | `direction` | Std | | direction of the lay in degrees from x towards y, at right angles to the strongest waves; none from Str = 0.5 on |
/// | `correlation_length` | | | distances along y and x at which the autocorrelation falls to 1/2 |
/// | `material` | Smc10, 50, 90 | Pmc10, 50, 90 | heights above which 10, 50 and 90 % of the surface lie |
/// | `peak_material` | Vmp | | volume of material above the height of the ratio 10 %, over the area |
/// | `valley_void` | Vvv | | volume of voids below the height of the ratio 80 %, over the area |
/// | `ten_point_height` | S5z | | mean height of the five highest peaks plus mean depth of the five deepest pits; none if there are fewer |
/// | `peak_density` | Spd | | number of peaks over the area |
/// | `core` | Sk, Spk, Svk, Smr1, Smr2 | Pk, Ppk, Pvk, Pmr1, Pmr2 | see [`CoreHeights`] |
///
/// *Area.* Each cell of four nodes is cut along either diagonal into two triangles; its area is the mean of both. With the slopes `g` of
/// these triangles `Sdr = <sqrt(1 + g^2)> - 1`, which is `Sdq^2 / 2` where slopes are small.
///
/// *Correlation.* See [`Autocorrelation`]. A length is none if the autocorrelation does not fall that far within half of the cell: along the
/// grooves of a surface that does not vary along them, and for a flat. Then there is no aspect ratio, either.
///
/// *Peaks and pits.* Those of S5z and Spd are higher (deeper) than their eight neighbours, and rise by 5 % of Sz or more above the highest saddle
/// to a higher one (Wolf pruning); those at free rims count.
///
/// Source: ISO 25178-2:2021; ISO 21920-2:2021; ISO 13565-2:1996; Peklenik, Proc. Inst. Mech. Eng. 182(3K):108, 1967.
///
/// ```
/// use asperity::Grid;
/// use asperity::surface::{Indenter, Texture};
/// let surface = Indenter::Sine { amplitude: 2.0 }.surface(Grid::line(4096, 1.0)?)?;
/// let texture = Texture::new(&surface);
/// assert!((texture.mean_deviation - 4.0 / std::f64::consts::PI).abs() < 1e-5);
/// assert!((texture.height() - 4.0).abs() < 1e-12);
/// assert_eq!(texture.parameters()[0].symbol, "Pa");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Texture {
    is_line: bool,
    /// Mean deviation, a length.
    pub mean_deviation: f64,
    /// Rms height, a length.
    pub rms_height: f64,
    /// Skewness.
    pub skewness: f64,
    /// Kurtosis.
    pub kurtosis: f64,
    /// Height of the highest peak above the mean, a length.
    pub peak: f64,
    /// Depth of the deepest valley below the mean, a length.
    pub valley: f64,
    /// Rms gradient.
    pub rms_gradient: f64,
    /// Developed area or length over that of the cell, less 1.
    pub developed_ratio: f64,
    /// Autocorrelation length.
    pub autocorrelation_length: Option<f64>,
    /// Texture aspect ratio of a surface, from 0 (grooves) to 1 (alike in all directions).
    pub aspect_ratio: Option<f64>,
    /// Direction of the lay of a surface, in degrees.
    pub direction: Option<f64>,
    /// Correlation lengths along y (none for a line) and x.
    pub correlation_length: [Option<f64>; 2],
    /// Heights about the mean above which 10, 50 and 90 % of the surface lie.
    pub material: [f64; 3],
    /// Volume of material of the peaks over the area, a length; none for a line.
    pub peak_material: Option<f64>,
    /// Volume of the voids of the valleys over the area, a length; none for a line.
    pub valley_void: Option<f64>,
    /// Ten point height, a length.
    pub ten_point_height: Option<f64>,
    /// Peaks per area; none for a line.
    pub peak_density: Option<f64>,
    /// Core, peaks and valleys.
    pub core: CoreHeights,
}

/// One parameter of a texture, under its name in the standards.
#[derive(Debug, Clone, PartialEq)]
pub struct TextureParameter {
    /// The symbol, such as "Sa" of a surface or "Pa" of a line.
    pub symbol: String,
    /// Its meaning in a few words.
    pub meaning: &'static str,
    /// The value; none where it is not defined.
    pub value: Option<f64>,
}

impl Texture {
    /// The parameters of `surface`.
    pub fn new(surface: &Surface) -> Self {
        let (z, is_line) = (surface.heights(), surface.grid().is_line());
        let Roughness { rms_height, peak, valley, skewness, kurtosis, .. } = Roughness::new(surface);
        let (curve, correlation) = (AbbottCurve::new(surface), Autocorrelation::new(surface));
        let along = |angle: f64| correlation.as_ref().and_then(|it| it.decay(angle, HALF));
        let hills = (!is_line).then(|| SignificantHills::new(surface, peak + valley));
        let [shortest, longest] = correlation.as_ref().map_or([None; 2], |it| it.extremes(DECAYED));
        let aspect_ratio = shortest.zip(longest).filter(|_| !is_line).map(|(shortest, longest)| shortest / longest);
        let has_lay = !is_line && aspect_ratio.is_none_or(|ratio| ratio < LEAST_ISOTROPIC);
        Self {
            is_line,
            mean_deviation: chunks::sum(z.len(), |i| z[i].abs()) / z.len() as f64,
            rms_height,
            skewness,
            kurtosis,
            peak,
            valley,
            rms_gradient: rms_gradient(surface),
            developed_ratio: developed_ratio(surface),
            autocorrelation_length: shortest,
            aspect_ratio,
            direction: if has_lay { texture_direction(surface) } else { None },
            correlation_length: [if is_line { None } else { along(FRAC_PI_2) }, along(0.0)],
            material: RATIOS.map(|(ratio, _)| curve.height(ratio)),
            peak_material: (!is_line).then(|| curve.material_volume(PEAKS)),
            valley_void: (!is_line).then(|| curve.void_volume(VALLEYS)),
            ten_point_height: hills.and_then(|it| it.ten_point_height),
            peak_density: hills.map(|it| it.peak_density),
            core: curve.core(),
        }
    }

    /// The height of the highest peak above the deepest valley, a length.
    pub fn height(&self) -> f64 {
        self.peak + self.valley
    }

    /// Peklenik's number `gamma`: the correlation length along x over that along y. It is 1 for surfaces that are alike in all
    /// directions and above 1 for grooves along x; none for a line, and if a length is not defined.
    pub fn peklenik(&self) -> Option<f64> {
        let [y, x] = self.correlation_length;
        Some(x? / y?)
    }

    /// All parameters of the standards with their symbols, in the order of the table above.
    pub fn parameters(&self) -> Vec<TextureParameter> {
        let letter = if self.is_line { 'P' } else { 'S' };
        let parameter = |(name, meaning, value): (&str, &'static str, Option<f64>)| TextureParameter {
            symbol: format!("{letter}{name}"),
            meaning,
            value,
        };
        let all =
            self.of_heights().into_iter().chain(self.of_distances()).chain(self.of_material()).chain(self.of_areas());
        let volumes = [
            ("Vmp", "peak material volume per area", self.peak_material),
            ("Vvv", "valley void volume per area", self.valley_void),
        ];
        let volumes = volumes.into_iter().filter(|_| !self.is_line).map(|(symbol, meaning, value)| TextureParameter {
            symbol: symbol.to_owned(),
            meaning,
            value,
        });
        all.map(parameter).chain(volumes).collect()
    }

    fn of_heights(&self) -> [(&'static str, &'static str, Option<f64>); 7] {
        [
            ("a", "mean deviation", self.mean_deviation),
            ("q", "rms height", self.rms_height),
            ("sk", "skewness", self.skewness),
            ("ku", "kurtosis", self.kurtosis),
            ("p", "highest peak", self.peak),
            ("v", "deepest valley", self.valley),
            ("z", "peak to valley", self.height()),
        ]
        .map(|(name, meaning, value)| (name, meaning, Some(value)))
    }

    fn of_distances(&self) -> impl Iterator<Item = (&'static str, &'static str, Option<f64>)> {
        let aspect = (!self.is_line).then_some(("tr", "texture aspect ratio", self.aspect_ratio));
        let all = [
            ("dq", "rms gradient", Some(self.rms_gradient)),
            ("dr", "developed ratio", Some(self.developed_ratio)),
            ("al", "decay length", self.autocorrelation_length),
        ];
        all.into_iter().chain(aspect)
    }

    /// The parameters that only surfaces have.
    fn of_areas(&self) -> Vec<(&'static str, &'static str, Option<f64>)> {
        if self.is_line {
            return Vec::new();
        }
        vec![
            ("td", "texture direction, degrees from x to y", self.direction),
            ("5z", "ten point height", self.ten_point_height),
            ("pd", "peak density, per area", self.peak_density),
        ]
    }

    fn of_material(&self) -> impl Iterator<Item = (&'static str, &'static str, Option<f64>)> {
        let CoreHeights { core, peaks, valleys, peak_ratio, valley_ratio } = self.core;
        let heights = RATIOS.iter().zip(self.material).map(|((_, name), height)| (*name, "height by material", height));
        let cores = [
            ("k", "core height", core),
            ("pk", "reduced peak height", peaks),
            ("vk", "reduced valley depth", valleys),
            ("mr1", "ratio of peaks", peak_ratio),
            ("mr2", "ratio less valleys", valley_ratio),
        ];
        heights.chain(cores).map(|(name, meaning, value)| (name, meaning, Some(value)))
    }
}
