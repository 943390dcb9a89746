//! Columns of pictures, each for some nodes.

use std::ops::Range;

/// Nodes in at most `most` columns of about the same width.
pub(crate) fn columns(nodes: usize, most: usize) -> impl Iterator<Item = Range<usize>> {
    let count = nodes.min(most);
    (0..count).map(move |i| i * nodes / count..(i + 1) * nodes / count)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_hold_every_node_once() {
        for (nodes, most) in [(5, 8), (1000, 7), (4096, 1024)] {
            let held: Vec<usize> = columns(nodes, most).flatten().collect();
            assert_eq!(held, (0..nodes).collect::<Vec<_>>());
        }
    }
}
