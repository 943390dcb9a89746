//! The sums over the nodes that a certificate is made of.

use crate::contact::{Problem, chunks};

/// Sums over pressure `p`, displacement `u` and `v = u - h`. `v` is taken relative to its value at one node in contact, the
/// reference, so that its differences near the solution keep their digits.
#[derive(Clone, Copy)]
pub(super) struct CertificateSums {
    pub reference_v: f64,
    pub pressure: f64,
    pub pressure_v: f64,
    pub elastic: f64,
    pub square_pressure: f64,
    pub square_displacement: f64,
    pub lowest_v: f64,
    pub lowest_pressure: f64,
}

impl CertificateSums {
    /// The sums over no nodes, with the value of `v` at the reference.
    pub(crate) fn none(reference_v: f64) -> Self {
        Self {
            reference_v,
            pressure: 0.0,
            pressure_v: 0.0,
            elastic: 0.0,
            square_pressure: 0.0,
            square_displacement: 0.0,
            lowest_v: f64::INFINITY,
            lowest_pressure: f64::INFINITY,
        }
    }

    /// The sums over all nodes, in one pass.
    pub(crate) fn new(problem: &Problem, pressure: &[f64], displacement: &[f64]) -> Self {
        let height = problem.height();
        let reference = pressure.iter().position(|&p| p > 0.0);
        let none = Self::none(reference.map_or(0.0, |i| displacement[i] - height[i]));
        let parts = chunks::visit(pressure.len(), |range| {
            let mut sums = none;
            for i in range {
                sums.add_displacement(displacement[i], height[i]);
                sums.add_pressure(pressure[i], displacement[i], height[i]);
            }
            sums
        });
        parts.into_iter().fold(none, Self::plus)
    }

    /// Adds what does not depend on the pressure of a node.
    pub(crate) fn add_displacement(&mut self, u: f64, h: f64) {
        self.square_displacement += u * u;
        self.lowest_v = self.lowest_v.min(u - h - self.reference_v);
    }

    /// Adds the pressure of a node.
    pub(crate) fn add_pressure(&mut self, p: f64, u: f64, h: f64) {
        self.pressure += p;
        self.pressure_v += p * (u - h - self.reference_v);
        self.elastic += p * u;
        self.square_pressure += p * p;
        self.lowest_pressure = self.lowest_pressure.min(p);
    }

    /// The sums over both sets of nodes, which have the same reference.
    pub(crate) fn plus(self, other: Self) -> Self {
        Self {
            reference_v: self.reference_v,
            pressure: self.pressure + other.pressure,
            pressure_v: self.pressure_v + other.pressure_v,
            elastic: self.elastic + other.elastic,
            square_pressure: self.square_pressure + other.square_pressure,
            square_displacement: self.square_displacement + other.square_displacement,
            lowest_v: self.lowest_v.min(other.lowest_v),
            lowest_pressure: self.lowest_pressure.min(other.lowest_pressure),
        }
    }
}
