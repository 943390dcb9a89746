//! Rulers: axes whose numbers are in a power of a thousand of a unit.

use crate::plot::Axis;
use crate::record::units::{engineering_exponent, scaled_unit, with_unit};

/// The smallest gap, over the rms height, that an axis is fitted to: below it a full contact would show its rounding errors.
const LEAST_GAP: f64 = 1e-3;
/// The end of an axis over the largest value on it.
const HEADROOM: f64 = 1.08;

/// An axis for the values of a quantity, its numbers in a power of a thousand of a unit.
#[derive(Debug, Clone)]
pub(crate) struct Ruler {
    /// The axis, in numbers.
    pub axis: Axis,
    /// The value at the number 1.
    pub unit: f64,
    /// The smallest value that the axis is fitted to.
    least: f64,
}

impl Ruler {
    /// An axis over `low..high` in a unit, which may be empty; an empty range is widened.
    pub(crate) fn new(symbol: &str, unit: &str, [low, high]: [f64; 2]) -> Self {
        let high = if high > low { high } else { low + low.abs().max(f64::MIN_POSITIVE) };
        let exponent = engineering_exponent(low.abs().max(high.abs()), unit.is_empty());
        let power = 10f64.powi(exponent);
        let unit = scaled_unit(unit, exponent);
        Self { axis: Axis::linear(with_unit(symbol, &unit), [low / power, high / power]), unit: power, least: 0.0 }
    }

    /// An axis for pressures from 0 to `highest`, in `contact_modulus`.
    pub(crate) fn pressure(highest: f64, contact_modulus: f64) -> Self {
        Self::over_modulus("p / E*", highest, contact_modulus)
    }

    /// An axis for shear stresses from 0 to `highest`, in `contact_modulus`.
    pub(crate) fn shear(highest: f64, contact_modulus: f64) -> Self {
        Self::over_modulus("τ_max / E*", highest, contact_modulus)
    }

    fn over_modulus(symbol: &str, highest: f64, contact_modulus: f64) -> Self {
        let ruler = Self::new(symbol, "", [0.0, HEADROOM * highest / contact_modulus]);
        Self { unit: ruler.unit * contact_modulus, ..ruler }
    }

    /// An axis for gaps from 0 to `highest`, in `rms_height`.
    pub(crate) fn gap(highest: f64, rms_height: f64) -> Self {
        let ruler = Self::new("gap / h_rms", "", [0.0, HEADROOM * highest / rms_height]);
        Self { unit: ruler.unit * rms_height, least: LEAST_GAP * rms_height, ..ruler }
    }

    /// An axis for values of a range, in a unit, with some room at each end that is not zero.
    pub(crate) fn over(symbol: &str, range: [f64; 2], unit: f64) -> Self {
        let ruler = Self::new(symbol, "", range.map(|end| HEADROOM * end / unit));
        Self { unit: ruler.unit * unit, ..ruler }
    }

    /// The axis fitted to values up to `highest`.
    pub(crate) fn fitted(&self, highest: f64) -> Axis {
        let [low, high] = self.axis.range;
        let fitted = HEADROOM * highest.max(self.least) / self.unit;
        Axis { range: [low, if fitted > low { fitted } else { high }], ..self.axis.clone() }
    }

    /// The place of `value` along the axis: 0 at its start, 1 at its end.
    pub(crate) fn place(&self, value: f64) -> f64 {
        self.axis.place(value / self.unit)
    }

    /// The share of the axis that lies between two values `difference` apart.
    pub(crate) fn share(&self, difference: f64) -> f64 {
        let [low, high] = self.axis.range;
        difference / (self.unit * (high - low))
    }
}

/// A length with its unit, such as `x: 160 µm`.
pub(crate) fn measured(symbol: &str, unit: &str, length: f64) -> String {
    let exponent = engineering_exponent(length, unit.is_empty());
    let number = format!("{:.3}", length / 10f64.powi(exponent));
    let number = number.trim_end_matches('0').trim_end_matches('.');
    format!("{symbol}: {number} {}", scaled_unit(unit, exponent)).trim_end().into()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ruler(high: f64, unit: &str) -> Ruler {
        Ruler::new("x", unit, [0.0, high])
    }

    #[test]
    fn names_carry_unit_and_power() {
        let named = [(160e-6, "m", "x [µm]"), (2e-3, "", "x [1e-3]"), (2e7, "mm", "x [1e6 mm]"), (5.0, "", "x")];
        for (high, unit, name) in named {
            assert_eq!(ruler(high, unit).axis.name, name);
        }
        assert_eq!(measured("x", "m", 160e-6), "x: 160 µm");
        assert_eq!(measured("y", "R", 2.5), "y: 2.5 R");
    }

    #[test]
    fn values_have_places_and_ticks_are_numbers() {
        let ruler = ruler(160e-6, "m");
        assert!((ruler.place(40e-6) - 0.25).abs() < 1e-12 && (ruler.share(40e-6) - 0.25).abs() < 1e-12);
        let labels: Vec<String> = ruler.axis.ticks().into_iter().map(|(_, label)| label).collect();
        assert_eq!(labels, ["0", "50", "100", "150"]);
        assert!(Ruler::new("x", "R", [2.0, 2.0]).axis.ticks().len() > 3);
    }

    #[test]
    fn axes_are_fitted_to_what_they_show() {
        let gap = Ruler::gap(10.0, 2.0);
        assert_eq!((gap.fitted(4.0).range, gap.fitted(0.0).range), ([0.0, 2.16], [0.0, 1.08e-3]));
        let pressure = Ruler::pressure(3.0, 10.0);
        assert_eq!((pressure.unit, pressure.fitted(0.0)), (10.0, pressure.axis.clone()));
    }
}
