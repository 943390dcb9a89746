//! The grid that lines and surfaces share, periodic or free along each axis.

use crate::error::GridError;

/// An equidistant grid of `ny` rows and `nx` columns on a cell of `ly` by `lx`, which is periodic unless an axis is
/// made free.
///
/// A line is a grid of shape `(1, n)`: nothing varies along y. Solvers do not distinguish lines and surfaces; only
/// spectral exponents, statistics and pictures do.
///
/// Along a free axis there is nothing outside the cell: the nodes are the centres of elements that fill it, and nodes
/// at the rim have no neighbours outside.
///
/// ```
/// use asperity::Grid;
/// let grid = Grid::surface([64, 128], [1.0, 4.0])?;
/// assert_eq!(grid.spacing(), [1.0 / 64.0, 4.0 / 128.0]);
/// assert!(Grid::line(3, 1.0).is_err());
/// # Ok::<(), asperity::error::GridError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    shape: [usize; 2],
    size: [f64; 2],
    free: [bool; 2],
}

impl Grid {
    /// The fewest points along an axis: below it a central difference and its neighbours coincide.
    pub const MIN_POINTS: usize = 4;

    /// The most points of a grid: one field of doubles on it takes 128 GiB, or 1 GiB where addresses have 32 bits, as in
    /// a browser.
    pub const MAX_POINTS: usize = 1 << if usize::BITS > 34 { 34 } else { 27 };

    /// A line of `points` points and period `length`.
    ///
    /// # Errors
    /// [`GridError`] for fewer than [`Grid::MIN_POINTS`] points, for more than [`Grid::MAX_POINTS`], or for a length that
    /// is not positive and finite.
    pub fn line(points: usize, length: f64) -> Result<Self, GridError> {
        Self { shape: [1, points], size: [1.0, length], free: [false; 2] }.checked(&["x"])
    }

    /// A surface of `[ny, nx]` points and periods `[ly, lx]`.
    ///
    /// # Errors
    /// The errors of [`Grid::line`], for either axis.
    pub fn surface(shape: [usize; 2], size: [f64; 2]) -> Result<Self, GridError> {
        Self { shape, size, free: [false; 2] }.checked(&["y", "x"])
    }

    /// The grid, if it can be along the last `axes`.
    fn checked(self, axes: &[&'static str]) -> Result<Self, GridError> {
        let Self { shape, size, .. } = self;
        for (i, &axis) in (2 - axes.len()..).zip(axes) {
            let (points, length) = (shape[i], size[i]);
            if points < Self::MIN_POINTS {
                return Err(GridError::TooFewPoints { axis, points });
            }
            if !(length.is_finite() && length > 0.0) {
                return Err(GridError::Length { axis, length });
            }
        }
        match shape[0].checked_mul(shape[1]) {
            Some(points) if points <= Self::MAX_POINTS => Ok(self),
            _ => Err(GridError::TooManyPoints { shape }),
        }
    }

    /// The grid of `factor` times as many points along each side of the same cell.
    ///
    /// # Errors
    /// [`GridError::TooManyPoints`].
    pub fn refined(&self, factor: usize) -> Result<Self, GridError> {
        let [ny, nx] = self.shape.map(|n| n.saturating_mul(factor));
        self.with_shape([if self.is_line() { 1 } else { ny }, nx])
    }

    /// Distance of the nodes of `coarse` along y and x in nodes of this grid, if it is this grid or a coarser version of it by powers
    /// of two.
    pub fn stride(&self, coarse: &Self) -> Option<[usize; 2]> {
        let stride = [0, 1].map(|axis| self.shape[axis] / coarse.shape[axis]);
        let fits =
            |axis: usize| stride[axis].is_power_of_two() && stride[axis] * coarse.shape[axis] == self.shape[axis];
        (coarse.size == self.size && coarse.free == self.free && fits(0) && fits(1)).then_some(stride)
    }

    /// The grid of another shape over the same cell.
    ///
    /// # Errors
    /// The errors of [`Grid::line`].
    pub fn with_shape(&self, shape: [usize; 2]) -> Result<Self, GridError> {
        let grid = if self.is_line() { Self::line(shape[1], self.size[1]) } else { Self::surface(shape, self.size) };
        Ok(grid?.with_periodic(self.periodic()))
    }

    /// The same grid, periodic or free along y and x. The y of a line, along which nothing varies, stays periodic.
    ///
    /// ```
    /// let patch = asperity::Grid::surface([4, 5], [1.0, 1.0])?.with_periodic([true, false]);
    /// assert_eq!((patch.neighbour(4, [0, 1]), patch.neighbour(0, [-1, 0])), (4, 15));
    /// # Ok::<(), asperity::error::GridError>(())
    /// ```
    pub fn with_periodic(&self, [y, x]: [bool; 2]) -> Self {
        Self { free: [!y && !self.is_line(), !x], ..*self }
    }

    /// Whether the cell is periodic along y and x.
    pub fn periodic(&self) -> [bool; 2] {
        self.free.map(|free| !free)
    }

    /// Whether the cell is periodic along all axes.
    pub fn is_periodic(&self) -> bool {
        self.free == [false; 2]
    }

    /// The boundaries of the cell, in words.
    pub fn boundary(&self) -> &'static str {
        match self.periodic() {
            [true, true] => "periodic",
            [false, false] => "free",
            [true, false] if self.is_line() => "free",
            [true, false] => "periodic along y, free along x",
            [false, true] => "free along y, periodic along x",
        }
    }

