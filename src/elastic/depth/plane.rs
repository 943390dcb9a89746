//! The residual stress of one wave of plastic strain in the plane of its wave vector and the depth.

use super::layer_wave::LayerWave;
use super::wave_tensor::WaveTensor;
use crate::fourier::Complex;

/// The Airy function of one wave of plastic strain `e` that is uniform in each layer.
///
/// In the frame of the wave (`n` along the wave vector, `t` across it, `z` into the solid) the stress is `nn = phi''`, `zz = -q^2 phi`,
/// `nz = -i q phi'`, which is in equilibrium, and `tt = nu (nn + zz) - E e_tt`, since nothing varies along `t`. Compatibility asks for
///
/// ```text
/// (d^2/dz^2 - q^2)^2 phi = f = -E* [a'' - q^2 c - 2 i q e_nz'],    a = e_nn + nu e_tt,    c = e_zz + nu e_tt,
/// ```
///
/// with `phi(0) = phi'(0) = 0` at the surface, which carries no traction, and `phi -> 0` below. In layers, `f` is a constant
/// `F = E* q^2 c` in each, and at each interface a delta of strength `D0 = 2 i q E* [e_nz]` and the derivative of one, of strength
/// `D1 = -E* [a]`, with the jumps `[]`.
///
/// Without a surface the solution is the sum of the sources times `(1 + q r) exp(-q r) / (4 q^3)` at their distances `r`. One scan down adds up those above
/// (`P`), one scan up those below (`N`), each as the two coefficients of `exp(-q r)` and `q r exp(-q r)`. An image
/// `(al + be q z) exp(-q z)` then clears the surface. All exponentials fade, so that nothing overflows, and the work is linear in the number of layers.
///
/// With `e_nz` times `i` all coefficients are real.
pub(super) struct PlaneScan {
    /// What deeper sources make just below each interface.
    from_below: Vec<FadingPair>,
}

/// Coefficients of `exp(-q r)` and `q r exp(-q r)`.
#[derive(Clone, Copy, Default)]
struct FadingPair(Complex, Complex);

impl FadingPair {
    /// After a layer, with what its uniform source adds.
    fn through(self, layer: &LayerWave, source: Complex) -> Self {
        Self(
            self.0 * layer.decay + source * layer.first,
            (self.1 + self.0 * layer.x) * layer.decay + source * layer.second,
        )
    }
}

/// The constants of a solid that are needed for a wave.
#[derive(Clone, Copy)]
pub(super) struct PlaneSolid {
    pub young: f64,
    pub poisson: f64,
    pub contact_modulus: f64,
}

/// The sources of a wave of strain in its layers.
struct Sources<'a> {
    q: f64,
    solid: PlaneSolid,
    strain: &'a [WaveTensor],
}

impl Sources<'_> {
    fn along(&self, layer: usize) -> [Complex; 2] {
        let strain = self.strain.get(layer).copied().unwrap_or_default();
        [strain.nn + strain.tt * self.solid.poisson, strain.nz]
    }

    /// Those of an interface, as they act downwards (`D0 - q D1`, `q D1`) and upwards (`D0 + q D1`, `-q D1`).
    fn interface(&self, interface: usize) -> [FadingPair; 2] {
        let [a, nz] = self.along(interface);
        let [above, nz_above] = interface.checked_sub(1).map_or([Complex::default(); 2], |layer| self.along(layer));
        let scale = self.q * self.solid.contact_modulus;
        let (d0, d1) = ((nz - nz_above) * (2.0 * scale), (a - above) * -scale);
        [FadingPair(d0 - d1, d1), FadingPair(d0 + d1, -d1)]
    }

    /// The constant one of a layer.
    fn uniform(&self, layer: usize) -> Complex {
        let strain = self.strain[layer];
        (strain.zz + strain.tt * self.solid.poisson) * (self.solid.contact_modulus * self.q * self.q)
    }
}

impl PlaneScan {
    pub(crate) fn new(layers: usize) -> Self {
        Self { from_below: vec![FadingPair::default(); layers + 1] }
    }

    /// Writes the layer means of the stress `nn`, `zz`, `i nz` and `tt` by a wave of strain to `stress`.
    pub(crate) fn run(
        &mut self,
        q: f64,
        solid: PlaneSolid,
        layers: &[LayerWave],
        strain: &[WaveTensor],
        stress: &mut [WaveTensor],
    ) {
        let sources = Sources { q, solid, strain };
        self.scan_up(&sources, layers);
        self.scan_down(&sources, layers, stress);
        for (stress, strain) in stress.iter_mut().zip(strain) {
            stress.tt = (stress.nn + stress.zz) * solid.poisson - strain.tt * solid.young;
        }
    }

    fn scan_up(&mut self, sources: &Sources<'_>, layers: &[LayerWave]) {
        let mut below = FadingPair::default();
        self.from_below[layers.len()] = below;
        for (j, layer) in layers.iter().enumerate().rev() {
            let [_, up] = sources.interface(j + 1);
            below = FadingPair(below.0 + up.0, below.1 + up.1).through(layer, sources.uniform(j));
            self.from_below[j] = below;
        }
    }

    fn scan_down(&self, sources: &Sources<'_>, layers: &[LayerWave], stress: &mut [WaveTensor]) {
        let q = sources.q;
        let [mut above, _] = sources.interface(0);
        // phi times 4 q^3 and its slope times 4 q^2, without the image
        let free = |above: FadingPair, below: FadingPair| [above.0 + above.1 + below.0 + below.1, below.1 - above.1];
        let at_surface = free(above, self.from_below[0]);
        let image = [-at_surface[0], -at_surface[0] - at_surface[1]];
        let mut top = [Complex::default(); 2];
        let mut depth = 0.0;
        for (j, layer) in layers.iter().enumerate() {
            let ([down, up], below) = (sources.interface(j + 1), self.from_below[j + 1]);
            let lower = FadingPair(below.0 + up.0, below.1 + up.1);
            let integral = (above.0 + above.1 + lower.0 + lower.1) * layer.first
                + (above.0 + lower.0) * layer.second
                + sources.uniform(j) * (2.0 * layer.plane_self() / (q * q))
                + (image[0] * layer.means[0] + image[1] * layer.means[1]) * layer.thickness;
            above = above.through(layer, sources.uniform(j));
            above = FadingPair(above.0 + down.0, above.1 + down.1);
            depth += layer.x;
            let faded = layer.fading * layer.decay;
            let [value, slope] = free(above, below);
            let bottom =
                [value + (image[0] + image[1] * depth) * faded, slope + (image[1] * (1.0 - depth) - image[0]) * faded];
            let over = 1.0 / (4.0 * q * q * layer.thickness);
            stress[j].nn = (bottom[1] - top[1]) * over;
            stress[j].nz = (bottom[0] - top[0]) * over;
            stress[j].zz = integral * (-q * over);
            top = bottom;
        }
    }
}
