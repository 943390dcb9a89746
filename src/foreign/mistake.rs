//! Everyday errors, recognised from the numbers.

use super::claim::Claim;
use super::correction::{ClaimCorrection, MistakeKind};
use super::factor::Factor;
use super::fault::Fault;
use super::given_field::GivenField;
use serde::Serialize;

/// The largest fault of a claim that counts as a solution.
const SOUND: f64 = 0.01;
/// By how many times an error must make the fault larger to be recognised, and by how many times it may be behind the one that does
/// most.
const FAR: f64 = 10.0;
/// Fewer nodes under load fit a surface by themselves, if only it is turned or stretched.
const FEWEST: f64 = 12.0;

/// An everyday error that explains why a claim fails: without it the claim holds, or comes close to that.
///
/// # How it is recognised
/// Each error is undone in turn, and the claim is certified again, by a transform pair or two.
/// What counts is its fault, of first order in the error of the pressure: the largest of the bound of its relative
/// error in the energy norm, the share of tension, and the relative error of the load. An error is recognised where the
/// fault falls tenfold, and to at most 0.01, with a load that is spread over a dozen nodes. Errors are tried alone
/// first, and in pairs if none explains it alone. Those that explain it equally well, as flipped heights and a shift by
/// half the cell of a sine do, are all reported.
///
/// A result that is just not converged does not fit anything else either, so nothing is found. A factor is the one with which the
/// surface is level under the pressure, by least squares, or with which pressure and gap do no work; factors within 3 % of 1 are
/// left to lack of convergence.
///
/// | error             | what is undone                                             |
/// |-------------------|------------------------------------------------------------|
/// | `heights`         | peaks that point away from the solid                       |
/// | `sign`            | tension positive, displacement out of the solid, or a negative gap |
/// | `quantity`        | a gap for a displacement, or the reverse                   |
/// | `pressure-factor` | forces per node or per width, units                        |
/// | `modulus`         | 2, `1 - nu^2`, units; a cell of another size looks the same |
/// | `arrangement`     | transposed, backwards, or shifted by half the cell or by one or two nodes |
/// | `load`            | pressures that carry another load than the prescribed one  |
/// | `boundary`        | a periodic cell for a free one, or the reverse             |
/// | `kernel`          | waves as stiff as `\|qx\| + \|qy\|` in place of `\|q\|`        |
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Mistake {
    /// Short names of the errors: one, or two that come together.
    pub errors: Vec<&'static str>,
    /// What is wrong and how to mend it.
    pub sentence: String,
    /// The certificate `eta` without the errors.
    pub certificate: f64,
    /// The bound of the relative error of the pressure without the errors.
    pub pressure_error_bound: f64,
}

/// A claim without some errors.
struct CorrectedClaim {
    changes: Vec<ClaimCorrection>,
    fault: Fault,
}

impl Claim {
    /// The everyday errors that explain why the claim fails, each a sentence with what to do; none where it holds, or
    /// fails for another reason. Poisson's ratios of the solid, if known, explain some of the factors. On other solids than half-spaces and
    /// with a hardness none is looked for.
    pub fn mistakes(&self, poisson: &[f64]) -> Vec<Mistake> {
        if !self.is_plain() {
            return Vec::new();
        }
        let given = Fault::from_claim(self).map_or(f64::INFINITY, |fault| fault.size);
        let explains =
            |trial: &CorrectedClaim| trial.fault.size <= SOUND.min(given / FAR) && trial.fault.nodes >= FEWEST;
        let kinds = MistakeKind::all(self.surface.grid());
        let alone: Vec<CorrectedClaim> =
            kinds.iter().filter_map(|kind| CorrectedClaim::new(self, &[*kind])).filter(explains).collect();
        let after = |first: MistakeKind| kinds.iter().filter(move |second| first.goes_with(**second));
        let pairs = || kinds.iter().flat_map(|first| after(*first).map(|second| [*first, *second]));
        let trials = match alone.is_empty() {
            true => pairs().filter_map(|pair| CorrectedClaim::new(self, &pair)).filter(explains).collect(),
            false => alone,
        };
        self.reported(trials, poisson)
    }

