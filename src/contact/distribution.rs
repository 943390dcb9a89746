//! Distributions of pressure and gap, and the power spectrum of the pressure.

use crate::contact::{Contact, chunks};
use crate::surface::{Field, PowerSpectrum};
use std::ops::Range;

/// The distribution of a quantity over the nodes of one kind: the pressure of those in contact, or the gap of the others.
///
/// Its integral is the fraction of these nodes, unless some values are above the last bin. At all other nodes the
/// quantity is zero.
///
/// ```
/// use asperity::setup::Setup;
/// let setup = Setup::from_toml("
///     surface = { indenter = { shape = 'sine', amplitude = 0.01 } }
///     grid = { points = 256, size = 1.0 }
///     load = { reduced-pressure = 0.1 }
/// ")?;
/// let contact = setup.solver.solver().solve(&setup.problem()?, &setup.stop, &mut ())?;
/// let pressure = contact.pressure_distribution(20, contact.max_pressure());
/// let share: f64 = pressure.bins().map(|([low, high], density)| density * (high - low)).sum();
/// assert!((share - contact.counted().relative_area).abs() < 1e-12);
/// let gap = contact.gap_distribution(20, contact.max_gap());
/// let share: f64 = gap.bins().map(|([low, high], density)| density * (high - low)).sum();
/// assert!((share + contact.counted().relative_area - 1.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Distribution {
    /// Ends of the bins, which are equally wide, from 0; in the unit of the quantity.
    pub edges: Vec<f64>,
    /// Density in each bin, over the unit of the quantity; 0 if there are no such nodes.
    pub density: Vec<f64>,
}

impl Distribution {
    /// The distribution of the values of `nodes` nodes into `bins` bins up to `largest`; `value` is that of a node, or none of the
    /// other kind.
    fn new(nodes: usize, bins: usize, largest: f64, value: impl Fn(usize) -> Option<f64> + Sync) -> Self {
        let width = largest / bins as f64;
        let counts = |range: Range<usize>| {
            let mut counts = vec![0u64; bins];
            for value in range.filter_map(&value).filter(|value| *value <= largest) {
                counts[((value / width) as usize).min(bins - 1)] += 1;
            }
            counts
        };
        let mut counted = vec![0; bins];
        for part in chunks::visit(nodes, counts) {
            counted.iter_mut().zip(part).for_each(|(sum, count)| *sum += count);
        }
        let density = |count: u64| if largest > 0.0 { count as f64 / (nodes as f64 * width) } else { 0.0 };
        Self {
            edges: (0..=bins).map(|i| i as f64 * width).collect(),
            density: counted.into_iter().map(density).collect(),
        }
    }

    /// The ends of each bin and the density in it.
    pub fn bins(&self) -> impl Iterator<Item = ([f64; 2], f64)> {
        self.edges.windows(2).map(|edges| [edges[0], edges[1]]).zip(self.density.iter().copied())
    }
}

impl Contact {
    /// Distribution of the pressure over the nodes in contact, up to the `largest` one.
    pub fn pressure_distribution(&self, bins: usize, largest: f64) -> Distribution {
        let pressure = values(&self.pressure);
        Distribution::new(pressure.len(), bins, largest, |node| (pressure[node] > 0.0).then_some(pressure[node]))
    }

    /// Distribution of the gap over the nodes that are not in contact, up to the `largest` one.
    pub fn gap_distribution(&self, bins: usize, largest: f64) -> Distribution {
        let [pressure, gap] = [&self.pressure, &self.gap].map(values);
        Distribution::new(gap.len(), bins, largest, |node| (pressure[node] <= 0.0).then(|| gap[node].max(0.0)))
    }

    /// Power spectrum of the pressure: pressure^2 length for lines, pressure^2 length^2 for surfaces.
    pub fn pressure_spectrum(&self) -> PowerSpectrum {
        PowerSpectrum::from_field(self.problem.surface().grid(), values(&self.pressure))
    }
}

/// The values of a field of a contact, row by row.
fn values(field: &Field) -> &[f64] {
    field.as_slice().expect("results are made in standard layout")
}
