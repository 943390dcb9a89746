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
pub fn strips_of(curve: &[[f32; 2]], pieces: impl Iterator<Item = Range<usize>> + Clone) -> LineStrips2D {
    let item = |of: &DataType| Arc::new(Field::new("item", of.clone(), false));
    let values: Float32Array = pieces.clone().flat_map(|piece| curve[piece].as_flattened()).copied().collect();
    let points = FixedSizeListArray::new(item(&DataType::Float32), 2, Arc::new(values), None);
    let lengths = OffsetBuffer::from_lengths(pieces.map(|piece| piece.len()));
    let strips = ListArray::new(item(points.data_type()), lengths, Arc::new(points), None);
    let strips = SerializedComponentBatch::new(Arc::new(strips), LineStrips2D::descriptor_strips());
    LineStrips2D { strips: Some(strips), ..LineStrips2D::update_fields() }
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
    }
}
