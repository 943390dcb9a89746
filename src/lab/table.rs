//! Entries of tables.

/// The points of a grid of some shape: `4096` of a line, `64x64` of a surface.
pub(crate) fn points([ny, nx]: [usize; 2]) -> String {
    if ny == 1 { nx.to_string() } else { format!("{ny}x{nx}") }
}

/// A value that may be missing.
pub(crate) fn or_dash<T>(value: Option<T>, format: impl FnOnce(T) -> String) -> String {
    value.map_or("-".into(), format)
}

/// The median of values in ascending order, of which there is one at the least.
pub(crate) fn median(sorted: &[f64]) -> f64 {
    let n = sorted.len();
    0.5 * (sorted[(n - 1) / 2] + sorted[n / 2])
}
