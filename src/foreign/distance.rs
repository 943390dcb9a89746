//! The distance of the steps of a run from a reference.

use crate::contact::{Contact, Observer, Step, Wish};
use serde::Serialize;
use std::ops::ControlFlow;

/// The distance of a step from the reference.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Distance {
    /// Number of the step, from 0.
    pub step: usize,
    /// Seconds from the start.
    pub seconds: f64,
    /// The certificate `eta`; NaN where it is not known.
    pub certificate: f64,
    /// Relative error of the pressure, `|p - p*| / |p*|`, by root mean squares over the nodes.
    pub pressure_error: f64,
    /// The same in the energy norm `|x|^2 = <x u(x)>`.
    pub energy_error: f64,
}

/// Measures the distance of each step of a run from a reference on the same grid; steps of other grids are ignored.
pub struct Distances<'a> {
    reference: &'a Contact,
    /// The distances so far.
    pub steps: Vec<Distance>,
}

impl<'a> Distances<'a> {
    /// The distances from a reference, none yet.
    pub fn new(reference: &'a Contact) -> Self {
        Self { reference, steps: Vec::new() }
    }

    fn distance(&self, step: &Step<'_>) -> Distance {
        let Contact { pressure, displacement, .. } = self.reference;
        let (mut square, mut error, mut energy, mut energy_error) = (0.0, 0.0, 0.0, 0.0);
        let reference = pressure.iter().zip(displacement);
        for ((p, u), (p_star, u_star)) in step.pressure().iter().zip(step.displacement()).zip(reference) {
            square += p_star * p_star;
            error += (p - p_star).powi(2);
            energy += p_star * u_star;
            energy_error += (p - p_star) * (u - u_star);
        }
        Distance {
            step: step.index(),
            seconds: step.seconds(),
            certificate: step.certificate().map_or(f64::NAN, |it| it.eta),
            pressure_error: (error / square).sqrt(),
            energy_error: (energy_error.max(0.0) / energy).sqrt(),
        }
    }
}

impl Observer for Distances<'_> {
    fn step(&mut self, step: &Step<'_>) -> Wish {
        if step.problem().surface().grid() == self.reference.problem.surface().grid() {
            self.steps.push(self.distance(step));
        }
        Ok(ControlFlow::Continue(()))
    }
}
