//! The certificate over the steps, and its plateaus.

use crate::contact::Decision;

/// The certificate has stood still while its best value fell by less than this factor.
const FACTOR: f64 = 2.0;
/// The least share of the steps of a grid that is called a plateau, and the fewest certificates in it.
const SHARE: f64 = 0.1;
const FEWEST: usize = 8;
/// The pace of a plateau is at most this part of the pace of its grid.
const PACE: f64 = 0.25;

/// A certified step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CertifiedStep {
    pub step: usize,
    pub level: usize,
    pub eta: f64,
    pub decision: Option<Decision>,
    /// Whether nodes entered or left the contact since the last one.
    pub has_changed: bool,
}

/// A stretch of steps in which the certificate stood still.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Plateau {
    /// Its first and last step.
    pub steps: [usize; 2],
    /// The best certificate in it.
    pub eta: f64,
    /// The step after it, of the same grid.
    pub next: Option<Next>,
}

/// The step that ended a plateau.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Next {
    /// What the solver did, if it reports it.
    pub decision: Option<Decision>,
    /// Whether nodes entered or left the contact.
    pub has_changed: bool,
}

/// The longest plateau on the finest grid, if there is one.
pub(crate) fn plateau(points: &[CertifiedStep]) -> Option<Plateau> {
    let finest: Vec<&CertifiedStep> = points.iter().filter(|point| point.level == 0 && point.eta.is_finite()).collect();
    let best: Vec<f64> = finest
        .iter()
        .scan(f64::INFINITY, |best, point| {
            *best = best.min(point.eta);
            Some(*best)
        })
        .collect();
    let (first, last) = (finest.first()?, finest.last()?);
    let steps = last.step - first.step;
    let pace = (best[0] / best[best.len() - 1]).ln() / steps.max(1) as f64;
    let mut longest: Option<(usize, usize)> = None;
    let mut end = 0;
    for start in 0..finest.len() {
        end = end.max(start);
        while end + 1 < finest.len() && best[end + 1] * FACTOR > best[start] {
            end += 1;
        }
        let length = |(start, end): (usize, usize)| finest[end].step - finest[start].step;
        if longest.is_none_or(|other| length(other) < length((start, end))) {
            longest = Some((start, end));
        }
    }
    let (start, end) = longest?;
    let length = finest[end].step - finest[start].step;
    let fall = (best[start] / best[end]).ln() / length.max(1) as f64;
    let stands = (length as f64) >= SHARE * steps as f64 && end - start >= FEWEST;
    let is_slow =
        end + 1 == finest.len() && fall * length as f64 <= FACTOR.ln() || FACTOR.ln() / length as f64 <= PACE * pace;
    let next = finest.get(end + 1).map(|next| Next { decision: next.decision, has_changed: next.has_changed });
    (stands && is_slow).then(|| Plateau { steps: [finest[start].step, finest[end].step], eta: best[end], next })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(eta: impl Fn(usize) -> f64, count: usize) -> Vec<CertifiedStep> {
        (0..count)
            .map(|step| CertifiedStep { step, level: 0, eta: eta(step), decision: None, has_changed: step == 60 })
            .collect()
    }

    #[test]
    fn a_stretch_without_progress_is_found_and_steady_progress_is_none() {
        let steady = |step: usize| 10f64.powf(-0.02 * step as f64);
        assert_eq!(plateau(&points(steady, 500)), None);
        let held = |step: usize| {
            10f64.powf(-0.1 * (step.min(20) + step.max(60) - 60) as f64)
                * if step.is_multiple_of(2) { 1.0 } else { 5.0 }
        };
        let found = plateau(&points(held, 100)).unwrap();
        assert_eq!(found.steps[0], 18);
        assert!((60..64).contains(&found.steps[1]) && (found.eta / 1e-2).log10().abs() < 0.4, "{found:?}");
        let end = |step: usize| 10f64.powf(-0.1 * step.min(70) as f64);
        let found = plateau(&points(end, 100)).unwrap();
        assert!(found.steps[1] == 99 && found.next.is_none(), "{found:?}");
    }
}
