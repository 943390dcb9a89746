//! Rigid surfaces: heights on a grid, peaks towards the solid positive.

mod bends;
mod bumps;
mod filled;
mod indenter;
mod level;
mod moments;
mod plateau;
mod preparation;
mod random;
mod refine;
mod roughness;
mod seam;
mod spectrum;
mod survey;
mod texture;

pub use bumps::{Bump, Bumps};
pub use indenter::Indenter;
pub(crate) use indenter::{about_peak, shortest_period};
pub use moments::{MomentErrors, SpectralMoments};
pub use plateau::Plateaus;
pub use preparation::{
    Crop, Detrend, Fill, Form, LineLevel, LineOffsets, Mirror, Outliers, Preparation, Prepared, Resample, Scars,
    Settling,
};
pub use random::{
    ExactPart, HeightDistribution, Lay, MeasuredSpectrum, RandomRoughness, RankMap, Rolloff, RolloffForm,
    RoughnessScale, SelfAffine, SpectralDensity, SpectrumConvention, SpectrumFile, SpectrumKind, SpectrumTable,
    TargetHeights,
};
pub use roughness::{PowerSpectrum, Roughness};
pub use spectrum::Spectrum;
pub use survey::{
    Artefact, Artefacts, Band, Noise, PowerLawFit, PreparationChoice, RepeatNoise, Scale, Scales, Survey, TipReach,
};
pub use texture::{
    AbbottCurve, Autocorrelation, CoreHeights, SurfaceParameter, SurfaceParameters, Texture, TextureParameter,
};

use crate::chunks;
use crate::error::SurfaceError;
use crate::formats::overflowing;
use crate::grid::Grid;
use ndarray::{Array2, ArrayView1};
use std::sync::Arc;

/// Values on a grid, shape `(ny, nx)`, row by row.
pub type Field = Array2<f64>;

/// The largest magnitude of a field.
pub(crate) fn largest(field: &Field) -> f64 {
    field.iter().fold(0.0, |most: f64, value| most.max(value.abs()))
}

/// A mean below this fraction of the largest deviation is rounding: such heights are not changed.
const ROUNDING: f64 = 1e-12;

/// The height profile of a rigid surface. Peaks that point at the solid are positive.
///
/// Heights are stored about their mean, since only differences matter for a contact. The mean is computed relative to
/// the first height, so that even an offset of a billion rms heights costs no additional digits.
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    grid: Grid,
    height: Field,
    mean_height: f64,
    seed: Option<u64>,
    plateaus: Option<Plateaus>,
    rank_map: Option<RankMap>,
    /// The nodes whose heights were not measured but filled in, row by row; none if all were measured.
    filled: Option<Arc<[bool]>>,
}

impl Surface {
    /// A surface with given heights.
    ///
    /// # Errors
    /// [`SurfaceError::Shape`] if the array does not fit the grid, [`SurfaceError::NonFinite`] for a NaN or infinity,
    /// [`SurfaceError::Overflow`] for heights so large that the squares of their differences are not finite.
    pub fn new(grid: Grid, height: Field) -> Result<Self, SurfaceError> {
        let mut height = checked(&grid, height)?;
        let mean_height = centre(height.as_slice_mut().expect("standard layout"));
        Ok(Self { grid, height, mean_height, seed: None, plateaus: None, rank_map: None, filled: None })
    }

    /// The surface with the parts of another surface, identical to the last bit: heights about their mean, mean, seed
    /// and plateaus. This moves a surface to another process.
    ///
    /// # Errors
    /// The errors of [`Surface::new`].
    ///
    /// ```
    /// use asperity::{Grid, Surface};
    /// let one = Surface::line(ndarray::arr1(&[1.0, 3.0, 5.0, 4.0]).view(), 1.0)?;
    /// let parts = (one.height().clone(), one.mean_height(), one.seed(), one.plateaus().cloned());
    /// assert_eq!(Surface::from_parts(*one.grid(), parts.0, parts.1, parts.2, parts.3)?, one);
    /// # Ok::<(), asperity::error::SurfaceError>(())
    /// ```
    pub fn from_parts(
        grid: Grid,
        height: Field,
        mean_height: f64,
        seed: Option<u64>,
        plateaus: Option<Plateaus>,
    ) -> Result<Self, SurfaceError> {
        Ok(Self { grid, height: checked(&grid, height)?, mean_height, seed, plateaus, rank_map: None, filled: None })
    }

    /// A line of given heights and period.
    ///
    /// # Errors
    /// The errors of [`Surface::new`] and [`Grid::line`].
    pub fn line(height: ArrayView1<f64>, length: f64) -> Result<Self, SurfaceError> {
        let grid = Grid::line(height.len(), length)?;
        Self::new(grid, height.to_owned().insert_axis(ndarray::Axis(0)))
    }

