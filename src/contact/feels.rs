//! What a solid feels besides the pressure.

/// What a solid feels besides the pressure between the surfaces, as far as the quantities of a state depend on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Feels {
    /// An attraction between the surfaces, which displaces the solid and stresses it.
    pub attraction: bool,
    /// A strain that is not elastic, such as plastic strain, which displaces the solid and leaves a stress in it.
    pub eigenstrain: bool,
    /// Earlier pressures, which displace the solid. The stress is that of the present pressure.
    pub memory: bool,
}

impl Feels {
    /// The pressure alone: an elastic solid, also one whose surface yields under a hardness, slips, slides or rolls.
    pub const PRESSURE: Self = Self { attraction: false, eigenstrain: false, memory: false };
    /// An attraction between the surfaces.
    pub const ATTRACTION: Self = Self { attraction: true, ..Self::PRESSURE };
    /// A strain that is not elastic.
    pub const EIGENSTRAIN: Self = Self { eigenstrain: true, ..Self::PRESSURE };
    /// Earlier pressures.
    pub const MEMORY: Self = Self { memory: true, ..Self::PRESSURE };

    /// Whether the solid feels the pressure alone, so that displacement, energy and stress follow from it.
    pub fn is_pressure_alone(self) -> bool {
        self == Self::PRESSURE
    }
}
