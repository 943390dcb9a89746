//! Estimated errors of a state by a coarser history.

use super::PlasticState;
use crate::contact::Quantity;

/// By how much a state differs from that of a coarser or a finer history under the same load, or an error that is estimated from that, see
/// [`PlasticErrorSources`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PlasticErrors {
    /// Of the approach, a length.
    pub approach: f64,
    /// Of the depth of the imprint, a length.
    pub imprint_depth: f64,
    /// Of the accumulated plastic strain over all layers, per area of the cell: a length.
    pub total_accumulated: f64,
    /// Of the mean pressure over the nodes in contact, a pressure.
    pub mean_contact_pressure: f64,
    /// The error of the relative area, dimensionless: a difference of areas with edges resolved between the nodes. Areas by counted nodes are often equal where
    /// the contacts are not.
    pub relative_area: f64,
}

/// The estimated errors of a state by their sources. None of them is in the certificate, which is that of one step on its grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlasticErrorSources {
    /// The errors by the load steps, which are of first order: three times the difference from steps of half the length, and at least 0.2 % of the area and
    /// 0.4 % of the imprint where the solid has flowed.
    pub steps: PlasticErrors,
    /// The errors by the layers, from the differences of three histories: in these layers, and in layers of twice and of four times the thickness.
    pub layers: PlasticErrors,
    /// The errors by the grid: the difference from a grid of half as many points along each axis. None where
    /// a number of points is odd, or too small.
    pub grid: Option<PlasticErrors>,
}

impl PlasticErrorSources {
    /// The numbers of a state for imprint and area, as far as they are known.
    pub(super) fn numbers(&self) -> Vec<(Quantity, f64)> {
        let imprint = |it: &PlasticErrors| it.imprint_depth;
        let area = |it: &PlasticErrors| it.relative_area;
        let grid = self.grid.iter().flat_map(|grid| {
            [(Quantity::ImprintGridError, imprint(grid)), (Quantity::RelativeAreaGridError, area(grid))]
        });
        let others = [
            (Quantity::ImprintStepError, imprint(&self.steps)),
            (Quantity::RelativeAreaStepError, area(&self.steps)),
            (Quantity::ImprintLayerError, imprint(&self.layers)),
            (Quantity::RelativeAreaLayerError, area(&self.layers)),
        ];
        others.into_iter().chain(grid).filter(|(_, error)| error.is_finite()).collect()
    }
}

impl PlasticErrors {
    /// Errors that are not known.
    pub(super) const UNKNOWN: Self = Self {
        approach: f64::NAN,
        imprint_depth: f64::NAN,
        total_accumulated: f64::NAN,
        mean_contact_pressure: f64::NAN,
        relative_area: f64::NAN,
    };

    /// Each of them times a factor.
    pub(super) fn times(self, factor: f64) -> Self {
        self.with(self, |error, _| factor * error)
    }

    /// The larger ones of both; NaN where one of them is not known.
    pub(super) fn larger(self, other: Self) -> Self {
        self.with(other, |a, b| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) })
    }

    fn with(self, other: Self, of: impl Fn(f64, f64) -> f64) -> Self {
        Self {
            approach: of(self.approach, other.approach),
            imprint_depth: of(self.imprint_depth, other.imprint_depth),
            total_accumulated: of(self.total_accumulated, other.total_accumulated),
            mean_contact_pressure: of(self.mean_contact_pressure, other.mean_contact_pressure),
            relative_area: of(self.relative_area, other.relative_area),
        }
    }

    /// The differences of a state and that of another history; NaN where one of them is not converged, since they estimate nothing then.
    pub fn between(state: &PlasticState, other: &PlasticState) -> Self {
        let is_known = state.is_converged && other.is_converged;
        let difference = |of: fn(&PlasticState) -> f64| if is_known { (of(state) - of(other)).abs() } else { f64::NAN };
        Self {
            approach: difference(PlasticState::approach),
            imprint_depth: difference(PlasticState::imprint_depth),
            total_accumulated: difference(PlasticState::total_accumulated),
            mean_contact_pressure: difference(PlasticState::mean_contact_pressure),
            relative_area: difference(|state| state.contact.resolved().relative_area),
        }
    }
}
