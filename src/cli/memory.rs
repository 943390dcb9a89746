//! Memory: what a command needs, and what there is.

use super::method::Method;
use super::usage;
use anyhow::Result;
use asperity::Grid;

/// Fields of doubles that a solve by `method` holds at its peak when the share `contact` of the nodes touches: those that
/// the documentation of the solvers states, the heights, and a field for each half-space. The result takes three besides the
/// heights.
pub fn fields(method: Method, grid: &Grid, contact: f64) -> f64 {
    let extension = if grid.is_line() { 2.0 } else { 2.0 / 3.0 };
    let solver: f64 = match method {
        Method::Multilevel => 2.0 + extension + 8.0 * contact,
        Method::PolonskyKeer => 7.0,
        Method::Gfmd => 10.0,
    };
    1.0 + solver.max(3.0)
}

/// Bytes of so many fields.
pub fn bytes(fields: f64, grid: &Grid) -> f64 {
    fields * size_of::<f64>() as f64 * grid.len() as f64
}

/// Bytes that are free, where the system tells.
#[cfg(target_os = "linux")]
pub fn available() -> Option<f64> {
    use procfs::{Current, Meminfo};
    Meminfo::current().ok().and_then(|memory| memory.mem_available).map(|bytes| bytes as f64)
}

/// Bytes that are free: this system does not tell.
#[cfg(not(target_os = "linux"))]
pub fn available() -> Option<f64> {
    None
}

/// Refuses a grid on which `what` needs more than is free, or than the system grants.
pub fn check(grid: &Grid, what: &str, fields: f64) -> Result<()> {
    let needed = bytes(fields, grid);
    let refuse = |than: &str| {
        let [ny, nx] = grid.shape();
        let needed = words(needed);
        usage(format!(
            "a grid of {ny} x {nx} points does not fit in memory: {what} needs at least {needed}, {than}: give fewer points"
        ))
    };
    if let Some(free) = available().filter(|free| needed > *free) {
        return refuse(&format!("and {} are free", words(free)));
    }
    let mut reserved = Vec::<u8>::new();
    let granted = reserved.try_reserve_exact(needed as usize);
    std::hint::black_box(reserved);
    granted.or_else(|_| refuse("more than the system grants"))
}

/// A number of bytes, for reading.
pub fn words(bytes: f64) -> String {
    let (unit, name) = match bytes {
        ..1e6 => (1e3, "kB"),
        ..1e9 => (1e6, "MB"),
        ..1e12 => (1e9, "GB"),
        _ => (1e12, "TB"),
    };
    let value = bytes / unit;
    if value < 10.0 { format!("{value:.1} {name}") } else { format!("{value:.0} {name}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_read_well() {
        let read: Vec<String> = [200.0, 57_300.0, 2.1e6, 9.99e8, 5.6e11, 1e13].map(words).into();
        assert_eq!(read, ["0.2 kB", "57 kB", "2.1 MB", "999 MB", "560 GB", "10 TB"]);
    }

    #[test]
    fn what_exceeds_memory_is_refused_in_numbers() {
        let grid = Grid::surface([1 << 17, 1 << 17], [1.0, 1.0]).unwrap();
        let refused = check(&grid, "a test", 1e4).unwrap_err().to_string();
        assert!(refused.contains("131072 x 131072 points") && refused.contains("1374 TB"), "{refused}");
        assert!(check(&Grid::line(4, 1.0).unwrap(), "a test", 5.0).is_ok());
    }
}
