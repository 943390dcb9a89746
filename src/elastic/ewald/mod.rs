//! A half-space without images, whose displacement is the sum of a near and a far part.
//!
//! The displacement by a pressure on one element falls as `1/r`. A convolution that is padded with zeros takes it as a whole, and so
//! needs twice as many points along each axis. Here it is split like the sums of Ewald,
//!
//! `1/r = (1/r - g(r)) + g(r)`,
//!
//! where the [`FarKernel`] `g` is smooth, and equal to `1/r` beyond a radius `R`. The near part is zero there: its grid is padded by `R`
//! only. The far part has no waves shorter than four spacings of a grid of every fourth node, on which it is convolved; the
//! [`CoarseWindow`] takes pressures there, and displacements back. Both parts are exact to the rounding of the numbers. On 1024^2 nodes both
//! grids together have two fifths of the points of the padded one.
//!
//! Inner iterations of the multilevel solver split `1/r` as well, but with two digits only and for pressures on few nodes, where the near
//! part is a sum over neighbours.
//!
//! # Source
//! Ewald, Ann. Phys. 369, 253 (1921); a window in place of the Gaussian: Jiang & Greengard, Comm. Pure Appl. Math. (2025), doi 10.1002/cpa.22240;
//! the coarse grid: Hockney & Eastwood, *Computer Simulation Using Particles* (1988), chapter 8, and Barnett, Magland & af Klinteberg,
//! SIAM J. Sci. Comput. 41, C479 (2019).

mod convolution;
mod far;
mod shape;
mod table;
mod window;

use super::ElasticSolid;
use super::element;
use super::free::padded;
use crate::fourier::Real;
use crate::grid::Grid;
pub(super) use convolution::EwaldConvolution;
use shape::{DOUBLE, EwaldShape, SINGLE};
use std::sync::OnceLock;
use table::EwaldTable;

/// The most points that both grids may have, in those of the padded one. With more the passes over the coarse grid take what the
/// transforms save.
const MOST_POINTS: f64 = 0.5;

/// The tables of a half-space that is free along both axes of a surface, made on first use.
#[derive(Debug, Clone)]
pub(super) struct EwaldTables {
    pub modulus: f64,
    grid: Grid,
    double: OnceLock<EwaldTable>,
    single: OnceLock<EwaldTable>,
}

impl EwaldTables {
    /// Whether there are any. The grids of a browser are too small, and the compiler leaves out all else there: a fiftieth of the module.
    pub(crate) const ARE_MADE: bool = !cfg!(target_arch = "wasm32");

    /// The tables of a half-space over a grid; none where the padded convolution is as fast, or the only one.
    pub(crate) fn new(grid: &Grid, solid: &dyn ElasticSolid) -> Option<Self> {
        let is_free = !grid.is_line() && grid.periodic() == [false; 2];
        if !Self::ARE_MADE || !is_free || !solid.is_half_space() {
            return None;
        }
        let shape = EwaldShape::new(grid, DOUBLE)?;
        let pays = shape.points() as f64 <= MOST_POINTS * padded(grid).ok()?.len() as f64;
        let modulus = solid.contact_modulus();
        pays.then(|| Self { modulus, grid: *grid, double: OnceLock::new(), single: OnceLock::new() })
    }

    /// The table for fields of a precision.
    pub(crate) fn at_precision<T: Real>(&self) -> &EwaldTable {
        let (table, fineness) = if T::EPSILON > f64::EPSILON { (&self.single, SINGLE) } else { (&self.double, DOUBLE) };
        table.get_or_init(|| EwaldTable::new(&self.grid, self.modulus, fineness))
    }

    /// Stiffness of a uniform pressure on the grid that a padded convolution has, the softest of all fields there.
    pub(crate) fn softest(&self) -> f64 {
        let (padded, [dy, dx]) = (padded(&self.grid).expect("checked when it was made"), self.grid.spacing());
        // the elements between both middles of the padded grid make one rectangle
        element::rectangle([0.5 * dy, 0.5 * dx], padded.size(), self.modulus).recip()
    }

    /// Points of both grids of the convolution in double precision.
    pub(crate) fn points(&self) -> usize {
        self.shape().points()
    }

    /// Fields of doubles of the convolution and its table in double precision.
    pub(crate) fn fields(&self) -> f64 {
        self.shape().values() as f64 / self.grid.len() as f64
    }

    fn shape(&self) -> EwaldShape {
        EwaldShape::new(&self.grid, DOUBLE).expect("checked when it was made")
    }
}

#[cfg(test)]
mod tests {
    use super::super::free::{FreeConvolution, FreeTable};
    use super::*;
    use crate::elastic::HalfSpace;

