//! The parts of recordings, each a row of the table of its group.

use super::drawing::PartRow;
use super::{chart, field, instrument, patch, profile};

/// All parts, in the order of their panes.
pub(crate) fn all() -> impl Iterator<Item = &'static PartRow> {
    [chart::PARTS, profile::PARTS, field::PARTS, patch::PARTS, instrument::PARTS].into_iter().flatten()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setup::Part;
    use strum::IntoEnumIterator;

    #[test]
    fn each_part_has_one_row() {
        for part in Part::iter() {
            assert_eq!(all().filter(|row| row.part == part).count(), 1, "{part:?}");
        }
    }
}
