//! Units of length in files of instruments.

/// Metres in a unit of length by the names that instruments write; none for other names.
pub(super) fn metres(unit: &str) -> Option<f64> {
    Some(match unit.trim().trim_matches(['[', ']', '(', ')']) {
        "m" | "metre" | "meter" => 1.0,
        "cm" => 1e-2,
        "mm" | "millimetre" | "millimeter" => 1e-3,
        "µm" | "μm" | "um" | "~m" | "micron" | "microns" | "micrometre" | "micrometer" => 1e-6,
        "nm" | "nanometre" | "nanometer" => 1e-9,
        "Å" | "A" | "Angstrom" | "angstrom" => 1e-10,
        "pm" => 1e-12,
        "in" | "inch" => 25.4e-3,
        "mil" => 25.4e-6,
        _ => return None,
    })
}

/// Metres in a unit of length of files that write the ampere as A, too; none for other units.
pub(super) fn metres_of_si(unit: &str) -> Option<f64> {
    metres(unit).filter(|_| unit.trim() != "A")
}

/// The unit of distances along x of a map with units along y and x, of which none is taken for the other; none if one is not known.
pub(super) fn lateral(along_y: Option<f64>, along_x: Option<f64>) -> Option<f64> {
    along_x.filter(|_| along_y.is_some())
}

/// How many of a unit one of another is, if both are known.
pub(super) fn ratio(unit: Option<f64>, other: Option<f64>) -> f64 {
    unit.zip(other).map_or(1.0, |(unit, other)| unit / other)
}
