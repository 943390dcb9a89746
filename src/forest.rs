//! Disjoint sets that are joined.

/// Disjoint sets of items; each set is a tree, and its root represents it.
pub(crate) struct Forest {
    parent: Vec<usize>,
}

impl Forest {
    /// Each of the items in a set of its own.
    pub(crate) fn new(items: usize) -> Self {
        Self { parent: (0..items).collect() }
    }

    /// The root over an item; the path there is halved on the way, so that later searches are short.
    pub(crate) fn root(&mut self, mut item: usize) -> usize {
        while self.parent[item] != item {
            self.parent[item] = self.parent[self.parent[item]];
            item = self.parent[item];
        }
        item
    }

    /// Joins the sets of two items under the earlier root, and says whether they were two sets.
    pub(crate) fn join(&mut self, a: usize, b: usize) -> bool {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a.max(b)] = a.min(b);
        a != b
    }
}
