//! The observables: all numbers that are reported for a contact, in one table.
//!
//! A new observable needs one row of the table. Results, tables of studies, the page and the curves of recordings
//! follow from it.
//!
//! A plain name such as `relative_area` or `kappa_r` is the most accurate value, with contact edges interpolated
//! between the nodes. The errors `relative_area_error` and `kappa_r_error` belong to it. Names that end in `_counted`
//! are from counting nodes. Names that end in `_corrected` are from counting nodes, minus the mean excess.

use crate::contact::{
    Certificate, Contact, Counted, Load, Patches, Problem, Resolution, Resolved, StateValues, Step, Validity, Work,
    hysteretic_friction,
};
use ndarray::ArrayView1;
use serde::{Deserialize, Serialize};
use std::cell::LazyCell;

/// A number that is reported for a contact.
#[derive(Debug, Serialize)]
pub struct Observable {
    /// The name of its field in [`Observables`], with the unit where two are possible.
    pub name: &'static str,
    /// The symbol of the field.
    pub symbol: &'static str,
    /// The unit: `length`, `pressure`, their product `pressure length` or quotient `pressure/length`, or `1` for a pure number.
    pub unit: &'static str,
    /// Whether it is a whole number.
    #[serde(skip)]
    pub is_whole: bool,
    /// Whether the number is recorded at each step.
    pub is_traced: bool,
    /// The states for which it has a meaning.
    #[serde(skip)]
    pub validity: Validity,
    /// One sentence.
    pub sentence: &'static str,
    /// The number of a state; NaN if it is not known, or has no meaning.
    #[serde(skip)]
    pub value: fn(&State<'_>) -> f64,
}

/// A contact, or the state of a solver at a step, from which observables are computed. Values that need a pass over the
/// nodes are computed on first use, and once.
pub struct State<'a> {
    problem: &'a Problem,
    work: Work,
    values: StateValues,
    /// The certificate; NaN where it is not known.
    certificate: Certificate,
    /// The contact stiffness; NaN if it was not requested.
    stiffness: f64,
    counted: Lazy<'a, Counted>,
    resolved: Lazy<'a, Resolved>,
    patches: Lazy<'a, Patches>,
    /// Area and gradient of the contact on the next coarser grid, if they are known.
    coarser: Option<&'a Resolved>,
    mean_gap: Lazy<'a, f64>,
    /// The elastic energy; NaN where it is not known.
    elastic_energy: Lazy<'a, f64>,
    /// The approach; NaN if it is not known, or not defined.
    approach: Lazy<'a, f64>,
    plastic_area: Lazy<'a, f64>,
    plastic_overlap: Lazy<'a, f64>,
    mean_pressure: Lazy<'a, f64>,
    max_pressure: Lazy<'a, f64>,
    /// The hysteretic friction; NaN at rest.
    friction: Lazy<'a, f64>,
}

/// What stands for a number without a meaning.
trait Unknown {
    const UNKNOWN: Self;
}

impl Unknown for f64 {
    const UNKNOWN: Self = f64::NAN;
}

impl Unknown for usize {
    const UNKNOWN: Self = 0;
}

impl Unknown for u64 {
    const UNKNOWN: Self = 0;
}

type Lazy<'a, T> = LazyCell<T, Box<dyn FnOnce() -> T + 'a>>;

fn lazy<'a, T>(make: impl FnOnce() -> T + 'a) -> Lazy<'a, T> {
    LazyCell::new(Box::new(make))
}

