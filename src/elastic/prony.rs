//! Prony series of viscoelastic solids.

use super::secular::{Pole, zeros_of_compliance, zeros_of_stiffness};
use crate::error::SolidError;

/// A term of a Prony series: a ratio, dimensionless, and a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PronyTerm {
    /// In creep form `f`, the compliance that the term adds in the long run over the glassy compliance. In relaxation
    /// form `g`, the stiffness that the term takes away in the long run over the glassy stiffness. Dimensionless.
    pub ratio: f64,
    /// In creep form the retardation time, in relaxation form the relaxation time; a time.
    pub time: f64,
}

/// A linear viscoelastic solid with one common Poisson's ratio, as a Prony series in creep form, which is the
/// generalised Kelvin solid:
///
/// ```text
/// J(t) E*_0 = 1 + sum_j f_j (1 - exp(-t / tau_j)),    u(t) = A [p + sum_j eps_j],    tau_j d eps_j/dt + eps_j = f_j p
/// ```
///
/// Here `J` is the displacement of the surface by a unit step of the pressure, `E*_0` the glassy contact modulus, which
/// answers fast changes, and `A` the compliance of the elastic solid of that modulus. The fields `eps_j` have the unit
/// of a pressure.
///
/// | quantity | symbol | unit |
/// |---|---|---|
/// | ratio of a term | `f_j` | 1 |
/// | retardation time of a term | `tau_j` | time |
///
/// Finite element codes give the relaxation form `E(t)/E_0 = 1 - sum_j g_j (1 - exp(-t / tau_j))` instead, whose times
/// are shorter: those of a standard linear solid differ by the factor `1 + f`. [`Prony::from_relaxation`] converts it
/// without approximation.
///
/// # Source
/// Ferry, *Viscoelastic Properties of Polymers* (1980), chapter 3; Christensen, *Theory of Viscoelasticity* (1982),
/// section 1.6.
///
/// ```
/// use asperity::elastic::{Prony, PronyTerm};
/// // a standard linear solid that is ten times as compliant in the long run
/// let prony = Prony::new(vec![PronyTerm { ratio: 9.0, time: 1.0 }])?;
/// assert_eq!((prony.creep(0.0), prony.relaxed_ratio()), (1.0, 10.0));
/// // it relaxes ten times as fast as it creeps
/// assert!((prony.to_relaxation()[0].time - 0.1).abs() < 1e-15);
/// # Ok::<(), asperity::error::SolidError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Prony {
    terms: Vec<PronyTerm>,
}

impl Prony {
    /// The solid with the terms of a series in creep form. No terms make an elastic solid. Terms of equal times act as
    /// one term with the sum of the ratios.
    ///
    /// # Errors
    /// [`SolidError::PronyTerm`] for a ratio or a time that is not positive and finite.
    pub fn new(terms: Vec<PronyTerm>) -> Result<Self, SolidError> {
        check(&terms)?;
        Ok(Self { terms })
    }

    /// The solid with the terms of a series in relaxation form, `E(t)/E_0 = 1 - sum_j g_j (1 - exp(-t / tau_j))`, as finite
    /// element codes write it. Terms of equal times are added.
    ///
    /// The stiffness of a slowly growing load `exp(s t)` over the glassy one is the rational function
    /// `1 - sum_j g_j / (1 + s tau_j)`. Its reciprocal is the compliance. So the rates of creep are its zeros, one below each
    /// rate of relaxation, and the ratios follow from its derivatives there. Each zero is found by bisection of its distance
    /// from the nearest pole, so that it has all digits also where two times are nearly equal.
    ///
    /// # Errors
    /// [`SolidError::PronyTerm`] for a ratio or a time that is not positive and finite, [`SolidError::PronySum`] for ratios
    /// whose sum is 1 or more, which leave no stiffness in the long run.
    ///
    /// ```
    /// use asperity::elastic::{Prony, PronyTerm};
    /// let prony = Prony::from_relaxation(&[PronyTerm { ratio: 0.9, time: 0.1 }])?;
    /// let [term] = prony.terms() else { panic!("one term becomes one term") };
    /// assert!((term.ratio - 9.0).abs() < 1e-13 && (term.time - 1.0).abs() < 1e-14);
    /// # Ok::<(), asperity::error::SolidError>(())
    /// ```
    pub fn from_relaxation(terms: &[PronyTerm]) -> Result<Self, SolidError> {
        check(terms)?;
        let left = 1.0 - compensated_sum(terms.iter().map(|term| term.ratio));
        if left <= 0.0 {
            return Err(SolidError::PronySum { sum: 1.0 - left });
        }
        // the difference once more, with the digits that the sum has lost
        let left = compensated_sum(std::iter::once(1.0).chain(terms.iter().map(|term| -term.ratio)));
        Ok(Self { terms: from_zeros(zeros_of_stiffness(&merged(terms), left)) })
    }

