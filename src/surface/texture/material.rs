//! The material ratio of heights.

use crate::formats::Scan;
use crate::surface::Surface;

/// The share of the heights in the central region.
const CENTRAL: f64 = 0.4;
/// Secants that differ by less than this share fall equally, except for rounding. Heights that an instrument has rounded have many such.
const TIE: f64 = 1e-9;

/// The material ratio curve of a surface (Abbott's curve): the height `c(r)` above which the share `r` of the surface lies.
///
/// The heights are about their mean, each of `n` nodes stands for the share `1/n`, and `c` is linear between the middles of these
/// shares.
///
/// Source: ISO 25178-2 (areal material ratio curve), ISO 21920-2 (profiles).
///
/// ```
/// use asperity::Grid;
/// use asperity::surface::{AbbottCurve, Indenter};
/// let surface = Indenter::Sine { amplitude: 2.0 }.surface(Grid::line(1000, 1.0)?)?;
/// let curve = AbbottCurve::new(&surface);
/// assert!((curve.height(0.25) - 2.0 * (std::f64::consts::PI * 0.25).cos()).abs() < 5e-3);
/// assert!((curve.ratio(2f64.sqrt()) - 0.25).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct AbbottCurve {
    descending: Vec<f64>,
}

/// Core, peaks and valleys of a material ratio curve: Sk, Spk, Svk, Smr1 and Smr2.
///
/// The central region is the 40 % of the curve over which its secant falls least; if there are several, the first. The line of least squares through it,
/// continued to the ratios 0 and 1, spans the core. A triangle of the base `peak_ratio` and the area of the curve above
/// the core has the height `peaks`; the same holds for the valleys below it.
///
/// Source: ISO 13565-2, ISO 25178-2. The standards evaluate filtered heights; these are as they are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoreHeights {
    /// Height of the core, Sk; a length.
    pub core: f64,
    /// Reduced height of the peaks above the core, Spk; a length.
    pub peaks: f64,
    /// Reduced depth of the valleys below the core, Svk; a length.
    pub valleys: f64,
    /// The material ratio between peaks and core, Smr1, from 0 to 1.
    pub peak_ratio: f64,
    /// The material ratio between core and valleys, Smr2, from 0 to 1.
    pub valley_ratio: f64,
}

impl AbbottCurve {
    /// The curve of `surface`.
    pub fn new(surface: &Surface) -> Self {
        Self::from_heights(surface.heights().to_vec())
    }

    /// The curve of a scan without its voids; none if all heights are void.
    ///
    /// ```
    /// use asperity::formats::Scan;
    /// use asperity::surface::AbbottCurve;
    /// let height = ndarray::arr2(&[[5.0, f64::NAN, 3.0, 7.0]]);
    /// let curve = AbbottCurve::from_scan(&Scan { height, spacing: [1.0; 2] }).expect("three heights are there");
    /// assert_eq!([curve.height(0.0), curve.height(0.5), curve.height(1.0)], [2.0, 0.0, -2.0]);
    /// ```
    pub fn from_scan(scan: &Scan) -> Option<Self> {
        let heights: Vec<f64> = scan.height.iter().copied().filter(|height| height.is_finite()).collect();
        let mean = heights.iter().sum::<f64>() / heights.len() as f64;
        mean.is_finite().then(|| Self::from_heights(heights.iter().map(|height| height - mean).collect()))
    }

    fn from_heights(mut heights: Vec<f64>) -> Self {
        heights.sort_unstable_by(|one, other| other.total_cmp(one));
        Self { descending: heights }
    }

    /// Root mean square of the heights about the mean, a length.
    pub fn rms_height(&self) -> f64 {
        (self.descending.iter().map(|z| z * z).sum::<f64>() / self.descending.len() as f64).sqrt()
    }

    /// The height about the mean above which the share `ratio` of the surface lies, a length; beyond the first and the last node theirs.
    pub fn height(&self, ratio: f64) -> f64 {
        let (z, last) = (&self.descending, self.descending.len() - 1);
        let place = (ratio * z.len() as f64 - 0.5).clamp(0.0, last as f64);
        let below = place as usize;
        z[below] + (place - below as f64) * (z[last.min(below + 1)] - z[below])
    }

