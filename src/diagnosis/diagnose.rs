//! The observer that finds out why a run was slow.

use super::cause::Cause;
use super::contact_history::{ContactChange, ContactHistory};
use super::curve::{CertifiedStep, plateau};
use super::rates::BandRate;
use super::returns::Returns;
use super::ritz::Ritz;
use super::spectrogram::{Reference, Spectrogram};
use crate::contact::{Certificate, Contact, Failure, Observer, Problem, Relaxation, Solver, Status, Step, Stop, Wish};
use crate::grid::Grid;
use serde::Serialize;
use std::fmt;
use std::ops::ControlFlow;
use std::sync::Arc;

/// Relative distance from their final values within which area and `kappa_r` count as settled.
const STANDS: f64 = 0.01;
/// A node flips often that did so more often than this.
const OFTEN: u32 = 8;
/// Number of repetitions from which a cycle is reported.
const ROUNDS: usize = 3;
/// A damping that is too strong or too weak by this factor is reported.
const ILL: f64 = 3.0;
/// Condition number from which masses, or conjugate gradients, are reported as a cause.
const ILL_CONDITIONED: f64 = 50.0;
/// Share of the steps for which a band must be the slowest to be reported.
const LAGS: f64 = 0.2;
/// Decrease in digits per step from which no band counts as slow.
const SWIFT: f64 = 0.5;

/// Observes a run. It reports the causes of slow convergence, and the steps from which the results are settled.
///
/// Of each step it takes one pass over the pressure, area and `kappa_r`, and with a [`Reference`] a transform of the
/// early steps and of later ones less often. Runs are repeatable to the last bit, so the reference is best the final
/// state of the same run made before.
pub struct Diagnosis {
    contact: ContactHistory,
    spectrogram: Spectrogram,
    has_reference: bool,
    has_energies: bool,
    ritz: Ritz,
    /// The Ritz values of the last step.
    values: Option<[f64; 2]>,
    /// The largest condition number seen on each level.
    conditions: Vec<f64>,
    points: Vec<CertifiedStep>,
    change: ContactChange,
    has_changed: bool,
    returns: Returns,
    /// Step, area and `kappa_r` on the finest grid.
    results: Vec<(usize, [f64; 2])>,
    relaxation: Option<Relaxation>,
    stop: Stop,
    ended: Option<(Status, Certificate, usize)>,
}

/// The steps from which area and `kappa_r` are within one per cent of their final values.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Standing {
    /// Step of the relative area.
    pub relative_area: usize,
    /// Step of `kappa_r`.
    pub kappa_r: usize,
    /// Steps of the run.
    pub steps: usize,
}

/// The findings about a run. Their text has one line each.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Findings {
    /// The causes of slow convergence, the main cause first.
    pub causes: Vec<Cause>,
    /// The steps from which its results are settled.
    pub standing: Option<Standing>,
    /// The convergence rates of the waves of each band, longest first; empty without a reference.
    pub rates: Vec<BandRate>,
}

impl Findings {
    /// The rates as a table in Markdown; empty if there are none.
    pub fn table(&self) -> String {
        let word = |rate: Option<f64>| rate.map_or("-".into(), |rate| format!("{rate:.1e}"));
        let row = |it: &BandRate| {
            let [long, short] = it.wavelengths;
            format!(
                "| {short:.2e} to {long:.2e} | {:.0} % | {} | {} |\n",
                100.0 * it.share,
                word(it.rate),
                word(it.theory)
            )
        };
        let rows: String = self.rates.iter().map(row).collect();
        let head = "| wavelength | slowest in | digits per step | in theory, without contact |\n|---|---|---|---|\n";
        if rows.is_empty() { rows } else { format!("{head}{rows}") }
    }
}

impl Diagnosis {
    /// A diagnosis for a run that solves a problem; errors by wavelength need a reference state.
    pub fn new(problem: &Problem, reference: Option<Arc<Reference>>) -> Self {
        Self::on(problem.surface().grid(), problem.contact_modulus(), reference)
    }

