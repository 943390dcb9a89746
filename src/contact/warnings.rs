//! Warnings about contacts with unreliable numbers: loads beyond full contact, grids that are too coarse, pressures
//! above those at which solids yield, slopes that are not small.

use super::{Contact, Law, Observables, Quantity, ResultClaim, State};
use crate::sentence::{Sentence, sentence};
use crate::warning::Warning;
use std::borrow::Borrow;

/// Reduced pressures above this one are far beyond full contact, which is near 1 to 2.
const HEAVIEST: f64 = 10.0;
/// Estimated errors of area or `kappa_r` above this one give a warning.
pub(crate) const LARGEST_ERROR: f64 = 0.1;
/// Contact moduli from this one on are those of metals, glasses and ceramics, if they are in pascals.
const STIFF: f64 = 1e10;
/// The pressure, divided by the contact modulus, above which all metals yield: the hardness of steels is 0.01 to 0.04
/// of it.
const HARDEST: f64 = 0.05;
/// The pressure, divided by the contact modulus, above which nearly all other solids yield, and strains are not small: the hardness of glassy
/// polymers is about 0.1 of it.
const LARGEST_STRAIN: f64 = 0.3;
/// Rms slopes of the contact above this one give a warning, since the theory neglects their squares.
const STEEPEST: f64 = 0.5;
/// Bounds of the error of the pressure above this one give a warning.
const LARGEST_BOUND: f64 = 0.1;
/// A share of the contact in patches that are too small to trust above this one gives a warning.
const LARGEST_SHARE: f64 = 0.25;
/// Shares of the contact on heights that were filled in above this one give a warning.
const LARGEST_FILLED_SHARE: f64 = 0.02;
/// Number of nodes in contact, over that in the largest contact of a history, up to which a state does not count. A path that begins at first touch
/// always has states of single nodes.
const SMALL_CONTACT: f64 = 1e-2;

/// Warnings about contacts under one load or several: loads far beyond full contact, errors that are not known,
/// inaccurate pressures, grids that are too coarse, and those of [`warnings_of_strains`].
pub fn warnings_of(found: &[&Observables], law: Law) -> Vec<Warning> {
    let strains: Vec<Strain> = found.iter().map(|it| Strain::from(*it)).collect();
    let contacts = Contacts { found, all: found.len(), are_states: false };
    contacts.warnings().into_iter().chain(warnings_of_strains(&strains, law)).collect()
}

/// The same warnings about the states of a process, whatever it is, and that of a contact that reaches a free rim. States whose contact is a hundredth
/// of the largest one or less, such as those at first touch, and frames on the way to a state do not count.
pub fn warnings_of_states(states: &[impl Borrow<State>]) -> Vec<Warning> {
    let states: Vec<&State> = states.iter().map(Borrow::borrow).collect();
    let found: Vec<Observables> = states.iter().map(|state| Observables::of_state(state)).collect();
    let largest = found.iter().map(|it| it.relative_area_counted).fold(0.0, f64::max);
    let is_touching = |(state, it): &(&&State, &Observables)| {
        state.claim != ResultClaim::Moving && it.relative_area_counted > SMALL_CONTACT * largest
    };
    let touching: Vec<(&State, &Observables)> =
        states.iter().zip(&found).filter(is_touching).map(|(state, it)| (*state, it)).collect();
    let counted: Vec<&Observables> = touching.iter().map(|(_, it)| *it).collect();
    let contacts = Contacts { found: &counted, all: states.len(), are_states: true };
    // the modulus of a solid that creeps depends on the time, and one that yields has a law for its strains
    let is_strained = |(state, _): &&(&State, &Observables)| {
        let feels = state.contact.values().feels;
        !(feels.memory || feels.eigenstrain)
    };
    let strains: Vec<Strain> =
        touching.iter().filter(is_strained).map(|(state, _)| Strain::from(&state.contact)).collect();
    let law = states.first().map_or(Law::HardWall, |first| first.contact.problem.law());
    let rim =
        states.iter().max_by_key(|state| nodes_at_rim(&state.contact)).and_then(|state| warning_of_rim(&state.contact));
    contacts.warnings().into_iter().chain(rim).chain(warnings_of_strains(&strains, law)).collect()
}

/// Contacts of which warnings speak.
#[derive(Clone, Copy)]
struct Contacts<'a> {
    found: &'a [&'a Observables],
    /// How many there are, with those that do not count.
    all: usize,
    /// Whether they are states of a process, and not contacts under loads.
    are_states: bool,
}

