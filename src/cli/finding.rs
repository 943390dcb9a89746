//! The findings of a solve under one load: status, observables, and the exact solution where there is one.

use super::flow::FlowFinding;
use super::output::{TextRow, row};
use super::units::{Units, significant};
use asperity::contact::{Contact, Load, Observables, Plasticity, Quantity, ResultClaim, Status, Unit};
use asperity::history::Sliding;
use asperity::setup::Setup;
use asperity::theory::Exact;
use serde::{Serialize, Serializer};

/// Values below this one are written with powers of ten.
const LEAST_PLAIN_NUMBER: f64 = 1e-3;

/// The words beside `kappa_r` of a contact with a hardness whose surface has yielded somewhere.
const FLATTENED: &str = "   by the gradient before the surface is flattened: do not compare it with elastic contacts";

/// The share of edges given by the shape is reported above this value.
const LARGEST_UNTOLD_SHARE_OF_SHAPE: f64 = 0.05;

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
    pub(crate) fn rows(&self, units: Units) -> Vec<TextRow> {
        let it = &self.observables;
        let mut rows = self.results(units);
        // The usual claim is left out: what is printed on every line is read on none.
        if self.claim != ResultClaim::Solution {
            rows.push(row("claim", self.claim.words()));
        }
        if it.friction.is_finite() {
            rows.extend(self.friction_rows(it.friction));
            // E* of p*, kappa and kappa_r is the modulus at this speed: without it they cannot be compared with those of other contacts.
            let modulus = units.pressure(it.effective_modulus);
            rows.push(row("effective modulus", format!("{modulus}, of p*, kappa and kappa_r")));
        }
        if !it.approach.is_nan() {
            rows.push(row("approach", units.length(it.approach)));
        }
        if let Some(plasticity) = &self.plasticity {
            let (area, load) = (significant(plasticity.area), percent(plasticity.load_share));
            let overlap = units.length(plasticity.overlap);
            rows.push(row("plastic area", format!("{area} ({load} of the load)")));
            rows.push(row("plastic overlap", format!("{overlap}, mean over the cell")));
        }
        if !it.stiffness.is_nan() {
            let load_error = plus_or_minus(", mean pressure", it.mean_pressure_error);
            rows.push(row("contact stiffness", format!("{:.6e}{load_error}", it.stiffness)));
        }
        if let Some(exact) = &self.exact {
            rows.push(row("exact values", exact.name));
        }
        if let Some(flow) = &self.flow {
            rows.extend(flow.rows(units));
        }
        rows
    }

    /// The friction of a contact that slides with the error of its grid, and what theory says.
    fn friction_rows(&self, friction: f64) -> Vec<TextRow> {
        // the error is relative
        let error = self.motion.get(Quantity::FrictionError).unwrap_or(0.0);
        let error = plus_or_minus("", friction.abs() * error);
        let mut rows = vec![row("friction coefficient", format!("{friction:.6e}{error} (by the loss in the solid)"))];
        let [full, persson] = [Quantity::FrictionFullContact, Quantity::FrictionPersson].map(|it| self.motion.get(it));
        if let (Some(full), Some(persson)) = (full, persson) {
            let theory = format!("{full:.6e}, by Persson's theory {persson:.6e}");
            rows.push(row("friction, full contact", theory));
        }
        rows
    }

    /// Area, `kappa_r`, gap and pressures, and the certificate.
    fn results(&self, units: Units) -> Vec<TextRow> {
        let it = &self.observables;
        let mut area = with_error(it.resolved_area(), it.relative_area_error);
        let mut kappa_r = with_error(it.resolved_kappa_r(), it.kappa_r_error);
        if let Some(exact) = &self.exact {
            area += &self.beside(exact.relative_area);
            if let Some(exact) = exact.kappa_r {
                kappa_r += &self.beside(exact);
            }
        }
        if self.plasticity.as_ref().is_some_and(|it| it.area > 0.0) {
            kappa_r += FLATTENED;
        }
        let gap_error = plus_or_minus("", it.mean_gap_error_bound);
        let gap = format!("{} ({:.4}{gap_error} rms heights)", units.length(it.mean_gap), it.mean_gap_over_rms_height);
        let mut pressure = units.pressure(it.mean_pressure);
        if let Some(force) = self.force {
            pressure += &format!(" (force {})", units.force(force));
        }
        let mut bound = format!("relative error of the pressure at most {:.1e}", it.pressure_error_bound);
        // At a given mean gap the load follows from how much of the gap is left, so the certificate over that gap tells the error of the load.
        if it.certificate_gap > 0.0 {
            bound += &format!(", {:.1e} of the remaining gap", it.certificate_gap);
        }
        vec![
            row("relative area", area),
            row("kappa_r", kappa_r),
            row("mean gap", gap),
            row("mean pressure", pressure),
            row("largest pressure", units.pressure(it.max_pressure)),
            row("certificate", format!("{:.2e} ({bound})", it.certificate)),
        ]
    }

    /// A value of the exact solution, to stand beside that of the solver.
    fn beside(&self, exact: f64) -> String {
        format!("   {} {}", self.exact_words(), significant(exact))
    }

    /// The words before a value of the exact solution.
    fn exact_words(&self) -> &'static str {
        self.exact.as_ref().map_or("exact", |exact| exact_words(exact.name, self.has_neighbours))
    }

    /// The radius of the contact in the exact solution, or half its width on a line, in words; none where the contact is not one circle or strip.
    pub(crate) fn exact_radius(&self, units: Units) -> Option<String> {
        let radius = self.exact.as_ref()?.contact_radius?;
        Some(format!("{} {}", self.exact_words(), units.length(radius)))
    }

    /// Further names and values, for who wants to know more of the contact, or of the solver.
    pub(crate) fn details(&self, units: Units) -> Vec<TextRow> {
        let it = &self.observables;
        let in_contact = match it.reduced_pressure_contact.is_finite() {
            true => format!("in contact {:.6e}", it.reduced_pressure_contact),
            false => "in contact not known, since there is no gradient".into(),
        };
        let gradient = match it.rms_gradient_contact.is_finite() {
            true => format!("in contact {:.6e}", it.rms_gradient_contact),
            false => "in contact not known".into(),
        };
        let errors = [it.relative_area_error, it.kappa_r_error].map(percent);
        let work = format!("{} steps, {} transforms, {:.3} s", it.iterations, it.transforms, self.seconds);
        let mut rows = vec![
            row("reduced pressure p*", format!("{:.6e}, {in_contact}", it.reduced_pressure)),
            row("rms gradient", format!("{:.6e}, {gradient}", it.rms_gradient)),
            row("kappa", with_error(it.resolved_kappa(), it.relative_area_error)),
            row("relative area, counted", counted(it.relative_area_counted, it.relative_area_corrected)),
            row("kappa, counted", counted(it.kappa_counted, it.kappa_corrected)),
            row("kappa_r, counted", counted(it.kappa_r_counted, it.kappa_r_corrected)),
            row("grid error, estimated", format!("area {}, kappa_r {}", errors[0], errors[1])),
            row("contact patches", self.patches()),
            row("work", work),
        ];
        // a share of heights that were filled in says nothing where none touches
        if it.filled_area_share > 0.0 {
            let [area, load] = [it.filled_area_share, it.filled_load_share].map(percent);
            rows.push(row("on filled heights", format!("{area} of the contact, {load} of the load")));
        }
        if !it.elastic_energy.is_nan() {
            rows.push(row("elastic energy per area", units.energy_per_area(it.elastic_energy)));
        }
        rows.extend(self.others(units));
        rows
    }

    /// The number and the size of the contact patches, and how far they can be trusted.
    fn patches(&self) -> String {
        let it = &self.observables;
        let mut words = format!("{} ({:.2} nodes each", it.patches, it.nodes_per_patch);
        if it.unresolved_share > 0.0 {
            words += &format!(", {} of the contact in patches with too few nodes", percent(it.unresolved_share));
        }
        words += ")";
        if it.edges_of_shape > LARGEST_UNTOLD_SHARE_OF_SHAPE {
            words += &format!(", {} of the edges given by the shape", percent(it.edges_of_shape));
        }
        words
    }

    /// The observables that no other row holds.
    fn others(&self, units: Units) -> Vec<TextRow> {
        let values = serde_json::to_value(self.observables).unwrap_or_default();
        let mut rows = Vec::new();
        for quantity in Quantity::found().filter(|it| it.row().is_printed) {
            // a number without a meaning is null
            let Some(value) = values[quantity.name()].as_f64() else { continue };
            let words = if quantity.row().unit == Unit::Length { units.length(value) } else { format!("{value:.6e}") };
            rows.push(row(&quantity.name().replace('_', " "), words));
        }
        rows
    }
}

/// The words before a value of a solution with a name, of [`Exact`]. The solution of a contact that stands alone is not exact where the boundary is
/// periodic, which adds neighbours.
pub(crate) fn exact_words(name: &str, has_neighbours: bool) -> &'static str {
    if has_neighbours && name.ends_with("isolated") { "without neighbouring cells" } else { "exact" }
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
    match value >= LEAST_PLAIN_NUMBER {
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
