//! A state of a solid that has yielded below its surface.

use super::PlasticSolid;
use super::pressing::Pressing;
use crate::contact::{Contact, CutLayers, FieldKind, Load, StateField};
use crate::elastic::DepthLayers;
use crate::surface::Field;
use ndarray::{Array2, Array3, Axis};

/// The part of the elastic strain at yield up to which an accumulated strain is negligible.
const NEGLIGIBLE: f64 = 1e-3;

/// The largest part of the energy that is taken up and stored by which the work of the load may differ from it, to be told.
const LARGEST_IMBALANCE: f64 = 1e-2;

/// How far a load step is from the minimum of its energy, all per area of the cell (pressure times length), and relative.
///
/// A load step is one convex minimum: of all increments `x` of the plastic strain, the one with the least
/// `Phi(x) = W(e + x) + sum_j h_j <psi(x)>`, where `W` is the energy of solid and load in the contact that belongs to the strain. Its gradient is minus the stress
/// deviator `s`. By Fenchel's inequality the distance from the minimum is at most
///
/// ```text
/// Phi(x) - Phi* <= <p (g - min g)> + sum_j h_j <psi(x) + psi*(s) - s : x>,    psi*(s) = max(s_eq - k, 0)^2 / (2 (H + C))
/// ```
///
/// for *any* pressure `p >= 0` that carries the load, with the gap `g = A p + u^r - h` and the stress that belong to it. So contacts that are solved within
/// the step may be inexact. With the exact increment `x*` also `(H + C)/3 sum_j h_j <|x - x*|^2> <= Phi(x) - Phi*`.
///
/// It says nothing about the finite grid, the layers, and the finite load step, whose errors are others.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PlasticCertificate {
    /// The first term: what is missing in the contact.
    pub contact_gap: f64,
    /// The second term: what is missing in the flow.
    pub flow_gap: f64,
    /// The sum of both over the energy that flow has dissipated in the step plus a thousandth of the elastic energy: the goal of a step.
    pub relative_gap: f64,
    /// The dissipated energy of the step by which it was divided.
    pub dissipated: f64,
}

impl PlasticCertificate {
    /// The bound of the distance from the minimum, `Phi(x) - Phi*`, an energy per area.
    pub fn gap(&self) -> f64 {
        self.contact_gap + self.flow_gap
    }
}

/// Energies of a contact with a solid that yields, per area of the cell, pressure times length.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PlasticEnergy {
    /// The elastic energy that is stored, by the pressure and by the residual stress: `<p A p>/2 - sum_j h_j <e S e>/2`. As everywhere on a
    /// periodic half-space, the uniform pressure stores none.
    pub elastic: f64,
    /// The energy that flow has taken up so far, also that of kinematic hardening, which is stored.
    pub plastic: f64,
    /// The work of the load so far, from loads and approaches: of a step without flow the change of the elastic energy, of one with flow the mean of two
    /// orders in which load and flow may come. It equals `elastic + plastic`, except for the error of long steps.
    pub work: f64,
    /// By how much the work of each step differs from the change of `elastic + plastic` in it, the sum of the magnitudes.
    pub imbalance: f64,
}

impl PlasticEnergy {
    /// The work of the load, if what flow has taken up and what is stored account for it within 1 %: else the steps are too long to tell it.
    pub fn balanced_work(&self) -> Option<f64> {
        (self.imbalance <= LARGEST_IMBALANCE * (self.elastic + self.plastic)).then_some(self.work)
    }
}

/// A contact with a solid that has yielded below its surface.
///
/// | field | shape | unit | meaning |
/// |---|---|---|---|
/// | `contact.pressure` | `(ny, nx)` | pressure | `p` |
/// | `contact.displacement` | `(ny, nx)` | length | the whole displacement `A p + u^r` |
/// | `residual` | `(ny, nx)` | length | `u^r`, what the plastic strain displaces: the imprint as it would be without load |
/// | `strain` | `(layers, components, nodes)` | 1 | plastic strain `e`, see [`DepthResponse`](crate::elastic::DepthResponse) |
/// | `accumulated` | `(layers, nodes)` | 1 | accumulated plastic strain `alpha` |
/// | `stress` | `(layers, components, nodes)` | pressure | the whole stress, means over the layers |
///
/// The certificate of `contact` bounds its error for this plastic strain; [`PlasticState::certificate`] is that of contact and flow together.
#[derive(Debug, Clone)]
pub struct PlasticState {
    /// The load; none before the first one.
    pub load: Option<Load>,
    /// The contact on the heights of the problem.
    pub contact: Contact,
    /// Plastic strain.
    pub strain: Array3<f64>,
    /// Accumulated plastic strain.
    pub accumulated: Array2<f64>,
    /// Stress.
    pub stress: Array3<f64>,
    /// Displacement of the surface by the plastic strain.
    pub residual: Field,
    /// How far the step is from its minimum.
    pub certificate: PlasticCertificate,
    /// Energies.
    pub energy: PlasticEnergy,
    /// Iterations of flow in the step.
    pub iterations: usize,
    /// Whether the certificates of this step and of all steps before it met the tolerance: a step goes on from the strain of the one before.
    pub is_converged: bool,
    /// The contact under the load of this step before anything flowed in it.
    pub(super) unflowed: Pressing,
    pub(super) layers: DepthLayers,
    pub(super) solid: PlasticSolid,
}

impl PlasticState {
    /// The layers.
    pub fn layers(&self) -> &DepthLayers {
        &self.layers
    }

