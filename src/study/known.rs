//! Points of a table, grouped by realisation.

use super::identity::{Identity, RowKey, key_of};
use super::point::Point;
use std::collections::HashMap;

/// Points of a table by the keys of their realisations.
pub(super) struct Known<'a>(HashMap<RowKey, Vec<&'a Point>>);

impl<'a> Known<'a> {
    /// Points in the order of their table.
    pub(crate) fn new(points: &'a [Point]) -> Self {
        let mut known: HashMap<RowKey, Vec<&Point>> = HashMap::new();
        points.iter().for_each(|point| known.entry(key_of(point)).or_default().push(point));
        Self(known)
    }

    /// The points of each realisation, if they are all there.
    pub(crate) fn find_all(&self, identities: &[Identity<'_>]) -> Vec<Option<Vec<Point>>> {
        identities.iter().map(|identity| identity.find(self.with_key_of(identity))).collect()
    }

    /// The points with the key of a realisation.
    pub(crate) fn with_key_of(&self, identity: &Identity<'_>) -> &[&'a Point] {
        self.0.get(&identity.key()).map_or(&[], Vec::as_slice)
    }

    /// The number of points that belong to none of the realisations.
    pub(crate) fn foreign(&self, identities: &[Identity<'_>]) -> usize {
        let mut by_key: HashMap<RowKey, Vec<&Identity<'_>>> = HashMap::new();
        identities.iter().for_each(|identity| by_key.entry(identity.key()).or_default().push(identity));
        let is_foreign = |key: &RowKey, point: &Point| {
            by_key.get(key).is_none_or(|identities| !identities.iter().any(|identity| identity.includes(point)))
        };
        self.0.iter().map(|(key, points)| points.iter().filter(|point| is_foreign(key, point)).count()).sum()
    }
}