    /// The share of the surface above a height about the mean, from 0 to 1.
    pub fn ratio(&self, height: f64) -> f64 {
        let z = &self.descending;
        let above = z.partition_point(|z| *z > height);
        if above == 0 || above == z.len() {
            return (above > 0).into();
        }
        let [over, under] = [z[above - 1], z[above]];
        (above as f64 - 0.5 + (over - height) / (over - under)) / z.len() as f64
    }

    /// The volume of material above the height of the share `ratio`, over the area: Vmp for 0.1; a length.
    ///
    /// ```
    /// use asperity::formats::Scan;
    /// use asperity::surface::AbbottCurve;
    /// // a ramp: above the height of a tenth of it lies a triangle of that base
    /// let height = ndarray::Array2::from_shape_fn((1, 1000), |(_, i)| i as f64);
    /// let curve = AbbottCurve::from_scan(&Scan { height, spacing: [1.0; 2] }).expect("heights are there");
    /// assert!((curve.material_volume(0.1) - 0.5 * 0.1 * 100.0).abs() < 1e-9);
    /// ```
    pub fn material_volume(&self, ratio: f64) -> f64 {
        volume(self.descending.iter(), ratio) - ratio * self.height(ratio)
    }

    /// The volume of the voids below the height of the share `ratio`, over the area: Vvv for 0.8; a length.
    pub fn void_volume(&self, ratio: f64) -> f64 {
        (1.0 - ratio) * self.height(ratio) - volume(self.descending.iter().rev(), 1.0 - ratio)
    }

    /// Core, peaks and valleys.
    pub fn core(&self) -> CoreHeights {
        let [top, bottom] = self.equivalent_line();
        let n = self.descending.len();
        let [peak_ratio, valley_ratio] = [top, bottom].map(|height| self.ratio(height));
        CoreHeights {
            core: top - bottom,
            peaks: triangle(self.descending.iter().map(|z| z - top), peak_ratio * n as f64),
            valleys: triangle(self.descending.iter().rev().map(|z| bottom - z), (1.0 - valley_ratio) * n as f64),
            peak_ratio,
            valley_ratio,
        }
    }

    /// The heights at the ratios 0 and 1 of the line of least squares through the central region.
    fn equivalent_line(&self) -> [f64; 2] {
        let (z, n) = (&self.descending, self.descending.len() as f64);
        let width = (CENTRAL * n).round() as usize;
        let fall = |first: usize| z[first] - z[first + width];
        let least = (0..z.len() - width).map(fall).fold(f64::INFINITY, f64::min);
        let first = (0..z.len() - width).find(|first| fall(*first) <= least * (1.0 + TIE));
        let first = first.expect("the least is one of them");
        let (region, middle) = (&z[first..=first + width], 0.5 * width as f64);
        let mean = region.iter().sum::<f64>() / region.len() as f64;
        let places = || (0..region.len()).map(|i| i as f64 - middle);
        let along: f64 = places().map(|place| place * place).sum();
        let slope = places().zip(region).map(|(place, z)| place * (z - mean)).sum::<f64>() / along;
        let from_top = first as f64 + middle + 0.5;
        [mean - slope * from_top, mean + slope * (n - from_top)]
    }
}

/// The integral of heights over the first share of them, each of which stands for the same share.
fn volume<'a>(heights: impl ExactSizeIterator<Item = &'a f64>, share: f64) -> f64 {
    let count = heights.len() as f64;
    let nodes = share.clamp(0.0, 1.0) * count;
    let part = |(i, height): (usize, &f64)| height * (nodes - i as f64).clamp(0.0, 1.0);
    heights.take(nodes.ceil() as usize).enumerate().map(part).sum::<f64>() / count
}

/// The height of the triangle on a base of so many nodes that has the area under the curve there. `excess` falls, and the curve is 0 at
/// the end of the base; 0 without a base.
fn triangle(excess: impl Iterator<Item = f64>, base: f64) -> f64 {
    let (mut area, mut last, mut nodes) = (0.0, 0.0, 0.0);
    for height in excess.take_while(|height| *height > 0.0) {
        (area, last, nodes) = (area + height, height, nodes + 1.0);
    }
    // the last piece ends at the end of the base, not half a node after the last node
    let area = area - 0.5 * last + 0.5 * last * (base - (nodes - 0.5));
    if base > 0.0 { 2.0 * area / base } else { 0.0 }
}
