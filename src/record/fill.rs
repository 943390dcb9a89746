//! Filled areas in 2-D views, which know only lines: bars so close that they touch.

/// Number of bars.
const BARS: usize = 512;

/// Radius of the bars of a picture of `width`, wide enough that neighbours overlap.
pub fn radius(width: f32) -> f32 {
    0.9 * width / BARS as f32
}

/// Bars between a curve over `0..width` and `edge`, as one strip that runs up and down. `outer` picks of two heights the one
/// nearer to the edge, so that no bar crosses the curve.
pub fn bars(curve: &[[f32; 2]], width: f32, edge: f32, outer: fn(f32, f32) -> f32) -> Vec<[f32; 2]> {
    let bar = width / BARS as f32;
    let tips = tips(curve, bar, outer).into_iter().enumerate();
    let ends = |(i, tip): (usize, f32)| {
        let x = (i as f32 + 0.5) * bar;
        if i % 2 == 0 { [[x, tip], [x, edge]] } else { [[x, edge], [x, tip]] }
    };
    tips.filter(|(_, tip)| tip.is_finite()).flat_map(ends).collect()
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
}