impl Contacts<'_> {
    /// All warnings but those of strains.
    fn warnings(self) -> Vec<Warning> {
        let all = [too_heavy(self), unknown(self), without_gradient(self), loose(self), coarse(self), filled(self)];
        let mut warnings: Vec<Warning> = all.into_iter().flatten().collect();
        // a grid is found for one contact only: several take a number
        if self.are_states || self.all > 1 {
            let remedies = warnings.iter_mut().flat_map(|it| &mut it.remedies);
            remedies.filter(|it| it.key == "grid.refine").for_each(|it| it.value = None);
        }
        warnings
    }

    /// The end of a statement that holds for some of them.
    fn count(self, count: usize) -> Sentence {
        match (self.all, self.are_states) {
            (1, _) => "".into(),
            (all, false) => sentence!(" under {count} of {all} loads", count, all),
            (all, true) => sentence!(" in {count} of {all} states", count, all),
        }
    }
}

/// How far a contact strains its solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strain {
    max_pressure: f64,
    /// The modulus that acts, a pressure.
    modulus: f64,
    /// The rms slope of the contact; 0 where it is not known.
    slope: f64,
}

impl Strain {
    /// The strain of a contact with the resolved slope of its surface, or else that of the nodes in contact. Where the shape gives the edges, as that
    /// of a punch does, the slope of the nodes is that of its sides, and is not known.
    fn new(max_pressure: f64, modulus: f64, [resolved, counted]: [f64; 2], has_edges_of_shape: bool) -> Self {
        let slopes = [Some(resolved), Some(counted).filter(|_| !has_edges_of_shape)];
        let slope = slopes.into_iter().flatten().find(|slope| slope.is_finite()).unwrap_or(0.0);
        Self { max_pressure, modulus, slope }
    }
}

impl From<&Observables> for Strain {
    fn from(it: &Observables) -> Self {
        let moduli = [it.effective_modulus, it.max_pressure / it.max_pressure_over_modulus];
        let modulus = moduli.into_iter().find(|modulus| modulus.is_finite()).unwrap_or(f64::NAN);
        let slopes = [it.rms_gradient_contact, it.rms_gradient_contact_counted];
        Self::new(it.max_pressure, modulus, slopes, it.edges_of_shape > 0.0)
    }
}

impl From<&Contact> for Strain {
    fn from(contact: &Contact) -> Self {
        let resolved = contact.resolved();
        let slopes = [resolved.rms_gradient_contact, contact.counted().rms_gradient_contact];
        Self::new(contact.max_pressure(), contact.effective_modulus(), slopes, resolved.edges_of_shape > 0)
    }
}

/// Warnings about contacts in which solids yield, or strains are too large for the theory.
pub fn warnings_of_strains(strains: &[Strain], law: Law) -> Vec<Warning> {
    [yielding(strains, law), steep(strains)].into_iter().flatten().collect()
}

/// The warning that a contact reaches a free rim, beyond which the heights are not known.
pub fn warning_of_rim(contact: &Contact) -> Option<Warning> {
    let pressed = nodes_at_rim(contact);
    (pressed > 0).then(|| {
        Warning::new(
            sentence!(
                "The contact reaches the free rim at {pressed} nodes. The heights beyond the rim are missing, so the \
                 pressure there is that of a sharp edge",
                pressed
            ),
            "Use a larger part of the surface, or a smaller load",
        )
    })
}

/// The nodes at a free rim that carry pressure.
fn nodes_at_rim(contact: &Contact) -> usize {
    let grid = contact.problem.surface().grid();
    contact.pressure.iter().enumerate().filter(|(node, p)| **p > 0.0 && grid.is_at_rim(*node)).count()
}

/// The warning that contacts that slide over a viscoelastic solid, one for each speed, leave a trail that is longer than the cell.
pub fn warning_of_trail<'a>(contacts: impl IntoIterator<Item = &'a Contact>) -> Option<Warning> {
    let slides: Vec<[f64; 2]> = contacts.into_iter().filter_map(trail_and_cell).collect();
    let long = slides.iter().filter(|[trail, cell]| trail > cell);
    let count = long.clone().count();
    let [trail, cell] = *long.max_by(|a, b| a[0].total_cmp(&b[0]))?;
    let (at, up_to) = match slides.len() {
        1 => (String::new(), ""),
        all => (format!("At {count} of {all} speeds t"), "up to "),
    };
    let t = if at.is_empty() { "T" } else { &at };
    Some(
        Warning::new(
            format!(
                "{t}he trail of the contact in the solid (speed times retardation time) is {up_to}{trail:.3e} long, and the \
                 cell {cell:.3e} along x, so that the surface slides into the trails of its periodic images. Friction, area and \
                 gap are those of the whole row of images, not of a single contact"
            ),
            "Use a cell that is longer along x than the trail, or a lower speed",
        )
        .with_remedy("grid.size", None)
        .with_remedy("sliding.speed", None),
    )
}

