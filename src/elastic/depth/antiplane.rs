//! The residual stress of one wave of plastic strain out of the plane of its wave vector and the depth.

use super::layer_wave::LayerWave;
use super::wave_tensor::WaveTensor;
use crate::fourier::Complex;

/// The stress function of the shears `nt` and `tz` of one wave of plastic strain `e` that is uniform in each layer, below a surface only.
///
/// In the frame of [`PlaneScan`](super::plane::PlaneScan) the stress is `nt = chi'`, `tz = -i q chi`, and compatibility asks for
///
/// ```text
/// (d^2/dz^2 - q^2) chi = -F,    F = 2 G (e_nt' - i q e_tz),    chi(0) = 0,    chi -> 0 below
/// ```
///
/// with the shear modulus `G`. In layers, `F` is a constant `-2 i q G e_tz` in each, and a delta of strength `2 G [e_nt]` at each interface. Scans down
/// and up add up `exp(-q r) / (2 q)` of all sources, and an image `exp(-q z)` clears the surface. With `e_tz` times `i` all coefficients are
/// real.
pub(super) struct AntiplaneScan {
    /// What deeper sources make just below each interface.
    from_below: Vec<Complex>,
}

/// The sources of a wave of strain in its layers.
struct ShearSources<'a> {
    q: f64,
    shear_modulus: f64,
    strain: &'a [WaveTensor],
}

impl ShearSources<'_> {
    fn interface(&self, interface: usize) -> Complex {
        let nt = |layer: Option<usize>| {
            layer.and_then(|layer| self.strain.get(layer)).map_or(Complex::default(), |strain| strain.nt)
        };
        (nt(Some(interface)) - nt(interface.checked_sub(1))) * (2.0 * self.shear_modulus)
    }

    fn uniform(&self, layer: usize) -> Complex {
        self.strain[layer].tz * (-2.0 * self.q * self.shear_modulus)
    }
}

impl AntiplaneScan {
    pub(crate) fn new(layers: usize) -> Self {
        Self { from_below: vec![Complex::default(); layers + 1] }
    }

    /// Writes the layer means of the stress `nt` and `i tz` by a wave of strain to `stress`.
    pub(crate) fn run(
        &mut self,
        q: f64,
        shear_modulus: f64,
        layers: &[LayerWave],
        strain: &[WaveTensor],
        stress: &mut [WaveTensor],
    ) {
        let sources = ShearSources { q, shear_modulus, strain };
        self.scan_up(&sources, layers);
        self.scan_down(&sources, layers, stress);
    }

    fn scan_up(&mut self, sources: &ShearSources<'_>, layers: &[LayerWave]) {
        let mut below = Complex::default();
        self.from_below[layers.len()] = below;
        for (j, layer) in layers.iter().enumerate().rev() {
            below = (below + sources.interface(j + 1)) * layer.decay + sources.uniform(j) * layer.first;
            self.from_below[j] = below;
        }
    }

    fn scan_down(&self, sources: &ShearSources<'_>, layers: &[LayerWave], stress: &mut [WaveTensor]) {
        let q = sources.q;
        let mut above = sources.interface(0);
        // all values of chi times 2 q
        let image = -(above + self.from_below[0]);
        let mut top = Complex::default();
        for (j, layer) in layers.iter().enumerate() {
            let (source, uniform) = (sources.interface(j + 1), sources.uniform(j));
            let lower = self.from_below[j + 1] + source;
            let integral = (above + lower) * layer.first
                + uniform * (2.0 * layer.antiplane_self() / (q * q))
                + image * (layer.means[0] * layer.thickness);
            above = above * layer.decay + uniform * layer.first + source;
            let bottom = above + self.from_below[j + 1] + image * (layer.fading * layer.decay);
            let over = 1.0 / (2.0 * q * layer.thickness);
            stress[j].nt = (bottom - top) * over;
            stress[j].tz = integral * (q * over);
            top = bottom;
        }
    }
}
