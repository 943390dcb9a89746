//! Filled areas in flat views of the viewer, which know only lines: bars so close that they touch.

/// Bars under a curve.
const BARS: usize = 512;

/// Bars side by side from `left` to `right`, as one strip that runs up and down: `ends(i, x)` are the ends of bar `i`, which
/// stands at `x`. Bars whose ends are not finite are left out.
pub(crate) fn zigzag([left, right]: [f32; 2], bars: usize, ends: impl Fn(usize, f32) -> [f32; 2]) -> Vec<[f32; 2]> {
    let bar = |i: usize| {
        let x = left + (i as f32 + 0.5) / bars as f32 * (right - left);
        let [start, end] = ends(i, x);
        if i.is_multiple_of(2) { [[x, start], [x, end]] } else { [[x, end], [x, start]] }
    };
    (0..bars).map(bar).filter(|bar| bar.iter().all(|end| end[1].is_finite())).flatten().collect()
}

/// Bars of a convex shape, about `pitch` apart and so much shorter that lines of width `pitch` do not stick out.
pub(crate) fn shape(corners: &[[f32; 2]], pitch: f32) -> Vec<[f32; 2]> {
    let ends = |values: &mut dyn Iterator<Item = f32>| {
        values.fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
    };
    let sides = || corners.iter().zip(corners.iter().cycle().skip(1));
    let [left, right] = ends(&mut corners.iter().map(|corner| corner[0]));
    let bars = ((right - left) / pitch).ceil().max(1.0) as usize;
    zigzag([left, right], bars, |_, x| {
        let crossing = |(from, to): (&[f32; 2], &[f32; 2])| {
            let share = (x - from[0]) / (to[0] - from[0]);
            (0.0..=1.0).contains(&share).then(|| from[1] + share * (to[1] - from[1]))
        };
        let [top, bottom] = ends(&mut sides().filter_map(crossing));
        let reach = (0.5 * (bottom - top) - 0.7 * pitch).max(0.0);
        [top.midpoint(bottom) - reach, top.midpoint(bottom) + reach]
    })
}

/// Lines from side to side of what lies within closed outlines, at most `pitch` below one another and two at least: inside is where outlines go around once
/// more in one sense than in the other, as those of letters do.
pub(crate) fn spans(outlines: &[Vec<[f64; 2]>], pitch: f64) -> Vec<[[f64; 2]; 2]> {
    let ends = outlines
        .iter()
        .flatten()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [_, y]| [low.min(*y), high.max(*y)]);
    let rows = if ends[0] < ends[1] { ((ends[1] - ends[0]) / pitch).ceil().max(2.0) as usize } else { 0 };
    let step = (ends[1] - ends[0]) / rows as f64;
    (0..rows).flat_map(|row| spans_at(outlines, ends[0] + (row as f64 + 0.5) * step)).collect()
}

/// The spans at a height.
fn spans_at(outlines: &[Vec<[f64; 2]>], y: f64) -> Vec<[[f64; 2]; 2]> {
    let sides = outlines.iter().flat_map(|outline| outline.iter().zip(outline.iter().cycle().skip(1)));
    let crossing = |(from, to): (&[f64; 2], &[f64; 2])| {
        let sense = i32::from(to[1] > y) - i32::from(from[1] > y);
        (sense != 0).then(|| (from[0] + (y - from[1]) / (to[1] - from[1]) * (to[0] - from[0]), sense))
    };
    let mut crossings: Vec<(f64, i32)> = sides.filter_map(crossing).collect();
    crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut turns = 0;
    let inside = crossings.windows(2).filter(|pair| {
        turns += pair[0].1;
        turns != 0
    });
    inside.map(|pair| [[pair[0].0, y], [pair[1].0, y]]).collect()
}

/// Radius of the bars under a curve over `0..width`, wide enough that neighbours overlap.
pub(crate) fn radius(width: f32) -> f32 {
    0.9 * width / BARS as f32
}

