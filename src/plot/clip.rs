//! Lines cut at the edges of the unit square, and into dashes.

/// The parts inside the unit square of the line through `points`; points that are not finite break it.
pub(crate) fn runs(points: &[[f64; 2]]) -> Vec<Vec<[f64; 2]>> {
    let mut runs: Vec<Vec<[f64; 2]>> = Vec::new();
    for [start, end] in points.windows(2).filter_map(|pair| inside(pair[0], pair[1])) {
        match runs.last_mut().filter(|run| run.last() == Some(&start)) {
            Some(run) => run.push(end),
            None => runs.push(vec![start, end]),
        }
    }
    runs
}

/// The part of a segment inside the unit square.
fn inside(start: [f64; 2], end: [f64; 2]) -> Option<[[f64; 2]; 2]> {
    let step = [end[0] - start[0], end[1] - start[1]];
    let mut part = [0.0f64, 1.0];
    for (from, step) in start.into_iter().zip(step) {
        if !step.is_finite() || (step == 0.0 && !(0.0..=1.0).contains(&from)) {
            return None;
        }
        if step != 0.0 {
            let [a, b] = [-from / step, (1.0 - from) / step];
            part = [part[0].max(a.min(b)), part[1].min(a.max(b))];
        }
    }
    let at = |share: f64| [0, 1].map(|i| if share == 1.0 { end[i] } else { start[i] + share * step[i] });
    (part[0] <= part[1]).then(|| part.map(at))
}

/// Dashes of length `on`, `off` apart, along a line.
pub(crate) fn dashes(line: &[[f64; 2]], [on, off]: [f64; 2]) -> Vec<Vec<[f64; 2]>> {
    let mut dashes = Vec::new();
    let mut dash: Vec<[f64; 2]> = line.first().copied().into_iter().collect();
    let (mut is_on, mut left) = (true, on);
    for pair in line.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        let mut gone = 0.0;
        while length - gone > left {
            gone += left;
            let at = [0, 1].map(|i| from[i] + gone / length * (to[i] - from[i]));
            if is_on {
                dash.push(at);
                dashes.push(std::mem::take(&mut dash));
            } else {
                dash = vec![at];
            }
            is_on = !is_on;
            left = if is_on { on } else { off };
        }
        left -= length - gone;
        if is_on {
            dash.push(to);
        }
    }
    dashes.extend((dash.len() > 1).then_some(dash));
    dashes
}
