//! The places that flow in a step, and the accelerated iteration of their strains.

use super::flow::weight;
use crate::anderson::Anderson;
use crate::elastic::DepthLayers;
use ndarray::Array3;

/// The strains of the places that have flowed at some time of a step, as vectors whose product is that of the energy.
pub(super) struct Accelerated {
    /// Places, each a layer and a node, in the order in which they came.
    places: Vec<[usize; 2]>,
    /// The square root of the thickness of each layer.
    scales: Vec<f64>,
    anderson: Anderson,
    /// The plain successor of the last point that was accepted.
    plain: Vec<f64>,
}

impl Accelerated {
    pub(crate) fn new(layers: &DepthLayers) -> Self {
        let scales = (0..layers.count()).map(|j| layers.thickness(j).sqrt()).collect();
        Self { places: Vec::new(), scales, anderson: Anderson::default(), plain: Vec::new() }
    }

    /// Adds places that begin to flow.
    pub(crate) fn add(&mut self, places: impl IntoIterator<Item = [usize; 2]>, components: usize) {
        self.places.extend(places);
        let len = self.places.len() * components;
        self.plain.resize(len, 0.0);
        self.anderson.lengthen(len);
    }

    /// Whether the last point combined several ones.
    pub(crate) fn is_combined(&self) -> bool {
        self.anderson.is_combined()
    }

    /// Puts the next point in the place of `point`, whose plain successor is `next`.
    pub(crate) fn advance(&mut self, point: &mut Array3<f64>, next: &Array3<f64>) {
        let from = self.packed(point);
        self.plain = self.packed(next);
        let change = self.plain.iter().zip(&from).map(|(next, from)| next - from).collect();
        let accelerated = self.anderson.next(from, change, 1.0);
        self.unpack(&accelerated, point);
    }

    /// Puts the plain successor of the last accepted point in the place of a worse one, and forgets all points.
    pub(crate) fn go_back(&mut self, point: &mut Array3<f64>) {
        self.anderson.clear();
        self.unpack(&self.plain, point);
    }

    fn packed(&self, field: &Array3<f64>) -> Vec<f64> {
        let components = field.dim().1;
        let of_place =
            |&[layer, node]: &[usize; 2]| (0..components).map(move |c| self.scale(layer, c) * field[[layer, c, node]]);
        self.places.iter().flat_map(of_place).collect()
    }

    fn unpack(&self, values: &[f64], field: &mut Array3<f64>) {
        let components = field.dim().1;
        for (&[layer, node], values) in self.places.iter().zip(values.chunks_exact(components)) {
            for (c, value) in values.iter().enumerate() {
                field[[layer, c, node]] = value / self.scale(layer, c);
            }
        }
    }

    fn scale(&self, layer: usize, component: usize) -> f64 {
        self.scales[layer] * weight(component).sqrt()
    }
}
