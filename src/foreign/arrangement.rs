//! Other orders in which the nodes of a field may have been written.

use crate::grid::Grid;

/// Another order of the nodes of a field.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Arrangement {
    /// Rows for columns.
    Transposed,
    /// From end to end along y or x, or along both.
    Backwards([bool; 2]),
    /// Moved by half of the points along y or x, or along both, as by `numpy.fft.fftshift`.
    Shifted([bool; 2]),
    /// Moved by some nodes along y and x, as by `numpy.roll`.
    Rolled([isize; 2]),
}

impl Arrangement {
    const ALL: [Self; 19] = [
        Self::Transposed,
        Self::Backwards([false, true]),
        Self::Backwards([true, false]),
        Self::Backwards([true, true]),
        Self::Shifted([false, true]),
        Self::Shifted([true, false]),
        Self::Shifted([true, true]),
        Self::Rolled([0, 1]),
        Self::Rolled([0, -1]),
        Self::Rolled([1, 0]),
        Self::Rolled([-1, 0]),
        Self::Rolled([1, 1]),
        Self::Rolled([1, -1]),
        Self::Rolled([-1, 1]),
        Self::Rolled([-1, -1]),
        Self::Rolled([0, 2]),
        Self::Rolled([0, -2]),
        Self::Rolled([2, 0]),
        Self::Rolled([-2, 0]),
    ];

    /// The orders that differ from the given one on a grid.
    pub(crate) fn on(grid: &Grid) -> impl Iterator<Item = Self> + use<> {
        let (is_line, [ny, nx]) = (grid.is_line(), grid.shape());
        Self::ALL.into_iter().filter(move |arrangement| match arrangement {
            Self::Transposed => ny == nx,
            Self::Backwards([of_y, _]) | Self::Shifted([of_y, _]) => !(is_line && *of_y),
            Self::Rolled([along_y, _]) => !(is_line && *along_y != 0),
        })
    }

    /// The field in this order.
    pub(crate) fn apply(self, values: &[f64], grid: &Grid) -> Vec<f64> {
        let [ny, nx] = grid.shape();
        let moved = |is_moved: bool, i: usize, n: usize| if is_moved { (i + n - n / 2) % n } else { i };
        let rolled = |by: isize, i: usize, n: usize| (i as isize + by).rem_euclid(n as isize) as usize;
        let turned = |is_turned: bool, i: usize, n: usize| if is_turned { n - 1 - i } else { i };
        let source = |y: usize, x: usize| match self {
            Self::Transposed => [x, y],
            Self::Backwards([of_y, of_x]) => [turned(of_y, y, ny), turned(of_x, x, nx)],
            Self::Shifted([of_y, of_x]) => [moved(of_y, y, ny), moved(of_x, x, nx)],
            Self::Rolled([along_y, along_x]) => [rolled(along_y, y, ny), rolled(along_x, x, nx)],
        };
        let value = |node: usize| {
            let [y, x] = source(node / nx, node % nx);
            values[y * nx + x]
        };
        (0..values.len()).map(value).collect()
    }

    /// The relation of the field to the heights, in words.
    pub(crate) fn words(self) -> String {
        match self {
            Self::Transposed => "are transposed".into(),
            Self::Backwards(axes) => format!("run backwards along {}", along(axes)),
            Self::Shifted(axes) => format!("are shifted by half the cell along {}", along(axes)),
            Self::Rolled([0, x]) => format!("are shifted along x by {}", nodes(x)),
            Self::Rolled([y, 0]) => format!("are shifted along y by {}", nodes(y)),
            Self::Rolled([y, x]) => format!("are shifted along y by {}, and along x by {}", nodes(y), nodes(x)),
        }
    }

    /// The expression in Python that corrects the field `name`.
    pub(crate) fn remedy(self, name: &str, grid: &Grid) -> String {
        let (is_line, numpy) = (grid.is_line(), "numpy.fft.fftshift");
        match self {
            Self::Transposed => format!("{name}.T"),
            Self::Backwards(_) if is_line => format!("{name}[::-1]"),
            Self::Shifted(_) if is_line => format!("{numpy}({name})"),
            Self::Rolled([_, x]) if is_line => format!("numpy.roll({name}, {})", -x),
            Self::Rolled([y, x]) => format!("numpy.roll({name}, ({}, {}), axis=(0, 1))", -y, -x),
            Self::Backwards([true, true]) => format!("{name}[::-1, ::-1]"),
            Self::Backwards([of_y, _]) => format!("{name}[{}]", if of_y { "::-1" } else { ":, ::-1" }),
            Self::Shifted([true, true]) => format!("{numpy}({name})"),
            Self::Shifted([of_y, _]) => format!("{numpy}({name}, axes={})", usize::from(!of_y)),
        }
    }
}

fn nodes(by: isize) -> String {
    if by.abs() == 1 { format!("{by} node") } else { format!("{by} nodes") }
}

fn along(axes: [bool; 2]) -> &'static str {
    match axes {
        [true, true] => "y and x",
        [true, false] => "y",
        _ => "x",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_order_puts_right_what_it_describes() {
        let grid = Grid::surface([4, 5], [1.0, 1.0]).unwrap();
        let values: Vec<f64> = (0..20).map(f64::from).collect();
        let first = |arrangement: Arrangement| arrangement.apply(&values, &grid)[0];
        assert_eq!(first(Arrangement::Backwards([false, true])), 4.0);
        assert_eq!(first(Arrangement::Backwards([true, true])), 19.0);
        // as numpy.fft.fftshift: the first value goes to the middle
        assert_eq!(Arrangement::Shifted([true, true]).apply(&values, &grid)[2 * 5 + 2], 0.0);
        let square = Grid::surface([4, 4], [1.0, 1.0]).unwrap();
        assert_eq!(Arrangement::Transposed.apply(&values[..16], &square)[1], 4.0);
        // as numpy.roll by -1: the second value goes to the beginning
        assert_eq!(Arrangement::Rolled([0, 1]).apply(&values, &grid)[0], 1.0);
        assert_eq!(Arrangement::Rolled([-1, 0]).apply(&values, &grid)[0], 15.0);
        assert_eq!(Arrangement::on(&square).count(), 19);
        assert_eq!(Arrangement::on(&grid).count(), 18);
        assert_eq!(Arrangement::on(&Grid::line(8, 1.0).unwrap()).count(), 6);
    }
}