    /// The sum of two surfaces of one grid, such as roughness on an indenter.
    ///
    /// ```
    /// use asperity::{Grid, Indenter, Surface, surface::Spectrum};
    /// let grid = Grid::line(64, 1.0)?;
    /// let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 0.1, rms_gradient: 0.01 };
    /// let (smooth, rough) = (Indenter::Cylinder { radius: 9.0 }.surface(grid)?, Surface::rough(grid, &spectrum, 1)?);
    /// let both = smooth.plus(&rough);
    /// assert_eq!(both.heights()[7], smooth.heights()[7] + rough.heights()[7]);
    /// assert_eq!(both.seed(), Some(1));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Panics
    /// If the grids differ.
    pub fn plus(&self, other: &Self) -> Self {
        assert_eq!(self.grid, other.grid, "surfaces can be added on the same grid only");
        Self {
            grid: self.grid,
            height: &self.height + &other.height,
            mean_height: self.mean_height + other.mean_height,
            seed: self.seed.or(other.seed),
            plateaus: None,
            rank_map: self.rank_map.or(other.rank_map),
            filled: self.filled_with(other),
        }
    }

    /// The lower of two surfaces of one grid at each node, such as a plateau with grooves.
    ///
    /// ```
    /// use asperity::{Grid, Indenter, Surface};
    /// let grid = Grid::line(64, 1.0)?;
    /// let wave = Indenter::Sine { amplitude: 1.0 }.surface(grid)?;
    /// let plateau = Surface::new(grid, ndarray::Array2::from_elem(grid.shape(), 0.5))?;
    /// let lower = wave.lower(&plateau);
    /// let highest = lower.heights_as_given().into_iter().fold(f64::MIN, f64::max);
    /// assert!((highest - 0.5).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Panics
    /// If the grids differ.
    pub fn lower(&self, other: &Self) -> Self {
        assert_eq!(self.grid, other.grid, "surfaces can be compared on the same grid only");
        let [one, two] = [self, other].map(Self::heights_as_given);
        let lower = ndarray::Zip::from(&one).and(&two).map_collect(|one, two| one.min(*two));
        let lower = Self::new(self.grid, lower).expect("finite heights of the same shape");
        Self {
            seed: self.seed.or(other.seed),
            rank_map: self.rank_map.or(other.rank_map),
            filled: self.filled_with(other),
            ..lower
        }
    }

    /// The grid under the heights.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The heights about their mean.
    pub fn height(&self) -> &Field {
        &self.height
    }

    /// The heights about their mean, row by row.
    pub fn heights(&self) -> &[f64] {
        self.height.as_slice().expect("standard layout by construction")
    }

    /// The mean of the heights as they were given.
    pub fn mean_height(&self) -> f64 {
        self.mean_height
    }

    /// The heights as they were given, except for rounding: a field made anew.
    pub fn heights_as_given(&self) -> Field {
        &self.height + self.mean_height
    }

    /// Local mean-square gradient (Eq. 8) as a function of the node, counted row by row.
    ///
    /// Per direction `g_i^2 = 1/2 [((h_i - h_{i+1})/l)^2 + ((h_i - h_{i-1})/l)^2]` with the spacing `l`, periodic; at a
    /// free rim the only difference is used for both. A surface has the sum over both directions. The function panics
    /// where there is no node.
    pub fn square_gradient(&self) -> impl Fn(usize) -> f64 + Sync {
        let (h, grid) = (self.heights(), self.grid);
        let nx = grid.shape()[1];
        let [per_dy, per_dx] = self.grid.spacing().map(f64::recip);
        // from a rim to its neighbour: across the period, or back into the cell
        let [round_y, round_x] = self.grid.periodic();
        let [over_left, over_right] = if round_x { [nx - 1; 2] } else { [1; 2] };
        let [over_above, over_below] = if round_y { [h.len() - nx; 2] } else { [nx; 2] };
        move |node| {
            let [_, x] = grid.place(node);
            let left = if x > 0 { node - 1 } else { node + over_left };
            let right = if x + 1 < nx { node + 1 } else { node - over_right };
            let above = if node >= nx { node - nx } else { node + over_above };
            let below = if node + nx < h.len() { node + nx } else { node - over_below };
            let square = |neighbour: usize, per_spacing: f64| ((h[node] - h[neighbour]) * per_spacing).powi(2);
            0.5 * (square(left, per_dx) + square(right, per_dx) + square(above, per_dy) + square(below, per_dy))
        }
    }

