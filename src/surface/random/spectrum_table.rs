//! Spectra that are given by values.

use crate::error::SurfaceError;

/// Steps of the integrals from profiles to surfaces and back.
const STEPS: usize = 4000;
/// Values per decade of a converted spectrum.
const PER_DECADE: f64 = 60.0;
/// The largest share of a converted spectrum that may come out below zero, by the scatter of the values.
const MOST_BELOW: f64 = 0.3;
/// How far below its first wavenumber the spectrum of the profiles of a surface is followed.
const BELOW: f64 = 1e-3;
/// How far beyond its last wavenumber the spectrum of a profile is continued for the integral over its tail.
const BEYOND: f64 = 1e3;

/// What the density of a spectrum is a density of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpectrumKind {
    /// Of the waves of an isotropic surface: `<h^2> = int C d^2q`, with `C` in length^4.
    Surface,
    /// Of the waves of a profile: `<h^2> = int C dq` over both signs of `q`, with `C` in length^3.
    Profile,
}

/// A power spectrum that is given by values, between which `ln C` is linear in `ln q`. Outside of the given wavenumbers it is zero.
///
/// A profile of an isotropic surface has another spectrum than the surface. Either is found from the other:
///
/// ```text
/// C_profile(q) =  2    int C_surface(k) k / sqrt(k^2 - q^2) dk
/// C_surface(q) = -1/pi int C'_profile(k) / sqrt(k^2 - q^2) dk       both from q to infinity
/// ```
///
/// For the second integral the spectrum of the profile is continued beyond its end with its last slope. Where the scatter of the values makes
/// the result negative it is zero, and the rest is lowered so that `<h^2>` stays as it is.
///
/// Source: Nayak, J. Lubr. Technol. 93:398, 1971; Jacobs, Junge & Pastewka, Surf. Topogr. 5:013001, 2017.
///
/// ```
/// use asperity::surface::{SpectrumKind, SpectrumTable};
/// let table = SpectrumTable::new(vec![1.0, 10.0, 100.0], vec![1.0, 1e-3, 1e-6], SpectrumKind::Surface)?;
/// assert!((table.density(2.0) - 0.125).abs() < 1e-12);
/// assert_eq!(table.density(200.0), 0.0);
/// # Ok::<(), asperity::error::SurfaceError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct SpectrumTable {
    wavenumber: Vec<f64>,
    density: Vec<f64>,
    kind: SpectrumKind,
}

impl SpectrumTable {
    /// The spectrum with the values `density` at the wavenumbers `wavenumber`, `2 pi` over the wavelength.
    ///
    /// # Errors
    /// [`SurfaceError::SpectrumTable`] unless there are two wavenumbers or more, positive and ascending, with as many densities, all
    /// finite and none negative, and one above zero.
    pub fn new(wavenumber: Vec<f64>, density: Vec<f64>, kind: SpectrumKind) -> Result<Self, SurfaceError> {
        let wrong = |place: Option<usize>, reason: String| Err(SurfaceError::SpectrumTable { place, reason });
        if wavenumber.len() < 2 || wavenumber.len() != density.len() {
            let [wavenumbers, densities] = [wavenumber.len(), density.len()];
            return wrong(
                None,
                format!(
                    "there are {wavenumbers} wavenumbers and {densities} densities: give two of each or more, and as many of both"
                ),
            );
        }
        if let Some(i) = wavenumber.iter().position(|q| !(q.is_finite() && *q > 0.0)) {
            return wrong(Some(i), format!("the wavenumber {:?} is not positive and finite", wavenumber[i]));
        }
        if let Some(i) = wavenumber.windows(2).position(|pair| pair[0] >= pair[1]) {
            let [before, q] = [wavenumber[i], wavenumber[i + 1]];
            return wrong(
                Some(i + 1),
                format!("the wavenumber {q:?} follows {before:?}: sort them, and give each once"),
            );
        }
        if let Some(i) = density.iter().position(|value| !(value.is_finite() && *value >= 0.0)) {
            return wrong(Some(i), format!("the density {:?} is negative or not finite", density[i]));
        }
        match density.iter().any(|value| *value > 0.0) {
            true => Ok(Self { wavenumber, density, kind }),
            false => wrong(None, "all densities are zero".into()),
        }
    }

    /// Its wavenumbers, ascending; 1/length.
    pub fn wavenumbers(&self) -> &[f64] {
        &self.wavenumber
    }

    /// The last wavenumber.
    pub(super) fn last(&self) -> f64 {
        self.wavenumber[self.wavenumber.len() - 1]
    }

