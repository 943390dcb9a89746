//! Steady sliding over a viscoelastic solid.

use crate::contact::{Feels, Problem, Quantity};
use crate::error::{ConflictRule, SetupError};
use crate::history::SlidingProcess;
use crate::setup::Setup;
use crate::setup::cost::bytes;
use crate::setup::drive::{Drive, StateChart};
use crate::setup::ingredient::Ingredient;
use crate::setup::key::{Dimension, FlagValue, Key, key};

/// Fields that sliding takes besides its solves, lines and surfaces, and for each term of the Prony series. Measured as the peak of resident memory.
const FIELDS: [f64; 2] = [22.0, 14.0];
const TERM_FIELDS: f64 = 2.0;

#[rustfmt::skip]
const KEYS: &[Key] = &[
    key("sliding.speed", "speed", FlagValue::List, Dimension::Speed, "V[,V]", "Speed at which the surface slides steadily over a viscoelastic solid along x; 1e-3..1e3:13 for 13 speeds with equal ratios"),
];

/// Steady sliding over a viscoelastic solid, one state for each speed.
pub(crate) const SLIDING: Drive = Drive {
    name: "sliding",
    keys: KEYS,
    given: Ingredient { path: "sliding", name: "sliding", is_given: |it| it.sliding.is_some() },
    takes: &["load"],
    needs: &["viscoelastic"],
    states: |it| it.sliding.as_ref().map_or(0, |it| it.speed.len()),
    check: |_, grid| if grid.is_periodic() { Ok(()) } else { Err(ConflictRule::SlidingOfFree.into()) },
    bytes: |it, grid| {
        let terms = it.memory()?.len() as f64;
        Ok(bytes(grid, FIELDS[usize::from(!grid.is_line())] + TERM_FIELDS * terms))
    },
    transforms: |_, _| Ok(Drive::TRANSFORMS_OF_WARM_STATE),
    make: |it, problem| Ok(Box::new(it.slides(problem)?)),
    doubts: |it, _| it.warnings_of_creep(),
    totals: |_| Vec::new(),
    needs_pressure: false,
    is_list: false,
    missed: Drive::WITHOUT_CERTIFICATE,
    axis: Some(Quantity::Speed),
    is_logarithmic: true,
    charts: [
        StateChart::against(Quantity::Speed, Quantity::Friction),
        StateChart::against(Quantity::Speed, Quantity::RelativeArea),
    ],
    columns: &[
        Quantity::Speed,
        Quantity::Friction,
        Quantity::FrictionError,
        Quantity::FrictionFullContact,
        Quantity::FrictionPersson,
        Quantity::RelativeArea,
        Quantity::MeanGap,
        Quantity::MaxPressure,
        Quantity::Certificate,
    ],
    caption: &[Quantity::Speed, Quantity::Friction],
    has_claims: false,
    feels: Feels::PRESSURE,
};

impl Setup {
    /// What makes the states of sliding, one for each speed.
    fn slides(&self, problem: Problem) -> Result<SlidingProcess, SetupError> {
        let speeds = self.sliding.clone().map_or(Vec::new(), |it| it.speed);
        Ok(SlidingProcess::new(problem, self.prony()?, speeds, self.stop))
    }
}
