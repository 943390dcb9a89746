//! Units of the numbers in a summary.

use asperity::contact::Load;
use asperity::quantity::{area_in_words, conductance_unit, length_in_words, number_in_words, pressure_in_words};
use asperity::setup::SetupTable;

/// Which numbers of a setup have known units: metres and pascals, or none that the program knows.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Units {
    /// Whether lengths are metres.
    pub metres: bool,
    /// Whether pressures are pascals.
    pub pascals: bool,
    /// The unit of a conductance per area, where lengths are metres and resistivities or conductivities have units.
    pub conductance: Option<&'static str>,
}

impl Units {
    /// The units that a setup states: in texts such as `160 um` and `1 GPa`, in its height files, or as the setup of a result.
    pub(crate) fn new(table: &SetupTable) -> Self {
        let (metres, texts) = (table.is_in_metres(), table.texts());
        let conductance = texts.iter().find_map(|text| conductance_unit(text)).filter(|_| metres);
        Self { metres, conductance, pascals: table.is_in_pascals() }
    }

    /// A length.
    pub(crate) fn length(self, value: f64) -> String {
        if self.metres { length_in_words(value) } else { plain(value) }
    }

    /// A pressure.
    pub(crate) fn pressure(self, value: f64) -> String {
        if self.pascals { pressure_in_words(value) } else { plain(value) }
    }

    /// A load that is prescribed.
    pub(crate) fn load(self, load: Load) -> String {
        match load {
            Load::MeanPressure(it) if self.pascals => format!("mean pressure {}", pressure_in_words(it)),
            Load::MeanGap(it) if self.metres => format!("mean gap {}", length_in_words(it)),
            Load::Approach(it) if self.metres => format!("approach {}", length_in_words(it)),
            other => other.to_string(),
        }
    }

    /// A position.
    pub(crate) fn position(self, value: f64) -> String {
        if self.metres { length_in_words(value) } else { format!("{value:.4e}") }
    }

    /// An area.
    pub(crate) fn area(self, value: f64) -> String {
        if self.metres { area_in_words(value) } else { plain(value) }
    }

    /// A force, with its unit in the SI.
    pub(crate) fn force(self, (value, unit): (f64, &str)) -> String {
        match self {
            Self { metres: true, pascals: true, .. } => format!("{} {unit}", number_in_words(value)),
            _ => number_in_words(value),
        }
    }

    /// An energy per area.
    pub(crate) fn energy_per_area(self, value: f64) -> String {
        match self {
            Self { metres: true, pascals: true, .. } => format!("{} J/m²", number_in_words(value)),
            _ => plain(value),
        }
    }
}

/// A number without a known unit, in full.
fn plain(value: f64) -> String {
    format!("{value:.6e}")
}

/// A pure number with six digits behind its point, or with as many significant ones where it is small.
pub(crate) fn significant(value: f64) -> String {
    match value.abs() {
        0.0 => "0".into(),
        1e-2..1e6 => format!("{value:.6}"),
        _ => format!("{value:.5e}"),
    }
}
