//! The findings of a solve under one load: status, observables, and the exact solution where there is one.

use super::flow::FlowFinding;
use super::units::{Units, significant};
use asperity::contact::{Contact, Load, Observables, Plasticity, Quantity, ResultClaim, Status, Unit};
use asperity::history::Sliding;
use asperity::setup::Setup;
use asperity::theory::Exact;
use serde::{Serialize, Serializer};

/// Values below this one are written with powers of ten.
const SMALL: f64 = 1e-3;

/// The words beside `kappa_r` of a contact with a hardness whose surface has yielded somewhere.
const FLATTENED: &str = "   by the gradient before the surface is flattened: do not compare it with elastic contacts";

/// The share of edges given by the shape is reported above this value.
const MANY_OF_SHAPE: f64 = 0.05;

/// The numbers of a contact under its load.
#[derive(Serialize)]
pub(crate) struct Finding {
    pub status: Status,
    /// The claim of the contact: what its certificate proves.
    pub claim: ResultClaim,
    #[serde(flatten)]
    pub observables: Observables,
    /// What its motion gives besides, of a contact that slides.
    #[serde(flatten)]
    pub motion: MotionNumbers,
    pub seconds: f64,
    /// What yields, where there is a hardness.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plasticity: Option<Plasticity>,
    /// The exact solution under the same mean pressure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exact: Option<Exact>,
    /// The force with its unit in the SI, where one is prescribed.
    #[serde(skip)]
    pub force: Option<(f64, &'static str)>,
    /// Whether the cell repeats.
    #[serde(skip)]
    pub has_neighbours: bool,
    /// Leakage and conductance, where `--flow` or `--resistivity` is given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub flow: Option<FlowFinding>,
}

/// The numbers of a contact that slides besides its observables, in the order of [`Sliding::NUMBERS`]; none of others.
pub(crate) struct MotionNumbers(Vec<(Quantity, f64)>);

impl MotionNumbers {
    fn new(contact: &Contact) -> Self {
        let known = Sliding::NUMBERS.into_iter().filter(|_| contact.problem.is_moving());
        Self(known.filter_map(|quantity| Some((quantity, contact.values().get(quantity)?))).collect())
    }

    fn get(&self, quantity: Quantity) -> Option<f64> {
        self.0.iter().find(|(other, _)| *other == quantity).map(|(_, value)| *value)
    }
}

impl Serialize for MotionNumbers {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(quantity, value)| (quantity.name(), value)))
    }
}

impl Finding {
    pub(crate) fn new(setup: &Setup, contact: &Contact) -> Self {
        let grid = contact.problem.surface().grid();
        let unit = if grid.is_line() { "N/m" } else { "N" };
        let force = matches!(setup.load, Load::Force(_)).then(|| (contact.mean_pressure() * grid.area(), unit));
        Self {
            force,
            status: contact.status,
            claim: contact.claim(),
            observables: Observables::new(contact),
            motion: MotionNumbers::new(contact),
            seconds: contact.work.seconds,
            plasticity: setup.law.hardness().map(|_| contact.plasticity()),
            exact: setup.exact(grid, contact.mean_pressure()),
            has_neighbours: grid.is_periodic(),
            flow: None,
        }
    }

    /// Names and values for reading, the results first: each with its error.
    pub(crate) fn rows(&self, units: Units) -> Vec<(String, String)> {
        let stiffness = Some(&self.observables).filter(|it| !it.stiffness.is_nan()).map(|it| {
            let load = plus_or_minus(", mean pressure", it.mean_pressure_error);
            ("contact stiffness", format!("{:.6e}{load}", it.stiffness))
        });
        let exact = self.exact.as_ref().map(|exact| ("exact values", exact.name.to_owned()));
        let friction = Some(self.observables.friction).filter(|it| it.is_finite());
        let slides = friction.is_some().then_some(self.observables.effective_modulus);
        let modulus =
            slides.map(|it| ("effective modulus", format!("{}, of p*, kappa and kappa_r", units.pressure(it))));
        let friction = friction.into_iter().flat_map(|it| self.friction_rows(it));
        let approach = Some(self.observables.approach).filter(|it| !it.is_nan());
        let approach = approach.map(|approach| ("approach", units.length(approach)));
        let plasticity = self.plasticity.iter().flat_map(|it| {
            [
                ("plastic area", format!("{} ({} of the load)", significant(it.area), percent(it.load_share))),
                ("plastic overlap", format!("{}, mean over the cell", units.length(it.overlap))),
            ]
        });
        let claim = (self.claim != ResultClaim::Solution).then(|| ("claim", self.claim.words().to_owned()));
        let results = self.results(units).into_iter().chain(claim).chain(friction).chain(modulus).chain(approach);
        let results = results.chain(plasticity).chain(stiffness).chain(exact);
        let flow = self.flow.iter().flat_map(|it| it.rows(units));
        results.map(|(name, value)| (name.to_owned(), value)).chain(flow).collect()
    }