    /// The diagnosis of a run on a grid with a contact modulus.
    pub fn on(grid: &Grid, contact_modulus: f64, reference: Option<Arc<Reference>>) -> Self {
        Self {
            contact: ContactHistory::new(grid),
            has_reference: reference.is_some(),
            has_energies: false,
            spectrogram: Spectrogram::new(grid, contact_modulus, reference),
            ritz: Ritz::default(),
            values: None,
            conditions: Vec::new(),
            points: Vec::new(),
            change: ContactChange::default(),
            has_changed: false,
            returns: Returns::default(),
            results: Vec::new(),
            relaxation: None,
            stop: Stop::default(),
            ended: None,
        }
    }

    /// The diagnosis that computes the spectra of the steps even without a reference.
    pub fn with_energies(self) -> Self {
        Self { has_energies: true, ..self }
    }

    /// The contact so far.
    pub fn contact(&self) -> &ContactHistory {
        &self.contact
    }

    /// Nodes that entered and left by the last step.
    pub fn change(&self) -> ContactChange {
        self.change
    }

    /// The extreme Ritz values of the conjugate gradients that the last step belongs to.
    pub fn ritz(&self) -> Option<[f64; 2]> {
        self.values
    }

    /// Errors and energies by wavelength so far.
    pub fn spectrogram(&self) -> &Spectrogram {
        &self.spectrogram
    }

    /// The findings about a run that has ended.
    pub fn findings(&self) -> Findings {
        Findings { causes: self.causes(), standing: self.standing(), rates: self.rates() }
    }

    /// The causes of slow convergence, the main cause first; empty if there is no cause, or before the run has ended.
    pub fn causes(&self) -> Vec<Cause> {
        let Some((status, certificate, _)) = self.ended else { return Vec::new() };
        let main = [self.rounding(status, &certificate), self.cycle(status), self.damping(), self.masses()];
        let rest = [self.slow_band(), self.condition(), self.flips(), plateau(&self.points).map(Cause::from_plateau)];
        main.into_iter().chain(rest).flatten().collect()
    }

    /// The steps from which the results are settled, for a run that has ended.
    pub fn standing(&self) -> Option<Standing> {
        let (_, _, steps) = self.ended?;
        let since = |which: usize| {
            let end = self.results.last()?.1[which];
            let stands = |values: &[f64; 2]| (values[which] - end).abs() <= STANDS * end.abs();
            let moving = self.results.iter().rposition(|(_, values)| !stands(values));
            self.results.get(moving.map_or(0, |last| last + 1)).map(|(step, _)| *step)
        };
        Some(Standing { relative_area: since(0)?, kappa_r: since(1)?, steps })
    }

    fn rounding(&self, status: Status, certificate: &Certificate) -> Option<Cause> {
        let is_missed = status != Status::Converged && certificate.eta > self.stop.tolerance();
        let from = self.points.iter().filter(|point| point.level == 0).min_by(|a, b| a.eta.total_cmp(&b.eta))?.step;
        (is_missed && certificate.eta <= certificate.rounding).then_some(Cause::Rounding {
            tolerance: self.stop.tolerance(),
            eta: certificate.eta,
            rounding: certificate.rounding,
            from,
        })
    }

    fn cycle(&self, status: Status) -> Option<Cause> {
        let cycle = self.returns.cycle().filter(|cycle| cycle.rounds >= ROUNDS && status != Status::Converged)?;
        let times = (cycle.rounds * cycle.period / 2).min(cycle.rounds) as u32;
        let nodes = self.contact.flips().iter().filter(|&&flips| flips >= times).count();
        Some(Cause::from_cycle(cycle, nodes))
    }