/// The warning that the friction of contacts that slide over a viscoelastic solid, one for each speed, is not known well on their grid.
pub fn warning_of_friction<'a>(contacts: impl IntoIterator<Item = &'a Contact>) -> Option<Warning> {
    let known = contacts.into_iter().filter_map(|contact| contact.values().get(Quantity::FrictionError));
    let errors: Vec<f64> = known.collect();
    let large = errors.iter().copied().filter(|error| *error > LARGEST_ERROR);
    let count = large.clone().count();
    let largest = amount(large.reduce(f64::max)?);
    let at = match errors.len() {
        1 => "".into(),
        all => sentence!(" at {count} of {all} speeds", count, all),
    };
    Some(
        Warning::new(
            sentence!("The friction coefficient may be off by {largest}{at} on this grid", largest, at),
            "Use a finer grid",
        )
        .with_remedy("grid.refine", None),
    )
}

/// Warnings about a contact under its load that do not follow from its observables: those of a rim, of a trail, and of its friction.
pub fn warnings_of_contact(contact: &Contact) -> Vec<Warning> {
    [warning_of_rim(contact), warning_of_trail([contact]), warning_of_friction([contact])]
        .into_iter()
        .flatten()
        .collect()
}

/// The length along which the solid remembers a contact that slides, and that of the cell along `x`.
fn trail_and_cell(contact: &Contact) -> Option<[f64; 2]> {
    let compliance = contact.problem.compliance();
    Some([compliance.trail()?, contact.problem.surface().grid().size()[1]])
}

fn too_heavy(contacts: Contacts<'_>) -> Option<Warning> {
    let heavy = contacts.found.iter().map(|it| it.reduced_pressure).filter(|it| *it > HEAVIEST).reduce(f64::max)?;
    Some(Warning::new(
        sentence!("The reduced pressure {heavy:.3e} is far above 1, so the contact is nearly full", heavy),
        "Check the load, the modulus, the size and their units",
    ))
}

fn unknown(contacts: Contacts<'_>) -> Option<Warning> {
    let count = contacts.found.iter().filter(|it| is_unknown(it) && !has_no_gradient(it)).count();
    (count > 0).then(|| {
        Warning::new(
            sentence!(
                "This grid is too coarse for kappa_r and its error estimate, so kappa_r may be completely wrong{count}",
                count = contacts.count(count)
            ),
            "Use a finer grid, or heights that are neither rounded nor clipped",
        )
        .with_remedy("grid.refine", Some("auto"))
    })
}

/// The warning that there is no `kappa_r` where the shape of the surface gives the edges of the contact.
fn without_gradient(contacts: Contacts<'_>) -> Option<Warning> {
    let count = contacts.found.iter().filter(|it| has_no_gradient(it)).count();
    (count > 0).then(|| {
        Warning::new(
            sentence!("The shape of the surface gives most edges of the contact, as those of a punch or of rounded and clipped heights, so there \
                 is no rms gradient in contact and no kappa_r{count}", count = contacts.count(count)),
            "Read area, pressure and gap, or give heights that are neither rounded nor clipped",
        )
    })
}

fn loose(contacts: Contacts<'_>) -> Option<Warning> {
    let bounds = contacts.found.iter().map(|it| it.pressure_error_bound).filter(|it| *it > LARGEST_BOUND);
    let bounds: Vec<f64> = bounds.collect();
    let largest = bounds.iter().copied().reduce(f64::max)?;
    let count = contacts.count(bounds.len());
    Some(
        Warning::new(
            match largest < 1.0 {
                true => sentence!(
                    "The relative error of the pressure may be {largest:.0} %{count}",
                    largest = 100.0 * largest,
                    count
                ),
                false => sentence!("The relative error of the pressure may be 100 % or more{count}", count),
            },
            "Set a tolerance for the pressure",
        )
        .with_remedy("stop.pressure-tolerance", Some("0.01")),
    )
}

fn coarse(contacts: Contacts<'_>) -> Option<Warning> {
    let doubtful: Vec<&Observables> = contacts.found.iter().copied().filter(|it| is_doubtful(it)).collect();
    let count = contacts.count(doubtful.len());
    let worst = doubtful.into_iter().max_by(|a, b| error(a).total_cmp(&error(b)))?;
    let share = (100.0 * worst.unresolved_share).round();
    let small = match share {
        0.0 => "".into(),
        share => sentence!(": {share} % of the contact is in patches that are too small to trust", share),
    };
    let [kappa_r, area] = [worst.kappa_r_error, worst.relative_area_error].map(amount);
    let statement = match (has_kappa_r(worst), worst.relative_area_error.is_nan()) {
        (true, _) => sentence!(
            "kappa_r may be off by {kappa_r}, the area by {area}{count} on this grid{small}",
            kappa_r,
            area,
            count,
            small
        ),
        (false, false) => sentence!("The area may be off by {area}{count} on this grid{small}", area, count, small),
        (false, true) => {
            sentence!(
                "{share} % of the contact is in patches that are too small to trust{count} on this grid",
                share,
                count
            )
        }
    };
    Some(
        Warning::new(statement, "Use a finer grid, or heights that are smoother and have more digits")
            .with_remedy("grid.refine", Some("auto")),
    )
}

