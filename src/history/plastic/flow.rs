//! Plastic flow at one place in one step.

use super::PlasticSolid;

/// A tensor at one place: `xx`, `yy`, `zz` and one or three shears, which count twice.
pub(super) type PlaceTensor<const N: usize> = [f64; N];

/// `a : b`.
pub(super) fn product<const N: usize>(a: &PlaceTensor<N>, b: &PlaceTensor<N>) -> f64 {
    (0..N).map(|c| weight(c) * a[c] * b[c]).sum()
}

/// How often a component counts in a double contraction.
pub(super) fn weight(component: usize) -> f64 {
    if component < 3 { 1.0 } else { 2.0 }
}

fn deviator<const N: usize>(mut tensor: PlaceTensor<N>) -> PlaceTensor<N> {
    let mean = (tensor[0] + tensor[1] + tensor[2]) / 3.0;
    (0..3).for_each(|c| tensor[c] -= mean);
    tensor
}

/// What is known of one place: the plastic strain and its accumulated amount at the begin of the step, an increment of the strain, and the stress by both
/// together.
pub(super) struct FlowPlace<const N: usize> {
    pub strain: PlaceTensor<N>,
    pub accumulated: f64,
    pub increment: PlaceTensor<N>,
    pub stress: PlaceTensor<N>,
}

/// The law of flow of a solid.
#[derive(Debug, Clone, Copy)]
pub(super) struct FlowLaw {
    shear_modulus: f64,
    yield_stress: f64,
    isotropic: f64,
    kinematic: f64,
}

/// What the law says of one place, energies per volume.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct PlaceFlow {
    /// The dissipated energy `psi(x) = k d + (H + C) d^2/2` of the increment `x` with `d = sqrt(2/3) |x|` and `k = Y + H alpha`.
    pub psi: f64,
    /// `psi(x) + psi*(s) - s : x`, which is never negative: how far stress and increment are from the law.
    pub gap: f64,
    /// The work `(2/3) C e : x` against the stress that earlier flow has left.
    pub back_work: f64,
    /// `(e + x) : stress`.
    pub product: f64,
}

impl FlowLaw {
    pub(crate) fn new(solid: &PlasticSolid) -> Self {
        Self {
            shear_modulus: solid.shear_modulus(),
            yield_stress: solid.yield_stress(),
            isotropic: solid.hardening(),
            kinematic: solid.kinematic_hardening(),
        }
    }

    /// The hardening over the modulus `3 G` of an equivalent stress, at most 1.
    pub(crate) fn contrast(&self) -> f64 {
        ((self.isotropic + self.kinematic) / (3.0 * self.shear_modulus)).min(1.0)
    }

    /// The equivalent increment `sqrt(2/3) |x|`.
    pub(crate) fn amount<const N: usize>(increment: &PlaceTensor<N>) -> f64 {
        (2.0 / 3.0 * product(increment, increment)).sqrt()
    }

    /// The next increment by radial return at a fixed total strain: with `t = s + 2 G x` and `t_eq = sqrt(3/2) |t|`, the tensor along `t` with
    /// `d = max(t_eq - k, 0) / (3 G + H + C)`. And what the law says of the place now.
    pub(crate) fn returned<const N: usize>(&self, place: &FlowPlace<N>) -> (PlaceTensor<N>, PlaceFlow) {
        let FlowPlace { strain, accumulated, increment, stress } = place;
        let (strength, hardening) = (self.yield_stress + self.isotropic * accumulated, self.isotropic + self.kinematic);
        let back = 2.0 / 3.0 * self.kinematic;
        let full = deviator(*stress);
        let s: PlaceTensor<N> = std::array::from_fn(|c| full[c] - back * strain[c]);
        if increment.iter().all(|&x| x == 0.0) && 1.5 * product(&s, &s) <= strength * strength {
            return ([0.0; N], PlaceFlow { product: product(strain, stress), ..PlaceFlow::default() });
        }
        let trial: PlaceTensor<N> = std::array::from_fn(|c| s[c] + 2.0 * self.shear_modulus * increment[c]);
        let size = (1.5 * product(&trial, &trial)).sqrt();
        let amount = (size - strength).max(0.0) / (3.0 * self.shear_modulus + hardening);
        let next = trial.map(|t| if amount > 0.0 { 1.5 * amount * t / size } else { 0.0 });
        let (now, excess) = (Self::amount(increment), ((1.5 * product(&s, &s)).sqrt() - strength).max(0.0));
        let psi = strength * now + 0.5 * hardening * now * now;
        let flow = PlaceFlow {
            psi,
            gap: psi + excess * excess / (2.0 * hardening) - product(&s, increment),
            back_work: back * product(strain, increment),
            product: product(strain, stress) + product(increment, stress),
        };
        (next, flow)
    }
}
