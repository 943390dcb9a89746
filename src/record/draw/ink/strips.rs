//! Many short strips at once.

use rerun::external::arrow::array::{Array, FixedSizeListArray, Float32Array, ListArray};
use rerun::external::arrow::buffer::OffsetBuffer;
use rerun::external::arrow::datatypes::{DataType, Field};
use rerun::{LineStrips2D, SerializedComponentBatch};
use std::ops::Range;
use std::sync::Arc;

/// Strips that are `pieces` of a curve, which may overlap.
///
/// A strip is a list of points in the viewer's columns. Made one by one, a thousand strips of two points take several times
/// as long.
pub(crate) fn strips_of(curve: &[[f32; 2]], pieces: impl Iterator<Item = Range<usize>> + Clone) -> LineStrips2D {
    let item = |of: &DataType| Arc::new(Field::new("item", of.clone(), false));
    let mut values = Vec::with_capacity(2 * (curve.len() + pieces.size_hint().0));
    pieces.clone().for_each(|piece| values.extend_from_slice(curve[piece].as_flattened()));
    let values = Arc::new(Float32Array::from(values));
    let points = FixedSizeListArray::new(item(&DataType::Float32), 2, values, None);
    let lengths = OffsetBuffer::from_lengths(pieces.map(|piece| piece.len()));
    let strips = ListArray::new(item(points.data_type()), lengths, Arc::new(points), None);
    let strips = SerializedComponentBatch::new(Arc::new(strips), LineStrips2D::descriptor_strips());
    LineStrips2D { strips: Some(strips), ..LineStrips2D::update_fields() }
}

/// Strips of two points each.
pub(crate) fn lines_of(lines: &[[[f32; 2]; 2]]) -> LineStrips2D {
    strips_of(lines.as_flattened(), (0..lines.len()).map(|line| 2 * line..2 * line + 2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_are_what_the_viewer_makes_of_strips_one_by_one() {
        let curve: Vec<[f32; 2]> = (0..9u8).map(|i| [f32::from(i), f32::from(i * i)]).collect();
        let pieces = [0..2, 1..5, 4..9, 3..3];
        let one_by_one = LineStrips2D::update_fields().with_strips(pieces.clone().map(|piece| curve[piece].to_vec()));
        assert_eq!(strips_of(&curve, pieces.into_iter()), one_by_one);
        let lines = [[[1.0, 2.0], [3.0, 4.0]], [[5.0, 6.0], [7.0, 8.0]]];
        assert_eq!(lines_of(&lines), LineStrips2D::update_fields().with_strips(lines));
        assert_eq!(lines_of(&[]), LineStrips2D::update_fields().with_strips([[[0.0_f32; 2]; 2]; 0]));
    }
}