    /// Pressure on single nodes, on a patch and in the corners.
    fn pressure([ny, nx]: [usize; 2]) -> Vec<f64> {
        let is_corner = |y: usize, x: usize| [0, ny - 1].contains(&y) && [0, nx - 1].contains(&x);
        let is_patch = |y: usize, x: usize| (ny / 4..ny / 3).contains(&y) && (nx / 2..nx / 2 + 9).contains(&x);
        let at = |y: usize, x: usize| {
            let noise = ((y * 31 + x * 17) as f64 * 0.7).sin();
            if is_corner(y, x) || is_patch(y, x) || (y * nx + x).is_multiple_of(97) { 1.0 + noise } else { 0.0 }
        };
        (0..ny * nx).map(|i| at(i / nx, i % nx)).collect()
    }

    /// The displacement by `convolve`, which takes what fills and what stores rows.
    fn displaced<T: Real>(
        shape: [usize; 2],
        convolve: impl FnOnce(&(dyn Fn(usize, &mut [T]) + Sync), &mut [Vec<T>]),
    ) -> Vec<f64> {
        let (pressure, width) = (pressure(shape), shape[1]);
        let fill = |r: usize, row: &mut [T]| {
            row.iter_mut().zip(&pressure[r * width..]).for_each(|(to, from)| *to = T::from_double(*from));
        };
        let mut rows = vec![Vec::new(); shape[0]];
        convolve(&fill, &mut rows);
        rows.concat().into_iter().map(Real::to_double).collect()
    }

    fn by_both_parts<T: Real>(tables: &EwaldTables) -> Vec<f64> {
        let shape = tables.grid.shape();
        displaced::<T>(shape, |fill, rows| {
            let table = tables.at_precision::<T>();
            EwaldConvolution::new(shape, table).convolve(table, 2.0, fill, rows, |_, row, sink| *sink = row.to_vec());
        })
    }

    fn by_padding(grid: &Grid) -> Vec<f64> {
        displaced::<f64>(grid.shape(), |fill, rows| {
            let table = FreeTable::new(grid, &HalfSpace::new(3.0)).unwrap();
            let mut padded = FreeConvolution::new(grid, &table);
            padded.convolve(&table, 2.0, grid.shape(), fill, rows, |_, row, sink| *sink = row.to_vec());
        })
    }

    #[test]
    fn both_parts_add_up_to_the_whole_on_any_shape() {
        for (shape, size) in [([400, 400], [1.0, 1.0]), ([513, 431], [1.2e-9, 1.3e-9]), ([450, 601], [4e7, 4e7])] {
            let grid = Grid::surface(shape, size).unwrap().with_periodic([false; 2]);
            let tables = EwaldTables { grid, ..EwaldTables::new(&square(512), &HalfSpace::new(3.0)).unwrap() };
            let whole = by_padding(&grid);
            let largest = whole.iter().fold(0.0, |most: f64, u| most.max(*u));
            for (found, allowed) in [(by_both_parts::<f64>(&tables), 1e-14), (by_both_parts::<f32>(&tables), 1e-6)] {
                let error = found.iter().zip(&whole).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / largest;
                assert!(error < allowed, "{shape:?}: {error:e}, allowed {allowed:e}");
            }
        }
    }

    fn square(points: usize) -> Grid {
        Grid::surface([points; 2], [1.0; 2]).unwrap().with_periodic([false; 2])
    }

    #[test]
    fn the_softest_field_is_that_of_the_padded_table() {
        let tables = EwaldTables::new(&square(512), &HalfSpace::new(3.0)).unwrap();
        let table = FreeTable::new(&square(512), &HalfSpace::new(3.0)).unwrap();
        assert!((tables.softest() / table.softest() - 1.0).abs() < 1e-12);
    }

    /// Neither on small grids, nor on long cells, nor where an axis is periodic.
    #[test]
    fn tables_are_made_where_they_pay() {
        let solid = HalfSpace::new(1.0);
        let is_made = |grid: Grid| EwaldTables::new(&grid, &solid).is_some();
        let surface = |shape, size| Grid::surface(shape, size).unwrap().with_periodic([false; 2]);
        assert!(is_made(square(512)) && is_made(square(1024)) && is_made(surface([700, 900], [1.0, 1.2])));
        assert!(!is_made(square(128)) && !is_made(surface([1024, 64], [1.0, 1.0 / 16.0])));
        assert!(!is_made(surface([1024, 1024], [1.0, 9.0])));
        assert!(!is_made(square(512).with_periodic([true, false])) && !is_made(square(512).with_periodic([true; 2])));
        assert!(!is_made(Grid::line(1 << 16, 1.0).unwrap().with_periodic([false; 2])));
    }
}