    /// Whether a node lies at the rim of a free axis.
    pub fn is_at_rim(&self, node: usize) -> bool {
        let place = [node / self.shape[1], node % self.shape[1]];
        (0..2).any(|axis| self.free[axis] && (place[axis] == 0 || place[axis] + 1 == self.shape[axis]))
    }

    /// Points along y and x.
    pub fn shape(&self) -> [usize; 2] {
        self.shape
    }

    /// Lengths of the cell along y and x, which are the periods along periodic axes. For a line, the length along y is
    /// nominally 1.
    pub fn size(&self) -> [f64; 2] {
        self.size
    }

    /// True for a line, the grid of shape `(1, n)`.
    pub fn is_line(&self) -> bool {
        self.shape[0] == 1
    }

    /// Number of points.
    #[expect(clippy::len_without_is_empty, reason = "a grid has at least four points")]
    pub fn len(&self) -> usize {
        self.shape[0] * self.shape[1]
    }

    /// Area of the cell; the length of a line.
    pub fn area(&self) -> f64 {
        if self.is_line() { self.size[1] } else { self.size[0] * self.size[1] }
    }

    /// Distances between neighbours along y and x.
    pub fn spacing(&self) -> [f64; 2] {
        [self.size[0] / self.shape[0] as f64, self.size[1] / self.shape[1] as f64]
    }

    /// The shorter one of both spacings, a length; that along `x` of a line.
    pub(crate) fn shortest_spacing(&self) -> f64 {
        let [dy, dx] = self.spacing();
        if self.is_line() { dx } else { dx.min(dy) }
    }

    /// The node, counted row by row, `dy` rows and `dx` columns from another: beyond a period, the node on the other
    /// side of the cell; beyond a free rim, the node at the rim.
    ///
    /// ```
    /// let grid = asperity::Grid::surface([4, 5], [1.0, 1.0])?;
    /// assert_eq!((grid.neighbour(0, [0, -1]), grid.neighbour(0, [-1, 2])), (4, 17));
    /// # Ok::<(), asperity::error::GridError>(())
    /// ```
    pub fn neighbour(&self, node: usize, [dy, dx]: [isize; 2]) -> usize {
        let [ny, nx] = self.shape;
        let along = |i: usize, step: isize, n: usize, free: bool| match i as isize + step {
            to if (0..n as isize).contains(&to) => to as usize,
            to if free => to.clamp(0, n as isize - 1) as usize,
            to => to.rem_euclid(n as isize) as usize,
        };
        let [y, x] = self.place(node);
        along(y, dy, ny, self.free[0]) * nx + along(x, dx, nx, self.free[1])
    }

    /// Row and column of a node. A line needs no division.
    pub(crate) fn place(&self, node: usize) -> [usize; 2] {
        match self.shape {
            [1, _] => [0, node],
            [_, nx] => [node / nx, node % nx],
        }
    }

