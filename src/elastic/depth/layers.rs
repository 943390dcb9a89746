//! The layers in which a plastic strain is given.

use crate::error::PlasticError;

/// The most layers.
const MOST: usize = 10_000;

/// Layers below the surface of a half-space, each with a thickness of its own. Below the last one the solid goes on without plastic strain.
///
/// ```
/// use asperity::elastic::DepthLayers;
/// let layers = DepthLayers::graded(0.5, 2.0, 3.0)?;
/// assert_eq!(layers.interfaces(), [0.0, 0.5, 1.5, 3.5]);
/// assert_eq!((layers.count(), layers.thickness(1), layers.middle(1)), (3, 1.0, 1.0));
/// assert!(DepthLayers::new(vec![0.0, 0.2, 0.1]).is_err());
/// # Ok::<(), asperity::error::PlasticError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct DepthLayers {
    interfaces: Vec<f64>,
    /// Differences of the interfaces; exactly equal where they were meant to be.
    thicknesses: Vec<f64>,
}

impl DepthLayers {
    /// The ratio of the thicknesses of neighbours that [`DepthLayers::below`] uses: the imprint of a cylinder came out half a percent off.
    pub const RATIO: f64 = 1.1;

    /// The layers between given depths, lengths, of which the first is 0, the surface.
    ///
    /// # Errors
    /// [`PlasticError::LayerOrder`] for depths that do not begin at 0, that do not rise or are not finite, and [`PlasticError::LayerCount`]
    /// for fewer than two depths, or more than 10 001.
    pub fn new(interfaces: Vec<f64>) -> Result<Self, PlasticError> {
        let count = interfaces.len().saturating_sub(1);
        if count == 0 || count > MOST {
            return Err(PlasticError::LayerCount { count });
        }
        if interfaces[0] != 0.0 {
            return Err(PlasticError::LayerOrder { before: 0.0, depth: interfaces[0] });
        }
        let falling = interfaces.windows(2).find(|pair| !(pair[1].is_finite() && pair[1] > pair[0]));
        match falling {
            Some(pair) => Err(PlasticError::LayerOrder { before: pair[0], depth: pair[1] }),
            None => {
                let thicknesses = interfaces.windows(2).map(|pair| pair[1] - pair[0]).collect();
                Ok(Self { interfaces, thicknesses })
            }
        }
    }

    /// A number of layers of equal thickness down to a depth, a length.
    ///
    /// # Errors
    /// The errors of [`DepthLayers::new`].
    pub fn uniform(count: usize, depth: f64) -> Result<Self, PlasticError> {
        if count > MOST {
            return Err(PlasticError::LayerCount { count });
        }
        let interfaces = (0..=count).map(|j| depth * j as f64 / count as f64);
        let layers = Self::new(interfaces.collect())?;
        Ok(Self { thicknesses: vec![depth / count as f64; count], ..layers })
    }

    /// Layers of which the first has a given thickness, and each further one is thicker by a ratio of at least 1, until they reach a depth.
    ///
    /// # Errors
    /// [`PlasticError::Grading`] for a thickness or a depth that is not positive and finite, or a ratio that is below 1 or not finite, and
    /// [`PlasticError::LayerCount`] for more than 10 000 layers.
    pub fn graded(first: f64, ratio: f64, depth: f64) -> Result<Self, PlasticError> {
        let is_length = |value: f64| value.is_finite() && value > 0.0;
        if !(is_length(first) && is_length(depth) && ratio.is_finite() && ratio >= 1.0) {
            return Err(PlasticError::Grading { first, ratio, depth });
        }
        // the sum of `count` thicknesses is `first (ratio^count - 1)/(ratio - 1)`
        let many = depth / first;
        let count = if ratio > 1.0 { (many * (ratio - 1.0)).ln_1p() / ratio.ln() } else { many }.ceil();
        if count > MOST as f64 {
            return Err(PlasticError::LayerCount { count: count as usize });
        }
        let (mut interfaces, mut thickness) = (vec![0.0], first);
        while interfaces[interfaces.len() - 1] < depth {
            interfaces.push(interfaces[interfaces.len() - 1] + thickness);
            thickness *= ratio;
        }
        Self::new(interfaces)
    }

    /// Layers down to a depth below a grid of a spacing, both lengths: the first is half as thick as the spacing, and each further one is
    /// thicker by a tenth.
    ///
    /// # Errors
    /// The errors of [`DepthLayers::graded`].
    pub fn below(spacing: f64, depth: f64) -> Result<Self, PlasticError> {
        Self::graded(0.5 * spacing, Self::RATIO, depth)
    }

    /// These layers and more below them, until they reach half as deep again: their thickness grows by the ratio of the last two, if that is above 1.
    ///
    /// # Errors
    /// [`PlasticError::LayerCount`] for more than 10 000 layers.
    pub fn deepened(&self) -> Result<Self, PlasticError> {
        let count = self.count();
        let mut thickness = self.thickness(count - 1);
        let ratio = if count > 1 { (thickness / self.thickness(count - 2)).max(1.0) } else { 1.0 };
        let Self { mut interfaces, mut thicknesses } = self.clone();
        while interfaces[interfaces.len() - 1] < 1.5 * self.depth() && thicknesses.len() <= MOST {
            thickness *= ratio;
            interfaces.push(interfaces[interfaces.len() - 1] + thickness);
            thicknesses.push(thickness);
        }
        let layers = Self::new(interfaces)?;
        Ok(Self { thicknesses, ..layers })
    }

    /// Each layer cut into two of half its thickness: for an estimate of the error by the layers.
    ///
    /// # Errors
    /// [`PlasticError::LayerCount`] for more than 10 000 layers.
    pub fn halved(&self) -> Result<Self, PlasticError> {
        let halves = (0..self.count()).flat_map(|j| [self.middle(j), self.interfaces[j + 1]]);
        Self::new(std::iter::once(0.0).chain(halves).collect())
    }

    /// Two layers each made one, for an estimate of the error by the layers; the last one stays as it is if their number is odd.
    ///
    /// # Errors
    /// None that is known: depths rise as before.
    pub fn doubled(&self) -> Result<Self, PlasticError> {
        let last = (!self.count().is_multiple_of(2)).then_some(self.depth());
        Self::new(self.interfaces.iter().copied().step_by(2).chain(last).collect())
    }

    /// The thickness of each layer, a length.
    pub fn thicknesses(&self) -> &[f64] {
        &self.thicknesses
    }

    /// The number of layers.
    pub fn count(&self) -> usize {
        self.interfaces.len() - 1
    }

    /// The depths of the interfaces, lengths, from the surface down to the end of the last layer.
    pub fn interfaces(&self) -> &[f64] {
        &self.interfaces
    }

    /// The thickness of a layer, a length.
    ///
    /// # Panics
    /// If there is no such layer.
    pub fn thickness(&self, layer: usize) -> f64 {
        self.thicknesses[layer]
    }

    /// The depth of the middle of a layer, a length.
    ///
    /// # Panics
    /// If there is no such layer.
    pub fn middle(&self, layer: usize) -> f64 {
        0.5 * (self.interfaces[layer] + self.interfaces[layer + 1])
    }

    /// The depth of the end of the last layer, a length.
    pub fn depth(&self) -> f64 {
        self.interfaces[self.count()]
    }
}
