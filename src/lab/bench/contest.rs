//! A contest: one contact, solved by one method after the other.

use super::group::Group;
use super::peak::peak_of;
use super::timing::Timing;
use crate::contact::{Load, Stop};
use crate::error::SetupError;
use crate::lab::Watch;
use crate::setup::{Cell, Method, Recipe, Setup};
use crate::surface::{Indenter, Spectrum};
use std::num::NonZeroUsize;
use std::time::Instant;

/// Length of the cell; the contact modulus is 1 as well.
pub const CELL: f64 = 1.0;
/// The most points of a quick contest, and the spacings that its shortest wavelength has at the least.
const QUICK_LINE: usize = 1 << 14;
const QUICK_SURFACE: usize = 256;
const QUICK_SPACINGS: f64 = 4.0;

/// One contact to be solved.
#[derive(Debug, Clone, PartialEq)]
pub struct Contest {
    /// The group that it belongs to.
    pub group: Group,
    /// Name in tables.
    pub name: String,
    /// The contact; the methods and their stop come later.
    pub setup: Setup,
}

impl Contest {
    /// A named indenter under its mean pressure.
    pub(super) fn smooth(group: Group, (name, indenter, pressure): (&str, Indenter, f64), cell: Cell) -> Self {
        let setup = Setup::new(Recipe::indenter(indenter), cell, Load::MeanPressure(pressure));
        Self { group, name: name.into(), setup }
    }

    /// Self-affine roughness with a roll-off at 1/8 of the cell for lines, 1/4 for surfaces, and a short cut-off at
    /// `1/waves` of that.
    pub(super) fn rough(group: Group, cell: Cell, waves: f64, hurst: f64, reduced_pressure: f64, seed: u64) -> Self {
        let rolloff_wavelength = if is_line(&cell) { CELL / 8.0 } else { CELL / 4.0 };
        let short_cutoff = rolloff_wavelength / waves;
        let spectrum = Spectrum { hurst, rolloff_wavelength, short_cutoff, rms_gradient: 1e-3 };
        let setup = Setup::new(Recipe::rough(spectrum, seed), cell, Load::ReducedPressure(reduced_pressure));
        Self { group, name: format!("H {hurst} p* {reduced_pressure}"), setup }
    }

    /// The contest on a small grid, without the waves that are too short for it.
    pub(super) fn quick(mut self) -> Self {
        let Setup { grid, surface, .. } = &mut self.setup;
        let most = if is_line(grid) { QUICK_LINE } else { QUICK_SURFACE };
        grid.points.iter_mut().for_each(|points| *points = most.min(*points));
        if let Some(spectrum) = &mut surface.spectrum {
            let shortest = QUICK_SPACINGS * CELL / grid.points[0] as f64;
            spectrum.short_cutoff = spectrum.short_cutoff.max(shortest);
        }
        self
    }

    /// Solves the contest by each method when its timing is asked for; all that was made is freed in between. With several
    /// methods the first is what the others are held against.
    ///
    /// # Errors
    /// Each timing, for a contact that a method cannot take on.
    pub fn timings<'a>(
        &'a self,
        methods: &'a [Method],
        stop: Stop,
        repeats: NonZeroUsize,
        watch: &'a mut Watch<'_>,
    ) -> impl Iterator<Item = Result<Timing, SetupError>> + 'a {
        let mut first = None;
        methods.iter().map(move |&solver| {
            let setup = Setup { solver, stop, ..self.setup.clone() };
            let (timing, peak_mib) = peak_of(|| self.time(&setup, repeats, watch));
            let timing = Timing { peak_mib, ..timing? };
            let first = *first.get_or_insert(timing.solve_seconds);
            Ok(Timing { ratio: (methods.len() > 1).then(|| timing.solve_seconds / first), ..timing })
        })
    }

    /// Makes and solves a contact.
    fn time(&self, setup: &Setup, repeats: NonZeroUsize, watch: &mut Watch<'_>) -> Result<Timing, SetupError> {
        let clock = Instant::now();
        let problem = setup.problem()?;
        let make_seconds = clock.elapsed().as_secs_f64();
        let mut solve_seconds = Vec::new();
        loop {
            let mut observer = watch(&format!("{} {}", self.name, self.points()));
            let contact = setup.solver.solver().solve(&problem, &setup.stop, &mut observer)?;
            solve_seconds.push(contact.work.seconds);
            if solve_seconds.len() == repeats.get() {
                return Ok(Timing::of(self.group, &self.name, &contact, make_seconds, solve_seconds));
            }
        }
    }

    /// Points of the grid, in words.
    pub fn points(&self) -> String {
        self.setup.grid.points.iter().map(usize::to_string).collect::<Vec<_>>().join("x")
    }
}

fn is_line(cell: &Cell) -> bool {
    cell.points.len() == 1
}