    /// The nearest neighbours of a node: next and previous along x, then along y. If there is no neighbour (along y of
    /// a line, and at a free rim), it is the node itself.
    pub(crate) fn neighbours(&self, node: usize) -> [usize; 4] {
        let ([ny, nx], [_, x]) = (self.shape, self.place(node));
        let last_row = (ny - 1) * nx;
        let [over_y, over_x] = [if self.free[0] { 0 } else { last_row }, if self.free[1] { 0 } else { nx - 1 }];
        [
            if x + 1 < nx { node + 1 } else { node - over_x },
            if x > 0 { node - 1 } else { node + over_x },
            if node < last_row { node + nx } else { node - over_y },
            if node >= nx { node - nx } else { node + over_y },
        ]
    }

    /// Positions `x` of the columns, from 0.
    pub fn x(&self) -> impl ExactSizeIterator<Item = f64> + use<> {
        let dx = self.spacing()[1];
        (0..self.shape[1]).map(move |i| i as f64 * dx)
    }

    /// Positions `y` of the rows, from 0.
    pub fn y(&self) -> impl ExactSizeIterator<Item = f64> + use<> {
        let dy = self.spacing()[0];
        (0..self.shape[0]).map(move |i| i as f64 * dy)
    }

    /// The longest period along which the surface varies: the longest wavelength in the cell.
    pub fn longest_wavelength(&self) -> f64 {
        if self.is_line() { self.size[1] } else { self.size[0].max(self.size[1]) }
    }

    /// Twice the coarsest spacing: the shortest wavelength that is resolved along every axis.
    pub fn shortest_wavelength(&self) -> f64 {
        let [dy, dx] = self.spacing();
        2.0 * if self.is_line() { dx } else { dy.max(dx) }
    }

    /// Number of Fourier coefficients of a real field, see [`crate::fourier`].
    pub fn modes(&self) -> usize {
        (self.shape[1] / 2 + 1) * self.shape[0]
    }

    /// Magnitudes `|q|` of the wave vectors (`q = 2 pi / wavelength`), in the order of the coefficients in
    /// [`crate::fourier`]: `q_x` from 0 to Nyquist outside, all `q_y` inside.
    pub fn wavenumbers(&self) -> impl Iterator<Item = f64> + use<> {
        let [ny, nx] = self.shape;
        let [ly, lx] = self.size;
        (0..=nx / 2).flat_map(move |kx| {
            let qx = std::f64::consts::TAU * kx as f64 / lx;
            (0..ny).map(move |ky| qx.hypot(std::f64::consts::TAU * ky.min(ny - ky) as f64 / ly))
        })
    }

    /// Wave vectors `[q_y, q_x]` in the order of [`Grid::wavenumbers`]; `q_y` of the upper half of the rows is negative.
    ///
    /// ```
    /// use asperity::Grid;
    /// let grid = Grid::surface([4, 6], [std::f64::consts::TAU; 2])?;
    /// let second: Vec<[f64; 2]> = grid.wave_vectors().skip(4).take(4).collect();
    /// assert_eq!(second, [[0.0, 1.0], [1.0, 1.0], [2.0, 1.0], [-1.0, 1.0]]);
    /// # Ok::<(), asperity::error::GridError>(())
    /// ```
    pub fn wave_vectors(&self) -> impl Iterator<Item = [f64; 2]> + use<> {
        let [ny, nx] = self.shape;
        let [qy, qx] = self.size.map(|length| std::f64::consts::TAU / length);
        let along_y = move |ky: usize| if 2 * ky <= ny { qy * ky as f64 } else { -qy * (ny - ky) as f64 };
        (0..=nx / 2).flat_map(move |kx| (0..ny).map(move |ky| [along_y(ky), qx * kx as f64]))
    }

    /// Number of modes of the full spectrum that each stored coefficient represents (2, or 1 where it is its own mirror
    /// image): the weights of Parseval's sum, in the order of [`Grid::wavenumbers`].
    pub fn multiplicities(&self) -> impl Iterator<Item = f64> + use<> {
        let [ny, nx] = self.shape;
        (0..=nx / 2).flat_map(move |kx| {
            let weight = if kx == 0 || 2 * kx == nx { 1.0 } else { 2.0 };
            (0..ny).map(move |_| weight)
        })
    }
}
