//! How one wave fades within one layer.

/// Below these products `q h` of wavenumber and thickness the first terms of a series are used, since the closed forms are differences of like
/// numbers.
const THIN: f64 = 0.1;

/// Means and integrals of a wave of wavenumber `q` over a layer from the depth `z` on with the thickness `h`. With `x = q h` and
/// `X = exp(-x)`:
///
/// | field    | is                                  | meaning                                        |
/// |----------|-------------------------------------|------------------------------------------------|
/// | `fading` | `exp(-q z)`                         | what is left of the wave at the top            |
/// | `decay`  | `X`                                 | what is left of it after the layer             |
/// | `first`  | `(1 - X)/q`                         | `int exp(-q t) dt` over the layer              |
/// | `second` | `(1 - (1 + x) X)/q`                 | `int q t exp(-q t) dt` over the layer          |
/// | `means`  | `A0`, `A1`                          | means of `exp(-q z)` and `q z exp(-q z)`       |
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct LayerWave {
    pub x: f64,
    pub thickness: f64,
    pub fading: f64,
    pub decay: f64,
    pub first: f64,
    pub second: f64,
    pub means: [f64; 2],
}

impl LayerWave {
    /// A wave of which `fading` is left at the depth `top`, in a layer from there on. Of the layer `above`, what depends on the thickness alone is taken over, if
    /// that is the same.
    pub(crate) fn new(q: f64, top: f64, thickness: f64, above: &Self) -> Self {
        let fading = above.fading * above.decay;
        let wave = if thickness == above.thickness { *above } else { Self::of_thickness(q, thickness) };
        let means = [fading * wave.first / thickness, fading * (q * top * wave.first + wave.second) / thickness];
        Self { fading, means, ..wave }
    }

    /// The surface, above all layers.
    pub(crate) fn surface() -> Self {
        Self { fading: 1.0, decay: 1.0, ..Self::default() }
    }

    /// The wave in a layer at the surface.
    fn of_thickness(q: f64, thickness: f64) -> Self {
        let x = q * thickness;
        let lost = -(-x).exp_m1();
        let decay = 1.0 - lost;
        Self { x, thickness, decay, first: lost / q, second: (lost - x * decay) / q, ..Self::default() }
    }

    /// `2 x - 3 + (3 + x) X`: the integral over the layer of what a uniform source in it makes by [`PlaneScan`](super::plane::PlaneScan)'s
    /// equation, times `2 q^5`.
    pub(crate) fn plane_self(&self) -> f64 {
        const TERMS: [f64; 8] =
            [1.0 / 2.0, 0.0, -1.0 / 24.0, 1.0 / 60.0, -1.0 / 240.0, 1.0 / 1260.0, -1.0 / 8064.0, 1.0 / 60480.0];
        if self.x < THIN { series(&TERMS, self.x) } else { 2.0 * self.x - 3.0 + (3.0 + self.x) * self.decay }
    }

    /// `x - 1 + X`: the same of [`AntiplaneScan`](super::antiplane::AntiplaneScan)'s equation, times `q^3`.
    pub(crate) fn antiplane_self(&self) -> f64 {
        const TERMS: [f64; 8] = [
            1.0 / 2.0,
            -1.0 / 6.0,
            1.0 / 24.0,
            -1.0 / 120.0,
            1.0 / 720.0,
            -1.0 / 5040.0,
            1.0 / 40320.0,
            -1.0 / 362_880.0,
        ];
        if self.x < THIN { series(&TERMS, self.x) } else { self.x - 1.0 + self.decay }
    }
}

/// `x^2` times a polynomial.
fn series(terms: &[f64], x: f64) -> f64 {
    x * x * terms.iter().rev().fold(0.0, |sum, term| sum * x + term)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Closed form and series are one function: they meet where one takes over from the other.
    #[test]
    fn series_and_closed_forms_meet() {
        let values = |x: f64| {
            let wave = LayerWave::of_thickness(1.0, x);
            [wave.plane_self() / (x * x), wave.antiplane_self() / (x * x)]
        };
        let [thin, thick] = [values(THIN * (1.0 - 1e-9)), values(THIN * (1.0 + 1e-9))];
        for (thin, thick) in thin.into_iter().zip(thick) {
            assert!((thin / thick - 1.0).abs() < 1e-9, "{thin} against {thick}");
        }
    }
}