    /// The friction of a contact that slides with the error of its grid, and what theory says.
    fn friction_rows(&self, friction: f64) -> Vec<(&'static str, String)> {
        let error = self.motion.get(Quantity::FrictionError);
        let error = error.map_or(String::new(), |error| plus_or_minus("", friction.abs() * error));
        let mut rows = vec![("friction coefficient", format!("{friction:.6e}{error} (by the loss in the solid)"))];
        let [full, persson] = [Quantity::FrictionFullContact, Quantity::FrictionPersson].map(|it| self.motion.get(it));
        if let (Some(full), Some(persson)) = (full, persson) {
            rows.push(("friction, full contact", format!("{full:.6e}, by Persson's theory {persson:.6e}")));
        }
        rows
    }

    /// Area, `kappa_r`, gap and pressures, and the certificate.
    fn results(&self, units: Units) -> [(&'static str, String); 6] {
        let it = &self.observables;
        let force = self.force.map_or(String::new(), |force| format!(" (force {})", units.force(force)));
        let words = self.exact_words();
        let exact = |value: Option<f64>| value.map_or(String::new(), |v| format!("   {words} {}", significant(v)));
        let area = exact(self.exact.as_ref().map(|exact| exact.relative_area));
        let kappa_r = exact(self.exact.as_ref().and_then(|exact| exact.kappa_r));
        let flattened = if self.plasticity.as_ref().is_some_and(|it| it.area > 0.0) { FLATTENED } else { "" };
        let error = plus_or_minus("", it.mean_gap_error_bound);
        let gap = format!("{} ({:.4}{error} rms heights)", units.length(it.mean_gap), it.mean_gap_over_rms_height);
        let left = match it.certificate_gap > 0.0 {
            true => format!(", {:.1e} of the remaining gap", it.certificate_gap),
            false => String::new(),
        };
        let bound = format!("relative error of the pressure at most {:.1e}", it.pressure_error_bound);
        [
            ("relative area", with_error(it.resolved_area(), it.relative_area_error) + &area),
            ("kappa_r", with_error(it.resolved_kappa_r(), it.kappa_r_error) + &kappa_r + flattened),
            ("mean gap", gap),
            ("mean pressure", units.pressure(it.mean_pressure) + &force),
            ("largest pressure", units.pressure(it.max_pressure)),
            ("certificate", format!("{:.2e} ({bound}{left})", it.certificate)),
        ]
    }

    /// The words before a value of theory. The solution of a contact that stands alone is not exact where the boundary is periodic, which adds neighbours.
    fn exact_words(&self) -> &'static str {
        let is_apart = self.has_neighbours && self.exact.as_ref().is_some_and(|exact| exact.name.ends_with("isolated"));
        if is_apart { "without neighbouring cells" } else { "exact" }
    }

    /// The radius of the contact in the exact solution, or half its width on a line, in words; none where the contact is not one circle or strip.
    pub(crate) fn exact_radius(&self, units: Units) -> Option<String> {
        let radius = self.exact.as_ref()?.contact_radius?;
        Some(format!("{} {}", self.exact_words(), units.length(radius)))
    }

