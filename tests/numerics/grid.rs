//! Grids: wavenumbers, and what is refused.

use asperity::Grid;
use asperity::error::GridError;

#[test]
fn wavenumbers_mirror_at_nyquist() {
    let grid = Grid::surface([5, 4], [std::f64::consts::TAU, std::f64::consts::TAU]).unwrap();
    let q: Vec<f64> = grid.wavenumbers().collect();
    assert_eq!(q.len(), grid.modes());
    assert_eq!(&q[..5], &[0.0, 1.0, 2.0, 2.0, 1.0]);
    assert_eq!(q[10], 2.0);
    assert_eq!(grid.multiplicities().sum::<f64>(), grid.len() as f64);
}

#[test]
fn bad_grids_are_refused() {
    assert!(Grid::line(3, 1.0).is_err());
    assert!(Grid::line(4, f64::NAN).is_err());
    assert!(Grid::surface([4, 4], [1.0, -1.0]).is_err());
    for shape in [[usize::MAX / 2, 4], [1 << 17, (1 << 17) + 1]] {
        assert_eq!(Grid::surface(shape, [1.0, 1.0]), Err(GridError::TooManyPoints { shape }));
    }
    assert!(Grid::line(Grid::MAX_POINTS + 1, 1.0).is_err());
    assert!(Grid::surface([1 << 17, 1 << 17], [1.0, 1.0]).is_ok());
}

#[test]
fn coarser_versions_of_a_grid_are_told_from_others() {
    let surface = |shape, size| Grid::surface(shape, size).unwrap();
    let fine = surface([48, 64], [1.0, 2.0]);
    let coarser = [([48, 64], [1, 1]), ([12, 16], [4, 4]), ([48, 8], [1, 8])].map(|(shape, it)| (shape, Some(it)));
    for (shape, expected) in coarser.into_iter().chain([([16, 64], None), ([96, 64], None)]) {
        assert_eq!(fine.stride(&surface(shape, [1.0, 2.0])), expected, "{shape:?}");
        assert_eq!(fine.stride(&surface(shape, [1.0, 1.0])), None);
    }
}