    /// The density at the wavenumber `q`, in the kind of the table.
    pub fn density(&self, q: f64) -> f64 {
        let after = self.wavenumber.partition_point(|it| *it < q);
        if self.wavenumber.get(after) == Some(&q) {
            return self.density[after];
        }
        if after == 0 || after == self.wavenumber.len() {
            return 0.0;
        }
        let [[q0, q1], [c0, c1]] = [&self.wavenumber, &self.density].map(|of| [of[after - 1], of[after]]);
        if c0 > 0.0 && c1 > 0.0 {
            c0 * (c1 / c0).powf((q / q0).ln() / (q1 / q0).ln())
        } else {
            c0 + (c1 - c0) * (q - q0) / (q1 - q0)
        }
    }

    /// The same spectrum as one of `kind`, as it is or by an integral.
    ///
    /// # Errors
    /// [`SurfaceError::SpectrumTable`] for the spectrum of a profile that no isotropic surface has, even without its scatter.
    pub fn converted(&self, kind: SpectrumKind) -> Result<Self, SurfaceError> {
        let of = match (self.kind, kind) {
            (SpectrumKind::Surface, SpectrumKind::Profile) => Self::of_profile,
            (SpectrumKind::Profile, SpectrumKind::Surface) => Self::of_surface,
            _ => return Ok(self.clone()),
        };
        let first = self.wavenumber[0] * if kind == SpectrumKind::Profile { BELOW } else { 1.0 };
        let decades = (self.last() / first).log10();
        let count = (PER_DECADE * decades).ceil() as usize;
        let at = |i: usize| first * 10f64.powf(decades * i as f64 / count as f64);
        let wavenumber: Vec<f64> = (0..count).map(at).chain([self.last()]).collect();
        let density: Vec<f64> = wavenumber.iter().map(|&q| of(self, q)).collect();
        Self::new(wavenumber, density.iter().map(|value| value.max(0.0)).collect(), kind)?.with_square(&density)
    }

    /// The same spectrum times the factor that makes up for what `found` had below zero, where that is little.
    fn with_square(mut self, found: &[f64]) -> Result<Self, SurfaceError> {
        // each value stands for an interval between logarithms, so that an integral is a sum over q^n C with n axes
        let axes = if self.kind == SpectrumKind::Profile { 1 } else { 2 };
        let sum = |of: &dyn Fn(f64) -> f64| -> f64 {
            self.wavenumber.iter().zip(found).map(|(q, &value)| q.powi(axes) * of(value)).sum()
        };
        let (above, below) = (sum(&|value| value.max(0.0)), sum(&|value| (-value).max(0.0)));
        if below > MOST_BELOW * above {
            return Err(SurfaceError::SpectrumTable {
                place: None,
                reason: "no isotropic surface has profiles of this spectrum, which rises too steeply: give the spectrum of a surface, or \
                         average that of the profile in bands"
                    .into(),
            });
        }
        let factor = 1.0 - below / above;
        self.density.iter_mut().for_each(|value| *value *= factor);
        Ok(self)
    }

    /// The density of the profiles of an isotropic surface.
    fn of_profile(&self, q: f64) -> f64 {
        // k = q cosh(s), and no waves are shorter than the first wavenumber
        let [from, to] = [self.wavenumber[0], self.last()].map(|k| (k / q).max(1.0).acosh());
        let step = (to - from) / STEPS as f64;
        let ks = (0..STEPS).map(|i| q * (from + step * (i as f64 + 0.5)).cosh());
        2.0 * step * ks.map(|k| k * self.density(k)).sum::<f64>()
    }

    /// The density of the isotropic surface whose profiles have this spectrum.
    fn of_surface(&self, q: f64) -> f64 {
        let to = (BEYOND * self.last() / q).acosh();
        let step = to / STEPS as f64;
        let ks = (0..STEPS).map(|i| q * (step * (i as f64 + 0.5)).cosh());
        -step / std::f64::consts::PI * ks.map(|k| self.slope(k)).sum::<f64>()
    }

    /// `dC/dq` of the interpolated spectrum, continued beyond its end with its last slope in logarithms, where that falls.
    fn slope(&self, q: f64) -> f64 {
        let after = self.wavenumber.partition_point(|it| *it < q).clamp(1, self.wavenumber.len() - 1);
        let [[q0, q1], [c0, c1]] = [&self.wavenumber, &self.density].map(|of| [of[after - 1], of[after]]);
        if !(c0 > 0.0 && c1 > 0.0) {
            return if q <= self.last() { (c1 - c0) / (q1 - q0) } else { 0.0 };
        }
        let exponent = (c1 / c0).ln() / (q1 / q0).ln();
        let is_known = q <= self.last() || exponent < 0.0;
        if is_known { exponent * c0 * (q / q0).powf(exponent) / q } else { 0.0 }
    }
}