    /// Further names and values, for who wants to know more of the contact, or of the solver.
    pub(crate) fn details(&self, units: Units) -> Vec<(String, String)> {
        let it = &self.observables;
        let of_shape = match it.edges_of_shape > MANY_OF_SHAPE {
            true => format!(", {} of the edges given by the shape", percent(it.edges_of_shape)),
            false => String::new(),
        };
        let small = match it.unresolved_share > 0.0 {
            true => format!(", {} of the contact in patches with too few nodes", percent(it.unresolved_share)),
            false => String::new(),
        };
        let in_contact = match it.reduced_pressure_contact.is_finite() {
            true => format!("in contact {:.6e}", it.reduced_pressure_contact),
            false => "in contact not known, since there is no gradient".into(),
        };
        let gradient = match it.rms_gradient_contact.is_finite() {
            true => format!("in contact {:.6e}", it.rms_gradient_contact),
            false => "in contact not known".into(),
        };
        let energy = Some(it.elastic_energy).filter(|energy| !energy.is_nan());
        let energy = energy.map(|energy| ("elastic energy per area", units.energy_per_area(energy)));
        let rows = [
            ("reduced pressure p*", format!("{:.6e}, {in_contact}", it.reduced_pressure)),
            ("rms gradient", format!("{:.6e}, {gradient}", it.rms_gradient)),
            ("kappa", with_error(it.resolved_kappa(), it.relative_area_error)),
            ("relative area, counted", counted(it.relative_area_counted, it.relative_area_corrected)),
            ("kappa, counted", counted(it.kappa_counted, it.kappa_corrected)),
            ("kappa_r, counted", counted(it.kappa_r_counted, it.kappa_r_corrected)),
            (
                "grid error, estimated",
                format!("area {}, kappa_r {}", percent(it.relative_area_error), percent(it.kappa_r_error)),
            ),
            ("contact patches", format!("{} ({:.2} nodes each{small}){of_shape}", it.patches, it.nodes_per_patch)),
            ("work", format!("{} steps, {} transforms, {:.3} s", it.iterations, it.transforms, self.seconds)),
        ];
        // a share of heights that were filled in says nothing where none touches
        let filled = (it.filled_area_share > 0.0).then(|| {
            let [area, load] = [it.filled_area_share, it.filled_load_share].map(percent);
            ("on filled heights", format!("{area} of the contact, {load} of the load"))
        });
        let rows = rows.into_iter().chain(filled).chain(energy).map(|(name, value)| (name.to_owned(), value));
        rows.chain(self.others(units)).collect()
    }

    /// The observables that no other row holds.
    fn others(&self, units: Units) -> impl Iterator<Item = (String, String)> {
        let values = serde_json::to_value(self.observables).unwrap_or_default();
        Quantity::found().filter(|it| it.row().is_printed).filter_map(move |quantity| {
            let value = values[quantity.name()].as_f64()?;
            let words = if quantity.row().unit == Unit::Length { units.length(value) } else { format!("{value:.6e}") };
            Some((quantity.name().replace('_', " "), words))
        })
    }
}

/// A quantity with resolved edges, and its error by the grid: as many digits as mean something.
fn with_error(resolved: Option<f64>, relative_error: f64) -> String {
    let Some(value) = resolved else { return "not resolved on this grid".into() };
    let error = value * relative_error;
    if !(error.is_finite() && error > 0.0) {
        return significant(value);
    }
    // one digit of the error, of a small one two
    let place = error.log10().floor();
    let places = -place + f64::from(u8::from(error < 2.0 * 10f64.powf(place)));
    match value >= SMALL {
        true => format!("{value:.0$} ± {error:.0$}", places.clamp(0.0, 12.0) as usize),
        false => format!("{value:.0$e} ± {error:.1e}", (places + value.log10().floor()).clamp(0.0, 12.0) as usize),
    }
}

/// A quantity by counting nodes, and without the mean excess of the nodes at the edges.
fn counted(counted: f64, corrected: f64) -> String {
    format!("{}, corrected {}", significant(counted), significant(corrected))
}

/// Words and a relative error behind its sign; nothing where there is no error.
fn plus_or_minus(words: &str, error: f64) -> String {
    if error > 0.0 && error.is_finite() { format!("{words} ± {error:.1e}") } else { String::new() }
}

fn percent(share: f64) -> String {
    if share.is_finite() { format!("{:.2} %", 100.0 * share) } else { "unknown".into() }
}