/// Makes of the rows the struct [`Observables`] and the table [`OBSERVABLES`].
macro_rules! observables {
    ($($name:ident: $type:ty, $validity:ident, $symbol:literal, $unit:literal, $is_traced:literal, $of:expr, $sentence:literal;)+) => {
        /// The observables of a contact; those that are not known are NaN.
        ///
        /// ```
        /// use asperity::contact::{OBSERVABLES, Observables};
        /// use asperity::setup::Setup;
        /// let setup = Setup::from_toml("
        ///     surface = { indenter = { shape = 'sine', amplitude = 0.01 } }
        ///     grid = { points = 256, size = 1.0 }
        ///     load = { reduced-pressure = 0.1 }
        /// ")?;
        /// let contact = setup.solver.solver().solve(&setup.problem()?, &setup.stop, &mut ())?;
        /// let found = Observables::new(&contact);
        /// assert_eq!((found.patches, found.kappa_r), (1, contact.resolved().kappa_r));
        /// assert!(OBSERVABLES.iter().any(|row| row.name == "mean_gap" && row.unit == "length"));
        /// # Ok::<(), Box<dyn std::error::Error>>(())
        /// ```
        #[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
        #[serde(default)]
        pub struct Observables {
            $(#[doc = $sentence] pub $name: $type,)+
        }

        /// The table of observables.
        pub const OBSERVABLES: &[Observable] = &[$(Observable {
            name: stringify!($name),
            symbol: $symbol,
            unit: $unit,
            is_whole: !matches!(stringify!($type).as_bytes(), b"f64"),
            is_traced: $is_traced,
            validity: Validity::$validity,
            sentence: $sentence,
            value: |state| {
                let of: fn(&State<'_>) -> $type = $of;
                if Validity::$validity.holds(state.values.kind) { of(state) as f64 } else { f64::NAN }
            },
        },)+];

        impl Observables {
            /// Takes all observables from a contact, or from a step.
            pub fn new<'a>(state: impl Into<State<'a>>) -> Self {
                let state = state.into();
                Self {
                    $($name: {
                        let of: fn(&State<'_>) -> $type = $of;
                        if Validity::$validity.holds(state.values.kind) { of(&state) } else { Unknown::UNKNOWN }
                    },)+
                }
            }

            /// The numbers, in the order of [`OBSERVABLES`].
            pub fn numbers(&self) -> [f64; OBSERVABLES.len()] {
                [$(self.$name as f64,)+]
            }
        }
    };
}

// name: type, validity, symbol, unit, whether it is traced, how it is computed from a state, one sentence
#[rustfmt::skip]
observables! {
    mean_pressure: f64, Always, "<p>", "pressure", false, |it| *it.mean_pressure,
        "Mean pressure.";
    reduced_pressure: f64, Always, "p*", "1", false, |it| it.reduced_pressure(),
        "Reduced pressure: mean pressure divided by rms gradient and contact modulus, of a contact that slides by its effective modulus.";
    reduced_pressure_contact: f64, Elastic, "p_r*", "1", false, |it| it.resolved.reduced_pressure_contact,
        "Reduced pressure with the rms gradient of the contact.";
    reduced_pressure_contact_counted: f64, Elastic, "p_r*, counted", "1", false, |it| it.counted.reduced_pressure_contact,
        "Reduced pressure with the rms gradient of the nodes in contact.";
    relative_area: f64, Always, "a_rel", "1", true, |it| it.relative_area(),
        "Relative contact area, with contact edges interpolated between grid nodes.";
    relative_area_counted: f64, Always, "a_rel, counted", "1", true, |it| it.counted.relative_area,
        "Relative contact area as the fraction of nodes in contact.";
    relative_area_corrected: f64, Elastic, "a_rel, corrected", "1", false, |it| it.counted.relative_area_corrected,
        "Fraction of nodes in contact, minus the mean excess of counted nodes at the edges.";
    rms_height: f64, Always, "h_rms", "length", false, |it| it.problem.rms_height(),
        "Root mean square of the heights about their mean.";
    rms_gradient: f64, Always, "g_rms", "1", false, |it| it.problem.rms_gradient(),
        "Root-mean-square gradient of the surface.";
    rms_gradient_contact: f64, Elastic, "g_r", "1", false, |it| it.resolved.rms_gradient_contact,
        "Root-mean-square gradient over the contact, with contact edges interpolated between grid nodes.";
    rms_gradient_contact_counted: f64, Always, "g_r, counted", "1", false, |it| it.counted.rms_gradient_contact,
        "Root-mean-square gradient of the nodes in contact.";
    rms_gradient_contact_corrected: f64, Elastic, "g_r, corrected", "1", false, |it| it.counted.rms_gradient_contact_corrected,
        "Root-mean-square gradient of the nodes in contact, minus the mean excess of counted nodes at the edges.";
    kappa: f64, Elastic, "kappa", "1", true, |it| it.resolved.relative_area / it.counted.reduced_pressure,
        "Relative contact area divided by reduced pressure, with contact edges interpolated between grid nodes.";
    kappa_counted: f64, Elastic, "kappa, counted", "1", false, |it| it.counted.kappa,
        "Fraction of nodes in contact divided by reduced pressure.";
    kappa_corrected: f64, Elastic, "kappa, corrected", "1", false, |it| it.counted.relative_area_corrected / it.counted.reduced_pressure,
        "Corrected relative contact area divided by reduced pressure.";
    kappa_r: f64, NoAdhesion, "kappa_r", "1", true, |it| it.values.kappa_r.unwrap_or_else(|| it.resolved.kappa_r),
        "Relative contact area divided by the reduced pressure with the rms gradient of the contact, with contact edges interpolated between grid nodes.";
    kappa_r_counted: f64, Elastic, "kappa_r, counted", "1", true, |it| it.counted.kappa_r,
        "Fraction of nodes in contact, divided by the reduced pressure with the rms gradient of these nodes.";
    kappa_r_corrected: f64, Elastic, "kappa_r, corrected", "1", false, |it| it.counted.kappa_r_corrected,
        "Corrected relative contact area divided by the reduced pressure with the corrected rms gradient of the contact.";
    mean_gap: f64, Always, "<g>", "length", false, |it| *it.mean_gap,
        "Mean gap between the surfaces.";
    mean_gap_over_rms_height: f64, Always, "<g> / h_rms", "1", true, |it| *it.mean_gap / it.problem.rms_height(),
        "Mean gap divided by the rms height.";
    elastic_energy: f64, Elastic, "U", "pressure length", false, |it| *it.elastic_energy,
        "Elastic energy per area: half the mean of pressure times displacement.";
    approach: f64, Always, "d", "length", false, |it| *it.approach,
        "Approach: distance that the surface has moved since its highest peak touched the undeformed solid. Not defined on a periodic half-space.";
    plastic_area: f64, Elastic, "a_pl", "1", false, |it| *it.plastic_area,
        "Relative plastic area: the fraction of nodes at the hardness, where the solid yields.";
    plastic_overlap: f64, Yielding, "<o>", "length", false, |it| *it.plastic_overlap,
        "Mean overlap of the surfaces where they yield or have yielded, not part of the mean gap: the plastically displaced volume per area of the cell.";
    max_pressure: f64, Always, "p_max", "pressure", false, |it| *it.max_pressure,
        "Largest pressure.";
    max_pressure_over_modulus: f64, Always, "p_max / E*", "1", false, |it| *it.max_pressure / it.problem.contact_modulus(),
        "Largest pressure divided by the contact modulus.";
    effective_modulus: f64, Sliding, "E*_eff", "pressure", false, |it| it.effective_modulus(),
        "Contact modulus that reduced pressures, kappa and kappa_r use: E*, or between the relaxed and the glassy one for a contact that slides over a viscoelastic solid.";
    patches: usize, Always, "n", "1", true, |it| it.patches.count(),
        "Number of contact patches.";
    nodes_per_patch: f64, Always, "n_c / n", "1", false, |it| it.resolution().nodes_per_patch,
        "Nodes in contact per contact patch.";
    unresolved_share: f64, Always, "n_c < few / n_c", "1", false, |it| it.resolution().unresolved_share,
        "Fraction of the nodes in contact that are in patches too small to trust: fewer than 4 nodes on lines, 12 on surfaces.";
    edges_of_shape: f64, Elastic, "n_e / n", "1", false, |it| it.resolved.edges_of_shape as f64 / (it.resolved.edges.max(1)) as f64,
        "Fraction of the contact edges that are given by the shape of the surface, such as the rim of a punch.";
    relative_area_error: f64, NoAdhesion, "|da| / a_rel", "1", false, |it| it.resolution().relative_area_error,
        "Estimated relative error of the relative contact area on this grid.";
    kappa_r_error: f64, NoAdhesion, "|dkappa_r| / kappa_r", "1", false, |it| it.resolution().kappa_r_error,
        "Estimated relative error of kappa_r on this grid.";
    certificate: f64, NoAdhesion, "eta", "1", true, |it| it.certificate.eta,
        "Certificate: a bound of the energy error, divided by load times rms height.";
    pressure_error_bound: f64, Elastic, "|dp| / |p|", "1", false, |it| it.certificate.pressure_error_bound,
        "Bound of the relative error of the pressure in the energy norm.";
    certificate_gap: f64, Elastic, "eta_D", "1", false, |it| it.certificate.eta_gap,
        "Certificate at a given mean gap, divided by the remaining gap: the order of magnitude of the relative error of the load.";
    mean_gap_error_bound: f64, Elastic, "|d<g>| / h_rms", "1", false, |it| it.certificate.mean_gap_error_bound,
        "Bound of the error of the mean gap, divided by the rms height.";
    penetration: f64, Elastic, "-min g / h_rms", "1", false, |it| it.certificate.penetration,
        "Largest penetration divided by the rms height.";
    load_error: f64, Elastic, "|dl| / l", "1", false, |it| it.certificate.load_error,
        "Error of the load, relative to the given load; at a given mean gap, relative to the rms height.";
    stiffness: f64, Elastic, "k", "pressure/length", false, |it| it.stiffness,
        "Contact stiffness: increase of the mean pressure per decrease of the mean gap. Computed on request.";
    mean_pressure_error: f64, Elastic, "|d<p>| / <p>", "1", false, |it| it.mean_pressure_error(),
        "Relative error of the mean pressure at a given mean gap, to first order, from the contact stiffness; 0 if the pressure is given.";
    friction: f64, Elastic, "mu", "1", false, |it| *it.friction,
        "Hysteretic friction coefficient of a contact that slides over a viscoelastic solid: the force along x by the loss in the solid over the load. Not defined at rest.";
    iterations: usize, Always, "iterations", "1", false, |it| it.work.iterations,
        "Iterations of the solver.";
    transforms: u64, Always, "transforms", "1", false, |it| it.work.transforms,
        "Fourier transforms, forward and inverse.";
}

impl Observables {
    /// The relative area, where the grid resolves it.
    pub fn resolved_area(&self) -> Option<f64> {
        resolved(self.relative_area, self.relative_area_error)
    }

    /// `kappa`, where the grid resolves the relative area.
    pub fn resolved_kappa(&self) -> Option<f64> {
        resolved(self.kappa, self.relative_area_error)
    }

    /// `kappa_r`, where the grid resolves it.
    pub fn resolved_kappa_r(&self) -> Option<f64> {
        resolved(self.kappa_r, self.kappa_r_error)
    }
}

/// A value whose error is smaller than the value. If patches have too few nodes, the value is 0 or NaN, or its error is
/// unknown or infinite.
fn resolved(value: f64, error: f64) -> Option<f64> {
    (value.is_finite() && value > 0.0 && error < 1.0).then_some(value)
}

impl Observable {
    /// Whether the observable says something of a contact that others do not: no overlap where nothing yields, and no modulus of a motion at
    /// rest.
    pub fn tells_of(&self, contact: &Contact) -> bool {
        let problem = &contact.problem;
        let is_there = match self.validity {
            Validity::Yielding => !problem.law().is_hard_wall() || problem.flattened_by() > 0.0,
            Validity::Sliding => problem.is_moving(),
            Validity::Always | Validity::NoAdhesion | Validity::Elastic => true,
        };
        is_there && self.validity.holds(contact.values().kind)
    }
}

impl State<'_> {
    /// How well the grid resolves the contact.
    fn resolution(&self) -> Resolution {
        let grid = self.problem.surface().grid();
        Resolution::new(grid, &self.counted, &self.resolved, &self.patches, self.coarser)
    }

    /// The modulus by which pressures are reduced, from those that are.
    fn effective_modulus(&self) -> f64 {
        *self.mean_pressure / (self.counted.reduced_pressure * self.problem.rms_gradient())
    }

    /// The reduced pressure: that of the state, or the prescribed one, to the last bit, or else the computed one, as that of a contact that
    /// moves, whose modulus depends on the motion.
    fn reduced_pressure(&self) -> f64 {
        match (self.values.mean_pressure, self.problem.load()) {
            (Some(pressure), _) => pressure / (self.problem.rms_gradient() * self.problem.contact_modulus()),
            (None, Load::ReducedPressure(prescribed)) if !self.problem.is_moving() => prescribed,
            (None, _) => self.counted.reduced_pressure,
        }
    }

    /// The relative area: that of the state, or else with edges interpolated between the nodes.
    fn relative_area(&self) -> f64 {
        self.values.relative_area.unwrap_or_else(|| self.resolved.relative_area)
    }

    /// The stiffness times the error of the gap, divided by the mean pressure.
    fn mean_pressure_error(&self) -> f64 {
        if self.problem.datum().is_none() {
            return 0.0;
        }
        self.stiffness * self.certificate.eta * self.problem.rms_height() / *self.mean_pressure
    }
}

impl<'a> From<&'a Contact> for State<'a> {
    fn from(contact: &'a Contact) -> Self {
        Self {
            problem: &contact.problem,
            work: contact.work,
            values: contact.values(),
            certificate: contact.certificate,
            stiffness: contact.known_stiffness().unwrap_or(f64::NAN),
            counted: lazy(|| contact.counted()),
            resolved: lazy(|| contact.resolved()),
            patches: lazy(|| contact.patches()),
            coarser: contact.coarser.as_ref(),
            mean_gap: lazy(|| contact.mean_gap()),
            elastic_energy: lazy(|| contact.elastic_energy()),
            approach: lazy(|| contact.approach().unwrap_or(f64::NAN)),
            plastic_area: lazy(|| contact.plasticity().area),
            plastic_overlap: lazy(|| contact.plasticity().overlap),
            mean_pressure: lazy(|| contact.values().mean_pressure.unwrap_or_else(|| contact.mean_pressure())),
            max_pressure: lazy(|| contact.max_pressure()),
            friction: lazy(|| contact.friction()),
        }
    }
}