/// Bars between a curve over `0..width` and `edge`. `outer` picks of two heights the one nearer to the edge, so that no bar
/// crosses the curve.
pub(crate) fn under(curve: &[[f32; 2]], width: f32, edge: f32, outer: fn(f32, f32) -> f32) -> Vec<[f32; 2]> {
    let tips = tips(curve, width / BARS as f32, outer);
    zigzag([0.0, width], BARS, |i, _| [tips[i], edge])
}

/// The outermost height of the curve within each bar; NaN where there is no curve.
fn tips(curve: &[[f32; 2]], bar: f32, outer: fn(f32, f32) -> f32) -> Vec<f32> {
    let mut tips = vec![f32::NAN; BARS];
    for &[x, y] in curve {
        let tip = &mut tips[((x / bar) as usize).min(BARS - 1)];
        *tip = outer(*tip, y);
    }
    for piece in curve.windows(2) {
        let ([left, start], [right, end]) = (piece[0], piece[1]);
        let centres = |x: f32| ((x / bar + 0.5) as usize).min(BARS);
        for (i, tip) in tips.iter_mut().enumerate().take(centres(right)).skip(centres(left)) {
            let along = ((i as f32 + 0.5) * bar - left) / (right - left);
            *tip = outer(*tip, start + (end - start) * along);
        }
    }
    tips
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_touch_sparse_and_dense_curves_and_never_cross_them() {
        let sparse = tips(&[[0.0, 0.0], [512.0, 512.0]], 1.0, f32::max);
        assert!(sparse.iter().take(511).enumerate().all(|(i, tip)| (tip - (i as f32 + 0.5)).abs() < 1e-3));
        let dense: Vec<[f32; 2]> = (0..=5120).map(|i| [i as f32 / 10.0, if i == 777 { -9.0 } else { 1.0 }]).collect();
        assert_eq!(tips(&dense, 1.0, f32::min)[77], -9.0);
        assert!(tips(&dense, 1.0, f32::min).iter().all(|tip| *tip <= 1.0));
    }

    #[test]
    fn bars_run_up_and_down_from_end_to_end() {
        let bars = zigzag([2.0, 7.0], 5, |i, _| [if i == 1 { f32::NAN } else { 0.0 }, 1.0]);
        assert_eq!(bars.len(), 8);
        assert_eq!((bars[0], bars[1], bars[2]), ([2.5, 0.0], [2.5, 1.0], [4.5, 0.0]));
        assert_eq!(bars[7][0], 6.5);
    }

    #[test]
    fn spans_fill_what_lies_within_and_leave_holes_free() {
        let square = |low: f64, high: f64| vec![[low, low], [high, low], [high, high], [low, high]];
        let hole: Vec<[f64; 2]> = square(4.0, 6.0).into_iter().rev().collect();
        let length = |spans: &[[[f64; 2]; 2]]| spans.iter().map(|[from, to]| to[0] - from[0]).sum::<f64>();
        let ring = spans(&[square(0.0, 10.0), hole], 1.0);
        assert_eq!((ring.len(), length(&ring)), (12, 96.0));
        let both = spans(&[square(0.0, 10.0), square(4.0, 6.0)], 1.0);
        assert_eq!(length(&both), 100.0, "what outlines of one sense share is inside");
        assert!(spans(&[], 1.0).is_empty());
    }

    #[test]
    fn shapes_are_filled_from_side_to_side() {
        let line = shape(&[[0.0, 0.0], [12.0, 0.0], [12.0, 6.0], [0.0, 6.0]], 1.0);
        assert_eq!(line.len(), 2 * 12);
        for (point, expected) in line.iter().zip([[0.5, 0.7], [0.5, 5.3], [1.5, 5.3], [1.5, 0.7]]) {
            assert!((0..2).all(|i| (point[i] - expected[i]).abs() < 1e-5), "{line:?}");
        }
        let triangle = shape(&[[0.0, 0.0], [3.0, 3.0], [0.0, 3.0]], 1.0);
        assert!(triangle.len() == 2 * 3 && triangle.iter().all(|[x, y]| (*x..3.0).contains(y)), "{triangle:?}");
    }
}