/// The warning that much of the contact is on heights that were never measured.
fn filled(contacts: Contacts<'_>) -> Option<Warning> {
    let shares = contacts.found.iter().filter(|it| it.filled_area_share > LARGEST_FILLED_SHARE);
    let worst = shares.clone().max_by(|a, b| a.filled_area_share.total_cmp(&b.filled_area_share))?;
    let count = contacts.count(shares.count());
    let [area, load] = [worst.filled_area_share, worst.filled_load_share].map(|share| 100.0 * share);
    Some(
        Warning::new(
            sentence!("{area:.0} % of the contact and {load:.0} % of the load are on heights that were filled in and never measured{count}, and the area may be off by as much", area, load, count),
            "Crop the heights to a part that was measured",
        )
        .with_remedy("surface.prepare.crop", None),
    )
}

/// The warning that the solid yields below the pressures that are found.
fn yielding(strains: &[Strain], law: Law) -> Option<Warning> {
    if !law.is_hard_wall() {
        return None;
    }
    let share = |it: &Strain| it.max_pressure / it.modulus;
    let largest = |above: f64| strains.iter().filter(|it| it.modulus >= above).map(share).reduce(f64::max);
    let (metals, others) = (largest(STIFF).filter(|it| *it > HARDEST), largest(0.0).filter(|it| *it > LARGEST_STRAIN));
    let warning = match (metals, others) {
        (Some(share), _) => Warning::new(
            sentence!(
                "The largest pressure is {share:.2} of the contact modulus. Metals yield at lower pressures, so the \
                 real contact area is larger",
                share
            ),
            "Give the hardness",
        ),
        (None, None) => return None,
        (None, Some(share)) => Warning::new(
            sentence!(
                "The largest pressure is {share:.2} of the contact modulus. Nearly all solids yield at lower pressures, so the real contact \
                 area is larger, and strains are not small",
                share
            ),
            "Give the hardness; of rubber, which does not yield, use a smaller load or gentler slopes",
        ),
    };
    Some(warning.with_remedy("law.hardness", None))
}

/// The warning that slopes are not small.
fn steep(strains: &[Strain]) -> Option<Warning> {
    let slope = strains.iter().map(|it| it.slope).reduce(f64::max).filter(|slope| *slope > STEEPEST)?;
    Some(Warning::new(
        sentence!(
            "The rms slope of the contact is {slope:.2}, an angle of {degrees:.0} degrees, but the theory of elastic contact is for small slopes",
            slope,
            degrees = slope.atan().to_degrees()
        ),
        "Give heights and size in the same unit, and a slope as a gradient: 5 degrees are 0.087",
    ))
}

/// Whether a contact has no rms gradient, since the shape of the surface gives most of its edges.
fn has_no_gradient(it: &Observables) -> bool {
    it.edges_of_shape > 0.0 && it.rms_gradient_contact.is_nan()
}

/// Whether `kappa_r` has a meaning: with adhesion, areas are counted and there is none, and no certificate.
fn has_kappa_r(it: &Observables) -> bool {
    !it.certificate.is_nan()
}

/// Whether there is a contact whose `kappa_r`, or its error, is no number or zero.
fn is_unknown(it: &Observables) -> bool {
    has_kappa_r(it)
        && it.relative_area_counted > 0.0
        && !(it.kappa_r_error.is_finite() && it.relative_area_error.is_finite() && it.kappa_r > 0.0)
}

/// Whether the grid is too coarse for the numbers of a contact.
fn is_doubtful(it: &Observables) -> bool {
    error(it) > LARGEST_ERROR || it.unresolved_share > LARGEST_SHARE
}

/// A relative error in words.
fn amount(error: f64) -> String {
    match 100.0 * error {
        percent if !percent.is_finite() => "any amount".into(),
        percent if percent < 0.1 => "less than 0.1 %".into(),
        percent if percent < 9.95 => format!("{percent:.1} %"),
        percent => format!("{percent:.0} %"),
    }
}

/// The larger one of the estimated errors of the grid, without what filled heights add to it, which no finer grid mends.
fn error(it: &Observables) -> f64 {
    it.relative_area_error.max(it.kappa_r_error) - if it.filled_area_share > 0.0 { it.filled_area_share } else { 0.0 }
}