impl<'a> From<&'a Step<'_>> for State<'a> {
    fn from(step: &'a Step<'_>) -> Self {
        let pressure = || ArrayView1::from(step.pressure());
        Self {
            problem: step.problem(),
            work: step.work(),
            values: step.values(),
            stiffness: f64::NAN,
            certificate: step.certificate().copied().unwrap_or(Certificate::UNKNOWN),
            counted: lazy(|| *step.counted()),
            resolved: lazy(|| *step.resolved()),
            patches: lazy(|| step.patches().clone()),
            coarser: None,
            mean_gap: lazy(|| step.mean_gap()),
            elastic_energy: lazy(|| f64::NAN),
            approach: lazy(|| f64::NAN),
            plastic_area: lazy(move || {
                let yielding = pressure().iter().filter(|p| step.problem().law().yields(**p)).count();
                yielding as f64 / pressure().len() as f64
            }),
            plastic_overlap: lazy(|| step.mean_gap() - step.separation()),
            mean_pressure: lazy(move || {
                step.values().mean_pressure.unwrap_or_else(|| pressure().mean().unwrap_or(0.0))
            }),
            max_pressure: lazy(move || pressure().fold(0.0, |max: f64, &p| max.max(p))),
            friction: lazy(|| hysteretic_friction(step.problem(), step.pressure(), step.displacement())[1]),
        }
    }
}
