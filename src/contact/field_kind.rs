//! The one table of the fields that states have besides those of their contacts.

use crate::contact::Unit;
use strum::{EnumIter, IntoEnumIterator};

/// A field of a state besides pressure, gap and displacement. Archives, recordings, the page and Python go through all of
/// them, in this order, and ask for the [`row`](FieldKind::row) of each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter)]
pub enum FieldKind {
    /// The traction along `x` on the solid.
    Traction,
    /// The slip of the surface of the solid along `x` relative to the rigid surface, from the state before to this one.
    Slip,
    /// The traction along `y` on the solid.
    TractionAcross,
    /// The slip of the surface of the solid along `y` relative to the rigid surface, from the state before to this one.
    SlipAcross,
    /// The traction by which the surfaces attract each other.
    Attraction,
    /// What a solid that creeps remembers, as the pressure that would cause the same displacement of the glassy solid.
    StoredStrain,
    /// How far a plastic strain displaces the surface into the solid: what would be left of it without a load.
    Imprint,
    /// The accumulated plastic strain in the layers of a cut.
    PlasticStrain,
    /// The von Mises stress in the layers of a cut, means over their thicknesses.
    VonMises,
    /// The magnitude of the flux of a leakage along `x` over its mean.
    FluxX,
    /// The pressure of a fluid that leaks along `x`, over its drop.
    FluidPressureX,
    /// The magnitude of the flux of a leakage along `y` over its mean.
    FluxY,
    /// The pressure of a fluid that leaks along `y`, over its drop.
    FluidPressureY,
}

/// What is known of a field without its values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FieldRow {
    /// The field that the row describes.
    pub kind: FieldKind,
    /// Its name in recordings, on the page and in Python.
    pub name: &'static str,
    /// The name of its array in archives.
    pub array: &'static str,
    /// Its title in pictures.
    pub title: &'static str,
    /// Its symbol on an axis, with what it is divided by: the contact modulus, the rms height, or the yield stress.
    pub symbol: &'static str,
    /// Its unit.
    pub unit: Unit,
    /// Where it lies.
    pub on: On,
    /// Whether it may be unknown in some places, which have NaN.
    pub may_be_unknown: bool,
}

/// Where a field lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum On {
    /// On the surface: its shape is `(ny, nx)`.
    Surface,
    /// In a vertical cut through the layers below the surface, see [`CutLayers`](crate::contact::CutLayers): its shape is
    /// `(layers, nx)`.
    Cut,
}

impl FieldKind {
    /// The field of a name.
    pub fn find(name: &str) -> Option<Self> {
        Self::iter().find(|kind| kind.row().name == name)
    }

    /// The row of the field.
    pub fn row(self) -> &'static FieldRow {
        &FIELDS[self as usize]
    }
}

/// A row to fill in, of a pure number on the surface that is known everywhere.
const ON_SURFACE: FieldRow = FieldRow {
    kind: FieldKind::Traction,
    name: "",
    array: "",
    title: "",
    symbol: "",
    unit: Unit::One,
    on: On::Surface,
    may_be_unknown: false,
};

/// The table, in the order of [`FieldKind`].
const FIELDS: [FieldRow; 13] = [
    FieldRow {
        kind: FieldKind::Traction,
        name: "traction",
        array: "traction",
        title: "Traction along x on the solid",
        symbol: "τ / E*",
        unit: Unit::Pressure,
        ..ON_SURFACE
    },
    FieldRow {
        kind: FieldKind::Slip,
        name: "slip",
        array: "slip",
        title: "Slip of the solid along x in this step",
        symbol: "slip / h_rms",
        unit: Unit::Length,
        ..ON_SURFACE
    },
    FieldRow {
        kind: FieldKind::TractionAcross,
        name: "traction_across",
        array: "traction_across",
        title: "Traction along y on the solid",
        symbol: "τ_y / E*",
        unit: Unit::Pressure,
        ..ON_SURFACE
    },
    FieldRow {
        kind: FieldKind::SlipAcross,
        name: "slip_across",
        array: "slip_across",
        title: "Slip of the solid along y in this step",
        symbol: "slip_y / h_rms",
        unit: Unit::Length,
        ..ON_SURFACE
    },
    FieldRow {
        kind: FieldKind::Attraction,
        name: "attraction",
        array: "attraction",
        title: "Attraction between the surfaces",
        symbol: "σ / E*",
        unit: Unit::Pressure,
        ..ON_SURFACE
    },
    FieldRow {
        kind: FieldKind::StoredStrain,
        name: "stored_strain",
        array: "stored_strain",
        title: "Stored strain, as a pressure",
        symbol: "Σ ε / E*",
        unit: Unit::Pressure,
        ..ON_SURFACE
    },
    FieldRow {
        kind: FieldKind::Imprint,
        name: "imprint",
        array: "imprint",
        title: "Displacement by plastic strain",
        symbol: "u^r / h_rms",
        unit: Unit::Length,
        ..ON_SURFACE
    },
    FieldRow {
        kind: FieldKind::PlasticStrain,
        name: "plastic_strain",
        array: "cut_plastic_strain",
        title: "Accumulated plastic strain α",
        symbol: "α",
        on: On::Cut,
        ..ON_SURFACE
    },
    FieldRow {
        kind: FieldKind::VonMises,
        name: "von_mises",
        array: "cut_von_mises",
        title: "Von Mises stress",
        symbol: "σ_v / Y",
        unit: Unit::Pressure,
        on: On::Cut,
        ..ON_SURFACE
    },
    FieldRow {
        kind: FieldKind::FluxX,
        name: "flux_x",
        array: "flux_x",
        title: "Flux of the leakage along x, over its mean",
        symbol: "|J_x| / <J_x>",
        ..ON_SURFACE
    },
    FieldRow {
        kind: FieldKind::FluidPressureX,
        name: "fluid_pressure_x",
        array: "fluid_pressure_x",
        title: "Pressure of the fluid along x, over its drop",
        symbol: "p_f / Δp",
        may_be_unknown: true,
        ..ON_SURFACE
    },
    FieldRow {
        kind: FieldKind::FluxY,
        name: "flux_y",
        array: "flux_y",
        title: "Flux of the leakage along y, over its mean",
        symbol: "|J_y| / <J_y>",
        ..ON_SURFACE
    },
    FieldRow {
        kind: FieldKind::FluidPressureY,
        name: "fluid_pressure_y",
        array: "fluid_pressure_y",
        title: "Pressure of the fluid along y, over its drop",
        symbol: "p_f / Δp",
        may_be_unknown: true,
        ..ON_SURFACE
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_row_stands_where_its_kind_does() {
        assert_eq!(FieldKind::iter().count(), FIELDS.len());
        for kind in FieldKind::iter() {
            assert_eq!(kind.row().kind, kind);
            assert_eq!(FieldKind::find(kind.row().name), Some(kind), "a name belongs to one field");
        }
    }
}