    /// The best trials, in words. If some factors have a known cause, only these are reported.
    fn reported(&self, trials: Vec<CorrectedClaim>, poisson: &[f64]) -> Vec<Mistake> {
        let best = trials.iter().map(|trial| trial.fault.size).fold(f64::INFINITY, f64::min);
        let factor = |trial: &CorrectedClaim| trial.changes.iter().find_map(|change| self.factor(change, poisson));
        let is_known = trials.iter().filter_map(factor).any(|factor| factor.is_known());
        let is_reported = |trial: &&CorrectedClaim| {
            trial.fault.size <= FAR * best && factor(trial).is_none_or(|factor| factor.is_known() || !is_known)
        };
        trials.iter().filter(is_reported).map(|trial| self.mistake(trial, poisson)).collect()
    }

    /// The factor of an error that has one.
    fn factor(&self, ClaimCorrection { kind, factor }: &ClaimCorrection, poisson: &[f64]) -> Option<Factor> {
        match kind {
            MistakeKind::Modulus => Some(Factor::from_modulus(*factor, poisson)),
            MistakeKind::Scale => Some(Factor::from_pressure(*factor, self.surface.grid())),
            _ => None,
        }
    }

    fn mistake(&self, trial: &CorrectedClaim, poisson: &[f64]) -> Mistake {
        let sentences: Vec<String> = trial.changes.iter().map(|change| self.sentence(change, poisson)).collect();
        let certificate = trial.fault.certificate;
        Mistake {
            errors: trial.changes.iter().map(|change| change.kind.name()).collect(),
            sentence: format!(
                "{}; with this change the certificate is {:.1e}",
                sentences.join("; and "),
                certificate.eta
            ),
            certificate: certificate.eta,
            pressure_error_bound: certificate.pressure_error_bound,
        }
    }

    /// What is wrong, and what to do.
    fn sentence(&self, change: &ClaimCorrection, poisson: &[f64]) -> String {
        let name = self.quantity.name();
        if let Some(factor) = self.factor(change, poisson) {
            return factor.sentence();
        }
        match change.kind {
            MistakeKind::Arrangement(order) => {
                let remedy = order.remedy(name, self.surface.grid());
                format!("the {name}s {} relative to the heights: give {remedy}", order.words())
            }
            MistakeKind::Quantity if self.quantity == GivenField::Gap => {
                "the field is the displacement, not the gap: give it with --displacement".into()
            }
            MistakeKind::Quantity => "the field is the gap, not the displacement: give it with --gap".into(),
            MistakeKind::Load => {
                let prescribed = self.problem().ok().and_then(|it| it.mean_pressure()).unwrap_or(f64::NAN);
                format!("the pressures carry {:.4e}, but {prescribed:.4e} is prescribed: give the same load to both", self.mean())
            }
            MistakeKind::Boundary => match self.surface.grid().is_periodic() {
                true => "the pressures are those of a cell without images, but the boundary is periodic: give a free boundary".into(),
                false => "the pressures are those of a periodic cell, but the boundary is free: give a periodic boundary".into(),
            },
            MistakeKind::Kernel => {
                format!("the {name}s are those of a solid whose waves are as stiff as |qx| + |qy|: compute them with |q| = sqrt(qx^2 + qy^2)")
            }
            MistakeKind::Heights => {
                "the heights have the wrong sign: give -height, so that peaks towards the solid are positive".into()
            }
            _ => match self.quantity {
                GivenField::Pressure => "the pressures are negative in compression: give -pressure".into(),
                GivenField::Gap => "the gaps are negative where the surfaces are apart: give -gap".into(),
                GivenField::Displacement => {
                    "the displacements are positive out of the solid: give -displacement".into()
                }
            },
        }
    }
}

impl CorrectedClaim {
    /// The claim without errors of some kinds, if they make a difference.
    fn new(claim: &Claim, kinds: &[MistakeKind]) -> Option<Self> {
        let mut trial = (claim.clone(), Vec::new());
        for kind in kinds {
            let (claim, change) = kind.undone(&trial.0)?;
            trial.0 = claim;
            trial.1.push(change);
        }
        let (claim, changes) = trial;
        Some(Self { changes, fault: Fault::from_claim(&claim)? })
    }
}