    /// The terms of the same solid in relaxation form, whose rates are the zeros of the compliance. Terms of equal times
    /// are added first.
    pub fn to_relaxation(&self) -> Vec<PronyTerm> {
        from_zeros(zeros_of_compliance(&merged(&self.terms)))
    }

    /// The terms in creep form.
    pub fn terms(&self) -> &[PronyTerm] {
        &self.terms
    }

    /// `J(t) E*_0`, the displacement under a unit step of the pressure at time 0 over the immediate one; dimensionless, 0
    /// before the step.
    pub fn creep(&self, time: f64) -> f64 {
        if time < 0.0 {
            return 0.0;
        }
        1.0 - self.terms.iter().map(|term| term.ratio * (-time / term.time).exp_m1()).sum::<f64>()
    }

    /// `E(t)/E_0`, the pressure of a fixed contact after a unit step of the displacement at time 0 over the immediate one;
    /// dimensionless, 0 before the step.
    ///
    /// The series is converted anew in each call: use [`Prony::to_relaxation`] for many times.
    pub fn relaxation(&self, time: f64) -> f64 {
        if time < 0.0 {
            return 0.0;
        }
        1.0 + self.to_relaxation().iter().map(|term| term.ratio * (-time / term.time).exp_m1()).sum::<f64>()
    }

    /// The complex compliance at an angular frequency over the glassy one, real and imaginary part:
    /// `1 + sum_j f_j / (1 + i omega tau_j)`. The imaginary part is not positive for positive frequencies: the displacement lags.
    pub fn compliance(&self, angular_frequency: f64) -> [f64; 2] {
        self.terms.iter().fold([1.0, 0.0], |[re, im], term| {
            let phase = angular_frequency * term.time;
            // phase / (1 + phase^2) without overflow
            let lag = if phase.abs() > 1.0 { 1.0 / (phase + 1.0 / phase) } else { phase / (1.0 + phase * phase) };
            [re + term.ratio / (1.0 + phase * phase), im - term.ratio * lag]
        })
    }

    /// `1 + sum_j f_j`, the compliance in the long run over the glassy one: the relaxed contact modulus is `E*_0` divided by
    /// this.
    pub fn relaxed_ratio(&self) -> f64 {
        1.0 + self.terms.iter().map(|term| term.ratio).sum::<f64>()
    }

    /// The shortest time of a term, if there is one.
    pub fn shortest_time(&self) -> Option<f64> {
        self.terms.iter().map(|term| term.time).min_by(f64::total_cmp)
    }
}

fn check(terms: &[PronyTerm]) -> Result<(), SolidError> {
    let is_good = |value: f64| value.is_finite() && value >= f64::MIN_POSITIVE;
    match terms.iter().find(|term| !(is_good(term.ratio) && is_good(term.time))) {
        Some(&PronyTerm { ratio, time }) => Err(SolidError::PronyTerm { ratio, time }),
        None => Ok(()),
    }
}

/// The poles by falling times, so by growing rates. Those of equal times are one.
fn merged(terms: &[PronyTerm]) -> Vec<Pole> {
    let mut sorted = terms.to_vec();
    sorted.sort_by(|a, b| b.time.total_cmp(&a.time));
    let mut poles: Vec<Pole> = Vec::new();
    for PronyTerm { ratio, time } in sorted {
        match poles.last_mut() {
            Some(last) if last.time == time => last.ratio += ratio,
            _ => poles.push(Pole { ratio, time }),
        }
    }
    poles
}

/// The terms by growing times. A ratio below the range of doubles counts as none.
fn from_zeros(zeros: Vec<Pole>) -> Vec<PronyTerm> {
    let terms = zeros.into_iter().rev().map(|Pole { ratio, time }| PronyTerm { ratio, time });
    terms.filter(|term| term.ratio >= f64::MIN_POSITIVE).collect()
}

/// The sum with the rounding of its additions made up for (Neumaier).
fn compensated_sum(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, lost) = values.fold((0.0_f64, 0.0), |(sum, lost), value| {
        let next = sum + value;
        let rest = if sum.abs() >= value.abs() { (sum - next) + value } else { (value - next) + sum };
        (next, lost + rest)
    });
    sum + lost
}