    /// Local square gradient `|grad h|^2` as a function of the node, counted row by row, by central differences of fourth order,
    /// `h' = (8 (h_{i+1} - h_{i-1}) - (h_{i+2} - h_{i-2})) / (12 l)`, periodic, or with the heights reflected at the point of a free rim. On smooth heights it is closer to the gradient of the
    /// surface than Eq. 8, which is larger by a term of second order. The function panics where there is no node.
    pub fn square_slope(&self) -> impl Fn(usize) -> f64 + Sync {
        let (h, grid) = (self.heights(), self.grid);
        let [per_dy, per_dx] = grid.spacing().map(|spacing| 1.0 / (12.0 * spacing));
        let [ny, nx] = grid.shape();
        let slope = |i: usize, n: usize, stride: usize, first: usize, is_periodic: bool| {
            let inside = |i: usize| h[first + i * stride];
            if i >= 2 && i + 2 < n {
                return 8.0 * (inside(i + 1) - inside(i - 1)) - (inside(i + 2) - inside(i - 2));
            }
            let at = |step: isize| match i as isize + step {
                to if to >= 0 && to < n as isize => inside(to as usize),
                to if is_periodic => inside(to.rem_euclid(n as isize) as usize),
                to if to < 0 => 2.0 * inside(0) - inside((-to) as usize),
                to => 2.0 * inside(n - 1) - inside(2 * (n - 1) - to as usize),
            };
            8.0 * (at(1) - at(-1)) - (at(2) - at(-2))
        };
        let [round_y, round_x] = grid.periodic();
        move |node| {
            let [y, x] = grid.place(node);
            let along_x = slope(x, nx, 1, y * nx, round_x) * per_dx;
            let along_y = if ny == 1 { 0.0 } else { slope(y, ny, nx, x, round_y) * per_dy };
            along_x.powi(2) + along_y.powi(2)
        }
    }

    /// Local mean curvature as a function of the node, counted row by row: `-h''` of a line and half of `-(h_xx + h_yy)` of a surface, by
    /// second differences, so that a cylinder and a sphere of radius `R` have `1/R`. At a free rim it is 0 across the rim. The function
    /// panics where there is no node.
    pub fn curvature(&self) -> impl Fn(usize) -> f64 + Sync {
        let (h, grid) = (self.heights(), self.grid);
        let [per_yy, per_xx] = grid.spacing().map(|spacing| spacing.powi(-2));
        let share = if grid.is_line() { 1.0 } else { 0.5 };
        let bend = move |node: usize, [one, other]: [usize; 2]| match one != node && other != node {
            true => 2.0 * h[node] - h[one] - h[other],
            false => 0.0,
        };
        move |node| {
            let [right, left, below, above] = grid.neighbours(node);
            share * (bend(node, [left, right]) * per_xx + bend(node, [above, below]) * per_yy)
        }
    }

    /// Root-mean-square height about the mean, a length.
    fn rms_height(&self) -> f64 {
        let h = self.heights();
        (chunks::sum(h.len(), |i| h[i] * h[i]) / h.len() as f64).sqrt()
    }

    /// Root-mean-square gradient `gbar`: that of all nodes, see [`Surface::square_gradient`].
    pub fn rms_gradient(&self) -> f64 {
        let n = self.height.len();
        (chunks::sum(n, self.square_gradient()) / n as f64).sqrt()
    }

    /// The plateaus that the heights had before they were interpolated on this grid, if they were.
    pub fn plateaus(&self) -> Option<&Plateaus> {
        self.plateaus.as_ref()
    }

    /// How random heights got a distribution that is not Gaussian, if they have one.
    pub fn rank_map(&self) -> Option<&RankMap> {
        self.rank_map.as_ref()
    }

    /// The seed of a random surface.
    pub fn seed(&self) -> Option<u64> {
        self.seed
    }
}

/// The heights in standard layout, if they fit the grid and are finite.
fn checked(grid: &Grid, height: Field) -> Result<Field, SurfaceError> {
    if height.shape() != grid.shape() {
        return Err(SurfaceError::Shape { found: height.shape().to_vec(), expected: grid.shape() });
    }
    if let Some(((row, column), &value)) = height.indexed_iter().find(|(_, h)| !h.is_finite()) {
        return Err(SurfaceError::NonFinite { index: [row, column], value });
    }
    if let Some([least, most]) = overflowing(height.iter().copied()) {
        return Err(SurfaceError::Overflow { least, most });
    }
    Ok(if height.is_standard_layout() { height } else { height.as_standard_layout().into_owned() })
}

/// Refuses the first of some named values that is not positive and finite.
fn check_positive(values: &[(&'static str, f64)]) -> Result<(), SurfaceError> {
    match values.iter().find(|(_, value)| !(value.is_finite() && *value > 0.0)) {
        Some(&(name, value)) => Err(SurfaceError::NotPositive { name, value }),
        None => Ok(()),
    }
}

/// Subtracts the mean from the heights, unless it is rounding, and returns it.
fn centre(height: &mut [f64]) -> f64 {
    let (n, first) = (height.len(), height[0]);
    let offset = chunks::sum(n, |i| height[i] - first) / n as f64;
    let mean = first + offset;
    let largest = chunks::visit(n, |range| range.fold(0.0, |most: f64, i| most.max((height[i] - first).abs())));
    if mean.abs() <= ROUNDING * largest.into_iter().fold(0.0, f64::max) {
        return 0.0;
    }
    chunks::update(height, |_, height| height.iter_mut().for_each(|h| *h = (*h - first) - offset));
    mean
}