    /// The largest accumulated plastic strain.
    pub fn max_accumulated(&self) -> f64 {
        self.accumulated.iter().fold(0.0, |most: f64, &alpha| most.max(alpha))
    }

    /// Whether a place has yielded: its accumulated plastic strain is more than a thousandth of the elastic strain at yield, `Y/E`.
    pub fn has_yielded(&self, layer: usize, node: usize) -> bool {
        self.accumulated[[layer, node]] > NEGLIGIBLE * self.solid.yield_stress() / self.solid.young()
    }

    /// The depth of the end of the last layer that has yielded somewhere, a length; none if none has.
    pub fn deepest_yield(&self) -> Option<f64> {
        let yields = |layer: &usize| (0..self.accumulated.ncols()).any(|node| self.has_yielded(*layer, node));
        let deepest = (0..self.layers.count()).rev().find(yields)?;
        Some(self.layers.interfaces()[deepest + 1])
    }

    /// Whether the last layer has yielded somewhere: then the layers do not reach deep enough, and the result depends on where they end.
    pub fn reaches_the_bottom(&self) -> bool {
        self.deepest_yield() == Some(self.layers.depth())
    }

    /// The volume that has yielded, per area of the cell: a length.
    pub fn plastic_volume(&self) -> f64 {
        let count = |layer: usize| (0..self.accumulated.ncols()).filter(|&node| self.has_yielded(layer, node)).count();
        let volume = |layer: usize| self.layers.thickness(layer) * count(layer) as f64;
        (0..self.layers.count()).map(volume).sum::<f64>() / self.accumulated.ncols() as f64
    }

    /// The accumulated plastic strain over all layers, per area of the cell: `sum_j h_j <alpha>`, a length.
    pub fn total_accumulated(&self) -> f64 {
        let rows = self.accumulated.rows().into_iter().enumerate();
        rows.map(|(layer, alpha)| self.layers.thickness(layer) * alpha.sum()).sum::<f64>()
            / self.accumulated.ncols() as f64
    }

    /// How deep the imprint is: the difference of the largest and the smallest residual displacement, a length.
    pub fn imprint_depth(&self) -> f64 {
        let ends = self
            .residual
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], &u| [least.min(u), most.max(u)]);
        ends[1] - ends[0]
    }

    /// The share of the area that is in contact, with edges resolved between the nodes.
    pub fn relative_area(&self) -> f64 {
        self.contact.resolved().relative_area
    }

    /// The prescribed reduced pressure, or that of the mean pressure.
    pub fn reduced_pressure(&self) -> f64 {
        let problem = &self.contact.problem;
        let found = || self.contact.mean_pressure() / (problem.rms_gradient() * problem.contact_modulus());
        self.load.and_then(|load| load.reduced_pressure()).unwrap_or_else(found)
    }

    /// Mean pressure over the [area](PlasticState::relative_area) in contact; zero where nothing touches. Its relative error is that of the area, since the mean
    /// pressure over the cell has none.
    pub fn mean_contact_pressure(&self) -> f64 {
        let area = self.relative_area();
        if area > 0.0 { self.contact.mean_pressure() / area } else { 0.0 }
    }

    /// Plastic strain and von Mises stress in the layers below the row of the rigid surface that holds its highest peak.
    pub fn cut(&self) -> (CutLayers, [StateField; 2]) {
        let [ny, nx] = self.contact.problem.surface().grid().shape();
        let heights = self.contact.problem.height();
        let highest = (0..heights.len()).max_by(|&a, &b| heights[a].total_cmp(&heights[b])).unwrap_or(0);
        let row = (highest / nx).min(ny - 1);
        let field = |of: &dyn Fn(usize, usize) -> f64| {
            Field::from_shape_fn((self.layers.count(), nx), |(layer, column)| of(layer, row * nx + column))
        };
        let plastic_strain = field(&|layer, node| self.accumulated[[layer, node]]);
        let von_mises = field(&|layer, node| self.von_mises(layer, node));
        let fields = [(FieldKind::PlasticStrain, plastic_strain), (FieldKind::VonMises, von_mises)];
        let layers = CutLayers { row, interfaces: self.layers.interfaces().to_vec() };
        (layers, fields.map(|(kind, values)| StateField::new(kind, values)))
    }

    /// The von Mises stress of a place, a pressure.
    pub fn von_mises(&self, layer: usize, node: usize) -> f64 {
        let of_layer = self.stress.index_axis(Axis(0), layer);
        let stress = of_layer.index_axis(Axis(1), node);
        let [x, y, z] = [stress[0], stress[1], stress[2]];
        let shears: f64 = stress.iter().skip(3).map(|shear| shear * shear).sum();
        let differences = (x - y).powi(2) + (y - z).powi(2) + (z - x).powi(2);
        (0.5 * differences + 3.0 * shears).sqrt()
    }

    /// The largest von Mises stress, a pressure.
    pub fn max_von_mises(&self) -> f64 {
        let (layers, _, nodes) = self.stress.dim();
        let places = (0..layers).flat_map(|layer| (0..nodes).map(move |node| (layer, node)));
        places.map(|(layer, node)| self.von_mises(layer, node)).fold(0.0, f64::max)
    }

    /// How far the rigid surface has moved into the solid since its highest peak touched the solid that had not yielded, a length, without what the
    /// uniform pressure displaces, which has no limit on a periodic half-space.
    pub fn approach(&self) -> f64 {
        let mean = |field: &Field| field.mean().unwrap_or(0.0);
        let problem = &self.contact.problem;
        let datum = mean(&self.contact.gap) - mean(&self.contact.displacement) + mean(problem.surface().height());
        problem.highest() - datum
    }
}
