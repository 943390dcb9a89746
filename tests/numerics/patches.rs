//! Contact patches, against those that filling finds.

use asperity::Grid;
use asperity::contact::Patches;

fn grid(shape: [usize; 2]) -> Grid {
    if shape[0] == 1 { Grid::line(shape[1], 1.0) } else { Grid::surface(shape, [1.0, 1.0]) }.unwrap()
}

fn patches(rows: &[&str]) -> Vec<usize> {
    let field: Vec<f64> = rows.iter().flat_map(|r| r.chars()).map(|c| if c == '#' { 1.0 } else { 0.0 }).collect();
    Patches::new(&field, &grid([rows.len(), rows[0].len()])).sizes().to_vec()
}

#[test]
fn patches_join_across_rows_columns_and_periods() {
    assert_eq!(patches(&["##..#..#"]), [3, 1]);
    assert!(patches(&["........"]).is_empty());
    assert_eq!(patches(&["########"]), [8]);
    assert_eq!(patches(&["#..#", ".##.", "....", "#..#"]), [4, 2]);
    assert_eq!(patches(&["#.#.", "###.", "#.#.", "...."]), [7]);
    assert_eq!(patches(&["#...", ".#..", "..#.", "...#"]), [1, 1, 1, 1]);
}

/// The sizes by filling: each node takes the lowest number of its neighbours until nothing changes.
fn filled(pressure: &[f64], grid: &Grid) -> Vec<usize> {
    let ([ny, nx], [round_y, round_x]) = (grid.shape(), grid.periodic());
    let mut lowest: Vec<usize> = (0..ny * nx).collect();
    loop {
        let before = lowest.clone();
        for i in (0..ny * nx).filter(|&i| pressure[i] > 0.0) {
            let (y, x) = (i / nx, i % nx);
            let around = [
                ((y + 1) % ny * nx + x, round_y || y + 1 < ny),
                ((y + ny - 1) % ny * nx + x, round_y || y > 0),
                (y * nx + (x + 1) % nx, round_x || x + 1 < nx),
                (y * nx + (x + nx - 1) % nx, round_x || x > 0),
            ];
            for (j, is_there) in around {
                if is_there && pressure[j] > 0.0 {
                    lowest[i] = lowest[i].min(lowest[j])
                }
            }
        }
        if lowest == before {
            break;
        }
    }
    let mut sizes = vec![0; ny * nx];
    (0..ny * nx).filter(|&i| pressure[i] > 0.0).for_each(|i| sizes[lowest[i]] += 1);
    sizes.retain(|&nodes| nodes > 0);
    sizes.sort_unstable_by(|a, b| b.cmp(a));
    sizes
}

#[test]
fn patches_are_those_of_filling() {
    for shape in [[1, 40], [7, 5], [31, 32], [64, 48]] {
        for level in [-0.8, -0.3, 0.0, 0.3, 0.8] {
            let value = |i: usize| ((i * i) as f64 * 0.7).sin() + level;
            let pressure: Vec<f64> = (0..shape[0] * shape[1]).map(value).collect();
            for periodic in [[true; 2], [true, false], [false, true], [false; 2]] {
                let grid = grid(shape).with_periodic(periodic);
                assert_eq!(Patches::new(&pressure, &grid).sizes(), filled(&pressure, &grid), "{grid:?} {level}");
            }
        }
    }
}
