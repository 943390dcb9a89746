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
    /// The wave in a layer from the depth `top` on.
    pub fn new(q: f64, top: f64, thickness: f64) -> Self {
        let (x, fading) = (q * thickness, (-q * top).exp());
        let lost = -(-x).exp_m1();
        let decay = 1.0 - lost;
        let (first, second) = (lost / q, (lost - x * decay) / q);
        let means = [fading * first / thickness, fading * (q * top * first + second) / thickness];
        Self { x, thickness, fading, decay, first, second, means }
    }

    /// `2 x - 3 + (3 + x) X`: the integral over the layer of what a uniform source in it makes by [`PlaneScan`](super::plane::PlaneScan)'s
    /// equation, times `2 q^5`.
    pub fn plane_self(&self) -> f64 {
        const TERMS: [f64; 8] =
            [1.0 / 2.0, 0.0, -1.0 / 24.0, 1.0 / 60.0, -1.0 / 240.0, 1.0 / 1260.0, -1.0 / 8064.0, 1.0 / 60480.0];
        if self.x < THIN { series(&TERMS, self.x) } else { 2.0 * self.x - 3.0 + (3.0 + self.x) * self.decay }
    }

    /// `x - 1 + X`: the same of [`AntiplaneScan`](super::antiplane::AntiplaneScan)'s equation, times `q^3`.
    pub fn antiplane_self(&self) -> f64 {
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
            let wave = LayerWave::new(1.0, 0.0, x);
            [wave.plane_self() / (x * x), wave.antiplane_self() / (x * x)]
        };
        let [thin, thick] = [values(THIN * (1.0 - 1e-9)), values(THIN * (1.0 + 1e-9))];
        for (thin, thick) in thin.into_iter().zip(thick) {
            assert!((thin / thick - 1.0).abs() < 1e-9, "{thin} against {thick}");
        }
    }
}