    fn damping(&self) -> Option<Cause> {
        let relaxation = self.relaxation?;
        let (damping, best) = (relaxation.damping(), relaxation.best_decades_per_step());
        let is_ill = !(1.0 / ILL..=ILL).contains(&damping);
        is_ill.then(|| Cause::Damping { damping, rate: relaxation.slowest_decades_per_step(), best })
    }

    fn masses(&self) -> Option<Cause> {
        let (condition, best) = self.relaxation.map(|it| (it.condition(), it.best_decades_per_step()))?;
        (condition > ILL_CONDITIONED).then_some(Cause::Masses { condition, best })
    }

    /// The convergence rates of the waves of each band.
    fn rates(&self) -> Vec<BandRate> {
        BandRate::all(&self.spectrogram, self.relaxation)
    }

    /// The band that had the largest error for most steps, if that was for long.
    fn slow_band(&self) -> Option<Cause> {
        let slowest = self.rates().into_iter().max_by(|a, b| a.share.total_cmp(&b.share))?;
        let BandRate { wavelengths, share, rate, theory } = slowest;
        let rate = rate?;
        (share >= LAGS && rate < SWIFT).then_some(Cause::SlowBand { wavelengths, share, rate, theory })
    }

    fn condition(&self) -> Option<Cause> {
        let worst = self.conditions.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
        worst
            .filter(|(_, condition)| *condition > ILL_CONDITIONED)
            .map(|(level, condition)| Cause::Condition { level, condition })
    }

    fn flips(&self) -> Option<Cause> {
        let flips = self.contact.flips();
        let nodes = flips.iter().filter(|&&flips| flips > OFTEN).count();
        let (node, &most) = flips.iter().enumerate().max_by_key(|(node, flips)| (**flips, usize::MAX - node))?;
        (nodes > 0).then(|| Cause::Flips { nodes, times: OFTEN, position: self.contact.position(node), most })
    }
}

impl Observer for Diagnosis {
    fn begin(&mut self, solver: &dyn Solver, problem: &Problem, stop: &Stop) -> Result<(), Failure> {
        self.relaxation = solver.relaxation(problem);
        self.stop = *stop;
        Ok(())
    }

    fn step(&mut self, step: &Step<'_>) -> Wish {
        let phase = step.phase();
        self.change = self.contact.add(step);
        self.has_changed |= self.change.entered + self.change.left > 0;
        self.values = self.ritz.add(step.decision());
        if let Some([low, high]) = self.values {
            self.conditions.resize(self.conditions.len().max(phase.level + 1), 0.0);
            self.conditions[phase.level] = self.conditions[phase.level].max(high / low);
        }
        if let Some(certificate) = step.certificate() {
            let (step, level, eta, decision) = (step.index(), phase.level, certificate.eta, step.decision());
            self.points.push(CertifiedStep { step, level, eta, decision, has_changed: self.has_changed });
            self.has_changed = false;
        }
        if phase.level == 0 && phase.inner == 0 {
            self.returns.add(step.index(), step.pressure());
            let resolved = step.resolved();
            self.results.push((step.index(), [resolved.relative_area, resolved.kappa_r]));
        }
        if self.has_reference || self.has_energies {
            self.spectrogram.add(step);
        }
        Ok(ControlFlow::Continue(()))
    }

    fn end(&mut self, contact: &Contact) -> Result<(), Failure> {
        self.ended = Some((contact.status, contact.certificate, contact.work.iterations));
        Ok(())
    }
}

impl fmt::Display for Findings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { causes, standing, .. } = self;
        if causes.is_empty() {
            writeln!(f, "Nothing slowed it down.")?;
        }
        causes.iter().try_for_each(|cause| writeln!(f, "{cause}"))?;
        let Some(Standing { relative_area, kappa_r, steps }) = standing else { return Ok(()) };
        writeln!(
            f,
            "Area and kappa_r are within 1 % of their final values from steps {relative_area} and {kappa_r} of \
             {steps} on."
        )
    }
}
