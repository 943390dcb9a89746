//! The balance of the flows of cells, as a matrix that a multigrid cycle works on.

/// The balance of flows of cells, a symmetric positive definite matrix `A`: `(A x)_i = d_i x_i - sum_j c_ij x_j` with the conductances `c_ij`
/// between cells and their sum `d_i`, in which those to the sides count as well.
///
/// Conductances differ by many orders of magnitude, so that `d_i` is never used where it would cancel: flows are `c_ij (x_i - x_j)`.
pub(super) trait Balance {
    /// Number of cells.
    fn cells(&self) -> usize;

    /// The conductance of a cell to the sides.
    fn to_sides(&self, cell: usize) -> f64;

    /// The other cells and the conductances of a cell, which are above zero.
    fn links(&self, cell: usize) -> impl Iterator<Item = (usize, f64)> + Clone;

    /// `A x`.
    fn apply(&self, x: &[f64], product: &mut [f64]);

    /// One sweep of Gauss and Seidel of `A x = b` from zero, from the first cell to the last. What `x` holds before does not matter.
    fn sweep_from_zero(&self, b: &[f64], x: &mut [f64]);

    /// Adds the residual `b - A x` after [`Balance::sweep_from_zero`], which is what later cells have changed, to the sums of the groups of cells.
    fn add_rest_of_sweep(&self, x: &[f64], groups: &[u32], sums: &mut [f64]);

    /// One sweep of Gauss and Seidel of `A x = b`, from the last cell to the first.
    fn sweep_back(&self, b: &[f64], x: &mut [f64]);
}
